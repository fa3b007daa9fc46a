/* A fleet of logs for closeloop --batch: rigs drawn at random as for the blind trials, simulated by the independent rig
 * of tests/second, each with a log of a few hundred rows and one to hold out.
 * Usage: fleet DIR N [ROWS]: DIR/list.csv, and in DIR/<name> rig.cfg, fit.csv, holdout.csv.
 * SPDX-License-Identifier: MIT */
#include <stdio.h>
#include <stdlib.h>

#include "../../apps/lab/outfile.h"
#include "../blind/logs.h"

enum { ROWS = 300, SEED = 7, PATHS = 600 };

static int write_one(const char *folder, int k, int rows, lab_error *error)
{
  blind_trial t;
  char path[PATHS];
  blind_draw(SEED, k, &t);
  t.spacing = t.fit.end / rows;
  snprintf(path, sizeof path, "%s/log-%05d", folder, k);
  return blind_write_logs(&t, path, error);
}

static int write_list(const char *folder, const char *written, int n, lab_error *error)
{
  char path[PATHS];
  lab_outfile list;
  int k;
  snprintf(path, sizeof path, "%s/list.csv", folder);
  if (lab_out_open(&list, path, error))
    return error->status;
  fputs("name,rig,log,holdout\n", list.file);
  for (k = 0; k < n; k++)
    if (written[k])
      fprintf(list.file, "log-%05d,log-%05d/rig.cfg,log-%05d/fit.csv,log-%05d/holdout.csv\n", k, k, k, k);
  return lab_out_close(&list, error);
}

/* Try the rigs from, ..., to - 1. One whose events cannot be followed is left out.  Returns: LAB_OK, LAB_WORLD */
static int write_some(const char *folder, char *written, int from, int to, int rows, lab_error *error)
{
  int k, status = LAB_OK;
#pragma omp parallel for schedule(dynamic)
  for (k = from; k < to; k++) {
    lab_error mine;
    const int failed = write_one(folder, k, rows, &mine);
    written[k] = failed == LAB_OK;
#pragma omp critical(fleet)
    if (failed && failed != LAB_NUMERIC) {
      status = failed;
      *error = mine;
    }
  }
  return status;
}

/* For each that was left out another is drawn. */
static int write_all(const char *folder, int n, int rows, lab_error *error)
{
  const int room = 2 * n;
  char *written = calloc((size_t)room, 1);
  int from = 0, to = n, done = 0, status = written ? LAB_OK : lab_fail_memory(error, "the fleet");
  while (status == LAB_OK && done < n && to <= room) {
    status = write_some(folder, written, from, to, rows, error);
    for (; from < to; from++)
      done += written[from];
    to += n - done;
  }
  if (status == LAB_OK && done < n)
    status = lab_fail(error, LAB_NUMERIC, "only %d of %d rigs can be followed", done, room);
  if (status == LAB_OK)
    status = write_list(folder, written, from, error);
  free(written);
  return status;
}

int main(int argc, char **argv)
{
  const int n = argc > 2 ? atoi(argv[2]) : 0, rows = argc > 3 ? atoi(argv[3]) : ROWS;
  lab_error error;
  if (argc < 3 || n < 1 || rows < 10) {
    fprintf(stderr, "usage: fleet DIR N [ROWS]\n");
    return LAB_USAGE;
  }
  if (write_all(argv[1], n, rows, &error)) {
    fprintf(stderr, "fleet: %s\n", error.text);
    return error.status;
  }
  return 0;
}

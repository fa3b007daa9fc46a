/* A fleet of logs for closeloop --batch: rigs drawn at random as for the blind trials, simulated by the independent rig
 * of tests/second, each with LOGS logs of a few hundred rows and as many to hold out, which differ in their noise: a
 * simulation takes as long as closeloop does.
 * Usage: fleet DIR N [ROWS]: DIR/list.csv, and in DIR/<name> rig.cfg, fit.csv, holdout.csv.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../apps/lab/base/outfile.h"
#include "../blind/logs.h"

enum { LOGS = 20, ROWS = 300, SEED = 7, PATHS = 600 };

/* What a rig shows, without noise. */
typedef struct rig {
  blind_trial trial;
  blind_rows fit, holdout;
} rig;

static void close_rig(rig *r)
{
  blind_rows_free(&r->fit);
  blind_rows_free(&r->holdout);
}

static int simulate(rig *r, int k, int rows, lab_error *error)
{
  blind_trial *t = &r->trial;
  second_rig truth;
  memset(r, 0, sizeof *r);
  blind_draw(SEED, k, t);
  t->spacing = t->fit.end / rows;
  truth = blind_truth(t, BLIND_ALL);
  truth.pressure_noise = truth.position_noise = truth.temperature_noise = 0;
  if (blind_simulate(&truth, &t->fit, t->spacing, &r->fit, error))
    return error->status;
  return blind_simulate(&truth, &t->holdout, t->spacing, &r->holdout, error);
}

/* Uniform in 0..1, without its ends: xorshift (G. Marsaglia, 2003). */
static double draw(uint64_t *state)
{
  *state ^= *state << 13;
  *state ^= *state >> 7;
  *state ^= *state << 17;
  return ((double)(*state >> 12) + 0.5) / 4503599627370496.0;
}

static void add_noise(double *y, size_t n, double sigma, uint64_t *state)
{
  const double turn = 6.283185307179586;
  size_t i;
  for (i = 0; i < n; i++)
    y[i] += sigma * sqrt(-2 * log(draw(state))) * cos(turn * draw(state));
}

static int write_noisy(const blind_trial *t, const blind_rows *clean, uint64_t seed, const char *folder,
                       const char *name, lab_error *error)
{
  const size_t size = 5 * clean->n * sizeof(double);
  uint64_t state = seed * UINT64_C(0x9e3779b97f4a7c15) + 1;
  double *block = malloc(size);
  const blind_rows noisy = {
      clean->n, block, block + clean->n, block + 2 * clean->n, block + 3 * clean->n, block + 4 * clean->n};
  int status;
  if (!block)
    return lab_fail_memory(error, "a log");
  memcpy(block, clean->t, size);
  add_noise(noisy.p, noisy.n, t->declared.pressure_noise, &state);
  add_noise(noisy.x, noisy.n, t->declared.position_noise, &state);
  add_noise(noisy.T, noisy.n, t->declared.temperature_noise, &state);
  status = blind_write_rows(&noisy, t->channels, folder, name, error);
  free(block);
  return status;
}

/* Rig k has the logs LOGS k, LOGS k + 1, ... */
static int write_logs(const char *folder, int k, int rows, lab_error *error)
{
  rig r;
  char path[PATHS];
  int i, status = simulate(&r, k, rows, error);
  for (i = LOGS * k; status == LAB_OK && i < LOGS * (k + 1); i++) {
    const uint64_t seed = 2 * (uint64_t)i;
    snprintf(path, sizeof path, "%s/log-%05d", folder, i);
    status = blind_write_rig(&r.trial, path, error);
    if (status == LAB_OK)
      status = write_noisy(&r.trial, &r.fit, seed, path, "fit.csv", error);
    if (status == LAB_OK)
      status = write_noisy(&r.trial, &r.holdout, seed + 1, path, "holdout.csv", error);
  }
  close_rig(&r);
  return status;
}

/* The first n logs that there are. */
static int write_list(const char *folder, const char *written, int rigs, int n, lab_error *error)
{
  char path[PATHS];
  lab_outfile list;
  int i, done = 0, status = LAB_OK;
  snprintf(path, sizeof path, "%s/list.csv", folder);
  if (lab_out_open(&list, path, error))
    return error->status;
  fputs("name,rig,log,holdout\n", list.file);
  for (i = 0; i < LOGS * rigs && done < n; i++)
    if (written[i / LOGS]) {
      fprintf(list.file, "log-%05d,log-%05d/rig.cfg,log-%05d/fit.csv,log-%05d/holdout.csv\n", i, i, i, i);
      done++;
    }
  if (done < n)
    status = lab_fail(error, LAB_NUMERIC, "only %d of %d rigs can be followed", done / LOGS, rigs);
  return lab_out_end(&list, status, error);
}

/* All rigs, and a few more: one whose events cannot be followed is left out, with its logs. */
static int write_all(const char *folder, int n, int rows, lab_error *error)
{
  const int enough = (n + LOGS - 1) / LOGS, rigs = enough + enough / 20 + 1;
  char *written = calloc((size_t)rigs, 1);
  int k, status = written ? LAB_OK : lab_fail_memory(error, "the fleet");
#pragma omp parallel for schedule(dynamic)
  for (k = 0; k < rigs; k++) {
    lab_error mine;
    const int failed = written ? write_logs(folder, k, rows, &mine) : LAB_WORLD;
    if (failed == LAB_OK)
      written[k] = 1;
#pragma omp critical(fleet)
    if (failed && failed != LAB_NUMERIC && status == LAB_OK) {
      status = failed;
      *error = mine;
    }
  }
  if (status == LAB_OK)
    status = write_list(folder, written, rigs, n, error);
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

#include "judge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"

/* Rows until a channel has moved by a tenth of its range; 0: it does not. */
static size_t rows_until_moved(const double *value, size_t n)
{
  double low, high;
  size_t first = 0, i;
  lab_range(value, n, &low, &high);
  while (first < n && isnan(value[first]))
    first++;
  for (i = first; i < n && !(fabs(value[i] - value[first]) > 0.1 * (high - low)); i++)
    ;
  return i < n ? i + 1 : 0;
}

/* Rows by which a run tells how it starts: until all that is measured has moved, half of the rows at most; a tenth of
 * them at least, and eight. */
static size_t rows_at_start(const lab_run *x)
{
  const size_t least = x->n / 10 > 8 ? x->n / 10 : 8;
  size_t start = least < x->n ? least : x->n;
  int c;
  for (c = 0; c < x->n_channels; c++) {
    const size_t moved = rows_until_moved(x->log->value[x->channel[c]] + x->first, x->n);
    start = moved > start && moved <= x->n / 2 ? moved : start;
  }
  return start;
}

enum part { START, REST, WHOLE };

/* Give the rows of a part of each run the weights that are kept, and the others none. */
static void weigh(const lab_run *run, int n, const double *kept, enum part part)
{
  size_t i;
  int e, c;
  for (e = 0; e < n; e++) {
    const size_t start = rows_at_start(&run[e]);
    for (c = 0; c < run[e].n_channels; c++, kept += run[e].n)
      for (i = 0; i < run[e].n; i++)
        run[e].weight[(size_t)c * run[e].n + i] = part == WHOLE || part == (i < start ? START : REST) ? kept[i] : 0;
  }
}

static void keep_weights(const lab_run *run, int n, double *kept)
{
  int e;
  for (e = 0; e < n; e++) {
    const size_t values = run[e].n * (size_t)run[e].n_channels;
    memcpy(kept, run[e].weight, values * sizeof *kept);
    kept += values;
  }
}

/* Error of a model on runs that it has not seen: what each log has for itself is fitted to how it starts, and the error
 * is that of the rest. */
static int judge_unseen(const lab_rig *model, const lab_run *run, int n, lab_unknowns *u, lab_errors *errors,
                        lab_error *error)
{
  double *kept;
  int status = lab_unknowns_own(model, run, n, u, error);
  if (status != LAB_OK || u->n == 0)
    return status == LAB_OK ? lab_loop_errors(u, errors, error) : status;
  kept = calloc(u->n_rows + 1, sizeof *kept);
  if (!kept)
    return lab_fail_memory(error, "the errors of a model");
  keep_weights(run, n, kept);
  weigh(run, n, kept, START);
  status = lab_unknowns_fit(u, LAB_ROUNDS_ALL, NULL, error);
  weigh(run, n, kept, REST);
  if (status == LAB_OK)
    status = lab_loop_errors(u, errors, error);
  weigh(run, n, kept, WHOLE);
  free(kept);
  return status;
}

int lab_judge(const lab_rig *model, const lab_run *run, int n, lab_errors *errors, lab_error *error)
{
  lab_unknowns *u = malloc(sizeof *u);
  const int status =
      u ? judge_unseen(model, run, n, u, errors, error) : lab_fail_memory(error, "the errors of a model");
  free(u);
  return status;
}

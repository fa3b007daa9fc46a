#include "beginning.h"

#include <stdlib.h>
#include <string.h>

#include "drift.h"

int lab_beginning_open(const lab_run *x, size_t n, lab_run *part, lab_error *error)
{
  int c;
  *part = *x;
  part->n = n;
  part->drift = NULL;
  part->weight = malloc((size_t)x->n_channels * n * sizeof *part->weight);
  if (!part->weight)
    return lab_fail_memory(error, "the beginning of a run");
  for (c = 0; c < x->n_channels; c++)
    memcpy(part->weight + (size_t)c * n, x->weight + (size_t)c * x->n, n * sizeof *part->weight);
  return x->drift ? lab_drift_open(part, error) : LAB_OK;
}

void lab_beginning_close(lab_run *part)
{
  free(part->weight);
  free(part->drift);
}

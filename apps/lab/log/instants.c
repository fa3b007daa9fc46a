#include "instants.h"

#include <stdlib.h>

static int by_time(const void *a, const void *b)
{
  const lab_instant *x = a, *y = b;
  if (x->t != y->t)
    return x->t < y->t ? -1 : 1;
  return x->row < y->row ? -1 : x->row > y->row;
}

void lab_instants_of(const lab_log *log, lab_instant *order)
{
  size_t i;
  for (i = 0; i < log->n; i++) {
    order[i].t = log->value[LAB_CHANNEL_TIME][i];
    order[i].row = i;
  }
  qsort(order, log->n, sizeof *order, by_time);
}

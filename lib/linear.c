/* Dense linear algebra for the few states of the model. */
#include "internal.h"

static int pivot_row(int n, int k, pneu_real a[PNEU_STATE_MAX][PNEU_STATE_MAX])
{
  pneu_real most = PNEU_M(fabs)(a[k][k]);
  int i, best = k;
  for (i = k + 1; i < n; i++) {
    const pneu_real size = PNEU_M(fabs)(a[i][k]);
    if (size > most) {
      most = size;
      best = i;
    }
  }
  return most > 0 ? best : -1;
}

static void swap_rows(int n, pneu_real *x, pneu_real *y)
{
  int j;
  for (j = 0; j < n; j++) {
    const pneu_real keep = x[j];
    x[j] = y[j];
    y[j] = keep;
  }
}

static void swap_columns(int n, int j, int k, pneu_real a[PNEU_STATE_MAX][PNEU_STATE_MAX])
{
  int i;
  for (i = 0; i < n; i++) {
    const pneu_real keep = a[i][j];
    a[i][j] = a[i][k];
    a[i][k] = keep;
  }
}

/* Scale row k so that its pivot is 1, and write that column of the inverse. */
static void scale_row(int n, int k, pneu_real *row)
{
  const pneu_real scale = 1 / row[k];
  int j;
  row[k] = 1;
  for (j = 0; j < n; j++)
    row[j] *= scale;
}

static void eliminate(int n, int k, const pneu_real *pivot, pneu_real *row)
{
  const pneu_real factor = row[k];
  int j;
  row[k] = 0;
  for (j = 0; j < n; j++)
    row[j] -= factor * pivot[j];
}

/* Gauss-Jordan with partial pivoting. The inverse serves every stage of a step: for so few states that is quicker than
 * as many pairs of triangular solves, and as exact (TRIED.md). */
int pneu_invert(int n, pneu_real a[PNEU_STATE_MAX][PNEU_STATE_MAX])
{
  unsigned char pivot[PNEU_STATE_MAX];
  int i, k;
  for (k = 0; k < n; k++) {
    const int r = pivot_row(n, k, a);
    if (r < 0)
      return PNEU_E_SINGULAR;
    pivot[k] = (unsigned char)r;
    if (r != k)
      swap_rows(n, a[k], a[r]);
    scale_row(n, k, a[k]);
    for (i = 0; i < n; i++)
      if (i != k)
        eliminate(n, k, a[k], a[i]);
  }
  for (k = n - 1; k >= 0; k--) /* swapped rows are swapped columns of the inverse */
    if (pivot[k] != k)
      swap_columns(n, k, pivot[k], a);
  return PNEU_OK;
}

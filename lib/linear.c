/* Dense linear algebra for the few states of the model. */
#include "internal.h"

static int pivot_row(int n, int k, pneu_real a[PNEU_STATE_MAX][PNEU_STATE_MAX])
{
  int i, best = k;
  for (i = k + 1; i < n; i++)
    if (PNEU_M(fabs)(a[i][k]) > PNEU_M(fabs)(a[best][k]))
      best = i;
  return best;
}

static void swap(pneu_real *x, pneu_real *y)
{
  const pneu_real keep = *x;
  *x = *y;
  *y = keep;
}

/* Gauss-Jordan with partial pivoting. The inverse serves eight products a step: for so few states that
 * is quicker than eight pairs of triangular solves, and as exact (DESIGN.md). */
int pneu_invert(int n, pneu_real a[PNEU_STATE_MAX][PNEU_STATE_MAX])
{
  unsigned char pivot[PNEU_STATE_MAX];
  int i, j, k;
  for (k = 0; k < n; k++) {
    pneu_real scale;
    const int r = pivot_row(n, k, a);
    pivot[k] = (unsigned char)r;
    if (!(PNEU_M(fabs)(a[r][k]) > 0))
      return PNEU_E_SINGULAR;
    for (j = 0; r != k && j < n; j++)
      swap(&a[k][j], &a[r][j]);
    scale = 1 / a[k][k];
    a[k][k] = 1;
    for (j = 0; j < n; j++)
      a[k][j] *= scale;
    for (i = 0; i < n; i++) {
      const pneu_real factor = a[i][k];
      if (i == k)
        continue;
      a[i][k] = 0;
      for (j = 0; j < n; j++)
        a[i][j] -= factor * a[k][j];
    }
  }
  for (k = n - 1; k >= 0; k--) /* swapped rows are swapped columns of the inverse */
    for (i = 0; pivot[k] != k && i < n; i++)
      swap(&a[i][k], &a[i][pivot[k]]);
  return PNEU_OK;
}

/* Dense LU with partial pivoting for the few states of the model. */
#include "internal.h"

static int pivot_row(int n, int k, pneu_real a[PNEU_STATE_MAX][PNEU_STATE_MAX])
{
  int i, best = k;
  for (i = k + 1; i < n; i++)
    if (PNEU_M(fabs)(a[i][k]) > PNEU_M(fabs)(a[best][k]))
      best = i;
  return best;
}

static void swap_rows(int n, pneu_real *a, pneu_real *b)
{
  int j;
  for (j = 0; j < n; j++) {
    const pneu_real keep = a[j];
    a[j] = b[j];
    b[j] = keep;
  }
}

int pneu_lu_factor(int n, pneu_real a[PNEU_STATE_MAX][PNEU_STATE_MAX], unsigned char *pivot)
{
  int i, j, k;
  for (k = 0; k < n; k++) {
    const int r = pivot_row(n, k, a);
    pivot[k] = (unsigned char)r;
    if (!(PNEU_M(fabs)(a[r][k]) > 0))
      return PNEU_E_SINGULAR;
    if (r != k)
      swap_rows(n, a[k], a[r]);
    a[k][k] = 1 / a[k][k]; /* kept as its reciprocal */
    for (i = k + 1; i < n; i++) {
      const pneu_real factor = a[i][k] *= a[k][k];
      for (j = k + 1; j < n; j++)
        a[i][j] -= factor * a[k][j];
    }
  }
  return PNEU_OK;
}

void pneu_lu_solve(int n, pneu_real a[PNEU_STATE_MAX][PNEU_STATE_MAX], const unsigned char *pivot, pneu_real *b)
{
  int i, j;
  for (i = 0; i < n; i++) {
    const pneu_real keep = b[pivot[i]];
    b[pivot[i]] = b[i];
    b[i] = keep;
  }
  for (i = 1; i < n; i++)
    for (j = 0; j < i; j++)
      b[i] -= a[i][j] * b[j];
  for (i = n - 1; i >= 0; i--) {
    for (j = i + 1; j < n; j++)
      b[i] -= a[i][j] * b[j];
    b[i] *= a[i][i];
  }
}

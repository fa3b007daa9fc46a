#include "normal.h"

#include <math.h>
#include <string.h>

typedef double matrix[LAB_NORMAL_MAX + 1][LAB_NORMAL_MAX + 1];

void lab_normal_clear(lab_normal *normal, int k)
{
  memset(normal, 0, sizeof *normal);
  normal->k = k;
}

void lab_normal_add_rows(lab_normal *normal, const double *const *column, int m)
{
  int i, j, row;
  for (i = 0; i <= normal->k; i++)
    for (j = i; j <= normal->k; j++) {
      double sum = 0;
      for (row = 0; row < m; row++)
        sum += column[i][row] * column[j][row];
      normal->g[i][j] += sum;
    }
}

void lab_normal_add(lab_normal *normal, double weight, const lab_normal *other)
{
  int i, j;
  for (i = 0; i <= normal->k; i++)
    for (j = i; j <= normal->k; j++)
      normal->g[i][j] += weight * other->g[i][j];
}

void lab_normal_select(const lab_normal *normal, int n, const int *keep, lab_normal *part)
{
  int i, j;
  lab_normal_clear(part, n);
  for (i = 0; i <= n; i++)
    for (j = i; j <= n; j++) {
      const int a = i < n ? keep[i] : normal->k, b = j < n ? keep[j] : normal->k;
      part->g[i][j] = normal->g[a < b ? a : b][a < b ? b : a];
    }
}

void lab_normal_shift(lab_normal *normal, const double *change)
{
  const int k = normal->k;
  double moved[LAB_NORMAL_MAX]; /* J'J change */
  int i, j;
  for (i = 0; i < k; i++) {
    moved[i] = 0;
    for (j = 0; j < k; j++)
      moved[i] += normal->g[i < j ? i : j][i < j ? j : i] * change[j];
  }
  for (i = 0; i < k; i++)
    normal->g[k][k] += change[i] * (moved[i] - 2 * normal->g[i][k]);
  for (i = 0; i < k; i++)
    normal->g[i][k] -= moved[i];
}

/* Take column `pivot` out of what is left of the others. */
static void eliminate(matrix g, int k, const int *done, int pivot)
{
  int i, j;
  for (i = 0; i <= k; i++)
    for (j = i; j <= k; j++)
      if (!done[i] && !done[j] && i != pivot && j != pivot) {
        const double a = i < pivot ? g[i][pivot] : g[pivot][i], b = j < pivot ? g[j][pivot] : g[pivot][j];
        g[i][j] -= a * b / g[pivot][pivot];
      }
}

/* The column of J of which most is left, as a share of its square.  Returns: -1 where too little is left of any. */
static int largest(matrix g, int k, const int *done, const double *square)
{
  const double spanned = 1e-8;
  double best = spanned;
  int j, pivot = -1;
  for (j = 0; j < k; j++)
    if (!done[j] && square[j] > 0 && g[j][j] > best * square[j]) {
      best = g[j][j] / square[j];
      pivot = j;
    }
  return pivot;
}

double lab_normal_rest(const lab_normal *normal)
{
  int done[LAB_NORMAL_MAX + 1] = {0}, j;
  double square[LAB_NORMAL_MAX];
  matrix g;
  memcpy(g, normal->g, sizeof g);
  for (j = 0; j < normal->k; j++)
    square[j] = g[j][j];
  while ((j = largest(g, normal->k, done, square)) >= 0) {
    eliminate(g, normal->k, done, j);
    done[j] = 1;
  }
  return sqrt(fmax(g[normal->k][normal->k], 0));
}

/* J'J with the priors, in units of them, as L L'.  Out: factor, its lower triangle */
static void factorise(const lab_normal *normal, const double *prior, matrix factor)
{
  int i, j, l;
  for (i = 0; i < normal->k; i++)
    for (j = 0; j <= i; j++) {
      double sum = prior[i] * normal->g[j][i] * prior[j] + (i == j);
      for (l = 0; l < j; l++)
        sum -= factor[i][l] * factor[j][l];
      factor[i][j] = i == j ? sqrt(fmax(sum, 1)) : sum / factor[j][j]; /* 1 is the prior; less is rounding */
    }
}

static void solve(matrix factor, int k, double *b)
{
  int i, l;
  for (i = 0; i < k; i++) {
    for (l = 0; l < i; l++)
      b[i] -= factor[i][l] * b[l];
    b[i] /= factor[i][i];
  }
  for (i = k - 1; i >= 0; i--) {
    for (l = i + 1; l < k; l++)
      b[i] -= factor[l][i] * b[l];
    b[i] /= factor[i][i];
  }
}

void lab_normal_step(const lab_normal *normal, const double *prior, double *step)
{
  matrix factor;
  int j;
  factorise(normal, prior, factor);
  for (j = 0; j < normal->k; j++)
    step[j] = prior[j] * normal->g[j][normal->k];
  solve(factor, normal->k, step);
  for (j = 0; j < normal->k; j++)
    step[j] *= prior[j];
}

void lab_normal_deviations(const lab_normal *normal, const double *prior, double *deviation)
{
  matrix factor;
  int i, j;
  factorise(normal, prior, factor);
  for (j = 0; j < normal->k; j++) {
    double b[LAB_NORMAL_MAX] = {0};
    for (i = 0; i < normal->k; i++)
      b[i] = i == j;
    solve(factor, normal->k, b);
    deviation[j] = prior[j] * sqrt(b[j]);
  }
}

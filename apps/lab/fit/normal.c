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

int lab_solve_positive(int n, int stride, double *a, double *b)
{
  int i, j, k;
  for (j = 0; j < n; j++) {
    double *row = a + (size_t)j * (size_t)stride;
    for (k = 0; k < j; k++) {
      const double *above = a + (size_t)k * (size_t)stride;
      double sum = row[k];
      for (i = 0; i < k; i++)
        sum -= row[i] * above[i];
      row[k] = sum / above[k];
    }
    for (k = 0; k < j; k++)
      row[j] -= row[k] * row[k];
    if (!(row[j] > 0))
      return -1;
    row[j] = sqrt(row[j]);
  }
  for (j = 0; j < n; j++) {
    for (k = 0; k < j; k++)
      b[j] -= a[(size_t)j * (size_t)stride + (size_t)k] * b[k];
    b[j] /= a[(size_t)j * (size_t)stride + (size_t)j];
  }
  for (j = n - 1; j >= 0; j--) {
    for (k = j + 1; k < n; k++)
      b[j] -= a[(size_t)k * (size_t)stride + (size_t)j] * b[k];
    b[j] /= a[(size_t)j * (size_t)stride + (size_t)j];
  }
  return 0;
}

void lab_normal_deviations(const lab_normal *normal, const double *prior, double *deviation)
{
  const int k = normal->k;
  int i, j, l;
  for (l = 0; l < k; l++) {
    matrix a;
    double b[LAB_NORMAL_MAX] = {0};
    b[l] = 1;
    for (i = 0; i < k; i++)
      for (j = 0; j <= i; j++)
        a[i][j] = prior[i] * normal->g[j][i] * prior[j] + (i == j);
    deviation[l] = lab_solve_positive(k, LAB_NORMAL_MAX + 1, &a[0][0], b) ? prior[l] : prior[l] * sqrt(b[l]);
  }
}

void lab_normal_rows(const lab_normal *normal, double row[][LAB_NORMAL_MAX + 1])
{
  const double spanned = 1e-14;
  const int k = normal->k;
  int i, j, l;
  for (i = 0; i <= k; i++) {
    double left = normal->g[i][i];
    for (l = 0; l < i; l++)
      left -= row[l][i] * row[l][i];
    for (j = 0; j <= k; j++)
      row[i][j] = 0;
    if (!(left > spanned * normal->g[i][i]))
      continue;
    for (j = i; j <= k; j++) {
      double sum = normal->g[i][j];
      for (l = 0; l < i; l++)
        sum -= row[l][i] * row[l][j];
      row[i][j] = sum / sqrt(left);
    }
  }
}

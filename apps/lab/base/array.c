#include "array.h"

#include <math.h>
#include <stdlib.h>

double lab_dot(const double *a, const double *b, size_t n)
{
  double sum = 0;
  size_t i;
#pragma omp simd reduction(+ : sum)
  for (i = 0; i < n; i++)
    sum += a[i] * b[i];
  return sum;
}

double lab_project_out(const double *basis, int n, size_t stride, size_t m, double *v)
{
  double before = sqrt(lab_dot(v, v, m)), left = before;
  int j, pass;
  size_t i;
  for (pass = 0; pass < 2; pass++) {
    for (j = 0; j < n; j++) {
      const double *b = basis + (size_t)j * stride;
      const double c = lab_dot(b, v, m);
      for (i = 0; i < m; i++)
        v[i] -= c * b[i];
    }
    left = sqrt(lab_dot(v, v, m));
    if (left > 0.1 * before)
      break;
  }
  return left;
}

static int ascending(const void *a, const void *b)
{
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

void lab_sort(double *value, size_t n)
{
  qsort(value, n, sizeof *value, ascending);
}

double lab_median(double *value, size_t n)
{
  lab_sort(value, n);
  return n % 2 ? value[n / 2] : (value[n / 2 - 1] + value[n / 2]) / 2;
}

int lab_range(const double *value, size_t n, double *low, double *high)
{
  size_t i;
  *low = HUGE_VAL;
  *high = -HUGE_VAL;
  for (i = 0; i < n; i++)
    if (!isnan(value[i])) {
      *low = fmin(*low, value[i]);
      *high = fmax(*high, value[i]);
    }
  return *low <= *high;
}

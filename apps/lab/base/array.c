#include "array.h"

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

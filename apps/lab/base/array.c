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

enum { TOGETHER = 4 }; /* columns: each entry that they are multiplied by is read once */

/* sum[k] += a . (b + k stride), of all that go together. */
static void add_products(const double *a, const double *b, size_t stride, size_t n, double *sum)
{
  const double *b1 = b + stride, *b2 = b1 + stride, *b3 = b2 + stride;
  double s0 = 0, s1 = 0, s2 = 0, s3 = 0;
  size_t i;
#pragma omp simd reduction(+ : s0, s1, s2, s3)
  for (i = 0; i < n; i++) {
    s0 += a[i] * b[i];
    s1 += a[i] * b1[i];
    s2 += a[i] * b2[i];
    s3 += a[i] * b3[i];
  }
  sum[0] += s0;
  sum[1] += s1;
  sum[2] += s2;
  sum[3] += s3;
}

void lab_dots(const double *a, const double *b, size_t stride, int columns, size_t n, double *sum)
{
  int k = 0;
  for (; k + TOGETHER <= columns; k += TOGETHER)
    add_products(a, b + (size_t)k * stride, stride, n, sum + k);
  for (; k < columns; k++)
    sum[k] += lab_dot(a, b + (size_t)k * stride, n);
}

/* v -= the columns, each times its share, of all that go together. */
static void take_shares(double *restrict v, const double *restrict b, size_t stride, size_t n, const double *share)
{
  const double *b1 = b + stride, *b2 = b1 + stride, *b3 = b2 + stride;
  size_t i;
#pragma omp simd
  for (i = 0; i < n; i++)
    v[i] -= share[0] * b[i] + share[1] * b1[i] + share[2] * b2[i] + share[3] * b3[i];
}

static void take_share(double *restrict v, const double *restrict b, size_t n, double share)
{
  size_t i;
#pragma omp simd
  for (i = 0; i < n; i++)
    v[i] -= share * b[i];
}

/* Take the span of orthonormal columns out of v, as far as that can be done at once. */
static void take_out(const double *basis, int columns, size_t stride, size_t n, double *v)
{
  int j, k;
  for (j = 0; j < columns; j += TOGETHER) {
    const double *b = basis + (size_t)j * stride;
    const int some = columns - j < TOGETHER ? columns - j : TOGETHER;
    double share[TOGETHER] = {0};
    lab_dots(v, b, stride, some, n, share);
    if (some == TOGETHER)
      take_shares(v, b, stride, n, share);
    else
      for (k = 0; k < some; k++)
        take_share(v, b + (size_t)k * stride, n, share[k]);
  }
}

double lab_project_out(const double *basis, int n, size_t stride, size_t m, double *v)
{
  const double before = sqrt(lab_dot(v, v, m));
  double left = before;
  int pass;
  for (pass = 0; pass < 2; pass++) {
    take_out(basis, n, stride, m, v);
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

#include "quantile.h"

#include <float.h>
#include <math.h>

/* Continued fraction of the incomplete beta function, evaluated by Lentz's method [DLMF 8.17.22]. */
static double beta_fraction(double x, double a, double b)
{
  enum { TERMS = 10000 };
  double c = 1, d = 1 / (1 - (a + b) * x / (a + 1)), value = d;
  int k;
  for (k = 1; k < TERMS; k++) {
    const double even = k * (b - k) * x / ((a + 2 * k - 1) * (a + 2 * k));
    const double odd = -(a + k) * (a + b + k) * x / ((a + 2 * k) * (a + 2 * k + 1));
    double factor;
    d = 1 / (1 + even * d);
    c = 1 + even / c;
    value *= c * d;
    d = 1 / (1 + odd * d);
    c = 1 + odd / c;
    factor = c * d;
    value *= factor;
    if (fabs(factor - 1) < DBL_EPSILON)
      break;
  }
  return value;
}

/* Regularised incomplete beta function I_x(a, b), 0 <= x <= 1. */
static double beta_share(double x, double a, double b)
{
  double front;
  if (x <= 0 || x >= 1)
    return x > 0;
  front = exp(lgamma(a + b) - lgamma(a) - lgamma(b) + a * log(x) + b * log1p(-x));
  if (x < (a + 1) / (a + b + 2)) /* where the fraction converges fast */
    return front * beta_fraction(x, a, b) / a;
  return 1 - front * beta_fraction(1 - x, b, a) / b;
}

double lab_student_probability(double x, double degrees)
{
  double tail;
  if (isinf(degrees))
    return 0.5 * erfc(-x * 0.70710678118654752440);
  /* P(|t| > x) = I_{d/(d + x^2)}(d/2, 1/2) */
  tail = 0.5 * beta_share(degrees / (degrees + x * x), 0.5 * degrees, 0.5);
  return x > 0 ? 1 - tail : tail;
}

double lab_student_quantile(double p, double degrees)
{
  double low = -1, high = 1;
  int i;
  while (lab_student_probability(low, degrees) > p)
    low *= 2;
  while (lab_student_probability(high, degrees) < p)
    high *= 2;
  for (i = 0; i < 200 && high - low > DBL_EPSILON * (fabs(low) + fabs(high)); i++) {
    const double middle = 0.5 * (low + high);
    if (lab_student_probability(middle, degrees) < p)
      low = middle;
    else
      high = middle;
  }
  return 0.5 * (low + high);
}

/* Q(d/2, x/2) by Q(a + 1, z) = Q(a, z) + z^a e^-z/Gamma(a + 1) from Q(1/2, z) = erfc(sqrt z) or Q(1, z) = e^-z
 * [DLMF 8.8.6, 8.4.6, 8.4.8]: for whole degrees of freedom a sum of positive terms. */
double lab_chi2_tail(double x, int degrees)
{
  const double z = 0.5 * x;
  double a = degrees % 2 ? 0.5 : 1;
  double tail = degrees % 2 ? erfc(sqrt(z)) : exp(-z);
  for (; a < 0.5 * degrees && z > 0; a++)
    tail += exp(a * log(z) - z - lgamma(a + 1));
  return fmin(tail, 1);
}

double lab_chi2_threshold(double p)
{
  const double z = lab_student_quantile(0.5 * p, HUGE_VAL);
  return z * z;
}

#include "windowed.h"

#include <math.h>

enum { FEWEST = 8 };
static const double rougher = 1.5; /* times the model's scatter: a stroke that is only bent, or comes at another time,
                                      scatters much as the model's does */
/* How well a window is known, over the roughness of the whole: its mean, as the stem may have stopped anywhere within a
 * slip; and its scatter. */
static const double course_share = 0.5, roughness_share = 0.2;

/* Mean, slope over the window and scatter about the straight line. */
typedef struct view {
  double mean, rise, scatter;
  size_t n;
} view;

static view look(const double *y, const double *present, size_t w)
{
  double n = 0, sy = 0, st = 0, stt = 0, sty = 0, syy = 0;
  view v = {0, 0, 0, 0};
  size_t i;
  for (i = 0; i < w; i++) {
    const double t = (double)i / (double)w - 0.5;
    if (isnan(present[i]) || isnan(y[i]))
      continue;
    n++;
    sy += y[i];
    st += t;
    stt += t * t;
  }
  v.n = (size_t)n;
  if (v.n < FEWEST)
    return v;
  v.mean = sy / n;
  stt -= st * st / n;
  for (i = 0; i < w; i++) {
    const double t = (double)i / (double)w - 0.5 - st / n;
    if (isnan(present[i]) || isnan(y[i]))
      continue;
    sty += t * (y[i] - v.mean);
    syy += (y[i] - v.mean) * (y[i] - v.mean);
  }
  v.rise = sty / stt;
  v.scatter = sqrt(fmax(syy - sty * v.rise, 0) / (n - 2));
  return v;
}

size_t lab_windowed_count(size_t n, size_t w)
{
  return n < w ? 0 : 2 * (n - w) / w + 1;
}

static view look_at(const double *y, const double *present, size_t k, size_t w)
{
  return look(y + k * (w / 2), present + k * (w / 2), w);
}

/* Root mean square of the scatter beyond the noise, over the windows that have any. */
static double roughness(const double *measured, size_t count, size_t w, double sigma)
{
  double sum = 0;
  size_t k, n = 0;
  for (k = 0; k < count; k++) {
    const view seen = look_at(measured, measured, k, w);
    if (seen.n < FEWEST || !(seen.scatter > 2 * sigma))
      continue;
    sum += seen.scatter * seen.scatter - sigma * sigma;
    n++;
  }
  return n ? sqrt(sum / (double)n) : 0;
}

void lab_windowed_residuals(const double *measured, const double *predicted, size_t n, size_t w, double sigma,
                            double *r)
{
  const size_t count = lab_windowed_count(n, w);
  const double rough = roughness(measured, count, w, sigma);
  const double course_known = course_share * rough, scatter_known = roughness_share * rough;
  size_t k;
  for (k = 0; k < count; k++) {
    const view seen = look_at(measured, measured, k, w), model = look_at(predicted, measured, k, w);
    const double known_mean = sqrt(sigma * sigma / (double)seen.n + course_known * course_known);
    const double known_scatter = sqrt(sigma * sigma / (2 * (double)seen.n) + scatter_known * scatter_known);
    const double expected = sqrt(model.scatter * model.scatter + sigma * sigma);
    r[2 * k] = seen.n < FEWEST ? 0 : (seen.mean - model.mean) / known_mean;
    r[2 * k + 1] = seen.n < FEWEST ? 0 : (seen.scatter - expected) / known_scatter;
  }
}

double lab_windowed_roughness(const double *measured, const double *predicted, size_t n, size_t w, double sigma)
{
  const size_t count = lab_windowed_count(n, w);
  size_t k, moving = 0, rough = 0;
  for (k = 0; k < count; k++) {
    const view seen = look_at(measured, measured, k, w), model = look_at(predicted, measured, k, w);
    if (seen.n < FEWEST || fabs(seen.rise) < 6 * sigma)
      continue;
    moving++;
    rough += seen.scatter * seen.scatter > rougher * rougher * model.scatter * model.scatter + 9 * sigma * sigma;
  }
  return moving ? (double)rough / (double)moving : 0;
}

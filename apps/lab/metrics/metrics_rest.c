#include <math.h>

#include "metrics_private.h"

lab_part lab_part_mean(const lab_record *r, const double *value, size_t begin, size_t end, int k)
{
  const double from = r->t[begin], whole = r->t[end - 1] - from;
  lab_part part = {0, 0};
  size_t i;
  for (i = begin; i < end; i++) {
    const double share = whole > 0 ? (r->t[i] - from) / whole : 1;
    if (isnan(value[i]) || (int)fmin(LAB_PARTS * share, LAB_PARTS - 1) != k)
      continue;
    part.mean += value[i];
    part.n++;
  }
  part.mean = part.n ? part.mean / (double)part.n : (double)NAN;
  return part;
}

lab_rest lab_rest_of(const lab_record *r, const double *value, size_t begin, size_t end, double noise)
{
  const lab_part before = lab_part_mean(r, value, begin, end, LAB_PARTS - 2);
  const lab_part last = lab_part_mean(r, value, begin, end, LAB_PARTS - 1);
  lab_rest rest = {(double)NAN, (double)NAN, (double)NAN};
  if (last.n == 0 || before.n == 0)
    return rest;
  rest.level = last.mean;
  rest.error = 2 * noise / sqrt((double)last.n);
  noise *= LAB_SEEN * sqrt(1 / (double)before.n + 1 / (double)last.n);
  rest.drift = fmax(fabs(last.mean - before.mean) - noise, 0);
  return rest;
}

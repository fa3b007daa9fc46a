#include "chance.h"

#include <math.h>

/* Steele, Lea, Flood 2014, OOPSLA: SplitMix. */
uint64_t blind_bits(blind_chance *c)
{
  uint64_t z = c->state += UINT64_C(0x9E3779B97F4A7C15);
  z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
  return z ^ (z >> 31);
}

blind_chance blind_chance_of(uint64_t seed, uint64_t trial)
{
  blind_chance c = {seed};
  c.state = blind_bits(&c) ^ (trial * UINT64_C(0xD1342543DE82EF95));
  c.state = blind_bits(&c);
  return c;
}

double blind_uniform(blind_chance *c, double lo, double hi)
{
  return lo + (hi - lo) * (double)(blind_bits(c) >> 11) * 0x1p-53;
}

double blind_log_uniform(blind_chance *c, double lo, double hi)
{
  return lo * exp(log(hi / lo) * blind_uniform(c, 0, 1));
}

double blind_normal(blind_chance *c)
{
  const double a = blind_uniform(c, 1e-12, 1), b = blind_uniform(c, 0, 1);
  return sqrt(-2 * log(a)) * cos(6.283185307179586 * b);
}

int blind_below(blind_chance *c, int n)
{
  return (int)blind_uniform(c, 0, n);
}

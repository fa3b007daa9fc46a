/* Random numbers of the blind trials: splitmix64, so that a seed gives the same trials on every machine.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_CHANCE_H
#define BLIND_CHANCE_H

#include <stdint.h>

typedef struct blind_chance {
  uint64_t state;
} blind_chance;

/* A stream of its own for each trial of a seed. */
blind_chance blind_chance_of(uint64_t seed, uint64_t trial);

uint64_t blind_bits(blind_chance *c);

/* Evenly in lo..hi. */
double blind_uniform(blind_chance *c, double lo, double hi);

/* Evenly in the logarithm, 0 < lo <= hi. */
double blind_log_uniform(blind_chance *c, double lo, double hi);

/* Standard normal, by Box and Muller. */
double blind_normal(blind_chance *c);

/* 0 .. n-1 */
int blind_below(blind_chance *c, int n);

#endif

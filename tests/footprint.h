/* Footprint tests: FOOTPRINT(effect, what_it_shows) { ... } is the test of that name of an effect.
 * SPDX-License-Identifier: MIT */
#ifndef TESTS_FOOTPRINT_H
#define TESTS_FOOTPRINT_H

#include "fixture.h"

typedef struct footprint {
  const char *effect;
  void (*check)(void);
} footprint;

static footprint footprints[CHECK_TESTS];
static int footprint_n;

static inline void footprint_run(void **state)
{
  const footprint *f = *state;
  fixture_need(f->effect);
  check_note("%s", f->effect);
  f->check();
}

static inline void footprint_join(const char *name, const char *effect, void (*check)(void))
{
  footprints[footprint_n] = (footprint){effect, check};
  check_join((struct CMUnitTest){name, footprint_run, NULL, NULL, &footprints[footprint_n++]});
}

#define FOOTPRINT(effect, shows)                                                                                       \
  static void footprint_##effect(void);                                                                                \
  __attribute__((constructor)) static void footprint_##effect##_joins(void)                                            \
  {                                                                                                                    \
    footprint_join("test_" #effect "__" #shows, #effect, footprint_##effect);                                          \
  }                                                                                                                    \
  static void footprint_##effect(void)

/* Fails by name for an effect on one of the equations (a string of words) that has none. */
static inline void footprint_complete(const char *equations)
{
  int e, i, found;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    const pneu_effect *effect = pneu_effect_at(e);
    if (!strstr(equations, effect->equation))
      continue;
    for (i = found = 0; i < footprint_n; i++)
      found += strcmp(footprints[i].effect, effect->name) == 0;
    if (!found)
      fail_msg("no footprint test for %s", effect->name);
  }
}

#endif

/* Footprint tests: one row and one function for every effect.
 * SPDX-License-Identifier: MIT */
#ifndef TESTS_FOOTPRINT_H
#define TESTS_FOOTPRINT_H

#include "fixture.h"

typedef struct footprint {
  const char *effect;
  const char *shows; /* the second half of the test's name */
  void (*check)(void);
} footprint;

static inline void footprint_run(void **state)
{
  const footprint *f = *state;
  if (pneu_effect_find(f->effect) < 0)
    skip();
  check_note("%s", f->effect);
  f->check();
}

/* A test for each row. */
static inline void footprint_join(footprint *row, int n)
{
  static char name[CHECK_TESTS][100];
  int i;
  for (i = 0; i < n && i < CHECK_TESTS; i++) {
    snprintf(name[i], sizeof name[i], "test_%s__%s", row[i].effect, row[i].shows);
    check_join((struct CMUnitTest){name[i], footprint_run, NULL, NULL, &row[i]});
  }
}

/* Fails by name for an effect on one of the equations (a string of words) that has no row. */
static inline void footprint_complete(const footprint *row, int n, const char *equations)
{
  int e, i, found;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    const pneu_effect *effect = pneu_effect_at(e);
    if (!strstr(equations, effect->equation))
      continue;
    for (i = found = 0; i < n; i++)
      found += strcmp(row[i].effect, effect->name) == 0;
    if (!found)
      fail_msg("no footprint test for %s", effect->name);
  }
}

#endif

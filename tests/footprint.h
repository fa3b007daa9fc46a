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

/* A cmocka test for each row.  In: name  room for the names, as many as rows */
static inline void footprint_tests(footprint *row, int n, char (*name)[100], struct CMUnitTest *test)
{
  int i;
  memset(test, 0, (size_t)n * sizeof *test);
  for (i = 0; i < n; i++) {
    snprintf(name[i], sizeof name[i], "test_%s__%s", row[i].effect, row[i].shows);
    test[i].name = name[i];
    test[i].test_func = footprint_run;
    test[i].initial_state = &row[i];
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

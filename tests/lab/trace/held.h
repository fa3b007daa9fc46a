/* A log of a virtual rig, and its declared model within its tolerances.
 * SPDX-License-Identifier: MIT */
#ifndef TESTS_HELD_H
#define TESTS_HELD_H

#include "../../check.h"
#include "../../scratch.h"
#include "../../virtual.h"

#include "../../../apps/lab/trace/candidate.h"

typedef struct held_log {
  lab_rig rig;
  lab_log log;
  lab_run run;
  lab_candidate c;
} held_log;

/* Record 14 s of a rig, and fit its declared model, the orifices unknown.  In/out: h  static */
static inline void held_open(held_log *h, const second_rig *truth)
{
  virtual_record(truth, NULL, 0, scratch_path("log.csv"));
  virtual_declare(&h->rig);
  h->rig.fit[h->rig.n_fit++] = LAB_PARAM_ORIFICE_AREA;
  virtual_open(&h->rig, scratch_path("log.csv"), &h->log, &h->run);
  memset(&h->c, 0, sizeof h->c);
  succeed(lab_unknowns_open(&h->rig, &h->run, 1, &h->c.u, &error));
  succeed(lab_candidate_hold(&h->c, &error));
  assert_true(h->c.quality.fitted);
}

/* Add an effect at some size, and fit again. */
static inline void held_add(held_log *h, const char *param, double size)
{
  const int index = pneu_param_find(param);
  const lab_score score = {.effect = pneu_effect_of(index), .param = index, .shape = -1};
  succeed(lab_candidate_add_effect(&h->c, &score, size, &error));
  succeed(lab_candidate_fit(&h->c, LAB_ROUNDS_ALL, &error));
}

#endif

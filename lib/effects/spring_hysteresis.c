/* Friction within the spring (coils, diaphragm fabric) that builds up over a travel d and keeps its sense at rest:
 * force F_h z with z' = (v - |v| z)/d, -1 < z < 1. What builds up in less than 0.1 mm is dry friction. */
#include "../internal.h"

enum { FORCE, LENGTH };

static const pneu_param_info params[] = {
    {"hysteresis_force", "N", 0, PNEU_C(1e6), PNEU_C(200.0), 0, 0, "half width of the loop, fully built up"},
    {"hysteresis_length", "m", PNEU_C(1e-4), PNEU_C(10.0), PNEU_C(1e-3), PNEU_C(1e-3), 1,
     "travel in which it builds up"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  rate[0] = (t->v - PNEU_M(fabs)(t->v) * state[0]) / param[LENGTH];
  t->force -= param[FORCE] * state[0];
}

const pneu_effect pneu_effect_record_spring_hysteresis = {
    "spring_hysteresis",
    "Spring and diaphragm give back less force than they took.",
    "Dahl 1976, AIAA Journal 14:1675",
    "force",
    "after each reversal the balance of forces drifts over some travel, where dry friction would jump",
    PNEU_STAGE_FORCE,
    params,
    .add = add};

const char pneu_effect_sentence_spring_hysteresis[] =
    "Spring and diaphragm give back less force than they took: {size} either way, {of_friction} of the dry friction.";

/* A relief valve at the chamber: shut below its set pressure, its area grows with the pressure above it.
 * What it stands for: a safety valve set too low, a bleed that lifts. */
#include "../internal.h"

enum { RELIEF_SLOPE, RELIEF_PRESSURE };

static const pneu_param_info params[] = {
    {"relief_slope", "m2/Pa", 0, PNEU_C(1e-9), PNEU_C(1e-13), 0, 0, "effective area that opens for each pascal"},
    {"relief_pressure", "Pa", 0, PNEU_C(1e7), PNEU_C(1e5), PNEU_C(1e5), 1, "gauge pressure at which it lifts"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  const pneu_params *p = &t->model->p;
  const pneu_real above = t->p - p->ambient_pressure - param[RELIEF_PRESSURE];
  (void)state, (void)rate;
  if (!t->model->law.pressure_input && above > 0)
    pneu_exchange(t, param[RELIEF_SLOPE] * above, p->ambient_pressure, p->ambient_temperature, 0);
}

const pneu_effect pneu_effect_record_relief_valve = {
    "relief_valve",
    "Air leaves the chamber above a set pressure.",
    "proportional relief valve, ISO 4126-1:2013 for the terms",
    "mass",
    "pressure stays low near the supply; below the set pressure nothing shows",
    PNEU_STAGE_LEAK,
    params,
    .add = add};

const char pneu_effect_sentence_relief_valve[] = "The chamber lets air go above a set pressure: {leak}.";

/* A chamber of plastic or rubber gives way slowly: its dead volume V grows by V c (p_y - p_a) with
 * p_y' = (p - p_y)/tau. The state is p_y over the absolute supply pressure; at rest p_y = p. What gives way at once is
 * not seen beside the gas, and counts as volume; so does what gives way in less than 0.2 s.
 * Size: a printed chamber that leaks has 1.9e-7 1/Pa over 1 s (results/measured), 15 % at its 7.66 bar; a diaphragm of
 * 400 cm2 that bulges by 0.1 mm more under 4 bar adds 4 mL, to a dead volume of 40 mL 2.5e-7 1/Pa. Up to ten times
 * that is asked for; what a log explains by more is no wall. */
#include "../internal.h"

enum { COMPLIANCE, TIME };

static const pneu_param_info params[] = {
    {"volume_compliance", "1/Pa", 0, PNEU_C(2.5e-6), PNEU_C(2e-8), 0, 0,
     "share by which the volume grows per pressure"},
    {"volume_time", "s", PNEU_C(0.2), PNEU_C(1e5), PNEU_C(5.0), PNEU_C(5.0), 1, "time constant with which it does"}};

static int acts(const pneu_model *model, const pneu_real *param)
{
  return !model->law.pressure_input && param[COMPLIANCE] > 0;
}

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  const pneu_real scale = t->model->scale[0], give = t->model->p.dead_volume * param[COMPLIANCE];
  rate[0] = (t->p / scale - state[0]) / param[TIME];
  t->volume += give * (state[0] * scale - t->model->p.ambient_pressure);
  t->growth += give * scale * rate[0];
}

static void start(const pneu_real *param, const pneu_terms *t, pneu_real *state)
{
  (void)param;
  state[0] = t->p / t->model->scale[0];
}

const pneu_effect pneu_effect_record_chamber_creep = {
    "chamber_creep",
    "The chamber's wall gives way slowly: its volume grows under pressure.",
    "standard linear solid: Zener 1948, Elasticity and Anelasticity of Metals",
    "mass",
    "after the chamber is shut the pressure sinks and settles, or rises after venting, though nothing leaks",
    PNEU_STAGE_GEOMETRY,
    params,
    .add = add,
    .start = start,
    .acts = acts};

const char pneu_effect_sentence_chamber_creep[] =
    "The chamber's wall gives way slowly: at the supply pressure its volume grows by {volume_growth}, "
    "{of_volume} of the dead volume.";

/* A wall that stores heat: C T_w' = -Q + G_a (T_a - T_w), Q the heat into the gas, which meets T_w in place of T_a.
 * The state is w = (T_w - T_a)/T_a. Heat is corrected by film (T_w - T_a); where the film depends on the temperature
 * difference it keeps the value for a wall at ambient temperature. Without a film (heat_transfer) nothing happens.
 * Size: the wall that takes part within a stroke weighs 0.05 to 1 kg, of 500 to 900 J/(kg K). */
#include "../internal.h"

enum { COMPLIANCE, LOSS };

static const pneu_param_info params[] = {
    {"wall_compliance", "K/J", 0, PNEU_C(10.0), PNEU_C(0.01), 0, 0, "1/C, C the heat capacity of the wall"},
    {"wall_loss", "W/K", 0, PNEU_C(1e5), PNEU_C(1.0), PNEU_C(1.0), 1, "conductance from the wall to ambient"}};

/* Effects of earlier stages are known by now: the gas has its own temperature because a film acts. */
static int acts(const pneu_model *model, const pneu_real *param)
{
  return model->thermal && param[COMPLIANCE] > 0;
}

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  const pneu_real warmer = state[0] * t->model->p.ambient_temperature; /* T_w - T_a */
  t->heat += t->film * warmer;
  rate[0] = -param[COMPLIANCE] * (t->heat + param[LOSS] * warmer) / t->model->p.ambient_temperature;
}

const pneu_effect pneu_effect_record_wall_temperature = {
    "wall_temperature",
    "The wall warms and cools with the gas instead of staying at ambient temperature.",
    "lumped capacitance: Incropera and DeWitt 2002, section 5.1",
    "energy",
    "pressure recovers less after the orifices shut, then creeps on for minutes; strokes in quick succession drift",
    PNEU_STAGE_WALL,
    params,
    .add = add,
    .acts = acts};

const char pneu_effect_sentence_wall_temperature[] =
    "The wall warms and cools with the gas: its heat capacity is {reciprocal}.";

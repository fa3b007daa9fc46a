/* The pressure sensor is off by a constant: shown + b. */
#include "../internal.h"

enum { BIAS };

static const pneu_param_info params[] = {
    {"pressure_bias", "Pa", PNEU_C(-1e7), PNEU_C(1e7), PNEU_C(2e3), 0, 0, "what the sensor shows too much"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  (void)state, (void)rate;
  t->p_shown += param[BIAS];
}

const pneu_effect pneu_effect_record_pressure_bias = {
    "pressure_bias",
    "The pressure sensor shows a constant too much.",
    "instrumental bias: JCGM 200:2012 (VIM), 4.20",
    "sensor",
    "shown pressure is off by the same everywhere, also vented; position is right",
    PNEU_STAGE_SENSOR,
    params,
    .add = add};

const char pneu_effect_sentence_pressure_bias[] =
    "The pressure sensor shows {size} too {+much|little}, {of_supply} of the supply.";

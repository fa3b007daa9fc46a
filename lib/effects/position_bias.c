/* The position sensor is off by a constant: shown + b. */
#include "../internal.h"

enum { BIAS };

static const pneu_param_info params[] = {
    {"position_bias", "m", PNEU_C(-1.0), PNEU_C(1.0), PNEU_C(2e-4), 0, 0, "what the sensor shows too much"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  (void)state, (void)rate;
  t->x_shown += param[BIAS];
}

const pneu_effect pneu_effect_record_position_bias = {
    "position_bias",
    "The position sensor shows a constant too much.",
    "instrumental bias: JCGM 200:2012 (VIM), 4.20",
    "sensor",
    "shown position is off by the same on both stops and between; pressure is right",
    PNEU_STAGE_SENSOR,
    params,
    .add = add};

const char pneu_effect_sentence_position_bias[] =
    "The position sensor shows {size} too {+much|little}, {of_stroke} of the stroke.";

/* The position sensor is off in proportion: (1 + g) times what it follows. */
#include "../internal.h"

enum { GAIN };

static const pneu_param_info params[] = {{"position_gain", "1", PNEU_C(-0.9), PNEU_C(10.0), PNEU_C(0.02), 0, 0,
                                          "what the sensor shows too much, over the true value"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  (void)state, (void)rate;
  t->x_shown *= 1 + param[GAIN];
}

const pneu_effect pneu_effect_record_position_gain = {
    "position_gain",
    "The position sensor shows too much in proportion.",
    "gain fault of a sensor: DAMADICS f13 (Bartys et al. 2006, Control Eng. Practice 14:577)",
    "sensor",
    "shown position is right on the lower stop and off in proportion above it; pressure is right",
    PNEU_STAGE_GAIN,
    params,
    .add = add};

const char pneu_effect_sentence_position_gain[] =
    "The position sensor shows {percent} of the reading too {+much|little}.";

/* The position channel is sampled or sent later than the others: at time t it shows x(t - s). The skew is a constant of
 * the model, for whoever owns the clock; see pneu_model.
 * Size: a fraction of the sampling interval for a multiplexed converter, 10 to 200 ms over a bus. */
#include "../internal.h"

enum { SKEW };

static const pneu_param_info params[] = {
    {"channel_skew", "s", PNEU_C(-100.0), PNEU_C(100.0), PNEU_C(0.02), 0, 0, "age of the position when it is shown"}};

static void prepare(pneu_model *model, const pneu_real *param)
{
  model->position_skew = param[SKEW];
}

const pneu_effect pneu_effect_record_channel_skew = {
    "channel_skew",
    "Position is older (or younger) than the pressure beside it.",
    "delay between channels of a recorder: IEEE Std 1057-2017",
    "sensor",
    "shown position is late by the same time at every speed, with sharp corners; pressure is right",
    PNEU_STAGE_SENSOR,
    params,
    .prepare = prepare};

const char pneu_effect_sentence_channel_skew[] =
    "The recorded position is {size} {+older|younger} than the pressure beside it.";

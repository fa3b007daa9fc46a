/* The transducer follows its command late: tau y' = u - y, y the opening. */
#include "../internal.h"

enum { TIME_CONSTANT };

static const pneu_param_info params[] = {
    {"transducer_time", "s", 0, 10, PNEU_C(0.02), 0, 0, "time constant of the opening"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  rate[0] = (t->opening - state[0]) / param[TIME_CONSTANT];
  t->opening = state[0];
}

static void start(const pneu_real *param, const pneu_terms *t, pneu_real *state)
{
  (void)param;
  state[0] = t->opening;
}

const pneu_effect pneu_effect_record_transducer_lag = {
    "transducer_lag",
    "The opening follows the command with a first-order lag.",
    "switching times of 5 to 30 ms are usual for on/off pilots",
    "command",
    "pressure starts late by the same time after every change of command, both ways",
    PNEU_STAGE_COMMAND,
    params,
    .add = add,
    .start = start,
    .acts = pneu_lag_acts};

const char pneu_effect_sentence_transducer_lag[] = "The transducer follows its command with a lag of {size}.";

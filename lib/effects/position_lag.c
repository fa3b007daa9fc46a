/* The position sensor follows late: tau y' = x - y. The state is y over the stroke.
 * Size: 1 to 50 ms by the filter of the sensor. */
#include "../internal.h"

enum { TIME_CONSTANT };

static const pneu_param_info params[] = {
    {"position_time", "s", 0, PNEU_C(100.0), PNEU_C(0.02), 0, 0, "time constant of the sensor"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  const pneu_real scale = t->model->scale[2];
  rate[0] = (t->x_shown / scale - state[0]) / param[TIME_CONSTANT];
  t->x_shown = state[0] * scale;
}

static void start(const pneu_real *param, const pneu_terms *t, pneu_real *state)
{
  (void)param;
  state[0] = t->x / t->model->scale[2];
}

const pneu_effect pneu_effect_record_position_lag = {
    "position_lag",
    "The position sensor shows a change late.",
    "first-order response: step response time, JCGM 200:2012 (VIM), 4.23",
    "sensor",
    "shown position trails by velocity times lag, both ways; pressure is right",
    PNEU_STAGE_LAG,
    params,
    .add = add,
    .start = start,
    .acts = pneu_lag_acts};

const char pneu_effect_sentence_position_lag[] = "The position sensor follows with a lag of {size}.";

/* The temperature sensor follows late: tau y' = T - y. The state is y over the ambient temperature.
 * Size: 0.1 s (bare wire of 0.1 mm) to 30 s (sheathed). */
#include "../internal.h"

enum { TIME_CONSTANT };

static const pneu_param_info params[] = {
    {"temperature_time", "s", 0, PNEU_C(100.0), PNEU_C(0.5), 0, 0, "time constant of the sensor"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  const pneu_real scale = t->model->scale[1];
  rate[0] = (t->T_shown / scale - state[0]) / param[TIME_CONSTANT];
  t->T_shown = state[0] * scale;
}

static void start(const pneu_real *param, const pneu_terms *t, pneu_real *state)
{
  (void)param;
  state[0] = (t->T - t->model->start_excess) / t->model->scale[1];
}

const pneu_effect pneu_effect_record_temperature_lag = {
    "temperature_lag",
    "The temperature sensor shows a change late.",
    "Moffat 1962, Temperature: Its Measurement and Control 3(2):553",
    "sensor",
    "shown temperature trails and swings less; pressure and position are right",
    PNEU_STAGE_LAG,
    params,
    .add = add,
    .start = start,
    .acts = pneu_lag_acts};

const char pneu_effect_sentence_temperature_lag[] = "The temperature sensor follows with a lag of {size}.";

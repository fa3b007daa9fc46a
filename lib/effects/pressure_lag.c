/* The pressure sensor follows late: tau y' = p - y. The state is y over the absolute supply pressure.
 * Size: 1 to 20 ms with the line to the transducer. */
#include "../internal.h"

enum { TIME_CONSTANT };

static const pneu_param_info params[] = {
    {"pressure_time", "s", 0, PNEU_C(100.0), PNEU_C(0.02), 0, 0, "time constant of the sensor"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  const pneu_real scale = t->model->scale[0];
  rate[0] = (t->p_shown / scale - state[0]) / param[TIME_CONSTANT];
  t->p_shown = state[0] * scale;
}

static void start(const pneu_real *param, const pneu_terms *t, pneu_real *state)
{
  (void)param;
  state[0] = (t->p - t->model->p.ambient_pressure) / t->model->scale[0];
}

const pneu_effect pneu_effect_record_pressure_lag = {
    "pressure_lag",
    "The pressure sensor shows a change late.",
    "line to the transducer: Iberall 1950, J. Res. NBS 45:85 (RP2115)",
    "sensor",
    "shown pressure trails by rate times lag, both ways; position is right",
    PNEU_STAGE_LAG,
    params,
    .add = add,
    .start = start,
    .acts = pneu_lag_acts};

const char pneu_effect_sentence_pressure_lag[] = "The pressure sensor follows with a lag of {size}.";

/* The command acts late: u(t - d). The delay is a constant of the model; what is on its way is in pneu_input.delay.
 * Of a positioner it is what this opens that acts late, within the loop: three lags of d/3 in a row, which reach half
 * of a step after 0.9 d, as what is on its way there is no command and has to be a state. Size: 3 ms per metre of tube
 * (speed of sound), 5 to 30 ms for the transducer's electronics and bus. */
#include "../internal.h"

enum { DELAY };
enum { LAGS = 3 };

static const pneu_param_info params[] = {
    {"dead_time", "s", 0, PNEU_C(100.0), PNEU_C(0.02), 0, 0, "delay of the command"}};

/* A model without a positioner has the line alone. */
static int count_lags(const pneu_model *model)
{
  return model->band_edge > 0 ? LAGS : 0;
}

static int acts(const pneu_model *model, const pneu_real *param)
{
  const pneu_real lag = param[DELAY] / LAGS;
  if (count_lags(model) == 0)
    return param[DELAY] > 0 ? PNEU_ACTS_BY_CONSTANTS : PNEU_RESTS;
  return pneu_lag_acts(model, &lag);
}

static void prepare(pneu_model *model, const pneu_real *param)
{
  model->command_delay = param[DELAY];
}

/* An opening that is not the positioner's comes late by its line. */
static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  const int late = pneu_is_in_loop(t->model, t->input);
  int i;
  for (i = 0; i < count_lags(t->model); i++) {
    rate[i] = late ? LAGS * (t->opening - state[i]) / param[DELAY] : 0;
    t->opening = late ? state[i] : t->opening;
  }
}

static void start(const pneu_real *param, const pneu_terms *t, pneu_real *state)
{
  int i;
  (void)param;
  for (i = 0; i < count_lags(t->model); i++)
    state[i] = t->opening;
}

const pneu_effect pneu_effect_record_dead_time = {
    "dead_time",
    "Nothing happens for a while after a change of command.",
    "transport lag L/c in pneumatic lines: Richer and Hurmuzlu 2000, ASME J. Dyn. Syst. Meas. Control 122:416",
    "command",
    "pressure starts late by the same time after every change of command, both ways, and then has the right slope at "
    "once",
    PNEU_STAGE_COMMAND,
    params,
    .add = add,
    .start = start,
    .acts = acts,
    .prepare = prepare};

const char pneu_effect_sentence_dead_time[] = "Every command acts {size} late.";

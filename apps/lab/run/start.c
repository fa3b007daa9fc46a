#include "start.h"

#include <math.h>

/* What the log says about the start; NaN where it says nothing. */
struct seen {
  double p; /* [Pa] gauge */
  double x; /* [m] */
  double T; /* [K] */
};

/* Whether what drives the model has changed from the first row of a run to another. */
static int has_changed(const pneu_laws *law, const lab_log *log, size_t first, size_t row)
{
  const int command = lab_log_command(log);
  const double *u = command < 0 ? NULL : log->value[command], *p = log->value[LAB_CHANNEL_P],
               *x = log->value[LAB_CHANNEL_X];
  return (u && u[row] != u[first]) || (law->pressure_input && p && p[row] != p[first]) ||
         (law->position_input && x && x[row] != x[first]);
}

/* Rows before what drives the model first changes. */
static size_t rows_before_change(const pneu_laws *law, const lab_log *log, size_t first, size_t end)
{
  size_t n = 1;
  while (first + n < end && !has_changed(law, log, first, first + n))
    n++;
  return n;
}

/* Mean and squared error of the mean over the values that are there. */
static double mean(const double *value, size_t n, double *error2)
{
  double sum = 0, square = 0, centre;
  size_t i, m = 0;
  for (i = 0; i < n; i++)
    if (!isnan(value[i])) {
      sum += value[i];
      m++;
    }
  centre = sum / (double)m;
  for (i = 0; i < n; i++)
    if (!isnan(value[i]))
      square += (value[i] - centre) * (value[i] - centre);
  *error2 = square / ((double)m * (double)(m > 1 ? m - 1 : 1));
  return centre;
}

static double first_value(const double *value, size_t n)
{
  size_t i = 0;
  while (i + 1 < n && isnan(value[i]))
    i++;
  return value[i];
}

/* Whether values scatter rather than run along a curve: the mean squared step from one to the next is twice the
 * variance of white noise (von Neumann 1941), and far less for a curve. */
static int is_scatter(const double *value, size_t n)
{
  const double least = 0.5;
  double error2, step2 = 0, before = (double)NAN;
  size_t i, steps = 0, there = 0;
  mean(value, n, &error2);
  for (i = 0; i < n; i++) {
    if (isnan(value[i]))
      continue;
    there++;
    if (!isnan(before)) {
      step2 += (value[i] - before) * (value[i] - before);
      steps++;
    }
    before = value[i];
  }
  return step2 >= least * error2 * (double)there * (double)steps;
}

/* Whether the first of n values is one like the others; a move at the start hardly shifts the mean of many. */
static int begins_there(const double *value, size_t n)
{
  const double most = 4; /* standard deviations */
  double error2;
  const double centre = mean(value + 1, n - 1, &error2);
  return isnan(value[0]) || fabs(value[0] - centre) <= most * sqrt(error2 * (double)(n - 1));
}

/* Mean of the first n values; halved until they scatter, the first is one of them and both halves agree within three
 * standard errors, and the first value alone where too few are left to tell. */
static double level(const double *value, size_t n)
{
  const size_t few = 8;
  for (; n >= few; n /= 2) {
    double error_a, error_b, error2;
    const double a = mean(value, n / 2, &error_a), b = mean(value + n / 2, n - n / 2, &error_b);
    if ((a - b) * (a - b) <= 9 * (error_a + error_b) && is_scatter(value, n) && begins_there(value, n))
      return mean(value, n, &error2);
  }
  return first_value(value, n);
}

/* A channel at the start: where it drives the model its first value, else its level. */
static double look(const pneu_laws *law, const lab_log *log, int channel, size_t run, int drives)
{
  size_t first = log->run[run], end = log->run[run + 1];
  if (!log->value[channel])
    return NAN;
  return drives ? first_value(log->value[channel] + first, end - first)
                : level(log->value[channel] + first, rows_before_change(law, log, first, end));
}

static double balance(const pneu_model *model, double x, const pneu_input *input)
{
  return (double)pneu_balance_pressure(model, (pneu_real)x, input, 0);
}

double lab_balance_position(const pneu_model *model, double pressure, const pneu_input *input)
{
  enum { ROUNDS = 20 }; /* false position: one for a spring with a straight line */
  const double travel = (double)model->travel, enough = 1e-12;
  double low = 0, high = travel, p_low = balance(model, low, input), p_high = balance(model, high, input), x = 0;
  const double span = p_high - p_low;
  int i;
  if (!(pressure > p_low))
    return 0;
  if (!(pressure < p_high))
    return travel;
  for (i = 0; i < ROUNDS; i++) {
    double p;
    x = low + (high - low) * (pressure - p_low) / (p_high - p_low);
    p = balance(model, x, input);
    if (!(fabs(p - pressure) > enough * span))
      break;
    *(p < pressure ? &low : &high) = x;
    *(p < pressure ? &p_low : &p_high) = p;
  }
  return x;
}

/* How near a stop a stem is seen that stands on it [m]. */
static double near_stop(const pneu_model *model)
{
  return 0.02 * (double)model->p.stroke;
}

/* What the transducer is told: the command, or what a positioner makes of a set position while the stem rests at x; 0
 * where there is no such state. */
static double opening_at(const pneu_model *model, const pneu_input *input, double p, double x)
{
  pneu_state state;
  pneu_output out;
  if (!input->set_position)
    return (double)input->u;
  if (pneu_state_rest(model, (pneu_real)p, model->p.ambient_temperature, (pneu_real)x, input, &state) != PNEU_OK ||
      pneu_observe(model, &state, input, &out) != PNEU_OK)
    return 0;
  return (double)out.opening;
}

/* Pressure that holds the stem where it is seen: none on the lower stop, the supply on the upper one while the
 * transducer fills, which a positioner does not that is content. */
static double balanced_pressure(const pneu_model *model, const pneu_input *input, double x)
{
  const double near = near_stop(model), at = fmin(x, (double)model->travel), p = balance(model, at, input);
  if (!(x > near))
    return 0;
  return x > (double)model->travel - near && opening_at(model, input, p, at) > 0 ? (double)input->supply_pressure : p;
}

/* Pressure at rest at a set position: what holds the stem there; none or the supply beyond the positioner's cut-offs.
 */
static double pressure_at_set(const pneu_model *model, const pneu_input *input)
{
  const double x = fmin(fmax((double)input->u, 0), 1) * (double)model->p.stroke;
  const double p = fmin(fmax(balance(model, x, input), 0), (double)input->supply_pressure);
  const double opening = opening_at(model, input, p, x);
  return opening == 0 ? p : opening < 0 ? 0 : (double)input->supply_pressure;
}

/* Pressure at a start that shows none: what the stem says; without a stem, the set position of one that is positioned,
 * else the supply while the transducer fills. */
static double unseen_pressure(const pneu_model *model, const pneu_input *input, double x)
{
  if (!isnan(x))
    return balanced_pressure(model, input, x);
  if (input->set_position && !(model->p.proportional_band > 0))
    return pressure_at_set(model, input);
  return input->u > 0 ? (double)input->supply_pressure : 0;
}

/* A stem seen near a stop, and pushed that way, stands on it. */
static double on_stop(const pneu_model *model, const pneu_input *input, double p, double x)
{
  const double travel = (double)model->travel, near = near_stop(model);
  if (x < near && p < balance(model, 0, input))
    return 0;
  if (x > travel - near && p > balance(model, travel, input))
    return travel;
  return fmin(fmax(x, 0), travel);
}

/* Whether a chamber is at ambient: it reads so within twice what the zero of an ordinary sensor is known to, its stem
 * is down and nothing fills it. */
static int is_vented(const pneu_model *model, const pneu_input *input, const struct seen *read)
{
  const double zero = 0.005 * (double)input->supply_pressure;
  return !model->law.pressure_input && fabs(read->p) < zero && !(read->x > near_stop(model)) && !(input->u > 0);
}

/* At rest at time t [s]. */
static int rest(const pneu_model *model, const pneu_input *input, const struct seen *seen, double t, pneu_state *state)
{
  double T = isnan(seen->T) ? (double)model->p.ambient_temperature : seen->T;
  double p = isnan(seen->p) ? unseen_pressure(model, input, seen->x) : seen->p;
  double x = isnan(seen->x) ? lab_balance_position(model, p, input) : on_stop(model, input, p, seen->x);
  int status = pneu_state_rest(model, (pneu_real)p, (pneu_real)T, (pneu_real)x, input, state);
  if (status == PNEU_OK && model->law.position_input && !isnan(seen->x))
    state->x = (pneu_real)fmin(fmax(seen->x, 0), (double)model->travel); /* as measured: its slopes start from there */
  if (status == PNEU_OK && model->clock >= 0)
    state->extra[model->clock] = (pneu_real)t;
  return status;
}

int lab_run_initial_state(const pneu_model *model, const pneu_input *input, const lab_log *log, size_t run,
                          pneu_state *state, lab_error *error)
{
  const int rounds = 3; /* a bias is gone after one, a gain of 10 % to 1e-3 after three */
  const struct seen read = {look(&model->law, log, LAB_CHANNEL_P, run, model->law.pressure_input),
                            look(&model->law, log, LAB_CHANNEL_X, run, model->law.position_input),
                            look(&model->law, log, LAB_CHANNEL_T, run, 0)};
  const int vented = is_vented(model, input, &read);
  struct seen seen = read;
  pneu_output out;
  int i;
  for (i = 0; i < rounds; i++) {
    seen.p = vented ? 0 : seen.p;
    if (rest(model, input, &seen, log->value[LAB_CHANNEL_TIME][log->run[run]], state) != PNEU_OK ||
        pneu_observe(model, state, input, &out) != PNEU_OK)
      return lab_fail(error, LAB_DATA, "%s:%d: the run begins with p = %g Pa gauge, x = %g m: no state of this rig",
                      log->path, log->line[log->run[run]], seen.p, seen.x);
    seen.p = read.p - (double)(out.shown_pressure - state->p);
    seen.x = read.x - (double)(out.shown_position - state->x);
  }
  return LAB_OK;
}

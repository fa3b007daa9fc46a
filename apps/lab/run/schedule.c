#include "schedule.h"

#include <math.h>
#include <stdlib.h>

int lab_positioner_check(const lab_rig *rig, const lab_log *log, lab_error *error)
{
  if (lab_log_command(log) != LAB_CHANNEL_SP || rig->laws.pressure_input || lab_rig_has_positioner(rig))
    return LAB_OK;
  return lab_fail(error, LAB_DATA,
                  "%s: a set position sp and no command u: expected a positioner in the rig file, such as positioner "
                  "= { gain = 20; }",
                  log->path);
}

/* Every channel that drives the model must be there; the command only where there is a mass balance. */
static int check_inputs(const lab_rig *rig, const lab_log *log, lab_error *error)
{
  int i;
  for (i = 0; i < LAB_CHANNEL_COUNT; i++) {
    if (!rig->input[i] || log->value[i] ||
        (i == LAB_CHANNEL_U && (rig->laws.pressure_input || lab_log_command(log) >= 0)))
      continue;
    return lab_fail(error, LAB_DATA,
                    "%s: expected a column %s, which drives the model; where it is constant give "
                    "log.constants in the rig file, and where a column has another name log.map%s%s%s",
                    log->path, lab_channels[i].key, *log->read_as ? " (" : "", log->read_as, *log->read_as ? ")" : "");
  }
  return LAB_OK;
}

/* The value of a channel, or what was before where it is absent or a gap. */
static double held(const lab_log *log, int channel, size_t i, double before)
{
  if (channel < 0 || !log->value[channel] || isnan(log->value[channel][i]))
    return before;
  return log->value[channel][i];
}

static double held_input(const lab_rig *rig, const lab_log *log, int channel, size_t i, double before)
{
  return rig->input[channel] ? held(log, channel, i, before) : before;
}

/* A position that drives the model and lies beyond a stop, as noise at rest does, counts as on the stop. */
static double driving(const lab_rig *rig, int channel, double value)
{
  return channel == LAB_CHANNEL_X ? fmin(fmax(value, 0), (double)rig->params.stroke) : value;
}

/* Slope of a channel from row i to its next value; what was before in a gap, 0 after the last value. */
static double slope(const lab_rig *rig, const lab_log *log, int channel, size_t i, size_t end, double before)
{
  const double *value = log->value[channel], *t = log->value[LAB_CHANNEL_TIME];
  size_t next = i + 1;
  if (!rig->input[channel])
    return 0;
  if (isnan(value[i]))
    return before;
  while (next < end && isnan(value[next]))
    next++;
  if (next == end)
    return 0;
  return (driving(rig, channel, value[next]) - driving(rig, channel, value[i])) / (t[next] - t[i]);
}

static int same(const pneu_input *a, const pneu_input *b)
{
  return a->u == b->u && a->supply_pressure == b->supply_pressure && a->force == b->force &&
         a->pressure_rate == b->pressure_rate && a->position_rate == b->position_rate;
}

/* ---- Ramps of the command ---- */

enum { RAMP_STEPS = 20 };                  /* of a ramp from one row to the next, at most */
static const double ramp_step = 5e-3;      /* of the command's range: what a step of a ramp is meant to be */
static const double ramp_like = 1.0 / 3.0; /* share of a change that the one before or after it has on a ramp */

/* The change of a channel from the row before; 0 where there is none. */
static double change_at(const double *value, size_t i, size_t first, size_t end)
{
  return i > first && i < end && !isnan(value[i]) && !isnan(value[i - 1]) ? value[i] - value[i - 1] : 0;
}

/* How many steps stand for the change of a command to row i: 1 if it jumps; more where it is a part of a ramp, which
 * goes on or comes from before at a like pace, and the rows are far apart for it.
 * In:      range  from the least to the largest command, or half of it */
static int steps_to(const double *command, size_t i, size_t first, size_t end, double range)
{
  const double here = change_at(command, i, first, end);
  const double before = change_at(command, i - 1, first, end), after = change_at(command, i + 1, first, end);
  const double like = ramp_like * fabs(here), steps = ceil(fabs(here) / (ramp_step * range));
  const int is_ramp = (before * here > 0 && fabs(before) >= like) || (after * here > 0 && fabs(after) >= like);
  return !is_ramp ? 1 : (int)fmin(fmax(steps, 1), RAMP_STEPS);
}

/* Whether a command is seen at the rows of a log: not the rows of a schedule, where it changes and nothing is measured,
 * and not what a positioner sends, which holds from row to row. */
static int is_sampled(const lab_log *log)
{
  const int command = lab_log_command(log);
  const int measured = log->value[LAB_CHANNEL_P] || log->value[LAB_CHANNEL_X] || log->value[LAB_CHANNEL_T];
  return command >= 0 && measured && (command == LAB_CHANNEL_SP || !log->value[LAB_CHANNEL_SP]);
}

/* Steps of equal size from the input before to a command, centred about the straight line. */
static void add_ramp(double t, double duration, pneu_real to, int steps, lab_inputs *inputs)
{
  const size_t n = inputs->schedule.n;
  const pneu_input from = inputs->input[n - 1];
  int k;
  for (k = 0; k < steps; k++) {
    inputs->t[n + (size_t)k] = t + duration * (k + 0.5) / steps;
    inputs->input[n + (size_t)k] = from;
    inputs->input[n + (size_t)k].u =
        k + 1 < steps ? from.u + (to - from.u) * (pneu_real)(k + 1) / (pneu_real)steps : to;
  }
  inputs->schedule.n += (size_t)steps;
}

static double range_of(const pneu_model *model)
{
  return model->p.proportional_band > 0 ? (double)model->p.supply_pressure : 1;
}

/* Entries of a schedule, at most. */
static size_t count_entries(const pneu_model *model, const lab_log *log, size_t first, size_t end)
{
  const int command = lab_log_command(log), sampled = is_sampled(log);
  size_t i, n = end - first;
  for (i = first + 1; sampled && i < end; i++)
    n += (size_t)steps_to(log->value[command], i, first, end, range_of(model));
  return n;
}

static void fill(const pneu_model *model, const lab_rig *rig, const lab_log *log, size_t first, size_t end,
                 lab_inputs *inputs)
{
  const int command = lab_log_command(log), sampled = is_sampled(log);
  const double *t = log->value[LAB_CHANNEL_TIME];
  pneu_input input;
  size_t i;
  pneu_input_default(model, &input);
  input.set_position = command == LAB_CHANNEL_SP;
  inputs->schedule.n = 0;
  for (i = first; i < end; i++) {
    const int steps = i > first && sampled ? steps_to(log->value[command], i, first, end, range_of(model)) : 1;
    input.u = (pneu_real)held(log, command, i, (double)input.u);
    input.supply_pressure = (pneu_real)held_input(rig, log, LAB_CHANNEL_PS, i, (double)input.supply_pressure);
    input.force = (pneu_real)held_input(rig, log, LAB_CHANNEL_FORCE, i, (double)input.force);
    input.pressure_rate = (pneu_real)slope(rig, log, LAB_CHANNEL_P, i, end, (double)input.pressure_rate);
    input.position_rate = (pneu_real)slope(rig, log, LAB_CHANNEL_X, i, end, (double)input.position_rate);
    if (steps > 1)
      add_ramp(t[i - 1], t[i] - t[i - 1], input.u, steps, inputs);
    if (inputs->schedule.n > 0 && same(&input, &inputs->input[inputs->schedule.n - 1]))
      continue;
    inputs->t[inputs->schedule.n] = t[i];
    inputs->input[inputs->schedule.n++] = input;
  }
  inputs->schedule.t = inputs->t;
  inputs->schedule.input = inputs->input;
}

int lab_inputs_from_log(const pneu_model *model, const lab_rig *rig, const lab_log *log, size_t run, lab_inputs *inputs,
                        lab_error *error)
{
  const size_t first = log->run[run], end = log->run[run + 1], room = count_entries(model, log, first, end);
  if (check_inputs(rig, log, error))
    return error->status;
  inputs->t = malloc(room * sizeof *inputs->t);
  inputs->input = malloc(room * sizeof *inputs->input);
  if (!inputs->t || !inputs->input) {
    lab_inputs_free(inputs);
    return lab_fail_memory(error, "a schedule");
  }
  fill(model, rig, log, first, end, inputs);
  return LAB_OK;
}

void lab_inputs_free(lab_inputs *inputs)
{
  free(inputs->t);
  free(inputs->input);
  inputs->t = NULL;
  inputs->input = NULL;
  inputs->schedule.n = 0;
}

#include "schedule.h"

#include <math.h>
#include <stdlib.h>

/* Every channel that drives the model must be there; the command only where there is a mass balance. */
static int check_inputs(const lab_rig *rig, const lab_log *log, lab_error *error)
{
  int i;
  if (lab_log_command(log) == LAB_CHANNEL_SP && !rig->laws.pressure_input && !lab_rig_has_positioner(rig))
    return lab_fail(error, LAB_DATA,
                    "%s: a set position sp and no command u: expected a positioner in the rig file, such as positioner "
                    "= { gain = 20; }",
                    log->path);
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

static void fill(const lab_rig *rig, const lab_log *log, size_t first, size_t end, pneu_input input, lab_inputs *inputs)
{
  const int command = lab_log_command(log);
  size_t i, n = 0;
  input.set_position = command == LAB_CHANNEL_SP;
  for (i = first; i < end; i++) {
    input.u = (pneu_real)held(log, command, i, (double)input.u);
    input.supply_pressure = (pneu_real)held_input(rig, log, LAB_CHANNEL_PS, i, (double)input.supply_pressure);
    input.force = (pneu_real)held_input(rig, log, LAB_CHANNEL_FORCE, i, (double)input.force);
    input.pressure_rate = (pneu_real)slope(rig, log, LAB_CHANNEL_P, i, end, (double)input.pressure_rate);
    input.position_rate = (pneu_real)slope(rig, log, LAB_CHANNEL_X, i, end, (double)input.position_rate);
    if (n > 0 && same(&input, &inputs->input[n - 1]))
      continue;
    inputs->t[n] = log->value[LAB_CHANNEL_TIME][i];
    inputs->input[n++] = input;
  }
  inputs->schedule.n = n;
  inputs->schedule.t = inputs->t;
  inputs->schedule.input = inputs->input;
}

int lab_inputs_from_log(const pneu_model *model, const lab_rig *rig, const lab_log *log, size_t run, lab_inputs *inputs,
                        lab_error *error)
{
  size_t first = log->run[run], end = log->run[run + 1];
  pneu_input input;
  if (check_inputs(rig, log, error))
    return error->status;
  inputs->t = malloc((end - first) * sizeof *inputs->t);
  inputs->input = malloc((end - first) * sizeof *inputs->input);
  if (!inputs->t || !inputs->input) {
    lab_inputs_free(inputs);
    return lab_fail_memory(error, "a schedule");
  }
  pneu_input_default(model, &input);
  fill(rig, log, first, end, input, inputs);
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

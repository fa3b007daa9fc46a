#include "schedule.h"

#include <math.h>
#include <stdlib.h>

#include "../base/noise.h"
#include "stairs.h"

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

/* Where a channel that drives the model turns after row i; NULL: it does not. */
static const lab_bend *bend_after(const lab_rig *rig, const lab_log *log, int channel, size_t i)
{
  const lab_bend *bend = rig->input[channel] && log->bend[channel] ? &log->bend[channel][i] : NULL;
  return bend && !isnan(bend->t) ? bend : NULL;
}

/* Slope of a channel from row i to where it turns or its next value; what was before in a gap, 0 after the last value.
 * In:      bend  NULL: it does not turn before */
static double slope(const lab_rig *rig, const lab_log *log, int channel, size_t i, size_t end, const lab_bend *bend,
                    double before)
{
  const double *value = log->value[channel], *t = log->value[LAB_CHANNEL_TIME];
  size_t next = i + 1;
  if (!rig->input[channel])
    return 0;
  if (isnan(value[i]))
    return before;
  while (next < end && isnan(value[next]))
    next++;
  if (bend)
    return (driving(rig, channel, bend->value) - driving(rig, channel, value[i])) / (bend->t - t[i]);
  if (next == end)
    return 0;
  return (driving(rig, channel, value[next]) - driving(rig, channel, value[i])) / (t[next] - t[i]);
}

/* Whether an input is what another has come to after a time. */
static int goes_on(const pneu_input *now, const pneu_input *before, double elapsed)
{
  return now->supply_pressure == before->supply_pressure && now->force == before->force &&
         now->pressure_rate == before->pressure_rate && now->position_rate == before->position_rate &&
         now->u_rate == before->u_rate && !lab_input_jumps(before, elapsed, now);
}

pneu_input lab_input_after(const pneu_input *before, double elapsed)
{
  pneu_input now = *before;
  now.u += now.u_rate * (pneu_real)elapsed;
  return now;
}

int lab_input_jumps(const pneu_input *before, double elapsed, const pneu_input *next)
{
  static const double rounding = 1e-9; /* of the command */
  const pneu_input end = lab_input_after(before, elapsed);
  return fabs((double)(next->u - end.u)) > rounding * fmax(fabs((double)next->u), fabs((double)before->u));
}

/* ---- Ramps of the command ---- */

static const double ramp_like = 1.0 / 3.0; /* share of a pace that the one before or after it has on a ramp */
static const double on_line = 1e-4;        /* of the command's range: how far a row may be from the line of a ramp */

/* Stairs that rounding makes of a slow ramp: rows of a step at most, and its size over the resolution and the range.
 * By judgement: controllers send steps of 0.1 % of the range. */
enum { LONGEST_STEP = 16 };
static const double one_rounding = 1.5, highest_step = 2.5e-4;

/* A stretch of rows in which the command holds, runs along a line, and holds again. */
typedef struct line {
  size_t from, to;
  double begin, end; /* [s] of what runs */
  double u, rate;    /* before it; [1/s] */
} line;

/* A command over time: rows first to end - 1 of a log. */
typedef struct course {
  const double *t, *u;
  size_t first, end;
  double off;  /* how far a value may be from a line */
  double step; /* the highest of stairs that rounding makes */
} course;

/* The pace of the command from the row before; 0 where it does not change. */
static double pace_at(const course *c, size_t i)
{
  const int known = i > c->first && i < c->end && !isnan(c->u[i]) && !isnan(c->u[i - 1]);
  return known ? (c->u[i] - c->u[i - 1]) / (c->t[i] - c->t[i - 1]) : 0;
}

/* The change of the command at row i if it is no larger than rounding makes it; 0: none is, or a larger one. */
static double small_change(const course *c, size_t i)
{
  const double change = i > c->first && i < c->end ? c->u[i] - c->u[i - 1] : 0;
  return fabs(change) < c->step ? change : 0;
}

/* Whether a command is on stairs of single roundings between row i and the next: the change at it or before it goes the
 * way of the one after. */
static int is_on_stairs(const course *c, size_t i)
{
  size_t last = i, next = i + 1;
  while (i - last < LONGEST_STEP && last > c->first && pace_at(c, last) == 0)
    last--;
  while (next - i < LONGEST_STEP && next < c->end && pace_at(c, next) == 0)
    next++;
  return small_change(c, last) * small_change(c, next) > 0;
}

/* Whether a command is on a ramp from the row before to row i, which goes on or comes from before at a like pace, or
 * does both; or which rounding makes stairs of. */
static int is_ramp(const course *c, size_t i)
{
  const double here = pace_at(c, i), before = pace_at(c, i - 1) / here, after = pace_at(c, i + 1) / here;
  if (here != 0 && (before >= ramp_like || after >= ramp_like || (before > 0 && after > 0)))
    return 1;
  return is_on_stairs(c, i) || (here != 0 && is_on_stairs(c, i - 1));
}

/* The longest line from a row on that misses none of the rows between by more than it may (Bristol 1990). */
static line line_from(const course *c, size_t i)
{
  line l = {i, i + 1, c->t[i], c->t[i], c->u[i], 0};
  double low = -HUGE_VAL, high = HUGE_VAL;
  size_t k;
  for (k = i + 1; is_ramp(c, k); k++) {
    const double dt = c->t[k] - c->t[i], slope = (c->u[k] - c->u[i]) / dt;
    if (slope < low || slope > high)
      break;
    if (pace_at(c, k) != 0) {
      l.to = k;
      l.end = c->t[k];
      l.rate = slope;
    }
    low = fmax(low, slope - c->off / dt);
    high = fmin(high, slope + c->off / dt);
  }
  return l;
}

/* Whether a line of one row is the end of a steeper one beside it. */
static int is_part_of(const line *l, const line *beside)
{
  return l->to == l->from + 1 && l->rate * beside->rate > 0 && fabs(l->rate) < fabs(beside->rate);
}

/* The same; where a ramp begins or ends between two rows, it does so where its line meets the level. */
static line corner_from(const course *c, size_t i, const line *before)
{
  line l = line_from(c, i), next;
  if (!(l.rate != 0) || l.to >= c->end)
    return l;
  next = line_from(c, l.to);
  if (pace_at(c, i) == 0 && is_part_of(&l, &next)) {
    l.begin = l.end - (c->u[l.to] - l.u) / next.rate;
    l.rate = next.rate;
  } else if (pace_at(c, l.to + 1) == 0 && is_part_of(&l, before)) {
    l.end = l.begin + (c->u[l.to] - l.u) / before->rate;
    l.rate = before->rate;
  }
  return l;
}

/* Whether a command is seen at the rows of a log, so that it may run between them: not the rows of a schedule, where it
 * changes and nothing is measured, and not what a positioner or a controller sends, which holds from row to row. */
static int is_sampled(const lab_log *log)
{
  const int command = lab_log_command(log);
  const int measured = log->value[LAB_CHANNEL_P] || log->value[LAB_CHANNEL_X] || log->value[LAB_CHANNEL_T];
  if (command == LAB_CHANNEL_SP && lab_holds_between_rows(log))
    return 0;
  return command >= 0 && measured && (command == LAB_CHANNEL_SP || !log->value[LAB_CHANNEL_SP]);
}

static course course_of(const pneu_model *model, const lab_log *log, size_t first, size_t end)
{
  const int command = lab_log_command(log);
  const double range = model->p.proportional_band > 0 ? (double)model->p.supply_pressure : 1;
  course c = {log->value[LAB_CHANNEL_TIME], NULL, first, end, on_line * range, 0};
  if (is_sampled(log))
    c.u = log->value[command];
  if (c.u)
    c.off = fmax(c.off, lab_resolution(c.u + first, end - first)); /* its ends are rounded too */
  c.step = fmin(one_rounding * c.off, highest_step * range);
  return c;
}

/* What drives the model from a time on, unless it only goes on. */
static void add_input(double t, const pneu_input *input, lab_inputs *to)
{
  size_t *n = &to->schedule.n;
  if (*n > 0 && goes_on(input, &to->input[*n - 1], t - to->t[*n - 1]))
    return;
  to->t[*n] = t;
  to->input[(*n)++] = *input;
}

/* Whether an input jumps away from what drives the model then. */
static int jumps(double t, const pneu_input *input, const lab_inputs *to)
{
  const size_t n = to->schedule.n;
  return n > 0 && lab_input_jumps(&to->input[n - 1], t - to->t[n - 1], input);
}

/* A command from row i to the next, along a line that may begin and end between them. One that jumps and runs at once
 * jumps somewhere in the row before, and holds until it runs. */
static void add_line(const course *c, const line *l, size_t i, pneu_input *input, lab_inputs *to)
{
  const double t[] = {c->t[i], l->begin, l->end};
  const double next = i + 1 < c->end ? c->t[i + 1] : c->t[i];
  int k;
  input->u = (pneu_real)l->u;
  input->u_rate = 0;
  if (i == l->from && jumps(t[0], input, to))
    add_input(t[0], input, to);
  for (k = 0; k < 3; k++)
    if (k == 0 || (t[k] > t[0] && t[k] < next)) {
      input->u = (pneu_real)(l->u + l->rate * (fmin(fmax(t[k], l->begin), l->end) - l->begin));
      input->u_rate = (pneu_real)(t[k] >= l->begin && t[k] < l->end ? l->rate : 0);
      add_input(t[k], input, to);
    }
}

/* From where p or x turns after row i to the next row; the one first that turns first.
 * In:      p, x  NULL: it does not */
static void add_bends(const lab_rig *rig, const lab_log *log, size_t i, const lab_bend *p, const lab_bend *x,
                      pneu_input *input, lab_inputs *to)
{
  int turn, of_p = p && (!x || p->t < x->t);
  for (turn = 0; turn < 2; turn++, of_p = !of_p) {
    const lab_bend *bend = of_p ? p : x;
    const int channel = of_p ? LAB_CHANNEL_P : LAB_CHANNEL_X;
    double rise;
    if (!bend)
      continue;
    rise = driving(rig, channel, log->value[channel][i + 1]) - driving(rig, channel, bend->value);
    *(of_p ? &input->pressure_rate : &input->position_rate) =
        (pneu_real)(rise / (log->value[LAB_CHANNEL_TIME][i + 1] - bend->t));
    add_input(bend->t, input, to);
  }
}

static void fill(const pneu_model *model, const lab_rig *rig, const lab_log *log, size_t first, size_t end,
                 lab_inputs *inputs)
{
  const int command = lab_log_command(log);
  const double *t = log->value[LAB_CHANNEL_TIME];
  const course c = course_of(model, log, first, end);
  line l = {first, first, 0, 0, 0, 0};
  pneu_input input;
  size_t i;
  pneu_input_default(model, &input);
  input.set_position = command == LAB_CHANNEL_SP;
  inputs->schedule.n = 0;
  for (i = first; i < end; i++) {
    const lab_bend *p, *x;
    if (c.u && i == l.to)
      l = corner_from(&c, i, &l);
    p = l.rate != 0 ? NULL : bend_after(rig, log, LAB_CHANNEL_P, i);
    x = l.rate != 0 ? NULL : bend_after(rig, log, LAB_CHANNEL_X, i);
    input.supply_pressure = (pneu_real)held_input(rig, log, LAB_CHANNEL_PS, i, (double)input.supply_pressure);
    input.force = (pneu_real)held_input(rig, log, LAB_CHANNEL_FORCE, i, (double)input.force);
    input.pressure_rate = (pneu_real)slope(rig, log, LAB_CHANNEL_P, i, end, p, (double)input.pressure_rate);
    input.position_rate = (pneu_real)slope(rig, log, LAB_CHANNEL_X, i, end, x, (double)input.position_rate);
    if (l.rate != 0)
      add_line(&c, &l, i, &input, inputs);
    else {
      input.u = (pneu_real)held(log, command, i, (double)input.u);
      input.u_rate = 0;
      add_input(t[i], &input, inputs);
      add_bends(rig, log, i, p, x, &input, inputs);
    }
  }
  inputs->schedule.t = inputs->t;
  inputs->schedule.input = inputs->input;
}

int lab_inputs_from_log(const pneu_model *model, const lab_rig *rig, const lab_log *log, size_t run, lab_inputs *inputs,
                        lab_error *error)
{
  const size_t first = log->run[run], end = log->run[run + 1], room = 4 * (end - first);
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

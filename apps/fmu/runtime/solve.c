/* Model exchange: the importer's solver and our events. Co-simulation: the library's stepper. */
#include <math.h>

#include "private.h"

static const char too_many[] = "the command has changed too often within the dead time";

/* ---- Model exchange ---- */

static int move(fmu_instance *i, int call, int phase)
{
  if (fmu_may(i, call))
    return FMU_ERROR;
  i->m.phase = phase;
  return FMU_OK;
}

int fmu_enter_event(fmu_instance *instance)
{
  return move(instance, FMU_CALL_ENTER_EVENT, FMU_EVENT);
}

int fmu_enter_continuous(fmu_instance *instance)
{
  return move(instance, FMU_CALL_ENTER_CONTINUOUS, FMU_CONTINUOUS);
}

int fmu_update(fmu_instance *instance, fmu_event *event)
{
  pneu_input input;
  pneu_state before;
  fmu_memory *m;
  int which;
  if (fmu_may(instance, FMU_CALL_UPDATE))
    return FMU_ERROR;
  m = &instance->m;
  before = m->state;
  which = fmu_fired(instance);
  if (m->delay.length > 0 && fmu_delay_jump(&m->delay, m->time, m->input[FMU_INPUT_U]) != PNEU_OK)
    return fmu_say(instance, FMU_ERROR, "%s", too_many);
  fmu_drive(instance, &input);
  if (which >= 0)
    pneu_switch(&instance->model, &input, which, &instance->m.state);
  else
    pneu_settle(&instance->model, &input, &instance->m.state);
  fmu_arm(instance);
  event->states_changed = instance->m.state.x != before.x || instance->m.state.v != before.v;
  event->next_time = instance->m.delay.length > 0 ? fmu_delay_stop(&instance->m.delay, instance->m.time) : HUGE_VAL;
  return FMU_OK;
}

/* Without its velocity a position that moves pumps no gas: the importer is told, once. */
static void see_position(fmu_instance *i)
{
  fmu_memory *m = &i->m;
  const double moved = fabs(m->state.x - m->x_seen);
  m->x_seen = m->state.x;
  if (!i->model.law.position_input || m->warned || m->input[FMU_INPUT_VELOCITY] != 0 ||
      moved <= 1e-6 * i->model.scale[2])
    return;
  m->warned = 1;
  fmu_say(i, FMU_WARNING, "position moves, velocity is 0: where it is not given too, the gas is not pumped");
}

/* An importer that has stepped over a crossing is called to it. */
int fmu_completed_step(fmu_instance *instance, int *enter_event)
{
  if (fmu_may(instance, FMU_CALL_COMPLETED_STEP))
    return FMU_ERROR;
  see_position(instance);
  if (instance->m.delay.length > 0 &&
      fmu_delay_follow(&instance->m.delay, instance->m.time, instance->m.input[FMU_INPUT_U]) != PNEU_OK)
    return fmu_say(instance, FMU_ERROR, "%s", too_many);
  *enter_event = fmu_fired(instance) >= 0 || fmu_delay_asks(&instance->m.delay, instance->m.time);
  return FMU_OK;
}

int fmu_set_time(fmu_instance *instance, double time)
{
  if (fmu_may(instance, FMU_CALL_SET_TIME))
    return FMU_ERROR;
  if (!(time * 0 == 0))
    return fmu_say(instance, FMU_ERROR, "time is not a number");
  fmu_pass_to(instance, time);
  fmu_impose(instance);
  return FMU_OK;
}

static int may_at(fmu_instance *i, int call, size_t n, int expected)
{
  if (fmu_may(i, call) || fmu_refresh(i))
    return FMU_ERROR;
  return n == (size_t)expected ? FMU_OK : fmu_say(i, FMU_ERROR, "expected %d entries", expected);
}

int fmu_set_states(fmu_instance *instance, const double *x, size_t n)
{
  size_t k;
  if (!instance || may_at(instance, FMU_CALL_SET_STATES, n, instance->shape.n))
    return FMU_ERROR;
  for (k = 0; k < n; k++) {
    const int kind = instance->shape.kind[k];
    pneu_real *at = fmu_state_at(&instance->model, &instance->m.state, kind);
    if (at && fmu_packed_at(&instance->model, instance->m.state.mode, kind) >= 0)
      *at = x[k]; /* what is frozen stays */
  }
  return FMU_OK;
}

int fmu_get_states(fmu_instance *instance, double *x, size_t n)
{
  size_t k;
  if (!instance || may_at(instance, FMU_CALL_GET_STATES, n, instance->shape.n))
    return FMU_ERROR;
  for (k = 0; k < n; k++) {
    const pneu_real *at = fmu_state_at(&instance->model, &instance->m.state, instance->shape.kind[k]);
    x[k] = at ? *at : 0;
  }
  return FMU_OK;
}

int fmu_get_nominals(fmu_instance *instance, double *x, size_t n)
{
  size_t k;
  if (!instance || may_at(instance, FMU_CALL_GET_STATES, n, instance->shape.n))
    return FMU_ERROR;
  for (k = 0; k < n; k++) {
    const int kind = instance->shape.kind[k];
    x[k] = kind < FMU_STATE_EFFECT ? instance->model.scale[kind] : 1; /* effects' are scaled to about 1 */
  }
  return FMU_OK;
}

int fmu_get_rates(fmu_instance *instance, double *dx, size_t n)
{
  if (!instance || may_at(instance, FMU_CALL_GET_STATES, n, instance->shape.n))
    return FMU_ERROR;
  return fmu_rates(instance, dx);
}

int fmu_get_indicators(fmu_instance *instance, double *z, size_t n)
{
  if (may_at(instance, FMU_CALL_GET_STATES, n, FMU_INDICATOR_COUNT))
    return FMU_ERROR;
  fmu_indicators(instance, z);
  return FMU_OK;
}

int fmu_count(fmu_instance *instance, size_t *states, size_t *indicators)
{
  if (fmu_may(instance, FMU_CALL_ANY))
    return FMU_ERROR;
  if (states)
    *states = (size_t)instance->shape.n;
  if (indicators)
    *indicators = FMU_INDICATOR_COUNT;
  return FMU_OK;
}

/* ---- Co-simulation ---- */

/* To `end`. What is no time but rounding is passed over: the stepper has a shortest step. */
static int run_to(fmu_instance *i, double end)
{
  fmu_memory *m = &i->m;
  const double length = end - m->time;
  pneu_options options;
  pneu_input input;
  int status = PNEU_OK;
  pneu_options_default(&options);
  options.tol = m->tol;
  fmu_drive(i, &input);
  if (m->delay.length > 0) {
    input.u = fmu_command(i, m->input[FMU_INPUT_U]);
    input.delay = &m->delay.line;
  }
  i->work.h = 0;
  if (length > 1e-12 * (1 + fabs(end)))
    status = pneu_run(&i->model, &m->state, &input, length, &options, NULL, &i->work);
  fmu_pass_to(i, end);
  m->delay.now = end;
  return status;
}

int fmu_step(fmu_instance *instance, double from, double length)
{
  fmu_memory *m, before;
  int status, k;
  if (fmu_may(instance, FMU_CALL_STEP))
    return FMU_ERROR;
  m = &instance->m;
  if (!(fabs(from - m->time) <= 1e-6 * (1 + fabs(m->time))) || !(length >= 0 && length * 0 == 0))
    return fmu_say(instance, FMU_ERROR, "a step of %g s from %g s: the time is %g s, and it runs forward", length, from,
                   m->time);
  if (from + length > m->stop_time + 1e-9 * (1 + fabs(m->stop_time)))
    return fmu_say(instance, FMU_ERROR, "a step beyond the stop time of %g s", m->stop_time);
  before = *m;
  for (k = 0; k < FMU_INPUT_COUNT; k++) /* what has not been set anew is as it was */
    m->set_at[k] = m->time;
  fmu_impose(instance);
  status = run_to(instance, from + length);
  if (status != PNEU_OK) {
    *m = before;
    return fmu_say(instance, FMU_DISCARD, "%s", status == PNEU_E_DELAY ? too_many : pneu_status_text(status));
  }
  fmu_arm(instance);
  return FMU_OK;
}

/* Variables by reference. */
#include <math.h>

#include "private.h"

static int is_in(unsigned reference, unsigned first, unsigned count)
{
  return reference >= first && reference < first + count;
}

static int unknown(fmu_instance *i, unsigned reference)
{
  return fmu_say(i, FMU_ERROR, "no such variable: reference %u", reference);
}

/* ---- Getting ---- */

static int get_output(const fmu_instance *i, int which, double *value)
{
  pneu_state state = i->m.state;
  pneu_input input;
  pneu_output o;
  fmu_within(i, &state);
  fmu_drive(i, &input);
  if (pneu_observe(&i->model, &state, &input, &o) != PNEU_OK)
    return FMU_DISCARD;
  {
    const double output[FMU_OUTPUT_COUNT] = {i->m.state.p,        o.temperature,          i->m.state.x,
                                             i->m.state.v,        o.mass_in - o.mass_out, o.shown_pressure,
                                             o.shown_temperature, o.shown_position,       o.holding_force};
    *value = output[which];
  }
  return FMU_OK;
}

/* Place among the FMU's states, -1 if it is none. */
static int state_of(const fmu_instance *i, unsigned reference, int kind)
{
  int k;
  for (k = 0; k < i->shape.n; k++)
    if (i->shape.kind[k] == kind &&
        (fmu_state_reference(kind) == reference || FMU_REF_RATE + (unsigned)kind == reference))
      return k;
  return -1;
}

static int get_state(fmu_instance *i, unsigned reference, double *value)
{
  const int kind = (int)(reference - FMU_REF_STATE);
  const pneu_real *at;
  if (state_of(i, reference, kind) < 0)
    return unknown(i, reference);
  at = fmu_state_at(&i->model, &i->m.state, kind);
  *value = at ? *at : 0;
  return FMU_OK;
}

static int get_rate(fmu_instance *i, unsigned reference, double *value)
{
  const int k = state_of(i, reference, (int)(reference - FMU_REF_RATE));
  double rate[PNEU_STATE_MAX];
  if (k < 0)
    return unknown(i, reference);
  if (fmu_rates(i, rate))
    return FMU_DISCARD;
  *value = rate[k];
  return FMU_OK;
}

int fmu_value(fmu_instance *i, unsigned r, double *value)
{
  fmu_memory *m = &i->m;
  double z[FMU_INDICATOR_COUNT];
  if (!fmu_has_variable(&fmu_model_data.law, r))
    return unknown(i, r);
  if (r == FMU_REF_TIME)
    *value = m->time;
  else if (is_in(r, FMU_REF_INPUT, FMU_INPUT_COUNT))
    *value = m->input[r - FMU_REF_INPUT];
  else if (is_in(r, FMU_REF_START, FMU_START_COUNT))
    *value = m->start[r - FMU_REF_START];
  else if (is_in(r, FMU_REF_PARAMETER, PNEU_PARAM_COUNT) &&
           fmu_has_parameter(&fmu_model_data, (int)(r - FMU_REF_PARAMETER)))
    *value = *pneu_param_at(&m->params, (int)(r - FMU_REF_PARAMETER));
  else if (is_in(r, FMU_REF_OUTPUT, FMU_OUTPUT_COUNT))
    return fmu_refresh(i) ? FMU_ERROR : get_output(i, (int)(r - FMU_REF_OUTPUT), value);
  else if (is_in(r, FMU_REF_STATE, FMU_REF_RATE - FMU_REF_STATE))
    return fmu_refresh(i) ? FMU_ERROR : get_state(i, r, value);
  else if (is_in(r, FMU_REF_RATE, FMU_REF_INDICATOR - FMU_REF_RATE))
    return fmu_refresh(i) ? FMU_ERROR : get_rate(i, r, value);
  else if (is_in(r, FMU_REF_INDICATOR, FMU_INDICATOR_COUNT)) {
    if (fmu_refresh(i))
      return FMU_ERROR;
    fmu_indicators(i, z);
    *value = z[r - FMU_REF_INDICATOR];
  } else
    return unknown(i, r);
  return FMU_OK;
}

int fmu_get_real(fmu_instance *instance, const unsigned *reference, size_t n, double *value)
{
  size_t k;
  int status = fmu_may(instance, FMU_CALL_GET);
  for (k = 0; k < n && status == FMU_OK; k++)
    status = fmu_value(instance, reference[k], &value[k]);
  return status;
}

int fmu_get_integer(fmu_instance *instance, const unsigned *reference, size_t n, int *value)
{
  size_t k;
  if (fmu_may(instance, FMU_CALL_GET) || fmu_refresh(instance))
    return FMU_ERROR;
  for (k = 0; k < n; k++)
    if (reference[k] == FMU_REF_MODE)
      value[k] = instance->m.state.mode;
    else if (reference[k] == FMU_REF_CHOKED && fmu_has_variable(&fmu_model_data.law, FMU_REF_CHOKED))
      value[k] = instance->m.choked;
    else
      return unknown(instance, reference[k]);
  return FMU_OK;
}

/* ---- Setting ---- */

static int set_input(fmu_instance *i, int which, double value)
{
  if (fmu_may(i, FMU_CALL_SET_INPUT))
    return FMU_ERROR;
  if ((which == FMU_INPUT_SUPPLY || which == FMU_INPUT_PRESSURE) && value <= -i->m.params.ambient_pressure)
    return fmu_say(i, FMU_ERROR, "a pressure must be above vacuum, found %g Pa gauge", value);
  i->m.input[which] = value;
  i->m.set_at[which] = i->m.time;
  if (!i->m.stale)
    fmu_impose(i);
  return FMU_OK;
}

static int set_start(fmu_instance *i, int which, double value)
{
  if (fmu_may(i, FMU_CALL_SET_PARAMETER))
    return FMU_ERROR;
  i->m.start[which] = value;
  return FMU_OK;
}

static int set_parameter(fmu_instance *i, int which, double value)
{
  pneu_param_info info;
  if (fmu_may(i, FMU_CALL_SET_PARAMETER))
    return FMU_ERROR;
  pneu_param_describe(which, &info);
  if (value < info.lower || value > info.upper)
    return fmu_say(i, FMU_ERROR, "%s must be within %g..%g %s, found %g", info.name, (double)info.lower,
                   (double)info.upper, info.unit, value);
  *pneu_param_at(&i->m.params, which) = value;
  return FMU_OK;
}

static int set_one(fmu_instance *i, unsigned r, double value)
{
  if (!(value * 0 == 0))
    return fmu_say(i, FMU_ERROR, "reference %u: not a number, or infinite", r);
  if (!fmu_has_variable(&fmu_model_data.law, r))
    return fmu_say(i, FMU_ERROR, "reference %u cannot be set", r);
  i->m.stale |= (i->m.phase & (FMU_INSTANTIATED | FMU_INITIALIZING)) != 0;
  if (is_in(r, FMU_REF_INPUT, FMU_INPUT_COUNT))
    return set_input(i, (int)(r - FMU_REF_INPUT), value);
  if (is_in(r, FMU_REF_START, FMU_START_COUNT))
    return set_start(i, (int)(r - FMU_REF_START), value);
  if (is_in(r, FMU_REF_PARAMETER, PNEU_PARAM_COUNT) && fmu_has_parameter(&fmu_model_data, (int)(r - FMU_REF_PARAMETER)))
    return set_parameter(i, (int)(r - FMU_REF_PARAMETER), value);
  return fmu_say(i, FMU_ERROR, "reference %u cannot be set", r);
}

int fmu_set_slopes(fmu_instance *instance, const unsigned *reference, size_t n, const int *order, const double *slope)
{
  static const int slope_of[FMU_INPUT_COUNT] = {
      [FMU_INPUT_PRESSURE] = FMU_INPUT_PRESSURE_RATE, [FMU_INPUT_POSITION] = FMU_INPUT_VELOCITY};
  int status = fmu_may(instance, FMU_CALL_SET_INPUT);
  size_t k;
  for (k = 0; k < n && status <= FMU_WARNING; k++) {
    const int is_input = is_in(reference[k], FMU_REF_INPUT, FMU_INPUT_COUNT);
    const unsigned rate = is_input ? (unsigned)slope_of[reference[k] - FMU_REF_INPUT] : 0;
    if (!is_input || order[k] != 1)
      return fmu_say(instance, FMU_ERROR, "reference %u, order %d: only inputs have slopes", reference[k], order[k]);
    if (rate)
      status = set_one(instance, FMU_REF_INPUT + rate, slope[k]) ? FMU_ERROR : status;
    else if (slope[k] != 0)
      status = fmu_say(instance, FMU_WARNING, "reference %u holds during a step", reference[k]);
  }
  return status;
}

int fmu_set_real(fmu_instance *instance, const unsigned *reference, size_t n, const double *value)
{
  size_t k;
  int status = fmu_may(instance, FMU_CALL_GET);
  for (k = 0; k < n && status == FMU_OK; k++)
    status = set_one(instance, reference[k], value[k]);
  return status;
}

#include "shape.h"

#include <stddef.h>

/* What depends on the inputs of the model: 1, it is there only where pressure or position is one; -1, only where not.
 */
static const struct {
  unsigned reference;
  signed char pressure, position;
} conditions[] = {
    {FMU_REF_INPUT + FMU_INPUT_U, -1, 0},
    {FMU_REF_INPUT + FMU_INPUT_SUPPLY, -1, 0},
    {FMU_REF_INPUT + FMU_INPUT_FORCE, 0, -1},
    {FMU_REF_INPUT + FMU_INPUT_PRESSURE, 1, 0},
    {FMU_REF_INPUT + FMU_INPUT_PRESSURE_RATE, 1, 0},
    {FMU_REF_INPUT + FMU_INPUT_POSITION, 0, 1},
    {FMU_REF_INPUT + FMU_INPUT_VELOCITY, 0, 1},
    {FMU_REF_START + FMU_START_PRESSURE, -1, 0},
    {FMU_REF_START + FMU_START_TEMPERATURE, -1, 0},
    {FMU_REF_START + FMU_START_POSITION, 0, -1},
    {FMU_REF_OUTPUT + FMU_OUTPUT_PRESSURE, -1, 0},
    {FMU_REF_OUTPUT + FMU_OUTPUT_POSITION, 0, -1},
    {FMU_REF_OUTPUT + FMU_OUTPUT_VELOCITY, 0, -1},
    {FMU_REF_OUTPUT + FMU_OUTPUT_MASS_FLOW, -1, 0},
    {FMU_REF_OUTPUT + FMU_OUTPUT_HOLDING_FORCE, 0, 1},
    {FMU_REF_CHOKED, -1, 0},
};

static const unsigned char state_counts[PNEU_EFFECT_COUNT + 1] = {
#define PNEU_EFFECT(name, n_param, n_state) n_state,
#include "../../../lib/effects.def"
#undef PNEU_EFFECT
    0};

static int first_state(int effect)
{
  int e, first = FMU_STATE_EFFECT;
  for (e = 0; e < effect; e++)
    first += state_counts[e];
  return first;
}

int fmu_state_effect(int kind)
{
  int e = 0;
  while (kind >= first_state(e + 1))
    e++;
  return e;
}

int fmu_state_number(int kind)
{
  const int effect = fmu_state_effect(kind);
  return state_counts[effect] > 1 ? 1 + kind - first_state(effect) : 0;
}

unsigned fmu_state_reference(int kind)
{
  return (unsigned)(kind < FMU_STATE_EFFECT ? FMU_REF_OUTPUT + kind : FMU_REF_STATE + kind);
}

/* Whether something that is there only where it is driven (1), or not driven (-1), is there. */
static int goes_with(int condition, int driven)
{
  return condition == 0 || (condition > 0) == (driven != 0);
}

int fmu_has_variable(const pneu_laws *law, unsigned reference)
{
  size_t i;
  for (i = 0; i < sizeof conditions / sizeof conditions[0]; i++)
    if (conditions[i].reference == reference)
      return goes_with(conditions[i].pressure, law->pressure_input) &&
             goes_with(conditions[i].position, law->position_input);
  return 1;
}

int fmu_command_kind(const pneu_params *params)
{
  return params->proportional_band > 0            ? FMU_COMMAND_PRESSURE
         : params->effect[PNEU_AT_positioner] > 0 ? FMU_COMMAND_POSITION
                                                  : FMU_COMMAND_OPENING;
}

int fmu_model(const fmu_data *data, const pneu_params *params, pneu_model *model, int *bad)
{
  const int status = pneu_model_init(model, params, &data->law, bad);
  return status == PNEU_OK ? pneu_model_terms(model, data->term, data->n_terms) : status;
}

/* Whether an effect is at work. */
static int is_active(const pneu_model *model, int effect)
{
  int i;
  for (i = 0; i < model->n_active; i++)
    if (model->active[i] == effect)
      return 1;
  return 0;
}

void fmu_shape_of(const pneu_model *model, fmu_shape *shape)
{
  int i, j, n = 0;
  if (!model->law.pressure_input)
    shape->kind[n++] = FMU_STATE_P;
  if (model->thermal)
    shape->kind[n++] = FMU_STATE_T;
  for (i = 0; i < model->n_active; i++)
    for (j = 0; j < model->states_of[model->active[i]]; j++)
      shape->kind[n++] = first_state(model->active[i]) + j;
  if (!model->law.position_input) {
    shape->kind[n++] = FMU_STATE_X;
    shape->kind[n++] = FMU_STATE_V;
  }
  shape->n = n;
}

static int has_kind(const fmu_shape *shape, int kind)
{
  int i;
  for (i = 0; i < shape->n; i++)
    if (shape->kind[i] == kind)
      return 1;
  return 0;
}

int fmu_fits(const fmu_shape *shape, const pneu_model *model)
{
  fmu_shape needed;
  int i;
  fmu_shape_of(model, &needed);
  for (i = 0; i < needed.n; i++)
    if (!has_kind(shape, needed.kind[i]))
      return 0;
  return 1;
}

/* Give the effect of parameter i its usual size. */
static void switch_on(pneu_params *params, int i)
{
  pneu_param_info info;
  int e = 0, first, count, k;
  for (first = pneu_effect_params(e, &count); i >= first + count; first = pneu_effect_params(e, &count))
    e++;
  for (k = first; k < first + count; k++) {
    pneu_param_describe(k, &info);
    *pneu_param_at(params, k) = info.value;
  }
}

int fmu_has_parameter(const fmu_data *data, int i)
{
  pneu_params params = data->params;
  pneu_model model, changed;
  fmu_shape shape;
  if (i < 0 || i >= PNEU_PARAM_COUNT || i == PNEU_PARAM_supply_pressure)
    return 0;
  if (i == pneu_effect_params(PNEU_EFFECT_channel_skew, NULL))
    return 0;
  if (i == PNEU_PARAM_proportional_band)
    return params.proportional_band > 0;
  if (i < PNEU_PARAM_BASE_COUNT)
    return 1;
  if (fmu_model(data, &params, &model, NULL) != PNEU_OK)
    return 0;
  fmu_shape_of(&model, &shape);
  switch_on(&params, i);
  return fmu_model(data, &params, &changed, NULL) == PNEU_OK && fmu_fits(&shape, &changed);
}

pneu_real *fmu_state_at(const pneu_model *model, pneu_state *state, int kind)
{
  pneu_real *const base[FMU_STATE_EFFECT] = {&state->p, &state->T, &state->x, &state->v};
  int effect;
  if (kind < FMU_STATE_EFFECT)
    return base[kind];
  effect = fmu_state_effect(kind);
  return is_active(model, effect) ? &state->extra[model->state_of[effect] + kind - first_state(effect)] : NULL;
}

int fmu_packed_at(const pneu_model *model, int mode, int kind)
{
  const int moves = pneu_dimension(model, mode) > model->n_gas;
  int effect;
  switch (kind) {
  case FMU_STATE_P:
    return 0;
  case FMU_STATE_T:
    return model->thermal ? 1 : -1;
  case FMU_STATE_X:
    return moves ? model->n_gas : -1;
  case FMU_STATE_V:
    return moves ? model->n_gas + 1 : -1;
  default:
    effect = fmu_state_effect(kind);
    return is_active(model, effect) ? 1 + model->thermal + model->state_of[effect] + kind - first_state(effect) : -1;
  }
}

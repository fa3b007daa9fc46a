#include "shape.h"

#include <stddef.h>

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

unsigned fmu_state_reference(int kind)
{
  return (unsigned)(kind < FMU_STATE_EFFECT ? FMU_REF_OUTPUT + kind : FMU_REF_STATE + kind);
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
  shape->kind[n++] = FMU_STATE_P;
  if (model->thermal)
    shape->kind[n++] = FMU_STATE_T;
  for (i = 0; i < model->n_active; i++)
    for (j = 0; j < state_counts[model->active[i]]; j++)
      shape->kind[n++] = first_state(model->active[i]) + j;
  shape->kind[n++] = FMU_STATE_X;
  shape->kind[n++] = FMU_STATE_V;
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

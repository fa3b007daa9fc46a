/* Check parameters once; precompute what follows from them. */
#include <string.h>

#include "internal.h"

static int out_of_bounds(pneu_real value, const pneu_param_info *info)
{
  return !(value >= info->lower && value <= info->upper);
}

/* Whether a parameter of effect e, apart from those that only give it form, is not neutral.  In: param  its first */
static int is_switched_on(int e, const pneu_real *param)
{
  const pneu_param_info *info = pneu_effect_at(e)->param;
  int i, count;
  pneu_effect_params(e, &count);
  for (i = 0; i < count; i++)
    if (!info[i].shape && param[i] != info[i].neutral)
      return 1;
  return 0;
}

/* Whether parameter i gives form to an effect that is neutral, and is 0: not named in an initialiser. */
static int is_left_out(const pneu_params *p, int i)
{
  const int e = pneu_effect_of(i);
  return e >= 0 && p->effect[i - PNEU_PARAM_BASE_COUNT] == 0 &&
         !is_switched_on(e, &p->effect[pneu_effect_params(e, NULL) - PNEU_PARAM_BASE_COUNT]);
}

/* Index of the first parameter outside its bounds, -1 if none. */
static int bad_param(pneu_params *p)
{
  int i;
  for (i = 0; i < PNEU_PARAM_COUNT; i++) {
    pneu_param_info info;
    pneu_param_describe(i, &info);
    if (out_of_bounds(*pneu_param_at(p, i), &info) && !(PNEU_EFFECT_COUNT > 0 && info.shape && is_left_out(p, i)))
      return i;
  }
  return -1;
}

/* Returns: enum pneu_action */
static int action_of(const pneu_model *model, int e)
{
  const pneu_effect *effect = pneu_effect_at(e);
  const pneu_real *param = &model->p.effect[model->param_of[e]];
  return effect->acts ? effect->acts(model, param) : is_switched_on(e, param) ? PNEU_ACTS : PNEU_RESTS;
}

static int state_count(int e)
{
  static const unsigned char counts[PNEU_EFFECT_COUNT + 1] = {
#define PNEU_EFFECT(name, n_param, n_state) n_state,
#include PNEU_EFFECTS_FILE
#undef PNEU_EFFECT
      0};
  return counts[e];
}

/* List the active effects by stage and give each its states. */
static void activate(pneu_model *model)
{
  int e, stage;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++)
    model->param_of[e] = (unsigned char)(pneu_effect_params(e, NULL) - PNEU_PARAM_BASE_COUNT);
  for (stage = 0; stage <= PNEU_STAGE_SENSOR; stage++)
    for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
      const int action = pneu_effect_at(e)->stage == stage ? action_of(model, e) : PNEU_RESTS;
      if (action == PNEU_RESTS)
        continue;
      model->active[model->n_active++] = (unsigned char)e;
      model->state_of[e] = (unsigned char)model->n_extra;
      model->states_of[e] = (unsigned char)(action == PNEU_ACTS ? state_count(e) : 0);
      model->n_extra += model->states_of[e];
      if (pneu_effect_at(e)->prepare)
        pneu_effect_at(e)->prepare(model, &model->p.effect[model->param_of[e]]);
      model->bristle |= stage == PNEU_STAGE_BRISTLE;
      model->thermal |= stage == PNEU_STAGE_HEAT;
    }
}

/* Constants of the gas and of the flow laws. */
static void derive_flow(pneu_model *model)
{
  const pneu_real gamma = model->p.heat_ratio, R = model->p.gas_constant;
  model->critical_ratio = PNEU_M(pow)(2 / (gamma + 1), gamma / (gamma - 1));
  model->paper_gain = PNEU_M(sqrt)(2 / R);
  model->nozzle_gain = PNEU_M(sqrt)(2 * gamma / ((gamma - 1) * R));
  pneu_nozzle_prepare(model);
  model->choked_gain = PNEU_M(sqrt)(gamma / R) * PNEU_M(pow)(2 / (gamma + 1), (gamma + 1) / (2 * (gamma - 1)));
}

/* The chamber law: which exponent, and whether the gas has a temperature of its own. A film turns the isothermal and
 * the polytropic chamber into an energy balance (effects/heat_transfer.c), an exponent the isothermal one into a
 * polytropic one. */
static void derive_gas(pneu_model *model)
{
  const int law = model->law.gas, heated = model->thermal;
  model->thermal = law != PNEU_GAS_ISOTHERMAL || heated || model->exponent_rise > 0;
  model->g = law == PNEU_GAS_POLYTROPIC && !heated ? model->p.polytropic_index : model->p.heat_ratio;
  if (model->exponent_rise > 0 && !heated)
    model->g = 1 + model->exponent_rise;
  if (model->law.pressure_input)
    model->thermal = 0;
  model->n_gas = 1 + model->thermal + model->n_extra;
}

static void derive_scales(pneu_model *model)
{
  const pneu_params *p = &model->p;
  const pneu_real on_stop = model->stop_compliance > 0 ? PNEU_ON_STOP * p->stroke / model->stop_compliance : 0;
  const pneu_real largest = (p->supply_pressure + p->ambient_pressure) * p->area + on_stop +
                            p->spring_rate * (PNEU_M(fabs)(p->spring_preload) + p->stroke) +
                            PNEU_M(fabs)(p->external_force); /* [N] */
  model->force_noise = PNEU_FORCE_NOISE * largest;
  model->force_resolved = PNEU_FORCE_RESOLVED * largest;
  model->scale[0] = model->p.supply_pressure + model->p.ambient_pressure;
  model->scale[1] = model->p.ambient_temperature;
  model->scale[2] = model->p.stroke > 0 ? model->p.stroke : 1;
  model->scale[3] = model->scale[2] * 100; /* velocity settles in about 10 ms */
  model->velocity_resolved = model->bristle ? PNEU_VELOCITY_RESOLVED * model->scale[3] : 0;
}

static int bad_law(const pneu_laws *law)
{
  return law->gas < 0 || law->gas >= PNEU_GAS_COUNT || law->flow < 0 || law->flow >= PNEU_FLOW_COUNT;
}

int pneu_model_init(pneu_model *model, const pneu_params *p, const pneu_laws *law, int *bad)
{
  int at;
  memset(model, 0, sizeof *model);
  model->p = *p;
  model->law = *law;
  model->clock = model->supply_line = -1;
  at = bad_param(&model->p);
  if (bad)
    *bad = at;
  if (at >= 0)
    return PNEU_E_PARAM;
  if (bad_law(law))
    return PNEU_E_LAW;
  model->viscous = p->viscous_friction + p->damping;
  model->upper_stop = model->travel = p->stroke;
  activate(model);
  derive_flow(model);
  derive_gas(model);
  derive_scales(model);
  return PNEU_OK;
}

void pneu_input_default(const pneu_model *model, pneu_input *input)
{
  memset(input, 0, sizeof *input);
  input->supply_pressure = model->p.supply_pressure;
}

void pneu_options_default(pneu_options *options)
{
#ifdef PNEU_SINGLE
  options->tol = PNEU_C(1e-4);
#else
  options->tol = 1e-6;
#endif
  options->h_max = 0;
  options->max_steps = 100000;
}

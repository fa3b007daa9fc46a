/* From a state to what can be measured, and states at rest. */
#include <string.h>

#include "internal.h"

int pneu_observe(const pneu_model *model, const pneu_state *state, const pneu_input *input, pneu_output *out)
{
  pneu_terms t;
  pneu_real y[PNEU_STATE_MAX];
  int status;
  pneu_pack(model, state, y);
  status = pneu_evaluate(model, state, input, y, &t, NULL);
  if (status != PNEU_OK)
    return status;
  out->pressure = t.p - model->p.ambient_pressure;
  out->temperature = t.T;
  out->mass = t.p * t.volume / (model->p.gas_constant * t.T);
  out->position = t.x;
  out->velocity = t.v;
  out->opening = t.opening;
  out->mass_in = t.mass_in;
  out->mass_out = t.mass_out;
  out->heat = t.heat;
  out->supply = t.supply - t.supply_resistance * t.mass_in - model->p.ambient_pressure;
  out->friction = t.friction;
  out->choked = t.choked;
  out->shown_pressure = t.p_shown;
  out->shown_temperature = t.T_shown;
  out->shown_position = t.x_shown;
  return PNEU_OK;
}

static void start_effects(const pneu_model *model, const pneu_input *input, pneu_state *state)
{
  pneu_terms t;
  pneu_real y[PNEU_STATE_MAX];
  int i;
  pneu_pack(model, state, y);
  if (pneu_evaluate(model, state, input, y, &t, NULL) != PNEU_OK)
    return;
  t.opening = input->u;
  for (i = 0; i < model->n_active; i++) {
    const int e = model->active[i];
    const pneu_effect *effect = pneu_effect_at(e);
    if (effect->start)
      effect->start(&model->p.effect[model->param_of[e]], &t, &state->extra[model->state_of[e]]);
  }
}

int pneu_state_rest(const pneu_model *model, pneu_real pressure, pneu_real temperature, pneu_real position,
                    const pneu_input *input, pneu_state *state)
{
  const pneu_real p_abs = pressure + model->p.ambient_pressure;
  const pneu_real T = model->thermal ? temperature : model->p.ambient_temperature;
  if (!(p_abs > 0) || !(T > 0) || !(position >= 0 && position <= model->upper_stop) || p_abs * T > PNEU_C(1e30))
    return PNEU_E_NONFINITE;
  memset(state, 0, sizeof *state);
  state->p = pressure;
  state->T = T;
  state->x = position;
  state->mode = PNEU_MODE_STUCK;
  start_effects(model, input, state);
  pneu_settle(model, input, state);
  return PNEU_OK;
}

void pneu_scales(const pneu_model *model, pneu_real *scale)
{
  int i, n = 0;
  scale[n++] = model->scale[0];
  if (model->thermal)
    scale[n++] = model->scale[1];
  for (i = 0; i < model->n_extra; i++)
    scale[n++] = 1; /* states of effects are scaled to about 1 */
  scale[n++] = model->scale[2];
  scale[n] = model->scale[3];
}

/* From a state to what can be measured, and states at rest. */
#include <string.h>

#include "internal.h"
#include "stem.h"

int pneu_observe(const pneu_model *model, const pneu_state *state, const pneu_input *input, pneu_output *out)
{
  pneu_terms t;
  pneu_real y[PNEU_STATE_MAX];
  int status;
  pneu_pack(model, state, y);
  status = pneu_evaluate(model, state, input, y, PNEU_EXTENT_FLOWS, &t, NULL);
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
  out->supply = t.supply - model->p.ambient_pressure;
  if (PNEU_EFFECT_COUNT > 0)
    out->supply -= t.supply_line.lost;
  out->friction = t.friction;
  out->holding_force = pneu_stem_holding(&t);
  out->choked = t.choked;
  out->shown_pressure = t.p_shown;
  out->shown_temperature = t.T_shown;
  out->shown_position = t.x_shown;
  return PNEU_OK;
}

/* Whether an effect or a free term stands between the state and what is shown, or a force is shown. */
static int has_sensors(const pneu_model *model)
{
  return model->n_terms > 0 || model->law.position_input ||
         (model->n_active > 0 && pneu_effect_at(model->active[model->n_active - 1])->stage >= PNEU_STAGE_LAG);
}

/* As pneu_evaluate judges a state; no effect adds to the volume but by the model's constants. */
int pneu_is_physical(const pneu_model *model, const pneu_state *state)
{
  return state->p + model->p.ambient_pressure > 0 && (!model->thermal || state->T > 0) &&
         (model->law.pressure_input || pneu_volume(model, state->x) > 0);
}

/* Whether what is shown hangs on no more than the state and the sensors. */
static int is_of_sensors(const pneu_model *model)
{
  int i, all = !model->law.position_input;
  for (i = 0; i < model->n_terms; i++)
    all &= model->term[i].equation < PNEU_TERM_SHOWN_PRESSURE;
  return all;
}

/* What stands before the sensors asks for no flow. */
static int show_by_sensors(const pneu_model *model, const pneu_state *state, const pneu_input *input, pneu_shown *shown)
{
  pneu_terms t;
  pneu_real y[PNEU_STATE_MAX];
  pneu_pack(model, state, y);
  if (is_of_sensors(model) && pneu_is_physical(model, state))
    pneu_evaluate_sensors(model, state, input, y, &t);
  else if (pneu_evaluate(model, state, input, y, PNEU_EXTENT_FORCES, &t, NULL) != PNEU_OK)
    return PNEU_RETRY_STATE;
  shown->pressure = t.p_shown;
  shown->temperature = t.T_shown;
  shown->position = t.x_shown;
  shown->force = model->law.position_input ? pneu_stem_holding(&t) : 0;
  return PNEU_OK;
}

int pneu_show(const pneu_model *model, const pneu_state *state, const pneu_input *input, pneu_shown *shown)
{
  if (has_sensors(model))
    return show_by_sensors(model, state, input, shown);
  if (!pneu_is_physical(model, state))
    return PNEU_RETRY_STATE;
  shown->pressure = state->p;
  shown->temperature = model->thermal ? state->T : model->p.ambient_temperature;
  shown->position = state->x;
  shown->force = 0;
  return PNEU_OK;
}

void pneu_start_effects(const pneu_model *model, const pneu_input *input, pneu_state *state)
{
  enum { ROUNDS = 2 }; /* a lag of the transducer follows what the positioner asks for, by its own state */
  pneu_terms t;
  pneu_real y[PNEU_STATE_MAX];
  int i, round;
  for (round = 0; round < ROUNDS; round++) {
    pneu_pack(model, state, y);
    (void)pneu_evaluate(model, state, input, y, PNEU_EXTENT_FLOWS, &t,
                        NULL); /* pneu_state_rest has looked at what may fail */
    t.opening = t.asked;
    for (i = 0; i < model->n_active; i++) {
      const int e = model->active[i];
      const pneu_effect *effect = pneu_effect_at(e);
      if (effect->start)
        effect->start(&model->p.effect[model->param_of[e]], &t, &state->extra[model->state_of[e]]);
    }
  }
}

/* A stem that touches a stop which yields sinks in until the forces balance, friction apart: Newton with the slopes
 * of main spring and stop; the other forces hardly change over so short a way. */
static void sink_in(const pneu_model *model, const pneu_input *input, pneu_state *state)
{
  enum { ROUNDS = 4 };
  const int lower = state->x <= 0, upper = state->x >= model->travel;
  const pneu_real rate = model->p.spring_rate + 1 / model->stop_compliance;
  pneu_terms t;
  pneu_real y[PNEU_STATE_MAX];
  int i;
  for (i = 0; i < ROUNDS && (lower || upper); i++) {
    pneu_start_effects(model, input, state); /* at rest, what creeps has followed */
    pneu_pack(model, state, y);
    (void)pneu_evaluate(model, state, input, y, PNEU_EXTENT_FORCES, &t, NULL);
    if (i == 0 && (lower ? t.force >= 0 : t.force <= 0))
      return;
    state->x = PNEU_M(fmin)(PNEU_M(fmax)(state->x + t.force / rate, model->lower_stop), model->upper_stop);
  }
}

int pneu_state_rest(const pneu_model *model, pneu_real pressure, pneu_real temperature, pneu_real position,
                    const pneu_input *input, pneu_state *state)
{
  const pneu_real p_abs = pressure + model->p.ambient_pressure;
  const pneu_real T = model->thermal ? temperature + model->start_excess : model->p.ambient_temperature;
  if (!(p_abs > 0) || !(T > 0) || !(position >= 0 && position <= model->p.stroke) || p_abs * T > PNEU_C(1e30))
    return PNEU_E_NONFINITE;
  memset(state, 0, sizeof *state);
  state->p = pressure;
  state->T = T;
  state->x = position < model->travel ? position : model->travel;
  state->mode = PNEU_MODE_STUCK;
  if (model->stop_compliance > 0 && !model->law.position_input)
    sink_in(model, input, state);
  pneu_start_effects(model, input, state);
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

#include "handover.h"

/* The place of an effect's states, -1 where it is off. */
static int place_of(const pneu_model *model, int effect)
{
  int i;
  for (i = 0; i < model->n_active; i++)
    if (model->active[i] == effect)
      return model->state_of[effect];
  return -1;
}

/* Lags of the opening that were not there begin where it is: at rest a positioner would ask for something else. */
static void begin_lags(const pneu_model *from, const pneu_model *to, const pneu_input *input, const pneu_state *before,
                       pneu_state *next)
{
  enum { COUNT = 2 };
  static const char *const lags[COUNT] = {"dead_time", "transducer_lag"};
  pneu_state at = *before;
  pneu_output now;
  int k, i;
  pneu_settle(from, input, &at);
  if (pneu_observe(from, &at, input, &now) != PNEU_OK)
    return;
  for (k = 0; k < COUNT; k++) {
    const int effect = pneu_effect_find(lags[k]);
    if (effect >= 0 && place_of(from, effect) < 0 && place_of(to, effect) >= 0)
      for (i = 0; i < to->states_of[effect]; i++)
        next->extra[to->state_of[effect] + i] = now.opening;
  }
}

int lab_hand_over(const pneu_model *from, const pneu_model *to, const pneu_input *input, pneu_state *state)
{
  const pneu_real x = state->x < 0 ? 0 : state->x > to->p.stroke ? to->p.stroke : state->x;
  pneu_state next;
  int effect, i, status = pneu_state_rest(to, state->p, state->T, x, input, &next);
  if (status != PNEU_OK)
    return status;
  next.T = to->thermal ? state->T : next.T;
  for (effect = 0; effect < PNEU_EFFECT_COUNT; effect++) {
    const int before = place_of(from, effect), after = place_of(to, effect);
    for (i = 0; before >= 0 && after >= 0 && i < to->states_of[effect]; i++)
      next.extra[after + i] = state->extra[before + i];
  }
  begin_lags(from, to, input, state, &next);
  if (from->clock >= 0 && to->clock >= 0)
    next.extra[to->clock] = state->extra[from->clock];
  if (state->v != 0 && state->x > to->lower_stop && state->x < to->upper_stop) {
    next.v = state->v;
    next.mode = state->v > 0 ? PNEU_MODE_UP : PNEU_MODE_DOWN;
  }
  *state = next;
  return PNEU_OK;
}

int lab_states_agree(const pneu_model *a, const pneu_model *b)
{
  int effect, same = a->thermal == b->thermal && a->bristle == b->bristle && a->n_extra == b->n_extra &&
                     a->clock == b->clock && (a->stop_compliance > 0) == (b->stop_compliance > 0);
  for (effect = 0; same && effect < PNEU_EFFECT_COUNT; effect++)
    same = a->states_of[effect] == b->states_of[effect] &&
           (a->states_of[effect] == 0 || place_of(a, effect) == place_of(b, effect));
  return same;
}

/* Modes of the stem: what ends each, and what follows. */
#include "internal.h"

/* Force that friction has to hold at rest, and the level at which it gives way: above the rounding of the balance, lest
 * a stem that comes to rest in equilibrium chatter. With a bristle the friction force is a state and no level is left.
 */
static void rest_balance(const pneu_terms *t, pneu_real *force, pneu_real *level)
{
  *force = t->force - t->bristle_force;
  *level = (t->model->bristle ? 0 : t->friction) + t->model->force_noise;
}

/* ---- The dead band of a positioner ---- */

static int has_side(const pneu_state *state)
{
  return pneu_has_positioner() && state->side != PNEU_SIDE_UNTOLD;
}

/* By how much [m] a stem at x is off its side. */
static pneu_real off_side(const pneu_model *model, int side, const pneu_input *input, pneu_real x)
{
  const pneu_real error = pneu_loop_error(model, input->u, x);
  const pneu_real over = side == PNEU_SIDE_BELOW   ? model->dead_band - error
                         : side == PNEU_SIDE_ABOVE ? model->dead_band + error
                                                   : PNEU_M(fabs)(error) - model->dead_band;
  return over * model->p.stroke / (1 + model->feedback_span);
}

/* The side on which the stem is; within rounding of an edge, the one on which it was. */
static void find_side(const pneu_model *model, const pneu_input *input, pneu_state *state)
{
  const pneu_real rounding = PNEU_ON_EDGE * model->p.stroke;
  if (!pneu_is_in_loop(model, input) || !(model->dead_band > 0) || input->u_rate != 0 || model->law.pressure_input)
    state->side = PNEU_SIDE_UNTOLD;
  else if (state->side == PNEU_SIDE_UNTOLD || off_side(model, state->side, input, state->x) > rounding)
    state->side = off_side(model, PNEU_SIDE_BELOW, input, state->x) < 0   ? PNEU_SIDE_BELOW
                  : off_side(model, PNEU_SIDE_ABOVE, input, state->x) < 0 ? PNEU_SIDE_ABOVE
                                                                          : PNEU_SIDE_WITHIN;
}

/* To the other side of an edge. */
static void pass_edge(const pneu_model *model, const pneu_input *input, pneu_state *state)
{
  if (state->side != PNEU_SIDE_WITHIN)
    state->side = PNEU_SIDE_WITHIN;
  else
    state->side = pneu_loop_error(model, input->u, state->x) > 0 ? PNEU_SIDE_BELOW : PNEU_SIDE_ABOVE;
}

/* ---- Events ---- */

/* Those of the stem.  Returns: their number */
static int stem_events(const pneu_model *model, const pneu_state *state, const pneu_input *input, const pneu_real *y,
                       pneu_real *g)
{
  pneu_terms t;
  pneu_real force, level;
  const int i_x = model->n_gas, i_v = model->n_gas + 1;
  switch (state->mode) {
  case PNEU_MODE_UP:
    g[0] = -y[i_v] - model->velocity_resolved;
    g[1] = y[i_x] - model->upper_stop;
    return 2;
  case PNEU_MODE_DOWN:
    g[0] = y[i_v] - model->velocity_resolved;
    g[1] = model->lower_stop - y[i_x];
    return 2;
  case PNEU_MODE_DRIVEN:
  case PNEU_MODE_FIXED:
    return 0;
  default:
    break;
  }
  if (pneu_evaluate(model, state, input, y, PNEU_EXTENT_FORCES, &t, NULL) != PNEU_OK)
    return 0;
  rest_balance(&t, &force, &level);
  g[0] = state->mode == PNEU_MODE_UPPER ? -force - level : force - level;
  g[1] = -force - level;
  return state->mode == PNEU_MODE_STUCK ? 2 : 1;
}

int pneu_events(const pneu_model *model, const pneu_state *state, const pneu_input *input, const pneu_real *y,
                pneu_real *g)
{
  const int i_x = model->n_gas;
  int n = stem_events(model, state, input, y, g);
  if (!has_side(state))
    return n;
  while (n < PNEU_EVENT_EDGE)
    g[n++] = -1;
  g[n] = off_side(model, state->side, input, pneu_dimension(model, state->mode) > i_x ? y[i_x] : state->x);
  return n + 1;
}

/* Mode of a stem with v = 0. */
static int rest_mode(const pneu_model *model, pneu_real x, pneu_real force, pneu_real level)
{
  const int up = force > level, down = force < -level;
  if (x <= model->lower_stop)
    return up ? PNEU_MODE_UP : PNEU_MODE_LOWER;
  if (x >= model->upper_stop)
    return down ? PNEU_MODE_DOWN : PNEU_MODE_UPPER;
  if (model->bristle)
    return force < 0 ? PNEU_MODE_DOWN : PNEU_MODE_UP;
  return up ? PNEU_MODE_UP : down ? PNEU_MODE_DOWN : PNEU_MODE_STUCK;
}

static void settle(const pneu_model *model, const pneu_input *input, pneu_state *state)
{
  pneu_terms t;
  pneu_real y[PNEU_STATE_MAX], force, level;
  if (model->law.position_input || model->p.stroke <= 0) {
    state->mode = model->law.position_input ? PNEU_MODE_DRIVEN : PNEU_MODE_FIXED;
    state->v = model->law.position_input ? input->position_rate : 0;
    return;
  }
  if (state->v != 0) {
    const int up = state->v > 0;
    if (up ? state->x < model->upper_stop : state->x > model->lower_stop) {
      state->mode = up ? PNEU_MODE_UP : PNEU_MODE_DOWN;
      return;
    }
    state->v = 0; /* it has hit the stop */
  }
  state->mode = PNEU_MODE_STUCK;
  pneu_pack(model, state, y);
  if (pneu_evaluate(model, state, input, y, PNEU_EXTENT_FORCES, &t, NULL) != PNEU_OK)
    return;
  rest_balance(&t, &force, &level);
  state->mode = rest_mode(model, state->x, force, level);
}

void pneu_settle(const pneu_model *model, const pneu_input *input, pneu_state *state)
{
  find_side(model, input, state);
  settle(model, input, state);
}

/* Sliding has ended between the stops: go the other way, or the same way if there is a resolvable push, or stay. */
static void come_to_rest(const pneu_model *model, const pneu_input *input, pneu_state *state)
{
  const int before = state->mode;
  pneu_real y[PNEU_STATE_MAX], g[PNEU_EVENT_MAX];
  settle(model, input, state);
  if (state->mode != before)
    return;
  state->mode = PNEU_MODE_STUCK;
  pneu_pack(model, state, y);
  if (stem_events(model, state, input, y, g) > 0 && g[before == PNEU_MODE_UP ? 0 : 1] > model->force_resolved)
    state->mode = before;
}

static void switch_mode(const pneu_model *model, const pneu_input *input, int which, pneu_state *state)
{
  const int mode = state->mode;
  if (mode == PNEU_MODE_LOWER || mode == PNEU_MODE_STUCK || mode == PNEU_MODE_UPPER) {
    const int up = which == 0 && mode != PNEU_MODE_UPPER;
    state->mode = up ? PNEU_MODE_UP : PNEU_MODE_DOWN;
    return;
  }
  if (which == 0 && model->bristle) { /* the bristles turn it round */
    state->mode = mode == PNEU_MODE_UP ? PNEU_MODE_DOWN : PNEU_MODE_UP;
    return;
  }
  state->v = 0;
  if (which == 1) { /* a stop */
    state->x = mode == PNEU_MODE_UP ? model->upper_stop : model->lower_stop;
    settle(model, input, state);
  } else
    come_to_rest(model, input, state);
}

void pneu_switch(const pneu_model *model, const pneu_input *input, int which, pneu_state *state)
{
  if (has_side(state) && which == PNEU_EVENT_EDGE)
    pass_edge(model, input, state);
  else
    switch_mode(model, input, which, state);
  find_side(model, input, state);
}

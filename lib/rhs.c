/* From a packed state to its time derivative: every term is added once, in the order of the stages. */
#include "internal.h"
#include "chamber.h"
#include "stem.h"
#include "transducer.h"

int pneu_dimension(const pneu_model *model, int mode)
{
  static const unsigned char stem_entries[PNEU_MODE_COUNT] = {0, 0, 2, 2, 0, 1, 0};
  return model->n_gas + stem_entries[mode];
}

int pneu_pack(const pneu_model *model, const pneu_state *state, pneu_real *y)
{
  const int n = pneu_dimension(model, state->mode);
  int i, at = 0;
  y[at++] = state->p;
  if (model->thermal)
    y[at++] = state->T;
  for (i = 0; i < model->n_extra; i++)
    y[at++] = state->extra[i];
  if (n > at)
    y[at] = state->x;
  if (n > at + 1)
    y[at + 1] = state->v;
  return n;
}

void pneu_unpack(const pneu_model *model, const pneu_real *y, pneu_state *state)
{
  const int n = pneu_dimension(model, state->mode);
  int i, at = 0;
  state->p = y[at++];
  if (model->thermal)
    state->T = y[at++];
  for (i = 0; i < model->n_extra; i++)
    state->extra[i] = y[at++];
  if (n > at)
    state->x = y[at];
  if (n > at + 1)
    state->v = y[at + 1];
}

/* Direction of motion: that of the mode while the stem slides, so that it does not change within a step. */
static pneu_real sense_of(int mode, pneu_real v)
{
  const int up = mode == PNEU_MODE_UP || (mode != PNEU_MODE_DOWN && v > 0);
  return up ? PNEU_C(1.0) : mode == PNEU_MODE_DOWN || v < 0 ? PNEU_C(-1.0) : PNEU_C(0.0);
}

static void begin(const pneu_model *model, const pneu_state *state, const pneu_input *input, const pneu_real *y,
                  pneu_terms *t)
{
  const int i_x = model->n_gas, n = pneu_dimension(model, state->mode);
  const pneu_params *p = &model->p;
  t->model = model;
  t->input = input;
  t->p = y[0] + p->ambient_pressure;
  t->T = model->thermal ? y[1] : p->ambient_temperature;
  t->x = n > i_x ? y[i_x] : state->x;
  t->v = n > i_x + 1 ? y[i_x + 1] : state->mode == PNEU_MODE_DRIVEN ? input->position_rate : 0;
  t->sense = sense_of(state->mode, t->v);
  t->side = state->side;
  t->time = model->clock >= 0 ? y[1 + model->thermal + model->clock] : 0;
  t->area = p->area * (1 - model->area_slope * t->x);
  t->swept_area = t->area * p->swept_ratio;
  t->volume = pneu_volume(model, t->x);
  t->supply = input->supply_pressure + p->ambient_pressure;
  t->exhaust = p->ambient_pressure;
  t->fill_area = p->fill_area;
  t->vent_area = p->vent_area;
  t->crossing = 0;
  t->asked = t->opening = t->choked_share = 0;
  t->mass_in = t->mass_out = t->drawn = t->mass_in_T = 0;
  t->growth = t->heat = t->film = t->bristle_force = 0;
  t->din_dp = t->dout_dp = t->dout_dT = 0;
  t->choked = 0;
}

/* What lies between the orifices and the outside, which a build without effects has not. */
static void begin_lines(const pneu_model *model, const pneu_real *y, pneu_terms *t)
{
  static const pneu_line none = {0, 0, 0, 0};
  t->supply_line = model->supply_loss;
  t->exhaust_line = none;
  if (model->supply_line >= 0)
    t->supply = y[1 + model->thermal + model->supply_line] * model->scale[0];
}

/* A build without effects need not link the call. */
static void add_effects(pneu_terms *t, const pneu_real *y, int stage, int *next, pneu_real *rate)
{
  if (PNEU_EFFECT_COUNT > 0 && *next < t->model->n_active)
    pneu_add_effects(t, y, stage, next, rate);
}

/* A build without free terms need not link them. */
static void add_terms(pneu_terms *t, int first, int last)
{
  if (PNEU_TERM_KNOTS > 0 && t->model->n_terms > 0)
    pneu_add_terms(t, first, last);
}

/* What the sensors show. Rates depend on no more than the lags among them. */
static void add_sensors(pneu_terms *t, const pneu_real *y, int *next, pneu_real *rate)
{
  t->p_shown = t->p - t->model->p.ambient_pressure;
  t->T_shown = t->T;
  t->x_shown = t->x;
  add_effects(t, y, rate ? PNEU_STAGE_LAG : PNEU_STAGE_SENSOR, next, rate);
  if (!rate)
    add_terms(t, PNEU_TERM_SHOWN_PRESSURE, PNEU_TERM_SHOWN_POSITION);
}

int pneu_evaluate(const pneu_model *model, const pneu_state *state, const pneu_input *input, const pneu_real *y,
                  int extent, pneu_terms *t, pneu_real *rate)
{
  int next = 0;
  begin(model, state, input, y, t);
  if (PNEU_EFFECT_COUNT > 0)
    begin_lines(model, y, t);
  t->extent = extent;
  add_effects(t, y, PNEU_STAGE_GEOMETRY, &next, rate);
  if (!pneu_chamber_ok(t))
    return PNEU_RETRY_STATE;
  if (!model->law.pressure_input) {
    t->asked = t->opening = pneu_command_opening(t);
    add_effects(t, y, PNEU_STAGE_BOUNDARY, &next, rate);
    add_terms(t, PNEU_TERM_SUPPLY, PNEU_TERM_SUPPLY);
    if (extent > PNEU_EXTENT_FORCES)
      pneu_transducer_flow(t);
  }
  add_effects(t, y, PNEU_STAGE_WALL, &next, rate);
  pneu_stem_force(t);
  add_effects(t, y, PNEU_STAGE_FORCE, &next, rate);
  add_terms(t, PNEU_TERM_FORCE, PNEU_TERM_HEAT);
  add_effects(t, y, PNEU_STAGE_BRISTLE, &next, rate);
  add_sensors(t, y, &next, rate);
  return PNEU_OK;
}

void pneu_evaluate_sensors(const pneu_model *model, const pneu_state *state, const pneu_input *input,
                           const pneu_real *y, pneu_terms *t)
{
  int next = 0;
  begin(model, state, input, y, t);
  t->extent = PNEU_EXTENT_FORCES;
  while (next < model->n_active && pneu_effect_at(model->active[next])->stage < PNEU_STAGE_LAG)
    next++;
  add_sensors(t, y, &next, NULL);
}

void pneu_rates(const pneu_terms *t, int mode, pneu_real *dydt)
{
  const pneu_model *model = t->model;
  const int n = pneu_dimension(model, mode), i_x = model->n_gas;
  pneu_chamber_rates(t, dydt);
  if (model->clock >= 0)
    dydt[1 + model->thermal + model->clock] = 1;
  if (n > i_x)
    dydt[i_x] = t->v;
  if (n > i_x + 1)
    dydt[i_x + 1] = pneu_stem_acceleration(t);
}

int pneu_rhs(const pneu_model *model, const pneu_state *state, const pneu_input *input, const pneu_real *y,
             pneu_real *dydt)
{
  pneu_terms t;
  if (pneu_evaluate(model, state, input, y, PNEU_EXTENT_FLOWS, &t, dydt + 1 + model->thermal) != PNEU_OK)
    return PNEU_RETRY_STATE;
  pneu_rates(&t, state->mode, dydt);
  return PNEU_OK;
}

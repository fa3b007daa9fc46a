/* Step responses and the static characteristic: figures 4, 11, 13, 14 and the standard experiment. */
#include "../lab/run/standard.h"
#include "products.h"

static const double accuracy = 1e-9; /* local error in units of full scale */

/* ---- The standard experiment ---- */

static int run(const lab_rig *rig, lab_response *response, lab_error *error)
{
  const lab_response_options options = {.tol = accuracy};
  pneu_model model;
  return lab_rig_model(rig, &model, error) ? error->status : lab_standard_experiment(&model, &options, response, error);
}

/* Every second sample, as rows of a figure. */
static void add_figure(const study_cell *c, const lab_response *r, table *t)
{
  size_t i;
  for (i = 0; i < r->n; i += 2)
    table_row(t, "ssgggg", c->gas, c->flow, r->t[i], r->u[i], r->p[i] * 1e-3, r->x[i] * 1e3);
}

enum { STEP, FIG04, FIG13, FIG14 };

/* Of every actuator in every law; the large step of the subject in the first law and in all; the last actuator without
 * its upper limiter. */
static int step_rows(const study_cell *c, table *t, lab_error *error)
{
  lab_rig own = *c->rig;
  lab_response r;
  size_t i;
  own.laws = c->laws;
  if (run(&own, &r, error))
    return error->status;
  for (i = 0; i < r.n; i++)
    table_row(&t[STEP], "gggg", r.t[i], r.u[i], r.p[i] * 1e-3, r.x[i] * 1e3);
  if (c->actuator == c->s->subject && c->law == 0)
    add_figure(c, &r, &t[FIG04]);
  if (c->actuator == c->s->subject)
    add_figure(c, &r, &t[FIG13]);
  lab_response_free(&r);
  if (c->actuator != c->s->n_printed - 1)
    return LAB_OK;
  own.params.stroke = 2 * own.params.supply_pressure * own.params.area / own.params.spring_rate;
  if (run(&own, &r, error))
    return error->status;
  add_figure(c, &r, &t[FIG14]);
  lab_response_free(&r);
  return LAB_OK;
}

static const char figure_header[] = "gas,flow,t [s],u [1],p [kPa],x [mm]";

const study_tables step_responses = {
    {STUDY_PRINTED, STUDY_EVERY_LAW},
    step_rows,
    {[STEP] = {"step", "t [s],u [1],p [kPa],x [mm]", STUDY_BY_CELL, STUDY_CELL_FILE, 10},
     [FIG04] = {.file = "fig04.csv", .header = figure_header},
     [FIG13] = {.file = "fig13.csv", .header = figure_header},
     [FIG14] = {.file = "fig14.csv", .header = figure_header}}};

/* ---- The static characteristic ---- */

/* Ramp of pressure, slow against every time constant: travel by the balance of forces alone. */
static int add_branch(const pneu_model *model, const char *branch, double from, double to, pneu_state *state, table *t,
                      lab_error *error)
{
  enum { POINTS = 200 };
  const double duration = 1000; /* [s] */
  pneu_options options;
  pneu_workspace work = {0};
  pneu_input input;
  int i, status = PNEU_OK;
  pneu_options_default(&options);
  pneu_input_default(model, &input);
  input.pressure_rate = (to - from) / duration;
  for (i = 0; i <= POINTS && status == PNEU_OK; i++) {
    table_row(t, "sgg", branch, state->p * 1e-3, state->x * 1e3);
    if (i < POINTS)
      status = pneu_run(model, state, &input, duration / POINTS, &options, NULL, &work);
  }
  return status == PNEU_OK ? LAB_OK
                           : lab_fail(error, LAB_NUMERIC, "%s on the static characteristic at p = %.6g Pa",
                                      pneu_status_text(status), state->p);
}

/* From ambient to supply and back. */
static int static_rows(const study_cell *c, table *t, lab_error *error)
{
  const double top = c->rig->params.supply_pressure;
  lab_rig own = *c->rig;
  pneu_input input;
  pneu_model model;
  pneu_state state;
  own.laws.pressure_input = 1;
  if (lab_rig_model(&own, &model, error))
    return error->status;
  pneu_input_default(&model, &input);
  pneu_state_rest(&model, 0, model.p.ambient_temperature, 0, &input, &state);
  if (add_branch(&model, "rising", 0, top, &state, t, error))
    return error->status;
  return add_branch(&model, "falling", top, 0, &state, t, error);
}

const study_tables static_characteristic = {
    {STUDY_SUBJECT, STUDY_ONE_LAW}, static_rows, {{.file = "fig11.csv", .header = "branch,p [kPa],x [mm]"}}};

#include "responses.h"

#include <math.h>
#include <stdio.h>

#include "../lab/base/outfile.h"
#include "../lab/run/standard.h"
#include "../lab/base/series.h"

static const double accuracy = 1e-9; /* local error in units of full scale */

static int model_of(const lab_rig *rig, int gas, int flow, double stroke, pneu_model *model, lab_error *error)
{
  lab_rig own = *rig;
  own.laws = study_laws(rig, gas, flow);
  if (stroke > 0)
    own.params.stroke = stroke;
  if (lab_rig_model(&own, model, error))
    return error->status;
  model->term = rig->term; /* those of `own` end here */
  return LAB_OK;
}

static int save_trace(const study *s, const char *name, const lab_trace *trace, lab_error *error)
{
  const lab_series_column column[] = {
      {"t [s]", 1, trace->t}, {"u [1]", 1, trace->u}, {"p [kPa]", 1e-3, trace->p}, {"x [mm]", 1e3, trace->x}};
  char path[STUDY_PATH_TEXT + 2 * LAB_NAME_TEXT];
  lab_outfile out;
  snprintf(path, sizeof path, "%s/%s", s->results, name);
  if (lab_out_open(&out, path, error))
    return error->status;
  lab_series_header(out.file, column, 4);
  lab_series_rows(out.file, column, 4, trace->n);
  if (lab_out_close(&out, error))
    return error->status;
  study_note_saved(s, name);
  return LAB_OK;
}

static int standard_of(const study *s, const lab_rig *rig, int gas, int flow, lab_error *error)
{
  const lab_response_options options = {LAB_STEPPER, accuracy, 0, 0, 0, 0};
  char name[2 * LAB_NAME_TEXT];
  pneu_model model;
  lab_trace trace;
  int status;
  if (model_of(rig, gas, flow, 0, &model, error) || lab_standard_experiment(&model, &options, &trace, error))
    return lab_fail_in(error, "%s, %s, %s", rig->name, pneu_gas_key(gas), pneu_flow_key(flow));
  snprintf(name, sizeof name, "step_%s_%s_%s.csv", rig->name, pneu_gas_key(gas), pneu_flow_key(flow));
  status = save_trace(s, name, &trace, error);
  lab_trace_free(&trace);
  return status;
}

int responses_standard(const study *s, lab_error *error)
{
  int a, law, status = LAB_OK;
  for (a = 0; a < s->n_actuators && status == LAB_OK; a++)
    for (law = 0; law < s->n_gas * s->n_flow && status == LAB_OK; law++)
      status = standard_of(s, &s->actuator[a], s->gas[law / s->n_flow], s->flow[law % s->n_flow], error);
  return status;
}

/* Every second sample of a standard experiment, as rows of a figure. */
static int step_rows(const lab_rig *rig, int gas, int flow, double stroke, table *t, lab_error *error)
{
  const lab_response_options options = {LAB_STEPPER, accuracy, 0, 0, 0, 0};
  pneu_model model;
  lab_trace trace;
  size_t i;
  if (model_of(rig, gas, flow, stroke, &model, error) || lab_standard_experiment(&model, &options, &trace, error))
    return error->status;
  for (i = 0; i < trace.n; i += 2)
    table_row(t, "ssgggg", pneu_gas_key(gas), pneu_flow_key(flow), trace.t[i], trace.u[i], trace.p[i] * 1e-3,
              trace.x[i] * 1e3);
  lab_trace_free(&trace);
  return LAB_OK;
}

static int step_figure(const study *s, const char *name, const lab_rig *rig, int gas_laws, int flow_laws, double stroke,
                       lab_error *error)
{
  int law, status = LAB_OK;
  table t;
  table_open(&t, "gas,flow,t [s],u [1],p [kPa],x [mm]");
  for (law = 0; law < gas_laws * flow_laws && status == LAB_OK; law++)
    status = step_rows(rig, s->gas[law / flow_laws], s->flow[law % flow_laws], stroke, &t, error);
  if (status == LAB_OK)
    status = study_save(s, name, &t, error);
  table_close(&t);
  return status;
}

int responses_steps(const study *s, lab_error *error)
{
  const lab_rig *subject = &s->actuator[s->subject];
  const lab_rig *other = &s->actuator[s->n_actuators - 1];
  const double free_travel = 2 * other->params.supply_pressure * other->params.area / other->params.spring_rate;
  if (step_figure(s, "fig04.csv", subject, 1, 1, 0, error) ||
      step_figure(s, "fig13.csv", subject, s->n_gas, s->n_flow, 0, error))
    return error->status;
  return step_figure(s, "fig14.csv", other, s->n_gas, s->n_flow, free_travel, error);
}

/* Ramp of pressure from ambient to supply and back: travel by the balance of forces alone. */
static int static_rows(const lab_rig *rig, const char *branch, double from, double to, pneu_state *state, table *t,
                       lab_error *error)
{
  enum { POINTS = 200 };
  const double duration = 1000; /* [s] */
  lab_rig own = *rig;
  pneu_options options;
  pneu_workspace work = {0};
  pneu_input input;
  pneu_model model;
  int i;
  own.laws.pressure_input = 1;
  if (lab_rig_model(&own, &model, error))
    return error->status;
  pneu_options_default(&options);
  pneu_input_default(&model, &input);
  if (state->T == 0)
    pneu_state_rest(&model, from, model.p.ambient_temperature, 0, &input, state);
  input.pressure_rate = (to - from) / duration;
  for (i = 0; i <= POINTS; i++) {
    int status;
    table_row(t, "sgg", branch, state->p * 1e-3, state->x * 1e3);
    status = i < POINTS ? pneu_run(&model, state, &input, duration / POINTS, &options, NULL, &work) : PNEU_OK;
    if (status != PNEU_OK)
      return lab_fail(error, LAB_NUMERIC, "%s on the static characteristic at p = %.6g Pa", pneu_status_text(status),
                      state->p);
  }
  return LAB_OK;
}

int responses_static(const study *s, lab_error *error)
{
  const lab_rig *rig = &s->actuator[s->subject];
  const double top = rig->params.supply_pressure;
  pneu_state state = {0};
  table t;
  int status;
  table_open(&t, "branch,p [kPa],x [mm]");
  status = static_rows(rig, "rising", 0, top, &state, &t, error);
  if (status == LAB_OK)
    status = static_rows(rig, "falling", top, 0, &state, &t, error);
  if (status == LAB_OK)
    status = study_save(s, "fig11.csv", &t, error);
  table_close(&t);
  return status;
}

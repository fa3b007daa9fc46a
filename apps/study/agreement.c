#include "agreement.h"

#include <math.h>

#include "../lab/run/standard.h"
#include "audit.h"

static const double stepper_tol = 1e-8, reference_tol = 1e-12;

static double largest_gap(const double *a, const double *b, size_t n)
{
  double gap = 0;
  size_t i;
  for (i = 0; i < n; i++)
    if (!(fabs(a[i] - b[i]) <= gap))
      gap = fabs(a[i] - b[i]);
  return gap;
}

static int compare(const lab_rig *rig, const pneu_model *model, double *dx, double *dp, lab_error *error)
{
  const lab_response_options ours = {LAB_STEPPER, stepper_tol, 0, 0, 0, 0},
                             reference = {LAB_CVODE, reference_tol, 0, 0, 0, 0};
  lab_trace a, b;
  if (lab_standard_experiment(model, &ours, &a, error))
    return error->status;
  if (lab_standard_experiment(model, &reference, &b, error)) {
    lab_trace_free(&a);
    return error->status;
  }
  *dx = largest_gap(a.x, b.x, a.n) / rig->params.stroke;
  *dp = largest_gap(a.p, b.p, a.n) / rig->params.supply_pressure;
  lab_trace_free(&a);
  lab_trace_free(&b);
  return LAB_OK;
}

static int agreement_row(const lab_rig *rig, int gas, int flow, table *t, lab_error *error)
{
  lab_rig own = *rig;
  pneu_model model;
  audit balance;
  double dx = 0, dp = 0;
  own.laws = study_laws(rig, gas, flow);
  if (lab_rig_model(&own, &model, error) || compare(rig, &model, &dx, &dp, error) ||
      audit_run(&model, stepper_tol, &balance, error))
    return lab_fail_in(error, "%s, %s, %s", rig->name, pneu_gas_key(gas), pneu_flow_key(flow));
  table_row(t, "sssgggg", rig->name, pneu_gas_key(gas), pneu_flow_key(flow), dx, dp, balance.mass_gap,
            balance.energy_gap);
  return LAB_OK;
}

int agreement_make(const study *s, lab_error *error)
{
  int a, law, status = LAB_OK;
  table t;
  table_open(&t, "actuator,gas,flow,position_gap_over_stroke,pressure_gap_over_supply,mass_gap,energy_gap");
  for (a = 0; a < s->n_actuators && status == LAB_OK; a++)
    for (law = 0; law < s->n_gas * s->n_flow && status == LAB_OK; law++)
      status = agreement_row(&s->actuator[a], s->gas[law / s->n_flow], s->flow[law % s->n_flow], &t, error);
  if (status == LAB_OK)
    status = study_save(s, "agreement.csv", &t, error);
  table_close(&t);
  return status;
}

/* The stepper against CVODE, and the balances of mass and energy, on every standard experiment. */
#include <math.h>
#include <string.h>

#include "../lab/run/standard.h"
#include "products.h"

/* ---- Balances: what came in and went out against what is there ---- */

typedef struct audit {
  double mass_flow;     /* [kg] integral of inflow less outflow */
  double mass_passed;   /* [kg] integral of inflow plus outflow */
  double energy_flow;   /* [J] integral of enthalpy in less out, heat, less work on the stem */
  double energy_passed; /* [J] integral of the sizes of these */
  double mass_gap;      /* [1] change of mass less mass_flow, over mass_passed */
  double energy_gap;    /* [1] likewise; NaN for the isothermal law, where heat is what it must be */
} audit;

/* Gauss-Legendre on 0..1, four points (Abramowitz and Stegun 1964, table 25.4). */
enum { NODES = 4 };
static const double node[NODES] = {0.06943184420297371, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629};
static const double weight[NODES] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                     0.17392742256872693};

static double internal_energy(const pneu_model *model, const pneu_state *state)
{
  return (state->p + model->p.ambient_pressure) * pneu_volume(model, state->x) / (model->g - 1);
}

static int add_step(void *context, const pneu_step_view *view)
{
  audit *balance = context;
  const pneu_model *model = view->model;
  const double cp = model->g * model->p.gas_constant / (model->g - 1);
  int i;
  for (i = 0; i < NODES; i++) {
    const double dt = weight[i] * view->h;
    pneu_state at;
    pneu_output out;
    double in, leaving, work;
    pneu_dense(view, node[i], &at);
    if (pneu_observe(model, &at, view->input, &out) != PNEU_OK)
      return 1;
    in = cp * model->p.supply_temperature * out.mass_in;
    leaving = cp * out.temperature * out.mass_out;
    work = (out.pressure + model->p.ambient_pressure) * model->p.area * model->p.swept_ratio * out.velocity;
    balance->mass_flow += dt * (out.mass_in - out.mass_out);
    balance->mass_passed += dt * (out.mass_in + out.mass_out);
    balance->energy_flow += dt * (in - leaving + out.heat - work);
    balance->energy_passed += dt * (in + leaving + fabs(out.heat) + fabs(work));
  }
  return 0;
}

/* Fill for 15 s and vent for 15 s from rest, and add up both balances by Gauss quadrature of order 8 over the dense
 * output. */
static int run_audit(const pneu_model *model, double tol, audit *balance, lab_error *error)
{
  static const double command[2] = {1, -1};
  pneu_observer observer = {add_step, NULL, balance};
  pneu_options options;
  pneu_workspace work;
  pneu_input input;
  pneu_state state;
  double mass, energy;
  int i, status = PNEU_OK;
  memset(balance, 0, sizeof *balance);
  memset(&work, 0, sizeof work);
  pneu_options_default(&options);
  options.tol = tol;
  pneu_input_default(model, &input);
  pneu_state_rest(model, 0, model->p.ambient_temperature, 0, &input, &state);
  mass = pneu_mass(model, &state);
  energy = internal_energy(model, &state);
  for (i = 0; i < 2 && status == PNEU_OK; i++) {
    input.u = command[i];
    status = pneu_run(model, &state, &input, 15.0, &options, &observer, &work);
  }
  if (status != PNEU_OK)
    return lab_fail(error, LAB_NUMERIC, "%s in the audit, %s, p = %.6g Pa, x = %.6g m", pneu_status_text(status),
                    pneu_mode_text(state.mode), state.p, state.x);
  balance->mass_gap = (pneu_mass(model, &state) - mass - balance->mass_flow) / balance->mass_passed;
  balance->energy_gap = model->thermal
                            ? (internal_energy(model, &state) - energy - balance->energy_flow) / balance->energy_passed
                            : (double)NAN;
  return LAB_OK;
}

/* ---- Against CVODE ---- */

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
  const lab_response_options ours = {.tol = stepper_tol}, reference = {.integrator = LAB_CVODE, .tol = reference_tol};
  lab_response a, b;
  if (lab_standard_experiment(model, &ours, &a, error))
    return error->status;
  if (lab_standard_experiment(model, &reference, &b, error)) {
    lab_response_free(&a);
    return error->status;
  }
  *dx = largest_gap(a.x, b.x, a.n) / rig->params.stroke;
  *dp = largest_gap(a.p, b.p, a.n) / rig->params.supply_pressure;
  lab_response_free(&a);
  lab_response_free(&b);
  return LAB_OK;
}

static int agreement_rows(const study_cell *c, table *t, lab_error *error)
{
  lab_rig own = *c->rig;
  pneu_model model;
  audit balance;
  double dx = 0, dp = 0;
  own.laws = c->laws;
  if (lab_rig_model(&own, &model, error) || compare(&own, &model, &dx, &dp, error) ||
      run_audit(&model, stepper_tol, &balance, error))
    return error->status;
  table_row(t, "sssgggg", c->rig->name, c->gas, c->flow, dx, dp, balance.mass_gap, balance.energy_gap);
  return LAB_OK;
}

const study_tables agreement = {
    {STUDY_PRINTED, STUDY_EVERY_LAW},
    agreement_rows,
    {{.file = "agreement.csv",
      .header = "actuator,gas,flow,position_gap_over_stroke,pressure_gap_over_supply,mass_gap,energy_gap"}}};

#include "audit.h"

#include <math.h>
#include <string.h>

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

int audit_run(const pneu_model *model, double tol, audit *balance, lab_error *error)
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

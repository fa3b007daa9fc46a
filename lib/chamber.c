/* The gas in the chamber: geometry, pressure, balance of mass and energy. */
#include "chamber.h"

pneu_real pneu_volume(const pneu_model *model, pneu_real x)
{
  return model->p.dead_volume + model->p.area * x;
}

pneu_real pneu_pressure_of(const pneu_model *model, pneu_real m, pneu_real T, pneu_real volume)
{
  /* p V = m R T [B, Eq. 6]; where pressure is an input, the first entry is the gauge pressure */
  return model->law.pressure_input ? m + model->p.ambient_pressure : m * model->p.gas_constant * T / volume;
}

pneu_real pneu_pressure_abs(const pneu_model *model, const pneu_state *state)
{
  const pneu_real T = model->thermal ? state->T : model->p.ambient_temperature;
  return pneu_pressure_of(model, state->m, T, pneu_volume(model, state->x));
}

void pneu_chamber_rates(const pneu_terms *t, pneu_real *y_dot)
{
  const pneu_model *model = t->model;
  const pneu_real g = model->g, R = model->p.gas_constant;
  if (model->law.pressure_input) {
    y_dot[0] = t->input->pressure_rate;
    return;
  }
  y_dot[0] = t->mass_in - t->mass_out; /* [B, Eq. 7] */
  if (!model->thermal)
    return;
  /* m T' = sum_in (g T_in - T) q - (g - 1) (T q_out + (p V' - Q)/R): the first law with
   * u = R T/(g - 1); g = gamma: energy balance, g = n: polytropic, g -> 1: isothermal */
  y_dot[1] = (g * t->mass_in_T - t->T * t->mass_in -
              (g - 1) * (t->T * t->mass_out + (t->p * t->area * t->v - t->heat) / R)) / t->m;
}

int pneu_chamber_ok(const pneu_terms *t)
{
  return t->volume > 0 && t->T > 0 && t->p > 0;
}

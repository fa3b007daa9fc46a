/* The gas in the chamber: geometry and the balances of mass and energy, as rates of p and T. */
#include "chamber.h"

pneu_real pneu_volume(const pneu_model *model, pneu_real x)
{
  /* the integral of area (1 - area_slope x) */
  return model->p.dead_volume + model->p.area * model->p.swept_ratio * x * (1 - model->area_slope * x / 2);
}

pneu_real pneu_mass(const pneu_model *model, const pneu_state *state)
{
  const pneu_real T = model->thermal ? state->T : model->p.ambient_temperature;
  return (state->p + model->p.ambient_pressure) * pneu_volume(model, state->x) / (model->p.gas_constant * T);
}

void pneu_chamber_rates(const pneu_terms *t, pneu_real *y_dot)
{
  const pneu_model *model = t->model;
  const pneu_real g = model->g, R = model->p.gas_constant, expansion = t->swept_area * t->v + t->growth;
  pneu_real per_volume;
  if (model->law.pressure_input) {
    y_dot[0] = t->input->pressure_rate;
    return;
  }
  per_volume = 1 / t->volume; /* by itself: a processor need not wait for the flow */
  if (!model->thermal) {
    /* V p' = R T (q_in - q_out) - p V' [B, Eqs. 6, 7] */
    y_dot[0] = (R * t->T * (t->mass_in - t->mass_out) - t->p * expansion) * per_volume;
    y_dot[0] += model->rate_exponent_rise * y_dot[0]; /* effects/chamber_exponent.c */
    return;
  }
  /* first law with u = R T/(g - 1): g = gamma is the energy balance, g = n the polytropic law.
   * V p' = g (R sum_in T_in q - R T q_out - p V') + (g - 1) Q,  and T from p V = m R T */
  y_dot[0] = (g * (R * (t->mass_in_T - t->T * t->mass_out) - t->p * expansion) + (g - 1) * t->heat) * per_volume;
  y_dot[1] = t->T * ((y_dot[0] - R * t->T * (t->mass_in - t->mass_out) * per_volume) / t->p + expansion * per_volume);
}

int pneu_chamber_ok(const pneu_terms *t)
{
  return (t->volume > 0 || t->model->law.pressure_input) && t->T > 0 && t->p > 0;
}

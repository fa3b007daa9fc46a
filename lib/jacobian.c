/* Jacobian of the packed right-hand side. */
#include "internal.h"

/* Central scale of each entry for difference quotients: its size, or that of its full scale. */
static void differences(const pneu_model *model, const pneu_state *state, const pneu_input *input, const pneu_real *y,
                        const pneu_real *f0, int n, pneu_real jac[PNEU_STATE_MAX][PNEU_STATE_MAX])
{
  const pneu_real small = PNEU_M(sqrt)(PNEU_EPS);
  pneu_real scale[PNEU_STATE_MAX], z[PNEU_STATE_MAX], f[PNEU_STATE_MAX];
  int i, j;
  pneu_scales(model, state, scale);
  for (i = 0; i < n; i++)
    z[i] = y[i];
  for (j = 0; j < n; j++) {
    const pneu_real size = PNEU_M(fabs)(y[j]), floor = PNEU_C(1e-3) * scale[j];
    z[j] = y[j] + small * (size > floor ? size : floor);
    if (pneu_rhs(model, state, input, z, f) != PNEU_OK)
      z[j] = y[j], pneu_rhs(model, state, input, z, f);
    for (i = 0; i < n; i++)
      jac[i][j] = z[j] == y[j] ? 0 : (f[i] - f0[i]) / (z[j] - y[j]);
    z[j] = y[j];
  }
}

/* Chamber pressure p(m, T, x): slopes by p = m R T/V. */
typedef struct slopes {
  pneu_real p_m, p_T, p_x;
} slopes;

static slopes pressure_slopes(const pneu_terms *t)
{
  slopes s;
  s.p_m = t->p / t->m;
  s.p_T = t->p / t->T;
  s.p_x = -t->p * t->area / t->volume;
  return s;
}

/* Row of T: m T' = N, with N of chamber.c. */
static void energy_row(const pneu_terms *t, const slopes *s, int i_x, int n, pneu_real T_dot, pneu_real *row)
{
  const pneu_real g = t->model->g, R = t->model->p.gas_constant;
  const pneu_real T_in = t->mass_in > 0 ? t->mass_in_T / t->mass_in : t->T;
  const pneu_real n_p =
      (g * T_in - t->T) * t->din_dp - (g - 1) * (t->T * t->dout_dp + t->area * t->v / R); /* dN/dp */
  const pneu_real n_T = -t->mass_in - (g - 1) * (t->mass_out + t->T * t->dout_dT);
  row[0] = (n_p * s->p_m - T_dot) / t->m;
  row[1] = (n_p * s->p_T + n_T) / t->m;
  if (n > i_x)
    row[i_x] = n_p * s->p_x / t->m;
  if (n > i_x + 1)
    row[i_x + 1] = -(g - 1) * t->p * t->area / (R * t->m);
}

static void base_jacobian(const pneu_terms *t, int i_x, int n, const pneu_real *f0,
                          pneu_real jac[PNEU_STATE_MAX][PNEU_STATE_MAX])
{
  const pneu_params *p = &t->model->p;
  const slopes s = pressure_slopes(t);
  const pneu_real q_p = t->din_dp - t->dout_dp;
  int i, j;
  for (i = 0; i < n; i++)
    for (j = 0; j < n; j++)
      jac[i][j] = 0;
  jac[0][0] = q_p * s.p_m;
  if (t->model->thermal) {
    jac[0][1] = q_p * s.p_T - t->dout_dT;
    energy_row(t, &s, i_x, n, f0[1], jac[1]);
  }
  if (n > i_x)
    jac[0][i_x] = q_p * s.p_x;
  if (n <= i_x + 1)
    return;
  jac[i_x][i_x + 1] = 1;
  jac[i_x + 1][0] = t->area * s.p_m / p->moving_mass;
  if (t->model->thermal)
    jac[i_x + 1][1] = t->area * s.p_T / p->moving_mass;
  jac[i_x + 1][i_x] = (t->area * s.p_x - p->spring_rate) / p->moving_mass;
  jac[i_x + 1][i_x + 1] = -t->model->viscous / p->moving_mass;
}

int pneu_jacobian(const pneu_model *model, const pneu_state *state, const pneu_input *input, const pneu_real *y,
                  const pneu_real *f0, pneu_real jac[PNEU_STATE_MAX][PNEU_STATE_MAX])
{
  pneu_terms t;
  const int n = pneu_dimension(model, state->mode);
  if (model->n_active > 0 || model->p.proportional_band > 0 || model->law.pressure_input) {
    differences(model, state, input, y, f0, n, jac);
    return PNEU_OK;
  }
  if (pneu_evaluate(model, state, input, y, &t, NULL) != PNEU_OK)
    return PNEU_RETRY_STATE;
  base_jacobian(&t, model->n_gas, n, f0, jac);
  return PNEU_OK;
}

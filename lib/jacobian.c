/* Jacobian of the packed right-hand side. */
#include "internal.h"

/* Difference quotients, with steps by the size of each entry or a share of its full scale: a thousandth, and a tenth
 * for states of effects. These start at 0, their rates are nearly linear in them, and so short a step would leave
 * single precision one digit.  Returns: PNEU_RETRY_STATE where a step leaves the model's domain. */
static int differences(const pneu_model *model, const pneu_state *state, const pneu_input *input, const pneu_real *y,
                       const pneu_real *f0, int n, pneu_real jac[PNEU_STATE_MAX][PNEU_STATE_MAX])
{
  const pneu_real small = PNEU_M(sqrt)(PNEU_EPS);
  pneu_real scale[PNEU_STATE_MAX], z[PNEU_STATE_MAX], f[PNEU_STATE_MAX];
  int i, j;
  pneu_scales(model, scale);
  for (i = 0; i < n; i++)
    z[i] = y[i];
  for (j = 0; j < n; j++) {
    const int of_effect = j > model->thermal && j < model->n_gas;
    const pneu_real size = PNEU_M(fabs)(y[j]), floor = (of_effect ? PNEU_C(0.1) : PNEU_C(1e-3)) * scale[j];
    z[j] = y[j] + small * (size > floor ? size : floor);
    if (pneu_rhs(model, state, input, z, f) != PNEU_OK)
      return PNEU_RETRY_STATE;
    for (i = 0; i < n; i++)
      jac[i][j] = (f[i] - f0[i]) / (z[j] - y[j]);
    z[j] = y[j];
  }
  return PNEU_OK;
}

/* Rows of p and T in the order of their formulae in chamber.c. */
static void isothermal_row(const pneu_terms *t, int i_x, int n, pneu_real p_dot, pneu_real *row)
{
  const pneu_real R = t->model->p.gas_constant;
  row[0] = (R * t->T * (t->din_dp - t->dout_dp) - t->swept_area * t->v) / t->volume;
  if (n > i_x)
    row[i_x] = -p_dot * t->swept_area / t->volume;
  if (n > i_x + 1)
    row[i_x + 1] = -t->p * t->swept_area / t->volume;
}

static void energy_rows(const pneu_terms *t, int i_x, int n, const pneu_real *f0,
                        pneu_real jac[PNEU_STATE_MAX][PNEU_STATE_MAX])
{
  const pneu_real g = t->model->g, R = t->model->p.gas_constant, T = t->T, p = t->p;
  const pneu_real T_in = t->mass_in > 0 ? t->mass_in_T / t->mass_in : T;
  const pneu_real flow = t->mass_in - t->mass_out, gain = R * T / (p * t->volume); /* 1/m */
  const pneu_real swept = t->swept_area / t->volume, p_dot = f0[0];
  jac[0][0] = g * (R * (T_in * t->din_dp - T * t->dout_dp) - t->swept_area * t->v) / t->volume;
  jac[0][1] = -g * R * (t->mass_out + T * t->dout_dT) / t->volume;
  jac[1][0] = T * ((jac[0][0] - p_dot / p) / p - gain * (t->din_dp - t->dout_dp - flow / p));
  jac[1][1] = f0[1] / T + T * (jac[0][1] / p - gain * (flow / T - t->dout_dT));
  if (n > i_x) {
    jac[0][i_x] = -p_dot * swept;
    jac[1][i_x] = T * (jac[0][i_x] / p - swept * swept * t->v + gain * flow * swept);
  }
  if (n > i_x + 1) {
    jac[0][i_x + 1] = -g * p * swept;
    jac[1][i_x + 1] = T * (jac[0][i_x + 1] / p + swept);
  }
}

static void stem_rows(const pneu_terms *t, int i_x, pneu_real jac[PNEU_STATE_MAX][PNEU_STATE_MAX])
{
  const pneu_params *p = &t->model->p;
  jac[i_x][i_x + 1] = 1;
  jac[i_x + 1][0] = t->area / p->moving_mass;
  jac[i_x + 1][i_x] = -p->spring_rate / p->moving_mass;
  jac[i_x + 1][i_x + 1] = -t->model->viscous / p->moving_mass;
}

static void base_jacobian(const pneu_terms *t, int i_x, int n, const pneu_real *f0,
                          pneu_real jac[PNEU_STATE_MAX][PNEU_STATE_MAX])
{
  int i, j;
  for (j = 0; j < n; j++) /* the gas fills its rows */
    for (i = i_x; i < n; i++)
      jac[i][j] = 0;
  if (t->model->thermal)
    energy_rows(t, i_x, n, f0, jac);
  else
    isothermal_row(t, i_x, n, f0[0], jac[0]);
  if (n > i_x + 1)
    stem_rows(t, i_x, jac);
}

/* Effects stand in the order of their stages: what a sensor adds to what it shows acts on no rate. */
static int has_rates(const pneu_model *model)
{
  return model->n_active > 0 && pneu_effect_at(model->active[0])->stage <= PNEU_STAGE_LAG;
}

static int is_analytic(const pneu_model *model)
{
  return !has_rates(model) && model->n_terms == 0 && model->p.proportional_band <= 0 && !model->law.pressure_input;
}

int pneu_jacobian(const pneu_model *model, const pneu_state *state, const pneu_input *input, const pneu_real *y,
                  const pneu_real *f0, pneu_real jac[PNEU_STATE_MAX][PNEU_STATE_MAX])
{
  pneu_terms t;
  const int n = pneu_dimension(model, state->mode);
  if (!is_analytic(model))
    return differences(model, state, input, y, f0, n, jac);
  if (pneu_evaluate(model, state, input, y, PNEU_EXTENT_SLOPES, &t, NULL) != PNEU_OK)
    return PNEU_RETRY_STATE;
  base_jacobian(&t, model->n_gas, n, f0, jac);
  return PNEU_OK;
}

/* Slope of the right-hand side in time, by how far the command runs in a short one. */
static int slope_in_time(const pneu_model *model, const pneu_state *state, const pneu_input *input,
                         pneu_workspace *work)
{
  const pneu_real range = model->p.proportional_band > 0 ? model->p.supply_pressure : 1;
  const pneu_real dt = PNEU_M(sqrt)(PNEU_EPS) * range / PNEU_M(fabs)(input->u_rate);
  const int n = pneu_dimension(model, state->mode);
  pneu_input next = *input;
  int i;
  next.elapsed += dt;
  work->stats.rhs++;
  if (pneu_rhs(model, state, &next, work->y0, work->ft) != PNEU_OK)
    return PNEU_RETRY_STATE;
  for (i = 0; i < n; i++)
    work->ft[i] = (work->ft[i] - work->f0[i]) / dt;
  return PNEU_OK;
}

/* Right-hand side and Jacobian at y0. */
static int prepare(const pneu_model *model, const pneu_state *state, const pneu_input *input, pneu_workspace *work)
{
  pneu_terms t;
  const int n = pneu_dimension(model, state->mode);
  work->stats.rhs++;
  work->stats.jacobians++;
  if (!is_analytic(model)) {
    if (pneu_rhs(model, state, input, work->y0, work->f0) != PNEU_OK)
      return PNEU_RETRY_STATE;
    return differences(model, state, input, work->y0, work->f0, n, work->jac);
  }
  if (pneu_evaluate(model, state, input, work->y0, PNEU_EXTENT_SLOPES, &t, NULL) != PNEU_OK)
    return PNEU_RETRY_STATE;
  pneu_rates(&t, state->mode, work->f0);
  base_jacobian(&t, model->n_gas, n, work->f0, work->jac);
  return PNEU_OK;
}

int pneu_step_prepare(const pneu_model *model, const pneu_state *state, const pneu_input *input, pneu_workspace *work)
{
  const int status = prepare(model, state, input, work);
  return status == PNEU_OK && input->u_rate != 0 ? slope_in_time(model, state, input, work) : status;
}

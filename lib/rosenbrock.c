/* One step of a Rosenbrock-Wanner method, in the form without matrix products (Hairer and Wanner 1996, IV.7.25):
 *   (I/(h gamma) - J) k_i = f(t_0 + alpha_i h, y_0 + sum_j a_ij k_j) + sum_j c_ij k_j / h + gamma_i h f_t,
 *   y_1 = y_0 + sum_j m_j k_j,   error = sum_j e_j k_j,
 *   y(theta) = (1 - theta) y_0 + theta (y_1 + (1 - theta) (d_1 + theta (d_2 + theta d_3))),   d_i = sum_j d_ij k_j.
 * A method is its tables: where each stage, and behind the last the result, starts from; the rows of a that this asks
 * for, with m as the last, and the rows of c, one after the other; e from its first entry that is not 0; d; at_time and
 * of_slope, alpha_i and gamma_i, which count while the command runs. */
#include "internal.h"

enum { AT_START, FROM_START /* by a row of a */, FROM_LAST /* point and slope k of the stage before */, AS_BEFORE };

#if PNEU_ORDER == 5
#include "rodas5p.h"
#else
#include "ros4.h"
#endif

/* (I/(h gamma) - J)^-1 */
static int invert_matrix(int n, pneu_real h, pneu_workspace *work)
{
  const pneu_real shift = 1 / (GAMMA * h);
  int i, j;
  for (i = 0; i < n; i++) {
    for (j = 0; j < n; j++)
      work->inverse[i][j] = -work->jac[i][j];
    work->inverse[i][i] += shift;
  }
  return pneu_invert(n, work->inverse);
}

static pneu_real add_products(pneu_real sum, int n, const pneu_real *x, const pneu_real *y)
{
  int i;
  for (i = 0; i < n; i++)
    sum += x[i] * y[i];
  return sum;
}

/* k_i of the right-hand side b, which takes up what the command's slope asks for. */
static void solve(int n, int i, pneu_real slope_share, pneu_real *b, pneu_workspace *work)
{
  int l;
  for (l = 0; l < n && slope_share != 0; l++)
    b[l] += slope_share * work->ft[l];
  for (l = 0; l < n; l++)
    work->k[l][i] = add_products(0, n, work->inverse[l], b);
}

/* Point of stage i, or the result, into y1.  Returns: the next row of a. */
static const pneu_real *find_point(int n, int i, const pneu_real *row, pneu_workspace *work)
{
  int l;
  if (point[i] == AS_BEFORE)
    return row;
  if (point[i] == FROM_LAST) {
    for (l = 0; l < n; l++)
      work->y1[l] += work->k[l][i - 1];
    return row;
  }
  for (l = 0; l < n; l++)
    work->y1[l] = add_products(work->y0[l], i, row, work->k[l]);
  return row + i;
}

static pneu_real error_norm(const pneu_model *model, int n, const pneu_workspace *work)
{
  pneu_real scale[PNEU_STATE_MAX], worst = 0;
  int l;
  pneu_scales(model, scale);
  for (l = 0; l < n; l++) {
    const pneu_real sum = add_products(0, PNEU_STAGE_COUNT - ERROR_FROM, e, &work->k[l][ERROR_FROM]);
    const pneu_real part = PNEU_M(fabs)(sum) / scale[l];
    if (!(part <= worst))
      worst = part;
  }
  return worst;
}

int pneu_step_try(const pneu_model *model, const pneu_state *state, const pneu_input *input, pneu_real h,
                  pneu_workspace *work, pneu_real *error)
{
  const int n = pneu_dimension(model, state->mode);
  const pneu_real rate = 1 / h, slope = input->u_rate != 0 ? h : 0, *row_a = a, *row_c = c;
  const pneu_input *at = input;
  pneu_input now;
  pneu_real f[PNEU_STATE_MAX], b[PNEU_STATE_MAX];
  int i, l, status = invert_matrix(n, h, work);
  if (status != PNEU_OK)
    return status;
  for (l = 0; l < n; l++)
    b[l] = work->f0[l];
  solve(n, 0, of_slope[0] * slope, b, work);
  for (i = 1; i < PNEU_STAGE_COUNT; i++) {
    row_a = find_point(n, i, row_a, work);
    if (point[i] != AS_BEFORE) {
      if (slope > 0) {
        now = *input;
        now.elapsed += at_time[i] * h;
        at = &now;
      }
      status = pneu_rhs(model, state, at, work->y1, f);
      work->stats.rhs++;
      if (status != PNEU_OK)
        return status;
    }
    for (l = 0; l < n; l++)
      b[l] = f[l] + rate * add_products(0, i, row_c, work->k[l]);
    row_c += i;
    solve(n, i, of_slope[i] * slope, b, work);
  }
  find_point(n, PNEU_STAGE_COUNT, row_a, work);
  *error = error_norm(model, n, work);
  return PNEU_OK;
}

void pneu_dense_prepare(int n, pneu_workspace *work)
{
  int i, l;
  for (i = 0; i < PNEU_DENSE_COUNT; i++)
    for (l = 0; l < n; l++)
      work->dense[i][l] = add_products(0, DENSE_STAGES, d[i], work->k[l]);
}

/* The stem's velocity is the slope of its position, at the start and at the end. */
static void join_position(int i_x, pneu_real h, pneu_workspace *work)
{
  const pneu_real way = work->y1[i_x] - work->y0[i_x], start = h * work->y0[i_x + 1], end = h * work->y1[i_x + 1];
  work->dense[0][i_x] = start - way;
  work->dense[1][i_x] = 2 * way - start - end;
}

void pneu_dense_step(const pneu_model *model, int mode, pneu_real h, pneu_workspace *work)
{
  const int n = pneu_dimension(model, mode);
  pneu_dense_prepare(n, work);
  if (PNEU_ORDER == 4 && n > model->n_gas + 1)
    join_position(model->n_gas, h, work);
}

void pneu_dense_packed(const pneu_workspace *work, int n, pneu_real theta, pneu_real *y)
{
  int i, l;
  for (l = 0; l < n; l++) {
    pneu_real sum = work->dense[PNEU_DENSE_COUNT - 1][l];
    for (i = PNEU_DENSE_COUNT - 2; i >= 0; i--)
      sum = work->dense[i][l] + theta * sum;
    y[l] = (1 - theta) * work->y0[l] + theta * (work->y1[l] + (1 - theta) * sum);
  }
}

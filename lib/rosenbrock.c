/* One step of Rodas5P, a Rosenbrock-Wanner method of order 5 with an embedded one of order 4; L-stable,
 * stiffly accurate, eight stages, dense output of order 4. Coefficients: G. Steinebach, "Construction
 * of Rosenbrock-Wanner method Rodas5P and numerical benchmarks within the Julia Differential Equations
 * package", BIT 63:27 (2023), in the form without matrix products (Hairer and Wanner 1996, IV.7.25):
 *   (I/(h gamma) - J) k_i = f(y_0 + sum_j a_ij k_j) + sum_j c_ij k_j / h,
 *   y_1 = y_0 + sum_j a_8j k_j + k_8,   error = k_8.
 * Stages 6 to 8 share one row of a: each starts from the result of the one before. */
#include "internal.h"

#define GAMMA PNEU_C(0.21193756319429014)

static const pneu_real a[6][5] = {
    {0},
    {PNEU_C(3.0)},
    {PNEU_C(2.849394379747939), PNEU_C(0.45842242204463923)},
    {PNEU_C(-6.954028509809101), PNEU_C(2.489845061869568), PNEU_C(-10.358996098473584)},
    {PNEU_C(2.8029986275628964), PNEU_C(0.5072464736228206), PNEU_C(-0.3988312541770524), PNEU_C(-0.04721187230404641)},
    {PNEU_C(-7.502846399306121), PNEU_C(2.561846144803919), PNEU_C(-11.627539656261098), PNEU_C(-0.18268767659942256),
     PNEU_C(0.030198172008377946)}};

static const pneu_real c[8][7] = {
    {0},
    {PNEU_C(-14.155112264123755)},
    {PNEU_C(-17.97296035885952), PNEU_C(-2.859693295451294)},
    {PNEU_C(147.12150275711716), PNEU_C(-1.41221402718213), PNEU_C(71.68940251302358)},
    {PNEU_C(165.43517024871676), PNEU_C(-0.4592823456491126), PNEU_C(42.90938336958603), PNEU_C(-5.961986721573306)},
    {PNEU_C(24.854864614690072), PNEU_C(-3.0009227002832186), PNEU_C(47.4931110020768), PNEU_C(5.5814197821558125),
     PNEU_C(-0.6610691825249471)},
    {PNEU_C(30.91273214028599), PNEU_C(-3.1208243349937974), PNEU_C(77.79954646070892), PNEU_C(34.28646028294783),
     PNEU_C(-19.097331116725623), PNEU_C(-28.087943162872662)},
    {PNEU_C(37.80277123390563), PNEU_C(-3.2571969029072276), PNEU_C(112.26918849496327), PNEU_C(66.9347231244047),
     PNEU_C(-40.06618937091002), PNEU_C(-54.66780262877968), PNEU_C(-9.48861652309627)}};

/* y(theta) = (1 - theta) y_0 + theta (y_1 + (1 - theta) (d_1 + theta (d_2 + theta d_3))), d_i = sum_j d_ij k_j */
static const pneu_real d[3][8] = {
    {PNEU_C(25.948786856663858), PNEU_C(-2.5579724845846235), PNEU_C(10.433815404888879), PNEU_C(-2.3679251022685204),
     PNEU_C(0.524948541321073), PNEU_C(1.1241088310450404), PNEU_C(0.4272876194431874), PNEU_C(-0.17202221070155493)},
    {PNEU_C(-9.91568850695171), PNEU_C(-0.9689944594115154), PNEU_C(3.0438037242978453), PNEU_C(-24.495224566215796),
     PNEU_C(20.176138334709044), PNEU_C(15.98066361424651), PNEU_C(-6.789040303419874), PNEU_C(-6.710236069923372)},
    {PNEU_C(11.419903575922262), PNEU_C(2.8879645146136994), PNEU_C(72.92137995996029), PNEU_C(80.12511834622643),
     PNEU_C(-52.072871366152654), PNEU_C(-59.78993625266729), PNEU_C(-0.15582684282751913), PNEU_C(4.883087185713722)}};

int pneu_step_prepare(const pneu_model *model, const pneu_state *state, const pneu_input *input, pneu_workspace *work)
{
  pneu_terms t;
  const int status = pneu_rates(model, state, input, work->y0, &t, work->f0);
  if (status == PNEU_OK)
    pneu_slopes(model, state, input, work->y0, work->f0, &t, work->jac);
  work->stats.rhs++;
  work->stats.jacobians++;
  return status;
}

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

static void solve(int n, const pneu_workspace *work, const pneu_real *b, pneu_real *x)
{
  int i, j;
  for (i = 0; i < n; i++) {
    pneu_real sum = 0;
    for (j = 0; j < n; j++)
      sum += work->inverse[i][j] * b[j];
    x[i] = sum;
  }
}

/* Point at which stage i evaluates the right-hand side, into y1. */
static void stage_point(int n, int i, pneu_workspace *work)
{
  int j, l;
  for (l = 0; l < n; l++) {
    pneu_real sum = i < 6 ? work->y0[l] : work->y1[l] + work->k[i - 1][l];
    for (j = 0; i < 6 && j < i; j++)
      sum += a[i][j] * work->k[j][l];
    work->y1[l] = sum;
  }
}

static int stage(const pneu_model *model, const pneu_state *state, const pneu_input *input, pneu_real h, int n, int i,
                 pneu_workspace *work)
{
  const pneu_real rate = 1 / h;
  pneu_real f[PNEU_STATE_MAX];
  int j, l, status;
  stage_point(n, i, work);
  status = pneu_rhs(model, state, input, work->y1, f);
  work->stats.rhs++;
  if (status != PNEU_OK)
    return status;
  for (l = 0; l < n; l++) {
    pneu_real sum = 0;
    for (j = 0; j < i; j++)
      sum += c[i][j] * work->k[j][l];
    f[l] += rate * sum;
  }
  solve(n, work, f, work->k[i]);
  return PNEU_OK;
}

static pneu_real error_norm(const pneu_model *model, int n, const pneu_real *e)
{
  pneu_real scale[PNEU_STATE_MAX], worst = 0;
  int i;
  pneu_scales(model, scale);
  for (i = 0; i < n; i++) {
    const pneu_real part = PNEU_M(fabs)(e[i]) / scale[i];
    if (!(part <= worst))
      worst = part;
  }
  return worst;
}

int pneu_step_try(const pneu_model *model, const pneu_state *state, const pneu_input *input, pneu_real h,
                  pneu_workspace *work, pneu_real *error)
{
  const int n = pneu_dimension(model, state->mode);
  int i, status = invert_matrix(n, h, work);
  if (status != PNEU_OK)
    return status;
  solve(n, work, work->f0, work->k[0]);
  for (i = 1; i < PNEU_STAGE_COUNT; i++) {
    status = stage(model, state, input, h, n, i, work);
    if (status != PNEU_OK)
      return status;
  }
  for (i = 0; i < n; i++)
    work->y1[i] += work->k[PNEU_STAGE_COUNT - 1][i];
  if (error)
    *error = error_norm(model, n, work->k[PNEU_STAGE_COUNT - 1]);
  return PNEU_OK;
}

void pneu_dense_prepare(int n, pneu_workspace *work)
{
  int i, j, l;
  for (i = 0; i < 3; i++)
    for (l = 0; l < n; l++) {
      pneu_real sum = 0;
      for (j = 0; j < PNEU_STAGE_COUNT; j++)
        sum += d[i][j] * work->k[j][l];
      work->dense[i][l] = sum;
    }
}

void pneu_dense_packed(const pneu_workspace *work, int n, pneu_real theta, pneu_real *y)
{
  int l;
  for (l = 0; l < n; l++)
    y[l] = (1 - theta) * work->y0[l] +
           theta * (work->y1[l] +
                    (1 - theta) * (work->dense[0][l] + theta * (work->dense[1][l] + theta * work->dense[2][l])));
}

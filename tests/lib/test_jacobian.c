/* The Jacobian against difference quotients of the right-hand side, and the small linear algebra. */
#include "../fixture.h"
#include "../../lib/internal.h"

typedef struct scene {
  double p, x, v;
  int mode;
} scene;

static const scene scenes[] = {
    {5e4, 0, 0, PNEU_MODE_LOWER},         {2e5, 0.01, 0, PNEU_MODE_STUCK},   {2.5e5, 0.008, 0.03, PNEU_MODE_UP},
    {1e5, 0.012, -0.04, PNEU_MODE_DOWN},  {3.9e5, 0.02, 0, PNEU_MODE_UPPER}, {5e5, 0.01, 0.02, PNEU_MODE_UP},
    {-4e4, 0.01, -0.02, PNEU_MODE_DOWN},
#ifndef PNEU_SINGLE /* steps of a difference in float are longer than the blend */
    {3.9995e5, 0.01, 0.01, PNEU_MODE_UP},
#endif
};

/* Column j of the Jacobian by a central difference. */
static void column(const pneu_model *m, const pneu_state *s, const pneu_input *input, const pneu_real *y, int n, int j,
                   double *out)
{
  pneu_real scale[PNEU_STATE_MAX], z[PNEU_STATE_MAX], up[PNEU_STATE_MAX], down[PNEU_STATE_MAX];
  const double relative = TOL(1e-6, 1e-3);
  double h, from;
  int i;
  pneu_scales(m, scale);
  h = relative * (double)scale[j];
  memcpy(z, y, sizeof z);
  z[j] = (pneu_real)((double)y[j] + h);
  from = (double)z[j];
  assert_int_equal(pneu_rhs(m, s, input, z, up), PNEU_OK);
  z[j] = (pneu_real)((double)y[j] - h);
  assert_int_equal(pneu_rhs(m, s, input, z, down), PNEU_OK);
  for (i = 0; i < n; i++)
    out[i] = ((double)up[i] - (double)down[i]) / (from - (double)z[j]);
}

/* Entries are compared in units of the largest of their row, each scaled to full range. */
static void check_jacobian(const pneu_model *m, const pneu_state *s, const pneu_input *input, double rtol)
{
  pneu_real y[PNEU_STATE_MAX] = {0}, f0[PNEU_STATE_MAX], jac[PNEU_STATE_MAX][PNEU_STATE_MAX], scale[PNEU_STATE_MAX];
  double want[PNEU_STATE_MAX][PNEU_STATE_MAX], c[PNEU_STATE_MAX], largest;
  const int n = pneu_pack(m, s, y);
  int i, j;
  assert_int_equal(n, pneu_dimension(m, s->mode));
  assert_int_equal(pneu_rhs(m, s, input, y, f0), PNEU_OK);
  assert_int_equal(pneu_jacobian(m, s, input, y, f0, jac), PNEU_OK);
  pneu_scales(m, scale);
  for (j = 0; j < n; j++) {
    column(m, s, input, y, n, j, c);
    for (i = 0; i < n; i++)
      want[i][j] = c[i] * (double)scale[j];
  }
  for (i = 0; i < n; i++) {
    for (largest = 0, j = 0; j < n; j++)
      largest = fmax(largest, fabs(want[i][j]));
    for (j = 0; j < n; j++)
      assert_close((double)jac[i][j] * (double)scale[j], want[i][j], rtol * (largest + 1e-30), 10 * rtol);
  }
}

static void check_scenes(const pneu_model *m, const char *what, double rtol)
{
  static const double opening[] = {1, 0.3, 0, -0.4, -1};
  int i, j;
  for (i = 0; i < COUNT(scenes); i++)
    for (j = 0; j < COUNT(opening); j++) {
      const pneu_input input = fixture_input(m, opening[j]);
      pneu_state s = fixture_rest(m, scenes[i].p, scenes[i].x, &input);
      s.v = (pneu_real)scenes[i].v;
      s.extra[0] = s.extra[m->n_extra ? m->n_extra - 1 : 0] = (pneu_real)0.37; /* off the kink at 0 */
      if (m->thermal)
        s.T = 340;
      if (s.mode != PNEU_MODE_DRIVEN && s.mode != PNEU_MODE_FIXED)
        s.mode = scenes[i].mode;
      check_note("%s, %s, %s, u = %g, p = %g, %s", what, pneu_gas_key(m->law.gas), pneu_flow_key(m->law.flow),
                 opening[j], scenes[i].p, pneu_mode_text(s.mode));
      check_jacobian(m, &s, &input, rtol);
    }
}

TEST(test_pneu_jacobian__each_law_and_mode__is_the_slope_of_the_right_hand_side)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  int gas, flow;
  p.supply_temperature = 280;
  p.ambient_temperature = 310;
  p.polytropic_index = (pneu_real)1.25;
  p.swept_ratio = (pneu_real)0.9;
  for (gas = 0; gas < PNEU_GAS_COUNT; gas++)
    for (flow = 0; flow < PNEU_FLOW_COUNT; flow++) {
      const pneu_model m = fixture_model(&p, gas, flow);
      check_scenes(&m, "free stem", TOL(1e-6, 2e-2));
    }
}

TEST(test_pneu_jacobian__given_position_or_pressure__is_the_slope_of_the_right_hand_side)
{
  const pneu_params p = fixture_params(FIXTURE_R1_400);
  int gas, i;
  for (gas = 0; gas < PNEU_GAS_COUNT; gas++)
    for (i = 1; i < 4; i++) {
      const pneu_model m = fixture_model_roles(&p, gas, PNEU_FLOW_CHOKED, i & 1, i >> 1);
      check_scenes(&m, i == 1 ? "pressure given" : i == 2 ? "position given" : "both given", TOL(1e-6, 2e-2));
    }
}

TEST(test_pneu_jacobian__vessel_and_regulator__is_the_slope_of_the_right_hand_side)
{
  pneu_params p = fixture_vessel(1e-4);
  fixture_rig rig = fixture_at(fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER), 1, 1e5, 0);
  check_note("vessel");
  check_jacobian(&rig.m, &rig.s, &rig.input, TOL(1e-6, 2e-2));
  p = fixture_params(FIXTURE_R1_400);
  p.proportional_band = (pneu_real)5e4;
  rig = fixture_at(fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED), 2.2e5, 2e5, 0.01);
  check_note("regulator");
  check_jacobian(&rig.m, &rig.s, &rig.input, TOL(1e-5, 5e-2));
}

TEST(test_pneu_jacobian__each_effect__is_the_slope_of_the_right_hand_side)
{
  int e, gas;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++)
    for (gas = 0; gas < PNEU_GAS_COUNT; gas++) {
      pneu_params p = fixture_params(FIXTURE_R1_400);
      const pneu_effect *effect = pneu_effect_at(e);
      const int first = pneu_effect_params(e, NULL);
      pneu_model m;
      *pneu_param_at(&p, first) = effect->param[0].value;
      m = fixture_model(&p, gas, PNEU_FLOW_PAPER);
      check_scenes(&m, effect->name, TOL(1e-3, 0.2));
    }
}

/* ---- inverse ---- */

static void check_inverse(int n, pneu_real a[PNEU_STATE_MAX][PNEU_STATE_MAX], double tol)
{
  pneu_real b[PNEU_STATE_MAX][PNEU_STATE_MAX];
  int i, j, k;
  memcpy(b, a, sizeof b);
  assert_int_equal(pneu_invert(n, b), PNEU_OK);
  for (i = 0; i < n; i++)
    for (j = 0; j < n; j++) {
      double sum = 0;
      for (k = 0; k < n; k++)
        sum += (double)a[i][k] * (double)b[k][j];
      assert_close(sum, i == j, tol, 0);
    }
}

TEST(test_pneu_invert__random_matrices__times_itself_is_one)
{
  pneu_real a[PNEU_STATE_MAX][PNEU_STATE_MAX];
  uint64_t seed = 5;
  int n, try, i, j;
  for (n = 1; n <= PNEU_STATE_MAX; n++)
    for (try = 0; try < 50; try++) {
      for (i = 0; i < n; i++)
        for (j = 0; j < n; j++)
          a[i][j] = (pneu_real)(fixture_random(&seed, -1, 1) + (i == (j + try) % n ? 3 * n : 0));
      check_note("n = %d, try %d", n, try);
      check_inverse(n, a, TOL(1e-12, 1e-4));
    }
}

TEST(test_pneu_invert__zeros_on_the_diagonal__are_pivoted)
{
  pneu_real cycle[PNEU_STATE_MAX][PNEU_STATE_MAX] = {{0, 2, 0}, {0, 0, 3}, {4, 0, 0}};
  pneu_real swapped[PNEU_STATE_MAX][PNEU_STATE_MAX] = {{0, 1}, {1, 0}};
  check_inverse(3, cycle, TOL(1e-15, 1e-6));
  check_inverse(2, swapped, TOL(1e-15, 1e-6));
}

TEST(test_pneu_invert__singular_or_nan__is_refused)
{
  pneu_real singular[PNEU_STATE_MAX][PNEU_STATE_MAX] = {{1, 2}, {2, 4}};
  pneu_real nan[PNEU_STATE_MAX][PNEU_STATE_MAX] = {{(pneu_real)NAN, 1}, {1, (pneu_real)NAN}};
  assert_int_equal(pneu_invert(2, singular), PNEU_E_SINGULAR);
  assert_int_equal(pneu_invert(2, nan), PNEU_E_SINGULAR);
}

/* Down to the last of the air: differences reach into the domain, not out of it. */
TEST(test_pneu_jacobian__chamber_without_air__is_refused)
{
  static const double band[] = {0, 5e4}; /* analytic, and by differences */
  int i;
  for (i = 0; i < COUNT(band); i++) {
    pneu_params p = fixture_params(FIXTURE_R1_400);
    pneu_real y[PNEU_STATE_MAX], f0[PNEU_STATE_MAX] = {0}, jac[PNEU_STATE_MAX][PNEU_STATE_MAX];
    fixture_rig rig;
    p.proportional_band = (pneu_real)band[i];
    rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED), 1, 1e5, 0.01);
    pneu_pack(&rig.m, &rig.s, y);
    y[0] = -p.ambient_pressure + (pneu_real)TOL(1e-4, 1);
    assert_int_equal(pneu_jacobian(&rig.m, &rig.s, &rig.input, y, f0, jac), PNEU_OK);
    y[0] = (pneu_real)-2e5;
    assert_int_equal(pneu_jacobian(&rig.m, &rig.s, &rig.input, y, f0, jac), PNEU_RETRY_STATE);
  }
}

/* The step at which I/(h gamma) - J of one state is 0. */
TEST(test_pneu_step_try__singular_matrix__is_refused)
{
  const pneu_real h = (pneu_real)1e-3, gamma = (pneu_real)(PNEU_ORDER == 5 ? 0.21193756319429014 : 0.57282);
  const pneu_params p = fixture_vessel(1e-3);
  const fixture_rig rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), 1, 1e5, 0);
  pneu_workspace work = {0};
  pneu_real error;
  pneu_pack(&rig.m, &rig.s, work.y0);
  assert_int_equal(pneu_step_prepare(&rig.m, &rig.s, &rig.input, &work), PNEU_OK);
  assert_int_equal(pneu_step_try(&rig.m, &rig.s, &rig.input, h, &work, &error), PNEU_OK);
  work.jac[0][0] = 1 / (gamma * h);
  assert_int_equal(pneu_step_try(&rig.m, &rig.s, &rig.input, h, &work, &error), PNEU_E_SINGULAR);
}

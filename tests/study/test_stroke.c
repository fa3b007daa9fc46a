/* The linear flow laws of the study against their formula. */
#include "../fixture.h"

#include "../../apps/study/stroke.h"

enum { P_UP = 450000 };

static pneu_model warm_model(int flow)
{
  const pneu_laws laws = {PNEU_GAS_ISOTHERMAL, flow, 0, 0};
  pneu_model model;
  pneu_params p = fixture_params(FIXTURE_R1_400);
  p.ambient_temperature = 320;
  p.gas_constant = 189;
  p.heat_ratio = 1.3;
  assert_int_equal(linear_model_init(&model, &p, &laws, NULL), PNEU_OK);
  return model;
}

static void check_law(int flow, double held)
{
  static const double ratio[] = {0, 0.2, 0.54, 0.55, 0.7, 0.999, 1};
  const pneu_model m = warm_model(flow);
  const double k = 2e-6 * sqrt(2 / (189.0 * 320));
  int i;
  for (i = 0; i < COUNT(ratio); i++) {
    const double r = ratio[i] > held ? ratio[i] : held;
    pneu_flow f;
    m.own_flow(&m, 2e-6, P_UP, 400, ratio[i] * P_UP, &f);
    check_note("ratio %g, held %g", ratio[i], held);
    assert_close(f.q, k * P_UP * (1 - r), 0, 1e-13);
    assert_close(f.dq_dup, ratio[i] > held ? k : k * (1 - held), 0, 1e-13);
    assert_close(f.dq_ddown, ratio[i] > held ? -k : 0, 0, 1e-13);
    assert_close(f.dq_dT, 0, 0, 0);
    assert_int_equal(f.choked, !(ratio[i] > held));
  }
}

TEST(test_linear_model_init__any_ratio__is_in_proportion_to_the_difference)
{
  check_law(LINEAR_FLOW, -1);
}

TEST(test_linear_model_init__below_the_critical_ratio__is_held)
{
  check_law(LINEAR_CHOKED_FLOW, pow(2 / 2.3, 1.3 / 0.3));
}

TEST(test_linear_model_init__law_of_the_library__is_that_of_pneu_model_init)
{
  pneu_model model;
  pneu_laws laws = {PNEU_GAS_ENERGY, PNEU_FLOW_ISO6358, 0, 0};
  const pneu_params p = fixture_params(FIXTURE_R1_400);
  assert_int_equal(linear_model_init(&model, &p, &laws, NULL), PNEU_OK);
  assert_null(model.own_flow);
  laws.flow = LINEAR_CHOKED_FLOW + 1;
  assert_int_equal(linear_model_init(&model, &p, &laws, NULL), PNEU_E_LAW);
}

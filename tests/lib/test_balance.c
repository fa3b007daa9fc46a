/* The balance of forces on a stem at rest, against closed forms and against a stem whose pressure runs. */
#include "../fixture.h"

/* The R1-400 with an external force, and one effect or none. */
static pneu_params loaded(const char *param, double value)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  p.external_force = 300;
  if (param)
    fixture_set(&p, param, value);
  return p;
}

static double balance(const pneu_params *p, double x, double force, int direction)
{
  const pneu_model m = fixture_model(p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  pneu_input input = fixture_input(&m, 1);
  input.force = (pneu_real)force;
  return (double)pneu_balance_pressure(&m, (pneu_real)x, &input, direction);
}

TEST(test_pneu_balance_pressure__base_model__is_spring_load_and_friction_over_area)
{
  static const double place[] = {0, 0.007, 0.02}, force[] = {0, 150, -4000};
  const pneu_params p = loaded(NULL, 0);
  int i, k, direction;
  for (i = 0; i < COUNT(place); i++)
    for (k = 0; k < COUNT(force); k++)
      for (direction = -1; direction <= 1; direction++) {
        const double sum = 4e5 * (place[i] + 0.01) + 300 + force[k] + 480 * direction;
        check_note("x = %g m, %g N, direction %d", place[i], force[k], direction);
        assert_close(balance(&p, place[i], force[k], direction), sum / 0.04, TOL(1e-9, 0.2), 0);
      }
}

TEST(test_pneu_balance_pressure__load_that_pulls__is_below_vacuum)
{
  const pneu_params p = loaded(NULL, 0);
  assert_close(balance(&p, 0, -20000, 0), (4e5 * 0.01 + 300 - 20000) / 0.04, TOL(1e-9, 0.5), 0);
}

TEST(test_pneu_balance_pressure__each_effect_on_forces__counts)
{
  static const double x = 0.015, spring = 4e5 * 0.025 + 300, A = 0.04, F = 480;
  const struct closed_form {
    const char *param;
    double value, middle, up;
  } form[] = {{"area_loss", 0.2, spring / (A * 0.85), (spring + F) / (A * 0.85)},
              {"spring_cubic", 5e7, (spring + 5e7 * x * x * x) / A, (spring + 5e7 * x * x * x + F) / A},
              {"friction_per_pressure", 4e-3, spring / A, (spring + F) / (A - 4e-3)},
              {"friction_slope", 0.5, spring / A, (spring + F * 1.375) / A},
              {"stribeck_excess", 0.3, spring / A, (spring + F * 1.3) / A}};
  int i;
  for (i = 0; i < COUNT(form); i++) {
    const pneu_params p = loaded(form[i].param, form[i].value);
    check_note("%s", form[i].param);
    assert_close(balance(&p, x, 0, 0), form[i].middle, TOL(1e-8, 0.5), 0);
    assert_close(balance(&p, x, 0, 1), form[i].up, TOL(1e-8, 0.5), 0);
  }
}

TEST(test_pneu_balance_pressure__seals_that_hold_whatever_the_pressure__has_none)
{
  const pneu_params p = loaded("friction_per_pressure", 0.05);
  assert_true(isnan(balance(&p, 0.01, 0, 1)));
  assert_close(balance(&p, 0.01, 0, -1), (4e5 * 0.02 + 300 - 480) / 0.09, TOL(1e-8, 0.5), 0);
}

/* Pressure at which a stem at rest leaves x while pressure runs away from the balance. */
static double leaves_at(const pneu_model *m, double x, int direction)
{
  pneu_input input = fixture_input(m, 0);
  const double from = (double)pneu_balance_pressure(m, (pneu_real)x, &input, 0);
  pneu_state s = fixture_rest(m, from, x, &input);
  fixture_events e;
  input.pressure_rate = (pneu_real)(1e4 * direction);
  fixture_run(m, &s, &input, 4, TOL(1e-8, 1e-5), &e);
  assert_true(e.n > 0);
  assert_int_equal(e.after[0], direction > 0 ? PNEU_MODE_UP : PNEU_MODE_DOWN);
  return e.p[0];
}

TEST(test_pneu_balance_pressure__each_effect_of_usual_size__is_where_a_stem_at_rest_breaks_away)
{
  static const double x = 0.01;
  int e, direction;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    pneu_params p = loaded(NULL, 0);
    pneu_param_info info;
    pneu_model m;
    const int first = pneu_effect_params(e, NULL);
    pneu_param_describe(first, &info);
    *pneu_param_at(&p, first) = info.value;
    m = fixture_pressed(&p);
    if (m.bristle) /* such a stem has no break-away */
      continue;
    for (direction = -1; direction <= 1; direction += 2) {
      const pneu_input input = fixture_input(&m, 0);
      check_note("%s, direction %d", pneu_effect_at(e)->name, direction);
      assert_close(leaves_at(&m, x, direction), pneu_balance_pressure(&m, (pneu_real)x, &input, direction),
                   TOL(1e-4, 20), 0);
    }
  }
}

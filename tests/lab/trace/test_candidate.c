/* apps/lab/trace/candidate: values that are held, let go, and held again */
#include "held.h"

static held_log h;

static int count_let_go(void)
{
  int j, n = 0;
  for (j = 0; j < h.c.u.n; j++)
    n += lab_unknown_is_let_go(&h.c.u.unknown[j]);
  return n;
}

TEST(test_lab_candidate_let_go__one_value_far_off__is_found_without_its_prior)
{
  second_rig truth = virtual_rig(11);
  const double true_supply = truth.supply *= 0.9; /* five tolerances */
  double held, before;
  int j;
  held_open(&h, &truth);
  j = lab_unknowns_find(&h.c.u, PNEU_PARAM_supply_pressure);
  held = h.c.u.unknown[j].value;
  before = h.c.quality.bic;
  succeed(lab_candidate_let_go(&h.c, &error));
  assert_int_equal(count_let_go(), 1);
  assert_true(lab_unknown_is_let_go(&h.c.u.unknown[j]));
  assert_true(h.c.quality.bic < before - 10); /* the prior had cost 25 */
  assert_true(fabs(h.c.u.unknown[j].value - true_supply) < fabs(held - true_supply));
  assert_close(h.c.u.unknown[j].value, true_supply, 0, 5e-3);
  assert_close(h.c.quality.strain, 5, 0, 0.05); /* it is still told as so far off */
}

TEST(test_lab_candidate_let_go__as_declared__keeps_all)
{
  const second_rig truth = virtual_rig(11);
  held_open(&h, &truth);
  succeed(lab_candidate_let_go(&h.c, &error));
  assert_int_equal(count_let_go(), 0);
}

/* An instrument that is taken out of what was found is as well known as before. */
TEST(test_lab_candidate_drop__gain_of_a_sensor__is_held_again)
{
  second_rig truth = virtual_rig(13);
  const lab_unknown *x;
  truth.position_gain = -0.02;
  held_open(&h, &truth);
  held_add(&h, "position_gain.position_gain", truth.position_gain);
  x = &h.c.u.unknown[lab_unknowns_find(&h.c.u, pneu_param_find("position_gain.position_gain"))];
  assert_false(lab_unknown_is_held(x));
  assert_true(x->value < -1e-3);
  assert_false(lab_candidate_has_cause(&h.c));
  lab_candidate_drop(&h.c, 0);
  assert_true(lab_unknown_is_held(x));
  assert_close(x->value, 0, 0, 0);
  assert_close(*pneu_param_at(&h.c.u.rig.params, x->index), 0, 0, 0);
}

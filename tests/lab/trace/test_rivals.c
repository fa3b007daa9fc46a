/* apps/lab/trace/rivals: an effect gives way to the one that the logs ask for, and keeps its place against all others
 */
#include "held.h"

#include "../../../apps/lab/trace/rivals.h"

static held_log h;

static void expect_effect(int which, const char *name)
{
  assert_string_equal(pneu_effect_at(h.c.found[which].effect)->name, name);
}

TEST(test_lab_rivals_try__second_best_effect__gives_way_to_the_true_one)
{
  second_rig truth = virtual_rig(11);
  double before;
  int changed;
  truth.area_slope = 0.05;
  held_open(&h, &truth);
  held_add(&h, "spring_hardening.spring_cubic", 5e7);
  before = h.c.quality.bic;
  succeed(lab_rivals_try(&h.c, &changed, &error));
  assert_true(changed);
  assert_int_equal(h.c.n_found, 1);
  expect_effect(0, "area_variation");
  assert_true(h.c.quality.bic < before - 10);
  assert_true(lab_is_noise(&h.c.quality));
  assert_close(h.c.u.unknown[lab_unknowns_find(&h.c.u, h.c.found[0].param)].value, truth.area_slope, 0, 0.1);
  assert_true(h.c.found[0].explained > 0.9);
}

TEST(test_lab_rivals_try__true_effects__stay_in_their_order)
{
  second_rig truth = virtual_rig(12);
  int changed;
  truth.area_slope = 0.05;
  truth.dead_time = 0.05;
  held_open(&h, &truth);
  held_add(&h, "area_variation.area_loss", 0.04);
  held_add(&h, "dead_time.dead_time", 0.04);
  succeed(lab_rivals_try(&h.c, &changed, &error));
  assert_false(changed);
  expect_effect(0, "area_variation");
  expect_effect(1, "dead_time");
}

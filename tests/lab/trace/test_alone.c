/* One value of the independent rig far off, and no other. */
#include "../../scratch.h"
#include "../../virtual.h"

#include "../../../apps/lab/fit/deviations.h"
#include "../../../apps/lab/trace/alone.h"

static lab_rig rig;
static lab_log bench;
static lab_run run;
static lab_unknowns u, with;
static int any;

static void find(const second_rig *g)
{
  const char *path = scratch_path("alone.csv");
  virtual_declare(&rig);
  rig.fit[rig.n_fit++] = PNEU_PARAM_dry_friction;
  virtual_record_brief(g, path);
  virtual_open(&rig, path, &bench, &run);
  succeed(lab_unknowns_open(&rig, &run, 1, &u, &error));
  succeed(lab_unknowns_fit(&u, LAB_ROUNDS_ALL, NULL, &error));
  succeed(lab_alone_find(&u, &with, &any, &error));
}

TEST(test_lab_alone_find__supply_far_too_low__is_let_go)
{
  second_rig g = virtual_rig(3);
  int j;
  g.supply *= 0.7;
  find(&g);
  assert_int_equal(any, 1);
  j = lab_unknowns_find(&with, PNEU_PARAM_supply_pressure);
  assert_true(j >= 0);
  assert_true(lab_unknown_is_let_go(&with.unknown[j]));
  assert_close(with.unknown[j].value, g.supply, 0, 0.01);
  assert_int_equal(with.n, u.n + 1);
}

/* A factor of both areas is compared with the sheet as any other value is. */
TEST(test_lab_alone_find__both_orifices_far_too_small__deviate)
{
  static lab_fit_result fit;
  second_rig g = virtual_rig(3);
  lab_deviation d;
  int j;
  g.fill_area *= 0.3;
  g.vent_area *= 0.3;
  find(&g);
  assert_int_equal(any, 1);
  j = lab_unknowns_find(&with, LAB_PARAM_ORIFICE_AREA);
  assert_true(j >= 0);
  succeed(lab_unknowns_intervals(&with, &fit, &error));
  assert_true(lab_deviation_of(&rig, &with, &fit, j, &d));
  assert_close(d.ratio, 0.3, 0, 0.02);
  assert_true(d.beyond);
}

TEST(test_lab_alone_find__sound_rig__has_none)
{
  const second_rig g = virtual_rig(3);
  find(&g);
  assert_int_equal(any, 0);
}

/* Where the time is spent nothing is tried. */
TEST(test_lab_alone_find__no_time__has_none)
{
  second_rig g = virtual_rig(3);
  g.supply *= 0.7;
  find(&g);
  u.until = 1e-9;
  succeed(lab_alone_find(&u, &with, &any, &error));
  assert_int_equal(any, 0);
}

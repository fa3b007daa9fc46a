/* What a candidate costs, whichever way its fit is done. */
#include "../../scratch.h"
#include "../../virtual.h"

#include "../../../apps/lab/fit/nuisance.h"
#include "../../../apps/lab/trace/refit.h"

enum { ROWS = 501, COMMANDS = 3 };

static lab_rig rig;
static lab_log recorded;
static lab_run run;

static second_rig true_rig(void)
{
  return virtual_rig(second_rig_default_r1_400().seed);
}

/* Record 5 s of a rig, and open the log to fit its friction. */
static void open_log(const second_rig *g, lab_unknowns *u)
{
  static const double t_cmd[COMMANDS] = {0.402, 2.003, 3.501}, u_cmd[COMMANDS] = {1, -1, 0.5};
  const second_course course = {.t_cmd = t_cmd, .u_cmd = u_cmd, .n = COMMANDS};
  const char *path = scratch_path("log.csv");
  virtual_write(g, &course, 5, 0.01, path);
  virtual_declare(&rig);
  rig.fit[rig.n_fit++] = PNEU_PARAM_dry_friction;
  virtual_open(&rig, path, &recorded, &run);
  succeed(lab_unknowns_open(&rig, &run, 1, u, &error));
}

/* Instants of commands are known to their rows: they cost nothing, whether they are fitted or vary unseen. With
 * friction alone to count, the price is the logarithm of the number of values. */
TEST(test_lab_candidate_fit__instants_of_commands__cost_nothing_either_way)
{
  static lab_candidate whole, folded;
  static lab_nuisance nuisance;
  const second_rig g = true_rig();
  const double price = log(2 * ROWS);
  size_t i;
  open_log(&g, &whole.u);
  assert_int_equal(whole.u.n, 1 + COMMANDS);
  succeed(lab_candidate_fit(&whole, LAB_ROUNDS_ALL, &error));
  folded.u = whole.u;
  succeed(lab_nuisance_open(&folded.u, &nuisance, &error));
  assert_int_equal(folded.u.n, 1);
  succeed(lab_candidate_fit(&folded, LAB_ROUNDS_ALL, &error));
  assert_close(whole.quality.bic - whole.quality.chi2, price, 1e-6, 0);
  assert_close(folded.quality.bic - folded.quality.chi2, price, 1e-6, 0);
  /* the instants come back with the slopes that they had, which the next fit begins with */
  succeed(lab_nuisance_return(&folded.u, &error));
  succeed(lab_unknowns_keep_slopes(&folded.u, &error));
  lab_nuisance_begin_with(&nuisance, &folded.u);
  assert_false(folded.u.has_slope[0]);
  whole.u.slopes = NULL;
  succeed(lab_unknowns_keep_slopes(&whole.u, &error));
  succeed(lab_unknowns_find_slopes(&whole.u, &error));
  assert_int_equal(whole.u.m, folded.u.m);
  for (i = whole.u.m; i < whole.u.m * (size_t)whole.u.n; i++)
    assert_close(folded.u.slopes[i], whole.u.slopes[i], 0.02, 0.5);
  for (i = 1; i < (size_t)whole.u.n; i++)
    assert_true(folded.u.has_slope[i]);
  lab_unknowns_forget_slopes(&whole.u);
  lab_unknowns_forget_slopes(&folded.u);
  lab_nuisance_close(&nuisance);
}

/* A clock is known to 5 ms: one that is 60 ms off is missing from what was declared, one that is 6 ms off is not. */
TEST(test_lab_candidate_take_instruments__clock__is_found_far_beyond_its_tolerance)
{
  static const double skew[] = {0.006, 0.06};
  static lab_candidate c;
  second_rig g = true_rig();
  int i, any;
  for (i = 0; i < 2; i++) {
    g.position_skew = skew[i]; /* [s] by which the position is older than the pressure beside it */
    memset(&c, 0, sizeof c);
    open_log(&g, &c.u);
    succeed(lab_unknowns_hold(&c.u, &error));
    succeed(lab_candidate_fit(&c, LAB_ROUNDS_ALL, &error));
    succeed(lab_candidate_take_instruments(&c, &any, &error));
    assert_int_equal(any, i);
    assert_int_equal(c.n_found, i);
  }
  assert_int_equal(c.found[0].effect, pneu_effect_find("channel_skew"));
  assert_close((double)*pneu_param_at(&c.u.rig.params, c.found[0].param), 0.06, 0, 0.02);
  assert_between(c.found[0].statistic, 50, 144); /* other tolerances take a part of it */
  assert_between(c.found[0].explained, 0.5, 1);
  assert_true(c.quality.strain < 3);
}

/* A leak beside values that are off within their tolerances, begun at a tenth of its size with the fitted values far
 * from where they belong: from the declared values it is found all the same. */
TEST(test_lab_candidate_stage__bent_values__are_left_behind)
{
  static lab_candidate c, staged;
  static lab_unknowns declared;
  const int leak = pneu_param_find("chamber_leak.leak_area");
  second_rig g = true_rig();
  g.leak_area = 2e-8;
  g.dead_volume *= 1.2;
  g.spring_rate *= 0.95;
  open_log(&g, &declared);
  succeed(lab_unknowns_fit(&declared, LAB_ROUNDS_ALL, NULL, &error));
  c.u = declared;
  succeed(lab_unknowns_add(&c.u, leak, 2e-9, &error));
  c.n_found = 1;
  c.found[0].effect = pneu_effect_find("chamber_leak");
  c.found[0].param = leak;
  c.found[0].term = -1;
  succeed(lab_unknowns_hold(&c.u, &error));
  c.u.unknown[lab_unknowns_find(&c.u, pneu_param_find("dry_friction"))].value = 2000;
  c.u.unknown[lab_unknowns_find(&c.u, pneu_param_find("dead_volume"))].value *= 3;
  lab_unknowns_take(&c.u);
  succeed(lab_candidate_stage(&c, &declared, &staged, &error));
  assert_int_equal(staged.n_found, 1);
  assert_true(staged.quality.chi2 < 1.1 * staged.quality.values);
  assert_close(staged.u.unknown[lab_unknowns_find(&staged.u, leak)].value, 2e-8, 0, 0.05);
  assert_close(staged.u.unknown[lab_unknowns_find(&staged.u, pneu_param_find("dead_volume"))].value, g.dead_volume, 0,
               0.05);
}

/* A fitted candidate in which a parameter changes. */
static lab_candidate begun(const char *param, double bic)
{
  lab_candidate c = {.quality = {.fitted = 1, .bic = bic}};
  c.u.rig.n_onsets = 1;
  c.u.rig.onset[0].param = pneu_param_find(param);
  return c;
}

/* A supply that falls goes before one that gives way, unless that is better by odds. */
TEST(test_lab_refit_put_simplest_first__value_that_changes__gives_way_to_odds)
{
  static lab_candidate c[3];
  const double alike = lab_constant(LAB_ALIKE_BIC);
  int i;
  for (i = 0; i < 2; i++) {
    c[0] = begun("supply_droop.supply_resistance", 100);
    c[1] = begun("chamber_leak.leak_area", 101);
    c[2] = begun("supply_pressure", 100 + alike + (i ? 1 : -1));
    lab_refit_put_simplest_first(c, 3);
    assert_int_equal(c[0].u.rig.onset[0].param,
                     pneu_param_find(i ? "supply_droop.supply_resistance" : "supply_pressure"));
    assert_int_equal(c[i ? 2 : 0].u.rig.onset[0].param, pneu_param_find("supply_pressure"));
  }
  c[0].quality.fitted = 0;
  assert_false(lab_refit_is_simpler(&c[0], &c[1]));
  assert_true(lab_refit_is_simpler(&c[1], &c[0]));
}

/* What a fit says of declared values: which are told, and in which order. */
#include "../../fixture.h"
#include "../../words.h"

#include "../../../apps/lab/fit/deviations.h"

/* Well determined at a value. */
static void put(lab_unknowns *u, lab_fit_result *fit, int kind, int index, double value, double declared)
{
  u->unknown[u->n] =
      (lab_unknown){.kind = kind, .index = index, .run = LAB_ALL_RUNS, .value = value, .prior = declared};
  fit->low[u->n] = 0.99 * value;
  fit->high[u->n] = 1.01 * value;
  fit->state[u->n++] = LAB_STATE_FREE;
}

/* A filter of 25 ms is five tolerances, a spring half as stiff again five, friction of three times its sheet four, and
 * a supply that loses 4 % two: by size alone the order would be another. */
TEST(test_lab_deviations_find__begins_within_the_log__is_told_first)
{
  static lab_unknowns u;
  static lab_fit_result fit;
  static lab_deviations all;
  static lab_rig rig;
  const int lag = pneu_param_find("pressure_lag.pressure_time");
  double supply;
  if (lag < 0)
    skip();
  lab_rig_default(&rig);
  supply = (double)rig.params.supply_pressure;
  rig.fit[rig.n_fit++] = PNEU_PARAM_spring_rate;
  rig.fit[rig.n_fit++] = PNEU_PARAM_dry_friction;
  rig.fit[rig.n_fit++] = lag;
  u.rig = rig;
  u.declared = rig.params;
  u.rig.onset[0] = (lab_rig_onset){.param = PNEU_PARAM_supply_pressure, .from = 5, .value = 0.96 * supply};
  u.rig.n_onsets = 1;
  put(&u, &fit, LAB_UNKNOWN_PARAM, lag, 0.025, 0);
  put(&u, &fit, LAB_UNKNOWN_PARAM, PNEU_PARAM_dry_friction, 3 * (double)rig.params.dry_friction, 480);
  put(&u, &fit, LAB_UNKNOWN_PARAM, PNEU_PARAM_spring_rate, 1.5 * (double)rig.params.spring_rate, 4e5);
  put(&u, &fit, LAB_UNKNOWN_ONSET, 0, 0.96 * supply, supply);
  succeed(lab_deviations_find(&rig, &u, &fit, INFINITY, &all, &error));
  assert_int_equal(all.n, 4);
  assert_string_equal(all.of[0].name, "supply_pressure");
  assert_string_equal(all.of[1].name, "spring_rate");
  assert_string_equal(all.of[2].name, "dry_friction");
  assert_string_equal(all.of[3].name, "pressure_lag");
  assert_int_equal(all.condition, LAB_CONDITION_DEVIATES);
}

/* Rows of 30 ms, whose changes of the command are somewhere between two of them. */
TEST(test_lab_deviations_find__lag_of_half_a_row__is_of_the_logger)
{
  static const double lag_of[] = {0.0149, 0.0151};
  const int lag = pneu_param_find("pressure_lag.pressure_time");
  int k;
  if (lag < 0)
    skip();
  for (k = 0; k < 4; k++) {
    static lab_unknowns u;
    static lab_fit_result fit;
    static lab_deviations all;
    static lab_rig rig;
    lab_run run = {0};
    run.n_channels = 1 + k / 2;
    lab_rig_default(&rig);
    rig.fit[rig.n_fit++] = lag;
    u.n = 0;
    u.rig = rig;
    u.declared = rig.params;
    u.run = &run;
    u.n_runs = 1;
    put(&u, &fit, LAB_UNKNOWN_PARAM, lag, lag_of[k % 2], 0);
    snprintf(u.unknown[0].unit, sizeof u.unknown[0].unit, "s");
    put(&u, &fit, LAB_UNKNOWN_INSTANT, 0, 0, 0);
    u.unknown[1].upper = 0.03;
    succeed(lab_deviations_find(&rig, &u, &fit, INFINITY, &all, &error));
    assert_int_equal(all.n, k != 0);
  }
}

/* A value so many deviations off what is declared. */
static void put_off(lab_rig *rig, lab_unknowns *u, lab_fit_result *fit, int param, double deviations)
{
  const double value = (double)*pneu_param_at(&rig->params, param) * 1.1, half = value / 11 * 1.96 / deviations;
  rig->fit[rig->n_fit++] = param;
  put(u, fit, LAB_UNKNOWN_PARAM, param, value, 0);
  fit->low[u->n - 1] = value - half;
  fit->high[u->n - 1] = value + half;
}

/* p is 2e-4, 0.016 and 0.037; of four values the limits are 0.0125, 0.025 and 0.0375 where one, two and three are told
 * (Benjamini and Hochberg 1995), so that the third goes with the first two and is not told beside one. */
TEST(test_lab_deviations_find__several_are_off__small_ones_are_told_with_them)
{
  static const double off[][4] = {{3.7, 2.4, 2.09, 0.3}, {3.7, 0.3, 2.09, 0.3}, {2.4, 0.3, 0.3, 0.3}};
  static const int params[] = {PNEU_PARAM_spring_rate, PNEU_PARAM_dry_friction, PNEU_PARAM_spring_preload,
                               PNEU_PARAM_dead_volume},
                   told[] = {3, 1, 0};
  size_t k, i;
  for (k = 0; k < sizeof off / sizeof off[0]; k++) {
    static const lab_unknowns none;
    static lab_unknowns u;
    static lab_fit_result fit;
    static lab_deviations all;
    static lab_rig rig;
    u = none;
    lab_rig_default(&rig);
    u.declared = rig.params;
    for (i = 0; i < 4; i++)
      put_off(&rig, &u, &fit, params[i], off[k][i]);
    succeed(lab_deviations_find(&rig, &u, &fit, INFINITY, &all, &error));
    assert_int_equal(all.n, told[k]);
  }
}

/* A dead volume a tenth off is well within ten tolerances of 30 %; friction of twelve times its sheet is 22 of 50 %,
 * and the preload is at its bound. */
TEST(test_lab_deviations_find__model_lacks_something__values_far_off_or_at_an_end_are_not_told)
{
  static const double trusted[] = {INFINITY, 10};
  static const int told[] = {3, 1};
  static lab_unknowns u;
  static lab_fit_result fit;
  static lab_deviations all;
  static lab_rig rig;
  int k;
  lab_rig_default(&rig);
  u.declared = rig.params;
  put_off(&rig, &u, &fit, PNEU_PARAM_dead_volume, 5);
  put_off(&rig, &u, &fit, PNEU_PARAM_spring_preload, 5);
  fit.state[1] = LAB_STATE_AT_UPPER;
  rig.fit[rig.n_fit++] = PNEU_PARAM_dry_friction;
  put(&u, &fit, LAB_UNKNOWN_PARAM, PNEU_PARAM_dry_friction, 12 * (double)rig.params.dry_friction, 480);
  for (k = 0; k < 2; k++) {
    succeed(lab_deviations_find(&rig, &u, &fit, trusted[k], &all, &error));
    assert_int_equal(all.n, told[k]);
  }
  assert_string_equal(all.of[0].name, "dead_volume");
}

/* A vent beside the fill orifice is off its sheet where their ratio has a tolerance; where the rig file only asks for
 * its size, it is an effect. */
TEST(test_lab_deviation_of__vent_beside_the_fill__is_one_where_their_ratio_is_known)
{
  static lab_unknowns u;
  static lab_fit_result fit;
  static lab_rig rig;
  const int vent = pneu_param_find("vent_restriction");
  lab_deviation d;
  if (vent < 0)
    skip();
  lab_rig_default(&rig);
  rig.fit[rig.n_fit++] = vent;
  u.rig = rig;
  u.declared = rig.params;
  put(&u, &fit, LAB_UNKNOWN_PARAM, vent, 0.1, 0);
  assert_false(lab_deviation_of(&rig, &u, &fit, 0, &d));
  rig.fit[rig.n_fit++] = LAB_PARAM_ORIFICE_AREA;
  assert_true(lab_deviation_of(&rig, &u, &fit, 0, &d));
  assert_string_equal(d.name, "vent_restriction");
  assert_true(d.beyond);
}

/* Whether the only unknown, a parameter at `found` within `half`, is beyond its tolerance.  In: units of the declared
 */
static int is_beyond(const lab_rig *rig, int param, double found, double half)
{
  static lab_unknowns u;
  static lab_fit_result fit;
  const double declared = lab_param_value(rig, param);
  lab_deviation d;
  u.n = 0;
  u.rig = *rig;
  u.declared = rig->params;
  put(&u, &fit, LAB_UNKNOWN_PARAM, param, found * declared, declared);
  fit.low[0] = (found - half) * declared;
  fit.high[0] = (found + half) * declared;
  assert_true(lab_deviation_of(rig, &u, &fit, 0, &d));
  return d.beyond;
}

/* Friction is declared to half of itself: a value that the log knows to a quarter is taken as it is, of another all of
 * its interval has to be beyond that. */
TEST(test_lab_deviation_of__value_hardly_known__is_beyond_where_all_of_its_interval_is)
{
  static const struct {
    double found, half;
    int beyond;
  } cases[] = {{1.45, 0.1, 0}, {1.7, 0.25, 1}, {1.7, 0.3, 0}, {2, 0.45, 1}, {0.3, 0.3, 0}, {0.3, 0.15, 1}};
  static lab_rig rig;
  size_t i;
  lab_rig_default(&rig);
  rig.fit[rig.n_fit++] = PNEU_PARAM_dry_friction;
  for (i = 0; i < sizeof cases / sizeof *cases; i++)
    assert_int_equal(is_beyond(&rig, PNEU_PARAM_dry_friction, cases[i].found, cases[i].half), cases[i].beyond);
}

/* Damping and viscous friction are known to half of themselves, and act as one: what both may be off counts. */
TEST(test_lab_deviation_of__damping__has_room_for_viscous_friction)
{
  static lab_rig rig;
  lab_rig_default(&rig);
  rig.params.damping = 1000;
  rig.params.viscous_friction = 500;
  rig.fit[rig.n_fit++] = PNEU_PARAM_damping;
  assert_false(is_beyond(&rig, PNEU_PARAM_damping, 0.3, 0.02));
  assert_true(is_beyond(&rig, PNEU_PARAM_damping, 0.2, 0.02));
}

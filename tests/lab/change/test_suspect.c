/* Two models of one rig, and what of the second makes a change likely. */
#include "../../check.h"

#include "../../../apps/lab/change/suspect.h"

static lab_unknowns then, now;
static lab_search_result of_then, of_now;
static lab_log rows;
static lab_run run;
static lab_suspect suspect[LAB_SUSPECTS_MAX];

static void give(lab_unknowns *u, lab_search_result *r, int param, double value, double deviation)
{
  const int j = u->n++;
  u->unknown[j] = (lab_unknown){.kind = LAB_UNKNOWN_PARAM, .index = param, .run = LAB_ALL_RUNS, .value = value};
  r->fit.deviation[j] = deviation;
}

static double t[] = {0, 1, 2, 3};

/* Friction of 100 N and a supply of 400 kPa, on either side, by 1 N and 100 Pa. */
static void two_sides(double friction, double supply)
{
  lab_rig_default(&then.rig);
  then.rig.params.dry_friction = 100;
  then.rig.params.supply_pressure = (pneu_real)400e3;
  rows.value[LAB_CHANNEL_TIME] = t;
  run = (lab_run){.log = &rows, .n = 4};
  now.run = &run;
  then.n = now.n = 0;
  then.rig.n_onsets = 0;
  of_then = of_now = (lab_search_result){.verdict = LAB_VERDICT_NONE};
  give(&then, &of_then, PNEU_PARAM_dry_friction, 100, 1);
  give(&then, &of_then, PNEU_PARAM_supply_pressure, 400e3, 100);
  now.rig = then.rig;
  give(&now, &of_now, PNEU_PARAM_dry_friction, friction, 1);
  give(&now, &of_now, PNEU_PARAM_supply_pressure, supply, 100);
}

static int find(void)
{
  return lab_suspects_find(&(lab_explained){&then, &of_then}, &(lab_explained){&now, &of_now}, suspect);
}

TEST(test_lab_suspects_find__values__differ_by_more_than_from_day_to_day)
{
  two_sides(150, 401e3); /* the supply by seven deviations, which a regulator does by itself */
  assert_int_equal(find(), 1);
  assert_int_equal(suspect[0].score.param, PNEU_PARAM_dry_friction);
  assert_close(suspect[0].score.size, 50, 0, 1e-9);
  assert_null(suspect[0].found);
  two_sides(115, 400e3);
  assert_int_equal(find(), 0);
}

TEST(test_lab_suspects_find__effect__is_asked_before_values)
{
  const int leak = pneu_param_find("leak_area");
  two_sides(300, 400e3);
  give(&now, &of_now, leak, 1e-8, 1e-9);
  of_now.verdict = LAB_VERDICT_EFFECT;
  of_now.n_found = 1;
  of_now.found[0] = (lab_found){.effect = pneu_effect_of(leak), .param = leak};
  assert_int_equal(find(), 2);
  assert_int_equal(suspect[0].score.param, leak);
  assert_true(suspect[0].found == &of_now.found[0]);
  assert_close(suspect[0].score.size, 1e-8, 0, 1e-20);
  assert_int_equal(suspect[1].score.param, PNEU_PARAM_dry_friction);
}

TEST(test_lab_suspects_find__model_that_explains_nothing__has_none)
{
  two_sides(300, 400e3);
  of_then.verdict = LAB_VERDICT_UNDECIDED;
  assert_int_equal(find(), 0);
  of_then.verdict = LAB_VERDICT_NONE;
  of_now.verdict = LAB_VERDICT_UNDECIDED;
  assert_int_equal(find(), 0);
}

TEST(test_lab_suspects_find__value_that_begins__has_the_row_of_its_onset)
{
  two_sides(100, 400e3);
  now.rig.n_onsets = 1;
  now.rig.onset[0].param = PNEU_PARAM_dry_friction;
  now.rig.onset[0].from = 1.5;
  now.unknown[now.n++] = (lab_unknown){.kind = LAB_UNKNOWN_ONSET, .index = 0, .run = LAB_ALL_RUNS, .value = 250};
  of_now.fit.deviation[now.n - 1] = 1;
  assert_int_equal(find(), 1);
  assert_int_equal(suspect[0].score.onset, 2);
  assert_close(suspect[0].score.size, 150, 0, 1e-9);
}

TEST(test_lab_suspects_find__what_cannot_change_or_is_not_known__is_none)
{
  static const char *const names[] = {"ambient_pressure", "leak_area", "start_temperature.start_temperature"};
  size_t i;
  two_sides(300, 400e3);
  of_now.fit.state[0] = LAB_STATE_UNDETERMINED;
  assert_int_equal(find(), 0);
  for (i = 0; i < sizeof names / sizeof *names; i++) { /* the weather, an effect that is declared, warm gas at first */
    const int param = lab_param_index(names[i]);
    if (param < 0)
      continue;
    two_sides(100, 400e3);
    give(&now, &of_now, param, 1e5, 1e-9);
    assert_int_equal(find(), 0);
  }
}

/* tests/blind: what is drawn, the files that closeloop gets, and the information limit. */
#include "../scratch.h"

#include "../../apps/lab/log/log.h"
#include "../../apps/lab/rig/rig.h"
#include "../../apps/lab/rig/rigkeys.h"
#include "limit.h"

static blind_trial draw(int number)
{
  blind_trial t;
  blind_draw(1, number, &t);
  return t;
}

/* First trial with one thing missing, of that name, in a log with these channels. */
static blind_trial draw_with(const char *effect, int channels)
{
  blind_trial t;
  int k;
  for (k = 0; k < 5000; k++) {
    t = draw(k);
    if (t.n_missing == 1 && strcmp(t.missing[0].effect->name, effect) == 0 && t.channels == channels)
      return t;
  }
  fail_msg("no trial with %s", effect);
  return t;
}

/* ---- draw ---- */

TEST(test_blind_draw__same_seed_and_number__same_trial)
{
  const blind_trial a = draw(7), b = draw(7), c = draw(27);
  blind_trial other_seed;
  blind_draw(2, 7, &other_seed);
  assert_memory_equal(&a, &b, sizeof a);
  assert_int_equal(a.kind, c.kind);
  assert_memory_not_equal(&a.fit, &c.fit, sizeof a.fit);
  assert_memory_not_equal(&a.fit, &other_seed.fit, sizeof a.fit);
}

TEST(test_blind_draw__many__kinds_and_effects_have_their_share)
{
  const int listed = blind_listed_count(), trials = 20 * listed;
  int kinds[BLIND_KINDS] = {0}, *drawn = calloc((size_t)blind_effect_count, sizeof *drawn), k;
  for (k = 0; k < trials; k++) {
    const blind_trial t = draw(k);
    kinds[t.kind]++;
    if (t.n_missing == 1)
      drawn[t.missing[0].effect - blind_effects]++;
  }
  assert_int_equal(kinds[BLIND_NOTHING], 3 * listed);
  assert_int_equal(kinds[BLIND_SINGLE], 11 * listed);
  assert_int_equal(kinds[BLIND_PAIR], 3 * listed);
  for (k = 0; k < listed; k++)
    assert_int_equal(drawn[k], 11);
  for (; k < blind_effect_count; k++)
    assert_between(drawn[k], 3 * listed / 4 - 1, 3 * listed / 4 + 1);
  free(drawn);
}

static void assert_size_in_range(const blind_missing *m, const second_rig *base)
{
  const double share = m->size / blind_scale_of(m->effect->scale, base);
  check_note("%s", m->effect->name);
  assert_between(fabs(share), m->effect->lo * (1 - 1e-12), m->effect->hi * (1 + 1e-12));
  assert_true(m->effect->either_sign || share > 0);
}

TEST(test_blind_draw__many__are_within_their_ranges)
{
  int k, i;
  for (k = 0; k < 400; k++) {
    const blind_trial t = draw(k);
    for (i = 0; i < t.n_missing; i++) {
      assert_size_in_range(&t.missing[i], &t.base);
      assert_int_equal(t.missing[i].effect->channels & ~t.channels, 0);
    }
    if (t.n_missing == 2)
      assert_string_not_equal(t.missing[0].effect->family, t.missing[1].effect->family);
    assert_between(t.base.fill_area / t.declared.fill_area, 0.8, 1.2);
    assert_close(t.base.vent_area, t.base.fill_area, 0, 1e-15);
    assert_between(t.base.dry_friction / t.declared.dry_friction, 0.8, 1.2);
    assert_close(t.base.area, t.declared.area, 0, 0);
    assert_between(t.spacing, 4e-3, 5e-3);
  }
}

TEST(test_blind_draw__commands__are_not_on_rows_and_differ_between_the_logs)
{
  int k, on_row = 0;
  size_t i;
  for (k = 0; k < 50; k++) {
    const blind_trial t = draw(k);
    assert_memory_not_equal(t.fit.u, t.holdout.u, sizeof t.fit.u);
    for (i = 0; i < t.fit.n; i++) {
      const double rows = t.fit.t[i] / t.spacing;
      on_row += fabs(rows - floor(rows + 0.5)) < 1e-6;
      assert_between(fabs(t.fit.u[i]), t.fit.u[i] == 0 ? 0 : 0.3, 1);
    }
  }
  assert_int_equal(on_row, 0);
}

TEST(test_blind_truth__nothing_missing__is_the_base_rig)
{
  const blind_trial t = draw_with("chamber_leak", BLIND_P | BLIND_X);
  const second_rig without = blind_truth(&t, 0), with = blind_truth(&t, BLIND_ALL);
  second_rig base = t.base;
  base.step = t.step;
  assert_memory_equal(&without, &base, sizeof base);
  assert_close(with.leak_area, t.missing[0].size, 0, 0);
}

TEST(test_blind_draw__any_rig__makes_its_whole_stroke)
{
  int k;
  for (k = 0; k < 24; k++) {
    const blind_trial t = draw(k);
    second_rig g = blind_truth(&t, 0);
    blind_rows rows;
    double high = 0;
    size_t i;
    g.step = 1e-4;
    g.position_noise = g.position_range = 0;
    succeed(blind_simulate(&g, &t.fit, t.spacing, &rows, &error));
    for (i = 0; i < rows.n; i++)
      high = fmax(high, rows.x[i]);
    check_note("trial %d", k);
    assert_close(high, g.stroke, 0, 1e-9);
    assert_between(rows.x[rows.n - 1], -1e-12, 0.9 * g.stroke);
    blind_rows_free(&rows);
  }
}

/* What no trial draws, by how its name begins. */
static const char *const undrawn[] = {
    "long_chamber",      /* theirs are short */
    "positioner",        /* these rigs have none */
    "start_temperature", /* these begin as warm as the room */
};

static int is_undrawn(const char *name)
{
  int i, any = 0;
  for (i = 0; i < (int)(sizeof undrawn / sizeof *undrawn); i++)
    any |= strncmp(name, undrawn[i], strlen(undrawn[i])) == 0;
  return any;
}

TEST(test_blind_effects__each_of_the_catalogue__is_drawn_under_its_name_and_equation)
{
  int i;
  for (i = 0; i < PNEU_EFFECT_COUNT; i++) {
    const blind_effect *e = blind_effect_named(pneu_effect_at(i)->name);
    if ((e == NULL) != is_undrawn(pneu_effect_at(i)->name))
      fail_msg("%s blind trial has %s", e ? "a" : "no", pneu_effect_at(i)->name);
    if (e)
      assert_string_equal(e->equation, pneu_effect_at(i)->equation);
  }
  for (i = 0; i < blind_listed_count(); i++)
    assert_true(pneu_effect_find(blind_effects[i].name) >= 0);
}

/* ---- Files ---- */

static void assert_same_file(const char *a, const char *b)
{
  char *one = scratch_read(a), *two = scratch_read(b);
  assert_string_equal(one, two);
  free(one);
  free(two);
}

TEST(test_blind_write_logs__twice__same_bytes)
{
  blind_trial t = draw(3);
  char a[600], b[600];
  t.step = 1e-4;
  succeed(blind_write_logs(&t, scratch_path("a"), &error));
  succeed(blind_write_logs(&t, scratch_path("b"), &error));
  snprintf(a, sizeof a, "%s/fit.csv", scratch_path("a"));
  snprintf(b, sizeof b, "%s/fit.csv", scratch_path("b"));
  assert_same_file(a, b);
}

/* What closeloop reads of the files of a trial is what was meant. */
static void assert_readable(int number)
{
  static lab_rig rig;
  blind_trial t = draw(number);
  const double ambient = t.declared.ambient;
  lab_log log;
  char path[600];
  t.step = 1e-4;
  t.fit.end = t.holdout.end = 0.5; /* enough to be read */
  check_note("trial %d", number);
  succeed(blind_write_logs(&t, scratch_path("read"), &error));
  snprintf(path, sizeof path, "%s/rig.cfg", scratch_path("read"));
  succeed(lab_rig_read(path, &rig, &error));
  assert_close(rig.params.spring_rate, t.declared.spring_rate, 0, 1e-9);
  assert_close(rig.params.viscous_friction + rig.params.damping, t.declared.viscous, 0, 1e-9);
  assert_close(rig.params.fill_area, t.declared.fill_area, 0, 1e-9);
  assert_close(rig.noise[LAB_CHANNEL_P], t.declared.pressure_noise, 0, 1e-5);
  assert_int_equal(rig.n_fit, BLIND_FITTED);
  snprintf(path, sizeof path, "%s/fit.csv", scratch_path("read"));
  succeed(lab_log_read(path, &rig.log, ambient, &log, &error));
  assert_int_equal(log.n, second_samples(t.fit.end, t.spacing));
  assert_int_equal(!!log.value[LAB_CHANNEL_P], !!(t.channels & BLIND_P));
  assert_int_equal(!!log.value[LAB_CHANNEL_X], !!(t.channels & BLIND_X));
  assert_int_equal(!!log.value[LAB_CHANNEL_T], !!(t.channels & BLIND_T));
  lab_log_free(&log);
}

TEST(test_blind_write_logs__every_kind_of_trial__is_read_by_closeloop)
{
  int k;
  for (k = 0; k < 60; k++)
    assert_readable(k);
}

/* ---- Limit ---- */

TEST(test_blind_projected__plane_in_space__leaves_the_third_axis)
{
  double column[2][3] = {{1, 1, 0}, {1, -3, 0}}, s[3] = {5, 7, 3};
  assert_close(blind_projected(&column[0][0], 2, s, 3), 9, 1e-12, 0);
}

TEST(test_blind_projected__same_column_twice__counts_once)
{
  double column[2][3] = {{1, 2, 2}, {2, 4, 4}}, s[3] = {1, 2, 3};
  assert_close(blind_projected(&column[0][0], 2, s, 3), 14 - 11.0 * 11.0 / 9, 1e-12, 0);
}

/* A bias of position cannot be seen better than by the mean of all rows: 5 sigma/sqrt(n). */
TEST(test_blind_limit__position_bias__is_somewhat_above_that_of_the_mean)
{
  const blind_trial t = draw_with("position_bias", BLIND_P | BLIND_X);
  const double n = (double)second_samples(t.fit.end, t.spacing), mean = 5 * t.base.position_noise / sqrt(n);
  double size, statistic;
  succeed(blind_limit(&t, 0, &size, &statistic, &error));
  assert_between(size / mean, 1, 3);
  assert_close(statistic, 25 * t.missing[0].size * t.missing[0].size / (size * size), 0, 1e-6);
}

TEST(test_blind_limit__other_size__is_the_same)
{
  blind_trial t = draw_with("chamber_leak", BLIND_P | BLIND_X);
  double size[2], statistic;
  succeed(blind_limit(&t, 0, &size[0], &statistic, &error));
  t.missing[0].size = 50 * size[0];
  succeed(blind_limit(&t, 0, &size[1], &statistic, &error));
  assert_close(size[1], size[0], 0, 0.05);
}

/* Not known to within a row, an instant hides a dead time shorter than that; known, it does not. */
TEST(test_blind_limit__dead_time__grows_with_the_spacing_of_rows)
{
  blind_trial t = draw_with("dead_time", BLIND_P | BLIND_X);
  double fine, coarse, statistic;
  t.spacing = 4e-3;
  succeed(blind_limit(&t, 0, &fine, &statistic, &error));
  t.spacing = 4e-2;
  succeed(blind_limit(&t, 0, &coarse, &statistic, &error));
  assert_between(coarse / fine, 3, 100);
}

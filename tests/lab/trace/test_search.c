/* From a log of the independent rig to the effect that the declared model lacks. */
#include "../../fixture.h"
#include "../../scratch.h"
#include "../../virtual.h"

#include "../../../apps/lab/check/logs.h"
#include "../../../apps/lab/fit/deviations.h"
#include "../../../apps/lab/fit/outliers.h"
#include "../../../apps/lab/trace/rounds.h"
#include "../../../apps/lab/trace/freeterms.h"

static double min_gain = 0.02;
static int declared_gas = PNEU_GAS_ISOTHERMAL;

static lab_rig rig;
static lab_log log_read;
static lab_run run;
static lab_unknowns u;
static lab_search_result result;
static lab_deviations all;

/* The declaration of it is off by a few per cent in what is fitted. */
static second_rig true_rig(void)
{
  return virtual_rig(7);
}

enum { COMMANDS = 5 };
static const double t_cmd[COMMANDS] = {0.402, 2.503, 4.001, 5.507, 7.204};
static const double brisk[COMMANDS] = {1, 0, -1, 0.5, -0.5};

static void declare(void)
{
  virtual_declare(&rig);
  rig.laws.gas = declared_gas;
  rig.params.polytropic_index = (pneu_real)1.3;
  rig.params.spring_rate = (pneu_real)3.9e5;
  rig.params.dry_friction = 500;
  rig.fit[rig.n_fit++] = LAB_PARAM_ORIFICE_AREA;
  rig.fit[rig.n_fit++] = PNEU_PARAM_dry_friction;
  rig.fit[rig.n_fit++] = PNEU_PARAM_spring_rate;
  rig.fit[rig.n_fit++] = PNEU_PARAM_spring_preload;
}

/* A log of the true rig under some commands, and the declared model fitted to it; within tolerances if `held`. */
static void open_log(const second_rig *g, const double *u_cmd, int held)
{
  const second_course course = {.t_cmd = t_cmd, .u_cmd = u_cmd, .n = COMMANDS};
  virtual_write(g, &course, 10, 0.01, scratch_path("log.csv"));
  declare();
  virtual_open(&rig, scratch_path("log.csv"), &log_read, &run);
  assert_int_equal(run.n_instants, COMMANDS);
  succeed(lab_unknowns_open(&rig, &run, 1, &u, &error));
  succeed(lab_unknowns_fit(&u, LAB_ROUNDS_ALL, NULL, &error));
  if (held) {
    succeed(lab_unknowns_hold(&u, &error));
    succeed(lab_unknowns_fit(&u, LAB_ROUNDS_ALL, NULL, &error));
  }
}

/* Run the loop on such a log; where it is held, with what deviates. */
static void run_loop(const second_rig *g, const double *u_cmd, int held)
{
  lab_search_options options;
  lab_search_options_default(&options);
  options.max_effects = 1;
  options.min_gain = min_gain;
  open_log(g, u_cmd, held);
  succeed(lab_search_run(&u, &options, &result, &error));
  if (held)
    succeed(lab_deviations_find(&rig, &u, &result.fit, INFINITY, &all, &error));
}

/* The same of brisk commands, and what it names first. */
static void assert_named(const second_rig *g, const char *name)
{
  run_loop(g, brisk, 0);
  assert_int_equal(result.verdict, LAB_VERDICT_EFFECT);
  assert_string_equal(pneu_effect_at(result.found[0].effect)->name, name);
}

static const lab_deviation *deviation(const char *name)
{
  int i;
  for (i = 0; i < all.n; i++)
    if (!strcmp(all.of[i].name, name))
      return &all.of[i];
  return NULL;
}

/* A dead volume a fifth off is within its tolerance: nothing is missing, and what is off is told. */
TEST(test_lab_search_run__dead_volume_within_its_tolerance__is_a_deviation_and_no_effect)
{
  const lab_deviation *d;
  second_rig g = true_rig();
  g.dead_volume *= 1.2;
  run_loop(&g, brisk, 1);
  assert_int_equal(result.verdict, LAB_VERDICT_NONE);
  assert_int_equal(all.condition, LAB_CONDITION_AS_DECLARED);
  assert_non_null(d = deviation("dead_volume"));
  assert_between(1.2, d->lower / 4e-5, d->upper / 4e-5);
  assert_true(d->held && !d->beyond);
}

/* Friction of twice its declared value is wear, whatever explains the log. */
TEST(test_lab_search_run__friction_beyond_its_tolerance__deviates)
{
  const lab_deviation *d;
  second_rig g = true_rig();
  g.dry_friction = 960;
  run_loop(&g, brisk, 1);
  assert_int_equal(result.verdict, LAB_VERDICT_NONE);
  assert_int_equal(all.condition, LAB_CONDITION_DEVIATES);
  assert_non_null(d = deviation("dry_friction"));
  assert_close(d->ratio, 1.92, 0, 0.1);
  assert_true(d->beyond && !d->held);
}

/* Chi-square is a parabola here, so that an interval that was made ten times too narrow comes back, and one that is
 * right stays. */
TEST(test_lab_deviations_widen__too_narrow__is_as_wide_as_chi2_says)
{
  static lab_fit_result fit;
  const second_rig g = true_rig();
  const double narrower[] = {1, 10};
  int i, j, k;
  open_log(&g, brisk, 1);
  j = lab_unknowns_find(&u, PNEU_PARAM_spring_rate);
  for (i = 0; i < 2; i++) {
    double wide;
    succeed(lab_unknowns_intervals(&u, &fit, &error));
    wide = fit.high[j] - fit.low[j];
    u.declared.spring_rate = (pneu_real)(u.unknown[j].value - 2 * wide);
    fit.high[j] = u.unknown[j].value + wide / 2 / narrower[i];
    fit.low[j] = u.unknown[j].value - wide / 2 / narrower[i];
    for (k = 0; k < u.n; k++)
      fit.covariance[k][j] /= narrower[i] * narrower[i];
    succeed(lab_deviations_widen(&u, &fit, &error));
    check_note("%g of %g", fit.high[j] - fit.low[j], wide);
    assert_close(fit.high[j] - fit.low[j], wide, 0, 0.1);
  }
}

/* Whether an effect was found first, or is told as one that the log cannot tell from what was. */
static int is_told(const char *name)
{
  const int effect = pneu_effect_find(name);
  int i, any = result.found[0].effect == effect;
  for (i = 0; i < result.found[0].n_alike; i++)
    any |= result.found[0].alike[i] == effect;
  return any;
}

/* Pressure follows position, so that friction may grow with either; values fitted beside one of them, and held beside
 * the other, do not tell them apart. */
TEST(test_lab_search_run__friction_over_position_and_tolerances__over_pressure_is_alike)
{
  second_rig g = true_rig();
  g.friction_position = 0.12;
  g.dead_volume *= 0.76;
  g.spring_rate *= 1.17;
  run_loop(&g, brisk, 1);
  assert_int_equal(result.verdict, LAB_VERDICT_EFFECT);
  assert_int_equal(result.n_found, 1);
  assert_true(is_told("friction_position") && is_told("friction_pressure"));
}

/* What no value within its tolerance does is named. */
TEST(test_lab_search_run__leak_and_tolerances__is_one_effect_of_the_mass)
{
  second_rig g = true_rig();
  g.leak_area = 0.02 * g.vent_area;
  g.dead_volume *= 1.2;
  run_loop(&g, brisk, 1);
  assert_int_equal(result.verdict, LAB_VERDICT_EFFECT);
  assert_int_equal(result.n_found, 1);
  assert_string_equal(pneu_effect_at(result.found[0].effect)->equation, "mass"); /* it may be the porous one */
}

TEST(test_lab_search_run__nothing_missing__says_none_and_finds_the_parameters)
{
  const second_rig g = true_rig();
  run_loop(&g, brisk, 0);
  assert_int_equal(result.verdict, LAB_VERDICT_NONE);
  assert_int_equal(result.n_found, 0);
  assert_close(result.after.in_noise[LAB_CHANNEL_P], 1, 0.08, 0);
  assert_close(result.after.in_noise[LAB_CHANNEL_X], 1, 0.08, 0);
  assert_close(u.rig.params.spring_rate, 4e5, 0, 2e-3);
  assert_close(u.rig.params.dry_friction, 480, 0, 2e-2);
}

TEST(test_lab_search_run__noisier_than_declared__is_noise_all_the_same)
{
  second_rig g = true_rig();
  g.pressure_noise *= 1.25;
  g.position_noise *= 1.25;
  run_loop(&g, brisk, 0);
  assert_int_equal(result.verdict, LAB_VERDICT_NONE);
  assert_close(result.after.in_noise[LAB_CHANNEL_P], 1.25, 0.1, 0);
}

/* The fit bends so far that the slope of the missing film has the wrong sign, and the truth is at its bound. */
TEST(test_lab_search_run__adiabatic_chamber__lacks_heat_transfer)
{
  second_rig g = true_rig();
  g.gas = SECOND_ENERGY;
  g.heat = 0;
  assert_named(&g, "heat_transfer");
  assert_close(result.after.in_noise[LAB_CHANNEL_P], 1, 0.08, 0);
}

/* Declared is an exponent between isothermal and adiabatic; it is a film that lets heat pass, and is found. */
TEST(test_lab_search_run__film_declared_as_an_exponent__lacks_heat_transfer)
{
  second_rig g = true_rig();
  g.gas = SECOND_ENERGY;
  g.heat = 3;
  declared_gas = PNEU_GAS_POLYTROPIC;
  assert_named(&g, "heat_transfer");
  declared_gas = PNEU_GAS_ISOTHERMAL;
  assert_close(*pneu_param_at(&u.rig.params, result.found[0].param), 3, 0, 0.03);
  assert_close(result.after.in_noise[LAB_CHANNEL_P], 1, 0.08, 0);
}

TEST(test_lab_search_run__polytropic_chamber__lacks_its_exponent)
{
  second_rig g = true_rig();
  fixture_need("chamber_exponent");
  g.gas = SECOND_ENERGY;
  g.exponent = 1.2;
  assert_named(&g, "chamber_exponent");
  assert_close((double)*pneu_param_at(&u.rig.params, result.found[0].param), 0.2, 0.01, 0);
  assert_close(result.after.in_noise[LAB_CHANNEL_P], 1, 0.08, 0);
  g = true_rig();
  g.rate_exponent = 1.2;
  assert_named(&g, "chamber_exponent");
  assert_close((double)*pneu_param_at(&u.rig.params, result.found[0].param), 0.2, 0.01, 0);
  assert_close(result.after.in_noise[LAB_CHANNEL_P], 1, 0.08, 0);
}

TEST(test_lab_search_run__leak__is_named_and_sized)
{
  second_rig g = true_rig();
  fixture_need("chamber_leak");
  g.leak_area = 1.5e-8;
  assert_named(&g, "chamber_leak");
  assert_int_equal(result.n_found, 1);
  assert_close(*pneu_param_at(&u.rig.params, result.found[0].param), 1.5e-8, 0, 0.05);
  assert_true(result.before.in_noise[LAB_CHANNEL_P] > 2 * result.after.in_noise[LAB_CHANNEL_P]);
  assert_close(result.after.in_noise[LAB_CHANNEL_P], 1, 0.08, 0);
  assert_int_equal(result.n_path, 2);
  assert_close(result.path[0].errors.in_noise[LAB_CHANNEL_P], result.before.in_noise[LAB_CHANNEL_P], 0, 1e-3);
  assert_close(result.path[1].errors.chi2, result.after.chi2, 0, 0);
}

static int is_listed(const char *name)
{
  int i, any = 0;
  for (i = 0; i < result.n_listed; i++)
    any |= !strcmp(pneu_effect_at(result.listed[i])->name, name);
  return any;
}

/* What takes less off the error than is asked for is listed, or added where that is plain and leaves white noise; least
 * of all is an error that falls because commands that are held to straight lines are let go. */
TEST(test_lab_search_run__small_leak__is_added_where_it_is_plain)
{
  static const double share[] = {0.0013, 0.002, 0.0035};
  static const int plain[] = {0, 0, 1};
  second_rig g = true_rig();
  int i;
  min_gain = 0.1;
  for (i = 0; i < 3; i++) {
    g.leak_area = share[i] * g.vent_area;
    run_loop(&g, brisk, 0);
    check_note("leak of %g of the vent orifice", share[i]);
    assert_int_equal(result.verdict, plain[i] ? LAB_VERDICT_EFFECT : LAB_VERDICT_NONE);
    assert_int_equal(result.n_found, plain[i]);
    assert_int_equal(result.n_listed > 0, !plain[i]);
    assert_int_equal(result.n_steps == 1, !plain[i]); /* no refit of what its score says is small */
    assert_int_equal(is_listed("chamber_leak"), !plain[i]);
  }
  min_gain = 0.02;
}

/* Bonferroni: the level of a single score is that of all, shared by the slopes that were tried. */
TEST(test_lab_search_run__many_slopes__share_the_level)
{
  const second_rig g = true_rig();
  lab_search_options options;
  lab_search_options_default(&options);
  run_loop(&g, brisk, 0);
  assert_true(result.scores.tests >= result.scores.n && result.scores.n > 10);
  assert_close(result.level * result.scores.tests, options.alpha, 0, 1e-12);
}

/* Friction of a place, which the catalogue does not have, under commands that go through the whole stroke. The bump
 * falls to 15 % of its peak 2.07 mm from its middle, where it no longer counts as acting; knots lie 0.3 mm apart. */
TEST(test_lab_search_run__friction_bump__is_a_force_at_its_place)
{
  static const double through[COMMANDS] = {1, 0.9, -1, 0.5, -0.5};
  second_rig g = true_rig();
  const pneu_term *term = &u.rig.term[0];
  char text[LAB_WHERE_TEXT];
  double from, to, level, peak;
  g.bump = 300;
  g.bump_at = 12e-3;
  g.bump_width = 1.5e-3;
  run_loop(&g, through, 0);
  assert_int_equal(result.verdict, LAB_VERDICT_UNLISTED);
  assert_int_equal(result.n_found, 1);
  assert_int_equal(result.found[0].effect, -1);
  assert_int_equal(result.found[0].term, 0);
  assert_string_equal(lab_free_term_equation(term), "force");
  assert_int_equal(term->equation, PNEU_TERM_FRICTION);
  assert_int_equal(term->argument, PNEU_TERM_OVER_POSITION);
  assert_contains(lab_free_term_where(term, text), "both directions");
  assert_null(strstr(text, "everywhere"));
  lab_free_term_stretch(term, &from, &to, &level, &peak);
  assert_close(from, 12e-3 - 2.07e-3, 0.5e-3, 0);
  assert_close(to, 12e-3 + 2.07e-3, 0.5e-3, 0);
  assert_close(peak, 300, 0, 0.1);
  assert_true(result.before.in_noise[LAB_CHANNEL_X] > 2 * result.after.in_noise[LAB_CHANNEL_X]);
  assert_close(result.after.in_noise[LAB_CHANNEL_P], 1, 0.08, 0);
  assert_close(result.after.in_noise[LAB_CHANNEL_X], 1, 0.08, 0);
}

/* ---- Values that stand alone ---- */

static void count(void *context, const char *what)
{
  (void)what;
  ++*(int *)context;
}

/* A leak that values within their tolerances do not explain is still there without three values that stand alone: no
 * search is made for it again, and the values stay. */
TEST(test_lab_search_without_outliers__leak_and_three_accidents__is_not_looked_for_again)
{
  static const size_t row[] = {330, 470, 900};
  static lab_logs bench;
  const second_course course = {.t_cmd = t_cmd, .u_cmd = brisk, .n = COMMANDS};
  second_rig g = true_rig();
  lab_search_options options;
  lab_unknowns declared;
  lab_outliers out = {0};
  double *p, struck[COUNT(row)];
  int i, progress = 0;
  fixture_need("chamber_leak");
  g.leak_area = 1.5e-8;
  virtual_write(&g, &course, 10, 0.01, scratch_path("log.csv"));
  declare();
  succeed(lab_logs_add(&bench, &rig, scratch_path("log.csv"), &error));
  p = bench.log[0].value[LAB_CHANNEL_P];
  for (i = 0; i < COUNT(row); i++)
    struck[i] = p[row[i]] += 10 * g.pressure_noise;
  succeed(lab_unknowns_open(&rig, bench.run, bench.n, &u, &error));
  succeed(lab_unknowns_fit(&u, LAB_ROUNDS_ALL, NULL, &error));
  declared = u;
  lab_search_options_default(&options);
  options.max_effects = 1;
  options.on_progress = count;
  options.context = &progress;
  succeed(lab_search_run(&u, &options, &result, &error));
  assert_int_equal(result.verdict, LAB_VERDICT_EFFECT);
  assert_true(progress > 0);
  assert_int_equal(result.window, 0);
  assert_false(result.cut_short);
  succeed(lab_outliers_take(&declared, bench.log, &out, &error));
  assert_int_equal(out.n, COUNT(row));
  assert_int_equal(out.n_soon, 0);
  lab_outliers_put_back(&out);
  lab_outliers_free(&out);
  lab_unknowns_view(&declared, 0);
  progress = 0;
  succeed(lab_search_without_outliers(&options, &bench, &declared, &u, &result, &error));
  assert_int_equal(progress, 0);
  assert_int_equal(result.verdict, LAB_VERDICT_EFFECT);
  for (i = 0; i < COUNT(row); i++)
    assert_close(p[row[i]], struck[i], 0, 0);
  lab_logs_close(&bench);
}

/* A stem that sticks and slips under slow commands: no model keeps in step with it row by row. */
TEST(test_lab_search_run__stick_slip__is_seen_coarsely_and_named)
{
  static const double slow[COMMANDS] = {0.06, 0.05, -0.05, 0.06, -0.05};
  second_rig g = true_rig();
  fixture_need("stribeck_friction");
  g.stribeck = 0.5;
  g.stribeck_velocity = 2e-3;
  g.step = 2e-5;
  run_loop(&g, slow, 0);
  assert_true(result.window > 0);
  assert_int_equal(result.verdict, LAB_VERDICT_EFFECT);
  assert_int_equal(result.n_found, 1);
  assert_string_equal(pneu_effect_at(result.found[0].effect)->name, "stribeck_friction");
  assert_close(*pneu_param_at(&u.rig.params, result.found[0].param), 0.5, 0, 0.2);
  assert_int_equal(u.window, 0); /* and handed back as it came */
}

/* ---- What is noted ---- */

TEST(test_lab_search_list_small__again_and_again__is_there_once)
{
  static lab_search_result r;
  int i;
  for (i = 0; i < 3 * LAB_SCORES_MAX; i++)
    lab_search_list_small(&r, i / 2);
  assert_int_equal(r.n_listed, LAB_SCORES_MAX);
  assert_int_equal(r.listed[1], 1);
}

/* The last model is the one that the search ends with; those before it may be missing. */
TEST(test_lab_rounds_note_way__full__has_the_last)
{
  static lab_search_result r;
  static lab_candidate c;
  int i;
  lab_rig_default(&c.u.rig);
  for (i = 0; i <= LAB_SEARCH_PATH; i++) {
    c.quality.chi2 = i;
    lab_rounds_note_way(&r, &c);
  }
  assert_int_equal(r.n_path, LAB_SEARCH_PATH);
  assert_close(r.path[LAB_SEARCH_PATH - 1].chi2, LAB_SEARCH_PATH, 0, 0);
  assert_close(r.path[0].chi2, 0, 0, 0);
}

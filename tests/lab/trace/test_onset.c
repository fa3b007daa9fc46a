/* When what is found begins within a log of the independent rig. */
#include "../../scratch.h"
#include "../../virtual.h"

#include "../../../apps/lab/fit/deviations.h"
#include "../../../apps/lab/trace/early.h"
#include "../../../apps/lab/trace/search.h"

enum { ROWS = 1401 };

static lab_rig rig;
static lab_log log_read;
static lab_run run;
static lab_unknowns u;
static lab_search_result result;
static lab_deviations all;

static second_rig true_rig(void)
{
  return virtual_rig(11);
}

static void declare(void)
{
  virtual_declare(&rig);
  rig.params.spring_rate = (pneu_real)3.9e5;
  rig.fit[rig.n_fit++] = LAB_PARAM_ORIFICE_AREA;
  rig.fit[rig.n_fit++] = PNEU_PARAM_spring_rate;
  rig.fit[rig.n_fit++] = PNEU_PARAM_spring_preload;
}

/* The log of a rig that is another from some time on, and the declared model fitted to it. */
static void open_log(const second_rig *first, const second_rig *later, double change)
{
  virtual_record(first, later, change, scratch_path("log.csv"));
  declare();
  virtual_open(&rig, scratch_path("log.csv"), &log_read, &run);
  succeed(lab_unknowns_open(&rig, &run, 1, &u, &error));
  succeed(lab_unknowns_fit(&u, LAB_ROUNDS_ALL, NULL, &error));
}

static void close_loop(const second_rig *first, const second_rig *later, double change)
{
  lab_search_options options;
  open_log(first, later, change);
  lab_search_options_default(&options);
  options.max_effects = 1;
  succeed(lab_search_run(&u, &options, &result, &error));
  succeed(lab_deviations_find(&rig, &u, &result.fit, INFINITY, &all, &error));
}

/* The only onset is that of a parameter: it holds the truth, and the fit of its value as well. */
static void assert_begins(const char *name, double change, double value)
{
  const int param = pneu_param_find(name), j = lab_unknowns_find_onset(&u, param);
  const lab_onset *begin = &result.begin[0];
  assert_int_equal(u.rig.n_onsets, 1);
  assert_true(j >= 0);
  assert_true(begin->known);
  check_note("%s since %g [%g, %g], truth %g", name, begin->t, begin->low, begin->high, change);
  assert_between(change, begin->low, begin->high);
  assert_between(begin->t, begin->low, begin->high);
  assert_close(begin->t, u.rig.onset[0].from, 0, 0);
  assert_close(u.unknown[j].value, value, 0, 0.05);
}

/* Whether an effect is the one that was found, or one that the log cannot tell from it. */
static int is_said(const char *name)
{
  const lab_found *found = &result.found[0];
  int i, said = !strcmp(pneu_effect_at(found->effect)->name, name);
  for (i = 0; i < found->n_alike; i++)
    said |= !strcmp(pneu_effect_at(found->alike[i])->name, name);
  return said;
}

TEST(test_lab_search_run__leak_that_begins__is_named_since_when)
{
  const second_rig first = true_rig();
  second_rig later = first;
  later.leak_area = 6e-8;
  close_loop(&first, &later, 5.43);
  assert_int_equal(result.verdict, LAB_VERDICT_EFFECT);
  assert_int_equal(result.n_found, 1);
  assert_true(is_said("chamber_leak"));
  assert_between(result.found[0].explained, 0.5, 1.01);
  assert_int_equal(u.rig.onset[0].param, result.found[0].param);
  assert_between(5.43, result.begin[0].low, result.begin[0].high);
  assert_true(result.begin[0].high - result.begin[0].low < 0.5);
}

/* The stem is at rest as its friction rises: when it does shows at the next move only. */
TEST(test_lab_search_run__friction_that_rises__deviates_since_then)
{
  const second_rig first = true_rig();
  second_rig later = first;
  later.dry_friction = 1300;
  close_loop(&first, &later, 7.61);
  assert_int_equal(result.verdict, LAB_VERDICT_NONE);
  assert_int_equal(result.n_found, 0);
  assert_begins("dry_friction", 7.61, 1300);
  assert_int_equal(all.condition, LAB_CONDITION_DEVIATES);
  assert_string_equal(all.of[0].name, "dry_friction");
  assert_close(all.of[0].ratio, 1300.0 / 480, 0.05, 0);
  assert_int_equal(all.of[0].param, pneu_param_find("dry_friction"));
}

TEST(test_lab_search_run__supply_that_falls__deviates_since_then)
{
  const second_rig first = true_rig();
  second_rig later = first;
  later.supply = 0.8 * first.supply;
  close_loop(&first, &later, 6.57);
  assert_int_equal(result.verdict, LAB_VERDICT_NONE);
  assert_begins("supply_pressure", 6.57, 0.8 * 4e5);
  assert_string_equal(all.of[0].name, "supply_pressure");
}

TEST(test_lab_search_run__nothing_begins__has_no_onset)
{
  second_rig g = true_rig();
  close_loop(&g, NULL, 0);
  assert_int_equal(result.verdict, LAB_VERDICT_NONE);
  assert_int_equal(u.rig.n_onsets, 0);
  g.leak_area = 2e-8;
  close_loop(&g, NULL, 0);
  assert_int_equal(result.verdict, LAB_VERDICT_EFFECT);
  assert_int_equal(u.rig.n_onsets, 0);
}

/* ---- From the beginning of a run ---- */

static lab_candidate within, onset;
static size_t sound; /* rows of the run that leave only noise */

static void fit_early(const second_rig *first, const second_rig *later, double change)
{
  static lab_onset_scores begins;
  open_log(first, later, change);
  within.u = u;
  within.n_found = within.quality.fitted = 0;
  succeed(lab_candidate_hold(&within, &error));
  succeed(lab_early_fit(&within, 0, 0.01, &onset, &begins, &sound, &error));
}

TEST(test_lab_early_fit__spring_that_breaks__begins_where_the_run_leaves_the_model)
{
  const second_rig first = true_rig();
  second_rig later = first;
  later.spring_rate *= 0.7;
  fit_early(&first, &later, 6.57);
  assert_false(lab_is_noise(&within.quality));
  assert_between(log_read.value[LAB_CHANNEL_TIME][sound], 0.8 * 6.57, 1.1 * 6.57);
  assert_int_equal(onset.quality.fitted, 1);
  assert_int_equal(onset.u.rig.onset[0].param, pneu_param_find("spring_rate"));
  assert_between(6.57, onset.begin[0].low, onset.begin[0].high);
  assert_close(onset.u.rig.onset[0].value, later.spring_rate, 0, 0.02);
}

TEST(test_lab_early_fit__nothing_begins__is_the_fit_of_the_whole_run)
{
  const second_rig g = true_rig();
  fit_early(&g, NULL, 0);
  assert_int_equal(onset.quality.fitted, 0);
  assert_int_equal(within.quality.fitted, 1);
  assert_int_equal((int)within.quality.values, 2 * ROWS);
  assert_true(lab_is_noise(&within.quality));
}

TEST(test_lab_early_fit__missing_from_the_start__finds_neither)
{
  second_rig g = true_rig();
  g.leak_area = 2e-8;
  fit_early(&g, NULL, 0);
  assert_int_equal(onset.quality.fitted, 0);
  assert_false(lab_is_noise(&within.quality));
}

/* Whether a leak still begins at 5 s after it was asked to act throughout. */
static int leak_begins(const second_rig *first, const second_rig *later)
{
  static const double at = 5;
  const int leak = pneu_param_find("leak_area");
  lab_onset begin = {1, at, at, at};
  double chi2;
  open_log(first, later, at);
  succeed(lab_unknowns_add_onset(&u, leak, at, 1e-8, &error));
  succeed(lab_unknowns_fit(&u, LAB_ROUNDS_ALL, &chi2, &error));
  succeed(lab_onset_extend(&u, lab_unknowns_find_onset(&u, leak), 0.01, &chi2, &begin, &error));
  assert_close(u.unknown[lab_unknowns_find_onset(&u, leak)].value, 2e-8, 0, 0.05);
  return begin.known;
}

TEST(test_lab_onset_extend__leak__begins_only_where_it_does)
{
  const second_rig tight = true_rig();
  second_rig leaks = tight;
  leaks.leak_area = 2e-8;
  assert_true(leak_begins(&tight, &leaks));
  assert_false(leak_begins(&leaks, NULL));
}

/* What a sensor shows is a state that goes on when the supply falls. */
TEST(test_lab_run_predict__supply_falls_before_a_slow_sensor__goes_on)
{
  const second_rig g = true_rig();
  const double from = 2.5; /* [s] both orifices are shut */
  double *y = malloc(2 * ROWS * sizeof *y), most = 0;
  size_t i;
  open_log(&g, NULL, 0);
  *pneu_param_at(&rig.params, pneu_param_find("pressure_lag.pressure_time")) = (pneu_real)0.05;
  succeed(lab_unknowns_add_onset(&u, pneu_param_find("supply_pressure"), from, 3e5, &error));
  rig.onset[rig.n_onsets++] = u.rig.onset[0];
  succeed(lab_run_predict(&run, &(lab_episode){0, &rig}, 1, NULL, 1e-6, y, &error));
  for (i = 1; i < run.n; i++)
    if (fabs(log_read.value[LAB_CHANNEL_TIME][i] - from) < 0.2)
      most = fmax(most, fabs(y[i] - y[i - 1]));
  assert_true(y[run.n / 6] > 1e5);
  check_note("the pressure shown moves by %g Pa from row to row", most);
  assert_true(most < 50);
  free(y);
}

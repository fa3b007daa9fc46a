/* What a fit looks for: two runs of a log that the model itself has made, with known values for all of it. */
#include "../../fixture.h"
#include "../../virtual.h"

#include "../../../apps/lab/base/array.h"
#include "../../../apps/lab/fit/errors.h"
#include "../../../apps/lab/fit/linear.h"
#include "../../../apps/lab/fit/windowed.h"
#include "../../../apps/lab/fit/unknowns.h"
#include "../../../apps/lab/trace/candidate.h"

enum { ROWS = 81, RUNS = 2, SWITCHES = 2, FIRST_SWITCH = 8, DATA = RUNS * ROWS * 2 };
static const double spacing = 0.05; /* [s] */
static const double sigma_p = 300, sigma_x = 2e-5;

static lab_rig rig;
static lab_unknowns u;
static lab_run run[RUNS];
static lab_log run_log;
static double t[RUNS * ROWS], command[RUNS * ROWS], p[RUNS * ROWS], x[RUNS * ROWS];
static double theta[LAB_FIT_MAX]; /* values of the unknowns */
static double r[DATA + LAB_FIT_MAX], other[DATA + LAB_FIT_MAX], column[DATA + LAB_FIT_MAX];

/* Index of a parameter, of what can be fitted, by its name; skips the test where an effect was trimmed away. */
static int index_of(const char *name)
{
  const int i = lab_param_index(name);
  if (i < 0)
    skip();
  return i;
}

static double param_of(const lab_rig *model, const char *name)
{
  pneu_params params = model->params;
  return (double)*pneu_param_at(&params, index_of(name));
}

static void fit_list(const char *name, int per_log)
{
  rig.fit[rig.n_fit] = index_of(name);
  rig.fit_per_log[rig.n_fit++] = (unsigned char)per_log;
}

/* The R1-400 with 40 cm3 of dead volume. */
static void declare(void)
{
  virtual_declare(&rig);
  rig.noise[LAB_CHANNEL_P] = sigma_p;
  rig.noise[LAB_CHANNEL_X] = sigma_x;
}

/* Two runs of 4 s, shut, then filled by a share, then vented by another; nothing measured yet. */
static void write_commands(void)
{
  static size_t first[RUNS + 1] = {0, ROWS, RUNS * ROWS};
  static const double fill[RUNS] = {1, 0.7}, vent[RUNS] = {-1, -0.6};
  int k, i;
  run_log = virtual_log(RUNS * ROWS, t, command, p, x);
  run_log.n_runs = RUNS;
  run_log.run = first;
  for (k = 0; k < RUNS; k++)
    for (i = 0; i < ROWS; i++) {
      t[k * ROWS + i] = spacing * i;
      command[k * ROWS + i] = i < FIRST_SWITCH ? 0 : i < ROWS / 2 ? fill[k] : vent[k];
      p[k * ROWS + i] = x[k * ROWS + i] = 0;
    }
}

static void close_all(void)
{
  int k;
  for (k = 0; k < RUNS; k++)
    lab_run_close(&run[k]);
}

/* Everything about `rig`, with a log of zeros. */
static void open_empty(void)
{
  int k;
  close_all();
  write_commands();
  for (k = 0; k < RUNS; k++)
    succeed(lab_run_open(&rig, &run_log, (size_t)k, &run[k], &error));
  succeed(lab_unknowns_open(&rig, run, RUNS, &u, &error));
}

/* Let the model measure one run: its rig, and how early its commands were. */
static void measure_run(const lab_rig *truth, int k, const double early[SWITCHES])
{
  double y[2 * ROWS];
  succeed(lab_run_predict(&run[k], &(lab_episode){0, truth}, 1, early, u.tol, y, &error));
  memcpy(p + k * ROWS, y, ROWS * sizeof *y);
  memcpy(x + k * ROWS, y + ROWS, ROWS * sizeof *y);
}

/* Both runs, with the switches in the middle of their brackets. */
static void measure(const lab_rig *truth)
{
  const double early[SWITCHES] = {spacing / 2, spacing / 2};
  int k;
  for (k = 0; k < RUNS; k++)
    measure_run(truth, k, early);
}

/* Two shared parameters, the orifices of each run, and the switches. */
static void open_usual(void)
{
  declare();
  fit_list("dry_friction", 0);
  fit_list("orifice_area", 1);
  fit_list("spring_rate", 0);
  open_empty();
}

/* The same, with a log of the rig that is declared. */
static void open_measured(void)
{
  open_usual();
  measure(&rig);
}

/* The same, integrated so closely that differences are smooth. */
static void open_closely(void)
{
  open_usual();
  u.tol = 1e-9;
  measure(&rig);
  lab_unknowns_values(&u, theta);
}

enum { FRICTION, AREA_1, AREA_2, SPRING, SWITCH_1, USUAL = SWITCH_1 + RUNS * SWITCHES };

static void assert_all_zero(const double *value, size_t n)
{
  size_t i;
  for (i = 0; i < n; i++) {
    check_note("entry %d", (int)i);
    assert_close(value[i], 0, 0, 0);
  }
}

static double size_of(const double *value, size_t n)
{
  double sum = 0;
  size_t i;
  for (i = 0; i < n; i++)
    sum += value[i] * value[i];
  return sqrt(sum / (double)n);
}

/* ---- What there is to find ---- */

TEST(test_lab_unknowns_open__fit_list__has_shared_and_own_and_switches)
{
  static const char *const name[USUAL] = {"dry_friction", "orifice_area.1", "orifice_area.2", "spring_rate",
                                          "switch_1.1",   "switch_1.2",     "switch_2.1",     "switch_2.2"};
  static const int whose[USUAL] = {LAB_ALL_RUNS, 0, 1, LAB_ALL_RUNS, 0, 0, 1, 1};
  static const double value[USUAL] = {480, 1, 1, 4e5, 0.025, 0.025, 0.025, 0.025};
  int j;
  open_usual();
  assert_int_equal(u.n, USUAL);
  for (j = 0; j < USUAL; j++) {
    check_note("%s", name[j]);
    assert_string_equal(u.unknown[j].name, name[j]);
    assert_int_equal(u.unknown[j].run, whose[j]);
    assert_close(u.unknown[j].value, value[j], 0, 1e-12);
    assert_close(u.unknown[j].first, value[j], 0, 1e-12);
  }
  assert_int_equal(u.n_rows, DATA);
  assert_int_equal(u.n_data, DATA);
  assert_int_equal(u.m, DATA + USUAL);
}

/* Known to a tolerance in each run, and no nuisance that all share; a default of a kind is none. */
TEST(test_lab_unknowns_open__own_value_with_a_tolerance__has_a_prior_in_each_run)
{
  int k;
  declare();
  fit_list("spring_preload", 1);
  open_empty();
  for (k = 0; k < RUNS; k++)
    assert_close(u.unknown[k].spread, 0, 0, 0);
  rig.tolerance[PNEU_PARAM_spring_preload] = 2e-3;
  open_empty();
  for (k = 0; k < RUNS; k++) {
    assert_int_equal(u.unknown[k].run, k);
    assert_close(u.unknown[k].spread, 2e-3, 0, 0);
    assert_close(u.unknown[k].prior, (double)rig.params.spring_preload, 0, 0);
    assert_int_equal(lab_unknown_is_known(&u.unknown[k]), 0);
    u.unknown[k].value += 1e-3 * (k + 1);
  }
  assert_close((double)lab_unknowns_expected(&u).params.spring_preload, u.unknown[0].prior, 0, 0);
  close_all();
}

/* Of 3 and 6: 4.5. How far another may be from that two do not say: that of 3, 6 and 9 would be sqrt(9 (1 + 1/3)). */
TEST(test_lab_unknowns_expected__own_values__are_their_mean_and_spread)
{
  lab_rig next;
  open_usual();
  rig.fit_per_log[0] = 1; /* and one that nothing is expected of: a factor on both orifices */
  open_empty();
  assert_int_equal(u.unknown[1].run, 1);
  u.unknown[0].value = 3;
  u.unknown[1].value = 6;
  next = lab_unknowns_expected(&u);
  assert_close((double)next.params.dry_friction, 4.5, 0, 1e-6);
  assert_true(isnan(next.tolerance[PNEU_PARAM_dry_friction]));
  assert_true(isnan(next.tolerance[LAB_PARAM_ORIFICE_AREA]));
  u.unknown[u.n] = u.unknown[1];
  u.unknown[u.n++].value = 9;
  next = lab_unknowns_expected(&u);
  assert_close((double)next.params.dry_friction, 6, 0, 1e-6);
  assert_close(next.tolerance[PNEU_PARAM_dry_friction], sqrt(12), 0, 1e-12);
  close_all();
}

/* Ten tolerances of 50 % are the most, also of what is added later; of what is declared as none there is no such end.
 */
TEST(test_lab_unknowns_stay_near__far_more_than_declared__is_ten_tolerances_off)
{
  const double upper = (double)lab_param_info(PNEU_PARAM_damping).upper;
  double declared;
  declare();
  declared = (double)rig.params.damping;
  assert_true(declared > 0);
  fit_list("damping", 0);
  open_empty();
  u.unknown[0].value = 5.9 * declared;
  assert_int_equal(lab_unknowns_is_far(&u, 10), 0);
  u.unknown[0].value = 26 * declared;
  assert_int_equal(lab_unknowns_is_far(&u, 10), 1);
  lab_unknowns_stay_near(&u, 10);
  assert_close(u.unknown[0].value, 6 * declared, 0, 1e-6);
  assert_close((double)u.rig.params.damping, 6 * declared, 0, 1e-6);
  assert_int_equal(lab_unknowns_is_far(&u, 10), 1); /* at its end, as good as beyond */
  succeed(lab_unknowns_add(&u, PNEU_PARAM_spring_rate, 1, &error));
  assert_close(u.unknown[u.n - 1].upper, 2 * (double)rig.params.spring_rate, 0, 1e-12);
  succeed(lab_unknowns_add(&u, LAB_PARAM_ORIFICE_AREA, 4, &error));
  assert_close(u.unknown[u.n - 1].value, 3, 0, 1e-12);
  rig.params.damping = 0;
  open_empty();
  lab_unknowns_stay_near(&u, 10);
  assert_close(u.unknown[0].upper, upper, 0, 0);
  close_all();
}

/* What the fit would find simulates for long and is no valve: no damping, a positioner that opens fully at any error.
 */
TEST(test_lab_unknowns_add__damping_and_gain__stay_near_what_is_usual)
{
  const int gain = pneu_param_find("positioner.gain");
  declare();
  *pneu_param_at(&rig.params, gain) = 20;
  open_empty();
  succeed(lab_unknowns_add(&u, gain, 500, &error));
  assert_close(u.unknown[u.n - 1].value, 200, 0, 1e-12);
  assert_close(u.unknown[u.n - 1].upper, 200, 0, 1e-12);
  succeed(lab_unknowns_add(&u, PNEU_PARAM_damping, 0, &error));
  assert_close(u.unknown[u.n - 1].value, 0.02 * (double)rig.params.damping, 0, 1e-12);
  close_all();
}

/* A value that is fitted or held, as a multiple of the declared one. */
static void put(int param, double times)
{
  u.unknown[lab_unknowns_find(&u, param)].value = times * lab_param_value(&rig, param);
}

/* Of several values far off one at least was said to be known, and what one cause moves together is one. */
TEST(test_lab_candidate_is_far__values_of_two_causes_one_not_fitted__is_far)
{
  declare();
  fit_list("spring_rate", 0);
  fit_list("damping", 0);
  open_empty();
  succeed(lab_unknowns_hold(&u, &error));
  put(PNEU_PARAM_fill_area, 2);
  put(PNEU_PARAM_vent_area, 2);
  assert_false(lab_candidate_is_far(&u)); /* orifices of another make */
  put(PNEU_PARAM_dead_volume, 2.5);
  assert_true(lab_candidate_is_far(&u));
  put(PNEU_PARAM_fill_area, 1);
  put(PNEU_PARAM_vent_area, 1);
  put(PNEU_PARAM_dead_volume, 1);
  put(PNEU_PARAM_spring_rate, 1.5);
  put(PNEU_PARAM_damping, 3);
  assert_false(lab_candidate_is_far(&u)); /* both are fitted */
  put(PNEU_PARAM_moving_mass, 1.7);
  assert_true(lab_candidate_is_far(&u));
  close_all();
}

/* A value that runs away towards nothing is as far off. */
TEST(test_lab_unknowns_is_far__a_tenth_of_an_area__is_far)
{
  declare();
  fit_list("area", 0);
  open_empty();
  u.unknown[0].value = 0.81 * (double)rig.params.area;
  assert_int_equal(lab_unknowns_is_far(&u, 10), 0);
  u.unknown[0].value = 0.1 * (double)rig.params.area;
  assert_int_equal(lab_unknowns_is_far(&u, 10), 1);
  lab_unknowns_stay_near(&u, 10);
  assert_close(u.unknown[0].value, 0.8 * (double)rig.params.area, 0, 1e-12);
  close_all();
}

TEST(test_lab_unknowns_open__switches__lie_within_their_brackets)
{
  int j;
  open_usual();
  for (j = SWITCH_1; j < USUAL; j++) {
    const lab_unknown *s = &u.unknown[j];
    assert_int_equal(s->kind, LAB_UNKNOWN_INSTANT);
    assert_int_equal(s->index, (j - SWITCH_1) % SWITCHES);
    assert_close(s->lower, 0, 0, 0);
    assert_close(s->upper, spacing, 1e-12, 0);
    assert_close(s->prior, spacing / 2, 1e-12, 0);
    assert_close(s->spread, spacing / sqrt(12), 1e-12, 0); /* of a uniform distribution */
    assert_string_equal(s->unit, "s");
  }
  for (j = 0; j < SWITCH_1; j++)
    assert_close(u.unknown[j].spread, 0, 0, 0); /* nothing is known of the others */
}

TEST(test_lab_unknowns_hold__declared_values__have_a_prior_and_are_never_lost)
{
  int j;
  open_usual();
  succeed(lab_unknowns_hold(&u, &error));
  j = lab_unknowns_find(&u, PNEU_PARAM_moving_mass);
  assert_true(j >= USUAL);
  assert_close(u.unknown[j].prior, (double)u.declared.moving_mass, 0, 1e-12);
  assert_close(u.unknown[j].spread, 0.2 * (double)u.declared.moving_mass, 0, 1e-12);
  assert_close(u.unknown[j].lower, 0.2 * (double)u.declared.moving_mass, 0, 1e-12); /* it would ring without a mass */
  assert_true(lab_unknown_is_held(&u.unknown[j]));
  assert_false(lab_unknown_is_held(&u.unknown[lab_unknowns_find(&u, PNEU_PARAM_dry_friction)])); /* it is fitted */
}

/* Damping and viscous friction are one coefficient: the one known less well is held, and none beside the other. */
TEST(test_lab_unknowns_hold__damping_and_viscous_friction__are_one)
{
  declare();
  rig.params.damping = 900;
  rig.params.viscous_friction = 1000;
  open_empty();
  succeed(lab_unknowns_hold(&u, &error));
  assert_true(lab_unknowns_find(&u, PNEU_PARAM_viscous_friction) >= 0);
  assert_int_equal(lab_unknowns_find(&u, PNEU_PARAM_damping), -1);
  declare();
  fit_list("damping", 0);
  open_empty();
  succeed(lab_unknowns_hold(&u, &error));
  assert_int_equal(lab_unknowns_find(&u, PNEU_PARAM_viscous_friction), -1);
}

/* What was held stays in the model as it is; a lag that is too short to act, held or fitted, is none. */
TEST(test_lab_unknowns_settle__lag_that_does_not_act__is_none)
{
  const int lag = pneu_param_find("position_lag.position_time"), late = pneu_param_find("pressure_lag.pressure_time");
  int held;
  open_empty();
  succeed(lab_unknowns_hold(&u, &error));
  succeed(lab_unknowns_add(&u, late, 1e-10, &error)); /* let go: it is no longer held */
  held = lab_unknowns_find(&u, lag);
  assert_true(held >= 0);
  u.unknown[held].value = 1e-10;
  u.unknown[lab_unknowns_find(&u, PNEU_PARAM_moving_mass)].value = 2.5;
  lab_unknowns_take(&u);
  assert_true(*pneu_param_at(&u.rig.params, lag) > 0);
  lab_unknowns_settle(&u, NULL);
  assert_close(*pneu_param_at(&u.rig.params, lag), 0, 0, 0);
  assert_close(*pneu_param_at(&u.rig.params, late), 0, 0, 0);
  assert_close(u.rig.params.moving_mass, 2.5, 1e-12, 0);
  assert_true(lab_unknowns_find(&u, late) >= 0);
  assert_close(u.unknown[lab_unknowns_find(&u, late)].value, 0, 0, 0);
}

/* An actuator larger by half in all that is fitted or held shows the same: the fit ends at the size that is declared.
 */
TEST(test_lab_unknowns_fit__actuator_of_another_size__is_as_large_as_declared)
{
  static const int grown[] = {PNEU_PARAM_area,        PNEU_PARAM_dead_volume,  PNEU_PARAM_spring_rate,
                              PNEU_PARAM_moving_mass, PNEU_PARAM_dry_friction, PNEU_PARAM_damping,
                              PNEU_PARAM_fill_area,   PNEU_PARAM_vent_area};
  int i, j;
  declare();
  rig.params.viscous_friction = 0;
  fit_list("dry_friction", 0);
  fit_list("spring_rate", 0);
  fit_list("damping", 0);
  open_empty();
  measure(&rig);
  succeed(lab_unknowns_hold(&u, &error));
  for (i = 0; i < COUNT(grown); i++) {
    j = lab_unknowns_find(&u, grown[i]);
    assert_true(j >= 0);
    u.unknown[j].value *= 1.5;
  }
  succeed(lab_unknowns_fit(&u, LAB_ROUNDS_ALL, NULL, &error));
  for (i = 0; i < COUNT(grown); i++) {
    j = lab_unknowns_find(&u, grown[i]);
    check_note("%s", u.unknown[j].name);
    if (grown[i] != PNEU_PARAM_damping) /* which the log hardly shows */
      assert_close(u.unknown[j].value, (double)*pneu_param_at(&rig.params, grown[i]), 0, 0.01);
  }
}

/* Beside an error of many times the noise, priors of what is held count as if that were the noise; others do not. */
TEST(test_lab_unknowns_weigh_held__model_that_misfits__has_priors_that_count_by_what_is_left)
{
  double misfit;
  int j, k;
  open_measured();
  succeed(lab_unknowns_hold(&u, &error));
  succeed(lab_unknowns_weigh_held(&u, &error));
  assert_close(u.misfit, 1, 0, 0);
  for (j = 0; j < RUNS * ROWS; j++)
    x[j] += 30 * sigma_x * (j % 2 ? 1 : -1);
  succeed(lab_unknowns_residuals(&u, NULL, r, &error));
  misfit = size_of(r, DATA);
  assert_true(misfit > 10);
  succeed(lab_unknowns_weigh_held(&u, &error));
  assert_close(u.misfit, misfit, 0, 1e-12);
  lab_unknowns_values(&u, theta);
  j = lab_unknowns_find(&u, PNEU_PARAM_moving_mass);
  theta[j] += 0.5 * u.unknown[j].spread;
  theta[SWITCH_1] = u.unknown[SWITCH_1].prior + u.unknown[SWITCH_1].spread;
  succeed(lab_unknowns_residuals(&u, theta, r, &error));
  for (k = 0; k < u.n; k++)
    assert_close(r[DATA + k], k == j ? -0.5 * misfit : k == SWITCH_1 ? -1 : 0, 1e-9, 0);
}

/* A zero of each log in a model that errs by many times the noise: it is where the sum of squares is least if its
 * tolerance counts by what is left (some per cent less than before the fit, by which it counted), and so a few
 * tolerances off and not hundreds. */
TEST(test_lab_unknowns_fit__own_value_in_a_model_that_errs__counts_by_what_is_left)
{
  const double tolerance = 2 * sigma_x;
  double slope, misfit;
  int k;
  declare();
  fit_list("position_bias.position_bias", 1);
  rig.tolerance[rig.fit[0]] = tolerance;
  open_empty();
  measure(&rig);
  for (k = 0; k < RUNS * ROWS; k++)
    x[k] += 100 * sigma_x * (k % 4 ? 1 : -1);
  succeed(lab_unknowns_fit(&u, LAB_ROUNDS_ALL, NULL, &error));
  lab_unknowns_values(&u, theta);
  succeed(lab_unknowns_residuals(&u, NULL, r, &error));
  misfit = size_of(r, DATA);
  assert_true(misfit > 50);
  assert_close(u.own_misfit, misfit, 0, 1e-9);
  for (k = 0; k < RUNS; k++) {
    assert_close(lab_unknown_reach(&u, &u.unknown[k]), tolerance / misfit, 0, 1e-9);
    assert_true(fabs(theta[k]) > 0.1 * tolerance && fabs(theta[k]) < 5 * tolerance);
    succeed(lab_unknowns_slope(&u, theta, r, k, column, &error));
    slope = lab_dot(column, r, u.m);
    assert_between(slope / sqrt(lab_dot(column, column, u.m) * lab_dot(r, r, u.m)), -0.05, 0.05);
  }
}

TEST(test_lab_unknowns_open__nothing_to_fit__has_the_switches_alone)
{
  declare();
  open_empty();
  assert_int_equal(u.n, RUNS * SWITCHES);
  assert_int_equal(u.unknown[0].kind, LAB_UNKNOWN_INSTANT);
}

/* The second run again, its command on and off by turns for so many rows, and the unknowns. */
static void open_alternating(int rows)
{
  int i;
  for (i = 0; i < ROWS; i++)
    command[ROWS + i] = (i / rows) % 2;
  lab_run_close(&run[1]);
  succeed(lab_run_open(&rig, &run_log, 1, &run[1], &error));
  succeed(lab_unknowns_open(&rig, run, RUNS, &u, &error));
}

/* An instant for each change where there are ten rows for each, and else one share of a row for all of them. */
TEST(test_lab_unknowns_open__command_that_changes_often__has_one_timing)
{
  const lab_unknown *all = &u.unknown[SWITCHES];
  declare();
  open_empty();
  open_alternating(10);
  assert_int_equal(u.n, SWITCHES + 8);
  open_alternating(9);
  assert_int_equal(u.n, SWITCHES + 8);
  open_alternating(8);
  assert_int_equal(u.n, SWITCHES + 1);
  assert_int_equal(all->kind, LAB_UNKNOWN_INSTANT);
  assert_int_equal(all->index, LAB_ALL_INSTANTS);
  assert_int_equal(all->run, 1);
  assert_close(all->upper, 1, 0, 0);
  assert_close(all->prior, 0.5, 0, 0);
  assert_close(all->spread, 1 / sqrt(12), 1e-12, 0);
}

/* ... and that share brings all changes forward by as much of the row before each. */
TEST(test_lab_unknowns_residuals__command_that_changes_often__is_matched_by_its_timing)
{
  double early[20], y[2 * ROWS];
  size_t k;
  declare();
  open_empty();
  open_alternating(8);
  for (k = 0; k < run[1].n_instants; k++)
    early[k] = 0.3 * spacing;
  succeed(lab_run_predict(&run[1], &(lab_episode){0, &rig}, 1, early, u.tol, y, &error));
  memcpy(p + ROWS, y, ROWS * sizeof *y);
  memcpy(x + ROWS, y + ROWS, ROWS * sizeof *y);
  lab_unknowns_values(&u, theta);
  theta[SWITCHES] = 0.3;
  succeed(lab_unknowns_residuals(&u, theta, r, &error));
  assert_close(size_of(r + 2 * ROWS, 2 * ROWS), 0, 1e-9, 0);
  theta[SWITCHES] = 0;
  succeed(lab_unknowns_residuals(&u, theta, r, &error));
  assert_true(size_of(r + 2 * ROWS, 2 * ROWS) > 1);
}

/* Nothing fitted: commands at the rows that show them, the fit list as declared. */
TEST(test_lab_unknowns_none__commands_at_their_rows__leave_nothing)
{
  static const double prompt[SWITCHES] = {0, 0};
  int k;
  open_usual();
  lab_unknowns_none(&rig, run, RUNS, &u);
  for (k = 0; k < RUNS; k++)
    measure_run(&rig, k, prompt);
  assert_int_equal(u.n, 0);
  assert_int_equal(u.n_rows, DATA);
  assert_int_equal(u.m, DATA);
  succeed(lab_unknowns_errors(&u, r, &error));
  assert_all_zero(r, DATA);
}

TEST(test_lab_unknowns_add__parameter__is_in_the_model_with_its_scale)
{
  const lab_unknown *added = &u.unknown[USUAL];
  open_usual();
  succeed(lab_unknowns_add(&u, index_of("moving_mass"), 3, &error));
  assert_int_equal(u.n, USUAL + 1);
  assert_string_equal(added->name, "moving_mass");
  assert_string_equal(added->unit, "kg");
  assert_int_equal(added->run, LAB_ALL_RUNS);
  assert_close(added->scale, 3, 0, 0);
  assert_close(u.rig.params.moving_mass, 3, 0, 0);
  assert_close(u.declared.moving_mass, 2, 0, 0);
  assert_int_equal(lab_unknowns_find(&u, index_of("moving_mass")), USUAL);
}

TEST(test_lab_unknowns_add__effect__has_the_scale_of_its_usual_size)
{
  const int param = index_of("pressure_bias.pressure_bias");
  pneu_param_info info;
  pneu_param_describe(param, &info);
  open_usual();
  succeed(lab_unknowns_add(&u, param, 0, &error));
  assert_close(u.unknown[USUAL].scale, fabs((double)info.value), 0, 0);
  assert_close(u.unknown[USUAL].lower, info.lower, 0, 0);
  assert_close(u.unknown[USUAL].upper, info.upper, 0, 0);
}

TEST(test_lab_unknowns_add__beyond_its_bounds__is_put_onto_them)
{
  open_usual();
  succeed(lab_unknowns_add(&u, index_of("moving_mass"), 1e9, &error));
  assert_close(u.unknown[USUAL].value, 1e4, 0, 0);
  assert_close(u.rig.params.moving_mass, 1e4, 0, 0);
  succeed(lab_unknowns_add(&u, index_of("critical_ratio"), -1, &error));
  assert_close(u.unknown[USUAL + 1].value, 0, 0, 0);
}

/* A stem that hardly loses any energy takes long to simulate, and there is none. */
TEST(test_lab_unknowns_add__damping__stays_above_a_fiftieth_of_what_is_declared)
{
  open_usual();
  succeed(lab_unknowns_add(&u, PNEU_PARAM_damping, 0, &error));
  assert_close(u.unknown[u.n - 1].value, 0.02 * (double)rig.params.damping, 0, 1e-9);
  close_all();
}

TEST(test_lab_unknowns_add__no_room__is_refused)
{
  int j;
  open_usual();
  for (j = USUAL; j < LAB_FIT_MAX; j++)
    succeed(lab_unknowns_add(&u, index_of("moving_mass"), 3, &error));
  assert_fails(lab_unknowns_add(&u, index_of("moving_mass"), 3, &error), LAB_DATA, "more than 256 things");
  assert_int_equal(u.n, LAB_FIT_MAX);
}

TEST(test_lab_unknowns_drop__one_between_others__leaves_these_in_order)
{
  const int bias = index_of("pressure_bias.pressure_bias"), excess = index_of("stribeck_friction.stribeck_excess"),
            velocity = index_of("stribeck_friction.stribeck_velocity");
  pneu_param_info info;
  pneu_param_describe(velocity, &info);
  open_usual();
  succeed(lab_unknowns_add(&u, bias, 500, &error));
  succeed(lab_unknowns_add(&u, excess, 0.3, &error));
  succeed(lab_unknowns_add(&u, velocity, 0.9 * (double)info.value, &error));
  lab_unknowns_drop(&u, bias);
  assert_int_equal(u.n, USUAL + 2);
  assert_int_equal(lab_unknowns_find(&u, bias), -1);
  assert_int_equal(lab_unknowns_find(&u, excess), USUAL);
  assert_int_equal(lab_unknowns_find(&u, velocity), USUAL + 1);
  assert_close(param_of(&u.rig, "pressure_bias.pressure_bias"), 0, 0, 0);
  lab_unknowns_drop(&u, velocity); /* a shape goes back to its usual value */
  assert_close(param_of(&u.rig, "stribeck_friction.stribeck_velocity"), info.value, 0, 0);
  assert_close(param_of(&u.rig, "stribeck_friction.stribeck_excess"), 0.3, 0, 1e-12);
}

TEST(test_lab_unknowns_find__what_is_not_there__is_not_found)
{
  open_usual();
  assert_int_equal(lab_unknowns_find(&u, index_of("dry_friction")), FRICTION);
  assert_int_equal(lab_unknowns_find(&u, LAB_PARAM_ORIFICE_AREA), AREA_1); /* the first of its own */
  assert_int_equal(lab_unknowns_find(&u, index_of("spring_rate")), SPRING);
  assert_int_equal(lab_unknowns_find(&u, index_of("area")), -1);
  assert_int_equal(lab_unknowns_find(&u, 0), -1);
  assert_int_equal(lab_unknowns_find(&u, 1), -1); /* index of a switch, and of nothing else */
}

/* ---- Free terms ---- */

static const pneu_term bump = {PNEU_TERM_FRICTION, PNEU_TERM_OVER_POSITION, 5, 0, (pneu_real)0.02, {0, 10, 40, 10, 0}};

TEST(test_lab_unknowns_add_term__free_ends__has_all_its_knots)
{
  char name[32];
  int i;
  open_usual();
  succeed(lab_unknowns_add_term(&u, &bump, 50, 0, &error));
  assert_int_equal(u.n, USUAL + 5);
  assert_int_equal(u.rig.n_terms, 1);
  assert_memory_equal(&u.rig.term[0], &bump, sizeof bump);
  for (i = 0; i < 5; i++) {
    const lab_unknown *k = &u.unknown[USUAL + i];
    snprintf(name, sizeof name, "unlisted_1.%d", i + 1);
    assert_string_equal(k->name, name);
    assert_int_equal(k->kind, LAB_UNKNOWN_KNOT);
    assert_int_equal(k->index, i);
    assert_int_equal(k->term, 0);
    assert_int_equal(k->run, LAB_ALL_RUNS);
    assert_close(k->value, bump.value[i], 0, 0);
    assert_close(k->scale, 50, 0, 0);
    assert_close(k->lower, -5e4, 0, 0);
    assert_close(k->upper, 5e4, 0, 0);
  }
}

TEST(test_lab_unknowns_add_term__held_ends__keep_their_values)
{
  lab_rig model;
  int i;
  open_usual();
  succeed(lab_unknowns_add_term(&u, &bump, 50, 0, &error));
  succeed(lab_unknowns_add_term(&u, &bump, 50, 1, &error));
  assert_int_equal(u.n, USUAL + 5 + 3);
  assert_string_equal(u.unknown[USUAL + 5].name, "unlisted_2.2");
  assert_string_equal(u.unknown[USUAL + 7].name, "unlisted_2.4");
  lab_unknowns_values(&u, theta);
  for (i = 0; i < 8; i++)
    theta[USUAL + i] = 100 + i;
  model = u.rig;
  lab_unknowns_apply(&u, theta, LAB_ALL_RUNS, &model);
  for (i = 0; i < 5; i++) {
    assert_close(model.term[0].value[i], 100 + i, 0, 0);
    assert_close(model.term[1].value[i], i == 0 || i == 4 ? 0 : 104 + i, 0, 0);
  }
}

TEST(test_lab_unknowns_drop_term__the_last_one__takes_its_knots_alone)
{
  open_usual();
  succeed(lab_unknowns_add_term(&u, &bump, 50, 0, &error));
  succeed(lab_unknowns_add_term(&u, &bump, 50, 2, &error));
  succeed(lab_unknowns_add(&u, index_of("moving_mass"), 3, &error));
  lab_unknowns_drop_term(&u);
  assert_int_equal(u.rig.n_terms, 1);
  assert_int_equal(u.n, USUAL + 5 + 1);
  assert_string_equal(u.unknown[USUAL + 4].name, "unlisted_1.5");
  assert_string_equal(u.unknown[USUAL + 5].name, "moving_mass");
}

/* Four unknowns more have room, a term of five has not. */
static void assert_no_room(const pneu_term *term)
{
  open_usual();
  while (u.n < LAB_FIT_MAX - 4)
    succeed(lab_unknowns_add(&u, index_of("moving_mass"), 3, &error));
  assert_int_equal(lab_unknowns_add_term(&u, term, 50, 0, &error), LAB_DATA);
  assert_int_equal(u.rig.n_terms, 0);
  assert_int_equal(u.n, LAB_FIT_MAX - 4);
}

TEST(test_lab_unknowns_add_term__no_room__is_refused_and_leaves_all_as_it_is)
{
  int k;
  open_usual();
  for (k = 0; k < LAB_TERM_MAX; k++)
    succeed(lab_unknowns_add_term(&u, &bump, 50, 2, &error));
  assert_int_equal(lab_unknowns_add_term(&u, &bump, 50, 2, &error), LAB_DATA);
  assert_int_equal(u.rig.n_terms, LAB_TERM_MAX);
  assert_no_room(&bump);
}

/* ---- Free terms over cycles ---- */

/* Begins at 0.25 s, which means nothing, and comes every 0.5 s. */
static const pneu_term wave = {PNEU_TERM_FORCE, PNEU_TERM_OVER_CYCLE, 4,
                               (pneu_real)0.25, (pneu_real)0.75,      {80, -60, 10, 5}};

/* Of the period matters what turns the phase at the end, after 4 s, by a radian. */
TEST(test_lab_unknowns_add_term__cycle__has_its_amplitudes_and_its_period)
{
  const lab_unknown *period = &u.unknown[USUAL + 4];
  int i;
  open_usual();
  succeed(lab_unknowns_add_term(&u, &wave, 50, 0, &error));
  assert_int_equal(u.n, USUAL + 5);
  assert_int_equal(u.rig.n_terms, 1);
  for (i = 0; i < 4; i++) {
    assert_int_equal(u.unknown[USUAL + i].kind, LAB_UNKNOWN_KNOT);
    assert_close(u.unknown[USUAL + i].value, wave.value[i], 0, 0);
  }
  assert_int_equal(period->kind, LAB_UNKNOWN_PERIOD);
  assert_int_equal(period->term, 0);
  assert_int_equal(period->run, LAB_ALL_RUNS);
  assert_string_equal(period->name, "unlisted_1.period");
  assert_string_equal(period->unit, "s");
  assert_close(period->value, 0.5, 0, 1e-12);
  assert_close(period->first, 0.5, 0, 1e-12);
  assert_close(period->lower, 0.25, 0, 1e-12);
  assert_close(period->upper, 1, 0, 1e-12);
  assert_close(period->scale, 0.25 / (6.283185307179586 * 4), 0, 1e-12);
  assert_close(period->spread, 0, 0, 0);
}

TEST(test_lab_unknowns_apply__period__moves_the_end_of_its_term_alone)
{
  lab_rig model;
  open_usual();
  succeed(lab_unknowns_add_term(&u, &wave, 50, 0, &error));
  succeed(lab_unknowns_add_term(&u, &wave, 50, 0, &error));
  lab_unknowns_values(&u, theta);
  theta[USUAL + 9] = 0.6;
  model = u.rig;
  lab_unknowns_apply(&u, theta, LAB_ALL_RUNS, &model);
  assert_memory_equal(&model.term[0], &wave, sizeof wave);
  assert_close(model.term[1].from, 0.25, 0, 0);
  assert_close(model.term[1].to, 0.85, 0, 1e-12);
  assert_memory_equal(model.term[1].value, wave.value, sizeof wave.value);
}

TEST(test_lab_unknowns_drop_term__cycle__takes_its_period_along)
{
  open_usual();
  succeed(lab_unknowns_add_term(&u, &wave, 50, 0, &error));
  succeed(lab_unknowns_add_term(&u, &wave, 50, 0, &error));
  succeed(lab_unknowns_add(&u, index_of("moving_mass"), 3, &error));
  lab_unknowns_drop_term(&u);
  assert_int_equal(u.rig.n_terms, 1);
  assert_int_equal(u.n, USUAL + 5 + 1);
  assert_string_equal(u.unknown[USUAL + 4].name, "unlisted_1.period");
  assert_string_equal(u.unknown[USUAL + 5].name, "moving_mass");
  assert_int_equal(lab_unknowns_find(&u, index_of("moving_mass")), USUAL + 5);
}

/* Four amplitudes would have room, their period has not. */
TEST(test_lab_unknowns_add_term__no_room_for_the_period__is_refused)
{
  assert_no_room(&wave);
  lab_unknowns_drop(&u, index_of("moving_mass"));
  while (u.n < LAB_FIT_MAX - 5)
    succeed(lab_unknowns_add(&u, index_of("moving_mass"), 3, &error));
  succeed(lab_unknowns_add_term(&u, &wave, 50, 0, &error));
  assert_int_equal(u.n, LAB_FIT_MAX);
}

/* ---- Into a model ---- */

TEST(test_lab_unknowns_apply__all_experiments__has_shared_values_only)
{
  const double given[USUAL] = {600, 1.5, 0.5, 3e5, 0, 0, 0, 0};
  lab_rig model;
  open_usual();
  model = u.rig;
  lab_unknowns_apply(&u, given, LAB_ALL_RUNS, &model);
  assert_close(model.params.dry_friction, 600, 0, 0);
  assert_close(model.params.spring_rate, 3e5, 0, 0);
  assert_memory_equal(&model.params.fill_area, &rig.params.fill_area, sizeof rig.params.fill_area);
}

/* However often: a factor is one of the declared area, not of the latest. */
TEST(test_lab_unknowns_apply__one_experiment__has_its_own_values_too)
{
  const double given[USUAL] = {600, 1.5, 0.5, 3e5, 0, 0, 0, 0};
  lab_rig model;
  int e, again;
  open_usual();
  u.declared.vent_area = rig.params.vent_area *= 3;
  model = u.rig;
  for (again = 0; again < 2; again++)
    for (e = 0; e < RUNS; e++) {
      lab_unknowns_apply(&u, given, e, &model);
      assert_close(model.params.dry_friction, 600, 0, 0);
      assert_close(model.params.fill_area, given[AREA_1 + e] * (double)rig.params.fill_area, 0, 1e-14);
      assert_close(model.params.vent_area, given[AREA_1 + e] * (double)rig.params.vent_area, 0, 1e-14);
    }
}

/* ---- Residuals ---- */

TEST(test_lab_unknowns_residuals__log_of_the_model_itself__are_zero)
{
  size_t window;
  open_measured();
  assert_true(p[ROWS / 2] > 1e5 && x[ROWS / 2] > 0.01); /* it fills, and the stem moves */
  succeed(lab_unknowns_residuals(&u, NULL, r, &error));
  assert_all_zero(r, u.m);
  succeed(lab_unknowns_errors(&u, r, &error));
  assert_all_zero(r, u.n_rows);
  succeed(lab_unknowns_sticks_and_slips(&u, 0, &window, &error));
  assert_int_equal(window, 0);
}

TEST(test_lab_unknowns_sticks_and_slips__rough_pressure__is_not_of_the_stem)
{
  size_t window;
  int i;
  open_measured();
  for (i = 0; i < ROWS; i++)
    p[i] += i / 3 % 2 ? 1e5 : -1e5;
  succeed(lab_unknowns_sticks_and_slips(&u, 0, &window, &error));
  assert_true(window > 0);
  succeed(lab_unknowns_sticks_and_slips(&u, 1, &window, &error));
  assert_int_equal(window, 0);
}

/* Measured less predicted, over noise, channel by channel, run after run. */
TEST(test_lab_unknowns_residuals__known_errors__are_over_the_noise)
{
  const int at[] = {5, 50, 7};
  open_measured();
  p[at[0] + FIRST_SWITCH] += 600;
  x[at[1]] -= 1e-5;
  x[ROWS + at[2] + FIRST_SWITCH] += 4e-5;
  succeed(lab_unknowns_residuals(&u, NULL, r, &error));
  assert_close(r[at[0] + FIRST_SWITCH], 2, 1e-9, 0);
  assert_close(r[ROWS + at[1]], -0.5, 1e-9, 0);
  assert_close(r[3 * ROWS + at[2] + FIRST_SWITCH], 2, 1e-9, 0);
  assert_close(size_of(r, u.m) * sqrt((double)u.m), sqrt(8.25), 1e-9, 0); /* and nothing else */
}

TEST(test_lab_unknowns_residuals__gap__counts_nothing)
{
  open_measured();
  p[30] = x[ROWS + 40] = NAN;
  succeed(lab_unknowns_residuals(&u, NULL, r, &error));
  assert_all_zero(r, u.m);
}

/* Nine values of each channel of a run 2 and 3 standard deviations off, and a gap in each, which is no value. */
TEST(test_lab_loop_errors__known_errors_and_gaps__are_over_the_values_that_are_there)
{
  const double n = RUNS * ROWS - 1;
  lab_errors errors;
  int i;
  open_measured();
  for (i = 20; i < 29; i++) {
    p[i] += 2 * sigma_p;
    x[ROWS + i] -= 3 * sigma_x;
  }
  p[30] = x[ROWS + 40] = NAN;
  succeed(lab_loop_errors(&u, &errors, &error));
  assert_close(errors.in_noise[LAB_CHANNEL_P], sqrt(9 * 4 / n), 0, 1e-9);
  assert_close(errors.in_noise[LAB_CHANNEL_X], sqrt(9 * 9 / n), 0, 1e-9);
  assert_close(errors.rmse[LAB_CHANNEL_P], sigma_p * sqrt(9 * 4 / n), 0, 1e-9);
  assert_close(errors.rmse[LAB_CHANNEL_X], sigma_x * sqrt(9 * 9 / n), 0, 1e-9);
  assert_true(isnan(errors.rmse[LAB_CHANNEL_T]));
  assert_close(errors.chi2, 9 * (4 + 9), 0, 1e-9);
  assert_int_equal(errors.n, 2 * n);
}

/* A run is measured with each its orifices; in each other's place they fit neither. */
TEST(test_lab_unknowns_residuals__own_values__belong_to_their_log)
{
  static const double factor[RUNS] = {1.2, 0.9}, early[SWITCHES] = {0.025, 0.025};
  int k;
  open_usual();
  for (k = 0; k < RUNS; k++) {
    lab_rig truth = rig;
    truth.params.fill_area *= (pneu_real)factor[k];
    truth.params.vent_area *= (pneu_real)factor[k];
    measure_run(&truth, k, early);
  }
  lab_unknowns_values(&u, theta);
  theta[AREA_1] = factor[0];
  theta[AREA_2] = factor[1];
  succeed(lab_unknowns_residuals(&u, theta, r, &error));
  assert_all_zero(r, u.m);
  theta[AREA_2] = factor[0];
  succeed(lab_unknowns_residuals(&u, theta, r, &error));
  assert_all_zero(r, 2 * ROWS);
  assert_true(size_of(r + 2 * ROWS, 2 * ROWS) > 10);
}

TEST(test_lab_unknowns_residuals__switch_off_its_middle__is_paid_for)
{
  open_measured();
  lab_unknowns_values(&u, theta);
  theta[SWITCH_1 + 2] = 0.04; /* of the second run */
  succeed(lab_unknowns_residuals(&u, theta, r, &error));
  assert_close(r[DATA + SWITCH_1 + 2], (0.025 - 0.04) / (0.05 / sqrt(12)), 1e-12, 0);
  r[DATA + SWITCH_1 + 2] = 0;
  assert_all_zero(r + DATA, (size_t)u.n);
  assert_all_zero(r, 2 * ROWS);
  assert_true(size_of(r + 2 * ROWS, 2 * ROWS) > 1);
}

/* Instants that are known to have been at their rows or before. */
TEST(test_lab_unknowns_residuals__commands_that_were_early__are_matched_by_their_switches)
{
  static const double early[RUNS][SWITCHES] = {{0, 0.05}, {0.031, 0.007}};
  int k;
  open_usual();
  lab_unknowns_values(&u, theta);
  for (k = 0; k < RUNS; k++) {
    measure_run(&rig, k, early[k]);
    theta[SWITCH_1 + 2 * k] = early[k][0];
    theta[SWITCH_1 + 2 * k + 1] = early[k][1];
  }
  succeed(lab_unknowns_residuals(&u, theta, r, &error));
  assert_all_zero(r, DATA);
}

/* The second channel of the second run remembers 0.6: r_i = (e_i - 0.6 e_(i-1))/0.8, over a gap 0.36 of the row before
 * it. */
TEST(test_lab_unknowns_residuals__noise_with_memory__are_whitened)
{
  enum { GAP = 33 };
  double *white = r + 3 * ROWS, *error_of = other + 3 * ROWS;
  uint64_t seed = 1;
  int i;
  open_measured();
  for (i = FIRST_SWITCH; i < ROWS; i++) {
    x[i] += fixture_random(&seed, -sigma_x, sigma_x);
    x[ROWS + i] += fixture_random(&seed, -sigma_x, sigma_x);
  }
  x[ROWS + GAP] = NAN;
  run[1].colour[1] = (lab_colour){0.6, 1};
  succeed(lab_unknowns_residuals(&u, NULL, r, &error));
  succeed(lab_unknowns_errors(&u, other, &error));
  assert_memory_equal(r, other, 3 * ROWS * sizeof *r);
  for (i = 1; i < ROWS; i++) {
    const int before = i == GAP + 1 ? 2 : 1;
    const double memory = i == GAP || i <= FIRST_SWITCH ? 0 : pow(0.6, before);
    check_note("row %d", i);
    assert_close(white[i], (error_of[i] - memory * error_of[i - before]) / sqrt(1 - memory * memory), 1e-9, 0);
  }
}

/* A model in the place of the present one; what each run has for itself still applies. */
TEST(test_lab_unknowns_residuals_with__another_model__takes_its_shared_values)
{
  lab_rig model;
  open_measured();
  u.unknown[AREA_2].value = 1.1;
  lab_unknowns_values(&u, theta);
  theta[FRICTION] = 700;
  model = u.rig;
  model.params.dry_friction = 700;
  succeed(lab_unknowns_residuals(&u, theta, r, &error));
  succeed(lab_unknowns_residuals_with(&u, &model, other, &error));
  assert_true(size_of(r, 2 * ROWS) > 1);
  assert_memory_equal(r, other, u.m * sizeof *r);
}

/* Channel by channel, run after run, what coarse.h makes of a channel and its prediction. */
TEST(test_lab_unknowns_view__windows__has_the_coarse_residuals)
{
  enum { WINDOW = 20 };
  const size_t n = 2 * lab_windowed_count(ROWS, WINDOW);
  static double predicted_p[RUNS * ROWS], predicted_x[RUNS * ROWS];
  int k, i;
  open_measured();
  memcpy(predicted_p, p, sizeof p);
  memcpy(predicted_x, x, sizeof x);
  for (i = FIRST_SWITCH; i < ROWS; i++) /* the start stays known */
    x[ROWS + i] += i % 2 ? 1e-3 : 5e-4;
  lab_unknowns_view(&u, WINDOW);
  assert_int_equal(u.n_data, 2 * RUNS * n);
  assert_int_equal(u.m, u.n_data + USUAL);
  succeed(lab_unknowns_residuals(&u, NULL, r, &error));
  for (k = 0; k < RUNS; k++) {
    const size_t at = (size_t)k * 2 * n, row = (size_t)k * ROWS;
    lab_windowed_residuals(p + row, predicted_p + row, ROWS, WINDOW, sigma_p, other + at);
    lab_windowed_residuals(x + row, predicted_x + row, ROWS, WINDOW, sigma_x, other + at + n);
  }
  assert_memory_equal(r, other, 4 * n * sizeof *r);
  assert_true(size_of(r + 3 * n, n) > 1);
  assert_all_zero(r + u.n_data, USUAL);
  lab_unknowns_view(&u, 0);
  assert_int_equal(u.n_data, DATA);
  assert_int_equal(u.m, DATA + USUAL);
}

/* ---- Slopes ---- */

/* A gain adds its share of every pressure: -p/sigma there, up to 1300, 0 elsewhere; but for what the stepper leaves,
 * 1e-9 of full scale over the noise and a step of 2e-5. */
TEST(test_lab_unknowns_slope__gain_of_a_sensor__is_the_signal_over_the_noise)
{
  const int gain = index_of("pressure_gain.pressure_gain");
  int i;
  open_closely();
  succeed(lab_unknowns_add(&u, gain, 0, &error));
  u.m = u.n_data + (size_t)u.n;
  lab_unknowns_values(&u, theta);
  succeed(lab_unknowns_residuals(&u, theta, r, &error));
  succeed(lab_unknowns_slope(&u, theta, r, USUAL, column, &error));
  for (i = 0; i < ROWS; i++) {
    check_note("row %d", i);
    assert_close(column[i], -p[i] / sigma_p, 0.1, 0);
    assert_close(column[ROWS + i], 0, 0.1, 0);
    assert_close(column[2 * ROWS + i], -p[ROWS + i] / sigma_p, 0.1, 0);
    assert_close(column[3 * ROWS + i], 0, 0.1, 0);
  }
  assert_all_zero(column + DATA, (size_t)u.n);
}

/* What is known of a switch beforehand: -1/spread in its own row. */
TEST(test_lab_unknowns_slope__switch__has_its_prior)
{
  int j;
  open_measured();
  lab_unknowns_values(&u, theta);
  succeed(lab_unknowns_residuals(&u, theta, r, &error));
  succeed(lab_unknowns_slope(&u, theta, r, SWITCH_1 + 1, column, &error));
  for (j = 0; j < u.n; j++)
    assert_close(column[DATA + j], j == SWITCH_1 + 1 ? -sqrt(12) / spacing : 0, 0, 1e-9);
  assert_all_zero(column + 2 * ROWS, 2 * ROWS); /* the other run */
}

/* Root mean square distance between two columns, over the size of the first. */
static double distance(const double *a, const double *b, size_t n)
{
  double sum = 0;
  size_t i;
  for (i = 0; i < n; i++)
    sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sqrt(sum / (double)n) / size_of(a, n);
}

/* Difference quotient of the residuals in unknown j.  Out: quotient */
static void difference(int j, double up, double down, double *quotient)
{
  static double below[DATA + LAB_FIT_MAX];
  double at[LAB_FIT_MAX];
  size_t i;
  memcpy(at, theta, sizeof at);
  at[j] = theta[j] + up;
  succeed(lab_unknowns_residuals(&u, at, quotient, &error));
  at[j] = theta[j] - down;
  succeed(lab_unknowns_residuals(&u, at, below, &error));
  for (i = 0; i < u.m; i++)
    quotient[i] = (quotient[i] - below[i]) / (up + down);
}

/* Beside a central difference over ten times the step; of an instant, beside the change over its own step. */
TEST(test_lab_unknowns_slope__every_unknown__is_that_of_a_second_difference)
{
  int j;
  open_closely();
  succeed(lab_unknowns_residuals(&u, theta, r, &error));
  for (j = 0; j < USUAL; j++) {
    const int is_instant = u.unknown[j].kind == LAB_UNKNOWN_INSTANT;
    const double up = (is_instant ? 0.15 : 1e-2) * u.unknown[j].scale, down = is_instant ? 0 : up;
    check_note("%s", u.unknown[j].name);
    succeed(lab_unknowns_slope(&u, theta, r, j, column, &error));
    difference(j, up, down, other);
    assert_true(size_of(column, u.m) > 0);
    assert_close(distance(column, other, u.m), 0, 0.05, 0);
  }
}

/* From one run with steps of 1e-5, beside a central difference of exact ones; what is done already stays. */
TEST(test_lab_unknowns_slopes_together__every_unknown__is_that_of_a_difference)
{
  static double J[LAB_FIT_MAX * (DATA + LAB_FIT_MAX)];
  char done[LAB_FIT_MAX] = {0};
  int j;
  open_closely();
  done[SPRING] = 1;
  succeed(lab_unknowns_slopes_together(&u, theta, J, done, &error));
  assert_true(size_of(J + SPRING * u.m, u.m) == 0);
  for (j = 0; j < USUAL; j++) {
    const double step = 1e-5 * u.unknown[j].scale;
    check_note("%s", u.unknown[j].name);
    assert_true(done[j]);
    difference(j, step, step, other);
    if (j != SPRING)
      assert_close(distance(J + (size_t)j * u.m, other, u.m), 0, 0.02, 0);
  }
}

/* Of a model that differs, beside a difference; one that has other states is left. */
TEST(test_lab_unknowns_changes_with__other_models__are_their_differences)
{
  enum { LEAKING, LAGGING, MODELS };
  static lab_rig model[MODELS];
  static double change[MODELS * (DATA + LAB_FIT_MAX)];
  char done[MODELS];
  open_closely();
  model[LEAKING] = model[LAGGING] = u.rig;
  *pneu_param_at(&model[LEAKING].params, pneu_param_find("leak_area")) = (pneu_real)1e-12;
  *pneu_param_at(&model[LAGGING].params, pneu_param_find("transducer_time")) = (pneu_real)1e-4;
  succeed(lab_unknowns_residuals(&u, NULL, r, &error));
  succeed(lab_unknowns_changes_with(&u, model, MODELS, change, done, &error));
  assert_true(done[LEAKING] && !done[LAGGING]);
  succeed(lab_unknowns_change_with(&u, &model[LEAKING], r, other, &error));
  assert_true(size_of(other, u.m) > 0);
  assert_close(distance(change, other, u.m), 0, 0.01, 0);
}

/* A model with one unknown more begins with the slopes of the one that it extends, and the new one is not among them.
 */
TEST(test_lab_unknowns_begin_with__one_unknown_more__has_the_slopes_of_the_others)
{
  lab_unknowns more;
  int j, k;
  size_t i;
  open_measured();
  succeed(lab_unknowns_keep_slopes(&u, &error));
  succeed(lab_unknowns_find_slopes(&u, &error));
  more = u;
  succeed(lab_unknowns_add(&more, pneu_param_find("damping"), 900, &error));
  succeed(lab_unknowns_keep_slopes(&more, &error));
  lab_unknowns_begin_with(&more, &u);
  assert_int_equal(more.m, u.m + 1);
  for (j = 0; j < USUAL; j++) {
    check_note("%s", u.unknown[j].name);
    assert_true(more.has_slope[j]);
    for (i = 0; i < u.m; i++)
      assert_close(more.slopes[(size_t)j * more.m + i], u.slopes[(size_t)j * u.m + i], 0, 0);
    for (k = (int)u.m; k < (int)more.m; k++)
      assert_true(more.slopes[(size_t)j * more.m + (size_t)k] == 0);
  }
  assert_false(more.has_slope[USUAL]);
  lab_unknowns_forget_slopes(&more);
  lab_unknowns_forget_slopes(&u);
}

/* No room upwards: the difference is taken downwards, and is the same. */
TEST(test_lab_unknowns_slope__at_its_upper_bound__stays_inside)
{
  double seen[DATA + LAB_FIT_MAX];
  open_closely();
  succeed(lab_unknowns_residuals(&u, theta, r, &error));
  succeed(lab_unknowns_slope(&u, theta, r, SPRING, seen, &error));
  u.unknown[SPRING].upper = theta[SPRING];
  succeed(lab_unknowns_slope(&u, theta, r, SPRING, column, &error));
  assert_true(distance(seen, column, u.m) > 0);
  assert_close(distance(seen, column, u.m), 0, 0.05, 0);
}

/* ---- Fits ---- */

/* A log of a stiffer spring and wider orifices, and the declared model as the start. */
static const double true_factor[RUNS] = {1.05, 0.97}, true_early[SWITCHES] = {0.01, 0.03};
static const double truth_of[USUAL] = {510, 1.05, 0.97, 4.1e5, 0.01, 0.03, 0.01, 0.03};

static void open_to_fit(void)
{
  int k;
  open_usual();
  for (k = 0; k < RUNS; k++) {
    lab_rig truth = rig;
    truth.params.dry_friction = (pneu_real)truth_of[FRICTION];
    truth.params.spring_rate = (pneu_real)truth_of[SPRING];
    truth.params.fill_area *= (pneu_real)true_factor[k];
    truth.params.vent_area *= (pneu_real)true_factor[k];
    measure_run(&truth, k, true_early);
  }
}

TEST(test_lab_unknowns_fit__log_without_noise__finds_all_within_their_intervals)
{
  static lab_fit_result fit;
  double chi2, before;
  int j;
  open_to_fit();
  succeed(lab_unknowns_residuals(&u, NULL, r, &error));
  before = size_of(r, u.m);
  assert_true(before > 10);
  succeed(lab_unknowns_fit(&u, LAB_ROUNDS_ALL, &chi2, &error));
  succeed(lab_unknowns_residuals(&u, NULL, r, &error));
  assert_close(chi2, size_of(r, u.m) * size_of(r, u.m) * (double)u.m, 0, 1e-9);
  assert_between(chi2, 0, 4); /* priors: (0.015^2 + 0.005^2) 12/0.05^2 each run */
  succeed(lab_unknowns_intervals(&u, &fit, &error));
  for (j = 0; j < USUAL; j++) {
    check_note("%s", u.unknown[j].name);
    assert_between(truth_of[j], fit.low[j], fit.high[j]);
    assert_close(u.unknown[j].value, truth_of[j], 0.05 * u.unknown[j].scale, 0);
    assert_true(fit.deviation[j] > 0 && fit.deviation[j] < 0.1 * u.unknown[j].scale);
  }
  assert_close(u.unknown[SPRING].value, truth_of[SPRING], 0, 2e-3);
  assert_close(u.rig.params.spring_rate, u.unknown[SPRING].value, 0, 0);
  assert_close(u.unknown[SPRING].first, 4e5, 0, 0);
}

TEST(test_lab_unknowns_fit__noisy_log__is_as_far_off_as_its_interval_says)
{
  static lab_fit_result fit;
  double chi2;
  uint64_t seed = 3;
  int i, j;
  open_to_fit();
  for (i = 0; i < RUNS * ROWS; i++) {
    if (i % ROWS < FIRST_SWITCH)
      continue; /* the start stays known */
    p[i] += sigma_p * fixture_normal(&seed);
    x[i] += sigma_x * fixture_normal(&seed);
  }
  succeed(lab_unknowns_fit(&u, LAB_ROUNDS_ALL, &chi2, &error));
  succeed(lab_unknowns_intervals(&u, &fit, &error));
  assert_between(chi2 / (RUNS * 2.0 * (ROWS - FIRST_SWITCH)), 0.7, 1.3); /* four standard deviations */
  for (j = 0; j < USUAL; j++) {
    check_note("%s", u.unknown[j].name);
    assert_close(u.unknown[j].value, truth_of[j], 4 * fit.deviation[j], 0);
    if (fit.state[j] == LAB_STATE_FREE && j < SWITCH_1)
      assert_close((fit.high[j] - fit.low[j]) / 2, 1.959963984540054 * fit.deviation[j], 0, 1e-3);
  }
}

/* A row of the first run, moved to just after the stem gets to its upper stop. */
static void move_row_to_stop(void)
{
  static const double late = 3e-5; /* [s] */
  const double stop = (1 - 1e-9) * (double)rig.params.stroke;
  double from, to;
  int i, k = 0;
  u.tol = 1e-10;
  measure(&rig);
  while (k < ROWS && x[k] < stop)
    k++;
  assert_true(k < ROWS);
  from = t[k - 1];
  to = t[k];
  for (i = 0; i < 40; i++) {
    t[k] = (from + to) / 2;
    measure(&rig);
    *(x[k] < stop ? &from : &to) = t[k];
  }
  t[k] = to + late;
  measure(&rig);
}

/* Pressure and travel are the same where area, spring, friction, orifices and volume are all a per cent larger. Only
 * what is known of the area beforehand, to 2 %, says how large they are, and no row that a stop passes by. */
TEST(test_lab_unknowns_intervals__row_at_a_stop__leaves_the_scale_to_the_tolerance_of_the_area)
{
  static lab_fit_result fit;
  int spring;
  declare();
  rig.params.fill_area *= 4; /* it gets there */
  fit_list("dry_friction", 0);
  fit_list("orifice_area", 0);
  fit_list("spring_rate", 0);
  open_empty();
  move_row_to_stop();
  succeed(lab_unknowns_hold(&u, &error));
  succeed(lab_unknowns_intervals(&u, &fit, &error));
  spring = lab_unknowns_find(&u, index_of("spring_rate"));
  assert_between(fit.deviation[spring] / u.unknown[spring].value, 0.018, 0.022);
}

/* Friction of a place that the declared model lacks, found as knots between held ends. */
TEST(test_lab_unknowns_fit__knots__find_the_term_that_made_the_log)
{
  static const pneu_term flat = {PNEU_TERM_FRICTION, PNEU_TERM_OVER_POSITION, 5, 0, (pneu_real)0.02, {0}};
  static const double want[] = {60, 240, 100};
  lab_rig truth;
  double chi2;
  int i;
  declare();
  open_empty();
  truth = rig;
  truth.n_terms = 1;
  truth.term[0] = flat;
  for (i = 0; i < 3; i++)
    truth.term[0].value[i + 1] = (pneu_real)want[i];
  measure(&truth);
  succeed(lab_unknowns_add_term(&u, &flat, 100, 1, &error));
  succeed(lab_unknowns_fit(&u, LAB_ROUNDS_ALL, &chi2, &error));
  assert_between(chi2, 0, 0.1);
  for (i = 0; i < 3; i++) {
    assert_close(u.unknown[RUNS * SWITCHES + i].value, want[i], 3, 0);
    assert_close(u.rig.term[0].value[i + 1], u.unknown[RUNS * SWITCHES + i].value, 0, 0);
  }
  assert_close(u.rig.term[0].value[0], 0, 0, 0);
  assert_close(u.rig.term[0].value[4], 0, 0, 0);
}

/* A force that comes every 0.7 s, from a start that is off by 3 % in the period, a sixth of a turn after 4 s, and by a
 * third or more in size and phase. */
TEST(test_lab_unknowns_fit__cycle__finds_period_and_amplitudes)
{
  const pneu_term truth_term = {PNEU_TERM_FORCE, PNEU_TERM_OVER_CYCLE, 2, 0, (pneu_real)0.7, {80, -60}},
                  start = {PNEU_TERM_FORCE, PNEU_TERM_OVER_CYCLE, 2, 0, (pneu_real)0.721, {50, -10}};
  const int first = RUNS * SWITCHES;
  lab_rig truth;
  double chi2;
  declare();
  open_empty();
  truth = rig;
  truth.n_terms = 1;
  truth.term[0] = truth_term;
  measure(&truth);
  succeed(lab_unknowns_add_term(&u, &start, 100, 0, &error));
  succeed(lab_unknowns_fit(&u, LAB_ROUNDS_ALL, &chi2, &error));
  assert_between(chi2, 0, 0.1);
  assert_close(u.unknown[first].value, 80, 1, 0);
  assert_close(u.unknown[first + 1].value, -60, 1, 0);
  assert_close(u.unknown[first + 2].value, 0.7, 1e-3, 0);
  assert_close(u.rig.term[0].to, u.unknown[first + 2].value, 0, 1e-12);
}

/* ---- Runs to first order ---- */

/* What other values leave of runs that are not simulated again, less what simulations leave. */
static double off_by(const lab_linear *l, double step)
{
  double sum = 0;
  int i;
  lab_unknowns_values(&u, theta);
  theta[0] += step;
  succeed(lab_unknowns_residuals(&u, theta, r, &error));
  u.linear = l;
  succeed(lab_unknowns_residuals(&u, theta, other, &error));
  u.linear = NULL;
  for (i = 0; i < DATA; i++)
    sum += (r[i] - other[i]) * (r[i] - other[i]);
  return sqrt(sum);
}

TEST(test_lab_linear_open__other_values__are_off_by_their_square)
{
  lab_linear l;
  double step, far;
  open_closely();
  succeed(lab_linear_open(&u, &l, &error));
  assert_int_equal(l.n, 4); /* no instants */
  step = 0.004 * u.unknown[0].value;
  assert_between(off_by(&l, 0), 0, 1e-9);
  far = off_by(&l, step);
  assert_true(far > 0);
  assert_between(far / off_by(&l, step / 2), 3, 5);
  lab_linear_close(&l);
  close_all();
}

TEST(test_lab_linear_change__every_unknown__is_that_of_its_slope)
{
  static double J[LAB_FIT_MAX * (DATA + LAB_FIT_MAX)], first[LAB_FIT_MAX * (DATA + LAB_FIT_MAX)];
  char done[LAB_FIT_MAX] = {0};
  lab_linear l;
  int j, i;
  open_closely();
  succeed(lab_linear_open(&u, &l, &error));
  succeed(lab_unknowns_slopes_together(&u, theta, J, done, &error));
  u.linear = &l;
  memset(done, 0, sizeof done);
  succeed(lab_unknowns_slopes_together(&u, theta, first, done, &error));
  for (j = 0; j < l.n; j++) {
    double off = 0, all = 0;
    for (i = 0; i < DATA; i++) {
      const size_t at = (size_t)j * u.m + (size_t)i;
      off += (first[at] - J[at]) * (first[at] - J[at]);
      all += J[at] * J[at];
    }
    assert_true(all > 0);
    assert_between(sqrt(off / all), 0, 0.01);
  }
  lab_linear_close(&l);
  close_all();
}

/* ---- A stem that is hardly damped ---- */

TEST(test_lab_unknowns_leave_damping__hardly_any_behind_a_positioner__is_known_to_its_size)
{
  double declared;
  int j;
  declare();
  declared = (double)rig.params.damping;
  fit_list("damping", 0);
  open_empty();
  u.unknown[0].value = 0.2 * declared;
  assert_int_equal(lab_unknowns_leave_damping(&u), 0); /* no set position */
  run_log.value[LAB_CHANNEL_SP] = command;
  run_log.value[LAB_CHANNEL_U] = NULL;
  u.unknown[0].value = 0.4 * declared;
  assert_int_equal(lab_unknowns_leave_damping(&u), 0);
  u.unknown[0].value = 0.2 * declared;
  assert_int_equal(lab_unknowns_leave_damping(&u), 1);
  assert_int_equal(lab_unknowns_find(&u, PNEU_PARAM_damping), -1);
  assert_close((double)u.rig.params.damping, declared, 0, 0);
  succeed(lab_unknowns_hold(&u, &error));
  j = lab_unknowns_find(&u, PNEU_PARAM_damping);
  assert_true(j >= 0);
  assert_close(u.unknown[j].tolerance, declared, 0, 1e-12);
  close_all();
}

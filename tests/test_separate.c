/* Which test to record next: the trials, what they separate, what they narrow. */
#include <cminpack.h>

#include "fixture.h"

#include "../apps/lab/separate/separate_private.h"

static const int fitted[] = {LAB_FIT_ORIFICE_AREA, PNEU_PARAM_dry_friction, PNEU_PARAM_spring_rate,
                             PNEU_PARAM_spring_preload, PNEU_PARAM_damping};

/* The R1-400 with 40 cm3 of dead volume, ordinary sensors of pressure and position. */
static lab_rig make_rig(void)
{
  lab_rig rig;
  lab_rig_default(&rig);
  rig.laws.flow = PNEU_FLOW_CHOKED;
  rig.params.dead_volume = (pneu_real)4e-5;
  return rig;
}

static lab_inquiry make_inquiry(const lab_rig *rig)
{
  lab_inquiry q = {rig, {0}, 0.005, COUNT(fitted), fitted, NULL, 0};
  int c;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    q.noise[c] = (double)NAN;
  q.noise[LAB_CHANNEL_P] = 320;
  q.noise[LAB_CHANNEL_X] = 2e-5;
  return q;
}

/* Index of a parameter of an effect; the test is skipped where the effect was trimmed away. */
static int param_of(const char *effect)
{
  const int e = fixture_effect(effect);
  if (e < 0)
    skip();
  return pneu_effect_params(e, NULL);
}

static pneu_params with(const lab_rig *rig, int param, double value)
{
  pneu_params p = rig->params;
  *pneu_param_at(&p, param) = (pneu_real)value;
  return p;
}

/* ---- An independent refit: cminpack on whole predictions ---- */

enum { ROWS_MAX = 2 * 2 * 1501, FREE_MAX = 8 };

typedef struct refit {
  const lab_inquiry *inquiry;
  int n_records;
  const lab_outlook *outlook[2];
  pneu_params base;
  int n, param[FREE_MAX];
  double goal[2][LAB_FORESEEN * 1501];
} refit;

static void predict(const lab_outlook *outlook, const pneu_params *params, double *y)
{
  lab_error error;
  assert_int_equal(lab_foresee(outlook, params, y, NULL, &error), LAB_OK);
}

static void shift(const refit *f, const double *z, pneu_params *params)
{
  int i;
  for (i = 0; i < f->n; i++)
    lab_foresee_shift(params, f->param[i], z[i], lab_foresee_scale(&f->base, f->param[i]));
}

static int residuals(void *context, int m, int n, const double *z, double *r, int flag)
{
  static double y[LAB_FORESEEN * 1501];
  const refit *f = context;
  pneu_params params = f->base;
  int record, i;
  (void)flag, (void)m, (void)n;
  shift(f, z, &params);
  for (record = 0; record < f->n_records; record++) {
    const lab_outlook *o = f->outlook[record];
    const double root = sqrt((o->t[1] - o->t[0]) / f->inquiry->spacing);
    predict(o, &params, y);
    for (i = 0; i < 2 * o->n; i++) /* pressure, then position */
      *r++ = root * (y[i] - f->goal[record][i]) / f->inquiry->noise[i < o->n ? LAB_CHANNEL_P : LAB_CHANNEL_X];
  }
  return 0;
}

/* Fit `from` to what `goal` predicts, parameter `own` and those fitted anyway.
 * In/out: from   Returns: length of what is left [sigma] */
static double fit_to(refit *f, const pneu_params *goal, pneu_params *from, int own)
{
  static double r[ROWS_MAX], jacobian[ROWS_MAX * FREE_MAX], work[ROWS_MAX];
  double z[FREE_MAX] = {0}, scale[FREE_MAX], qtf[FREE_MAX], w1[FREE_MAX], w2[FREE_MAX], w3[FREE_MAX], sum = 0;
  int pivot[FREE_MAX], m = 0, calls, i;
  f->base = *from;
  for (f->n = 0; f->n < COUNT(fitted); f->n++)
    f->param[f->n] = fitted[f->n];
  f->param[f->n++] = own;
  for (i = 0; i < f->n_records; i++) {
    predict(f->outlook[i], goal, f->goal[i]);
    m += 2 * f->outlook[i]->n;
  }
  lmdif(residuals, f, m, f->n, z, r, 1e-8, 1e-8, 0, 400, 1e-6, scale, 1, 1, 0, &calls, jacobian, m, pivot, qtf, w1, w2,
        w3, work);
  residuals(f, m, f->n, z, r, 1);
  shift(f, z, from);
  for (i = 0; i < m; i++)
    sum += r[i] * r[i];
  return sqrt(sum);
}

/* ---- A trial as an outlook ---- */

typedef struct stage {
  pneu_input input[LAB_TRIAL_STEPS];
  lab_schedule schedule;
  lab_outlook outlook;
} stage;

static void stage_open(const lab_rig *rig, const lab_trial *trial, double settle, stage *s)
{
  const pneu_model model = fixture_model(&rig->params, rig->laws.gas, rig->laws.flow);
  lab_error error;
  int i;
  for (i = 0; i < trial->n; i++)
    s->input[i] = fixture_input(&model, trial->u[i]);
  s->schedule = (lab_schedule){(size_t)trial->n, trial->t, s->input};
  assert_int_equal(lab_outlook_open(rig, &s->schedule, settle, trial->duration, 0.005, &s->outlook, &error), LAB_OK);
}

/* A leak and a drooping supply of a size that a fill and vent cannot tell apart. */
static void make_alike(const lab_rig *rig, const lab_inquiry *q, pneu_params *leaks, pneu_params *droops)
{
  static lab_trials trials;
  static refit f;
  static stage s;
  const int leak = param_of("chamber_leak"), droop = param_of("supply_droop");
  lab_error error;
  *leaks = with(rig, leak, 3e-10);
  *droops = with(rig, droop, 1e5);
  assert_int_equal(lab_trials_build(rig, &trials, &error), LAB_OK);
  stage_open(rig, &trials.usual, trials.settle, &s);
  f = (refit){.inquiry = q, .n_records = 1, .outlook = {&s.outlook, NULL}};
  assert_between(fit_to(&f, leaks, droops, droop), 0.5, 2);
  lab_outlook_close(&s.outlook);
}

static lab_advice advise(const lab_inquiry *q, const pneu_params *a, const pneu_params *b)
{
  lab_advice advice;
  lab_error error = {0, ""};
  assert_int_equal(lab_separate(q, a, b, &advice, &error), LAB_OK);
  return advice;
}

/* ---- Separation ---- */

static void test_lab_separate__leak_or_droop__asks_for_a_hold_with_both_orifices_shut(void **state)
{
  const lab_rig rig = make_rig();
  const lab_inquiry q = make_inquiry(&rig);
  pneu_params leaks, droops;
  lab_advice advice;
  int i, shut = 0;
  (void)state;
  make_alike(&rig, &q, &leaks, &droops);
  advice = advise(&q, &leaks, &droops);
  assert_int_equal(advice.kind, LAB_ADVICE_TRIAL);
  assert_non_null(strstr(advice.text, "hold at"));
  assert_string_equal(advice.text, advice.trial.text);
  assert_true(advice.usual < 2);
  assert_true(advice.separation > 5 && advice.separation > 4 * advice.usual);
  for (i = 0; i + 1 < advice.trial.n; i++)
    shut |= advice.trial.u[i] == 0 && advice.trial.t[i + 1] - advice.trial.t[i] >= 10;
  assert_true(shut);
}

/* What has been recorded counts by its slopes: a tenth of the whole is what its curvature may take. */
static void test_lab_separate__separation__is_what_an_independent_fit_to_both_records_leaves(void **state)
{
  static lab_trials trials;
  static refit f;
  static stage before, after;
  const lab_rig rig = make_rig();
  const lab_inquiry q = make_inquiry(&rig);
  pneu_params leaks, droops, back;
  lab_advice advice;
  lab_error error;
  double one, other;
  (void)state;
  make_alike(&rig, &q, &leaks, &droops);
  advice = advise(&q, &leaks, &droops);
  assert_int_equal(advice.kind, LAB_ADVICE_TRIAL);
  assert_int_equal(lab_trials_build(&rig, &trials, &error), LAB_OK);
  stage_open(&rig, &trials.usual, trials.settle, &before);
  stage_open(&rig, &advice.trial, trials.settle, &after);
  f = (refit){.inquiry = &q, .n_records = 2, .outlook = {&before.outlook, &after.outlook}};
  back = leaks;
  one = fit_to(&f, &droops, &back, param_of("chamber_leak"));
  other = fit_to(&f, &leaks, &droops, param_of("supply_droop"));
  assert_close(advice.separation, fmin(one, other), 0, 0.1);
  lab_outlook_close(&before.outlook);
  lab_outlook_close(&after.outlook);
}

/* With nothing but a moment of rest recorded, estimates are several times too large; the trial that is best after
 * fitting again must win all the same. */
static void test_lab_separate__estimates_too_large__best_of_the_settled_wins(void **state)
{
  static lab_trials trials;
  static stage rest, s;
  static const lab_trial still = {"rest", 1, {0}, {0}, 0.5};
  const lab_rig rig = make_rig();
  lab_inquiry q = make_inquiry(&rig);
  side leaks = {with(&rig, param_of("chamber_leak"), 1e-9), 0, {0}, {0}};
  side droops = {with(&rig, param_of("supply_droop"), 6e5), 0, {0}, {0}};
  lab_advice advice;
  lab_error error;
  lab_normal nothing;
  int i, k;
  (void)state;
  stage_open(&rig, &still, 0, &rest);
  q.recorded = &rest.schedule;
  q.recorded_duration = still.duration;
  advice = advise(&q, &leaks.params, &droops.params);
  for (k = 0; k < COUNT(fitted); k++) {
    side_add(&leaks, fitted[k], &error);
    side_add(&droops, fitted[k], &error);
  }
  side_add(&leaks, param_of("chamber_leak"), &error);
  side_add(&droops, param_of("supply_droop"), &error);
  lab_normal_clear(&nothing, leaks.n);
  assert_int_equal(lab_trials_build(&rig, &trials, &error), LAB_OK);
  for (i = 0; i < 6; i++) { /* the holds */
    double one, other;
    stage_open(&rig, &trials.trial[i], trials.settle, &s);
    assert_int_equal(pursue(&q, &s.outlook, &droops.params, &leaks, &nothing, &one, &error), LAB_OK);
    assert_int_equal(pursue(&q, &s.outlook, &leaks.params, &droops, &nothing, &other, &error), LAB_OK);
    check_note("%s", trials.trial[i].text);
    assert_true(advice.separation >= 0.9 * fmin(one, other));
    lab_outlook_close(&s.outlook);
  }
  lab_outlook_close(&rest.outlook);
}

static void test_lab_separate__models_exchanged__same_advice(void **state)
{
  const lab_rig rig = make_rig();
  const lab_inquiry q = make_inquiry(&rig);
  const pneu_params leaks = with(&rig, param_of("chamber_leak"), 1e-9);
  const pneu_params blocked = with(&rig, param_of("vent_restriction"), 2e-3);
  const lab_advice one = advise(&q, &leaks, &blocked), other = advise(&q, &blocked, &leaks);
  (void)state;
  assert_string_equal(one.text, other.text);
  assert_string_equal(one.why, other.why);
  assert_true(one.separation > 0);
  assert_true(one.separation == other.separation && one.usual == other.usual);
}

static void test_lab_separate__one_model_twice__nothing_separates_it(void **state)
{
  const lab_rig rig = make_rig();
  const lab_inquiry q = make_inquiry(&rig);
  const pneu_params leaks = with(&rig, param_of("chamber_leak"), 1e-8);
  const lab_advice advice = advise(&q, &leaks, &leaks);
  (void)state;
  assert_int_equal(advice.kind, LAB_ADVICE_NONE);
  assert_true(advice.separation == 0 && advice.usual == 0);
}

static void test_lab_separate__one_thing_under_two_names__nothing_separates_it(void **state)
{
  const lab_rig rig = make_rig();
  const lab_inquiry q = make_inquiry(&rig);
  const pneu_params blocked = with(&rig, param_of("vent_restriction"), 0.1);
  const pneu_params small = with(&rig, PNEU_PARAM_vent_area, 0.9 * (double)rig.params.vent_area);
  const lab_advice advice = advise(&q, &blocked, &small);
  (void)state;
  assert_int_equal(advice.kind, LAB_ADVICE_NONE);
  assert_true(advice.separation < 0.1);
}

/* A first-order lag and a delay of equal time differ in the second order of that time only. */
static void test_lab_separate__lag_or_skew_of_position__says_that_no_schedule_and_no_sensor_does(void **state)
{
  const lab_rig rig = make_rig();
  lab_inquiry q = make_inquiry(&rig);
  const pneu_params lags = with(&rig, param_of("position_lag"), 1e-3);
  const pneu_params late = with(&rig, param_of("channel_skew"), 1e-3);
  const double pressure_noise[] = {320, (double)NAN};
  int i;
  (void)state;
  for (i = 0; i < COUNT(pressure_noise); i++) {
    lab_advice advice;
    q.noise[LAB_CHANNEL_P] = pressure_noise[i];
    advice = advise(&q, &lags, &late);
    assert_int_equal(advice.kind, LAB_ADVICE_NONE);
    assert_non_null(strstr(advice.text, "no schedule of the set separates them"));
    assert_non_null(strstr(advice.text, "nor with one more"));
  }
}

static void test_lab_separate__position_alone_too_little__names_the_sensor_to_add(void **state)
{
  const lab_rig rig = make_rig();
  lab_inquiry q = make_inquiry(&rig);
  pneu_params leaks, droops;
  lab_advice advice;
  (void)state;
  make_alike(&rig, &q, &leaks, &droops);
  q.noise[LAB_CHANNEL_P] = (double)NAN;
  advice = advise(&q, &leaks, &droops);
  assert_int_equal(advice.kind, LAB_ADVICE_SENSOR);
  assert_true(advice.channel == LAB_CHANNEL_P || advice.channel == LAB_CHANNEL_PS);
  assert_non_null(strstr(advice.text, "record p"));
  assert_true(advice.separation < 5 && advice.with_sensor > 5);
  assert_true(advice.trial.n > 2);
}

static void test_lab_separate__record_at_hand__is_judged_in_the_place_of_a_fill_and_vent(void **state)
{
  static lab_trials trials;
  static stage s;
  const lab_rig rig = make_rig();
  lab_inquiry q = make_inquiry(&rig);
  const pneu_params leaks = with(&rig, param_of("chamber_leak"), 1e-9);
  const pneu_params blocked = with(&rig, param_of("vent_restriction"), 2e-3);
  const double usual = advise(&q, &leaks, &blocked).usual;
  lab_advice advice;
  lab_error error;
  (void)state;
  assert_int_equal(lab_trials_build(&rig, &trials, &error), LAB_OK);
  stage_open(&rig, &trials.usual, trials.settle, &s);
  q.recorded = &s.schedule;
  q.recorded_duration = trials.usual.duration;
  advice = advise(&q, &leaks, &blocked);
  assert_close(advice.usual, usual, 0, 1e-9);
  assert_non_null(strstr(advice.why, "what has been recorded"));
  q.recorded_duration = trials.usual.t[2]; /* without the vent */
  assert_true(advise(&q, &leaks, &blocked).usual < 0.5 * usual);
  lab_outlook_close(&s.outlook);
}

/* ---- Where there is no advice ---- */

static void expect_reason(const lab_rig *rig, const char *reason)
{
  const lab_inquiry q = make_inquiry(rig);
  lab_advice advice = advise(&q, &rig->params, &rig->params);
  lab_error error = {0, ""};
  assert_int_equal(advice.kind, LAB_ADVICE_NONE);
  assert_non_null(strstr(advice.text, reason));
  memset(&advice, 0x55, sizeof advice);
  assert_int_equal(lab_advise_interval(&q, &rig->params, &advice, &error), LAB_OK);
  assert_int_equal(advice.kind, LAB_ADVICE_NONE);
  assert_non_null(strstr(advice.text, reason));
}

static void test_lab_separate__no_command_moves_a_stem__says_why(void **state)
{
  lab_rig rig = make_rig();
  (void)state;
  rig.params.stroke = 0;
  expect_reason(&rig, "vessel");
  rig = make_rig();
  rig.laws.pressure_input = 1;
  expect_reason(&rig, "pressure drives the model");
  rig = make_rig();
  rig.laws.position_input = 1;
  expect_reason(&rig, "position drives the model");
  rig = make_rig();
  rig.params.proportional_band = 1e4;
  expect_reason(&rig, "set pressures");
  rig = make_rig();
  rig.params.supply_pressure = (pneu_real)1.2e5;
  expect_reason(&rig, "does not move the stem");
}

static void test_lab_separate__inquiry_that_is_none__says_what_was_expected(void **state)
{
  const lab_rig rig = make_rig();
  lab_inquiry q = make_inquiry(&rig);
  lab_advice advice;
  lab_error error;
  (void)state;
  q.spacing = 0;
  assert_int_equal(lab_separate(&q, &rig.params, &rig.params, &advice, &error), LAB_DATA);
  assert_non_null(strstr(error.text, "spacing"));
  q = make_inquiry(&rig);
  q.noise[LAB_CHANNEL_P] = 0;
  assert_int_equal(lab_separate(&q, &rig.params, &rig.params, &advice, &error), LAB_DATA);
  assert_non_null(strstr(error.text, "channel p"));
  q.noise[LAB_CHANNEL_P] = q.noise[LAB_CHANNEL_X] = (double)NAN;
  assert_int_equal(lab_separate(&q, &rig.params, &rig.params, &advice, &error), LAB_DATA);
  assert_non_null(strstr(error.text, "recorded channel"));
}

/* ---- Intervals ---- */

static void test_lab_advise_interval__stribeck_undetected__asks_for_slow_motion(void **state)
{
  const lab_rig rig = make_rig();
  lab_inquiry q = make_inquiry(&rig);
  int fit[COUNT(fitted) + 1];
  lab_advice advice;
  lab_error error;
  (void)state;
  memcpy(fit, fitted, sizeof fitted);
  fit[q.n_fit++] = param_of("stribeck_friction");
  q.fit = fit;
  assert_int_equal(lab_advise_interval(&q, &rig.params, &advice, &error), LAB_OK);
  assert_int_equal(advice.kind, LAB_ADVICE_TRIAL);
  assert_int_equal(advice.param, fit[COUNT(fitted)]);
  assert_non_null(strstr(advice.text, "slow stroke"));
  assert_non_null(strstr(advice.why, "stribeck_friction"));
  assert_true(advice.after < 0.1 * advice.before);
}

/* One parameter: information adds up, and that of the trial alone is the sum of squared slopes. */
static void test_lab_advise_interval__one_parameter__is_the_information_of_both_records(void **state)
{
  static lab_trials trials;
  static double y[LAB_FORESEEN * 1501], slope[LAB_FORESEEN * 1501];
  static stage s;
  static const int only[] = {PNEU_PARAM_spring_rate};
  const lab_rig rig = make_rig();
  const double scale = (double)rig.params.spring_rate;
  lab_inquiry q = make_inquiry(&rig);
  double information[2];
  lab_advice advice;
  lab_error error;
  int i, k;
  (void)state;
  q.n_fit = 1;
  q.fit = only;
  assert_int_equal(lab_advise_interval(&q, &rig.params, &advice, &error), LAB_OK);
  assert_int_equal(advice.kind, LAB_ADVICE_TRIAL);
  assert_int_equal(lab_trials_build(&rig, &trials, &error), LAB_OK);
  for (k = 0; k < 2; k++) {
    int n;
    stage_open(&rig, k ? &advice.trial : &trials.usual, trials.settle, &s);
    n = s.outlook.n;
    assert_int_equal(lab_foresee(&s.outlook, &rig.params, y, NULL, &error), LAB_OK);
    assert_int_equal(lab_foresee_slopes(&s.outlook, &rig.params, 1, only, &scale, y, slope, &error), LAB_OK);
    information[k] = 0;
    for (i = 0; i < 2 * n; i++)
      information[k] += pow(slope[i] / (i < n ? 320 : 2e-5), 2) * (s.outlook.t[1] - s.outlook.t[0]) / q.spacing;
    lab_outlook_close(&s.outlook);
  }
  assert_close(advice.before, 1.959964 / sqrt(information[0]), 0, 1e-4);
  assert_close(advice.after, 1.959964 / sqrt(information[0] + information[1]), 0, 1e-4);
  assert_non_null(strstr(advice.why, "would narrow spring_rate from +-"));
}

/* ---- Trials ---- */

static const lab_trial *find_trial(const lab_trials *trials, const char *text)
{
  int i;
  for (i = 0; i < trials->n; i++)
    if (strstr(trials->trial[i].text, text))
      return &trials->trial[i];
  fail();
  return NULL;
}

static void test_lab_trials_build__hold_at_80_percent__stem_stands_there(void **state)
{
  static lab_trials trials;
  static double y[LAB_FORESEEN * 1501];
  static stage s;
  const lab_rig rig = make_rig();
  const lab_trial *hold;
  lab_error error;
  int i;
  (void)state;
  assert_int_equal(lab_trials_build(&rig, &trials, &error), LAB_OK);
  hold = find_trial(&trials, "hold at 80 % travel with both orifices shut for 10 s");
  assert_int_equal(hold->n, 4);
  assert_close(hold->t[3] - hold->t[2], 10, 1e-9, 0);
  stage_open(&rig, hold, trials.settle, &s);
  assert_int_equal(lab_foresee(&s.outlook, &rig.params, y, NULL, &error), LAB_OK);
  for (i = 0; i < s.outlook.n && s.outlook.t[i] < hold->t[3]; i++)
    if (s.outlook.t[i] > hold->t[2] + 0.5)
      assert_close(y[s.outlook.n + i] / (double)rig.params.stroke, 0.8, 0.01, 0);
  assert_close(y[2 * s.outlook.n - 1], 0, 1e-9, 0);
  lab_outlook_close(&s.outlook);
}

static void test_lab_trials_build__both_actuators__every_template_in_order_of_time(void **state)
{
  int actuator, i, k;
  (void)state;
  for (actuator = 0; actuator < FIXTURE_ACTUATORS; actuator++) {
    static lab_trials trials;
    lab_rig rig = make_rig();
    lab_error error;
    rig.params = fixture_params(actuator);
    assert_int_equal(lab_trials_build(&rig, &trials, &error), LAB_OK);
    assert_int_equal(trials.n, 14);
    for (i = 0; i < trials.n; i++) {
      const lab_trial *trial = &trials.trial[i];
      check_note("actuator %d: %s", actuator, trial->text);
      assert_true(trial->n >= 2 && trial->t[0] == 0 && trial->duration > trial->t[trial->n - 1]);
      for (k = 1; k < trial->n; k++)
        assert_true(trial->t[k] > trial->t[k - 1] && fabs(trial->u[k]) <= 1);
    }
  }
}

/* A small trickle of command meets a leak that lets as much out: the slow strokes cannot be done. */
static void test_lab_trials_build__leak_as_large_as_a_slow_opening__leaves_slow_strokes_out(void **state)
{
  static lab_trials trials;
  lab_rig rig = make_rig();
  lab_error error;
  (void)state;
  rig.params = with(&rig, param_of("chamber_leak"), 0.15 * (double)rig.params.fill_area);
  assert_int_equal(lab_trials_build(&rig, &trials, &error), LAB_OK);
  assert_int_equal(trials.n, 12);
  find_trial(&trials, "three full strokes");
}

static void test_trial_choose__ties__go_to_the_shortest(void **state)
{
  static lab_trials trials;
  const double duration[] = {40, 10, 20, 5, 1};
  const double value[] = {50, 47, 46, 44, (double)NAN};
  int i;
  (void)state;
  trials.n = 5;
  for (i = 0; i < trials.n; i++)
    trials.trial[i].duration = duration[i];
  assert_int_equal(trial_choose(&trials, value, 100), 1);
  assert_int_equal(trial_choose(&trials, value, 48), 3);
  trials.n = 1;
  assert_int_equal(trial_choose(&trials, value, 100), 0);
  assert_int_equal(trial_choose(&trials, value + 4, 100), -1);
}

/* ---- Normal equations ---- */

enum { M = 40, K = 3 };

/* Smooth columns with nothing in common, d last. */
static void make_columns(double column[K + 1][M], const double *pointer[K + 1])
{
  int i, j;
  for (j = 0; j <= K; j++) {
    pointer[j] = column[j];
    for (i = 0; i < M; i++)
      column[j][i] = pow(10, j) * (cos(0.1 * (j + 1) * i) + 0.01 * i * j);
  }
}

/* Gram-Schmidt, twice for good measure. */
static double rest_by_gram_schmidt(double column[K + 1][M])
{
  double sum = 0;
  int i, j, l, pass;
  for (j = 0; j <= K; j++)
    for (pass = 0; pass < 2; pass++)
      for (l = 0; l < j; l++) {
        double dot = 0, square = 0;
        for (i = 0; i < M; i++) {
          dot += column[j][i] * column[l][i];
          square += column[l][i] * column[l][i];
        }
        for (i = 0; i < M; i++)
          column[j][i] -= dot / square * column[l][i];
      }
  for (i = 0; i < M; i++)
    sum += column[K][i] * column[K][i];
  return sqrt(sum);
}

static void test_lab_normal_rest__is_what_gram_schmidt_leaves(void **state)
{
  static double column[K + 1][M];
  const double *pointer[K + 1];
  lab_normal normal;
  double rest;
  (void)state;
  make_columns(column, pointer);
  lab_normal_clear(&normal, K);
  lab_normal_add_rows(&normal, pointer, M);
  rest = lab_normal_rest(&normal);
  assert_true(rest < 0.9 * sqrt(normal.g[K][K]) && rest > 0);
  assert_close(rest, rest_by_gram_schmidt(column), 0, 1e-8);
}

/* What tells the last column from the first is d itself: were that counted, nothing of d would be left. */
static void test_lab_normal_rest__column_nearly_twice__counts_once(void **state)
{
  static double column[K + 1][M];
  const double *pointer[K + 1];
  const int two[] = {0, 1};
  lab_normal normal, part;
  int i;
  (void)state;
  make_columns(column, pointer);
  for (i = 0; i < M; i++)
    column[2][i] = column[0][i] + 1e-8 * column[K][i];
  lab_normal_clear(&normal, K);
  lab_normal_add_rows(&normal, pointer, M);
  lab_normal_select(&normal, 2, two, &part);
  assert_close(lab_normal_rest(&normal), lab_normal_rest(&part), 0, 1e-9);
}

static void test_lab_normal_select__any_order__takes_the_same_rows(void **state)
{
  static double column[K + 1][M];
  const double *pointer[K + 1], *turned[3];
  const int keep[] = {2, 0};
  lab_normal normal, part, again;
  int i, j;
  (void)state;
  make_columns(column, pointer);
  lab_normal_clear(&normal, K);
  lab_normal_add_rows(&normal, pointer, M);
  lab_normal_select(&normal, 2, keep, &part);
  turned[0] = column[2];
  turned[1] = column[0];
  turned[2] = column[K];
  lab_normal_clear(&again, 2);
  lab_normal_add_rows(&again, turned, M);
  assert_int_equal(part.k, 2);
  for (i = 0; i < 3; i++)
    for (j = i; j < 3; j++)
      assert_close(part.g[i][j], again.g[i][j], 0, 1e-12);
}

static void test_lab_normal_step__combination_of_the_columns__is_found(void **state)
{
  static double column[K + 1][M];
  const double *pointer[K + 1], prior[K] = {1e6, 1e6, 1e6}, want[K] = {3, -0.2, 0.01};
  double step[K];
  lab_normal normal;
  int i, j;
  (void)state;
  make_columns(column, pointer);
  for (i = 0; i < M; i++)
    column[K][i] = want[0] * column[0][i] + want[1] * column[1][i] + want[2] * column[2][i];
  lab_normal_clear(&normal, K);
  lab_normal_add_rows(&normal, pointer, M);
  lab_normal_step(&normal, prior, step);
  for (j = 0; j < K; j++)
    assert_close(step[j], want[j], 0, 1e-6);
}

static void test_lab_normal_shift__d_less_the_combination__is_that_of_new_rows(void **state)
{
  static double column[K + 1][M];
  const double *pointer[K + 1], change[K] = {2, -0.3, 0.05};
  lab_normal normal, again;
  int i, j;
  (void)state;
  make_columns(column, pointer);
  lab_normal_clear(&normal, K);
  lab_normal_add_rows(&normal, pointer, M);
  lab_normal_shift(&normal, change);
  for (i = 0; i < M; i++)
    column[K][i] -= change[0] * column[0][i] + change[1] * column[1][i] + change[2] * column[2][i];
  lab_normal_clear(&again, K);
  lab_normal_add_rows(&again, pointer, M);
  for (j = 0; j <= K; j++)
    assert_close(normal.g[j][K], again.g[j][K], 1e-6, 1e-10);
}

/* J'J + 1/prior^2 = [[5, 2], [2, 2]], whose inverse is [[1/3, -1/3], [-1/3, 5/6]]. */
static void test_lab_normal_deviations__two_unknowns__are_those_of_the_inverse(void **state)
{
  const double prior[] = {1, 1};
  double deviation[2];
  lab_normal normal;
  (void)state;
  lab_normal_clear(&normal, 2);
  normal.g[0][0] = 4;
  normal.g[0][1] = 2;
  normal.g[1][1] = 1;
  lab_normal_deviations(&normal, prior, deviation);
  assert_close(deviation[0], sqrt(1.0 / 3), 1e-12, 0);
  assert_close(deviation[1], sqrt(5.0 / 6), 1e-12, 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_lab_separate__leak_or_droop__asks_for_a_hold_with_both_orifices_shut),
      cmocka_unit_test(test_lab_separate__separation__is_what_an_independent_fit_to_both_records_leaves),
      cmocka_unit_test(test_lab_separate__estimates_too_large__best_of_the_settled_wins),
      cmocka_unit_test(test_lab_separate__models_exchanged__same_advice),
      cmocka_unit_test(test_lab_separate__one_model_twice__nothing_separates_it),
      cmocka_unit_test(test_lab_separate__one_thing_under_two_names__nothing_separates_it),
      cmocka_unit_test(test_lab_separate__lag_or_skew_of_position__says_that_no_schedule_and_no_sensor_does),
      cmocka_unit_test(test_lab_separate__position_alone_too_little__names_the_sensor_to_add),
      cmocka_unit_test(test_lab_separate__record_at_hand__is_judged_in_the_place_of_a_fill_and_vent),
      cmocka_unit_test(test_lab_separate__no_command_moves_a_stem__says_why),
      cmocka_unit_test(test_lab_separate__inquiry_that_is_none__says_what_was_expected),
      cmocka_unit_test(test_lab_advise_interval__stribeck_undetected__asks_for_slow_motion),
      cmocka_unit_test(test_lab_advise_interval__one_parameter__is_the_information_of_both_records),
      cmocka_unit_test(test_lab_trials_build__hold_at_80_percent__stem_stands_there),
      cmocka_unit_test(test_lab_trials_build__both_actuators__every_template_in_order_of_time),
      cmocka_unit_test(test_lab_trials_build__leak_as_large_as_a_slow_opening__leaves_slow_strokes_out),
      cmocka_unit_test(test_trial_choose__ties__go_to_the_shortest),
      cmocka_unit_test(test_lab_normal_rest__is_what_gram_schmidt_leaves),
      cmocka_unit_test(test_lab_normal_rest__column_nearly_twice__counts_once),
      cmocka_unit_test(test_lab_normal_select__any_order__takes_the_same_rows),
      cmocka_unit_test(test_lab_normal_step__combination_of_the_columns__is_found),
      cmocka_unit_test(test_lab_normal_shift__d_less_the_combination__is_that_of_new_rows),
      cmocka_unit_test(test_lab_normal_deviations__two_unknowns__are_those_of_the_inverse),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Which test to record next: the trials, what they separate, what they narrow. */
#include <nlopt.h>

#include "../../fixture.h"
#include "../../words.h"

#include "../../../apps/lab/discriminate/discriminate_private.h"

static const int fitted[] = {LAB_PARAM_ORIFICE_AREA, PNEU_PARAM_dry_friction, PNEU_PARAM_spring_rate,
                             PNEU_PARAM_spring_preload, PNEU_PARAM_damping};

static lab_test_plans plans;
static lab_advice advice; /* that was asked for last */

/* The R1-400 with 40 cm3 of dead volume, ordinary sensors of pressure and position. */
static lab_rig make_rig(void)
{
  lab_rig rig;
  lab_rig_default(&rig);
  rig.laws.flow = PNEU_FLOW_CHOKED;
  rig.params.dead_volume = (pneu_real)4e-5;
  return rig;
}

static lab_advice_request make_inquiry(const lab_rig *rig)
{
  lab_advice_request q = {.rig = rig, .spacing = 0.005, .n_fit = COUNT(fitted), .fit = fitted};
  int c;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    q.noise[c] = (double)NAN;
  q.noise[LAB_CHANNEL_P] = 320;
  q.noise[LAB_CHANNEL_X] = 2e-5;
  return q;
}

static void build_plans(const lab_rig *rig)
{
  succeed(lab_test_plans_build(rig, &plans, &error));
}

/* Index of a parameter of an effect; the test is skipped where the effect was trimmed away. */
static int param_of(const char *effect)
{
  const int e = pneu_effect_find(effect);
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

/* ---- An independent refit: NLopt on whole predictions ---- */

enum { FREE_MAX = 8 };

typedef struct refit {
  const lab_advice_request *request;
  int n_records;
  const lab_forecast *forecast[2];
  pneu_params base;
  int n, param[FREE_MAX];
  double goal[2][LAB_FORECAST_CHANNELS * 1501];
} refit;

static void predict(const lab_forecast *forecast, const pneu_params *params, double *y)
{
  succeed(lab_forecast_run(forecast, params, y, NULL, &error));
}

static void shift(const refit *f, const double *z, pneu_params *params)
{
  int i;
  for (i = 0; i < f->n; i++)
    lab_forecast_shift(params, f->param[i], z[i], lab_forecast_scale(&f->base, f->param[i]));
}

/* Sum of squares of the errors over noise. */
static double chi2(unsigned n, const double *z, double *gradient, void *context)
{
  static double y[LAB_FORECAST_CHANNELS * 1501];
  const refit *f = context;
  pneu_params params = f->base;
  double sum = 0;
  int record, i;
  (void)n, (void)gradient;
  shift(f, z, &params);
  for (record = 0; record < f->n_records; record++) {
    const lab_forecast *o = f->forecast[record];
    const double weight = (o->t[1] - o->t[0]) / f->request->spacing;
    predict(o, &params, y);
    for (i = 0; i < 2 * o->n; i++) { /* pressure, then position */
      const double r = (y[i] - f->goal[record][i]) / f->request->noise[i < o->n ? LAB_CHANNEL_P : LAB_CHANNEL_X];
      sum += weight * r * r;
    }
  }
  return sum;
}

/* Fit `from` to what `goal` predicts, parameter `own` and those fitted anyway.
 * In/out: from   Returns: length of what is left [sigma] */
static double fit_to(refit *f, const pneu_params *goal, pneu_params *from, int own)
{
  enum { ROUNDS = 2 };
  double z[FREE_MAX] = {0}, least = 0;
  int i;
  f->base = *from;
  for (f->n = 0; f->n < COUNT(fitted); f->n++)
    f->param[f->n] = fitted[f->n];
  f->param[f->n++] = own;
  for (i = 0; i < f->n_records; i++)
    predict(f->forecast[i], goal, f->goal[i]);
  for (i = 0; i < ROUNDS; i++) { /* its quadratic model is new each time */
    nlopt_opt opt = nlopt_create(NLOPT_LN_NEWUOA, (unsigned)f->n);
    nlopt_set_min_objective(opt, chi2, f);
    nlopt_set_initial_step1(opt, 0.02);
    nlopt_set_ftol_rel(opt, 1e-8);
    nlopt_set_maxeval(opt, 1000);
    nlopt_optimize(opt, z, &least);
    nlopt_destroy(opt);
  }
  shift(f, z, from);
  return sqrt(least);
}

/* ---- A trial as a forecast ---- */

typedef struct stage {
  pneu_input input[LAB_TEST_PLAN_STEPS];
  lab_schedule schedule;
  lab_forecast forecast;
} stage;

/* For a rig whose plans are built. */
static void stage_open(const lab_rig *rig, const lab_test_plan *plan, stage *s)
{
  const pneu_model model = fixture_model(&rig->params, rig->laws.gas, rig->laws.flow);
  int i;
  for (i = 0; i < plan->n; i++)
    s->input[i] = fixture_input(&model, plan->u[i]);
  s->schedule = (lab_schedule){(size_t)plan->n, plan->t, s->input};
  succeed(lab_forecast_open(rig, &s->schedule, plans.settle, plan->duration, 0.005, &s->forecast, &error));
}

static refit f;
static stage s;

/* A leak and a drooping supply of a size that a fill and vent cannot tell apart. */
static void make_alike(const lab_rig *rig, const lab_advice_request *q, pneu_params *leaks, pneu_params *droops)
{
  const int leak = param_of("chamber_leak"), droop = param_of("supply_droop");
  *leaks = with(rig, leak, 3e-10);
  *droops = with(rig, droop, 1e5);
  build_plans(rig);
  stage_open(rig, &plans.usual, &s);
  f = (refit){.request = q, .n_records = 1, .forecast = {&s.forecast, NULL}};
  assert_between(fit_to(&f, leaks, droops, droop), 0.5, 2);
  lab_forecast_close(&s.forecast);
}

static lab_advice advise(const lab_advice_request *q, const pneu_params *a, const pneu_params *b)
{
  succeed(lab_discriminate(q, a, b, &advice, &error));
  return advice;
}

/* ---- Separation ---- */

TEST(test_lab_discriminate__leak_or_droop__asks_for_a_hold_with_both_orifices_shut)
{
  const lab_rig rig = make_rig();
  const lab_advice_request q = make_inquiry(&rig);
  pneu_params leaks, droops;
  int i, shut = 0;
  make_alike(&rig, &q, &leaks, &droops);
  advise(&q, &leaks, &droops);
  assert_int_equal(advice.kind, LAB_ADVICE_TEST);
  assert_contains(advice.text, "hold at");
  assert_string_equal(advice.text, advice.plan.text);
  assert_true(advice.usual < 2);
  assert_true(advice.separation > 5 && advice.separation > 4 * advice.usual);
  for (i = 0; i + 1 < advice.plan.n; i++)
    shut |= advice.plan.u[i] == 0 && advice.plan.t[i + 1] - advice.plan.t[i] >= 10;
  assert_true(shut);
}

/* What has been recorded counts by its slopes: a tenth of the whole is what its curvature may take. */
TEST(test_lab_discriminate__separation__is_what_an_independent_fit_to_both_records_leaves)
{
  static stage before, after;
  const lab_rig rig = make_rig();
  const lab_advice_request q = make_inquiry(&rig);
  pneu_params leaks, droops, back;
  double one, other;
  make_alike(&rig, &q, &leaks, &droops);
  advise(&q, &leaks, &droops);
  assert_int_equal(advice.kind, LAB_ADVICE_TEST);
  build_plans(&rig);
  stage_open(&rig, &plans.usual, &before);
  stage_open(&rig, &advice.plan, &after);
  f = (refit){.request = &q, .n_records = 2, .forecast = {&before.forecast, &after.forecast}};
  back = leaks;
  one = fit_to(&f, &droops, &back, param_of("chamber_leak"));
  other = fit_to(&f, &leaks, &droops, param_of("supply_droop"));
  assert_close(advice.separation, fmin(one, other), 0, 0.1);
  lab_forecast_close(&before.forecast);
  lab_forecast_close(&after.forecast);
}

/* A valley: what is left falls by a tenth a step for several steps. */
TEST(test_lab_discriminate__back_pressure_or_narrow_vent__fitted_to_the_end_of_the_valley)
{
  const lab_rig rig = make_rig();
  const lab_advice_request q = make_inquiry(&rig);
  const int pressure = param_of("exhaust_back_pressure"), vent = param_of("vent_restriction");
  pneu_param_info info;
  pneu_params backs, narrow, other;
  double one;
  pneu_param_describe(pressure, &info);
  backs = with(&rig, pressure, 0.95 * (double)info.neutral + 0.05 * (double)info.value);
  pneu_param_describe(vent, &info);
  narrow = with(&rig, vent, 0.95 * (double)info.neutral + 0.05 * (double)info.value);
  advise(&q, &backs, &narrow);
  build_plans(&rig);
  stage_open(&rig, &plans.usual, &s);
  f = (refit){.request = &q, .n_records = 1, .forecast = {&s.forecast, NULL}};
  other = narrow;
  one = fit_to(&f, &backs, &other, vent);
  other = backs;
  assert_close(advice.usual, fmin(one, fit_to(&f, &narrow, &other, pressure)), 0.1, 0);
  lab_forecast_close(&s.forecast);
}

/* With nothing but a moment of rest recorded, estimates are several times too large; the trial that is best after
 * fitting again must win all the same. */
TEST(test_lab_discriminate__estimates_too_large__best_of_the_settled_wins)
{
  static stage rest;
  static const lab_test_plan still = {"rest", 1, {0}, {0}, 0.5};
  const lab_rig rig = make_rig();
  lab_advice_request q = make_inquiry(&rig);
  lab_forecast_model leaks = {with(&rig, param_of("chamber_leak"), 1e-9), 0, {0}, {0}};
  lab_forecast_model droops = {with(&rig, param_of("supply_droop"), 6e5), 0, {0}, {0}};
  lab_normal nothing;
  int i, k;
  build_plans(&rig);
  stage_open(&rig, &still, &rest);
  q.recorded = &rest.schedule;
  q.recorded_duration = still.duration;
  advise(&q, &leaks.params, &droops.params);
  for (k = 0; k < COUNT(fitted); k++) {
    lab_side_add(&leaks, fitted[k], &error);
    lab_side_add(&droops, fitted[k], &error);
  }
  lab_side_add(&leaks, param_of("chamber_leak"), &error);
  lab_side_add(&droops, param_of("supply_droop"), &error);
  lab_normal_clear(&nothing, leaks.n);
  for (i = 0; i < 6; i++) { /* the holds */
    double one, other;
    stage_open(&rig, &plans.plan[i], &s);
    succeed(lab_discrepancy(&q, &s.forecast, &droops.params, &leaks, &nothing, &one, &error));
    succeed(lab_discrepancy(&q, &s.forecast, &leaks.params, &droops, &nothing, &other, &error));
    check_note("%s", plans.plan[i].text);
    assert_true(advice.separation >= 0.9 * fmin(one, other));
    lab_forecast_close(&s.forecast);
  }
  lab_forecast_close(&rest.forecast);
}

TEST(test_lab_discriminate__models_exchanged__same_advice)
{
  const lab_rig rig = make_rig();
  const lab_advice_request q = make_inquiry(&rig);
  const pneu_params leaks = with(&rig, param_of("chamber_leak"), 1e-9);
  const pneu_params blocked = with(&rig, param_of("vent_restriction"), 2e-3);
  const lab_advice one = advise(&q, &leaks, &blocked), other = advise(&q, &blocked, &leaks);
  assert_string_equal(one.text, other.text);
  assert_string_equal(one.why, other.why);
  assert_true(one.separation > 0);
  assert_true(one.separation == other.separation && one.usual == other.usual);
}

TEST(test_lab_discriminate__one_model_twice__nothing_separates_it)
{
  const lab_rig rig = make_rig();
  const lab_advice_request q = make_inquiry(&rig);
  const pneu_params leaks = with(&rig, param_of("chamber_leak"), 1e-8);
  advise(&q, &leaks, &leaks);
  assert_int_equal(advice.kind, LAB_ADVICE_NONE);
  assert_true(advice.separation == 0 && advice.usual == 0);
}

TEST(test_lab_discriminate__one_thing_under_two_names__nothing_separates_it)
{
  const lab_rig rig = make_rig();
  const lab_advice_request q = make_inquiry(&rig);
  const pneu_params blocked = with(&rig, param_of("vent_restriction"), 0.1);
  const pneu_params small = with(&rig, PNEU_PARAM_vent_area, 0.9 * (double)rig.params.vent_area);
  advise(&q, &blocked, &small);
  assert_int_equal(advice.kind, LAB_ADVICE_NONE);
  assert_true(advice.separation < 0.1);
}

/* A first-order lag and a delay of equal time differ in the second order of that time only. */
TEST(test_lab_discriminate__lag_or_skew_of_position__says_that_no_schedule_and_no_sensor_does)
{
  const lab_rig rig = make_rig();
  lab_advice_request q = make_inquiry(&rig);
  const pneu_params lags = with(&rig, param_of("position_lag"), 1e-3);
  const pneu_params late = with(&rig, param_of("channel_skew"), 1e-3);
  const double pressure_noise[] = {320, (double)NAN};
  int i;
  for (i = 0; i < COUNT(pressure_noise); i++) {
    q.noise[LAB_CHANNEL_P] = pressure_noise[i];
    advise(&q, &lags, &late);
    assert_int_equal(advice.kind, LAB_ADVICE_NONE);
    assert_contains(advice.text, "no schedule of the set separates them");
    assert_contains(advice.text, "nor with one more");
  }
}

TEST(test_lab_discriminate__position_alone_too_little__names_the_sensor_to_add)
{
  const lab_rig rig = make_rig();
  lab_advice_request q = make_inquiry(&rig);
  pneu_params leaks, droops;
  make_alike(&rig, &q, &leaks, &droops);
  q.noise[LAB_CHANNEL_P] = (double)NAN;
  advise(&q, &leaks, &droops);
  assert_int_equal(advice.kind, LAB_ADVICE_SENSOR);
  assert_true(advice.channel == LAB_CHANNEL_P || advice.channel == LAB_CHANNEL_PS);
  assert_contains(advice.text, "record p");
  assert_true(advice.separation < 5 && advice.with_sensor > 5);
  assert_true(advice.plan.n > 2);
}

TEST(test_lab_discriminate__record_at_hand__is_judged_in_the_place_of_a_fill_and_vent)
{
  const lab_rig rig = make_rig();
  lab_advice_request q = make_inquiry(&rig);
  const pneu_params leaks = with(&rig, param_of("chamber_leak"), 1e-9);
  const pneu_params blocked = with(&rig, param_of("vent_restriction"), 2e-3);
  const double usual = advise(&q, &leaks, &blocked).usual;
  build_plans(&rig);
  stage_open(&rig, &plans.usual, &s);
  q.recorded = &s.schedule;
  q.recorded_duration = plans.usual.duration;
  advise(&q, &leaks, &blocked);
  assert_close(advice.usual, usual, 0, 1e-9);
  assert_contains(advice.why, "what has been recorded");
  q.recorded_duration = plans.usual.t[2]; /* without the vent */
  assert_true(advise(&q, &leaks, &blocked).usual < 0.5 * usual);
  lab_forecast_close(&s.forecast);
}

/* ---- Where there is no advice ---- */

static void expect_reason(const lab_rig *rig, const char *reason)
{
  const lab_advice_request q = make_inquiry(rig);
  advise(&q, &rig->params, &rig->params);
  assert_int_equal(advice.kind, LAB_ADVICE_NONE);
  assert_contains(advice.text, reason);
  memset(&advice, 0x55, sizeof advice);
  succeed(lab_advise_precision(&q, &rig->params, &advice, &error));
  assert_int_equal(advice.kind, LAB_ADVICE_NONE);
  assert_contains(advice.text, reason);
}

TEST(test_lab_discriminate__no_command_moves_a_stem__says_why)
{
  lab_rig rig = make_rig();
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

TEST(test_lab_discriminate__inquiry_that_is_none__says_what_was_expected)
{
  const lab_rig rig = make_rig();
  lab_advice_request q = make_inquiry(&rig);
  q.spacing = 0;
  assert_fails(lab_discriminate(&q, &rig.params, &rig.params, &advice, &error), LAB_DATA, "spacing");
  q = make_inquiry(&rig);
  q.noise[LAB_CHANNEL_P] = 0;
  assert_fails(lab_discriminate(&q, &rig.params, &rig.params, &advice, &error), LAB_DATA, "channel p");
  q.noise[LAB_CHANNEL_P] = q.noise[LAB_CHANNEL_X] = (double)NAN;
  assert_fails(lab_discriminate(&q, &rig.params, &rig.params, &advice, &error), LAB_DATA, "recorded channel");
}

/* ---- Intervals ---- */

TEST(test_lab_advise_precision__stribeck_undetected__asks_for_slow_motion)
{
  const lab_rig rig = make_rig();
  lab_advice_request q = make_inquiry(&rig);
  int fit[COUNT(fitted) + 1];
  memcpy(fit, fitted, sizeof fitted);
  fit[q.n_fit++] = param_of("stribeck_friction");
  q.fit = fit;
  succeed(lab_advise_precision(&q, &rig.params, &advice, &error));
  assert_int_equal(advice.kind, LAB_ADVICE_TEST);
  assert_int_equal(advice.param, fit[COUNT(fitted)]);
  assert_contains(advice.text, "slow stroke");
  assert_contains(advice.why, "stribeck_friction");
  assert_true(advice.after < 0.1 * advice.before);
}

/* Where the time is spent nothing is simulated, and that is what is said. */
TEST(test_lab_advise_precision__no_time__says_so)
{
  const lab_rig rig = make_rig();
  lab_advice_request q = make_inquiry(&rig);
  q.until = 1e-9;
  succeed(lab_advise_precision(&q, &rig.params, &advice, &error));
  assert_int_equal(advice.kind, LAB_ADVICE_NONE);
  assert_string_equal(advice.text, "there was no time to look for one");
}

/* What was found is to be known first, though a fitted value may be known less well; what is not, where nothing was
 * found. */
TEST(test_lab_advise_precision__what_was_found__goes_first)
{
  const lab_rig rig = make_rig();
  lab_advice_request q = make_inquiry(&rig);
  int fit[COUNT(fitted) + 1];
  lab_advice each[2];
  int i;
  memcpy(fit, fitted, sizeof fitted);
  q.fit = fit;
  q.n_known = q.n_fit;
  fit[q.n_fit++] = PNEU_PARAM_spring_rate;
  for (i = 0; i < COUNT(fitted); i++) /* each once */
    if (fit[i] == PNEU_PARAM_spring_rate)
      fit[i] = PNEU_PARAM_moving_mass;
  for (i = 0; i < 2; i++, q.n_known = 0)
    succeed(lab_advise_precision(&q, &rig.params, &each[i], &error));
  assert_int_equal(each[0].kind, LAB_ADVICE_TEST);
  assert_int_equal(each[0].param, PNEU_PARAM_spring_rate);
  assert_int_not_equal(each[1].param, PNEU_PARAM_spring_rate);
}

/* One parameter: information adds up, and that of the trial alone is the sum of squared slopes. */
TEST(test_lab_advise_precision__one_parameter__is_the_information_of_both_records)
{
  static double y[LAB_FORECAST_CHANNELS * 1501], slope[LAB_FORECAST_CHANNELS * 1501];
  static const int only[] = {PNEU_PARAM_spring_rate};
  const lab_rig rig = make_rig();
  const lab_forecast_model model = {rig.params, 1, {only[0]}, {(double)rig.params.spring_rate}};
  lab_advice_request q = make_inquiry(&rig);
  double information[2];
  int i, k;
  q.n_fit = 1;
  q.fit = only;
  succeed(lab_advise_precision(&q, &rig.params, &advice, &error));
  assert_int_equal(advice.kind, LAB_ADVICE_TEST);
  build_plans(&rig);
  for (k = 0; k < 2; k++) {
    int n;
    stage_open(&rig, k ? &advice.plan : &plans.usual, &s);
    n = s.forecast.n;
    succeed(lab_forecast_run(&s.forecast, &rig.params, y, NULL, &error));
    succeed(lab_forecast_slopes(&s.forecast, &model, y, slope, &error));
    information[k] = 0;
    for (i = 0; i < 2 * n; i++)
      information[k] += pow(slope[i] / (i < n ? 320 : 2e-5), 2) * (s.forecast.t[1] - s.forecast.t[0]) / q.spacing;
    lab_forecast_close(&s.forecast);
  }
  assert_close(advice.before, 1.959964 / sqrt(information[0]), 0, 1e-4);
  assert_close(advice.after, 1.959964 / sqrt(information[0] + information[1]), 0, 1e-4);
  assert_contains(advice.why, "would narrow the interval of spring_rate to ");
}

/* ---- Trials ---- */

static const lab_test_plan *find_trial(const char *text)
{
  int i;
  for (i = 0; i < plans.n; i++)
    if (strstr(plans.plan[i].text, text))
      return &plans.plan[i];
  fail();
  return NULL;
}

TEST(test_lab_test_plans_build__hold_at_80_percent__stem_stands_there)
{
  static double y[LAB_FORECAST_CHANNELS * 1501];
  const lab_rig rig = make_rig();
  const lab_test_plan *hold;
  int i;
  build_plans(&rig);
  hold = find_trial("hold at 80 % travel with both orifices shut for 10 s");
  assert_int_equal(hold->n, 4);
  assert_close(hold->t[3] - hold->t[2], 10, 1e-9, 0);
  stage_open(&rig, hold, &s);
  succeed(lab_forecast_run(&s.forecast, &rig.params, y, NULL, &error));
  for (i = 0; i < s.forecast.n && s.forecast.t[i] < hold->t[3]; i++)
    if (s.forecast.t[i] > hold->t[2] + 0.5)
      assert_close(y[s.forecast.n + i] / (double)rig.params.stroke, 0.8, 0.01, 0);
  assert_close(y[2 * s.forecast.n - 1], 0, 1e-9, 0);
  lab_forecast_close(&s.forecast);
}

TEST(test_lab_test_plans_build__both_actuators__every_template_in_order_of_time)
{
  int actuator, i, k;
  for (actuator = 0; actuator < FIXTURE_ACTUATORS; actuator++) {
    lab_rig rig = make_rig();
    rig.params = fixture_params(actuator);
    build_plans(&rig);
    assert_int_equal(plans.n, 14);
    for (i = 0; i < plans.n; i++) {
      const lab_test_plan *plan = &plans.plan[i];
      check_note("actuator %d: %s", actuator, plan->text);
      assert_true(plan->n >= 2 && plan->t[0] == 0 && plan->duration > plan->t[plan->n - 1]);
      for (k = 1; k < plan->n; k++)
        assert_true(plan->t[k] > plan->t[k - 1] && fabs(plan->u[k]) <= 1);
    }
  }
}

/* A small trickle of command meets a leak that lets as much out: the slow strokes cannot be done. */
TEST(test_lab_test_plans_build__leak_as_large_as_a_slow_opening__leaves_slow_strokes_out)
{
  lab_rig rig = make_rig();
  rig.params = with(&rig, param_of("chamber_leak"), 0.15 * (double)rig.params.fill_area);
  build_plans(&rig);
  assert_int_equal(plans.n, 12);
  find_trial("three full strokes");
}

TEST(test_trial_choose__ties__go_to_the_shortest)
{
  const double duration[] = {40, 10, 20, 5, 1};
  const double value[] = {50, 47, 46, 44, (double)NAN};
  int i;
  plans.n = 5;
  for (i = 0; i < plans.n; i++)
    plans.plan[i].duration = duration[i];
  assert_int_equal(lab_trial_choose(&plans, value, 100), 1);
  assert_int_equal(lab_trial_choose(&plans, value, 48), 3);
  plans.n = 1;
  assert_int_equal(lab_trial_choose(&plans, value, 100), 0);
  assert_int_equal(lab_trial_choose(&plans, value + 4, 100), -1);
}

/* ---- Normal equations ---- */

enum { M = 40, K = 3 };

static double column[K + 1][M]; /* d last */
static lab_normal normal;       /* of the columns */

/* Smooth columns with nothing in common. */
static void make_columns(void)
{
  int i, j;
  for (j = 0; j <= K; j++)
    for (i = 0; i < M; i++)
      column[j][i] = pow(10, j) * (cos(0.1 * (j + 1) * i) + 0.01 * i * j);
}

static void make_normal(void)
{
  const double *pointer[K + 1];
  int j;
  for (j = 0; j <= K; j++)
    pointer[j] = column[j];
  lab_normal_clear(&normal, K);
  lab_normal_add_rows(&normal, pointer, M);
}

/* Gram-Schmidt, twice for good measure. */
static double rest_by_gram_schmidt(void)
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

TEST(test_lab_normal_rest__is_what_gram_schmidt_leaves)
{
  double rest;
  make_columns();
  make_normal();
  rest = lab_normal_rest(&normal);
  assert_true(rest < 0.9 * sqrt(normal.g[K][K]) && rest > 0);
  assert_close(rest, rest_by_gram_schmidt(), 0, 1e-8);
}

/* What tells the last column from the first is d itself: were that counted, nothing of d would be left. */
TEST(test_lab_normal_rest__column_nearly_twice__counts_once)
{
  const int two[] = {0, 1};
  lab_normal part;
  int i;
  make_columns();
  for (i = 0; i < M; i++)
    column[2][i] = column[0][i] + 1e-8 * column[K][i];
  make_normal();
  lab_normal_select(&normal, 2, two, &part);
  assert_close(lab_normal_rest(&normal), lab_normal_rest(&part), 0, 1e-9);
}

TEST(test_lab_normal_select__any_order__takes_the_same_rows)
{
  const double *const turned[] = {column[2], column[0], column[K]};
  const int keep[] = {2, 0};
  lab_normal part, again;
  int i, j;
  make_columns();
  make_normal();
  lab_normal_select(&normal, 2, keep, &part);
  lab_normal_clear(&again, 2);
  lab_normal_add_rows(&again, turned, M);
  assert_int_equal(part.k, 2);
  for (i = 0; i < 3; i++)
    for (j = i; j < 3; j++)
      assert_close(part.g[i][j], again.g[i][j], 0, 1e-12);
}

/* Squares of the rows, and of d once a combination of the columns is taken out, are those of the original ones. */
TEST(test_lab_normal_rows__any_combination__is_as_long_as_that_of_the_columns)
{
  static double row[LAB_NORMAL_MAX + 1][LAB_NORMAL_MAX + 1];
  const double change[K] = {2, -0.3, 0.05};
  double by_rows = 0, by_columns = 0;
  int i, j, twice;
  for (twice = 0; twice < 2; twice++) {
    make_columns();
    for (i = 0; twice && i < M; i++)
      column[2][i] = 3 * column[0][i] - column[1][i]; /* spanned by the others */
    make_normal();
    lab_normal_rows(&normal, row);
    for (by_rows = 0, i = 0; i <= K; i++) {
      double r = row[i][K];
      for (j = 0; j < K; j++)
        r -= row[i][j] * change[j];
      by_rows += r * r;
    }
    for (by_columns = 0, i = 0; i < M; i++) {
      double r = column[K][i];
      for (j = 0; j < K; j++)
        r -= column[j][i] * change[j];
      by_columns += r * r;
    }
    check_note("%s", twice ? "a column spanned by the others" : "columns of their own");
    assert_close(by_rows, by_columns, 0, 1e-10);
  }
}

/* J'J + 1/prior^2 = [[5, 2], [2, 2]], whose inverse is [[1/3, -1/3], [-1/3, 5/6]]. */
TEST(test_lab_normal_deviations__two_unknowns__are_those_of_the_inverse)
{
  const double prior[] = {1, 1};
  double deviation[2];
  lab_normal_clear(&normal, 2);
  normal.g[0][0] = 4;
  normal.g[0][1] = 2;
  normal.g[1][1] = 1;
  lab_normal_deviations(&normal, prior, deviation);
  assert_close(deviation[0], sqrt(1.0 / 3), 1e-12, 0);
  assert_close(deviation[1], sqrt(5.0 / 6), 1e-12, 0);
}

/* Responses to schedules: delays of command and of position, and the clock of what comes in cycles. */
#include "../../fixture.h"
#include "../../words.h"

#include "../../../apps/lab/run/response.h"

enum { SAMPLES = 301 };
static const double dt = 0.01, t_end = 3;

/* A schedule on the stroke of the R1-400, with a supply that changes on its own, and while the command does not. */
enum { ROWS = 6 };
static const double row_t[ROWS] = {0, 0.2, 0.7, 1.1, 1.13, 2.0};
static const double row_u[ROWS] = {0, 1, 1, -1, 0.5, 0};
static const double row_supply[ROWS] = {4e5, 4e5, 3.5e5, 3.5e5, 4.5e5, 4.5e5};

/* Inputs of n rows: command of row i, supply of row j. */
static pneu_input input_of(const pneu_model *m, int i, int j)
{
  pneu_input input = fixture_input(m, row_u[i]);
  input.supply_pressure = (pneu_real)row_supply[j];
  return input;
}

static lab_response run(const pneu_model *m, const lab_simulation *task)
{
  lab_response response;
  succeed(lab_response_run(m, task, &response, &error));
  return response;
}

static lab_response respond(const pneu_model *m, size_t n, const double *t_row, const pneu_input *input, double shift,
                            int integrator)
{
  const lab_schedule schedule = {n, t_row, input};
  double t[SAMPLES];
  const pneu_state start = fixture_rest(m, 0, 0, &input[0]);
  const lab_simulation task = {.start = &start,
                               .schedule = &schedule,
                               .t = t,
                               .n = SAMPLES,
                               .t_end = t_end,
                               .options = {.integrator = integrator, .tol = 1e-9}};
  int i;
  for (i = 0; i < SAMPLES; i++)
    t[i] = fmin(fmax(i * dt - shift, 0), t_end);
  return run(m, &task);
}

static lab_response respond_to_rows(const pneu_model *m, double shift, int integrator)
{
  pneu_input input[ROWS];
  int i;
  for (i = 0; i < ROWS; i++)
    input[i] = input_of(m, i, i);
  return respond(m, ROWS, row_t, input, shift, integrator);
}

static void assert_same(const double *a, const double *b, double tol, const char *what)
{
  int i;
  for (i = 0; i < SAMPLES; i++) {
    check_note("%s at %g s", what, i * dt);
    assert_close(a[i], b[i], tol, 0);
  }
}

/* Commands that overlap with changes of supply, and a delay longer than the shortest command: against the schedule
 * written out by hand. */
static void check_delay(double delay, size_t n, const double *t, const int (*row)[2])
{
  const pneu_model late = fixture_quick(PNEU_GAS_ISOTHERMAL, "dead_time", delay),
                   prompt = fixture_quick(PNEU_GAS_ISOTHERMAL, NULL, 0);
  pneu_input input[2 * ROWS];
  lab_response a, b;
  size_t i;
  for (i = 0; i < n; i++)
    input[i] = input_of(&prompt, row[i][0], row[i][1]);
  a = respond_to_rows(&late, 0, LAB_STEPPER);
  b = respond(&prompt, n, t, input, 0, LAB_STEPPER);
  assert_same(a.p, b.p, 1e-2, "p");
  assert_same(a.x, b.x, 1e-9, "x");
  for (i = 0; i < SAMPLES; i++) /* as given */
    assert_close(a.u[i], a.t[i] < 0.2 ? 0 : a.t[i] < 1.1 ? 1 : a.t[i] < 1.13 ? -1 : a.t[i] < 2 ? 0.5 : 0, 0, 0);
  lab_response_free(&a);
  lab_response_free(&b);
}

TEST(test_lab_response_run__dead_time__delays_the_command_and_nothing_else)
{
  static const double t[] = {0, 0.221, 0.7, 1.1, 1.121, 1.13, 1.151, 2.021};
  static const int row[][2] = {{0, 0}, {1, 0}, {1, 2}, {1, 3}, {3, 3}, {3, 4}, {4, 4}, {5, 5}};
  fixture_need("dead_time");
  check_delay(0.021, 8, t, row);
}

TEST(test_lab_response_run__dead_time_beyond_the_shortest_command__keeps_their_order)
{
  static const double t[] = {0, 0.7, 0.75, 1.13, 1.65, 1.68, 2.55};
  static const int row[][2] = {{0, 0}, {0, 2}, {1, 2}, {1, 4}, {3, 4}, {4, 4}, {5, 5}};
  fixture_need("dead_time");
  check_delay(0.55, 7, t, row);
}

/* 1.1 + 0.03 and 1.13 are apart by rounding. */
TEST(test_lab_response_run__dead_time_that_ends_with_another_change__makes_one_of_them)
{
  static const double t[] = {0, 0.23, 0.7, 1.13, 1.16, 2.03};
  static const int row[][2] = {{0, 0}, {1, 0}, {1, 2}, {3, 4}, {4, 4}, {5, 5}};
  fixture_need("dead_time");
  assert_true(1.1 + 0.03 != 1.13);
  check_delay(0.03, 6, t, row);
}

/* A command that runs: by both integrators, and as a staircase of steps too small to tell, which comes late with the
 * ramp. */
enum { STAIRS = 400 };
static const double ramp_from = 0.3, ramp_s = 1.6;

static size_t commanded(const pneu_model *m, int stairs, double t[STAIRS + 2], pneu_input *input)
{
  const double to = -0.8, by = (to - 1) / (stairs > 0 ? stairs : 1);
  int i;
  t[0] = 0;
  input[0] = fixture_input(m, 1);
  for (i = 0; i < stairs; i++) {
    t[i + 1] = ramp_from + ramp_s * (i + 0.5) / stairs;
    input[i + 1] = fixture_input(m, 1 + by * (i + 1));
  }
  if (stairs > 0)
    return (size_t)stairs + 1;
  t[1] = ramp_from;
  input[1] = fixture_input(m, 1);
  input[1].u_rate = (pneu_real)(by / ramp_s);
  t[2] = ramp_from + ramp_s;
  input[2] = fixture_input(m, to);
  return 3;
}

static lab_response run_ramp(const pneu_model *m, int stairs, int integrator)
{
  double t[STAIRS + 2];
  pneu_input input[STAIRS + 2];
  const size_t n = commanded(m, stairs, t, input);
  return respond(m, n, t, input, 0, integrator);
}

static void check_ramp(const pneu_model *m)
{
  lab_response a = run_ramp(m, 0, LAB_STEPPER), b = run_ramp(m, 0, LAB_CVODE), c = run_ramp(m, STAIRS, LAB_STEPPER);
  int i;
  assert_same(a.p, b.p, 2, "p by CVODE");
  assert_same(a.x, b.x, 2e-7, "x by CVODE");
  assert_same(a.p, c.p, 30, "p by stairs");
  assert_same(a.x, c.x, 2e-6, "x by stairs");
  for (i = 0; i < SAMPLES; i++) /* as given */
    assert_close(a.u[i], 1 - 1.8 * fmin(fmax(a.t[i] - ramp_from, 0), ramp_s) / ramp_s, 1e-12, 0);
  lab_response_free(&a);
  lab_response_free(&b);
  lab_response_free(&c);
}

TEST(test_lab_response_run__ramp__is_a_staircase_of_small_steps)
{
  const pneu_model m = fixture_quick(PNEU_GAS_ISOTHERMAL, NULL, 0);
  check_ramp(&m);
}

TEST(test_lab_response_run__ramp_that_comes_late__the_same)
{
  const pneu_model m = fixture_quick(PNEU_GAS_ISOTHERMAL, "dead_time", 0.37);
  fixture_need("dead_time");
  check_ramp(&m);
}

/* A valve signature: an actuator of 677 cm2 follows a set position that rises in 100 s, in and out of the dead band of
 * its positioner some ninety times a second. A fit lets a model take 20000 steps in ten seconds. */
TEST(test_lab_response_run__slow_ramp_behind_a_dead_band__is_followed)
{
  static const double row[] = {0, 100}, at[] = {0, 20, 40, 60, 80, 100};
  pneu_params p = fixture_params(FIXTURE_R1_400);
  pneu_model m;
  pneu_input input[2];
  pneu_state start;
  pneu_stats stats = {0};
  const lab_schedule schedule = {2, row, input};
  const lab_simulation task = {.start = &start,
                               .schedule = &schedule,
                               .t = at,
                               .n = 6,
                               .t_end = 100,
                               .stats = &stats,
                               .options = {.max_steps = 20000}};
  lab_response r;
  int i;
  fixture_need("positioner");
  p.area = (pneu_real)677e-4;
  p.dead_volume = (pneu_real)1.2e-3;
  p.stroke = (pneu_real)38e-3;
  p.spring_rate = (pneu_real)145e3;
  p.spring_preload = (pneu_real)10.5e-3;
  p.moving_mass = 8;
  p.dry_friction = 350;
  p.damping = 2500;
  p.supply_pressure = (pneu_real)2e5;
  p.fill_area = p.vent_area = (pneu_real)4.5e-6;
  fixture_set(&p, "gain", 20);
  fixture_set(&p, "dead_band", 0.003);
  m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
  for (i = 0; i < 2; i++) {
    input[i] = fixture_input(&m, i);
    input[i].set_position = 1;
    input[i].u_rate = (pneu_real)(i ? 0 : 0.01);
  }
  start = fixture_rest(&m, 0, 0, &input[0]);
  r = run(&m, &task);
  check_note("%ld steps", stats.steps);
  assert_true(stats.steps > 20000);
  for (i = 1; i < 5; i++)
    assert_close(r.x[i], 0.01 * at[i] * 38e-3, 0.006 * 38e-3, 0);
  lab_response_free(&r);
}

/* Position as it was `skew` ago; before the start, as at the start; a younger one from beyond the end of the log. */
static void check_skew(double skew, int integrator)
{
  const pneu_model skewed = fixture_quick(PNEU_GAS_ISOTHERMAL, "channel_skew", skew),
                   plain = fixture_quick(PNEU_GAS_ISOTHERMAL, NULL, 0);
  lab_response a = respond_to_rows(&skewed, 0, integrator), now = respond_to_rows(&plain, 0, integrator);
  lab_response b = respond_to_rows(&plain, skew, integrator);
  int i;
  assert_same(a.p, now.p, 1e-2, "p");
  for (i = 0; i < SAMPLES && i * dt - skew <= t_end; i++) {
    check_note("skew %g s, x at %g s", skew, i * dt);
    assert_close(a.x[i], b.x[i], 1e-8, 0);
  }
  lab_response_free(&a);
  lab_response_free(&b);
  lab_response_free(&now);
}

TEST(test_lab_response_run__channel_skew__shifts_position_alone)
{
  static const double skew[] = {0.037, -0.016, 0.6, 50};
  int i;
  fixture_need("channel_skew");
  for (i = 0; i < COUNT(skew); i++)
    check_skew(skew[i], LAB_STEPPER);
  check_skew(0.037, LAB_CVODE);
}

/* A younger position: the stem goes on beyond the last sample under the last command. */
TEST(test_lab_response_run__negative_skew__looks_beyond_the_end)
{
  const double ahead = 0.05;
  pneu_model skewed, plain;
  const double t0 = 0;
  pneu_input input;
  lab_response a, b;
  fixture_need("channel_skew");
  skewed = fixture_quick(PNEU_GAS_ISOTHERMAL, "channel_skew", -ahead);
  plain = fixture_quick(PNEU_GAS_ISOTHERMAL, NULL, 0);
  skewed.p.fill_area = plain.p.fill_area = (pneu_real)4e-7; /* still rising at the end */
  input = fixture_input(&plain, 1);
  a = respond(&skewed, 1, &t0, &input, 0, LAB_STEPPER);
  b = respond(&plain, 1, &t0, &input, 0, LAB_STEPPER);
  assert_close(a.x[SAMPLES - 6], b.x[SAMPLES - 1], 1e-9, 0);
  assert_true(a.x[SAMPLES - 1] > b.x[SAMPLES - 1] + 1e-6);
  lab_response_free(&a);
  lab_response_free(&b);
}

TEST(test_lab_response_run__statistics_only__needs_no_trace)
{
  pneu_model m;
  pneu_input input[2];
  const double t[] = {0, 0.2};
  const lab_schedule schedule = {2, t, input};
  pneu_state start;
  pneu_stats stats;
  const lab_simulation task = {
      .start = &start, .schedule = &schedule, .t_end = t_end, .options = {.tol = 1e-6}, .stats = &stats};
  fixture_need("dead_time");
  fixture_need("channel_skew");
  m = fixture_quick(PNEU_GAS_ISOTHERMAL, "dead_time", 0.1);
  m.position_skew = (pneu_real)0.1;
  input[0] = fixture_input(&m, 0);
  input[1] = fixture_input(&m, 1);
  start = fixture_rest(&m, 0, 0, &input[0]);
  succeed(lab_response_run(&m, &task, NULL, &error));
  assert_true(stats.steps > 10);
}

/* ---- Cycles ---- */

static pneu_term cycle(int equation, double period, double size)
{
  return fixture_cycle(equation, period, 0.3 * size, size);
}

static double cycle_at(const pneu_term *term, double t)
{
  const double angle = 6.283185307179586 * t / (double)term->to;
  return (double)term->value[0] * cos(angle) + (double)term->value[1] * sin(angle);
}

/* The strokes of the rows under what comes in cycles: both integrators carry the clock. */
TEST(test_lab_response_run__cycles__are_the_same_by_stepper_and_cvode)
{
  const pneu_term term[] = {cycle(PNEU_TERM_FORCE, 0.31, 700), cycle(PNEU_TERM_SUPPLY, 0.9, 4e4),
                            cycle(PNEU_TERM_FLOW, 0.2, 5e-4), cycle(PNEU_TERM_FRICTION, 1.3, 200)};
  const pneu_model plain = fixture_quick(PNEU_GAS_ISOTHERMAL, NULL, 0);
  lab_response without = respond_to_rows(&plain, 0, LAB_STEPPER);
  int k, i;
  for (k = 0; k < COUNT(term); k++) {
    pneu_model m = plain;
    lab_response a, b;
    double apart = 0;
    assert_int_equal(pneu_model_terms(&m, &term[k], 1), PNEU_OK);
    a = respond_to_rows(&m, 0, LAB_STEPPER);
    b = respond_to_rows(&m, 0, LAB_CVODE);
    assert_same(a.p, b.p, 2, "p");
    assert_same(a.x, b.x, 2e-7, "x");
    for (i = 0; i < SAMPLES; i++)
      apart = fmax(apart, fabs(a.x[i] - without.x[i]));
    assert_true(apart > 1e-4);
    lab_response_free(&a);
    lab_response_free(&b);
  }
  lab_response_free(&without);
}

/* A schedule that begins late, and whose changes do not matter: cycles go by its own time. Position is shown as it was
 * a skew ago, and so is what its sensor adds. */
static void check_own_time(double skew, int integrator)
{
  static const double t_row[] = {5.3, 6.1, 7.4};
  const pneu_term term[] = {cycle(PNEU_TERM_SHOWN_PRESSURE, 0.77, 1e3), cycle(PNEU_TERM_SHOWN_POSITION, 0.9, 1e-3)};
  pneu_model m = fixture_quick(PNEU_GAS_ISOTHERMAL, NULL, 0);
  double t[28];
  pneu_input input[3];
  lab_schedule schedule = {3, t_row, input};
  pneu_state start;
  const lab_simulation task = {.start = &start,
                               .schedule = &schedule,
                               .t = t,
                               .n = COUNT(t),
                               .t_end = 8,
                               .options = {.integrator = integrator, .tol = 1e-9}};
  lab_response response;
  int i;
  for (i = 0; i < 3; i++) {
    input[i] = fixture_input(&m, 0);
    input[i].force = (pneu_real)i;
  }
  for (i = 0; i < COUNT(t); i++)
    t[i] = 5.3 + 0.1 * i;
  assert_int_equal(pneu_model_terms(&m, term, 2), PNEU_OK);
  m.position_skew = (pneu_real)skew;
  start = fixture_rest(&m, 2e5, 0.01, &input[0]);
  response = run(&m, &task);
  for (i = 0; i < COUNT(t); i++) {
    check_note("integrator %d, skew %g s, t = %g s", integrator, skew, t[i]);
    assert_close(response.p[i] - 2e5, cycle_at(&term[0], t[i]), 1e-5, 0);
    assert_close(response.x[i] - 0.01, cycle_at(&term[1], fmax(t[i] - skew, 5.3)), 1e-11, 0);
  }
  lab_response_free(&response);
}

TEST(test_lab_response_run__cycles__go_by_the_time_of_the_schedule)
{
  check_own_time(0, LAB_STEPPER);
  check_own_time(0, LAB_CVODE);
  check_own_time(0.25, LAB_STEPPER);
}

/* The stem has sunk into a stop that yields; from the second row on the stop is rigid. */
TEST(test_lab_response_run__stop_that_no_longer_yields__holds_the_stem_at_the_stroke)
{
  const pneu_model yields = fixture_quick(PNEU_GAS_ISOTHERMAL, "stop_compliance.stop_compliance", 1e-8),
                   rigid = fixture_quick(PNEU_GAS_ISOTHERMAL, NULL, 0);
  const pneu_model *const rows[2] = {&yields, &rigid};
  const double t_row[2] = {0, 2}, t[2] = {1.99, 3};
  const pneu_input input[2] = {input_of(&yields, 1, 0), input_of(&yields, 1, 0)};
  const lab_schedule schedule = {2, t_row, input};
  const pneu_state start = fixture_rest(&yields, 0, 0, &input[0]);
  const lab_simulation task = {.start = &start, .schedule = &schedule, .rows = rows, .t = t, .n = 2};
  lab_response response;
  fixture_need("stop_compliance");
  response = run(&yields, &task);
  assert_true(response.x[0] > (double)rigid.p.stroke);
  assert_close(response.x[1], (double)rigid.p.stroke, 1e-9, 0);
  lab_response_free(&response);
}

/* Shut air that keeps its heat and began too warm: another model goes on from what it is, and adds no excess again. */
TEST(test_lab_response_run__air_that_began_warm__goes_on_as_it_is)
{
  const double t_row[2] = {0, 2}, t[2] = {1.99, 3}, warm = 298.15 + 30;
  pneu_params p = fixture_vessel(1e-3);
  pneu_model before, after;
  const pneu_model *const rows[2] = {&before, &after};
  pneu_input input[2];
  const lab_schedule schedule = {2, t_row, input};
  pneu_state start;
  const lab_simulation task = {.start = &start, .schedule = &schedule, .rows = rows, .t = t, .n = 2};
  lab_response response;
  fixture_need("start_temperature");
  fixture_set(&p, "start_excess", 30);
  before = fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED);
  p.fill_area *= 2;
  after = fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED);
  input[0] = input[1] = fixture_input(&before, 0);
  start = fixture_rest(&before, 2e5, 0, &input[0]);
  response = run(&before, &task);
  assert_close(response.T[0], warm, 1e-6, 0);
  assert_close(response.T[1], warm, 1e-6, 0);
  lab_response_free(&response);
}

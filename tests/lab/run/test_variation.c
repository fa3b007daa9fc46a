/* What nearby runs differ by, beside differences of exact runs. */
#include "../../fixture.h"
#include "../../words.h"

#include "../../../apps/lab/run/response.h"

enum { SAMPLES = 601, ROWS = 3 };
static const double dt = 0.01, t_end = 6;
static const double row_t[ROWS] = {0, 0.2, 3}, row_u[ROWS] = {0, 1, -1};

/* A run: its model, and by how much its rows, its start and its last command differ from the usual. */
typedef struct drive {
  pneu_model model;
  double later;   /* [s] the second row */
  double warmer;  /* [K] the start */
  double command; /* [1] */
  size_t rows;    /* fewer than usual; 0: all */
  int positioned; /* its commands are set positions */
} drive;

/* One of them, and its memory. */
typedef struct cast {
  pneu_input input[ROWS];
  double t[ROWS];
  lab_schedule schedule;
  const pneu_model *rows[ROWS];
  pneu_state start;
  lab_simulation task;
} cast;

static double sample_t[SAMPLES];

static void prepare(const drive *d, double tol, cast *c)
{
  size_t i;
  for (i = 0; i < SAMPLES; i++)
    sample_t[i] = fmin(((double)i + 0.5) * dt, t_end); /* none as a command changes */
  for (i = 0; i < ROWS; i++) {
    c->t[i] = row_t[i] + (i == 1 ? d->later : 0);
    c->input[i] = fixture_input(&d->model, row_u[i] - (i == 2 ? d->command : 0));
    c->input[i].set_position = d->positioned;
    c->rows[i] = &d->model;
  }
  c->schedule = (lab_schedule){d->rows ? d->rows : ROWS, c->t, c->input};
  c->start = fixture_rest(&d->model, 0, 0, &c->input[0]);
  c->start.T += (pneu_real)d->warmer;
  c->task = (lab_simulation){.start = &c->start,
                             .schedule = &c->schedule,
                             .rows = c->rows,
                             .t = sample_t,
                             .n = SAMPLES,
                             .t_end = t_end,
                             .options = {.tol = tol, .shown_only = 1}};
}

/* Response of one, exactly. */
static void respond(const drive *d, lab_response *response)
{
  cast c;
  prepare(d, 1e-10, &c);
  succeed(lab_response_run(&d->model, &c.task, response, &error));
}

/* What `there` has beyond `here`, from one run. */
static void vary(const drive *here, const drive *there, lab_response *change)
{
  lab_response response;
  cast base, nearby;
  prepare(here, 1e-6, &base);
  prepare(there, 1e-6, &nearby);
  base.task.nearby = &nearby.task;
  base.task.n_nearby = 1;
  base.task.change = change;
  succeed(lab_response_run(&here->model, &base.task, &response, &error));
  lab_response_free(&response);
}

/* Largest error of a change over the largest change, or the errors that exact runs have. */
static double worst_of(const double *change, const double *above, const double *below, double scale)
{
  double worst = 0, largest = 1e-8 * scale;
  int i;
  for (i = 0; i < SAMPLES; i++) {
    const double exact = (above[i] - below[i]) / 2;
    largest = fmax(largest, fabs(exact));
    worst = fmax(worst, fabs(change[i] - exact));
  }
  return worst / largest;
}

/* The change from `here` to `up`, by exact runs of `up` and of `down`, as far on the other side, and by one run. */
static void check_change(const char *what, const drive *here, const drive *up, const drive *down, double most)
{
  lab_response above, below, change;
  double x, p;
  respond(up, &above);
  respond(down, &below);
  vary(here, up, &change);
  if (!change.x)
    fail_msg("%s is not followed", what);
  x = worst_of(change.x, above.x, below.x, 0.02);
  p = worst_of(change.p, above.p, below.p, 4e5);
  check_note("%s: position %g, pressure %g", what, x, p);
  assert_between(x, 0, most);
  assert_between(p, 0, most);
  lab_response_free(&above);
  lab_response_free(&below);
  lab_response_free(&change);
}

/* A parameter, its value, and a step that is small beside it. */
typedef struct param_step {
  const char *name;
  double value, step;
} param_step;

/* The same of a step of a parameter, in drives that `make` makes. */
static void check_step(drive (*make)(int gas, const char *name, double value), int gas, const param_step *of,
                       double most)
{
  const drive here = make(gas, of->name, of->value), up = make(gas, of->name, of->value + of->step),
              down = make(gas, of->name, of->value - of->step);
  check_change(of->name, &here, &up, &down, most);
}

static drive with(int gas, const char *name, double value)
{
  return (drive){.model = fixture_quick(gas, name, value)};
}

/* Across the stops, from which the stem breaks away and on which it lands, in every law of the gas. */
TEST(test_lab_variations__parameters__are_those_of_exact_runs)
{
  static const param_step of[] = {{"spring_rate", 1e5, 1}, {"dry_friction", 480, 1e-2}, {"area", 0.04, 4e-7},
                                  {"stroke", 0.02, 2e-7},  {"damping", 1000, 1e-1},     {"supply_pressure", 4e5, 1}};
  int gas, i;
  for (gas = 0; gas < PNEU_GAS_COUNT; gas++)
    for (i = 0; i < COUNT(of); i++)
      check_step(with, gas, &of[i], 0.01);
}

/* A command that comes later, a start that is warmer, another command. */
TEST(test_lab_variations__commands_and_start__are_those_of_exact_runs)
{
  const double step = 1e-6;
  const drive here = with(PNEU_GAS_ENERGY, NULL, 0);
  drive up = here, down = here;
  up.later = step;
  down.later = -step;
  check_change("a later command", &here, &up, &down, 0.01);
  up.later = down.later = 0;
  up.warmer = 100 * step;
  down.warmer = -100 * step;
  check_change("a warmer start", &here, &up, &down, 0.01);
  up.warmer = down.warmer = 0;
  up.command = step;
  down.command = -step;
  check_change("another command", &here, &up, &down, 0.01);
}

/* A vessel at rest, its run one long step: what differs goes its own way. */
TEST(test_lab_variations__run_at_rest__follows_what_differs)
{
  pneu_params p = fixture_vessel(1e-3);
  drive here = {.rows = 1}, up, down;
  fixture_set(&p, "film_conductance", 2);
  fixture_set(&p, "pressure_time", 0.1);
  here.model = fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED);
  up = down = here;
  up.warmer = 1e-3;
  down.warmer = -1e-3;
  check_change("a warmer start at rest", &here, &up, &down, 0.02);
}

/* A stem that its positioner brings to 0.6 of the stroke and stops as its error enters the dead band. */
static drive positioned(int gas, const char *name, double value)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  fixture_set(&p, "dead_volume", 4e-5);
  fixture_set(&p, "positioner.gain", 20);
  fixture_set(&p, "positioner.dead_band", 5e-3);
  fixture_set(&p, name, value);
  return (drive){.model = fixture_model(&p, gas, PNEU_FLOW_CHOKED), .positioned = 1, .command = -1.6};
}

/* Across the edge of the dead band, where the opening jumps. */
TEST(test_lab_variations__edge_of_a_dead_band__is_that_of_exact_runs)
{
  static const param_step of[] = {
      {"spring_rate", 4e5, 1}, {"positioner.dead_band", 5e-3, 1e-8}, {"fill_area", 0.893e-6, 1e-12}};
  int i;
  for (i = 0; i < COUNT(of); i++)
    check_step(positioned, PNEU_GAS_ISOTHERMAL, &of[i], 0.02);
}

/* What has states of its own, and what sensors show. */
TEST(test_lab_variations__effects__are_those_of_exact_runs)
{
  static const param_step of[] = {{"transducer_time", 0.05, 1e-6},
                                  {"pressure_gain", 0.01, 1e-5},
                                  {"position_time", 0.05, 1e-6},
                                  {"leak_area", 1e-7, 1e-12},
                                  {"film_conductance", 1, 1e-5}};
  int i;
  for (i = 0; i < COUNT(of); i++)
    check_step(with, PNEU_GAS_ENERGY, &of[i], 0.01);
}

static void check_not_followed(const drive *here, const drive *there)
{
  lab_response change;
  vary(here, there, &change);
  assert_true(!change.p && !change.x && !change.T && !change.force);
}

/* What has other states, other rows, or shows the position at another time: who asks has to take a difference. */
TEST(test_lab_variations__another_kind_of_run__is_not_followed)
{
  const drive here = with(PNEU_GAS_ENERGY, NULL, 0), lagging = with(PNEU_GAS_ENERGY, "transducer_time", 0.05),
              yields = with(PNEU_GAS_ENERGY, "stop_compliance", 1e-11),
              skewed = with(PNEU_GAS_ENERGY, "channel_skew", 0.05);
  drive shorter = here;
  shorter.rows = ROWS - 1;
  check_not_followed(&here, &lagging);
  check_not_followed(&here, &skewed);
  check_not_followed(&here, &yields);
  check_not_followed(&yields, &here);
  check_not_followed(&here, &shorter);
}

/* A stem that sticks and slips more than ten times under one command has no slopes that mean anything. */
TEST(test_lab_variations__stick_slip__is_not_followed)
{
  drive here = with(PNEU_GAS_ISOTHERMAL, NULL, 0), there;
  pneu_params p = here.model.p;
  fixture_set(&p, "stribeck_friction.stribeck_excess", 1);
  fixture_set(&p, "fill_area", 2e-8);
  here.model = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
  fixture_set(&p, "spring_rate", 1.001 * (double)p.spring_rate);
  there = here;
  there.model = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
  check_not_followed(&here, &there);
}

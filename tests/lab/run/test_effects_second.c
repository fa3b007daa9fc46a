/* Every effect, and free terms that sample what has no effect here, against the independent implementation of
 * tests/second: the same parameters, the same random commands, the same measured channels. */
#include "../../fixture.h"
#include "../../words.h"

#include "../../../apps/lab/base/text.h"
#include "../../../apps/lab/run/response.h"
#include "../../second/rig.h"

enum { SAMPLES = 401, CHANGES = 16 };
static const double dt = 0.01, t_end = 4;

/* Largest differences of p, x and T over supply, stroke and ambient temperature. */
typedef struct apart {
  double p, x, T;
} apart;

/* Take up the differences of one instant: pressure, position, temperature. */
static void widen(apart *d, double p, double x, double T)
{
  d->p = fmax(d->p, fabs(p) / 4e5);
  d->x = fmax(d->x, fabs(x) / 0.02);
  d->T = fmax(d->T, fabs(T) / 298.15);
}

/* ---- the effects, as both sides call them; `size` scales what is declared here ---- */

#define BOTH(name, field, value)                                                                                       \
  do {                                                                                                                 \
    g->field = (value)*size;                                                                                           \
    fixture_set(p, name, g->field);                                                                                    \
  } while (0)

static void set_chamber_exponent(pneu_params *p, second_rig *g, double size)
{
  g->gas = SECOND_ENERGY; /* without heat, by another exponent */
  g->exponent = 1 + 0.2 * size;
  fixture_set(p, "exponent_rise", 0.2 * size);
}

static void set_rate_exponent(pneu_params *p, second_rig *g, double size)
{
  g->rate_exponent = 1 + 0.3 * size;
  fixture_set(p, "rate_exponent_rise", 0.3 * size);
}

static void set_channel_skew(pneu_params *p, second_rig *g, double size)
{
  BOTH("channel_skew", position_skew, size < 1 ? -0.013 : 0.037);
}

static void set_choked_flow(pneu_params *p, second_rig *g, double size)
{
  (void)size;
  g->flow = SECOND_CHOKED;
  fixture_set(p, "choked_share", 1);
}

static void set_presliding(pneu_params *p, second_rig *g, double size)
{
  const double length = 3e-5 * size;
  g->bristle_rate = g->dry_friction / length;
  g->bristle_damping = 1e3;
  fixture_set(p, "presliding_length", length);
  fixture_set(p, "bristle_damping", g->bristle_damping);
}

static void set_start_temperature(pneu_params *p, second_rig *g, double size)
{
  g->start_temperature = g->ambient_temperature + 25 * size;
  fixture_set(p, "start_excess", 25 * size);
}

static void set_stop_compliance(pneu_params *p, second_rig *g, double size)
{
  const double compliance = 2e-8 * size;
  g->lower_rate = g->upper_rate = 1 / compliance;
  fixture_set(p, "stop_compliance", compliance);
  BOTH("stop_damping", stop_damping, 5e3);
}

static void set_stribeck_friction(pneu_params *p, second_rig *g, double size)
{
  g->step = 10e-6; /* stick-slip: an error in one slip shifts the next */
  BOTH("stribeck_excess", stribeck, 0.4);
  BOTH("stribeck_velocity", stribeck_velocity, 2e-3);
}

static void set_travel_limit(pneu_params *p, second_rig *g, double size)
{
  const double loss = 2e-3 * size;
  g->travel_limit = g->stroke - loss;
  fixture_set(p, "travel_loss", loss);
}

static void set_vent_restriction(pneu_params *p, second_rig *g, double size)
{
  const double share = 0.3 * size;
  g->vent_area *= 1 - share;
  fixture_set(p, "vent_restriction", share);
}

static void set_wall_temperature(pneu_params *p, second_rig *g, double size)
{
  const double capacity = 20 / size;
  BOTH("film_conductance", heat, 3);
  g->wall_capacity = capacity;
  fixture_set(p, "wall_compliance", 1 / capacity);
  BOTH("wall_loss", wall_loss, 0.5);
}

/* What an effect may differ by is three times what it was measured to (PNEU_SHOW=1 prints it), the larger of both laws
 * and rounded up to one digit. What is left is the steps of either side, most of it in pressure; a leak that is larger
 * by 0.003 % on one side alone is seen. The place in the table gives an effect its commands: what is new comes last. */
typedef struct effect_case {
  const char *name;
  apart most;
  void (*set)(pneu_params *p, second_rig *g, double size); /* NULL: only what is the same number on both sides, */
  struct {
    const char *param;
    size_t field;
    double value;
    int is_form; /* whatever the size */
  } same[2];     /* which are these, at size 1 */
} effect_case;

static void set_case(const effect_case *c, pneu_params *p, second_rig *g, double size)
{
  int i;
  if (c->set)
    c->set(p, g, size);
  for (i = 0; i < COUNT(c->same) && c->same[i].param; i++) {
    const double value = c->same[i].value * (c->same[i].is_form ? 1 : size);
    *(double *)((char *)g + c->same[i].field) = value;
    fixture_set(p, c->same[i].param, value);
  }
}

/* clang-format off */
#define CASE(name, p, x, T) {#name, {p, x, T}, set_##name, {{NULL, 0, 0, 0}}}
#define SAME(param, field, value) {#param, offsetof(second_rig, field), value, 0}
#define FORM(param, field, value) {#param, offsetof(second_rig, field), value, 1}
static const effect_case cases[] = {
    {"area_variation",         {3e-6, 2e-7, 2e-6}, NULL, {SAME(area_loss, area_slope, 0.08)}},
    {"chamber_leak",           {2e-6, 5e-8, 8e-7}, NULL, {SAME(leak_area, leak_area, 3e-8)}},
    CASE(channel_skew,          3e-6, 5e-8, 2e-6),
    CASE(choked_flow,           2e-6, 7e-8, 2e-6),
    {"connecting_tube",        {6e-7, 3e-8, 1e-6}, NULL, {SAME(tube_resistance, tube_resistance, 2e7),
                                                          SAME(tube_volume, tube_volume, 4e-5)}},
    {"dead_time",              {7e-6, 3e-7, 4e-6}, NULL, {SAME(dead_time, dead_time, 0.033)}},
    {"exhaust_back_pressure",  {4e-6, 2e-7, 3e-6}, NULL, {SAME(exhaust_resistance, back_pressure, 5e7)}},
    {"friction_position",      {3e-6, 2e-7, 2e-6}, NULL, {SAME(friction_slope, friction_position, 0.7)}},
    {"friction_pressure",      {4e-6, 2e-7, 3e-6}, NULL, {SAME(friction_per_pressure, friction_pressure, 1e-3)}},
    {"heat_transfer",          {3e-6, 2e-7, 2e-6}, NULL, {SAME(film_conductance, heat, 3)}},
    {"laminar_leak",           {2e-6, 7e-8, 2e-6}, NULL, {SAME(laminar_leak, laminar_leak, 2e-16)}},
    {"porous_leak",            {3e-6, 1e-7, 2e-6}, NULL, {SAME(porous_leak, porous_leak, 3e-16),
                                                          FORM(crossover_pressure, crossover, 3e5)}},
    {"position_bias",          {3e-6, 2e-7, 2e-6}, NULL, {SAME(position_bias, position_bias, -4e-4)}},
    {"position_gain",          {5e-6, 2e-7, 3e-6}, NULL, {SAME(position_gain, position_gain, 0.05)}},
    {"position_lag",           {3e-6, 2e-9, 2e-6}, NULL, {SAME(position_time, position_lag, 0.05)}},
    CASE(presliding,            1e-6, 3e-7, 5e-7),
    {"pressure_bias",          {9e-7, 7e-8, 4e-7}, NULL, {SAME(pressure_bias, pressure_bias, 6e3)}},
    {"pressure_gain",          {3e-6, 2e-7, 2e-6}, NULL, {SAME(pressure_gain, pressure_gain, -0.04)}},
    {"pressure_lag",           {4e-8, 2e-7, 2e-6}, NULL, {SAME(pressure_time, pressure_lag, 0.04)}},
    {"spring_hardening",       {3e-6, 2e-7, 2e-6}, NULL, {SAME(spring_cubic, spring_cubic, 8e7)}},
    {"spring_hysteresis",      {9e-7, 5e-8, 4e-7}, NULL, {SAME(hysteresis_force, hysteresis, 250),
                                                          SAME(hysteresis_length, hysteresis_length, 2e-3)}},
    CASE(stop_compliance,       9e-6, 7e-6, 3e-6),
    CASE(stribeck_friction,     9e-6, 7e-6, 3e-6),
    {"supply_droop",           {4e-6, 2e-7, 3e-6}, NULL, {SAME(supply_resistance, supply_droop, 5e7)}},
    {"temperature_lag",        {3e-6, 2e-7, 2e-9}, NULL, {SAME(temperature_time, temperature_lag, 0.3)}},
    {"transducer_lag",         {6e-7, 3e-8, 4e-7}, NULL, {SAME(transducer_time, transducer_lag, 0.05)}},
    CASE(travel_limit,          4e-6, 2e-7, 2e-6),
    CASE(vent_restriction,      3e-6, 2e-7, 2e-6),
    CASE(wall_temperature,      2e-6, 8e-8, 2e-6),
    {"chamber_creep",          {3e-6, 2e-7, 2e-6}, NULL, {SAME(volume_compliance, growth, 2e-6),
                                                          FORM(volume_time, growth_time, 0.3)}},
    {"spring_creep",           {2e-6, 7e-8, 3e-7}, NULL, {SAME(creep_stiffness, creep, 8e4),
                                                          FORM(creep_time, creep_time, 0.4)}},
};
/* clang-format on */

/* In place of a chamber law. */
static const effect_case exponent = CASE(chamber_exponent, 6e-7, 4e-8, 2e-7);
static const effect_case rate_exponent = {"chamber_exponent", {6e-7, 4e-8, 2e-7}, set_rate_exponent, {{NULL, 0, 0, 0}}};

/* Before anything happens. */
static const effect_case begins = CASE(start_temperature, 3e-6, 2e-7, 2e-6);

/* A vessel 0.8 m long and 36 mm wide. */
static void set_long_chamber(pneu_params *p, second_rig *g, double size)
{
  p->stroke = (pneu_real)(g->stroke = 0);
  p->area = (pneu_real)(g->area = 1e-3);
  p->dead_volume = (pneu_real)(g->dead_volume = 8e-4);
  BOTH("line_length", line_length, 1);
  g->line_friction = 2;
  g->step = 20e-6;
  fixture_set(p, "line_friction", g->line_friction);
}
static const effect_case along = CASE(long_chamber, 6e-7, 1e-9, 2e-6);

/* Lines before and behind the transducer that are in part orifices, and that store air: no size scales their shares.
 * With steps of an eighth on the other side, most agree to 1e-8; what stays is how either blends its flow laws, where a
 * tube's flow turns round or the chamber is empty. */
typedef struct line_case {
  const char *name;
  apart most;
  double tube, tube_turbulence, supply, supply_turbulence, supply_volume; /* [Pa s/kg], [1], [Pa s/kg], [1], [m3] */
} line_case;

/* clang-format off */
static const line_case lines[] = {
    {"tube, mixed",          {3e-6, 8e-8, 2e-6}, 2e7, 0.7, 0, 0, 0},
    {"tube, turbulent",      {3e-6, 1e-6, 1e-6}, 2e7, 1, 0, 0, 0},
    {"supply, mixed",        {5e-6, 2e-7, 3e-6}, 0, 0, 5e7, 0.7, 0},
    {"supply, turbulent",    {3e-6, 9e-8, 2e-6}, 0, 0, 5e7, 1, 0},
    {"supply, volume",       {1e-5, 1e-7, 2e-6}, 0, 0, 5e7, 0, 5e-5},
    {"supply, both",         {3e-6, 2e-7, 2e-6}, 0, 0, 5e7, 0.7, 5e-5},
    {"tube, supply",         {3e-7, 7e-9, 2e-7}, 2e7, 0.4, 5e7, 0.6, 0},
    {"tube, supply, volume", {2e-5, 8e-7, 8e-6}, 1e7, 1, 5e7, 1, 2e-4},
};
/* clang-format on */

static void set_line(const line_case *c, pneu_params *p, second_rig *g)
{
  p->supply_temperature = (pneu_real)(g->supply_temperature = 315);
  p->subsonic_index = (pneu_real)(g->iso_m = 0.45); /* no root of the difference */
  fixture_set(p, "tube_resistance", g->tube_resistance = c->tube);
  fixture_set(p, "tube_turbulence", g->tube_turbulence = c->tube_turbulence);
  g->tube_volume = c->tube > 0 ? 4e-5 : 0;
  fixture_set(p, "tube_volume", 4e-5);
  fixture_set(p, "supply_resistance", g->supply_droop = c->supply);
  fixture_set(p, "supply_turbulence", g->supply_turbulence = c->supply_turbulence);
  fixture_set(p, "supply_volume", g->supply_volume = c->supply_volume);
}

static second_positioner other;

#define LAW(name, value)                                                                                               \
  do {                                                                                                                 \
    other.name = (value)*size;                                                                                         \
    fixture_set(p, #name, other.name);                                                                                 \
  } while (0)

/* A positioner, and what is wrong with one. */
static void set_positioner(pneu_params *p, second_rig *g, double size)
{
  (void)g;
  LAW(gain, 15);
  LAW(dead_band, 0.004);
  LAW(cutoff_low, 0.15);
  LAW(cutoff_high, 0.8);
}

static void set_positioner_integral(pneu_params *p, second_rig *g, double size)
{
  (void)g;
  LAW(gain, 5);
  LAW(integral_time, 1);
  LAW(derivative_time, 0.02);
}

/* It does not scale: in whole, it opens the transducer fully. */
static void set_positioner_start(pneu_params *p, second_rig *g, double size)
{
  set_positioner_integral(p, g, size);
  other.integral_start = size < 1 ? -0.05 : 0.1;
  fixture_set(p, "integral_start", other.integral_start);
}

static void set_positioner_dead_band(pneu_params *p, second_rig *g, double size)
{
  set_positioner(p, g, size);
  other.dead_band += 0.01 * size;
  fixture_set(p, "dead_band_excess", 0.01 * size);
}

/* A leak that the positioner makes up for, at the edge of its dead band, and a spool that is late. */
static void set_positioner_beside_others(pneu_params *p, second_rig *g, double size)
{
  set_positioner_integral(p, g, size);
  set_positioner(p, g, size);
  BOTH("zero_shift", zero, 5e-4);
  BOTH("leak_area", leak_area, 3e-8);
  BOTH("transducer_time", transducer_lag, 0.05);
  BOTH("dead_time", dead_time, 0.033);
  BOTH("flow_bend", bend, 0.3);
}

/* clang-format off */
static const effect_case positioned[] = {
    CASE(positioner,               5e-5, 2e-5, 3e-6),
    {"positioner_bend",           {1e-5, 2e-5, 3e-6}, set_positioner, {SAME(flow_bend, bend, 0.3)}},
    CASE(positioner_beside_others, 2e-5, 3e-5, 6e-6),
    CASE(positioner_dead_band,     6e-5, 4e-5, 5e-6),
    CASE(positioner_integral,      7e-5, 2e-4, 2e-5),
    {"positioner_overlap",        {6e-5, 3e-5, 2e-6}, set_positioner, {SAME(overlap, overlap, 0.05)}},
    {"positioner_span",           {8e-5, 1e-4, 4e-5}, set_positioner_integral, {SAME(span_excess, span, 0.05)}},
    {"positioner_underlap",       {3e-4, 7e-5, 2e-6}, set_positioner, {SAME(overlap, overlap, -0.05)}},
    {"positioner_zero",           {6e-5, 9e-5, 3e-5}, set_positioner_integral, {SAME(zero_shift, zero, 5e-4)}},
    CASE(positioner_start,         1e-4, 3e-4, 5e-5),
    {"dead_time",                 {2e-5, 1e-5, 3e-6}, set_positioner, {SAME(dead_time, dead_time, 0.033)}},
};
/* clang-format on */

/* ---- one experiment on both sides ---- */

typedef struct run {
  pneu_params p;
  second_rig g;
  int gas, flow;
  size_t n;
  double t[CHANGES], u[CHANGES];
  pneu_term term[2];
  int n_terms;
  const second_positioner *positioner;
} run;

static double channel[3][SAMPLES];

/* Time until the base model's pressure passes a level on its way. */
static double time_to(const pneu_model *m, pneu_state *s, double u, double level)
{
  const pneu_input input = fixture_input(m, u);
  double t = 0;
  while (u * (level - (double)s->p) > 0) {
    fixture_run(m, s, &input, dt / 10, 1e-5, NULL);
    t += dt / 10;
  }
  return t;
}

/* Fill and vent by turns, fully or in part, between random levels of pressure that keep away from the supply's and
 * from ambient, where the two sides blend their flow laws in different ways. */
static void random_commands(run *e, uint64_t seed)
{
  fixture_rig rig = fixture_at(fixture_model(&e->p, e->gas, e->flow), 0, 0, 0);
  double t = 0.2;
  for (e->n = 1; e->n < CHANGES && t < t_end; e->n++) {
    const int fill = e->n % 2 == 1;
    const double level = fill ? fixture_random(&seed, 2.2e5, 3.5e5) : fixture_random(&seed, 0.5e5, 1.8e5);
    e->t[e->n] = t;
    e->u[e->n] = (fill ? 1 : -1) * fmin(fixture_random(&seed, 0.2, 1.6), 1);
    t += time_to(&rig.m, &rig.s, e->u[e->n], level);
  }
}

/* Set positions in place of commands, beyond the cut-offs as well. */
static void random_set_positions(run *e, uint64_t seed)
{
  size_t i;
  for (i = 1; i < CHANGES; i++) {
    e->t[i] = 0.2 + 0.24 * (double)(i - 1);
    e->u[i] = fixture_random(&seed, 0.1, 0.85);
  }
  e->n = CHANGES;
}

/* The R1-400 with faster orifices, and with a dead volume that leaves room for stops that yield. */
static run random_experiment(uint64_t seed, int gas, int flow)
{
  run e;
  memset(&e, 0, sizeof e);
  e.p = fixture_params(FIXTURE_R1_400);
  e.g = second_rig_default_r1_400();
  e.p.dead_volume = (pneu_real)(e.g.dead_volume = 2e-5);
  e.p.fill_area = e.p.vent_area = (pneu_real)(e.g.fill_area = e.g.vent_area = 4e-6);
  e.g.step = 80e-6;
  e.gas = gas;
  e.flow = flow;
  e.g.gas = gas == PNEU_GAS_ISOTHERMAL ? SECOND_ISOTHERMAL : SECOND_ENERGY;
  e.g.flow = flow == PNEU_FLOW_PAPER ? SECOND_PAPER : flow == PNEU_FLOW_CHOKED ? SECOND_CHOKED : SECOND_ISO6358;
  e.g.iso_b = (double)e.p.critical_ratio;
  e.g.iso_m = (double)e.p.subsonic_index;
  random_commands(&e, seed);
  return e;
}

static lab_response respond(const run *e)
{
  pneu_model m = fixture_model(&e->p, e->gas, e->flow);
  lab_schedule schedule;
  pneu_input input[CHANGES];
  double t[SAMPLES];
  lab_response response;
  pneu_state start;
  const lab_simulation task = {
      .start = &start, .schedule = &schedule, .t = t, .n = SAMPLES, .t_end = t_end, .options = {.tol = 1e-9}};
  size_t i;
  assert_int_equal(pneu_model_terms(&m, e->term, e->n_terms), PNEU_OK);
  for (i = 0; i < e->n; i++) {
    input[i] = fixture_input(&m, e->u[i]);
    input[i].set_position = e->positioner != NULL;
  }
  for (i = 0; i < SAMPLES; i++)
    t[i] = (double)i * dt;
  schedule.n = e->n;
  schedule.t = e->t;
  schedule.input = input;
  start = fixture_rest(&m, 0, 0, &input[0]);
  succeed(lab_response_run(&m, &task, &response, &error));
  return response;
}

static apart compare(const run *e)
{
  const second_log log = {NULL, NULL, channel[0], channel[1], channel[2], NULL, NULL};
  const second_course course = {.t_cmd = e->t, .u_cmd = e->u, .n = e->n, .positioner = e->positioner};
  lab_response response = respond(e);
  apart d = {0, 0, 0};
  int i;
  assert_int_equal(second_follow(&e->g, &course, t_end, dt, &log, NULL), 0);
  for (i = 0; i < SAMPLES; i++)
    widen(&d, response.p[i] - channel[0][i], response.x[i] - channel[1][i], response.T[i] - channel[2][i]);
  lab_response_free(&response);
  return d;
}

/* PNEU_SHOW in the environment prints the differences. */
static void assert_agrees(const run *e, const apart *most, const char *what)
{
  const apart d = compare(e);
  check_note("p %.1e, x %.1e, T %.1e apart: %s", d.p, d.x, d.T, what);
  if (getenv("PNEU_SHOW"))
    printf("%s\n", check_case);
  assert_between(d.p, 0, most->p);
  assert_between(d.x, 0, most->x);
  assert_between(d.T, 0, most->T);
}

/* ---- tests ---- */

static const int laws[][2] = {{PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER}, {PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED}};

/* Whether this build has the effect. Heat is a parameter of one chamber law: the other side's isothermal chamber has a
 * perfect film. */
static int comparable(const effect_case *c, int gas)
{
  const int heat = strcmp(c->name, "heat_transfer") == 0 || strcmp(c->name, "wall_temperature") == 0;
  if (heat && (gas != PNEU_GAS_ENERGY || pneu_effect_find("heat_transfer") < 0))
    return 0;
  return pneu_effect_find(c->name) >= 0;
}

TEST(test_lab_response_run__base_model__is_that_of_the_second_implementation)
{
  static const apart most = {3e-6, 1e-7, 2e-6}; /* as for the effects */
  int law;
  for (law = 0; law < COUNT(laws); law++) {
    const run e = random_experiment(1, laws[law][0], laws[law][1]);
    assert_agrees(&e, &most, "base");
  }
}

TEST(test_lab_response_run__each_effect__is_that_of_the_second_implementation)
{
  int law, i;
  for (i = 0; i < COUNT(cases); i++)
    for (law = 0; law < COUNT(laws); law++) {
      run e = random_experiment((uint64_t)(7 + i), laws[law][0], laws[law][1]);
      char what[80];
      if (!comparable(&cases[i], laws[law][0]))
        continue;
      set_case(&cases[i], &e.p, &e.g, law ? 0.8 : 1);
      snprintf(what, sizeof what, "%s, %s", cases[i].name, pneu_gas_key(laws[law][0]));
      assert_agrees(&e, &cases[i].most, what);
    }
}

TEST(test_lab_response_run__lines__are_those_of_the_second_implementation)
{
  static const int law[][2] = {{PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER},
                               {PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED},
                               {PNEU_GAS_ENERGY, PNEU_FLOW_ISO6358}};
  int i, k;
  fixture_need("connecting_tube");
  fixture_need("supply_droop");
  for (i = 0; i < COUNT(lines); i++)
    for (k = 0; k < COUNT(law); k++) {
      run e = random_experiment((uint64_t)(200 + i), law[k][0], law[k][1]);
      char what[80];
      set_line(&lines[i], &e.p, &e.g);
      snprintf(what, sizeof what, "%s, %s, %s", lines[i].name, pneu_gas_key(law[k][0]), pneu_flow_key(law[k][1]));
      assert_agrees(&e, &lines[i].most, what);
    }
}

TEST(test_lab_response_run__exponent__is_that_of_the_second_implementation)
{
  int flow;
  fixture_need(exponent.name);
  for (flow = 0; flow < 2; flow++) {
    run e = random_experiment((uint64_t)(70 + flow), PNEU_GAS_ISOTHERMAL, flow ? PNEU_FLOW_CHOKED : PNEU_FLOW_PAPER);
    set_case(&exponent, &e.p, &e.g, flow ? 0.3 : 1);
    assert_agrees(&e, &exponent.most, exponent.name);
    e = random_experiment((uint64_t)(72 + flow), PNEU_GAS_ISOTHERMAL, flow ? PNEU_FLOW_CHOKED : PNEU_FLOW_PAPER);
    set_case(&rate_exponent, &e.p, &e.g, flow ? 0.3 : 1);
    assert_agrees(&e, &rate_exponent.most, "rate_exponent_rise");
  }
}

TEST(test_lab_response_run__start_temperature__is_that_of_the_second_implementation)
{
  int i;
  fixture_need(begins.name);
  for (i = 0; i < 2; i++) {
    run e = random_experiment((uint64_t)(74 + i), PNEU_GAS_ENERGY, i ? PNEU_FLOW_CHOKED : PNEU_FLOW_PAPER);
    set_case(&begins, &e.p, &e.g, i ? -1 : 1);
    assert_agrees(&e, &begins.most, begins.name);
  }
}

TEST(test_lab_response_run__long_chamber__is_that_of_the_second_implementation)
{
  int i;
  fixture_need(along.name);
  for (i = 0; i < 4; i++) {
    run e = random_experiment((uint64_t)(76 + i), laws[i % 2][0], laws[i % 2][1]);
    set_case(&along, &e.p, &e.g, i < 2 ? 1 : 0.4);
    random_commands(&e, (uint64_t)(76 + i)); /* at its own pace */
    assert_agrees(&e, &along.most, along.name);
  }
}

TEST(test_lab_response_run__positioner__is_that_of_the_second_implementation)
{
  int law, i;
  fixture_need("positioner");
  for (i = 0; i < COUNT(positioned); i++)
    for (law = 0; law < COUNT(laws); law++) {
      run e = random_experiment(1, laws[law][0], laws[law][1]);
      char what[80];
      random_set_positions(&e, (uint64_t)(50 + i));
      memset(&other, 0, sizeof other);
      other.cutoff_low = -1, other.cutoff_high = 2; /* none */
      set_case(&positioned[i], &e.p, &e.g, law ? 0.8 : 1);
      e.positioner = &other;
      snprintf(what, sizeof what, "%s, %s", positioned[i].name, pneu_gas_key(laws[law][0]));
      assert_agrees(&e, &positioned[i].most, what);
    }
}

/* How far the stem is from that of a controller that works by turns, and is heard a dead time later [of the stroke]. */
static double off_turns(const char *name, double seconds)
{
  run e = random_experiment(1, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
  random_set_positions(&e, 50);
  memset(&other, 0, sizeof other);
  other.cutoff_low = -1, other.cutoff_high = 2; /* none */
  set_positioner(&e.p, &e.g, 1);
  other.cycle = 1e-3;
  e.g.dead_time = 0.033;
  fixture_set(&e.p, name, seconds);
  e.positioner = &other;
  return compare(&e).x;
}

/* Within the loop a dead time is made of lags: nearer to it than one lag of the same length is, or none. */
TEST(test_lab_response_run__dead_time_of_a_positioner__is_nearly_that_of_one_that_works_by_turns)
{
  double off, lag, none;
  fixture_need("positioner");
  fixture_need("dead_time");
  fixture_need("transducer_lag");
  off = off_turns("dead_time", 0.033);
  lag = off_turns("transducer_time", 0.033);
  none = off_turns("transducer_time", 0);
  check_note("off by %g, one lag by %g, none by %g of the stroke", off, lag, none);
  assert_true(off < 0.8 * lag);
  assert_true(off < 0.5 * none);
}

/* Give an experiment some of the first n effects, at random sizes, and append their names. */
static void set_some(run *e, int n, double share, uint64_t *seed, char *what, size_t room)
{
  int i;
  for (i = 0; i < n; i++) {
    const double size = fixture_random(seed, 0.3, 1.5), chance = fixture_random(seed, 0, 1);
    if (chance > share || !comparable(&cases[i], e->gas))
      continue;
    set_case(&cases[i], &e->p, &e->g, size);
    lab_append(what, room, " %s", cases[i].name);
  }
}

/* Some of the effects at once, at random sizes: order and interplay. Effects that are newer than the first sets take
 * part in the last ones only, lest the first become others. */
TEST(test_lab_response_run__random_sets_of_effects__agree_with_the_second_implementation)
{
  enum { FIRST_SETS = 8, NEWER = 2 };
  static const apart most[] = {{2e-6, 3e-9, 3e-15}, {7e-7, 6e-7, 2e-7}, {7e-6, 5e-6, 3e-15}, {6e-7, 3e-9, 3e-9},
                               {7e-6, 6e-7, 3e-15}, {3e-8, 3e-8, 4e-9}, {8e-7, 6e-8, 3e-15}, {3e-8, 2e-8, 8e-9},
                               {2e-7, 2e-8, 3e-15}, {3e-5, 6e-8, 2e-5}, {2e-6, 6e-8, 3e-15}, {8e-5, 5e-5, 3e-5}};
  uint64_t seed = 5;
  int draw;
  for (draw = 0; draw < COUNT(most); draw++) {
    const int *law = laws[draw % 2];
    run e = random_experiment((uint64_t)(100 + draw), law[0], law[1]);
    char what[600];
    snprintf(what, sizeof what, "set %d", draw);
    set_some(&e, COUNT(cases) - (draw < FIRST_SETS ? NEWER : 0), 0.35, &seed, what, sizeof what);
    assert_agrees(&e, &most[draw], what);
  }
}

/* Each line beside some of the effects, what it has in common with them as its row says. */
TEST(test_lab_response_run__lines_in_random_sets__agree_with_the_second_implementation)
{
  static const apart most[COUNT(lines)] = {{2e-7, 2e-8, 3e-15}, {2e-7, 3e-8, 3e-15}, {3e-6, 2e-6, 2e-6},
                                           {4e-8, 2e-9, 2e-7},  {7e-5, 2e-6, 3e-15}, {7e-7, 2e-7, 3e-15},
                                           {2e-6, 5e-8, 9e-9},  {3e-5, 6e-7, 2e-5}};
  uint64_t seed = 6;
  int draw;
  fixture_need("connecting_tube");
  fixture_need("supply_droop");
  for (draw = 0; draw < COUNT(most); draw++) {
    const int *law = laws[draw / 2 % 2];
    run e = random_experiment((uint64_t)(220 + draw), law[0], law[1]);
    char what[600];
    snprintf(what, sizeof what, "%s,", lines[draw].name);
    set_some(&e, COUNT(cases), 0.3, &seed, what, sizeof what);
    set_line(&lines[draw], &e.p, &e.g);
    assert_agrees(&e, &most[draw], what);
  }
}

/* ---- free terms ---- */

/* What the other side has as a law, and this side as a table over one argument. */
typedef struct term_case {
  const char *name;
  int equation, argument;
  double from, to;
  int isothermal_only;
  double (*curve)(const second_rig *g, double argument);
  void (*set)(second_rig *g); /* NULL: */
  size_t field;               /* only this one, */
  double value;
} term_case;

static void set_bump(second_rig *g)
{
  g->bump = 200;
  g->bump_at = 0.011;
  g->bump_width = 2e-3;
}

static double bump(const second_rig *g, double x)
{
  const double s = (x - g->bump_at) / g->bump_width;
  return g->bump * exp(-s * s);
}

static void set_relief(second_rig *g)
{
  g->relief_area = 1e-7;
  g->relief_from = 1.9e5; /* between two knots, as in life */
  g->relief_span = 7e4;
}

/* [B, Eq. 8] out of the chamber. */
static double relief(const second_rig *g, double p)
{
  const double open = fmin(fmax((p - g->relief_from) / g->relief_span, 0), 1), upstream = p + g->ambient;
  return -g->relief_area * open * sqrt(2 * upstream * fmax(p, 0) / (g->gas_constant * g->ambient_temperature));
}

static double cubic(const second_rig *g, double x)
{
  return g->spring_cubic * x * x * x;
}

static double seal(const second_rig *g, double p)
{
  return g->friction_pressure * fabs(p);
}

static double shown_pressure(const second_rig *g, double p)
{
  return g->pressure_gain * p;
}

static double shown_position(const second_rig *g, double x)
{
  return g->position_gain * x;
}

static const term_case terms[] = {
    {"bump", PNEU_TERM_FRICTION, PNEU_TERM_OVER_POSITION, 0, 0.02, 0, bump, set_bump, 0, 0},
    {"relief", PNEU_TERM_FLOW, PNEU_TERM_OVER_PRESSURE, 0, 4e5, 1, relief, set_relief, 0, 0},
    {"cubic", PNEU_TERM_FORCE, PNEU_TERM_OVER_POSITION, 0, 0.02, 0, cubic, NULL, offsetof(second_rig, spring_cubic),
     8e7},
    {"seal", PNEU_TERM_FRICTION, PNEU_TERM_OVER_PRESSURE, 0, 4e5, 0, seal, NULL,
     offsetof(second_rig, friction_pressure), 1e-3},
    {"shown pressure", PNEU_TERM_SHOWN_PRESSURE, PNEU_TERM_OVER_PRESSURE, -1e5, 4e5, 0, shown_pressure, NULL,
     offsetof(second_rig, pressure_gain), -0.04},
    {"shown position", PNEU_TERM_SHOWN_POSITION, PNEU_TERM_OVER_POSITION, 0, 0.02, 0, shown_position, NULL,
     offsetof(second_rig, position_gain), 0.05},
};

static void sample_term(const term_case *c, const second_rig *g, int n, pneu_term *term)
{
  int i;
  term->equation = c->equation;
  term->argument = c->argument;
  term->n = n;
  term->from = (pneu_real)c->from;
  term->to = (pneu_real)c->to;
  for (i = 0; i < n; i++)
    term->value[i] = (pneu_real)c->curve(g, c->from + (c->to - c->from) * i / (n - 1));
}

/* Largest distance between a curve and its table. */
static double interpolation_error(const term_case *c, const second_rig *g, const pneu_term *term)
{
  enum { FINE = 64 };
  double most = 0;
  int i, k;
  for (i = 0; i + 1 < term->n; i++)
    for (k = 0; k < FINE; k++) {
      const double part = (double)k / FINE;
      const double at = c->from + (c->to - c->from) * (i + part) / (term->n - 1);
      const double table = (1 - part) * (double)term->value[i] + part * (double)term->value[i + 1];
      most = fmax(most, fabs(c->curve(g, at) - table));
    }
  return most;
}

/* How far a constant error of the first term, of either sign, moves the response. */
static apart moved_by(const run *e, double by)
{
  run off = *e;
  lab_response base = respond(e);
  apart most = {0, 0, 0};
  int sign, i;
  off.n_terms = 2;
  off.term[1] = e->term[0];
  off.term[1].n = 2;
  for (sign = -1; sign <= 1; sign += 2) {
    lab_response response;
    off.term[1].value[0] = off.term[1].value[1] = (pneu_real)(sign * by);
    response = respond(&off);
    for (i = 0; i < SAMPLES; i++)
      widen(&most, response.p[i] - base.p[i], response.x[i] - base.x[i], response.T[i] - base.T[i]);
    lab_response_free(&response);
  }
  lab_response_free(&base);
  return most;
}

/* Both sides agree as well as a table can: the interpolation error may move the response as much as a constant of its
 * size does, and both implementations differ by 1e-5 without it. Without the table they are far apart. */
static void check_term(const term_case *c, const int *law, int knots)
{
  const double same = 1e-5;
  run e = random_experiment(9, law[0], law[1]);
  apart d, allowed, without;
  if (c->set)
    c->set(&e.g);
  else
    *(double *)((char *)&e.g + c->field) = c->value;
  without = compare(&e);
  sample_term(c, &e.g, knots, &e.term[0]);
  e.n_terms = 1;
  d = compare(&e);
  allowed = moved_by(&e, interpolation_error(c, &e.g, &e.term[0]));
  check_note("%s, %s, %d knots: p %.1e, x %.1e, T %.1e apart; by interpolation %.1e, %.1e, %.1e; without %.1e, %.1e",
             c->name, pneu_gas_key(law[0]), knots, d.p, d.x, d.T, allowed.p, allowed.x, allowed.T, without.p,
             without.x);
  if (getenv("PNEU_SHOW"))
    printf("%s\n", check_case);
  assert_between(d.p, 0, allowed.p + same);
  assert_between(d.x, 0, allowed.x + same);
  assert_between(d.T, 0, allowed.T + same);
  assert_true(fmax(without.p, without.x) > 10 * fmax(d.p, d.x));
}

TEST(test_lab_response_run__table_of_what_has_no_effect__is_that_of_the_second_implementation)
{
  int law, i;
  for (i = 0; i < COUNT(terms); i++)
    for (law = 0; law < COUNT(laws); law++)
      if (laws[law][0] == PNEU_GAS_ISOTHERMAL || !terms[i].isothermal_only) {
        check_term(&terms[i], laws[law], (PNEU_TERM_KNOTS + 1) / 2);
        check_term(&terms[i], laws[law], PNEU_TERM_KNOTS);
      }
}

TEST(test_effects_def__each_effect__is_compared)
{
  int e, i, found;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    for (i = found = 0; i < COUNT(cases); i++)
      found += strcmp(cases[i].name, pneu_effect_at(e)->name) == 0;
    for (i = 0; i < COUNT(positioned); i++)
      found += strcmp(positioned[i].name, pneu_effect_at(e)->name) == 0;
    found += strcmp(exponent.name, pneu_effect_at(e)->name) == 0;
    found += strcmp(begins.name, pneu_effect_at(e)->name) == 0;
    found += strcmp(along.name, pneu_effect_at(e)->name) == 0;
    if (!found)
      fail_msg("%s is not compared with the second implementation", pneu_effect_at(e)->name);
  }
}

/* Free terms: tables over one argument, added to one equation. Against closed forms, against effects that are sampled
 * into a table, and in the books of the base model. */
#include "../fixture.h"
#include "../../lib/internal.h"

enum { SAMPLES = 640 };

/* ---- tables ---- */

typedef double curve(double argument);

/* A curve at n equidistant knots, and no number behind the last, so that nobody looks there. */
static pneu_term sampled(int equation, int argument, int n, double from, double to, curve *f)
{
  pneu_term term;
  int i;
  memset(&term, 0, sizeof term);
  term.equation = equation;
  term.argument = argument;
  term.n = n;
  term.from = (pneu_real)from;
  term.to = (pneu_real)to;
  for (i = 0; i < n; i++)
    term.value[i] = (pneu_real)f(from + (to - from) * i / (n - 1));
  for (; i < PNEU_TERM_KNOTS; i++)
    term.value[i] = (pneu_real)NAN;
  return term;
}

static double zero(double argument)
{
  (void)argument;
  return 0;
}

/* Knots that no straight line joins. */
static double zigzag(double argument)
{
  return 3 + cos(7e3 * argument) + 100 * argument;
}

static void add(pneu_model *m, const pneu_term *term, int n)
{
  assert_int_equal(pneu_model_terms(m, term, n), PNEU_OK);
}

/* ---- which tables are taken ---- */

static pneu_term good_term(void)
{
  return sampled(PNEU_TERM_FRICTION, PNEU_TERM_OVER_POSITION, 5, 0, 0.02, zigzag);
}

static int offer(const pneu_term *term)
{
  const pneu_term before = good_term();
  pneu_model m = fixture_r1_400(PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  int status;
  add(&m, &before, 1);
  status = pneu_model_terms(&m, term, 1);
  assert_ptr_equal(m.term, status == PNEU_OK ? term : &before);
  return status;
}

TEST(test_pneu_model_terms__good_terms__are_used_where_they_lie)
{
  const pneu_term term[2] = {good_term(), good_term()};
  pneu_model m = fixture_r1_400(PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  assert_int_equal(m.n_terms, 0);
  add(&m, term, 2);
  assert_int_equal(m.n_terms, 2);
  assert_ptr_equal(m.term, term);
  add(&m, NULL, 0);
  assert_int_equal(m.n_terms, 0);
}

TEST(test_pneu_model_terms__unknown_equation_or_argument__is_refused)
{
  pneu_term term = good_term();
  assert_int_equal(offer(&term), PNEU_OK);
  term.equation = PNEU_TERM_EQUATION_COUNT;
  assert_int_equal(offer(&term), PNEU_E_LAW);
  term.equation = -1;
  assert_int_equal(offer(&term), PNEU_E_LAW);
  term = good_term();
  term.argument = PNEU_TERM_ARGUMENT_COUNT;
  assert_int_equal(offer(&term), PNEU_E_LAW);
  term.argument = -1;
  assert_int_equal(offer(&term), PNEU_E_LAW);
}

TEST(test_pneu_model_terms__bad_number_of_knots__is_refused)
{
  static const int n[] = {-1, 0, 1, PNEU_TERM_KNOTS + 1};
  pneu_term term = sampled(PNEU_TERM_FORCE, PNEU_TERM_OVER_POSITION, PNEU_TERM_KNOTS, 0, 0.02, zigzag);
  int i;
  assert_int_equal(offer(&term), PNEU_OK);
  for (i = 0; i < COUNT(n); i++) {
    term.n = n[i];
    assert_int_equal(offer(&term), PNEU_E_PARAM);
  }
  term.n = 2;
  assert_int_equal(offer(&term), PNEU_OK);
}

TEST(test_pneu_model_terms__no_finite_numbers__are_refused)
{
  static const double odd[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
  int i, k;
  for (i = 0; i < COUNT(odd); i++) {
    pneu_term term = good_term();
    term.from = (pneu_real)odd[i];
    assert_int_equal(offer(&term), PNEU_E_PARAM);
    term = good_term();
    term.to = (pneu_real)odd[i];
    assert_int_equal(offer(&term), PNEU_E_PARAM);
    for (k = 0; k < 5; k++) {
      term = good_term();
      term.value[k] = (pneu_real)odd[i];
      assert_int_equal(offer(&term), PNEU_E_PARAM);
    }
  }
}

TEST(test_pneu_model_terms__ends_swapped_or_equal__are_refused)
{
  pneu_term term = good_term();
  term.to = term.from;
  assert_int_equal(offer(&term), PNEU_E_PARAM);
  term.to = term.from - 1;
  assert_int_equal(offer(&term), PNEU_E_PARAM);
}

TEST(test_pneu_model_terms__negative_count__is_refused)
{
  const pneu_term term = good_term();
  pneu_model m = fixture_r1_400(PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  assert_int_equal(pneu_model_terms(&m, &term, -1), PNEU_E_PARAM);
  assert_int_equal(m.n_terms, 0);
}

/* ---- values ---- */

/* What a sensor shows too much at position x. */
static double shown_at(const pneu_model *m, double x)
{
  const pneu_input input = fixture_input(m, 0);
  pneu_state s = fixture_rest(m, 2e5, 0.01, &input);
  s.x = (pneu_real)x;
  return fixture_look(m, &s, &input).shown_p - 2e5;
}

TEST(test_pneu_add_terms__knots_middles_and_beyond__lie_on_the_lines)
{
  pneu_model m = fixture_r1_400(PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  pneu_term term = sampled(PNEU_TERM_SHOWN_PRESSURE, PNEU_TERM_OVER_POSITION, 9, 0.004, 0.016, zigzag);
  const double h = 0.012 / 8, tol = TOL(1e-9, 0.1);
  int i;
  for (i = 0; i < 9; i++)
    term.value[i] *= 1000;
  add(&m, &term, 1);
  for (i = 0; i < 9; i++) {
    check_note("knot %d", i);
    assert_close(shown_at(&m, 0.004 + i * h), (double)term.value[i], tol, 0);
  }
  for (i = 0; i < 8; i++) {
    check_note("after knot %d", i);
    assert_close(shown_at(&m, 0.004 + (i + 0.5) * h), (double)(term.value[i] + term.value[i + 1]) / 2, tol, 0);
    assert_close(shown_at(&m, 0.004 + (i + 0.25) * h), (double)(3 * term.value[i] + term.value[i + 1]) / 4, tol, 0);
  }
  assert_close(shown_at(&m, (double)term.to), (double)term.value[8], 0, TOL(1e-12, 1e-4));
  assert_close(shown_at(&m, 0), (double)term.value[0], tol, 0);
  assert_close(shown_at(&m, 0.02), (double)term.value[8], tol, 0);
}

/* ---- each equation, each argument ---- */

/* Terms at a moving state, filling through half an opening. */
static pneu_terms sums(const pneu_model *m)
{
  const pneu_input input = fixture_input(m, 0.5);
  pneu_state s = fixture_rest(m, 2.2e5, 0.011, &input);
  pneu_real y[PNEU_STATE_MAX];
  pneu_terms t;
  s.T = 310;
  s.v = (pneu_real)-0.02;
  s.extra[0] = (pneu_real)0.3; /* the clock, where there is one: the base model has no other states */
  s.mode = m->law.position_input ? PNEU_MODE_DRIVEN : PNEU_MODE_DOWN;
  pneu_pack(m, &s, y);
  assert_int_equal(pneu_evaluate(m, &s, &input, y, PNEU_EXTENT_FLOWS, &t, NULL), PNEU_OK);
  return t;
}

/* The sums by which the equations differ. */
enum { SUPPLY, FORCE, FRICTION, IN, IN_T, OUT, HEAT, P, X, SUMS };

static void difference(int gas, int pressure_input, int position_input, const pneu_term *term, int n, double *d)
{
  const pneu_params p = fixture_params(FIXTURE_R1_400);
  pneu_model m = fixture_model_roles(&p, gas, PNEU_FLOW_CHOKED, pressure_input, position_input);
  const pneu_terms a = sums(&m);
  pneu_terms b;
  add(&m, term, n);
  b = sums(&m);
  d[SUPPLY] = (double)b.supply - (double)a.supply;
  d[FORCE] = (double)b.force - (double)a.force;
  d[FRICTION] = (double)b.friction - (double)a.friction;
  d[IN] = (double)b.mass_in - (double)a.mass_in;
  d[IN_T] = (double)b.mass_in_T - (double)a.mass_in_T;
  d[OUT] = (double)b.mass_out - (double)a.mass_out;
  d[HEAT] = (double)b.heat - (double)a.heat;
  d[P] = (double)b.p_shown - (double)a.p_shown;
  d[X] = (double)b.x_shown - (double)a.x_shown;
}

/* A line from value 1 to 3 whose middle lies at the state of `sums`; a cosine and a sine in the middle of their
 * cycle, where only the cosine counts. */
static pneu_term line(int equation, int argument, double size)
{
  static const double middle[PNEU_TERM_ARGUMENT_COUNT] = {0.011, -0.02, 2.2e5, 0.5, 0.3};
  pneu_term term;
  memset(&term, 0, sizeof term);
  term.equation = equation;
  term.argument = argument;
  term.n = 2;
  term.from = (pneu_real)(middle[argument] - fabs(middle[argument]));
  term.to = (pneu_real)(middle[argument] + fabs(middle[argument]));
  term.value[0] = (pneu_real)(argument == PNEU_TERM_OVER_CYCLE ? -2 * size : size);
  term.value[1] = (pneu_real)(3 * size);
  return term;
}

typedef struct place {
  int equation, sum;
  double size, sign;
} place;

/* Sums that another one moves: the flow by the supply, what it carries by the flow. */
static int follows(int sum, int other)
{
  return sum == other || (sum == IN_T && other == IN) || ((sum == IN || sum == IN_T) && other == SUPPLY);
}

TEST(test_pneu_add_terms__each_equation_and_argument__changes_its_sum_only)
{
  static const place places[] = {{PNEU_TERM_SUPPLY, SUPPLY, 4096, 1},    {PNEU_TERM_FORCE, FORCE, 64, -1},
                                 {PNEU_TERM_FRICTION, FRICTION, 64, 1},  {PNEU_TERM_FLOW, IN, 1e-4, 1},
                                 {PNEU_TERM_FLOW, OUT, -1e-4, -1},       {PNEU_TERM_HEAT, HEAT, -16, 1},
                                 {PNEU_TERM_SHOWN_PRESSURE, P, 4096, 1}, {PNEU_TERM_SHOWN_POSITION, X, 1e-3, 1}};
  int i, k, argument;
  for (i = 0; i < COUNT(places); i++)
    for (argument = 0; argument < PNEU_TERM_ARGUMENT_COUNT; argument++) {
      const place *at = &places[i];
      const pneu_term term = line(at->equation, argument, at->size);
      double d[SUMS];
      difference(PNEU_GAS_ENERGY, 0, 0, &term, 1, d);
      check_note("equation %d, argument %d", at->equation, argument);
      assert_close(d[at->sum], at->sign * 2 * at->size, 0, TOL(1e-9, 1e-3));
      if (at->sum == IN)
        assert_close(d[IN_T], d[IN] * 298.15, 0, TOL(1e-9, 1e-3));
      for (k = 0; k < SUMS; k++)
        assert_true((d[k] != 0) == follows(k, at->sum));
    }
}

TEST(test_pneu_add_terms__several_on_one_equation__add_up)
{
  const pneu_term term[3] = {line(PNEU_TERM_FORCE, PNEU_TERM_OVER_POSITION, 64),
                             line(PNEU_TERM_FRICTION, PNEU_TERM_OVER_VELOCITY, 32),
                             line(PNEU_TERM_FORCE, PNEU_TERM_OVER_PRESSURE, -8)};
  double d[SUMS];
  difference(PNEU_GAS_ISOTHERMAL, 0, 0, term, 3, d);
  assert_close(d[FORCE], -2 * 64 + 2 * 8, 0, TOL(1e-9, 1e-3));
  assert_close(d[FRICTION], 2 * 32, 0, TOL(1e-9, 1e-3));
}

/* 480 N of dry friction. */
TEST(test_pneu_add_terms__friction_less_than_none__is_none)
{
  pneu_term term = line(PNEU_TERM_FRICTION, PNEU_TERM_OVER_POSITION, -200);
  double d[SUMS];
  difference(PNEU_GAS_ISOTHERMAL, 0, 0, &term, 1, d);
  assert_close(d[FRICTION], -400, 0, TOL(1e-12, 1e-6));
  term = line(PNEU_TERM_FRICTION, PNEU_TERM_OVER_POSITION, -300);
  difference(PNEU_GAS_ISOTHERMAL, 0, 0, &term, 1, d);
  assert_close(d[FRICTION], -480, 0, 0);
}

/* Bristles bend until they carry the level with the term: no rate is left there. */
TEST(test_pneu_add_terms__friction_with_bristles__is_in_their_level)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  const pneu_term term = line(PNEU_TERM_FRICTION, PNEU_TERM_OVER_POSITION, 120);
  pneu_real y[PNEU_STATE_MAX], f[PNEU_STATE_MAX];
  pneu_model m;
  pneu_input input;
  pneu_state s;
  fixture_need("presliding");
  fixture_set(&p, "presliding_length", 2e-5);
  m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  input = fixture_input(&m, 0);
  add(&m, &term, 1);
  s = fixture_rest(&m, 2e5, 0.011, &input);
  s.v = (pneu_real)0.01;
  s.mode = PNEU_MODE_UP;
  s.extra[0] = (pneu_real)(720.0 / 480);
  pneu_pack(&m, &s, y);
  assert_int_equal(pneu_rhs(&m, &s, &input, y, f), PNEU_OK);
  assert_close(f[1], 0, 1e-4 * 0.01 / 2e-5, 0);
}

/* No temperature of its own, no balance of energy, or no balance at all: nothing to heat, nothing to fill. */
TEST(test_pneu_add_terms__heat_and_flow_where_they_cannot_act__do_nothing)
{
  const pneu_term heat = line(PNEU_TERM_HEAT, PNEU_TERM_OVER_POSITION, 10),
                  flow = line(PNEU_TERM_FLOW, PNEU_TERM_OVER_POSITION, 1e-4);
  double d[SUMS];
  difference(PNEU_GAS_ISOTHERMAL, 0, 0, &heat, 1, d);
  assert_true(d[HEAT] == 0);
  difference(PNEU_GAS_POLYTROPIC, 0, 0, &heat, 1, d);
  assert_true(d[HEAT] == 0);
  difference(PNEU_GAS_ENERGY, 1, 0, &heat, 1, d);
  assert_true(d[HEAT] == 0);
  difference(PNEU_GAS_ENERGY, 1, 0, &flow, 1, d);
  assert_true(d[IN] == 0 && d[OUT] == 0);
  difference(PNEU_GAS_ENERGY, 0, 1, &heat, 1, d);
  assert_close(d[HEAT], 20, 0, TOL(1e-9, 1e-3));
}

/* ---- no term, and terms of nothing ---- */

static int standard(const pneu_model *m, double tol, fixture_sample *out)
{
  fixture_stretch stretch[3];
  pneu_state s;
  fixture_standard(m, stretch);
  s = fixture_rest(m, 0, 0, &stretch[0].input);
  memset(out, 0, SAMPLES * sizeof *out);
  return fixture_trace(m, &s, stretch, 3, 0.05, tol, out, SAMPLES);
}

/* Every equation over every argument. */
enum { ALL = PNEU_TERM_EQUATION_COUNT * PNEU_TERM_ARGUMENT_COUNT };

static void all_of_nothing(pneu_term term[ALL])
{
  static const double from[PNEU_TERM_ARGUMENT_COUNT] = {0, -0.1, 0, -1, 0},
                      to[PNEU_TERM_ARGUMENT_COUNT] = {0.02, 0.1, 4e5, 1, 20};
  int i;
  for (i = 0; i < ALL; i++) {
    const int argument = i % PNEU_TERM_ARGUMENT_COUNT;
    const int n = argument == PNEU_TERM_OVER_CYCLE ? PNEU_TERM_KNOTS / 2 * 2 : PNEU_TERM_KNOTS;
    term[i] = sampled(i / PNEU_TERM_ARGUMENT_COUNT, argument, n, from[argument], to[argument], zero);
  }
}

/* Take the clock out of a packed slope. */
static void without_clock(const pneu_model *m, pneu_real f[PNEU_STATE_MAX])
{
  const int at = 1 + m->thermal + m->clock;
  assert_close(f[at], 1, 0, 0);
  memmove(f + at, f + at + 1, (size_t)(PNEU_STATE_MAX - at - 1) * sizeof *f);
  f[PNEU_STATE_MAX - 1] = 0;
}

TEST(test_pneu_run__no_terms__is_the_base_model_bit_for_bit)
{
  static fixture_sample base[SAMPLES], none[SAMPLES];
  const pneu_term term = good_term();
  pneu_model m = fixture_r1_400(PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED);
  standard(&m, 1e-5, base);
  add(&m, &term, 1);
  standard(&m, 1e-5, none);
  assert_true(memcmp(base, none, sizeof base) != 0);
  add(&m, NULL, 0);
  standard(&m, 1e-5, none);
  assert_memory_equal(base, none, sizeof base);
}

/* The right-hand side is the same bit for bit but for the clock, which goes on by itself; the Jacobian is by
 * differences, which moves the steps, as the clock does. */
TEST(test_pneu_rhs__terms_of_nothing__is_that_of_the_base_model_bit_for_bit)
{
  static const int modes[] = {PNEU_MODE_UP, PNEU_MODE_DOWN, PNEU_MODE_STUCK, PNEU_MODE_LOWER};
  pneu_term term[ALL];
  uint64_t seed = 3;
  int i, gas;
  all_of_nothing(term);
  for (gas = 0; gas < PNEU_GAS_COUNT; gas++)
    for (i = 0; i < 200; i++) {
      pneu_model base = fixture_r1_400(gas, PNEU_FLOW_CHOKED), m = base;
      const pneu_input input = fixture_input(&base, fixture_random(&seed, -1, 1));
      pneu_state s = fixture_rest(&base, fixture_random(&seed, -5e4, 5e5), fixture_random(&seed, 0, 0.02), &input);
      pneu_real y[PNEU_STATE_MAX], f[PNEU_STATE_MAX] = {0}, g[PNEU_STATE_MAX] = {0};
      s.extra[0] = (pneu_real)fixture_random(&seed, 0, 100); /* the clock, in the model that has one */
      s.mode = modes[i % 4];
      s.v = (pneu_real)(s.mode == PNEU_MODE_UP ? 0.03 : s.mode == PNEU_MODE_DOWN ? -0.03 : 0);
      pneu_pack(&base, &s, y);
      assert_int_equal(pneu_rhs(&base, &s, &input, y, f), PNEU_OK);
      add(&m, term, ALL);
      pneu_pack(&m, &s, y);
      assert_int_equal(pneu_rhs(&m, &s, &input, y, g), PNEU_OK);
      without_clock(&m, g);
      assert_memory_equal(f, g, sizeof f);
    }
}

TEST(test_pneu_run__terms_of_nothing__is_the_base_model_to_the_stepper_s_tolerance)
{
  static fixture_sample base[SAMPLES], nothing[SAMPLES];
  pneu_term term[ALL];
  int gas, n, others;
  all_of_nothing(term);
  for (gas = 0; gas < PNEU_GAS_COUNT; gas++) {
    pneu_model m = fixture_r1_400(gas, PNEU_FLOW_PAPER);
    n = standard(&m, FIXTURE_TOL, base);
    add(&m, term, ALL);
    others = standard(&m, FIXTURE_TOL, nothing);
    n = others < n ? others : n; /* rounding decides whether the end is a sample */
    assert_true(n >= 600);
    check_note("%s", pneu_gas_key(gas));
    assert_between(fixture_apart(base, nothing, n), 0, TOL(1e-8, 1e-3));
  }
}

/* ---- effects, sampled into a table ---- */

static const double cubic = 2e8, leak_area = 5e-8, slope = 0.7;
static pneu_model leaky; /* whose leak `leak` samples */

static double hardening(double x)
{
  return cubic * x * x * x;
}

static double leak(double p)
{
  const pneu_params *q = &leaky.p;
  pneu_flow flow;
  pneu_orifice(&leaky, leaky.law.flow, (pneu_real)leak_area, (pneu_real)p + q->ambient_pressure, q->ambient_temperature,
               q->ambient_pressure, &flow);
  return -(double)flow.q;
}

static double friction_along(double x)
{
  return slope * 480 * x / 0.02;
}

/* Fill and vent in part, well away from equal pressures. */
static int part_strokes(const pneu_model *m, fixture_sample *out)
{
  const fixture_stretch stretch[] = {
      {2.5, fixture_input(m, 1)}, {3, fixture_input(m, -0.6)}, {2.005, fixture_input(m, 0.8)}};
  pneu_state s = fixture_rest(m, 1.2e5, 0.001, &stretch[0].input);
  memset(out, 0, SAMPLES * sizeof *out);
  return fixture_trace(m, &s, stretch, COUNT(stretch), 0.0125, FIXTURE_TOL, out, SAMPLES);
}

/* Largest difference between the response with an effect, which `p` has, and with the table of n knots instead. */
static double apart(const pneu_params *p, int n, int equation, int argument, double from, double to, curve *f)
{
  static fixture_sample effect[SAMPLES], table[SAMPLES];
  const pneu_model with_effect = fixture_model(p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  pneu_model m = fixture_r1_400(PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  pneu_term term;
  int samples;
  leaky = m;
  term = sampled(equation, argument, n, from, to, f);
  add(&m, &term, 1);
  samples = part_strokes(&with_effect, effect);
  assert_int_equal(part_strokes(&m, table), samples);
  assert_true(samples >= 600);
  return fixture_apart(effect, table, samples);
}

/* Twice the knots, a quarter of the error: down to 33, and to the tolerance of the stepper. */
static void assert_second_order(const pneu_params *p, int equation, int argument, double from, double to, curve *f)
{
  double before = apart(p, 9, equation, argument, from, to, f);
  int n;
  for (n = 17; n <= PNEU_TERM_KNOTS; n = 2 * n - 1) {
    const double now = apart(p, n, equation, argument, from, to, f);
    check_note("%d knots, %g off; half as many, %g", n, now, before);
#ifdef PNEU_SINGLE
    assert_between(now, 0, fmax(before / 2, 2e-5));
#else
    assert_between(fixture_order(before, now), 1.85, 2.15);
#endif
    before = now;
  }
}

TEST(test_pneu_run__hardening_spring_by_more_and_more_knots__converges_in_second_order)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  fixture_need("spring_hardening");
  fixture_set(&p, "spring_cubic", cubic);
  assert_second_order(&p, PNEU_TERM_FORCE, PNEU_TERM_OVER_POSITION, 0, 0.02, hardening);
}

TEST(test_pneu_run__leak_by_more_and_more_knots__converges_in_second_order)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  fixture_need("chamber_leak");
  fixture_set(&p, "leak_area", leak_area);
  assert_second_order(&p, PNEU_TERM_FLOW, PNEU_TERM_OVER_PRESSURE, 5e4, 3.9e5, leak);
}

/* A straight line needs two knots, and more make no difference. */
TEST(test_pneu_run__friction_that_grows_along_the_stroke__is_exact_by_any_number_of_knots)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  int n;
  fixture_need("friction_position");
  fixture_set(&p, "friction_slope", slope);
  for (n = 2; n <= PNEU_TERM_KNOTS; n += 31) {
    check_note("%d knots", n);
    assert_between(apart(&p, n, PNEU_TERM_FRICTION, PNEU_TERM_OVER_POSITION, 0, 0.02, friction_along), 0,
                   TOL(1e-9, 2e-5));
  }
}

/* ---- runs ---- */

static double bump(double x)
{
  const double s = (x - 0.012) / 2e-3;
  return 300 * exp(-s * s);
}

/* A relief that opens above 2 bar. */
static double relief(double p)
{
  return p > 2e5 ? -1e-4 * (p - 2e5) / 2e5 : 0;
}

/* Knots make steps: each changes a slope, and what is fast in the model answers. */
TEST(test_pneu_run__rough_tables__take_a_bounded_number_of_steps)
{
  const pneu_term term[] = {
      sampled(PNEU_TERM_FRICTION, PNEU_TERM_OVER_POSITION, PNEU_TERM_KNOTS, 0, 0.02, bump),
      sampled(PNEU_TERM_FORCE, PNEU_TERM_OVER_POSITION, PNEU_TERM_KNOTS, 0, 0.02, hardening),
      sampled(PNEU_TERM_FLOW, PNEU_TERM_OVER_PRESSURE, PNEU_TERM_KNOTS, 0, 4e5, relief),
      sampled(PNEU_TERM_SHOWN_PRESSURE, PNEU_TERM_OVER_PRESSURE, PNEU_TERM_KNOTS, 0, 4e5, zigzag),
  };
  const double most[] = {4, 4, 1.5, 1.5}; /* measured 2.5, 2.8, 1.0, 1.0 */
  int i, gas;
  for (i = 0; i < COUNT(term); i++)
    for (gas = 0; gas < PNEU_GAS_COUNT; gas++) {
      pneu_model m = fixture_r1_400(gas, PNEU_FLOW_CHOKED);
      const long base = fixture_steps(&m);
      add(&m, &term[i], 1);
      check_note("term %d, %s", i, pneu_gas_key(gas));
      assert_between(fixture_steps(&m), 0.5 * (double)base, most[i] * (double)base);
    }
}

/* Firmware's steps of 1 ms end where the run with error control does. */
TEST(test_pneu_step__terms__follow_the_run)
{
  const pneu_term term[2] = {sampled(PNEU_TERM_FRICTION, PNEU_TERM_OVER_POSITION, 17, 0, 0.02, bump),
                             sampled(PNEU_TERM_FLOW, PNEU_TERM_OVER_PRESSURE, 17, 0, 4e5, relief)};
  pneu_model m = fixture_r1_400(PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED);
  const pneu_input input = fixture_input(&m, 1);
  static pneu_workspace work;
  pneu_state a, b;
  int i;
  add(&m, term, 2);
  a = b = fixture_rest(&m, 0, 0, &input);
  fixture_run(&m, &a, &input, 2, FIXTURE_TOL, NULL);
  for (i = 0; i < 2000; i++)
    assert_int_equal(pneu_step(&m, &b, &input, (pneu_real)1e-3, &work), PNEU_OK);
  assert_between(a.x, 0.004, 0.018);
  assert_close(b.x, a.x, TOL(1e-6, 1e-4) * 0.02, 0);
  assert_close(b.p, a.p, TOL(1e-6, 1e-4) * 4e5, 0);
}

/* p A = k (x + x0) + F + dF(x), quasi-static: the stem breaks away where the table says, both ways. */
static void check_break_away(double x, double rate)
{
  const pneu_params p = fixture_params(FIXTURE_R1_400);
  const pneu_term term = sampled(PNEU_TERM_FRICTION, PNEU_TERM_OVER_POSITION, PNEU_TERM_KNOTS, 0, 0.02, bump);
  pneu_model m = fixture_pressed(&p);
  const double balance = 4e5 * (x + 0.01) / 0.04, way = rate > 0 ? 1 : -1;
  pneu_input input = fixture_input(&m, 0);
  fixture_events events;
  pneu_state s;
  add(&m, &term, 1);
  s = fixture_rest(&m, balance, x, &input);
  input.pressure_rate = (pneu_real)rate;
  fixture_run(&m, &s, &input, 4, FIXTURE_TOL, &events);
  check_note("x = %g, %g Pa/s", x, rate);
  assert_true(events.n > 0);
  assert_int_equal(events.after[0], way > 0 ? PNEU_MODE_UP : PNEU_MODE_DOWN);
  assert_close(events.p[0], balance + way * (480 + bump(x)) / 0.04, TOL(1, 100), 0);
}

TEST(test_pneu_run__friction_of_a_place__holds_there_against_both_directions)
{
  check_break_away(0.005, 1e4);
  check_break_away(0.005, -1e4);
  check_break_away(0.0125, 1e4); /* a knot */
  check_break_away(0.0125, -1e4);
}

/* The table is the line from 1e-5 to 3e-5 kg/s over the stroke, which is passed in 2 s. */
TEST(test_pneu_run__given_position__flow_of_a_place_fills_the_chamber)
{
  pneu_params p = fixture_vessel(1e-3);
  const pneu_term term = line(PNEU_TERM_FLOW, PNEU_TERM_OVER_POSITION, 1e-5);
  pneu_model m;
  pneu_input input;
  pneu_state s;
  p.stroke = (pneu_real)0.022;
  p.area = (pneu_real)1e-6; /* sweeps nothing to speak of */
  m = fixture_model_roles(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 0, 1);
  input = fixture_input(&m, 0);
  add(&m, &term, 1);
  s = fixture_rest(&m, 0, 0, &input);
  input.position_rate = (pneu_real)0.011;
  fixture_run(&m, &s, &input, 2, FIXTURE_TOL, NULL);
  assert_close(s.x, 0.022, 0, TOL(1e-9, 1e-5));
  assert_close((double)pneu_mass(&m, &s), 101325 * 1e-3 / (8.31446 / 0.02896 * 298.15) + 2 * 2e-5, 0, TOL(1e-9, 1e-4));
}

/* A flow that changes its sign with pressure settles where it is nothing, under every chamber law. */
TEST(test_pneu_run__flow_through_zero__settles_there)
{
  const pneu_params p = fixture_vessel(1e-3);
  const pneu_term term = {PNEU_TERM_FLOW, PNEU_TERM_OVER_PRESSURE, 2, 0, 200000, {(pneu_real)1e-4, (pneu_real)-1e-4}};
  static const double start[] = {0, 1.7e5};
  int gas, i;
  for (gas = 0; gas < PNEU_GAS_COUNT; gas++)
    for (i = 0; i < COUNT(start); i++) {
      fixture_rig rig = fixture_at(fixture_model(&p, gas, PNEU_FLOW_CHOKED), 0, start[i], 0);
      add(&rig.m, &term, 1);
      fixture_go(&rig, 600, TOL(1e-8, 1e-4), NULL);
      check_note("%s from %g Pa", pneu_gas_key(gas), start[i]);
      assert_close(rig.s.p, 1e5, 0, TOL(1e-5, 1e-2));
    }
}

/* W of heat into a shut vessel of the energy law: p' = (gamma - 1) W/V. */
TEST(test_pneu_run__constant_heat__raises_the_pressure)
{
  const pneu_params p = fixture_vessel(1e-3);
  const pneu_term term = {PNEU_TERM_HEAT, PNEU_TERM_OVER_OPENING, 2, 0, 1, {10, 500}};
  fixture_rig rig = fixture_at(fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED), 0, 0, 0);
  add(&rig.m, &term, 1);
  fixture_go(&rig, 3, FIXTURE_TOL, NULL);
  assert_close(rig.s.p, 0.4 * 10 * 3 / 1e-3, 0, TOL(1e-8, 1e-3));
}

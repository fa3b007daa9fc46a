/* Free terms over cycles: the series, the clock that it brings into the model, and what moves in time with it. Against
 * closed forms, and against another integration. */
#include "../fixture.h"

enum { MOST = PNEU_TERM_KNOTS / 2 * 2, FORCE = PNEU_TERM_FORCE, SHOWN = PNEU_TERM_SHOWN_PRESSURE };

static const double two_pi = 6.283185307179586;

/* n amplitudes, cosine and sine by turns. */
static pneu_term cycle(int equation, double period, int n, const double *value)
{
  pneu_term term;
  int i;
  memset(&term, 0, sizeof term);
  term.equation = equation;
  term.argument = PNEU_TERM_OVER_CYCLE;
  term.n = n;
  term.to = (pneu_real)period;
  for (i = 0; i < n; i++)
    term.value[i] = (pneu_real)value[i];
  return term;
}

static void add(pneu_model *m, const pneu_term *term, int n)
{
  assert_int_equal(pneu_model_terms(m, term, n), PNEU_OK);
}

static pneu_model plain_model(void)
{
  return fixture_r1_400(PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
}

/* ---- The series ---- */

/* What the pressure sensor shows too much at time t. */
static double shown_at(const pneu_model *m, double t)
{
  const pneu_input input = fixture_input(m, 0);
  pneu_state s = fixture_rest(m, 2e5, 0.01, &input);
  s.extra[m->clock] = (pneu_real)t;
  return fixture_look(m, &s, &input).shown_p - 2e5;
}

static double closed_form(const pneu_term *term, double t)
{
  double sum = 0;
  int i;
  for (i = 0; i < term->n; i++) {
    const double angle = two_pi * (i / 2 + 1) * t / (double)(term->to - term->from);
    sum += (double)term->value[i] * (i % 2 ? sin(angle) : cos(angle));
  }
  return sum;
}

TEST(test_pneu_add_terms__cosine_or_sine__is_the_closed_form)
{
  static const double t[] = {0, 0.125, 0.25, 0.5, 1, 3, 8.5, 1024.25, -0.25}; /* [s] with a period of 1 s */
  static const double want[][2] = {
      {1, 0}, {0.7071067811865476, 0.7071067811865476}, {0, 1}, {-1, 0}, {1, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  static const double amplitude[2][2] = {{1000, 0}, {0, 1000}};
  pneu_model m = plain_model();
  int i, k;
  for (k = 0; k < 2; k++) {
    const pneu_term term = cycle(SHOWN, 1, 2, amplitude[k]);
    add(&m, &term, 1);
    for (i = 0; i < COUNT(t); i++) {
      check_note("%s at %g s", k ? "sine" : "cosine", t[i]);
      assert_close(shown_at(&m, t[i]), 1000 * want[i][k], TOL(1e-8, 0.5), 0);
    }
  }
}

TEST(test_pneu_add_terms__harmonics__are_the_closed_form)
{
  static const int sizes[] = {2, 4, 6, MOST};
  uint64_t seed = 11;
  double value[MOST];
  int k, i;
  for (i = 0; i < MOST; i++)
    value[i] = fixture_random(&seed, -1000, 1000);
  for (k = 0; k < COUNT(sizes); k++) {
    pneu_term term = cycle(SHOWN, 1.7, sizes[k], value);
    pneu_model m = plain_model();
    term.from += (pneu_real)0.75; /* the beginning does not count */
    term.to += (pneu_real)0.75;
    add(&m, &term, 1);
    for (i = 0; i < 50; i++) {
      const double t = fixture_random(&seed, 0, TOL(100, 5));
      check_note("%d amplitudes at %g s", sizes[k], t);
      assert_close(shown_at(&m, (double)(pneu_real)t), closed_form(&term, (double)(pneu_real)t), TOL(1e-7, 5), 0);
    }
  }
}

/* With states of effects, and a temperature, before the clock in the packed vector. */
TEST(test_pneu_add_terms__clock_behind_other_states__is_read_as_time)
{
  static const double amplitude[] = {1000, -500}, t[] = {0, 0.3, 1.7};
  const pneu_term term = cycle(SHOWN, 1, 2, amplitude);
  pneu_params p = fixture_params(FIXTURE_R1_400);
  pneu_model m;
  pneu_input input;
  pneu_state s;
  int i;
  fixture_need("transducer_lag");
  fixture_need("position_lag");
  fixture_set(&p, "transducer_time", 0.02);
  fixture_set(&p, "position_time", 0.02);
  m = fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER);
  add(&m, &term, 1);
  input = fixture_input(&m, 1);
  assert_int_equal(m.clock, 2);
  s = fixture_rest(&m, 1e5, 0, &input);
  fixture_run(&m, &s, &input, 0.25, TOL(1e-6, 1e-4), NULL);
  assert_close(s.extra[2], 0.25, TOL(1e-12, 1e-6), 0);
  assert_between(s.p, 1.01e5, 4e5);
  for (i = 0; i < COUNT(t); i++)
    assert_close(shown_at(&m, t[i]), closed_form(&term, t[i]), TOL(1e-8, 0.5), 0);
}

TEST(test_pneu_model_terms__odd_number_over_a_cycle__is_refused)
{
  static const double value[MOST] = {1, 2, 3};
  pneu_term term = cycle(FORCE, 1, 2, value);
  const pneu_term before = term;
  pneu_model m = plain_model();
  int n;
  add(&m, &before, 1);
  for (n = 2; n <= PNEU_TERM_KNOTS; n++) {
    term.n = n;
    assert_int_equal(pneu_model_terms(&m, &term, 1), n % 2 ? PNEU_E_PARAM : PNEU_OK);
    if (n % 2) { /* the model keeps what it has */
      assert_ptr_equal(m.term, &term);
      assert_close(m.term_step, 2.0 / (n - 1) / 8, 0, TOL(1e-14, 1e-6));
    }
  }
  term.argument = PNEU_TERM_OVER_POSITION;
  term.n = 3;
  add(&m, &term, 1);
}

/* ---- The clock ---- */

static void switch_on(pneu_params *p, int with_states)
{
  int i;
  for (i = 0; i < PNEU_PARAM_COUNT; i++) {
    pneu_param_info info;
    pneu_param_describe(i, &info);
    if (with_states && i >= PNEU_PARAM_BASE_COUNT)
      *pneu_param_at(p, i) = info.value;
  }
}

/* Effects keep their places, and the clock comes after them; it goes again with the last term over a cycle. */
TEST(test_pneu_model_terms__cycle__brings_a_clock_and_takes_it_away)
{
  static const double value[] = {1, 2};
  const pneu_term over_position = {FORCE, PNEU_TERM_OVER_POSITION, 2, 0, 1, {1, 2}};
  const pneu_term term[] = {over_position, cycle(FORCE, 1, 2, value), cycle(SHOWN, 3, 2, value)};
  int gas, all;
  for (gas = 0; gas < PNEU_GAS_COUNT; gas++)
    for (all = 0; all < 2; all++) {
      pneu_params p = fixture_params(FIXTURE_R1_400);
      pneu_model m, before;
      int again;
      switch_on(&p, all);
      before = m = fixture_model(&p, gas, PNEU_FLOW_PAPER);
      check_note("%s, %d states", pneu_gas_key(gas), before.n_extra);
      assert_int_equal(m.clock, -1);
      assert_true(m.n_extra <= PNEU_EFFECT_STATE_COUNT);
      add(&m, term, 1);
      assert_int_equal(m.clock, -1);
      for (again = 0; again < 2; again++) {
        add(&m, term, 3);
        assert_int_equal(m.clock, before.n_extra);
        assert_int_equal(m.n_extra, before.n_extra + 1);
        assert_int_equal(m.n_gas, before.n_gas + 1);
        assert_true(m.n_extra <= PNEU_EXTRA_MAX && pneu_dimension(&m, PNEU_MODE_UP) <= PNEU_STATE_MAX);
        assert_memory_equal(m.state_of, before.state_of, sizeof m.state_of);
      }
      assert_int_not_equal(pneu_model_terms(&m, term, -1), PNEU_OK);
      assert_int_equal(m.clock, before.n_extra);
      add(&m, NULL, 0);
      m.term = before.term;
      assert_memory_equal(&m, &before, sizeof m);
    }
}

/* All states there can be fill the room to the last place. */
TEST(test_pneu_model_terms__every_state_at_once__fills_the_room)
{
  static const double value[] = {1, 2};
  const pneu_term term = cycle(FORCE, 1, 2, value);
  pneu_params p = fixture_params(FIXTURE_R1_400);
  pneu_model m;
  switch_on(&p, 1);
  m = fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER);
  if (m.n_extra < PNEU_EFFECT_STATE_COUNT)
    skip(); /* two effects that stand in for each other */
  add(&m, &term, 1);
  assert_int_equal(m.n_extra, PNEU_EXTRA_MAX);
  assert_int_equal(pneu_dimension(&m, PNEU_MODE_UP), PNEU_STATE_MAX);
}

/* An eighth of the shortest harmonic of all terms. */
TEST(test_pneu_model_terms__several_cycles__bound_the_step_by_the_shortest)
{
  static const double value[] = {1, 2, 3, 4, 5, 6};
  pneu_term term[] = {cycle(FORCE, 3, 6, value), cycle(SHOWN, 2, 2, value), cycle(SHOWN, 1.5, 2, value)};
  pneu_model m = plain_model();
  assert_close(m.term_step, 0, 0, 0);
  add(&m, term, 3);
  assert_close(m.term_step, 1.0 / 8, 0, TOL(1e-14, 1e-6));
  add(&m, term + 1, 2);
  assert_close(m.term_step, 1.5 / 8, 0, TOL(1e-14, 1e-6));
  term[2].from = (pneu_real)0.5;
  add(&m, term + 1, 2);
  assert_close(m.term_step, 1.0 / 8, 0, TOL(1e-14, 1e-6)); /* the distance of its ends is the period */
  add(&m, NULL, 0);
  assert_close(m.term_step, 0, 0, 0);
}

/* Over strokes with events, from any time on, by runs and by single steps: its slope is 1 in every stage. */
TEST(test_pneu_run__clock__counts_time)
{
  static const double value[] = {0, 50}, begin[] = {0, 7.25, -3};
  const pneu_term term = cycle(FORCE, 0.5, 2, value);
  static pneu_workspace work;
  int i, k;
  for (k = 0; k < COUNT(begin); k++) {
    pneu_model m = plain_model();
    fixture_stretch stretch[3];
    double t = begin[k];
    pneu_state s;
    add(&m, &term, 1);
    fixture_standard(&m, stretch);
    s = fixture_rest(&m, 0, 0, &stretch[0].input);
    assert_close(s.extra[m.clock], 0, 0, 0);
    s.extra[m.clock] = (pneu_real)t;
    for (i = 0; i < 3; i++) {
      fixture_run(&m, &s, &stretch[i].input, stretch[i].duration, TOL(1e-6, 1e-4), NULL);
      t += stretch[i].duration;
      check_note("stretch %d from %g s", i, begin[k]);
      assert_close(s.extra[m.clock], t, TOL(1e-11, 1e-3), 0);
    }
    for (i = 0; i < 100; i++)
      assert_int_equal(pneu_step(&m, &s, &stretch[1].input, (pneu_real)0.01, &work), PNEU_OK);
    assert_close(s.extra[m.clock], t + 1, TOL(1e-11, 1e-3), 0);
  }
}

/* ---- What moves in time ---- */

static double first_event;

static int stop_at_event(void *context, pneu_real t, const pneu_state *state, int mode_before)
{
  (void)context, (void)state, (void)mode_before;
  first_event = (double)t;
  return 1;
}

/* Instant, after the start, and mode in which a balanced stem breaks away within so many periods of a force.
 * Returns: 0 if it never does. */
static double break_away(double amplitude, double period, double begin, double periods, int *mode)
{
  const double value[] = {0, amplitude};
  const pneu_term term = cycle(FORCE, period, 2, value);
  const pneu_params p = fixture_params(FIXTURE_R1_400);
  const pneu_observer observer = {NULL, stop_at_event, NULL};
  pneu_model m = fixture_pressed(&p);
  const pneu_input input = fixture_input(&m, 0);
  static pneu_workspace work;
  const pneu_options options = fixture_options(TOL(1e-6, 1e-4));
  pneu_state s;
  int status;
  add(&m, &term, 1);
  s = fixture_rest(&m, 4e5 * 0.02 / 0.04, 0.01, &input);
  assert_int_equal(s.mode, PNEU_MODE_STUCK);
  s.extra[m.clock] = (pneu_real)begin;
  first_event = 0;
  status = pneu_run(&m, &s, &input, (pneu_real)(periods * period), &options, &observer, &work);
  assert_int_equal(status, first_event > 0 ? PNEU_E_STOPPED : PNEU_OK);
  *mode = s.mode;
  return first_event;
}

/* F sin(2 pi t/T) = 480 N, in the first cycle of one run over as many as may be: nothing else there asks for short
 * steps. The force acts against the air. */
TEST(test_pneu_run__periodic_force_on_a_stuck_stem__breaks_it_away_in_time)
{
  static const double amplitude[] = {505, 600, -600, 5000}, period[] = {0.02, 2, 300}, periods[] = {1, 1000};
  int i, k, j, mode;
  for (i = 0; i < COUNT(amplitude); i++)
    for (k = 0; k < COUNT(period); k++)
      for (j = 0; j < COUNT(periods); j++) {
        const double want = period[k] / two_pi * asin(480 / fabs(amplitude[i]));
        check_note("%g N every %g s, %g periods", amplitude[i], period[k], periods[j]);
        assert_close(break_away(amplitude[i], period[k], 0, periods[j], &mode), want, TOL(1e-8, 1e-5), TOL(1e-8, 3e-3));
        assert_int_equal(mode, amplitude[i] > 0 ? PNEU_MODE_DOWN : PNEU_MODE_UP);
      }
}

/* Wherever in between the run begins: at the next instant, which is of the other sign. In single precision a push is
 * resolved from 3 N on, which this force has gained after 7 ms. */
TEST(test_pneu_run__periodic_force_from_another_phase__breaks_away_in_time)
{
  const double period = 2, angle = asin(480.0 / 505), half = two_pi / 2;
  int i, mode;
  for (i = 0; i < 40; i++) {
    const double phase = half - angle + 2 * angle * (i + 0.5) / 40, begin = phase * period / two_pi;
    const double to_next = half + angle - phase;
    check_note("from %g rad on", phase);
    assert_close(break_away(505, period, begin, 3, &mode), to_next * period / two_pi, TOL(1e-8, 7e-3), 0);
    assert_int_equal(mode, PNEU_MODE_UP);
  }
}

TEST(test_pneu_run__periodic_force_below_friction__holds)
{
  int mode;
  assert_close(break_away(479, 0.5, 0, 500, &mode), 0, 0, 0);
  assert_int_equal(mode, PNEU_MODE_STUCK);
}

/* Slope of the pressure [Pa] abs of an isothermal vessel that fills by [B, Eq. 8] from a supply that swings. */
static double filling_slope(const pneu_params *p, const pneu_term *supply, double t, double pressure)
{
  const double R = (double)p->gas_constant, T = (double)p->ambient_temperature;
  const double above = (double)(p->supply_pressure + p->ambient_pressure) + (supply ? closed_form(supply, t) : 0);
  const double q = (double)p->fill_area * sqrt(2 * above / (R * T) * (above - pressure));
  return R * T * q / (double)p->dead_volume;
}

/* Gauge pressure after so long, by the classical method of Runge and Kutta. */
static double filled(const pneu_params *p, const pneu_term *supply, double duration)
{
  enum { STEPS = 4000 };
  const double h = duration / STEPS;
  double y = (double)p->ambient_pressure;
  int i;
  for (i = 0; i < STEPS; i++) {
    const double t = i * h, a = filling_slope(p, supply, t, y), b = filling_slope(p, supply, t + h / 2, y + h / 2 * a),
                 c = filling_slope(p, supply, t + h / 2, y + h / 2 * b), d = filling_slope(p, supply, t + h, y + h * c);
    y += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return y - (double)p->ambient_pressure;
}

TEST(test_pneu_run__periodic_supply__fills_a_vessel_as_another_integration_says)
{
  static const double value[] = {3e4, -5e4, 2e4, 1e4}, period[] = {0.3, 4, 30};
  const double duration = 5;
  const pneu_params p = fixture_vessel(3e-3);
  int i;
  for (i = 0; i < COUNT(period); i++) {
    const pneu_term term = cycle(PNEU_TERM_SUPPLY, period[i], 4, value);
    pneu_model m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
    const pneu_input input = fixture_input(&m, 1);
    const double want = filled(&p, &term, duration), steady = filled(&p, NULL, duration);
    pneu_state s;
    add(&m, &term, 1);
    s = fixture_rest(&m, 0, 0, &input);
    fixture_run(&m, &s, &input, duration, FIXTURE_TOL, NULL);
    check_note("every %g s", period[i]);
    assert_true(fabs(want - steady) > 100);
    assert_close(s.p, want, TOL(1e-3, 10), 0);
    assert_close(fixture_look(&m, &s, &input).supply, 4e5 + closed_form(&term, duration), TOL(1e-5, 2), 0);
  }
}

/* However large a swing: the supply keeps a thousandth of ambient pressure. */
TEST(test_pneu_add_terms__supply_below_vacuum__stays_above_it)
{
  static const double value[] = {-1e7, 0};
  const pneu_term term = cycle(PNEU_TERM_SUPPLY, 1, 2, value);
  fixture_rig rig = fixture_at(plain_model(), 1, 2e5, 0.01);
  add(&rig.m, &term, 1);
  rig.s.extra[rig.m.clock] = 0;
  assert_close(fixture_see(&rig).supply, -0.999 * 101325, TOL(1e-6, 1), 0);
}

/* Where something without a name acts: logs that the model itself has made, with a free term in it and noise on top. */
#include "../../fixture.h"
#include "../../virtual.h"

#include "../../../apps/lab/trace/freeterms.h"

enum { ROWS = 1201 };
static const double spacing = 0.05, two_pi = 6.283185307179586; /* [s] */
static const double sigma_p = 300, sigma_x = 2e-5;

static lab_rig rig;
static lab_unknowns u;
static lab_run run;
static lab_log run_log;
static lab_term_score slot[LAB_TERM_SCORES_MAX];
static double t[ROWS], command[ROWS], p[ROWS], x[ROWS];

/* The R1-400 with 40 cm3 of dead volume. */
static void declare(void)
{
  virtual_declare(&rig);
  rig.noise[LAB_CHANNEL_P] = sigma_p;
  rig.noise[LAB_CHANNEL_X] = sigma_x;
  rig.fit[rig.n_fit++] = PNEU_PARAM_dry_friction;
  rig.fit[rig.n_fit++] = PNEU_PARAM_spring_rate;
  rig.fit[rig.n_fit++] = LAB_PARAM_ORIFICE_AREA;
}

/* Twice up and down, slowly, in a minute. */
static void open_log(void)
{
  int i;
  lab_run_close(&run);
  run_log = virtual_log(ROWS, t, command, p, x);
  for (i = 0; i < ROWS; i++) {
    t[i] = spacing * i;
    command[i] = t[i] < 1 ? 0 : fmod(t[i] - 1, 29.5) < 14.75 ? 0.25 : -0.25;
    p[i] = x[i] = 0;
  }
  succeed(lab_run_open(&rig, &run_log, 0, &run, &error));
  succeed(lab_unknowns_open(&rig, &run, 1, &u, &error));
}

/* The log of a rig with a free term; without one where there is none. */
static void measure(const pneu_term *term, uint64_t seed)
{
  lab_rig truth = rig;
  double y[2 * ROWS];
  int i;
  if (term) {
    truth.n_terms = 1;
    truth.term[0] = *term;
  }
  succeed(lab_run_predict(&run, &(lab_episode){0, &truth}, 1, NULL, 1e-8, y, &error));
  for (i = 0; i < ROWS; i++) {
    p[i] = y[i] + sigma_p * fixture_normal(&seed);
    x[i] = y[ROWS + i] + sigma_x * fixture_normal(&seed);
  }
}

/* Fit what is declared to the log of a term, and try the slots.  Returns: their number. */
static int slots_of(const pneu_term *term, uint64_t seed)
{
  lab_projection scan;
  double chi2;
  int n;
  declare();
  open_log();
  measure(term, seed);
  succeed(lab_unknowns_fit(&u, LAB_ROUNDS_ALL, &chi2, &error));
  succeed(lab_projection_open(&u, &scan, &error));
  succeed(lab_score_free_terms(&scan, slot, &n, &error));
  lab_projection_close(&scan);
  return n;
}

static double surplus(int i)
{
  return slot[i].statistic - slot[i].degrees;
}

/* A term over a cycle comes first, with its period within a line of the spectrum, its size within a fifth and its phase
 * in the middle of the log within 0.4 rad. */
static void check_cycle(int equation, double period, double cosine, double sine)
{
  const pneu_term term = fixture_cycle(equation, period, cosine, sine);
  const double middle = two_pi * t[ROWS / 2], length = spacing * ROWS;
  const int n = slots_of(&term, 3);
  const pneu_term *found = &slot[0].term;
  double angle, want;
  check_note("equation %d", equation);
  assert_true(n > 1);
  assert_int_equal(found->equation, equation);
  assert_int_equal(found->argument, PNEU_TERM_OVER_CYCLE);
  assert_int_equal(found->n, 2);
  assert_int_equal(slot[0].degrees, 3);
  assert_close(1 / (double)(found->to - found->from), 1 / period, 0.25 / length, 0);
  assert_close(hypot((double)found->value[0], (double)found->value[1]), hypot(cosine, sine), 0, 0.2);
  angle = middle / (double)found->to - atan2((double)found->value[1], (double)found->value[0]);
  want = middle / period - atan2(sine, cosine);
  assert_close(remainder(angle - want, two_pi), 0, 0.4, 0);
  assert_true(surplus(0) > 1.5 * surplus(1) || slot[1].term.argument == PNEU_TERM_OVER_CYCLE);
}

TEST(test_lab_score_free_terms__periodic_force__ranks_force_over_cycles_first)
{
  check_cycle(PNEU_TERM_FORCE, 1.87, 50, -60);
  check_cycle(PNEU_TERM_FORCE, 4.3, -40, 30);
}

TEST(test_lab_score_free_terms__periodic_supply__ranks_supply_over_cycles_first)
{
  check_cycle(PNEU_TERM_SUPPLY, 2.3, 2e4, 1.5e4);
  check_cycle(PNEU_TERM_SUPPLY, 5.1, -1e4, 3e4);
}

/* A bump where the stem passes four times. */
TEST(test_lab_score_free_terms__friction_bump__ranks_friction_over_position_first)
{
  pneu_term bump = {PNEU_TERM_FRICTION, PNEU_TERM_OVER_POSITION, 11, 0, (pneu_real)0.02, {0}};
  int i, n;
  bump.value[6] = 120;
  bump.value[7] = 60;
  n = slots_of(&bump, 4);
  assert_true(n > 1);
  assert_int_equal(slot[0].term.equation, PNEU_TERM_FRICTION);
  assert_int_equal(slot[0].term.argument, PNEU_TERM_OVER_POSITION);
  assert_true(surplus(0) > 100);
  for (i = 1; i < n; i++)
    assert_true(surplus(i) <= surplus(i - 1));
  for (i = 0; i < slot[0].term.n; i++)
    assert_close(slot[0].term.value[i], 0, 0, 0);
}

/* T is chi-square with its degrees of freedom where nothing is missing: within five standard deviations. That of a
 * cycle is the largest over all periods, 500 of them: below 2 ln(500) + 2 ln(100). */
TEST(test_lab_score_free_terms__nothing_missing__is_chance)
{
  int seed, i;
  for (seed = 5; seed < 9; seed++) {
    const int n = slots_of(NULL, (uint64_t)seed);
    assert_true(n > 10);
    for (i = 0; i < n; i++) {
      check_note("equation %d over %d, %d degrees", slot[i].term.equation, slot[i].term.argument, slot[i].degrees);
      if (slot[i].term.argument == PNEU_TERM_OVER_CYCLE)
        assert_between(slot[i].statistic, 0, 2 * log(500) + 2 * log(100));
      else
        assert_close(slot[i].statistic, slot[i].degrees, 5 * sqrt(2.0 * slot[i].degrees), 0);
    }
  }
}

TEST(test_lab_score_free_terms__model_full_of_terms__has_no_slots)
{
  lab_projection scan;
  int i, n;
  declare();
  open_log();
  measure(NULL, 1);
  for (i = 0; i < LAB_TERM_MAX; i++)
    u.rig.term[i] = fixture_cycle(PNEU_TERM_FORCE, 1, 0, 0);
  u.rig.n_terms = LAB_TERM_MAX;
  succeed(lab_projection_open(&u, &scan, &error));
  succeed(lab_score_free_terms(&scan, slot, &n, &error));
  assert_int_equal(n, 0);
  lab_projection_close(&scan);
}

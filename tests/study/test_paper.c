#include "../../apps/study/paper.h"
#include "../words.h"

#define TIGHT 1e-12 /* closed forms: a few roundings */

/* constants of Table A1, typed again from the paper */
static const double R_air = 8.31446 / 0.02896;

/* R1-400 with 6 springs, no dry friction, no dead volume */
static paper_case ideal_case(paper_flow flow, double storage)
{
  paper_case c = {{"ideal", 0.04, 0.0, 0.02, 320e3, 0.01, 400e3, 80e3, 240e3, 0.893e-6, 0.0}, NULL, 100e3, 0.0};
  c.flow = flow;
  c.storage = storage;
  return c;
}

/* ---- Flow laws ---- */

TEST(test_paper_flow_unchoked__whole_numbers__exact)
{
  assert_close(paper_flow_unchoked(500.0, 320.0), 300.0, 0, TIGHT);
  assert_close(paper_flow_unchoked(500.0, 500.0), 0.0, 0, 0);
  assert_true(isnan(paper_flow_unchoked(1.0, 2.0)));
}

/* with gamma = 7/5 the choked flow is sqrt(0.7)/1.2^3 P_up and sets in at 1.2^-3.5 */
TEST(test_paper_flow_choked__below_critical__constant)
{
  double c = sqrt(0.7) / (1.2 * 1.2 * 1.2);
  assert_close(paper_choking_ratio(), pow(1.2, -3.5), 0, TIGHT);
  assert_close(paper_flow_choked(500.0, 0.0), 500.0 * c, 0, TIGHT);
  assert_close(paper_flow_choked(500.0, 264.0), 500.0 * c, 0, TIGHT);
  assert_close(paper_flow_choked(500.0, 500.0 * pow(1.2, -3.5)), 500.0 * c, 0, TIGHT);
}

/* 3.5 (r^(10/7) - r^(12/7)) at r = 0.9^3.5 is 3.5 0.9^5 (1 - 0.9) */
TEST(test_paper_flow_choked__above_critical__isentropic)
{
  double r = pow(0.9, 3.5);
  assert_close(paper_flow_choked(1.0, r), sqrt(3.5 * pow(0.9, 5) * 0.1), 0, TIGHT);
}

TEST(test_paper_flow_choked__small_drop__meets_unchoked)
{
  double P = 1e5, drop = 1.0;
  assert_close(paper_flow_choked(P, P - drop), paper_flow_unchoked(P, P - drop), 0, 1e-5);
}

/* ---- Velocities at constant pressure ---- */

TEST(test_paper_fill_speed__ratio_five__root_of_twenty)
{
  assert_close(paper_fill_speed(paper_flow_unchoked, 5.0, 1.0), sqrt(20.0), 0, TIGHT);
  assert_close(paper_fill_speed(paper_flow_unchoked, 500e3, 500e3), 0.0, 0, 0);
}

TEST(test_paper_vent_speed__ends__zero_and_half)
{
  assert_close(paper_vent_speed(paper_flow_unchoked, 101325.0, 101325.0), 0.0, 0, 0);
  assert_close(paper_vent_speed(paper_flow_unchoked, 2.0, 1.0), sqrt(0.5), 0, TIGHT);
  assert_close(paper_vent_speed(paper_flow_choked, 3.0, 1.0), paper_vent_speed(paper_flow_choked, 9.0, 1.0), 0, TIGHT);
}

/* Eq. (23) in whole numbers: p_bl (p_bh + 100)/(p_bh (p_bl + 100)) is 1/3, 17/27 and 108/133 */
TEST(test_paper_speed_change__table_1__fractions)
{
  assert_close(paper_speed_change(paper_flow_unchoked, 20, 100, 100), 1.0 - sqrt(1.0 / 3.0), 0, TIGHT);
  assert_close(paper_speed_change(paper_flow_unchoked, 80, 240, 100), 1.0 - sqrt(17.0 / 27.0), 0, TIGHT);
  assert_close(paper_speed_change(paper_flow_unchoked, 180, 380, 100), 1.0 - sqrt(108.0 / 133.0), 0, TIGHT);
}

TEST(test_paper_speed_change__choked_throughout__none)
{
  assert_close(paper_speed_change(paper_flow_choked, 180, 380, 100), 0.0, TIGHT, 0);
}

/* ---- Where the edges are equally fast ---- */

/* p_a/p_s = 5/7 makes the discriminant (25/7)^2 */
TEST(test_paper_critical_pressure__special_ratios__exact)
{
  assert_close(paper_critical_pressure(5.0 / 7.0), 4.0 / 7.0, 0, TIGHT);
  assert_close(paper_critical_pressure(0.0), 0.5 * (sqrt(5.0) - 1.0), 0, TIGHT);
  assert_close(paper_critical_pressure(-1.0), 1.0, 0, TIGHT);
  assert_close(paper_critical_pressure(0.25), 0.25 * (sqrt(29.0) - 3.0), 0, TIGHT);
}

/* (31) with the sign of equality */
TEST(test_paper_critical_pressure__any_ratio__solves_eq31)
{
  double a;
  for (a = -0.9; a < 5.0; a += 0.1) {
    double q = paper_critical_pressure(a);
    assert_close((1.0 + a) * (1.0 - q), q * (q + a), 1e-12, 0);
  }
}

TEST(test_paper_crossing__unchoked__is_eq35)
{
  double a;
  for (a = 0.0; a < 2.0; a += 0.25)
    assert_close(paper_crossing(paper_flow_unchoked, a), paper_critical_pressure(a), 0, TIGHT);
}

/* venting choked, filling not: with y = r^(-2/7), y^2 - y = 0.2/1.2^6, and p/p_s = r - (1 - r) p_a/p_s */
TEST(test_paper_crossing__choked__closed_form)
{
  double y = 0.5 * (1.0 + sqrt(1.0 + 0.8 / pow(1.2, 6))), r = pow(y, -3.5);
  assert_close(paper_crossing(paper_flow_choked, 0.0), r, 0, TIGHT);
  assert_close(paper_crossing(paper_flow_choked, 0.25), r - 0.25 * (1.0 - r), 0, TIGHT);
}

TEST(test_paper_supply_threshold__eq30__roots)
{
  assert_close(paper_supply_threshold(2.0), 1.0, 0, TIGHT);
  assert_close(paper_supply_threshold(0.5), 0.5 * (sqrt(3.0) - 1.0), 0, TIGHT);
}

/* ---- Scale and energy ---- */

TEST(test_paper_speed_scale__equal_areas__root_of_2RT)
{
  assert_close(paper_speed_scale(1.0, 1.0, 298.15), sqrt(2.0 * R_air * 298.15), 0, TIGHT);
  assert_close(paper_speed_scale(3.0, 2.0, 4.0 * 298.15), 3.0 * sqrt(2.0 * R_air * 298.15), 0, TIGHT);
}

/* mean of p over p_s along the travel, summed here over a thousand slices */
TEST(test_paper_returned_share__bench_sets__mean_pressure)
{
  double sum = 0.0;
  int i;
  for (i = 0; i < 1000; i++)
    sum += (80.0 + 160.0 * (i + 0.5) / 1000.0) / 400.0 / 1000.0;
  assert_close(paper_returned_share(80e3, 240e3, 400e3), sum, 0, 1e-10);
  assert_close(paper_returned_share(0.0, 140e3, 140e3), 0.5, 0, TIGHT);
}

TEST(test_paper_exergy_efficiency__pressure_ratio_e__closed_form)
{
  double e = exp(1.0);
  assert_close(paper_exergy_efficiency((e - 1.0) * 1e5, 1e5), (e - 1.0) / e, 0, TIGHT);
}

/* ---- Spring-loaded stem ---- */

TEST(test_paper_actuator_with_bench__table_a1__implied_springs)
{
  paper_actuator r1 = paper_actuators[PAPER_R1_400], m37 = paper_actuators[PAPER_37_13];
  r1 = paper_actuator_with_bench(&r1, 80e3, 240e3);
  m37 = paper_actuator_with_bench(&m37, 20e3, 100e3);
  assert_close(r1.rate, 320e3, 0, TIGHT);
  assert_close(r1.preload, 10e-3, 0, TIGHT);
  assert_close(m37.rate, 0.0677 * 80e3 / 0.0381, 0, TIGHT);
  assert_close(m37.preload, 9.525e-3, 0, TIGHT);
}

TEST(test_paper_actuators__table_a1__as_printed)
{
  paper_actuator r1 = paper_actuators[PAPER_R1_400], m37 = paper_actuators[PAPER_37_13];
  assert_string_equal(r1.key, "r1-400");
  assert_string_equal(m37.key, "37-13");
  assert_close(r1.area * r1.travel, 0.8e-3, 0, TIGHT);
  assert_close(r1.rate * r1.preload, 4000.0, 0, TIGHT);
  assert_close(r1.dead_volume / r1.orifice, 2.0 / 0.893, 0, TIGHT);
  assert_close(r1.supply - r1.bench_high - r1.bench_low, 80e3, 0, TIGHT);
  assert_close(m37.area * m37.travel, 2.57937e-3, 0, TIGHT);
  assert_close(m37.rate * m37.preload, 914.4, 0, TIGHT);
  assert_close(m37.dead_volume / m37.orifice, 4.0 / 2.177, 0, TIGHT);
  assert_close(m37.supply - m37.bench_high - m37.bench_low, 20e3, 0, TIGHT);
  assert_close(r1.friction + m37.friction, 960.0, 0, TIGHT);
}

TEST(test_paper_pressure__both_directions__friction_changes_sign)
{
  paper_case c = ideal_case(paper_flow_unchoked, 1.0);
  c.actuator.friction = 480.0;
  assert_close(paper_pressure(&c, PAPER_UP, 0.0), 92e3, 0, TIGHT);
  assert_close(paper_pressure(&c, PAPER_DOWN, 0.0), 68e3, 0, TIGHT);
  assert_close(paper_pressure(&c, PAPER_UP, 0.02), 252e3, 0, TIGHT);
}

/* top of 80..240 kPa at p_a = 100 kPa: 340 kPa, storage 160 kPa */
TEST(test_paper_speed__top_of_bench_set__hand_values)
{
  paper_case without = ideal_case(paper_flow_unchoked, 0.0), with = ideal_case(paper_flow_unchoked, 1.0);
  assert_close(paper_speed(&without, PAPER_UP, 0.02), sqrt(500.0 * 160.0) / 340.0, 0, TIGHT);
  assert_close(paper_speed(&without, PAPER_DOWN, 0.02), sqrt(340.0 * 240.0) / 340.0, 0, TIGHT);
  assert_close(paper_speed(&with, PAPER_UP, 0.02), sqrt(500.0 * 160.0) / 500.0, 0, TIGHT);
  assert_close(paper_speed(&with, PAPER_DOWN, 0.02), sqrt(340.0 * 240.0) / 500.0, 0, TIGHT);
  assert_close(paper_speed(&with, PAPER_DOWN, 0.0), 2.0 / 3.0, 0, TIGHT); /* nothing stored in no volume */
}

/* V_0 of a tenth of the swept volume stores like 2 mm of travel: 16 kPa at x = 0 */
TEST(test_paper_speed__dead_volume__slows)
{
  paper_case c = ideal_case(paper_flow_unchoked, 1.0);
  c.actuator.dead_volume = 0.08e-3;
  assert_close(paper_speed(&c, PAPER_DOWN, 0.0), sqrt(180.0 * 80.0) / 196.0, 0, TIGHT);
}

/* without dead volume the falling stem gains speed where p_bl (2 p + p_a) > p_a^2: PAPER.md 3.3 */
TEST(test_paper_speed__falling__gains_speed_by_criterion)
{
  const double p_bl[] = {10e3, 20e3, 30e3, 40e3, 60e3, 80e3, 180e3};
  paper_case c = ideal_case(paper_flow_unchoked, 1.0);
  size_t i;
  int j;
  for (i = 0; i < sizeof p_bl / sizeof p_bl[0]; i++) {
    c.actuator = paper_actuator_with_bench(&c.actuator, p_bl[i], p_bl[i] + 150e3);
    for (j = 1; j < 20; j++) {
      double x = j * 1e-3, p = paper_pressure(&c, PAPER_DOWN, x);
      double gain = paper_speed(&c, PAPER_DOWN, x - 1e-6) - paper_speed(&c, PAPER_DOWN, x + 1e-6);
      assert_int_equal(gain > 0.0, p_bl[i] * (2.0 * p + c.P_a) > c.P_a * c.P_a);
    }
  }
}

/* choked and without storage the falling velocity is the constant sqrt(0.7)/1.2^3 of the scale */
TEST(test_paper_stroke_time__choked_vent__constant_velocity)
{
  paper_case c = ideal_case(paper_flow_choked, 0.0);
  double scale = 0.893e-6 / 0.04 * sqrt(2.0 * R_air * 298.15);
  c.actuator = paper_actuator_with_bench(&c.actuator, 100e3, 300e3);
  assert_close(paper_stroke_time(&c, PAPER_DOWN), 0.9 * 0.02 * 1.728 / (sqrt(0.7) * scale), 0, 1e-10);
}

/* ---- Second implementation of the quasi-equilibrium: the gas mass is integrated, not the travel ---- */

/* mass of gas when the sliding stem stands at x */
static double mass_at(const paper_case *c, int direction, double x)
{
  const paper_actuator *a = &c->actuator;
  double p = (a->rate * (x + a->preload) + direction * a->friction) / a->area;
  return (p + c->P_a) * (a->dead_volume + a->area * x) / (R_air * 298.15);
}

/* its inverse, by bisection */
static double stem_at(const paper_case *c, int direction, double mass)
{
  double lo = 0.0, hi = c->actuator.travel;
  int i;
  for (i = 0; i < 50; i++) {
    double x = 0.5 * (lo + hi);
    *(mass_at(c, direction, x) < mass ? &lo : &hi) = x;
  }
  return 0.5 * (lo + hi);
}

/* |dm/dt| of [B, Eq. 9] */
static double mass_rate(const paper_case *c, int direction, double mass)
{
  const paper_actuator *a = &c->actuator;
  double x = stem_at(c, direction, mass);
  double P = mass * R_air * 298.15 / (a->dead_volume + a->area * x);
  double w = direction > 0 ? c->flow(a->supply + c->P_a, P) : c->flow(P, c->P_a);
  return a->orifice * sqrt(2.0 / (R_air * 298.15)) * w;
}

/* time = integral of dm/(dm/dt), midpoint rule */
static double time_by_mass(const paper_case *c, int direction)
{
  double m0 = mass_at(c, direction, 0.05 * c->actuator.travel), m1 = mass_at(c, direction, 0.95 * c->actuator.travel);
  double time = 0.0;
  int i, n = 2000;
  for (i = 0; i < n; i++)
    time += (m1 - m0) / n / mass_rate(c, direction, m0 + (m1 - m0) * (i + 0.5) / n);
  return time;
}

TEST(test_paper_stroke_time__table_a1__equals_integrated_mass)
{
  int which, law, direction;
  for (which = 0; which < PAPER_ACTUATOR_COUNT; which++) {
    for (law = 0; law < PAPER_LAW_COUNT; law++) {
      for (direction = -1; direction <= 1; direction += 2) {
        paper_case c = {paper_actuators[which], paper_laws[law].flow, 101325.0, 1.0};
        assert_close(paper_stroke_time(&c, direction), time_by_mass(&c, direction), 0, 1e-6);
      }
    }
  }
}

/* ---- Shape of the strokes ---- */

static double constant_flow(double P_up, double P_dn)
{
  (void)P_up;
  (void)P_dn;
  return 1e5;
}

/* under a constant flow the scaled times differ by S z (1 - z)/P_mean, S the change of pressure: area S/(6 P_mean) */
TEST(test_paper_asymmetry__constant_flow__closed_form)
{
  paper_case c = ideal_case(constant_flow, 0.0);
  assert_close(paper_asymmetry(&c), 0.9 * 160e3 / (6.0 * 260e3), 0, 1e-4);
}

TEST(test_paper_asymmetry__no_change_of_pressure__zero)
{
  paper_case c = ideal_case(constant_flow, 0.0);
  c.actuator = paper_actuator_with_bench(&c.actuator, 160e3, 160e3 + 1e-6);
  assert_close(paper_asymmetry(&c), 0.0, 1e-12, 0);
}

TEST(test_paper_symmetric_bench__r1_400__equal_times)
{
  paper_case c = ideal_case(paper_flow_unchoked, 1.0);
  double p_bl = paper_symmetric_bench(&c);
  assert_true(p_bl > 80e3 && p_bl < 240e3);
  c.actuator = paper_actuator_with_bench(&c.actuator, p_bl, p_bl + 160e3);
  assert_close(paper_stroke_time(&c, PAPER_UP), paper_stroke_time(&c, PAPER_DOWN), 0, 1e-9);
}

TEST(test_paper_symmetric_bench__supply_below_width__nan)
{
  paper_case c = ideal_case(paper_flow_unchoked, 1.0);
  c.actuator.supply = 150e3;
  assert_true(isnan(paper_symmetric_bench(&c)));
}

/* ---- Rows ---- */

TEST(test_paper_agreement__digits__three_words)
{
  assert_string_equal(paper_agreement(0.596, 0.59629, 0.001, 0), "yes");
  assert_string_equal(paper_agreement(0.5, 0.55, 0.1, 0), "yes");
  assert_string_equal(paper_agreement(238, 238.5165, 1, 0.2), "rounding");
  assert_string_equal(paper_agreement(238, 238.5165, 1, 0), "no");
  assert_string_equal(paper_agreement(-0.2, 0.2, 0.001, 0), "no");
  assert_string_equal(paper_agreement(1.0, (double)INFINITY, 1, 1), "no");
  assert_string_equal(paper_agreement(1.0, (double)NAN, 1, 1), "no");
}

static table numbers;

static int make_numbers(void **state)
{
  paper_numbers_table(&numbers);
  return 0;
}

static int close_numbers(void **state)
{
  table_close(&numbers);
  return 0;
}

TESTS_WITH(make_numbers, close_numbers)

static size_t row_named(const char *item)
{
  size_t i;
  for (i = 0; i < table_rows(&numbers); i++)
    if (!strcmp(table_text(&numbers, i, "item"), item))
      return i;
  fail_msg("no row %s", item);
  return 0;
}

/* A text of the row of an item. */
static const char *text_of(const char *item, const char *column)
{
  return table_text(&numbers, row_named(item), column);
}

static double computed(size_t row)
{
  return table_at(&numbers, row, (size_t)table_column(&numbers, "computed"))->number;
}

/* the numbers by hand: fractions and roots, derived in study/PAPER.md */
TEST(test_paper_numbers__required_items__hand_values)
{
  const struct {
    const char *item;
    double want;
    const char *agrees;
  } want[] = {
      {"table1.3", 1.0 - 1.0 / sqrt(3.0), "no"},
      {"table1.6", 1.0 - sqrt(17.0) / sqrt(27.0), "no"},
      {"table1.12", 1.0 - sqrt(108.0) / sqrt(133.0), "no"},
      {"example2.ratio", (sqrt(29.0) - 3.0) / 4.0, "yes"},
      {"example2.pressure", 100.0 * sqrt(29.0) - 300.0, "rounding"},
      {"eq30.threshold", (sqrt(3.0) - 1.0) / 2.0, "no"},
      {"eq30.threshold_as_printed", (sqrt(1.0 + 2.0 * sqrt(2.0)) - 1.0) / 2.0, "yes"},
      {"eq37.threshold", -1.0, "yes"},
      {"eq38.limit", (sqrt(5.0) - 1.0) / 2.0, "yes"},
      {"conclusion10.as_printed", sqrt(2.0), "yes"},
      {"conclusion10.springs_3", sqrt(3.0), "no"},
      {"conclusion17.efficiency", 0.5, "yes"},
      {"conclusion17.r1-400", 0.6, "no"},
      {"conclusion17.37-13", 4.0 / 7.0, "no"},
      {"conclusion17.maximum", 1.0, "no"},
      {"a1.r1-400.spring_rate", 320.0, "no"},
      {"a1.37-13.spring_rate", 67.7 * 80.0 / 38.1, "no"},
      {"a1.37-13.volume", 6.77 * 0.381, "rounding"},
      {"a1.r1-400.bench_low", 80.0, "no"},
      {"eq2.initial_acceleration", -2000.0, "no"},
      {"eq3.friction_loss", 0.0, "no"},
      {"eq4.preload", 0.0, "yes"},
      {"eq29.limit", sqrt(0.8), "no"},
      {"eq42.37-13", 140.0 * 67.7 * 0.0381 - 0.5 * 9478.0 * 9478.0 / 120e3, "no"},
      {"eq42.r1-400", 400e3 * 0.04 * 0.02 - 0.5 * 16e3 * 16e3 / 400e3, "no"},
      {"eq42.r1-400.bench", 400e3 * 0.04 * 0.02 - 0.5 * 16e3 * 16e3 / 320e3, "no"},
      {"eq42.37-13.bench", 140.0 * 67.7 * 0.0381 - 0.5 * 9478.0 * 9478.0 * 0.0381 / (67.7 * 80.0), "yes"},
      {"eq44.initial_energy", 20.0 / 320.0, "no"},
      {"conclusion17.r1-400.spring", 0.5, "yes"},
      {"conclusion17.37-13.spring", 1.0 - 120e3 * (7.62e-3 + 19.05e-3) / 9478.0, "no"},
      {"conclusion5.limit", sqrt(0.99), "yes"},
      {"conclusion11.theory", 0.0, "yes"},
      {"conclusion14.threshold", 4.0 / 7.0, "yes"},
      {"conclusion15.slopes", 1.0, "yes"},
      {"eq30.maxima", 0.0, "yes"},
      {"conclusion1.exponent", -1.0 - 261.325 / 480.0, "no"},
      {"conclusion13.springs_6", sqrt(500.0 * 160.0 / (340.0 * 240.0)), "yes"},
      {"table1.6.ambient", 6912.0 / 73.6, "no"},
      {"hypothesis2.force_share", 25.0, "no"},
      {"conclusion5.pressure", 0.81 / 0.19 * 101.325 / 400.0, "no"},
      {"conclusion8.exponent", 0.5 * log(40.0 / 7.0 * 2.4 / 9.0) / log(40.0 / 7.0), "yes"},
      {"fig18.reach", 28.0, "yes"},
      {"conclusion2.r1-400", sqrt(320.0 / 160.0) * 341.325 / 181.325, "yes"},
      {"assumption5.r1-400.fill", 101.325 / 501.325 * pow(1.2, 3.5), "no"},
  };
  size_t i;
  for (i = 0; i < sizeof want / sizeof want[0]; i++) {
    check_note("%s", want[i].item);
    assert_close(computed(row_named(want[i].item)), want[i].want, 1e-9, 1e-10);
    assert_string_equal(text_of(want[i].item, "agrees"), want[i].agrees);
  }
}

TEST(test_paper_numbers__conclusion_10__unbounded)
{
  const double ratio = computed(row_named("conclusion10.ratio"));
  assert_true(isinf(ratio) && ratio > 0);
  assert_string_equal(text_of("conclusion10.ratio", "agrees"), "no");
}

static void check_complete(size_t i)
{
  const char *agrees = table_text(&numbers, i, "agrees"), *cause = table_text(&numbers, i, "cause"),
             *kind = table_text(&numbers, i, "kind");
  const char *statement = table_text(&numbers, i, "statement"), *severity = table_text(&numbers, i, "severity");
  check_note("%s", table_text(&numbers, i, "item"));
  assert_true(*table_text(&numbers, i, "item") && *table_text(&numbers, i, "quantity"));
  assert_contains(table_text(&numbers, i, "note"), "(PAPER.md ");
  assert_contains("yes no rounding", agrees);
  assert_int_equal(*cause != 0, !strcmp(agrees, "no") && *statement); /* where there is one to have */
  assert_contains("arithmetic derivation data modelling", kind);
  assert_contains("conclusion number form", severity);
  assert_int_equal(*kind != 0, *cause != 0);
  assert_int_equal(*severity != 0, *cause != 0);
  assert_null(strchr(cause, ',')); /* the last columns can be counted with awk */
  assert_null(strchr(statement, ','));
  assert_string_equal(table_text(&numbers, i, "counted"), *statement ? "yes" : "no");
  if (isnan(computed(i)))
    assert_string_equal(agrees, "no"); /* a matter of form; else a claim whose value nobody computes */
  assert_int_equal(row_named(table_text(&numbers, i, "item")), i);
}

TEST(test_paper_numbers__every_row__complete_and_unique)
{
  size_t i;
  assert_true(table_rows(&numbers) > 100);
  for (i = 0; i < table_rows(&numbers); i++)
    check_complete(i);
  assert_true(isnan(table_at(&numbers, row_named("assumption2.r1-400"), 3)->number)); /* a claim without a number */
}

/* What only gives an order of magnitude, follows from another row, or was never said, does not count. */
TEST(test_paper_numbers__no_statement_of_the_paper__not_counted)
{
  static const char *const asides[] = {"eq8.excess",
                                       "example1.ambient",
                                       "fig6.reach",
                                       "eq29.pressure",
                                       "a1.r1-400.dead_gap",
                                       "a1.37-13.dead_gap",
                                       "a1.heat_ratio.use",
                                       "conclusion17.exergy.37-13",
                                       "conclusion14.choked",
                                       "eq2.initial_acceleration",
                                       "conclusion15.asymmetry",
                                       "a1.r1-400.preload"};
  size_t i;
  for (i = 0; i < sizeof asides / sizeof *asides; i++) {
    check_note("%s", asides[i]);
    assert_string_equal(text_of(asides[i], "counted"), "no");
  }
  assert_string_equal(text_of("table1.3", "counted"), "yes");
}

TEST(test_paper_numbers__statements__all_conclusions_among_them)
{
  size_t i;
  int number;
  for (number = 1; number <= 18; number++) {
    char name[24];
    int found = 0;
    snprintf(name, sizeof name, "conclusion %d", number);
    for (i = 0; i < table_rows(&numbers); i++)
      found |= strcmp(table_text(&numbers, i, "statement"), name) == 0;
    check_note("%s", name);
    assert_true(found);
  }
}

TEST(test_paper_numbers__same_fault__same_cause_and_severity)
{
  assert_string_equal(text_of("conclusion13.springs_3", "cause"),
                      text_of("conclusion4.37-13", "cause")); /* a limit at a pressure that the stem does not reach */
  assert_string_equal(text_of("conclusion13.springs_3", "severity"), "conclusion");
  assert_string_equal(text_of("eq46.outflow", "severity"), "form");
  assert_string_equal(text_of("table1.6", "severity"), "number");
  assert_contains(text_of("a1.r1-400.spring_rate", "note"), "may differ from the nominal values");
}

/* The names of the columns, as they will stand in the file */
static void assert_header(const table *t, const char *want)
{
  char got[256] = "";
  size_t i, used = 0;
  for (i = 0; i < t->columns; i++)
    used += (size_t)snprintf(got + used, sizeof got - used, "%s%s", i > 0 ? "," : "", t->cell[i].text);
  assert_string_equal(got, want);
}

TEST(test_paper_numbers__all__header)
{
  assert_header(&numbers, "item,quantity,unit,printed,computed,agrees,note,kind,cause,statement,severity,counted");
}

/* ---- Figures ---- */

/* v^2 = r^2 - r for the paper's law; for the nozzle a straight line above r = 1/0.528 */
TEST(test_paper_figure__fig05_both_laws__known_curves)
{
  double c = sqrt(0.7) / 1.728;
  size_t i;
  table t;
  paper_figure(PAPER_FIG05, &t);
  assert_header(&t, "flow,P1_over_P2 [1],v_over_scale [1],inverse_law [1],reciprocal_P2 [1/MPa]");
  for (i = 0; i < table_rows(&t); i++) {
    double ratio = table_at(&t, i, 1)->number, v = table_at(&t, i, 2)->number;
    if (strcmp(table_at(&t, i, 0)->text, "paper") == 0)
      assert_close(v * v + ratio, ratio * ratio, 0, TIGHT);
    else if (ratio > 1.9)
      assert_close(v, c * ratio, 0, TIGHT);
    assert_close(table_at(&t, i, 3)->number, ratio, 0, 0);
    assert_close(table_at(&t, i, 4)->number * 0.501325, ratio, 0, TIGHT);
  }
  assert_close(table_at(&t, i - 1, 1)->number, 501325.0 / 101325.0, 0, TIGHT);
  table_close(&t);
}

TEST(test_paper_figure__fig06_paper_flow__eq25_and_band)
{
  size_t i, in_band = 0, spring = 0;
  table t;
  paper_figure(PAPER_FIG06, &t);
  assert_header(&t, "flow,balance,p_over_pa [1],v_over_scale [1],in_band [1]");
  for (i = 0; i < table_rows(&t); i++) {
    double p = table_at(&t, i, 2)->number, v = table_at(&t, i, 3)->number;
    if (strcmp(table_at(&t, i, 0)->text, "paper") != 0)
      continue;
    if (strcmp(table_at(&t, i, 1)->text, "spring") == 0) {
      /* 180 kPa preload, V_0/A = 0.05 mm of a 10 kPa/mm spring: 0.5 kPa stored */
      assert_close(v, sqrt(p * (p + 1.0)) / (2.0 * p + 1.0 - 1.8 + 0.005), 0, 1e-10);
      spring++;
      continue;
    }
    assert_close(v * v * (1.0 + p), p, 1e-12, TIGHT);
    in_band += table_at(&t, i, 4)->number > 0.5;
  }
  assert_int_equal(in_band, 41); /* 1.8, 1.85 .. 3.8 */
  assert_int_equal(spring, 201);
  table_close(&t);
}

TEST(test_paper_figure__fig07_paper_flow__solves_eq33)
{
  size_t i;
  table t;
  paper_figure(PAPER_FIG07, &t);
  assert_header(&t, "flow,pa_over_ps [1],p_over_ps [1]");
  for (i = 0; i < table_rows(&t); i++) {
    double a = table_at(&t, i, 1)->number, q = table_at(&t, i, 2)->number;
    if (strcmp(table_at(&t, i, 0)->text, "paper") == 0)
      assert_close(q * q + (2.0 * a + 1.0) * q, a + 1.0, 0, 1e-10);
    else
      assert_true(q > paper_critical_pressure(a));
  }
  table_close(&t);
}

TEST(test_paper_figure__fig08_paper_flow__rises_to_golden_ratio)
{
  double last = 0.5, low = INFINITY, high = 0.0;
  size_t i;
  table t;
  paper_figure(PAPER_FIG08, &t);
  assert_header(&t, "flow,ps_over_pa [1],p_over_ps [1],asymptote [1],typical [1]");
  for (i = 0; strcmp(table_at(&t, i, 0)->text, "paper") == 0; i++) {
    double s = table_at(&t, i, 1)->number, q = table_at(&t, i, 2)->number;
    assert_true(q > last);
    assert_close((s + 1.0) * (1.0 - q), q * (s * q + 1.0), 0, 1e-10); /* (31) times p_s/p_a */
    assert_close(table_at(&t, i, 3)->number, 2.0 / (1.0 + sqrt(5.0)), 0, TIGHT);
    assert_int_equal(table_at(&t, i, 4)->number > 0.5, s >= 1.4 && s <= 8.0);
    if (table_at(&t, i, 4)->number > 0.5) {
      low = fmin(low, s);
      high = fmax(high, s);
    }
    last = q;
  }
  assert_close(low, 1.4, 0, TIGHT); /* 140 and 800 kPa are rows of the table */
  assert_close(high, 8.0, 0, TIGHT);
  assert_true(i > 100);
  table_close(&t);
}

#include <ctype.h>
#include <omp.h>

#include "../../apps/study/conclusions.h"
#include "../../apps/study/paper.h"
#include "../words.h"

static void read_study(study *s)
{
  succeed(study_read("study/hypotheses.cfg", s, &error));
}

/* ---- Judging ---- */

static finding one_value(double value)
{
  finding f;
  memset(&f, 0, sizeof f);
  finding_add(&f, value, "one");
  return f;
}

TEST(test_finding_judge__crossing_a_threshold__flips)
{
  const double inside = 0.0999, outside = 0.1001;
  finding f = one_value(inside);
  assert_int_equal(finding_judge(&f, -HUGE_VAL, 0.1), FINDING_HOLDS);
  f = one_value(0.1);
  assert_int_equal(finding_judge(&f, -HUGE_VAL, 0.1), FINDING_HOLDS);
  f = one_value(outside);
  assert_int_equal(finding_judge(&f, -HUGE_VAL, 0.1), FINDING_CONTRADICTED);
  assert_int_equal(finding_judge(&f, 0.1, HUGE_VAL), FINDING_HOLDS);
  f = one_value((double)NAN);
  assert_int_equal(finding_judge(&f, -HUGE_VAL, HUGE_VAL), FINDING_CONTRADICTED);
}

TEST(test_finding_judge__each_conclusion__flips_at_its_threshold)
{
  int i;
  for (i = 0; i < CONCLUSIONS; i++) {
    const conclusion *c = &conclusions[i];
    double low, high, limit, into;
    check_note("conclusion %d", c->number);
    assert_int_equal(c->number, i + 1);
    conclusion_limits(c, c->word, &low, &high);
    limit = high < HUGE_VAL ? high : low;
    into = high < HUGE_VAL ? -1e-6 : 1e-6;
    {
      const finding inside = one_value(limit + into), outside = one_value(limit - into);
      assert_int_equal(finding_judge(&inside, low, high), FINDING_HOLDS);
      assert_int_equal(finding_judge(&outside, low, high), FINDING_CONTRADICTED);
    }
  }
}

static void check_limits(int number, double word, double want_low, double want_high)
{
  double low, high;
  check_note("conclusion %d at %g", number, word);
  conclusion_limits(&conclusions[number - 1], word, &low, &high);
  assert_true(low == want_low || fabs(low - want_low) < 1e-12);
  assert_true(high == want_high || fabs(high - want_high) < 1e-12);
}

/* A word moves its own limits, and only where the statement has one. */
TEST(test_conclusion_limits__another_word__moves_only_what_hangs_on_it)
{
  check_limits(1, 0.2, -1.2, -0.8);
  check_limits(2, 0.3, 1.3, HUGE_VAL);
  check_limits(7, conclusion_words[4], -HUGE_VAL, 1.41421356);
  check_limits(6, 0.05, -HUGE_VAL, 0.05);
  check_limits(14, 0.3, -HUGE_VAL, 0.618);
  check_limits(9, 0.3, 0.01, HUGE_VAL);
}

TEST(test_finding_judge__a_case_that_fails__needs_every_conditioned_value)
{
  finding f = one_value(1);
  finding_add(&f, 5, "another");
  assert_int_equal(finding_judge(&f, 0, 2), FINDING_CONTRADICTED);
  finding_add_conditioned(&f, 1.5);
  assert_int_equal(finding_judge(&f, 0, 2), FINDING_HOLDS_WHEN);
  finding_add_conditioned(&f, (double)NAN);
  assert_int_equal(finding_judge(&f, 0, 2), FINDING_CONTRADICTED);
  f.n = 0;
  assert_int_equal(finding_judge(&f, 0, 2), FINDING_CONTRADICTED);
}

TEST(test_finding_add__beyond_its_room__left_out)
{
  finding f = one_value(1);
  int i;
  for (i = 0; i < 2 * FINDING_CASES; i++) {
    finding_add(&f, i, "case %d", i);
    finding_add_conditioned(&f, i);
  }
  assert_int_equal(f.n, FINDING_CASES);
  assert_int_equal(f.n_conditioned, FINDING_CASES);
}

TEST(test_finding_text__values_and_claim__in_words)
{
  finding f = one_value(0.25);
  char text[200];
  finding_add(&f, 1e-9, "two");
  lab_append(f.note, FINDING_TEXT, "at %g kPa", 80.0);
  lab_append(f.condition, FINDING_TEXT, "p_s is above %g kPa", 140.0);
  finding_evidence(&f, "ratio", -HUGE_VAL, 0.5, text, sizeof text);
  assert_string_equal(text, "ratio: 0.25 (one), 0 (two); claimed <= 0.5; at 80 kPa");
  finding_evidence(&f, "ratio", 0.5, HUGE_VAL, text, sizeof text);
  assert_contains(text, "claimed >= 0.5");
  finding_evidence(&f, "a measure with a long name", -1.1, -0.9, text, 30);
  assert_int_equal(strlen(text), 29);
  finding_verdict_text(&f, FINDING_HOLDS_WHEN, text, sizeof text);
  assert_string_equal(text, "holds when p_s is above 140 kPa");
  finding_verdict_text(&f, FINDING_CONTRADICTED, text, sizeof text);
  assert_string_equal(text, "contradicted");
}

TEST(test_finding_join__two_actuators__one_sentence)
{
  finding all, one = one_value(1), two = one_value(3);
  char text[200];
  memset(&all, 0, sizeof all);
  finding_add_conditioned(&one, 1);
  lab_append(one.condition, FINDING_TEXT, "the bench set starts");
  lab_append(one.where, FINDING_TEXT, "above 40 kPa");
  lab_append(one.note, FINDING_TEXT, "noted");
  finding_add_conditioned(&two, 2);
  lab_append(two.condition, FINDING_TEXT, "the bench set starts");
  lab_append(two.where, FINDING_TEXT, "anywhere");
  finding_join(&all, &one, "r1");
  finding_join(&all, &two, "m37");
  finding_verdict_text(&all, finding_judge(&all, 0, 2), text, sizeof text);
  assert_string_equal(text, "holds when the bench set starts above 40 kPa (r1), anywhere (m37)");
  finding_evidence(&all, "ratio", 0, 2, text, sizeof text);
  assert_string_equal(text, "ratio: 1 (r1, one), 3 (m37, one); claimed 0..2; r1: noted");
  memset(&all, 0, sizeof all);
  *one.where = 0;
  finding_join(&all, &one, "r1");
  finding_join(&all, &two, "m37");
  finding_verdict_text(&all, FINDING_HOLDS_WHEN, text, sizeof text);
  assert_string_equal(text, "holds when the bench set starts anywhere (m37)");
  two.conditioned[0].value = 2.1;
  assert_int_equal(finding_judge(&two, 0, 2), FINDING_CONTRADICTED);
}

TEST(test_finding_worst__each_kind_of_limit__nearest_to_failing)
{
  finding f = one_value(2);
  finding_add(&f, 1, "lower");
  finding_add(&f, 3.00001, "upper");
  assert_close(finding_worst(&f, -HUGE_VAL, 5), 3, 0, 0);
  assert_close(finding_worst(&f, 0.5, HUGE_VAL), 1, 0, 0);
  assert_close(finding_worst(&f, 0, 5), 2, 0, 0);
}

/* ---- Velocities ---- */

/* rising v = 3 - p, falling v = p, both over p = 1 .. 2 */
static speed_pair straight_lines(void)
{
  speed_pair pair;
  int i;
  memset(&pair, 0, sizeof pair);
  for (i = 0; i < SPEED_POINTS; i++) {
    pair.up.p[i] = pair.down.p[i] = 1 + i / (SPEED_POINTS - 1.0);
    pair.up.v[i] = 3 - pair.up.p[i];
    pair.down.v[i] = pair.down.p[i];
  }
  return pair;
}

TEST(test_speeds__straight_lines__read_off)
{
  speed_pair pair = straight_lines();
  int i;
  assert_close(speed_crossing(&pair), 1.5, 1e-12, 0);
  assert_close(speed_at_pressure(&pair.up, 1.23456), 3 - 1.23456, 1e-12, 0);
  assert_true(isnan(speed_at_pressure(&pair.up, 0.999)));
  assert_close(speed_max(&pair.up), 2, 1e-12, 0);
  assert_close(speed_min(&pair.up), 1, 1e-12, 0);
  assert_int_equal(speed_fastest(&pair.down), SPEED_POINTS - 1);
  for (i = 0; i < SPEED_POINTS; i++)
    pair.down.v[i] = 7 * pow(pair.down.p[i] + 5, -1.75);
  assert_close(speed_exponent(&pair.down, 5), -1.75, 0, 1e-9);
  assert_true(isnan(speed_crossing(&pair))); /* the fall is never the faster one now */
}

/* The paper's actuator with the spring as printed beside the study's, in one law. */
static paper_case closed_form(int actuator, int law)
{
  paper_case c;
  c.actuator = paper_actuators[actuator];
  c.flow = paper_laws[law].flow;
  c.P_a = paper.ambient;
  c.storage = 1;
  return c;
}

static pneu_laws isothermal(int law)
{
  pneu_laws laws = {PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 0, 0};
  if (law == PAPER_LAW_CHOKED)
    laws.flow = PNEU_FLOW_CHOKED;
  return laws;
}

static void compare_speeds(const lab_rig *rig, int actuator, int law)
{
  const paper_case c = closed_form(actuator, law);
  const double scale = paper_speed_scale(c.actuator.orifice, c.actuator.area, rig->params.ambient_temperature);
  const pneu_laws laws = isothermal(law);
  speed_pair pair;
  int i;
  assert_string_equal(rig->name, c.actuator.key);
  succeed(speeds_measure(&rig->params, &laws, &pair, &error));
  for (i = 0; i < SPEED_POINTS; i += 10) {
    const double x = speed_position(i) * c.actuator.travel;
    check_note("%s, %s, x = %g m", rig->name, paper_laws[law].key, x);
    assert_close(pair.up.v[i], scale * paper_speed(&c, PAPER_UP, x), 0, 0.03);
    assert_close(pair.down.v[i], scale * paper_speed(&c, PAPER_DOWN, x), 0, 0.03);
    assert_close(pair.up.p[i], paper_pressure(&c, PAPER_UP, x), 1e3, 0);
    assert_close(pair.down.p[i], paper_pressure(&c, PAPER_DOWN, x), 1e3, 0);
  }
  assert_close(pair.down.arrival, scale * paper_speed(&c, PAPER_DOWN, 0), 0, 0.03);
  assert_close(pair.shape.rise_time, paper_stroke_time(&c, PAPER_UP), 0, 0.03);
}

TEST(test_speeds_measure__every_law_and_actuator__quasi_static)
{
  static study s;
  int actuator, law;
  read_study(&s);
  for (actuator = 0; actuator < PAPER_ACTUATOR_COUNT; actuator++)
    for (law = 0; law < PAPER_LAW_COUNT; law++)
      compare_speeds(&s.actuator[actuator], actuator, law);
}

/* -int A p dx of the falling edge without friction is the energy of the spring: A x_n (p_bl + p_bh)/2 */
TEST(test_speeds_measure__returned_work__is_that_of_the_spring)
{
  const pneu_laws laws = isothermal(PAPER_LAW_UNCHOKED);
  pneu_params p;
  speed_pair pair;
  pneu_params_default(&p);
  p.dry_friction = 0;
  succeed(speeds_measure(&p, &laws, &pair, &error));
  assert_close(pair.returned, 0.5 * p.spring_rate * (0.03 * 0.03 - 0.01 * 0.01), 0, 5e-3);
}

TEST(test_speeds_measure__no_travel__data_error)
{
  const pneu_laws laws = isothermal(PAPER_LAW_UNCHOKED);
  pneu_params p;
  speed_pair pair;
  pneu_params_default(&p);
  p.supply_pressure = 50e3; /* below the 112 kPa that the preload and friction hold */
  assert_int_equal(speeds_measure(&p, &laws, &pair, &error), LAB_DATA);
  p.area = -1;
  assert_int_equal(speeds_measure(&p, &laws, &pair, &error), LAB_DATA);
}

/* ---- Bench sets ---- */

TEST(test_bench_scan_range__a_valley__ends_between_points)
{
  static bench_scan scan;
  double from = 0, to = 0;
  int i;
  for (i = 0; i < SCAN_POINTS; i++) {
    scan.from[i] = i;
    scan.value[SCAN_FALL_RANGE][i] = fabs(i - 10.0);
  }
  assert_int_equal(bench_scan_range(&scan, SCAN_FALL_RANGE, 2.5, &from, &to), 1);
  assert_close(from, 7.5, 1e-12, 0);
  assert_close(to, 12.5, 1e-12, 0);
  assert_int_equal(bench_scan_range(&scan, SCAN_FALL_RANGE, 1e3, &from, &to), 1);
  assert_close(from, 0, 0, 0);
  assert_close(to, SCAN_POINTS - 1, 0, 0);
  assert_int_equal(bench_scan_range(&scan, SCAN_FALL_RANGE, -1, &from, &to), 0);
}

enum { R1_400_BENCH = 2 }; /* of the study's actuators */

TEST(test_bench_equal__both_laws__where_the_closed_form_has_it)
{
  static study s;
  int law;
  read_study(&s);
  assert_string_equal(s.actuator[R1_400_BENCH].name, "r1-400-bench");
  for (law = 0; law < PAPER_LAW_COUNT; law++) {
    const paper_case c = closed_form(PAPER_R1_400, law);
    const pneu_laws laws = isothermal(law);
    double asymmetry;
    check_note("%s", paper_laws[law].key);
    assert_close(bench_equal(&s.actuator[R1_400_BENCH].params, &laws, 160e3, &asymmetry), paper_symmetric_bench(&c), 0,
                 0.02);
    assert_between(asymmetry, 0.1, 0.13);
  }
}

/* A narrow bench set changes the pressure by little, so that both strokes are nearly straight; the closed form agrees
 * with the width. */
TEST(test_bench_alike__a_tenth_of_the_shape__narrow_bench_set)
{
  static study s;
  const pneu_laws laws = isothermal(PAPER_LAW_UNCHOKED);
  paper_case c = closed_form(PAPER_R1_400, PAPER_LAW_UNCHOKED);
  double low, width;
  read_study(&s);
  width = bench_alike(&s.actuator[R1_400_BENCH].params, &laws, 160e3, 0.0102, &low);
  c.actuator = paper_actuator_with_bench(&c.actuator, low, low + width);
  assert_between(width, 11e3, 13e3);
  assert_close(paper_asymmetry(&c), 0.0102, 0, 0.03);
  assert_close(paper_stroke_time(&c, PAPER_UP), paper_stroke_time(&c, PAPER_DOWN), 0, 0.01);
  assert_true(isnan(bench_alike(&s.actuator[R1_400_BENCH].params, &laws, 160e3, 1e-6, &low)));
}

TEST(test_bench_params__narrower_than_a_preload_can_be__force_stands_in)
{
  pneu_params p, b;
  pneu_params_default(&p);
  b = bench_params(&p, 80e3, 100.0);
  assert_close(b.spring_preload, 1, 0, 0);
  assert_close(b.spring_rate * b.spring_preload + b.external_force, 80e3 * p.area, 0, 1e-12);
}

/* ---- Loaded cycle ---- */

/* What spring and load resist with is p_s A (1 - margin) - F up and p_s A margin + F down, so that the load takes
 * (p_s A (1 - 2 margin) - 2 F) x_n; the air is that which fills the volume from ambient to supply. */
TEST(test_load_cycle__friction_and_margin__are_all_that_is_lost)
{
  const double margin = 0.02;
  pneu_params p;
  load_cycle cycle;
  int law;
  pneu_params_default(&p);
  for (law = 0; law < PAPER_LAW_COUNT; law++) {
    const pneu_laws laws = isothermal(law);
    const double full = p.supply_pressure * p.area, swept = p.area * p.stroke;
    const double air = ((p.supply_pressure + p.ambient_pressure) * swept + p.supply_pressure * p.dead_volume) /
                       (p.gas_constant * p.ambient_temperature);
    check_note("%s", paper_laws[law].key);
    succeed(load_cycle_run(&p, &laws, margin, &cycle, &error));
    assert_close(cycle.work_up + cycle.work_down, (full * (1 - 2 * margin) - 2 * p.dry_friction) * p.stroke, 0, 5e-3);
    assert_close(cycle.air, air, 0, 1e-3);
  }
}

TEST(test_load_cycle__load_too_heavy__says_where_it_stays)
{
  const pneu_laws laws = isothermal(PAPER_LAW_UNCHOKED);
  pneu_params p;
  load_cycle cycle;
  pneu_params_default(&p);
  assert_fails(load_cycle_run(&p, &laws, -0.01, &cycle, &error), LAB_NUMERIC, "stays at x = 0 m");
}

/* ---- The table ---- */

static int is_verdict(const char *text)
{
  return !strcmp(text, "holds") || !strcmp(text, "contradicted") ||
         (!strncmp(text, "holds when ", 11) && strlen(text) > 11);
}

static int has_digit(const char *text)
{
  while (*text && !isdigit((unsigned char)*text))
    text++;
  return *text != 0;
}

static void check_row(const study *s, const table *t, size_t row)
{
  const int laws = s->n_gas * s->n_flow, law = (int)row % laws;
  check_note("row %d", (int)row);
  assert_close(table_at(t, row, 0)->number, (int)row / laws + 1, 0, 0);
  assert_string_equal(table_at(t, row, 1)->text, pneu_gas_key(s->gas[law / s->n_flow]));
  assert_string_equal(table_at(t, row, 2)->text, pneu_flow_key(s->flow[law % s->n_flow]));
  assert_true(is_verdict(table_at(t, row, 3)->text));
  assert_true(has_digit(table_at(t, row, 4)->text));
  assert_null(strstr(table_at(t, row, 4)->text, "nan"));
}

static const char *verdict_of(const table *t, int number, int laws, int law)
{
  return table_at(t, (size_t)((number - 1) * laws + law), 3)->text;
}

/* The tables of a study, with some number of threads. */
static void make_tables(const study *s, int threads, table made[CONCLUSION_TABLES])
{
  const int before = omp_get_max_threads();
  finding *found;
  int i;
  omp_set_num_threads(threads);
  succeed(conclusions_try(s, &found, &error));
  omp_set_num_threads(before);
  for (i = 0; i < CONCLUSION_TABLES; i++)
    conclusions_table(s, found, i, &made[i]);
  free(found);
}

static void assert_same_tables(const table *one, const table *two)
{
  size_t row, column;
  assert_int_equal(table_rows(one), table_rows(two));
  for (row = 0; row < table_rows(one); row++)
    for (column = 0; column < one->columns; column++)
      if (table_at(one, row, column)->text)
        assert_string_equal(table_at(one, row, column)->text, table_at(two, row, column)->text);
}

/* Verdict of an actuator, by index, in one of four laws. */
static const char *verdict_on(const table *t, int number, int actuator, int law)
{
  return table_at(t, (size_t)(((number - 1) * 4 + actuator) * 4 + law), 8)->text;
}

TEST(test_conclusions__whole_study__every_row_whatever_the_threads)
{
  static study s;
  table one[CONCLUSION_TABLES], two[CONCLUSION_TABLES];
  const table *overall = &one[CONCLUSION_OVERALL], *actuators = &one[CONCLUSION_ACTUATORS];
  size_t row;
  int i;
  read_study(&s);
  make_tables(&s, 1, one);
  make_tables(&s, 3, two);
  for (i = 0; i < CONCLUSION_TABLES; i++)
    assert_same_tables(&one[i], &two[i]);
  assert_int_equal(table_rows(overall), CONCLUSIONS * 4);
  assert_int_equal(table_rows(actuators), CONCLUSIONS * 4 * 4);
  assert_int_equal(table_rows(&one[CONCLUSION_THRESHOLDS]), CONCLUSIONS * 2 * 4);
  for (row = 0; row < table_rows(overall); row++)
    check_row(&s, overall, row);
  for (row = 0; row < table_rows(actuators); row++) {
    check_note("row %d", (int)row);
    assert_null(strstr(table_at(actuators, row, 9)->text, "nan"));
    assert_false(isnan(table_at(actuators, row, 5)->number));
  }
  /* what follows from closed forms: PAPER.md 4.1, 5.5, 6.4, 6.7, 7.2 */
  assert_string_equal(verdict_of(overall, 1, 4, 0), "contradicted");
  assert_string_equal(verdict_of(overall, 11, 4, 0), "holds");
  assert_string_equal(verdict_of(overall, 14, 4, 0), "holds");
  assert_string_equal(verdict_of(overall, 14, 4, 1), "contradicted");
  assert_string_equal(verdict_of(overall, 16, 4, 1), "holds");
  assert_contains(verdict_of(overall, 6, 4, 0), "not the spring");
  assert_contains(verdict_of(overall, 17, 4, 0), "return is idle");
  assert_contains(verdict_of(overall, 18, 4, 3), "exergy of the air (r1-400)");
  assert_string_equal(verdict_on(actuators, 3, 0, 0), "holds");
  assert_contains(verdict_on(actuators, 3, 1, 0), "holds when p_s is above");
  for (i = 0; i < CONCLUSION_TABLES; i++) {
    table_close(&one[i]);
    table_close(&two[i]);
  }
}

/* One conclusion of made-up findings: 1.15 on the printed actuator, 1.01 on its twin. */
TEST(test_conclusions_thresholds__a_verdict_that_turns__is_marked)
{
  static study s;
  static finding found[2 * CONCLUSIONS];
  table t;
  int i;
  read_study(&s);
  s.n_gas = s.n_flow = s.n_printed = 1;
  s.n_actuators = 2;
  for (i = 0; i < 2 * CONCLUSIONS; i++)
    found[i] = one_value(i < CONCLUSIONS ? 1.15 : 1.01);
  conclusions_table(&s, found, CONCLUSION_THRESHOLDS, &t);
  for (i = 0; i < 6; i++) /* conclusion 7 on the printed one: 5, 10, 20, 30, 41 % and the mark */
    assert_string_equal(table_at(&t, 12, (size_t)(5 + i))->text, i < 2   ? "contradicted"
                                                                 : i < 5 ? "holds"
                                                                         : "threshold, set");
  assert_string_equal(table_at(&t, 13, 1)->text, "bench");
  assert_string_equal(table_at(&t, 13, 10)->text, "set");
  assert_string_equal(table_at(&t, 14, 10)->text, ""); /* conclusion 8 has no word */
  table_close(&t);
}

TEST(test_conclusions_try__parameters_out_of_bounds__says_which_actuator_and_law)
{
  static study s;
  finding *found;
  read_study(&s);
  s.actuator[1].params.area = -1;
  assert_fails(conclusions_try(&s, &found, &error), LAB_DATA, "isothermal, paper");
  assert_contains(error.text, "37-13");
  assert_contains(error.text, "area");
  free(found);
}

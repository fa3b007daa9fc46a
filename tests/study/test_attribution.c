/* apps/study/shapes, attribution: how strokes differ in the tables of the study */
#include "../scratch.h"

#include "../../apps/study/products.h"

static study *read_study(void)
{
  static study s;
  succeed(study_read("study/hypotheses.cfg", &s, &error));
  snprintf(s.results, sizeof s.results, "%s", scratch_folder);
  return &s;
}

static void make(const study_tables *tables, const study *s, const char *name, table *t)
{
  succeed(study_make(s, tables, &error));
  succeed(table_load(s, name, t, &error));
}

/* The R1-400 as Eq. (1) has it under every law; the 37-13 as printed falls as a lag unless the flow chokes. */
TEST(test_edges__eq1__as_the_report_says)
{
  const study *s = read_study();
  table t;
  size_t row;
  make(&edges, s, "eq1.csv", &t);
  assert_int_equal(table_rows(&t), s->n_actuators * s->n_gas * s->n_flow * 2);
  for (row = 0; row < table_rows(&t); row++) {
    const char *actuator = table_text(&t, row, "actuator"), *flow = table_text(&t, row, "flow");
    const int falls = !strcmp(table_text(&t, row, "stroke"), "fall");
    check_note("row %zu", row);
    if (!falls)
      assert_string_equal(table_text(&t, row, "shape"), "lag");
    else if (!strncmp(actuator, "r1-400", 6))
      assert_string_equal(table_text(&t, row, "shape"), "ramp");
    else if (!strcmp(actuator, "37-13"))
      assert_string_equal(table_text(&t, row, "shape"), strcmp(flow, "choked") ? "lag" : "ramp");
  }
  table_close(&t);
}

TEST(test_directions__vent_for_equal_times__shape_stays)
{
  table t;
  size_t row, base = 0;
  make(&directions, read_study(), "directions.csv", &t);
  for (row = 0; row < table_rows(&t); row++) {
    if (table_number(&t, row, "down_over_up") == 1)
      base = row;
    if (!strcmp(table_text(&t, row, "what"), "orifice for equal times")) {
      assert_close(table_number(&t, row, "duration_ratio"), 1, 1e-8, 0);
      assert_close(table_number(&t, row, "asymmetry"), table_number(&t, base, "asymmetry"), 0, 0.01);
    }
  }
  table_close(&t);
}

/* Shapley shares add up to the whole, and nothing is left where every cause is gone. */
TEST(test_attribution__shares__add_up)
{
  const study *s = read_study();
  double sum[STUDY_LAW_MAX] = {0};
  table t;
  size_t row;
  int g;
  make(&attribution, s, "attribution_37-13.csv", &t);
  for (row = 0; row < table_rows(&t); row++)
    for (g = 0; g < s->n_gas; g++)
      if (!strcmp(table_text(&t, row, "gas"), pneu_gas_key(s->gas[g]))) {
        sum[g] += table_number(&t, row, "share");
        if (!strcmp(table_text(&t, row, "cause"), "remainder"))
          assert_close(table_number(&t, row, "share"), 0, 1e-8, 0);
        if (strstr(table_text(&t, row, "cause"), "place"))
          assert_true(table_number(&t, row, "share") < -1);
      }
  for (g = 0; g < s->n_gas; g++)
    assert_close(sum[g], 1, 1e-8, 0);
  table_close(&t);
}

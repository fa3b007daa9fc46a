/* Tables behind figures 5 to 8, for both flow laws.
 * SPDX-License-Identifier: MIT */
#include "paper.h"

enum { INTERVALS = 200 };

/* i-th of INTERVALS + 1 evenly spaced points */
static double point(double from, double to, int i)
{
  return from + (to - from) * i / INTERVALS;
}

static double constant(int id)
{
  return paper_constants[id].value;
}

/* from the supply's pressure down to ambient, the widest range a chamber of the R1-400 can see */
static void fig05_curve(table *t, const paper_law *law)
{
  double P_a = constant(PAPER_AMBIENT), P_s = constant(PAPER_R1_SUPPLY) + P_a;
  int i;
  for (i = 0; i <= INTERVALS; i++) {
    double ratio = point(1.0, P_s / P_a, i); /* P_1/P_2: the reciprocal of P_2 in units of P_1 */
    table_row(t, "sggg", law->key, ratio, paper_fill_speed(law->flow, ratio, 1.0), ratio);
  }
}

void paper_fig05(table *t)
{
  int i;
  table_open(t, "flow,P1_over_P2 [1],v_over_scale [1],inverse_law [1]");
  for (i = 0; i < PAPER_LAW_COUNT; i++)
    fig05_curve(t, &paper_laws[i]);
}

static void fig06_paper(table *t, const paper_law *law)
{
  double P_a = constant(PAPER_EXAMPLE_AMBIENT);
  double low = constant(PAPER_SPRINGS_12_LOW) / P_a, high = constant(PAPER_SPRINGS_12_HIGH) / P_a;
  int i;
  for (i = 0; i <= INTERVALS; i++) {
    double p = point(0.0, 10.0, i); /* twice as far as the text looks */
    table_row(t, "ssggg", law->key, "constant pressure", p, paper_vent_speed(law->flow, p + 1.0, 1.0),
              (double)(p >= low && p <= high));
  }
}

/* the falling stem of the R1-400 on the springs of the band, without dry friction */
static void fig06_spring(table *t, const paper_law *law)
{
  double P_a = constant(PAPER_EXAMPLE_AMBIENT);
  paper_case c = {paper_actuator_printed(PAPER_R1_400), law->flow, P_a, 1.0};
  int i;
  c.actuator = paper_actuator_with_bench(&c.actuator, constant(PAPER_SPRINGS_12_LOW), constant(PAPER_SPRINGS_12_HIGH));
  c.actuator.friction = 0.0;
  for (i = 0; i <= INTERVALS; i++) {
    double x = point(0.0, c.actuator.travel, i);
    table_row(t, "ssggg", law->key, "spring", paper_pressure(&c, PAPER_DOWN, x) / P_a, paper_speed(&c, PAPER_DOWN, x),
              1.0);
  }
}

void paper_fig06(table *t)
{
  int i;
  table_open(t, "flow,balance,p_over_pa [1],v_over_scale [1],in_band [1]");
  for (i = 0; i < PAPER_LAW_COUNT; i++) {
    fig06_paper(t, &paper_laws[i]);
    fig06_spring(t, &paper_laws[i]);
  }
}

void paper_fig07(table *t)
{
  int i, j;
  table_open(t, "flow,pa_over_ps [1],p_over_ps [1]");
  for (i = 0; i < PAPER_LAW_COUNT; i++) {
    for (j = 0; j <= INTERVALS; j++) {
      double a = point(0.0, 2.0, j); /* down to a supply of half an ambient pressure */
      table_row(t, "sgg", paper_laws[i].key, a, paper_crossing(paper_laws[i].flow, a));
    }
  }
}

static void fig08_curve(table *t, const paper_law *law)
{
  double P_a = constant(PAPER_EXAMPLE_AMBIENT), asymptote = paper_crossing(law->flow, 0.0);
  double low = constant(PAPER_TYPICAL_LOW) / P_a, high = constant(PAPER_TYPICAL_HIGH) / P_a;
  int i;
  for (i = 0; i <= INTERVALS; i++) {
    double s = point(0.5, 10.0, i);
    table_row(t, "sgggg", law->key, s, paper_crossing(law->flow, 1.0 / s), asymptote, (double)(s >= low && s <= high));
  }
}

void paper_fig08(table *t)
{
  int i;
  table_open(t, "flow,ps_over_pa [1],p_over_ps [1],asymptote [1],typical [1]");
  for (i = 0; i < PAPER_LAW_COUNT; i++)
    fig08_curve(t, &paper_laws[i]);
}

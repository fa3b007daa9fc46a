/* Curves of figures 5 to 8 from the closed forms.
 * SPDX-License-Identifier: MIT */
#include "paper.h"

enum { INTERVALS = 200 };

/* One of INTERVALS + 1 evenly spaced points. */
static double point(double from, double to, int i)
{
  return from + (to - from) * i / INTERVALS;
}

/* from the supply's pressure down to ambient, the widest range a chamber of the R1-400 can see */
static void fig05(table *t, const paper_law *law, int i)
{
  const double P_s = paper_actuators[PAPER_R1_400].supply + paper.ambient;
  const double ratio = point(1.0, P_s / paper.ambient, i); /* P_1/P_2 */
  table_row(t, "sgggg", law->key, ratio, paper_fill_speed(law->flow, ratio, 1.0), ratio, ratio / P_s * 1e6);
}

static const double band_low = 180e3, band_high = 380e3; /* 12 springs of Table 1 */

static void fig06_paper(table *t, const paper_law *law, int i)
{
  const double low = band_low / paper.example_ambient, high = band_high / paper.example_ambient;
  const double p = point(0.0, 10.0, i); /* twice as far as the text looks */
  table_row(t, "ssggg", law->key, "constant pressure", p, paper_vent_speed(law->flow, p + 1.0, 1.0),
            (double)(p >= low && p <= high));
}

/* the falling stem of the R1-400 on the springs of the band, without dry friction */
static void fig06_spring(table *t, const paper_law *law, int i)
{
  paper_case c = {paper_actuators[PAPER_R1_400], law->flow, paper.example_ambient, 1.0};
  const double x = point(0.0, c.actuator.travel, i);
  c.actuator = paper_actuator_with_bench(&c.actuator, band_low, band_high);
  c.actuator.friction = 0.0;
  table_row(t, "ssggg", law->key, "spring", paper_pressure(&c, PAPER_DOWN, x) / c.P_a, paper_speed(&c, PAPER_DOWN, x),
            1.0);
}

static void fig07(table *t, const paper_law *law, int i)
{
  const double a = point(0.0, 2.0, i); /* down to a supply of half an ambient pressure */
  table_row(t, "sgg", law->key, a, paper_crossing(law->flow, a));
}

static void fig08(table *t, const paper_law *law, int i)
{
  const double p_a = paper.example_ambient, s = point(0.0, 10.0, i); /* among them both ends of the typical range */
  table_row(t, "sgggg", law->key, s, paper_crossing(law->flow, 1.0 / s), paper_crossing(law->flow, 0.0),
            (double)(s >= paper.typical_low / p_a && s <= paper.typical_high / p_a));
}

/* Curves of each law, one after the other. */
static const struct {
  const char *header;
  int first; /* point */
  void (*curve[2])(table *t, const paper_law *law, int i);
} figures[PAPER_FIGURES] = {
    [PAPER_FIG05] = {"flow,P1_over_P2 [1],v_over_scale [1],inverse_law [1],reciprocal_P2 [1/MPa]", 0, {fig05}},
    [PAPER_FIG06] = {"flow,balance,p_over_pa [1],v_over_scale [1],in_band [1]", 0, {fig06_paper, fig06_spring}},
    [PAPER_FIG07] = {"flow,pa_over_ps [1],p_over_ps [1]", 0, {fig07}},
    [PAPER_FIG08] = {"flow,ps_over_pa [1],p_over_ps [1],asymptote [1],typical [1]", 1, {fig08}}};

void paper_figure(int which, table *t)
{
  int law, k, i;
  table_open(t, figures[which].header);
  for (law = 0; law < PAPER_LAW_COUNT; law++)
    for (k = 0; k < 2 && figures[which].curve[k]; k++)
      for (i = figures[which].first; i <= INTERVALS; i++)
        figures[which].curve[k](t, &paper_laws[law], i);
}

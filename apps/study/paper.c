/* Closed forms of the paper and of the spring-loaded stem in quasi-equilibrium, and their curves.
 * SPDX-License-Identifier: MIT */
#include "paper.h"

#include <math.h>

enum { HALVINGS = 60, PANELS = 200 };

#define STROKE_FROM 0.05 /* part of the travel that a stroke is timed over: 5 % to 95 % */
#define STROKE_TO   0.95

const paper_constants paper = {.gas_constant = 8.31446,
                               .molar_mass = 0.02896,
                               .ambient = 101325.0,
                               .heat_ratio = 1.4,
                               .temperature = 298.15,
                               .mass = 2.0,
                               .viscous = 500.0,
                               .damping = 1000.0,
                               .example_ambient = 100e3,
                               .example_supply = 400e3,
                               .typical_low = 140e3,
                               .typical_high = 800e3};

/* In the order of the struct. */
const paper_actuator paper_actuators[PAPER_ACTUATOR_COUNT] = {
    {"r1-400", 0.04, 2e-6, 0.02, 400e3, 0.01, 400e3, 80e3, 240e3, 0.893e-6, 480.0},
    {"37-13", 0.0677, 4e-6, 38.1e-3, 120e3, 7.62e-3, 140e3, 20e3, 100e3, 2.177e-6, 480.0}};

/* ---- Flow laws ---- */

const paper_law paper_laws[PAPER_LAW_COUNT] = {{"paper", paper_flow_unchoked}, {"choked", paper_flow_choked}};

double paper_flow_unchoked(double P_up, double P_dn)
{
  return sqrt(P_up * (P_up - P_dn));
}

/* (2/(g+1))^(g/(g-1)) */
double paper_choking_ratio(void)
{
  double g = paper.heat_ratio;
  return pow(2.0 / (g + 1.0), g / (g - 1.0));
}

/* m' sqrt(RT)/(C a P_up) = sqrt(2 g/(g-1) (r^(2/g) - r^((g+1)/g))); the paper's unit takes sqrt(2) out */
double paper_flow_choked(double P_up, double P_dn)
{
  double g = paper.heat_ratio;
  double r = fmax(P_dn / P_up, paper_choking_ratio());
  return P_up * sqrt(g / (g - 1.0) * (pow(r, 2.0 / g) - pow(r, (g + 1.0) / g)));
}

/* ---- The paper's velocities ---- */

double paper_fill_speed(paper_flow flow, double P_s, double P)
{
  return flow(P_s, P) / P;
}

double paper_vent_speed(paper_flow flow, double P, double P_a)
{
  return flow(P, P_a) / P;
}

double paper_speed_change(paper_flow flow, double p_bl, double p_bh, double P_a)
{
  return 1.0 - paper_vent_speed(flow, p_bl + P_a, P_a) / paper_vent_speed(flow, p_bh + P_a, P_a);
}

double paper_critical_pressure(double pa_over_ps)
{
  double b = 2.0 * pa_over_ps + 1.0;
  double discriminant = b * b + 4.0 * (pa_over_ps + 1.0);
  return 0.5 * (sqrt(discriminant) - b);
}

/* inflow falls and outflow grows with the chamber pressure, so there is one root in 0..1 */
double paper_crossing(paper_flow flow, double pa_over_ps)
{
  double a = pa_over_ps, lo = 0.0, hi = 1.0;
  int i;
  for (i = 0; i < HALVINGS; i++) {
    double q = 0.5 * (lo + hi);
    *(flow(1.0 + a, q + a) > flow(q + a, a) ? &lo : &hi) = q;
  }
  return 0.5 * (lo + hi);
}

double paper_supply_threshold(double c)
{
  return 0.5 * (sqrt(1.0 + 4.0 * c) - 1.0);
}

double paper_speed_scale(double orifice, double area, double temperature)
{
  return orifice / area * sqrt(2.0 * paper.gas_constant * temperature / paper.molar_mass);
}

/* ---- Energy ---- */

double paper_returned_share(double p_bl, double p_bh, double p_s)
{
  return (p_bl + p_bh) / (2.0 * p_s);
}

double paper_exergy_efficiency(double p_s, double P_a)
{
  double P_s = p_s + P_a;
  return p_s / (P_s * log(P_s / P_a));
}

/* ---- Spring-loaded stem ---- */

paper_actuator paper_actuator_with_bench(const paper_actuator *base, double p_bl, double p_bh)
{
  paper_actuator a = *base;
  a.bench_low = p_bl;
  a.bench_high = p_bh;
  a.rate = a.area * (p_bh - p_bl) / a.travel;
  a.preload = p_bl * a.area / a.rate;
  return a;
}

double paper_pressure(const paper_case *c, int direction, double x)
{
  const paper_actuator *a = &c->actuator;
  return (a->rate * (x + a->preload) + direction * a->friction) / a->area;
}

double paper_speed(const paper_case *c, int direction, double x)
{
  const paper_actuator *a = &c->actuator;
  double P = paper_pressure(c, direction, x) + c->P_a;
  double volume = a->dead_volume + a->area * x;
  double stored = c->storage * a->rate * volume / (a->area * a->area);
  double flow = direction == PAPER_UP ? c->flow(a->supply + c->P_a, P) : c->flow(P, c->P_a);
  return flow / (P + stored);
}

/* time over the scale C a/A sqrt(..) to pass the part y0..y1 of a stroke, y counted from its own start */
static double panel_time(const paper_case *c, int direction, double y0, double y1)
{
  static const double weight[3] = {1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};
  double mean = 0.0;
  int i;
  for (i = 0; i < 3; i++) {
    double y = y0 + 0.5 * i * (y1 - y0);
    double x = c->actuator.travel * (direction == PAPER_UP ? y : 1.0 - y);
    mean += weight[i] / paper_speed(c, direction, x);
  }
  return mean * (y1 - y0) * c->actuator.travel;
}

/* time[i] after i panels of the timed part of the stroke */
static void stroke_times(const paper_case *c, int direction, double time[PANELS + 1])
{
  double step = (STROKE_TO - STROKE_FROM) / PANELS;
  int i;
  time[0] = 0.0;
  for (i = 0; i < PANELS; i++)
    time[i + 1] = time[i] + panel_time(c, direction, STROKE_FROM + i * step, STROKE_FROM + (i + 1) * step);
}

double paper_stroke_time(const paper_case *c, int direction)
{
  const paper_actuator *a = &c->actuator;
  double time[PANELS + 1];
  stroke_times(c, direction, time);
  return time[PANELS] / paper_speed_scale(a->orifice, a->area, paper.temperature);
}

double paper_asymmetry(const paper_case *c)
{
  double up[PANELS + 1], down[PANELS + 1], sum = 0.0;
  int i;
  stroke_times(c, PAPER_UP, up);
  stroke_times(c, PAPER_DOWN, down);
  for (i = 1; i < PANELS; i++) /* the curves meet at both ends */
    sum += fabs(up[i] / up[PANELS] - down[i] / down[PANELS]);
  return sum / PANELS;
}

/* a falling stroke that cannot finish counts as slower */
static int falls_slower(const paper_case *c, double p_bl, double width)
{
  paper_case trial = *c;
  trial.actuator = paper_actuator_with_bench(&c->actuator, p_bl, p_bl + width);
  return !(paper_stroke_time(&trial, PAPER_DOWN) <= paper_stroke_time(&trial, PAPER_UP));
}

double paper_symmetric_bench(const paper_case *c)
{
  const paper_actuator *a = &c->actuator;
  double width = a->bench_high - a->bench_low;
  double lo = 0.0, hi = a->supply - width - a->friction / a->area;
  int i;
  if (falls_slower(c, hi, width) || !falls_slower(c, lo, width))
    return (double)NAN;
  for (i = 0; i < HALVINGS; i++) {
    double p_bl = 0.5 * (lo + hi);
    *(falls_slower(c, p_bl, width) ? &lo : &hi) = p_bl;
  }
  return 0.5 * (lo + hi);
}

/* ---- Curves of figures 5 to 8 ---- */

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

/* Every number and claim of the paper that algebra can check, beside ours.
 *
 * A row names its formula and the constants it starts from; the verdict follows from the relation,
 * so that no verdict is typed except for matters of form. The thresholds for words such as "roughly
 * constant" are in PAPER.md 1.
 *
 * SPDX-License-Identifier: MIT */
#include "paper.h"

#include <math.h>

#define NONE ((double)NAN)
enum { ARGS = 5 };

static double constant(int id)
{
  return paper_constants[id].value;
}

/* What a formula gets: an actuator of Table A1 and constants. */
typedef struct given {
  paper_actuator act;
  double a[ARGS];
} given;

typedef double (*formula)(const given *g);

/* How the computed number must stand to the printed or implied one. */
enum relation { SAME, AT_MOST, AT_LEAST, MORE, FORM };

/* Why a claim does not agree. */
#define X(name, kind, words) name,
enum cause {
  AGREES,
#include "paper_causes.def"
};
#undef X

#define ARITHMETIC           "arithmetic"
#define DERIVATION           "derivation"
#define DATA                 "data"
#define MODELLING            "modelling"
#define X(name, kind, words) [name] = {kind, words},
static const struct {
  const char *kind, *words;
} causes[] = {
    [AGREES] = {"", ""},
#include "paper_causes.def"
};
#undef X

typedef struct claim {
  const char *item, *quantity, *unit;
  double printed, digit; /* in `unit`; digit: unit of the last printed place, or what MORE must exceed */
  double slack;          /* what rounding on the way may add */
  int relation;          /* of the computed number to `printed`, */
  double bound;          /* or to this where nothing is printed */
  double per;            /* SI value of `unit` */
  formula compute;
  int actuator;
  int arg[ARGS]; /* enum paper_constant_id */
  int cause;     /* enum cause */
  const char *note;
} claim;

/* ---- Helpers ---- */

static paper_case case_of(const paper_actuator *act, paper_flow flow, double storage)
{
  paper_case c;
  c.actuator = *act;
  c.flow = flow;
  c.P_a = constant(PAPER_AMBIENT);
  c.storage = storage;
  return c;
}

/* actuator of Table A1 on the spring that its bench set implies, without dry friction */
static paper_case frictionless(const given *g, double storage)
{
  paper_actuator act = paper_actuator_with_bench(&g->act, g->act.bench_low, g->act.bench_high);
  act.friction = 0.0;
  return case_of(&act, paper_flow_unchoked, storage);
}

static double larger_over_smaller(double a, double b)
{
  return fmax(a, b) / fmin(a, b);
}

/* ---- Formulae: a[i] are the constants in the order of the row ---- */

static double first(const given *g)
{
  return g->a[0];
}

static double difference(const given *g)
{
  return g->a[1] - g->a[0];
}

static double quotient(const given *g)
{
  return g->a[0] / g->a[1];
}

static double nothing(const given *g)
{
  (void)g;
  return NONE;
}

/* Section 3: assumptions. */

/* (k_f + lambda) v_max / F, with v_max where the stem leaves the lower stop */
static double viscous_share(const given *g)
{
  paper_case c = frictionless(g, 0.0);
  double scale = paper_speed_scale(g->act.orifice, g->act.area, constant(PAPER_TEMPERATURE));
  double v = scale * paper_speed(&c, PAPER_UP, 0.0);
  return (constant(PAPER_VISCOUS) + constant(PAPER_DAMPING)) * v / constant(PAPER_FRICTION);
}

/* P_dn/P_up over the critical ratio, when filling starts */
static double fill_start(const given *g)
{
  double P_a = constant(PAPER_AMBIENT);
  return P_a / (g->act.supply + P_a) / paper_choking_ratio();
}

/* the same when venting from the top of the bench set */
static double vent_start(const given *g)
{
  double P_a = constant(PAPER_AMBIENT);
  return P_a / (g->act.bench_high + P_a) / paper_choking_ratio();
}

static double unchoked_excess(const given *g)
{
  double P_a = constant(PAPER_AMBIENT), P_s = g->act.supply + P_a;
  return paper_flow_unchoked(P_s, P_a) / paper_flow_choked(P_s, P_a);
}

/* Section 4: balance of forces and mass. */

/* at x = 0, p = 0, v = 0 Eq. (2) leaves m x'' = -k x_0 */
static double start_acceleration(const given *g)
{
  return -g->act.rate * g->act.preload / constant(PAPER_MASS);
}

/* up 0..x_n and back: f(x) is the same both ways */
static double friction_work_printed(const given *g)
{
  double x = g->act.travel;
  double up = constant(PAPER_FRICTION) * x + 0.5 * constant(PAPER_VISCOUS) * x * x;
  double down = -up;
  return up + down;
}

/* (p A - F)/k of Eq. (4) minus the balance (p A - F)/k - x_0 */
static double travel_excess(const given *g)
{
  double p = g->act.bench_high;
  double eq4 = (p * g->act.area - constant(PAPER_FRICTION)) / g->act.rate;
  double balance = (p * g->act.area - constant(PAPER_FRICTION) - g->act.rate * g->act.preload) / g->act.rate;
  return eq4 - balance;
}

/* V dp/dt over P dV/dt at the top of the travel */
static double storage_share(const given *g)
{
  paper_case c = frictionless(g, 1.0);
  double P = paper_pressure(&c, PAPER_UP, c.actuator.travel) + c.P_a;
  double V = c.actuator.dead_volume + c.actuator.area * c.actuator.travel;
  return V * c.actuator.rate / (c.actuator.area * c.actuator.area * P);
}

/* Eq. (13) over Eq. (12) where the stem starts */
static double eq13_excess(const given *g)
{
  double P_a = constant(PAPER_AMBIENT), ratio = (g->act.supply + P_a) / (g->act.bench_low + P_a);
  return ratio / paper_fill_speed(paper_flow_unchoked, ratio, 1.0);
}

/* d ln v/d ln P_2 of Eq. (12) in the middle of the bench set: -1 - P_2/(2 (P_1 - P_2)) */
static double fill_exponent(const given *g)
{
  double middle = 0.5 * (g->act.bench_low + g->act.bench_high);
  return -1.0 - (middle + constant(PAPER_AMBIENT)) / (2.0 * (g->act.supply - middle));
}

static double fill_ends(const given *g)
{
  paper_case c = frictionless(g, 0.0);
  return larger_over_smaller(paper_speed(&c, PAPER_UP, 0.0), paper_speed(&c, PAPER_UP, c.actuator.travel));
}

/* velocity at the upper stop over that at the start of the stroke */
static double fill_end_over_start(const given *g)
{
  paper_case c = frictionless(g, 0.0);
  return paper_speed(&c, PAPER_UP, c.actuator.travel) / paper_speed(&c, PAPER_UP, 0.0);
}

/* Eq. (14) where the stem starts over Eq. (15) */
static double start_over_maximum(const given *g)
{
  double P_a = constant(PAPER_AMBIENT), P_s = g->act.supply + P_a;
  return paper_fill_speed(paper_flow_unchoked, P_s, g->act.bench_low + P_a) /
         paper_fill_speed(paper_flow_unchoked, P_s, P_a);
}

/* v_max/p_s of Eq. (15), in units of the scale over p_a */
static double gain(double p_s, double p_a)
{
  return paper_fill_speed(paper_flow_unchoked, p_s + p_a, p_a) * p_a / p_s;
}

static double gain_spread(const given *g)
{
  return larger_over_smaller(gain(g->a[0], g->a[2]), gain(g->a[1], g->a[2]));
}

/* p/p_s above which Eq. (25) is within a tenth of (26): p/(p + p_a) = 0.9^2 */
static double flat_pressure(const given *g)
{
  double square = 0.9 * 0.9;
  return constant(PAPER_AMBIENT) * square / (1.0 - square) / g->act.supply;
}

/* Section 4.2: the falling edge. a: p_bl, p_bh, p_a */

static double change(const given *g)
{
  return paper_speed_change(paper_flow_unchoked, g->a[0], g->a[1], g->a[2]);
}

static double sign_of_change(const given *g)
{
  return change(g) > 0.0 ? 1.0 : -1.0;
}

/* p_a that Eq. (23) needs for the change a[2]: (p_bl/p_bh)(p_bh + p_a) = (1 - c)^2 (p_bl + p_a) */
static double needed_ambient(const given *g)
{
  double p_bl = g->a[0], p_bh = g->a[1], square = (1.0 - g->a[2]) * (1.0 - g->a[2]);
  return p_bl * p_bh * (1.0 - square) / (square * p_bh - p_bl);
}

/* 1 - v(n p_a)/v(infinity) of Eq. (25) */
static double flat_tail(const given *g)
{
  return 1.0 - paper_vent_speed(paper_flow_unchoked, g->a[0] + 1.0, 1.0);
}

/* Eq. (25) at p = p_s */
static double vent_at_supply(const given *g)
{
  return paper_vent_speed(paper_flow_unchoked, g->a[0] + g->a[1], g->a[1]);
}

/* p/p_a at which Eq. (25) is sqrt(0.5): y/(1 + y) = 1/2 */
static double pressure_of_half(const given *g)
{
  double square = 0.5;
  (void)g;
  return square / (1.0 - square);
}

static double vent_at_ambient(const given *g)
{
  return paper_vent_speed(paper_flow_unchoked, g->a[0], g->a[0]);
}

/* (28) over the infimum of (25), which is 0 */
static double vent_ratio(const given *g)
{
  return 1.0 / vent_at_ambient(g);
}

static double vent_ratio_printed(const given *g)
{
  (void)g;
  return 1.0 / sqrt(0.5);
}

static double vent_change(const given *g)
{
  return 1.0 - vent_at_ambient(g);
}

static double vent_change_printed(const given *g)
{
  (void)g;
  return 1.0 - sqrt(0.5);
}

static double bench_ratio(const given *g)
{
  return 1.0 / (1.0 - change(g));
}

static double vent_ends(const given *g, double storage)
{
  paper_case c = frictionless(g, storage);
  return larger_over_smaller(paper_speed(&c, PAPER_DOWN, 0.0), paper_speed(&c, PAPER_DOWN, c.actuator.travel));
}

static double vent_ends_paper(const given *g)
{
  return vent_ends(g, 0.0);
}

static double vent_ends_spring(const given *g)
{
  return vent_ends(g, 1.0);
}

/* change of velocity over pressures a[0]..a[1] on the bench set a[2]..a[3] */
static double spring_change(const given *g, double p_bl, double p_bh)
{
  paper_case c = frictionless(g, 1.0);
  double v[2];
  int i;
  c.actuator = paper_actuator_with_bench(&c.actuator, p_bl, p_bh);
  for (i = 0; i < 2; i++)
    v[i] = paper_speed(&c, PAPER_DOWN, g->a[i] * c.actuator.area / c.actuator.rate - c.actuator.preload);
  return 1.0 - v[0] / v[1];
}

/* same pressures, bench sets of 6 and 12 springs */
static double change_by_spring(const given *g)
{
  double six = spring_change(g, constant(PAPER_SPRINGS_6_LOW), constant(PAPER_SPRINGS_6_HIGH));
  double twelve = spring_change(g, constant(PAPER_SPRINGS_12_LOW), constant(PAPER_SPRINGS_12_HIGH));
  return fabs(six - twelve);
}

/* Eq. (23) over the whole travel of the two actuators of Table A1 */
static double change_by_actuator(const given *g)
{
  double P_a = constant(PAPER_AMBIENT);
  return fabs(paper_speed_change(paper_flow_unchoked, g->a[0], g->a[1], P_a) -
              paper_speed_change(paper_flow_unchoked, g->a[2], g->a[3], P_a));
}

/* mean d ln v/d ln p_s of Eq. (27) over the typical supplies */
static double supply_exponent(const given *g)
{
  double low = paper_vent_speed(paper_flow_unchoked, g->a[0] + g->a[2], g->a[2]);
  double high = paper_vent_speed(paper_flow_unchoked, g->a[1] + g->a[2], g->a[2]);
  return log(high / low) / log(g->a[1] / g->a[0]);
}

/* Section 4.3: both edges. */

static double threshold(const given *g)
{
  (void)g;
  return paper_supply_threshold(0.5);
}

static double threshold_printed(const given *g)
{
  (void)g;
  return paper_supply_threshold(sqrt(0.5));
}

/* s (s + 1) = s/(s + 1): (s + 1)^2 = 1 */
static double threshold_of_maxima(const given *g)
{
  (void)g;
  return sqrt(1.0) - 1.0;
}

static double lowest_supply(const given *g)
{
  return fmin(g->a[0], g->a[1]) / g->a[2];
}

static double fastest_up_over_slowest_down(const given *g)
{
  paper_case c = frictionless(g, 0.0);
  return paper_speed(&c, PAPER_UP, 0.0) / paper_speed(&c, PAPER_DOWN, 0.0);
}

/* a: p_bh, p_s, p_a; both velocities at the top of the bench set */
static double slowest_up_over_fastest_down(const given *g)
{
  paper_flow flow = paper_flow_unchoked;
  double P = g->a[0] + g->a[2];
  return paper_fill_speed(flow, g->a[1] + g->a[2], P) / paper_vent_speed(flow, P, g->a[2]);
}

/* a: p_s, p_a */
static double critical_ratio(const given *g)
{
  return paper_critical_pressure(g->a[1] / g->a[0]);
}

static double critical_pressure(const given *g)
{
  return g->a[0] * critical_ratio(g);
}

/* the left side of (36) is (sqrt(4 (a + 1)^2 + 1) - (2 a + 1))/2: it falls from 1 at a = -1 towards 1/2 */
static double far_bound(const given *g)
{
  (void)g;
  return paper_critical_pressure(1e6);
}

static double ratio_at_critical(const given *g)
{
  paper_flow flow = paper_flow_unchoked;
  double P = critical_pressure(g) + g->a[1];
  return paper_fill_speed(flow, g->a[0] + g->a[1], P) / paper_vent_speed(flow, P, g->a[1]);
}

/* p_a/p_s at which the left side of (37) is 1, by bisection: it falls */
static double upper_bound_threshold(const given *g)
{
  double lo = -1.4, hi = 0.0;
  int i;
  (void)g;
  for (i = 0; i < 60; i++) {
    double a = 0.5 * (lo + hi);
    if (paper_critical_pressure(a) > 1.0)
      lo = a;
    else
      hi = a;
  }
  return 0.5 * (lo + hi);
}

static double critical_limit(const given *g)
{
  (void)g;
  return paper_critical_pressure(0.0);
}

/* a: p_s, p_a */
static double critical_ratio_choked(const given *g)
{
  return paper_crossing(paper_flow_choked, g->a[1] / g->a[0]);
}

static double critical_spread(const given *g)
{
  return larger_over_smaller(paper_critical_pressure(g->a[2] / g->a[0]), paper_critical_pressure(g->a[2] / g->a[1]));
}

/* a: p_s, p_a, p_bh */
static double room_below_critical(const given *g)
{
  return critical_pressure(g) - g->a[2];
}

/* a: p_s, p_a, p_bl, p_bh; distance of the critical pressure from the nearer end, > 0 inside */
static double critical_inside(const given *g)
{
  double p = critical_pressure(g);
  return fmin(p - g->a[2], g->a[3] - p);
}

/* asymmetry on the bench set whose strokes take equal time over that on the nominal one */
static double symmetrized(const given *g)
{
  paper_actuator act = paper_actuator_with_bench(&g->act, g->act.bench_low, g->act.bench_high);
  paper_case nominal = case_of(&act, paper_flow_unchoked, 1.0), equal = nominal;
  double p_bl = paper_symmetric_bench(&nominal);
  equal.actuator = paper_actuator_with_bench(&act, p_bl, p_bl + act.bench_high - act.bench_low);
  return paper_asymmetry(&equal) / paper_asymmetry(&nominal);
}

/* falling stem: velocity at the end of the stroke over that at its start */
static double fall_end_over_start(const given *g)
{
  paper_case c = frictionless(g, 1.0);
  return paper_speed(&c, PAPER_DOWN, 0.0) / paper_speed(&c, PAPER_DOWN, c.actuator.travel);
}

/* Section 5: energy. */

/* left minus right side of (42) */
static double eq42_margin(const given *g)
{
  const paper_actuator *act = &g->act;
  double force = act->area * act->supply;
  return force * act->travel - 0.5 * force * force / act->rate;
}

static double eq43_travel(const given *g)
{
  return g->act.area * g->act.supply / g->act.rate;
}

/* bench set 0..p_s: no preload and x_n = A p_s/k */
static double returned_as_assumed(const given *g)
{
  return paper_returned_share(0.0, g->act.supply, g->act.supply);
}

static double kept_share(const given *g)
{
  return 1.0 - paper_returned_share(g->act.bench_low, g->act.bench_high, g->act.supply);
}

/* up: p_s A - k (x + x_0) on the load; down: k (x + x_0); the sum over A p_s x_n */
static double loaded_efficiency(const given *g)
{
  const paper_actuator *act = &g->act;
  double spring = act->rate * act->travel * (act->preload + 0.5 * act->travel);
  double input = act->area * act->supply * act->travel;
  return ((input - spring) + spring) / input;
}

static double exergy_efficiency(const given *g)
{
  return paper_exergy_efficiency(g->act.supply, constant(PAPER_AMBIENT));
}

/* less the dry friction of both strokes */
static double loaded_with_friction(const given *g)
{
  return loaded_efficiency(g) - 2.0 * constant(PAPER_FRICTION) / (g->act.area * g->act.supply);
}

/* Section 7 and Table A1. */

static double share_of_supply_force(const given *g)
{
  return g->a[0] / (g->act.supply * g->act.area);
}

static double share_of_spring_stroke(const given *g)
{
  return g->a[0] / (g->act.rate * g->act.travel);
}

static double preload_force(const given *g)
{
  return g->act.rate * g->act.preload;
}

/* stem position at supply pressure without a stop, over the nominal travel */
static double reach(const given *g)
{
  const paper_actuator *act = &g->act;
  return ((act->supply * act->area - constant(PAPER_FRICTION)) / act->rate - act->preload) / act->travel;
}

/* a: p_bl, p_bh */
static double spring_rate(const given *g)
{
  return paper_actuator_with_bench(&g->act, g->a[0], g->a[1]).rate;
}

static double preload_of_bench(const given *g)
{
  return paper_actuator_with_bench(&g->act, g->a[0], g->a[1]).preload;
}

static double preload_of_rate(const given *g)
{
  return g->a[0] * g->act.area / g->act.rate;
}

/* a: p_bh; from x_0/x_n, whatever the spring: p_bl = p_bh x_0/(x_0 + x_n) */
static double bench_low_of_travel(const given *g)
{
  return g->a[0] * g->act.preload / (g->act.preload + g->act.travel);
}

static double bench_low_of_rate(const given *g)
{
  return g->act.rate * g->act.preload / g->act.area;
}

static double bench_high_of_rate(const given *g)
{
  return g->act.rate * (g->act.preload + g->act.travel) / g->act.area;
}

static double room_above_bench(const given *g)
{
  return g->act.supply - g->a[0] - constant(PAPER_FRICTION) / g->act.area;
}

static double swept_volume(const given *g)
{
  return g->act.area * g->act.travel;
}

static double dead_gap(const given *g)
{
  return g->act.dead_volume / g->act.area;
}

/* Values from elsewhere: CODATA 2018 (exact); dry air of Picard et al. 2008, Metrologia 45:149; the
 * standard atmosphere; 7/5 of a rigid diatomic gas; 25 degC. */

static double gas_constant(const given *g)
{
  (void)g;
  return 8.31446261815324;
}

static double molar_mass(const given *g)
{
  (void)g;
  return 28.96546e-3;
}

static double standard_atmosphere(const given *g)
{
  (void)g;
  return 101325.0;
}

static double diatomic(const given *g)
{
  (void)g;
  return 7.0 / 5.0;
}

static double room_temperature(const given *g)
{
  (void)g;
  return 273.15 + 25.0;
}

/* ---- The claims ---- */

#define TENTH   0.1 /* "negligible", "roughly", "approximately", "almost": PAPER.md 1 */
#define R1      PAPER_R1_400
#define M37     PAPER_37_13
#define C(name) PAPER_##name

static const claim claims[] = {
#include "paper_claims.def"
};

enum { CLAIMS = sizeof claims / sizeof claims[0] };

/* ---- Verdicts ---- */

static const char *const word[2] = {"no", "yes"};

const char *paper_agreement(double printed, double computed, double digit, double slack)
{
  double off = fabs(printed - computed) - 1e-9 * fabs(printed); /* a tie is decided by print, not by the last bit */
  if (off <= 0.5 * digit)
    return word[1];
  return off <= 0.5 * digit + slack ? "rounding" : word[0];
}

static const char *judge(const claim *c, double computed)
{
  double target = isnan(c->printed) ? c->bound : c->printed;
  const char *verdict[] = {
      [SAME] = paper_agreement(target, computed, c->digit, c->slack),
      [AT_MOST] = word[computed <= target],
      [AT_LEAST] = word[computed >= target],
      [MORE] = word[computed > target + c->digit],
      [FORM] = word[0],
  };
  return verdict[c->relation];
}

static double evaluate(const claim *c)
{
  given g;
  int i;
  g.act = paper_actuator_printed(c->actuator);
  for (i = 0; i < ARGS; i++)
    g.a[i] = constant(c->arg[i]);
  return c->compute(&g) / c->per;
}

static paper_row row_of(const claim *c)
{
  double computed = evaluate(c);
  paper_row row = {c->item,
                   c->quantity,
                   c->unit,
                   c->printed,
                   computed,
                   judge(c, computed),
                   c->note,
                   causes[c->cause].kind,
                   causes[c->cause].words};
  return row;
}

size_t paper_numbers(paper_row *rows, size_t room)
{
  size_t i;
  for (i = 0; i < CLAIMS && i < room; i++)
    rows[i] = row_of(&claims[i]);
  return CLAIMS;
}

void paper_row_add(table *t, const paper_row *row)
{
  table_row(t, "sssggssss", row->item, row->quantity, row->unit, row->printed, row->computed, row->agrees, row->note,
            row->kind, row->cause);
}

void paper_numbers_table(table *t)
{
  paper_row row[CLAIMS];
  size_t i, n = paper_numbers(row, CLAIMS);
  table_open(t, PAPER_ROW_HEADER);
  for (i = 0; i < n; i++)
    paper_row_add(t, &row[i]);
}

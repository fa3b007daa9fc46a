/* Every number and claim of the paper that algebra can check, beside ours.
 *
 * study/paper/claims.csv has the claims in words, here is what the equations give for each; the verdict follows from
 * the relation that the claim names, so that no verdict is typed except for matters of form. Thresholds for words such
 * as "roughly constant" are in PAPER.md 1.
 *
 * SPDX-License-Identifier: MIT */
#include "paper.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "../lab/base/names.h"

/* Pressures of Table 1 [Pa]. */
typedef struct springs {
  double low, high;
} springs;

static const springs three = {20e3, 100e3}, six = {80e3, 240e3}, twelve = {180e3, 380e3};

/* ---- Formulae that take more than a line ---- */

static double larger_over_smaller(double a, double b)
{
  return fmax(a, b) / fmin(a, b);
}

static double fill(double P_s, double P)
{
  return paper_fill_speed(paper_flow_unchoked, P_s, P);
}

static double vent(double P, double P_a)
{
  return paper_vent_speed(paper_flow_unchoked, P, P_a);
}

static paper_actuator with_bench(const paper_actuator *act)
{
  return paper_actuator_with_bench(act, act->bench_low, act->bench_high);
}

/* On the spring that the bench set implies, without dry friction. */
static paper_case frictionless(const paper_actuator *act, double storage)
{
  paper_case c = {with_bench(act), paper_flow_unchoked, paper.ambient, storage};
  c.actuator.friction = 0.0;
  return c;
}

/* Velocity of that at a share of its travel. */
static double speed(const paper_actuator *act, double storage, int direction, double share)
{
  const paper_case c = frictionless(act, storage);
  return paper_speed(&c, direction, share * c.actuator.travel);
}

static double ends(const paper_actuator *act, double storage, int direction)
{
  return larger_over_smaller(speed(act, storage, direction, 0.0), speed(act, storage, direction, 1.0));
}

/* (k_f + lambda) v_max / F, with v_max where the stem leaves the lower stop */
static double viscous_share(const paper_actuator *act)
{
  const double scale = paper_speed_scale(act->orifice, act->area, paper.temperature);
  return (paper.viscous + paper.damping) * (scale * speed(act, 0.0, PAPER_UP, 0.0)) / act->friction;
}

/* up 0..x_n and back: f(x) is the same both ways */
static double friction_work_printed(const paper_actuator *act)
{
  const double up = act->friction * act->travel + 0.5 * paper.viscous * act->travel * act->travel;
  return up + -up;
}

/* (p A - F)/k of Eq. (4) minus x + x_0 of the balance of Eq. (2), k (x + x_0) = p A - F */
static double travel_excess(const paper_actuator *act)
{
  const double force = act->bench_high * act->area - act->friction;
  return force / act->rate - ((force - act->rate * act->preload) / act->rate + act->preload);
}

/* V dp/dt over P dV/dt at the top of the travel */
static double storage_share(const paper_actuator *act)
{
  const paper_case c = frictionless(act, 1.0);
  const double P = paper_pressure(&c, PAPER_UP, act->travel) + c.P_a, V = act->dead_volume + act->area * act->travel;
  return V * c.actuator.rate / (act->area * act->area * P);
}

/* Eq. (13) over Eq. (12) where the stem starts */
static double eq13_excess(const paper_actuator *act)
{
  const double ratio = (act->supply + paper.ambient) / (act->bench_low + paper.ambient);
  return ratio / fill(ratio, 1.0);
}

/* d ln v/d ln P_2 of Eq. (12) in the middle of the bench set: -1 - P_2/(2 (P_1 - P_2)) */
static double fill_exponent(const paper_actuator *act)
{
  const double middle = 0.5 * (act->bench_low + act->bench_high);
  return -1.0 - (middle + paper.ambient) / (2.0 * (act->supply - middle));
}

/* v_max/p_s of Eq. (15), in units of the scale over p_a */
static double gain(double p_s)
{
  const double p_a = paper.example_ambient;
  return fill(p_s + p_a, p_a) * p_a / p_s;
}

/* Eq. (23) */
static double change(const springs *s)
{
  return paper_speed_change(paper_flow_unchoked, s->low, s->high, paper.example_ambient);
}

/* the same over the whole travel of an actuator of Table A1 */
static double actuator_change(const paper_actuator *act)
{
  return paper_speed_change(paper_flow_unchoked, act->bench_low, act->bench_high, paper.ambient);
}

/* p_a that Eq. (23) needs for a change: (p_bl/p_bh)(p_bh + p_a) = (1 - c)^2 (p_bl + p_a) */
static double needed_ambient(const springs *s, double c)
{
  const double square = (1.0 - c) * (1.0 - c);
  return s->low * s->high * (1.0 - square) / (square * s->high - s->low);
}

/* change of velocity on a bench set over the pressures that 6 and 12 springs share */
static double spring_change(const paper_actuator *act, const springs *s)
{
  paper_case c = frictionless(act, 1.0);
  double x[2];
  c.actuator = paper_actuator_with_bench(&c.actuator, s->low, s->high);
  x[0] = twelve.low * act->area / c.actuator.rate - c.actuator.preload;
  x[1] = six.high * act->area / c.actuator.rate - c.actuator.preload;
  return 1.0 - paper_speed(&c, PAPER_DOWN, x[0]) / paper_speed(&c, PAPER_DOWN, x[1]);
}

/* (14) over (25) at a pressure */
static double edges_at(double p, double p_s)
{
  const double p_a = paper.example_ambient;
  return fill(p_s + p_a, p + p_a) / vent(p + p_a, p_a);
}

/* p/p_s of (35) */
static double critical(double p_s)
{
  return paper_critical_pressure(paper.example_ambient / p_s);
}

/* p_a/p_s at which the left side of (37) is 1, by bisection: it falls */
static double upper_bound_threshold(void)
{
  double lo = -1.4, hi = 0.0;
  int i;
  for (i = 0; i < 60; i++) {
    const double a = 0.5 * (lo + hi);
    *(paper_critical_pressure(a) > 1.0 ? &lo : &hi) = a;
  }
  return 0.5 * (lo + hi);
}

static double fastest_down_over_first_up(const paper_actuator *act)
{
  double fastest = 0.0;
  int i;
  for (i = 0; i <= 100; i++)
    fastest = fmax(fastest, speed(act, 1.0, PAPER_DOWN, i / 100.0));
  return fastest / speed(act, 1.0, PAPER_UP, 0.0);
}

/* left minus right side of (42) */
static double eq42_margin(const paper_actuator *act)
{
  const double force = act->area * act->supply;
  return force * act->travel - 0.5 * force * force / act->rate;
}

/* On a bench set of the same width whose strokes take equal time. */
static paper_case symmetrized(const paper_case *c)
{
  const double low = paper_symmetric_bench(c), width = c->actuator.bench_high - c->actuator.bench_low;
  paper_case equal = *c;
  equal.actuator = paper_actuator_with_bench(&c->actuator, low, low + width);
  return equal;
}

/* up: p_s A - k (x + x_0) on the load; down: k (x + x_0); the sum over A p_s x_n */
static double loaded_efficiency(const paper_actuator *act)
{
  const double spring = act->rate * act->travel * (act->preload + 0.5 * act->travel);
  const double input = act->area * act->supply * act->travel;
  return ((input - spring) + spring) / input;
}

/* ---- Verdicts ---- */

typedef struct claim_value {
  const char *item;
  double value; /* SI */
} claim_value;

static const char *const word[2] = {"no", "yes"};

const char *paper_agreement(double printed, double computed, double digit, double slack)
{
  const double off =
      fabs(printed - computed) - 1e-9 * fabs(printed); /* a tie is decided by print, not by the last bit */
  if (off <= 0.5 * digit)
    return word[1];
  return off <= 0.5 * digit + slack ? "rounding" : word[0];
}

/* A number that may be left out. */
static double number_or_0(const table *t, size_t row, const char *column)
{
  const double value = table_number(t, row, column);
  return isnan(value) ? 0 : value;
}

/* How the computed number stands to the printed or implied one. */
static const char *judge(const table *claims, size_t row, double computed)
{
  const char *relation = table_text(claims, row, "relation");
  const double printed = table_number(claims, row, "printed"), digit = number_or_0(claims, row, "digit");
  const double target = isnan(printed) ? number_or_0(claims, row, "bound") : printed;
  if (!strcmp(relation, "same"))
    return paper_agreement(target, computed, digit, number_or_0(claims, row, "slack"));
  if (!strcmp(relation, "at most"))
    return word[computed <= target];
  if (!strcmp(relation, "at least"))
    return word[computed >= target];
  if (!strcmp(relation, "more"))
    return word[computed > target + digit];
  assert(!strcmp(relation, "wrong"));
  return word[0];
}

static double value_of(const char *item, const claim_value *value, size_t n)
{
  const int i = lab_name_index(item, value, n, sizeof *value);
  return i < 0 ? (double)NAN : value[i].value; /* a matter of form has none */
}

/* Row of a cause; the first is that of a claim that agrees. */
static size_t find_cause(const table *causes, const char *name)
{
  size_t row = table_rows(causes) - 1;
  while (row > 0 && strcmp(table_text(causes, row, "cause"), name) != 0)
    row--;
  assert(row > 0 || !*name);
  return row;
}

static void add_claim(const table *claims, size_t row, const table *causes, double value, table *t)
{
  const char *cause = table_text(claims, row, "cause"), *statement = table_text(claims, row, "statement");
  const double computed = value / table_number(claims, row, "scale");
  const size_t why = find_cause(causes, cause);
  table_row(t, "sssggsssssss", table_text(claims, row, "item"), table_text(claims, row, "quantity"),
            table_text(claims, row, "unit"), table_number(claims, row, "printed"), computed,
            judge(claims, row, computed), table_text(claims, row, "note"), table_text(causes, why, "kind"),
            table_text(causes, why, "words"), statement, table_text(causes, why, "severity"), word[*statement != 0]);
}

/* claims_csv, causes_csv; made by make */
#include "study/paper/claims.csv.inc"
#include "study/paper/causes.csv.inc"

static void add_claims(const claim_value *value, size_t n, table *t)
{
  table claims, causes;
  size_t row;
  table_load_lines(claims_csv, sizeof claims_csv / sizeof *claims_csv - 1, &claims);
  table_load_lines(causes_csv, sizeof causes_csv / sizeof *causes_csv - 1, &causes);
  for (row = 0; row < table_rows(&claims); row++)
    add_claim(&claims, row, &causes, value_of(table_text(&claims, row, "item"), value, n), t);
  t->failed |= claims.failed || causes.failed;
  table_close(&claims);
  table_close(&causes);
}

/* ---- The claims ---- */

void paper_numbers_table(table *t)
{
  const paper_actuator r1 = paper_actuators[PAPER_R1_400], m37 = paper_actuators[PAPER_37_13];
  const paper_actuator r1_bench = with_bench(&r1), m37_bench = with_bench(&m37);
  const double P_a = paper.ambient, p_a = paper.example_ambient, p_s = paper.example_supply;
  const double low = paper.typical_low, high = paper.typical_high;
  const paper_case nominal = {r1_bench, paper_flow_unchoked, P_a, 1.0};
  const paper_case equal = symmetrized(&nominal);
  const claim_value values[] = {
      {"assumption2.r1-400", viscous_share(&r1)},
      {"assumption2.37-13", viscous_share(&m37)},
      {"assumption5.r1-400.fill", P_a / (r1.supply + P_a) / paper_choking_ratio()},
      {"assumption5.r1-400.vent", P_a / (r1.bench_high + P_a) / paper_choking_ratio()},
      {"assumption5.37-13.fill", P_a / (m37.supply + P_a) / paper_choking_ratio()},
      {"assumption5.37-13.vent", P_a / (m37.bench_high + P_a) / paper_choking_ratio()},
      {"eq8.excess", paper_flow_unchoked(r1.supply + P_a, P_a) / paper_flow_choked(r1.supply + P_a, P_a)},
      {"eq2.initial_acceleration", -r1.rate * r1.preload / paper.mass},
      {"eq3.friction_loss", friction_work_printed(&r1)},
      {"eq4.preload", travel_excess(&r1)},
      {"eq10.storage", storage_share(&r1)},
      {"eq18.storage", storage_share(&m37)},
      {"eq13.excess", eq13_excess(&r1)},
      {"conclusion1.exponent", fill_exponent(&r1)},
      {"conclusion2.r1-400", ends(&r1, 0.0, PAPER_UP)},
      {"conclusion2.37-13", ends(&m37, 0.0, PAPER_UP)},
      {"conclusion3.gain", larger_over_smaller(gain(low), gain(high))},
      {"conclusion4.r1-400", speed(&r1, 0.0, PAPER_UP, 1.0) / speed(&r1, 0.0, PAPER_UP, 0.0)},
      {"conclusion4.37-13", speed(&m37, 0.0, PAPER_UP, 1.0) / speed(&m37, 0.0, PAPER_UP, 0.0)},
      {"eq15.maximum", fill(r1.supply + P_a, r1.bench_low + P_a) / fill(r1.supply + P_a, P_a)},
      {"table1.3", change(&three)},
      {"table1.6", change(&six)},
      {"table1.12", change(&twelve)},
      {"table1.3.width", three.high - three.low},
      {"table1.6.width", six.high - six.low},
      {"table1.12.width", twelve.high - twelve.low},
      {"table1.3.ambient", needed_ambient(&three, 0.290)},
      {"table1.6.ambient", needed_ambient(&six, 0.200)},
      {"table1.12.ambient", needed_ambient(&twelve, 0.175)},
      {"eq23.sign", change(&six) > 0.0 ? 1.0 : -1.0},
      {"example1.ambient", P_a},
      {"conclusion5.pressure", P_a * 0.81 / (1.0 - 0.81) / r1.supply},
      {"conclusion5.limit", vent(1.0, 0.01)},
      {"fig6.flat", 1.0 - vent(6.0, 1.0)},
      {"fig6.reach", r1.supply / P_a},
      {"fig6.band", change(&twelve)},
      {"eq29.limit", vent(p_s + p_a, p_a)},
      {"eq29.pressure", 0.5 / (1.0 - 0.5)},
      {"conclusion9.minimum", vent(P_a, P_a)},
      {"conclusion10.ratio", 1.0 / vent(P_a, P_a)},
      {"conclusion10.as_printed", 1.0 / sqrt(0.5)},
      {"conclusion10.percent", 1.0 - vent(P_a, P_a)},
      {"conclusion10.percent_as_printed", 1.0 - sqrt(0.5)},
      {"conclusion10.springs_3", 1.0 / (1.0 - change(&three))},
      {"conclusion6.spring", fabs(spring_change(&r1, &six) - spring_change(&r1, &twelve))},
      {"conclusion7.r1-400", ends(&r1, 0.0, PAPER_DOWN)},
      {"conclusion7.37-13", ends(&m37, 0.0, PAPER_DOWN)},
      {"conclusion7.r1-400.spring", ends(&r1, 1.0, PAPER_DOWN)},
      {"conclusion7.37-13.spring", ends(&m37, 1.0, PAPER_DOWN)},
      {"conclusion8.exponent", log(vent(high + p_a, p_a) / vent(low + p_a, p_a)) / log(high / low)},
      {"conclusion11.actuators", fabs(actuator_change(&r1) - actuator_change(&m37))},
      {"conclusion11.theory", fabs((1.0 - vent(P_a, P_a)) - (1.0 - vent(P_a, P_a)))},
      {"eq30.threshold", paper_supply_threshold(0.5)},
      {"eq30.threshold_as_printed", paper_supply_threshold(sqrt(0.5))},
      {"eq30.maxima", sqrt(1.0) - 1.0},
      {"eq30.practice", fmin(r1.supply, m37.supply) / P_a},
      {"conclusion12.r1-400", speed(&r1, 0.0, PAPER_UP, 0.0) / speed(&r1, 0.0, PAPER_DOWN, 0.0)},
      {"conclusion12.37-13", speed(&m37, 0.0, PAPER_UP, 0.0) / speed(&m37, 0.0, PAPER_DOWN, 0.0)},
      {"conclusion13.springs_3", edges_at(three.high, p_s)},
      {"conclusion13.springs_6", edges_at(six.high, p_s)},
      {"eq35.root", edges_at(p_s * critical(p_s), p_s)},
      {"eq36.minimum", paper_critical_pressure(1e6)},
      {"eq37.threshold", upper_bound_threshold()},
      {"eq38.limit", paper_critical_pressure(0.0)},
      {"fig8.spread", larger_over_smaller(critical(low), critical(high))},
      {"conclusion14.threshold", critical(low)},
      {"conclusion14.choked", paper_crossing(paper_flow_choked, p_a / p_s)},
      {"example2.ratio", critical(p_s)},
      {"example2.pressure", p_s * critical(p_s)},
      {"example2.springs_3", p_s * critical(p_s) - three.high},
      {"example2.springs_6", p_s * critical(p_s) - six.high},
      {"example2.springs_12", fmin(p_s * critical(p_s) - twelve.low, twelve.high - p_s * critical(p_s))},
      {"conclusion15.asymmetry", paper_asymmetry(&equal) / paper_asymmetry(&nominal)},
      {"conclusion15.slopes", paper_stroke_time(&equal, PAPER_DOWN) / paper_stroke_time(&equal, PAPER_UP)},
      {"conclusion16.fall", speed(&r1, 1.0, PAPER_DOWN, 0.0) / speed(&r1, 1.0, PAPER_DOWN, 1.0)},
      {"conclusion16.r1-400", fastest_down_over_first_up(&r1)},
      {"conclusion16.37-13", fastest_down_over_first_up(&m37)},
      {"eq42.r1-400", eq42_margin(&r1)},
      {"eq42.37-13", eq42_margin(&m37)},
      {"eq42.r1-400.bench", eq42_margin(&r1_bench)},
      {"eq42.37-13.bench", eq42_margin(&m37_bench)},
      {"eq43.travel.r1-400", r1.area * r1.supply / r1.rate},
      {"eq43.travel.37-13", m37.area * m37.supply / m37.rate},
      {"conclusion17.efficiency", paper_returned_share(0.0, r1.supply, r1.supply)},
      {"conclusion17.r1-400", 1.0 - paper_returned_share(r1.bench_low, r1.bench_high, r1.supply)},
      {"conclusion17.37-13", 1.0 - paper_returned_share(m37.bench_low, m37.bench_high, m37.supply)},
      {"conclusion17.r1-400.spring", 1.0 - r1.rate * (r1.preload + 0.5 * r1.travel) / (r1.area * r1.supply)},
      {"conclusion17.37-13.spring", 1.0 - m37.rate * (m37.preload + 0.5 * m37.travel) / (m37.area * m37.supply)},
      {"conclusion17.maximum", loaded_efficiency(&r1)},
      {"conclusion17.exergy.r1-400", paper_exergy_efficiency(r1.supply, P_a)},
      {"conclusion17.exergy.37-13", paper_exergy_efficiency(m37.supply, P_a)},
      {"eq44.initial_energy", 0.5 * r1.rate * r1.preload * r1.preload / (r1.area * r1.supply * r1.travel)},
      {"conclusion18.bound", loaded_efficiency(&r1) - 2.0 * r1.friction / (r1.area * r1.supply)},
      {"hypothesis2.force_share", 4000.0 / (r1.supply * r1.area)},
      {"hypothesis2.spring_share", 4000.0 / (r1.rate * r1.travel)},
      {"hypothesis2.range", r1.rate * r1.preload},
      {"hypothesis3.reach", ((r1.supply * r1.area - r1.friction) / r1.rate - r1.preload) / r1.travel},
      {"fig18.1.width", 240e3 - 80e3},
      {"fig18.2.width", 280e3 - 120e3},
      {"fig18.3.width", 320e3 - 160e3},
      {"fig18.4.width", 360e3 - 200e3},
      {"fig18.spring_rate", paper_actuator_with_bench(&r1, 200e3, 360e3).rate},
      {"fig18.reach", r1.supply - 360e3 - r1.friction / r1.area},
      {"a1.gas_constant", 8.31446261815324 /* CODATA 2018, exact */},
      {"a1.molar_mass", 28.96546e-3 /* dry air of Picard et al. 2008, Metrologia 45:149 */},
      {"a1.ambient", 101325.0},
      {"a1.heat_ratio", 7.0 / 5.0},
      {"a1.temperature", 273.15 + 25.0},
      {"a1.r1-400.volume", r1.area * r1.travel},
      {"a1.37-13.volume", m37.area * m37.travel},
      {"a1.r1-400.dead_gap", r1.dead_volume / r1.area},
      {"a1.37-13.dead_gap", m37.dead_volume / m37.area},
      {"a1.r1-400.bench_low", r1.bench_high * r1.preload / (r1.preload + r1.travel)},
      {"a1.r1-400.bench_low_of_spring", r1.rate * r1.preload / r1.area},
      {"a1.r1-400.bench_high_of_spring", r1.rate * (r1.preload + r1.travel) / r1.area},
      {"a1.37-13.bench_low_of_spring", m37.rate * m37.preload / m37.area},
      {"a1.37-13.bench_high_of_spring", m37.rate * (m37.preload + m37.travel) / m37.area},
      {"a1.r1-400.spring_rate", r1_bench.rate},
      {"a1.37-13.spring_rate", m37_bench.rate},
      {"a1.r1-400.preload", r1.bench_low * r1.area / r1.rate},
      {"a1.r1-400.preload_of_bench", r1_bench.preload},
      {"a1.37-13.preload", m37.bench_low * m37.area / m37.rate},
      {"a1.37-13.preload_of_bench", m37_bench.preload},
  };
  table_open(t, "item,quantity,unit,printed,computed,agrees,note,kind,cause,statement,severity,counted");
  add_claims(values, sizeof values / sizeof *values, t);
}

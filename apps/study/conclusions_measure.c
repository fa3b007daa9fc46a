#include "conclusions_measure.h"

#include <math.h>

#include "conclusions.h"
#include "paper.h"

static const double kPa = 1e3;

static const lab_rig *rig_of(const conclusion_trial *t, int a)
{
  return &t->s->actuator[a];
}

static const char *name_of(const conclusion_trial *t, int a)
{
  return rig_of(t, a)->name;
}

static pneu_params params_of(const conclusion_trial *t, int a)
{
  return rig_of(t, a)->params;
}

static int run(const conclusion_trial *t, int a, const pneu_params *p, speed_pair *pair, lab_error *error)
{
  const pneu_laws laws = study_laws(rig_of(t, a), t->gas, t->flow);
  return speeds_measure(p, &laws, pair, error) ? lab_fail_in(error, "%s", name_of(t, a)) : LAB_OK;
}

static const char *comma(int a)
{
  return a ? ", " : "";
}

int conclusion_trial_run(const study *s, int gas, int flow, conclusion_trial *t, lab_error *error)
{
  int a;
  t->s = s;
  t->gas = gas;
  t->flow = flow;
  t->n = s->n_actuators;
  for (a = 0; a < t->n; a++) {
    const pneu_laws laws = study_laws(rig_of(t, a), gas, flow);
    const pneu_params p = params_of(t, a);
    if (run(t, a, &p, &t->nominal[a], error))
      return error->status;
    if (bench_scan_run(rig_of(t, a), &laws, &t->scan[a], error))
      return lab_fail_in(error, "%s", name_of(t, a));
  }
  return LAB_OK;
}

/* ---- Rising edge: conclusions 1 to 4 ---- */

int conclusion_inverse(const conclusion_trial *t, const conclusion *c, finding *f, lab_error *error)
{
  int a;
  (void)c;
  finding_condition(f, "the supply is ten times the nominal");
  finding_note(f, "with ten times the supply ");
  for (a = 0; a < t->n; a++) {
    pneu_params p = params_of(t, a);
    speed_pair far;
    double slope;
    finding_add(f, speed_exponent(&t->nominal[a].up, p.ambient_pressure), "%s", name_of(t, a));
    p.supply_pressure *= 10;
    p.fill_area /= 10;
    if (run(t, a, &p, &far, error))
      return error->status;
    slope = speed_exponent(&far.up, p.ambient_pressure);
    finding_add_conditioned(f, slope);
    finding_note(f, "%s%.3g", comma(a), slope);
  }
  return LAB_OK;
}

int conclusion_rise_range(const conclusion_trial *t, const conclusion *c, finding *f, lab_error *error)
{
  int a;
  (void)c, (void)error;
  for (a = 0; a < t->n; a++) {
    const speed_edge *up = &t->nominal[a].up;
    finding_add(f, speed_max(up) / speed_min(up), "%s", name_of(t, a));
    finding_note(f, "%s%.3g..%.3g mm/s", comma(a), 1e3 * speed_min(up), 1e3 * speed_max(up));
  }
  return LAB_OK;
}

enum { SUPPLIES = 9 };

/* v(5 %)/p_s at supplies in equal ratios from the least that finishes the stroke, but not below 140 kPa, to 800 kPa:
 * the supplies that the paper calls typical. */
static int supply_ratios(const conclusion_trial *t, int a, double p_s[SUPPLIES], double ratio[SUPPLIES],
                         lab_error *error)
{
  pneu_params p = params_of(t, a);
  const double last = (p.spring_rate * (p.stroke + p.spring_preload) + p.dry_friction) / p.area;
  const double top = paper_constants[PAPER_TYPICAL_HIGH].value;
  const double low = fmin(fmax(1.1 * last, paper_constants[PAPER_TYPICAL_LOW].value), top);
  speed_pair pair;
  int i;
  for (i = 0; i < SUPPLIES; i++) {
    p_s[i] = p.supply_pressure = low * pow(top / low, i / (SUPPLIES - 1.0));
    if (run(t, a, &p, &pair, error))
      return error->status;
    ratio[i] = pair.up.v[0] / p_s[i];
  }
  return LAB_OK;
}

/* Largest over smallest from entry i on. */
static double spread_from(const double ratio[SUPPLIES], int i)
{
  double least = ratio[i], most = ratio[i];
  for (; i < SUPPLIES; i++) {
    least = fmin(least, ratio[i]);
    most = fmax(most, ratio[i]);
  }
  return most / least;
}

int conclusion_supply(const conclusion_trial *t, const conclusion *c, finding *f, lab_error *error)
{
  int a, i;
  finding_condition(f, "p_s is above ");
  finding_note(f, "up to %g kPa", paper_constants[PAPER_TYPICAL_HIGH].value / kPa);
  for (a = 0; a < t->n; a++) {
    double p_s[SUPPLIES], ratio[SUPPLIES];
    if (supply_ratios(t, a, p_s, ratio, error))
      return error->status;
    finding_add(f, spread_from(ratio, 0), "%s from %.3g kPa", name_of(t, a), p_s[0] / kPa);
    for (i = 0; i + 1 < SUPPLIES && spread_from(ratio, i) > c->high && 2 * p_s[i + 1] <= p_s[SUPPLIES - 1]; i++)
      ;
    finding_add_conditioned(f, spread_from(ratio, i));
    finding_condition(f, "%s%.3g kPa (%s)", comma(a), p_s[i] / kPa, name_of(t, a));
    finding_note(f, ", %.3g from %.3g kPa (%s)", spread_from(ratio, i), p_s[i] / kPa, name_of(t, a));
  }
  return LAB_OK;
}

static double last_over_first(const speed_edge *e)
{
  return e->arrival / e->v[0];
}

int conclusion_last_rise(const conclusion_trial *t, const conclusion *c, finding *f, lab_error *error)
{
  int a;
  (void)c;
  finding_condition(f, "the stop is beyond the reach of the supply");
  finding_note(f, "without the stop ");
  for (a = 0; a < t->n; a++) {
    pneu_params p = params_of(t, a);
    speed_pair far;
    finding_add(f, last_over_first(&t->nominal[a].up), "%s", name_of(t, a));
    p.stroke = 2 * p.supply_pressure * p.area / p.spring_rate;
    if (run(t, a, &p, &far, error))
      return error->status;
    finding_add_conditioned(f, last_over_first(&far.up));
    finding_note(f, "%s%.4f", comma(a), last_over_first(&far.up));
  }
  return LAB_OK;
}

/* ---- Falling edge: conclusions 5 to 11 ---- */

int conclusion_vacuum(const conclusion_trial *t, const conclusion *c, finding *f, lab_error *error)
{
  pneu_param_info ambient;
  double least;
  int a;
  (void)c;
  pneu_param_describe(PNEU_PARAM_ambient_pressure, &ambient);
  least = ambient.lower;
  finding_note(f, "P_a = ");
  for (a = 0; a < t->n; a++) {
    pneu_params p = params_of(t, a);
    speed_pair pair;
    p.ambient_pressure = fmax(0.01 * (p.spring_rate * p.spring_preload - p.dry_friction) / p.area, least);
    if (run(t, a, &p, &pair, error))
      return error->status;
    finding_add(f, speed_max(&pair.down) / speed_min(&pair.down), "%s", name_of(t, a));
    finding_note(f, "%s%.2g kPa", comma(a), p.ambient_pressure / kPa);
  }
  return LAB_OK;
}

/* Relative change of velocity between two pressures while falling, as [B, Eq. 23]. */
static int change_between(const conclusion_trial *t, const pneu_params *p, double low, double high, double *change,
                          lab_error *error)
{
  speed_pair pair;
  if (run(t, t->s->subject, p, &pair, error))
    return error->status;
  *change = 1 - speed_at_pressure(&pair.down, low) / speed_at_pressure(&pair.down, high);
  return LAB_OK;
}

/* Pressure of Table 1, in proportion to the supply where that is not the paper's 400 kPa. */
static double of_table_1(const pneu_params *p, int constant)
{
  return paper_constants[constant].value * p->supply_pressure / paper_constants[PAPER_EXAMPLE_SUPPLY].value;
}

int conclusion_fixed_range(const conclusion_trial *t, const conclusion *c, finding *f, lab_error *error)
{
  const pneu_params nominal = params_of(t, t->s->subject);
  const double six = of_table_1(&nominal, PAPER_SPRINGS_6_LOW), six_top = of_table_1(&nominal, PAPER_SPRINGS_6_HIGH);
  const double twelve = of_table_1(&nominal, PAPER_SPRINGS_12_LOW);
  const double twelve_top = of_table_1(&nominal, PAPER_SPRINGS_12_HIGH);
  /* the range that both pass through between 6 % and 94 % of their travel */
  const double low = twelve + 0.06 * (twelve_top - twelve), high = six_top - 0.06 * (six_top - six);
  pneu_params p[4];
  double change[4];
  int i;
  (void)c;
  p[0] = p[1] = p[2] = bench_params(&nominal, six, six_top - six);
  p[3] = bench_params(&nominal, twelve, twelve_top - twelve);
  p[1].fill_area = p[1].vent_area = nominal.vent_area / 2;
  p[2].supply_pressure = 2 * nominal.supply_pressure;
  for (i = 0; i < 4; i++) {
    p[i].dry_friction = 0;
    if (change_between(t, &p[i], low, high, &change[i], error))
      return error->status;
  }
  finding_add(f, fabs(change[1] - change[0]), "half the orifice");
  finding_add(f, fabs(change[2] - change[0]), "twice the supply");
  finding_add(f, fabs(change[3] - change[0]), "12 springs for 6");
  finding_note(f, "%.3g..%.3g kPa, %.3g on 6 springs, %.3g on 12", low / kPa, high / kPa, change[0], change[3]);
  return LAB_OK;
}

/* Where the bench set saves a limit: a case for each actuator, and the words. */
static void save_by_bench(const conclusion_trial *t, int quantity, double limit, finding *f)
{
  int a;
  finding_condition(f, "the bench set starts ");
  for (a = 0; a < t->n; a++) {
    const bench_scan *scan = &t->scan[a];
    const double first = scan->from[0], last = scan->from[SCAN_POINTS - 1];
    double from = (double)NAN, to = (double)NAN;
    finding_add_conditioned(f, bench_scan_min(scan, quantity));
    bench_scan_range(scan, quantity, limit, &from, &to);
    if (from > first && to < last)
      finding_condition(f, "%sat %.3g..%.3g kPa", comma(a), from / kPa, to / kPa);
    else if (from > first)
      finding_condition(f, "%sabove %.3g kPa", comma(a), from / kPa);
    else if (to < last)
      finding_condition(f, "%sbelow %.3g kPa", comma(a), to / kPa);
    else
      finding_condition(f, "%sanywhere", comma(a));
    finding_condition(f, " (%s, %.3g kPa wide)", name_of(t, a), scan->width / kPa);
  }
}

/* Range of a quantity over the scan, to follow the values. */
static void note_scan(const conclusion_trial *t, int quantity, finding *f)
{
  int a;
  for (a = 0; a < t->n; a++) {
    const bench_scan *scan = &t->scan[a];
    finding_note(f, "%s%.3g..%.3g over bench sets %.3g kPa wide", comma(a), bench_scan_min(scan, quantity),
                 bench_scan_max(scan, quantity), scan->width / kPa);
  }
}

int conclusion_fall_range(const conclusion_trial *t, const conclusion *c, finding *f, lab_error *error)
{
  int a;
  (void)error;
  for (a = 0; a < t->n; a++) {
    const speed_edge *down = &t->nominal[a].down;
    finding_add(f, speed_max(down) / speed_min(down), "%s", name_of(t, a));
  }
  save_by_bench(t, SCAN_FALL_RANGE, c->high, f);
  note_scan(t, SCAN_FALL_RANGE, f);
  return LAB_OK;
}

int conclusion_fall_supply(const conclusion_trial *t, const conclusion *c, finding *f, lab_error *error)
{
  const double top = paper_constants[PAPER_TYPICAL_HIGH].value;
  int a;
  (void)c;
  finding_note(f, "p_s = %g..%g kPa", top / 2 / kPa, top / kPa);
  for (a = 0; a < t->n; a++) {
    pneu_params p = params_of(t, a);
    speed_pair low, high;
    p.supply_pressure = top / 2;
    if (run(t, a, &p, &low, error))
      return error->status;
    p.supply_pressure = top;
    if (run(t, a, &p, &high, error))
      return error->status;
    finding_add(f, log(speed_max(&high.down) / speed_max(&low.down)) / log(2.0), "%s", name_of(t, a));
  }
  return LAB_OK;
}

int conclusion_last_fall(const conclusion_trial *t, const conclusion *c, finding *f, lab_error *error)
{
  int a;
  (void)c;
  finding_condition(f, "p_bl > F/A");
  for (a = 0; a < t->n; a++) {
    pneu_params p = params_of(t, a);
    const speed_pair *nominal = &t->nominal[a];
    speed_pair weak;
    p.spring_preload = 0.5 * p.dry_friction / p.spring_rate;
    if (run(t, a, &p, &weak, error))
      return error->status;
    finding_add(f, nominal->down.arrival / speed_max(&nominal->down), "%s", name_of(t, a));
    finding_add(f, weak.down.arrival / speed_max(&weak.down), "%s with p_bl = %.2g kPa, F/A = %.2g kPa", name_of(t, a),
                0.5 * p.dry_friction / p.area / kPa, p.dry_friction / p.area / kPa);
    finding_add_conditioned(f, nominal->down.arrival / speed_max(&nominal->down));
  }
  return LAB_OK;
}

int conclusion_fall_change(const conclusion_trial *t, const conclusion *c, finding *f, lab_error *error)
{
  double least = HUGE_VAL, most = -HUGE_VAL;
  int a;
  (void)c, (void)error;
  for (a = 0; a < t->n; a++) {
    const speed_edge *down = &t->nominal[a].down;
    const double change = 1 - down->v[0] / down->v[SPEED_POINTS - 1];
    least = fmin(least, change);
    most = fmax(most, change);
    finding_note(f, "%s%.3g (%s)", comma(a), change, name_of(t, a));
  }
  finding_add(f, most - least, "%s", "");
  return LAB_OK;
}

/* ---- Both edges: conclusions 12 to 16 ---- */

int conclusion_first_over(const conclusion_trial *t, const conclusion *c, finding *f, lab_error *error)
{
  int a;
  (void)c, (void)error;
  for (a = 0; a < t->n; a++) {
    finding_add(f, speed_min(&t->nominal[a].down) / speed_max(&t->nominal[a].up), "%s", name_of(t, a));
    finding_add(f, bench_scan_max(&t->scan[a], SCAN_FIRST_OVER), "at worst on bench sets %.3g kPa wide",
                t->scan[a].width / kPa);
  }
  return LAB_OK;
}

int conclusion_last_over(const conclusion_trial *t, const conclusion *c, finding *f, lab_error *error)
{
  int a;
  (void)error;
  for (a = 0; a < t->n; a++) {
    finding_add(f, speed_min(&t->nominal[a].up) / speed_max(&t->nominal[a].down), "%s", name_of(t, a));
    finding_add(f, bench_scan_max(&t->scan[a], SCAN_LAST_OVER), "at worst on bench sets %.3g kPa wide",
                t->scan[a].width / kPa);
  }
  save_by_bench(t, SCAN_LAST_OVER, c->high, f);
  return LAB_OK;
}

int conclusion_crossing(const conclusion_trial *t, const conclusion *c, finding *f, lab_error *error)
{
  int a;
  (void)c;
  for (a = 0; a < t->n; a++) {
    pneu_params p = params_of(t, a);
    speed_pair pair;
    double p_equal;
    p.dry_friction = 0;
    p.stroke = 0.97 * p.supply_pressure * p.area / p.spring_rate - p.spring_preload;
    if (run(t, a, &p, &pair, error))
      return error->status;
    p_equal = speed_crossing(&pair);
    finding_add(f, p_equal / p.supply_pressure, "%s", name_of(t, a));
    finding_note(f, "%s%.3g kPa, both %.3g mm/s", comma(a), p_equal / kPa, 1e3 * speed_at_pressure(&pair.up, p_equal));
  }
  return LAB_OK;
}

int conclusion_symmetric(const conclusion_trial *t, const conclusion *c, finding *f, lab_error *error)
{
  int a;
  (void)c, (void)error;
  finding_condition(f, "durations are meant, not shapes: equal with the bench set at ");
  for (a = 0; a < t->n; a++) {
    const bench_scan *scan = &t->scan[a];
    const pneu_laws laws = study_laws(rig_of(t, a), t->gas, t->flow);
    const pneu_params p = params_of(t, a);
    double left = (double)NAN, low = bench_scan_equal(scan, &p, &laws, &left);
    finding_add(f, isnan(low) ? low : left / scan->nominal[SCAN_ASYMMETRY], "%s", name_of(t, a));
    finding_add_conditioned(f, isnan(low) ? low : 0); /* of the difference in duration nothing is left there */
    finding_condition(f, "%s%.3g..%.3g kPa (%s)", comma(a), low / kPa, (low + scan->width) / kPa, name_of(t, a));
    finding_note(f, "%s%.3g over %.3g, never below %.3g", comma(a), left, scan->nominal[SCAN_ASYMMETRY],
                 bench_scan_min(scan, SCAN_ASYMMETRY));
  }
  return LAB_OK;
}

int conclusion_fastest(const conclusion_trial *t, const conclusion *c, finding *f, lab_error *error)
{
  int a;
  (void)c, (void)error;
  finding_condition(f, "the rising edge is meant");
  for (a = 0; a < t->n; a++) {
    const double up = speed_position(speed_fastest(&t->nominal[a].up));
    finding_add(f, up, "%s up", name_of(t, a));
    finding_add(f, 1 - speed_position(speed_fastest(&t->nominal[a].down)), "%s down", name_of(t, a));
    finding_add_conditioned(f, up);
  }
  return LAB_OK;
}

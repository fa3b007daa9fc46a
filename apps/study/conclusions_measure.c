/* What is measured on simulated strokes to try the paper's conclusions. */
#include <math.h>

#include "../lab/base/array.h"
#include "conclusions.h"
#include "paper.h"

static const double kPa = 1e3;

/* ---- What is simulated ---- */

enum { NARROWEST = 500 }; /* width of the bench set over that which counts as none */

static const double margin = 0.01; /* force that moves a loaded stem, over supply pressure times area */

/* Sum of p_bl and p_bh over p_s at which an idle return is tried: a little above 1, from where conclusion 17 holds. */
static const double half_returned = 1.02;

/* Pressure of Table 1, in proportion to the supply where that is not the paper's 400 kPa. */
static double of_table_1(const pneu_params *p, double pressure)
{
  return pressure * p->supply_pressure / paper.example_supply;
}

/* On springs of Table 1. */
static pneu_params on_springs(const pneu_params *p, double low, double high)
{
  const double from = of_table_1(p, low);
  return bench_params(p, from, of_table_1(p, high) - from);
}

/* Ambient pressure is a hundredth of the lowest in the chamber, as far as the library goes. A tenth of the orifice
 * keeps viscous friction, which assumption 2 leaves out, small beside that pressure. */
static pneu_params in_vacuum(const pneu_params *nominal)
{
  pneu_params p = *nominal;
  const pneu_param_info ambient = lab_param_info(PNEU_PARAM_ambient_pressure);
  p.ambient_pressure = fmax(0.01 * bench_pressure(&p, 0, -1), ambient.lower);
  p.fill_area /= 10;
  p.vent_area /= 10;
  return p;
}

/* On a bench set of its width about the middle of the supply. */
static pneu_params centred(const pneu_params *p, double width)
{
  return bench_params(p, 0.5 * (half_returned * p->supply_pressure - width), width);
}

/* Supplies in equal ratios from the least that finishes the stroke, but not below 140 kPa, to 800 kPa: those that the
 * paper calls typical. */
static void typical_supplies(pneu_params p[CONCLUSION_SUPPLIES])
{
  const double top = paper.typical_high;
  const double low = fmin(fmax(1.1 * bench_pressure(p, p->stroke, 1), paper.typical_low), top);
  int i;
  for (i = 0; i < CONCLUSION_SUPPLIES; i++)
    p[i].supply_pressure = low * pow(top / low, i / (CONCLUSION_SUPPLIES - 1.0));
}

static void fill_variants(const pneu_params *nominal, const bench_scan *scan, pneu_params p[TRIAL_VARIANTS])
{
  int i;
  for (i = 0; i < TRIAL_VARIANTS; i++)
    p[i] = *nominal;
  p[TRIAL_FAR_SUPPLY].supply_pressure *= 10;
  p[TRIAL_FAR_SUPPLY].fill_area /= 10;
  p[TRIAL_NO_STOP].stroke = 2 * nominal->supply_pressure * nominal->area / nominal->spring_rate;
  p[TRIAL_WEAK_PRELOAD].spring_preload = 0.5 * nominal->dry_friction / nominal->spring_rate;
  p[TRIAL_WHOLE_DISCHARGE].stroke = p[TRIAL_NO_STOP].stroke;
  p[TRIAL_WHOLE_DISCHARGE].spring_preload = p[TRIAL_WEAK_PRELOAD].spring_preload;
  p[TRIAL_PROLONGED].dry_friction = 0;
  p[TRIAL_PROLONGED].stroke =
      0.97 * nominal->supply_pressure * nominal->area / nominal->spring_rate - nominal->spring_preload;
  p[TRIAL_HALF_TOP].supply_pressure = paper.typical_high / 2;
  p[TRIAL_TOP].supply_pressure = paper.typical_high;
  p[TRIAL_TWICE_AREA].area *= 2;
  for (i = TRIAL_SIX_SPRINGS; i < TRIAL_TWELVE_SPRINGS; i++)
    p[i] = on_springs(&p[i], 80e3, 240e3);
  p[TRIAL_TWELVE_SPRINGS] = on_springs(nominal, 180e3, 380e3);
  for (i = TRIAL_SIX_SPRINGS; i <= TRIAL_TWELVE_SPRINGS; i++)
    p[i].dry_friction = 0;
  p[TRIAL_HALF_ORIFICE].fill_area = p[TRIAL_HALF_ORIFICE].vent_area = nominal->vent_area / 2;
  p[TRIAL_TWICE_SUPPLY].supply_pressure *= 2;
  p[TRIAL_VACUUM] = p[TRIAL_NARROW_VACUUM] = in_vacuum(nominal);
  p[TRIAL_VACUUM] = bench_params(&p[TRIAL_VACUUM], scan->low, scan->width);
  p[TRIAL_NARROW_VACUUM] = bench_params(&p[TRIAL_NARROW_VACUUM], scan->low, scan->width / NARROWEST);
  p[TRIAL_CENTRED] = centred(nominal, scan->width);
  p[TRIAL_IDEAL].dry_friction = 0;
  p[TRIAL_IDEAL_CENTRED] = centred(&p[TRIAL_IDEAL], scan->width);
  typical_supplies(&p[TRIAL_SUPPLIES]);
}

int conclusion_trial_run(const lab_rig *rig, const pneu_laws *laws, conclusion_trial *t, lab_error *error)
{
  int i;
  t->laws = *laws;
  if (bench_scan_run(&rig->params, laws, &t->scan, error))
    return error->status;
  fill_variants(&rig->params, &t->scan, t->p);
  for (i = 0; i < TRIAL_VARIANTS; i++)
    if (speeds_measure(&t->p[i], laws, &t->pair[i], error))
      return lab_fail_in(error, "variant %d", i);
  for (i = 0; i < TRIAL_LOADED; i++)
    if (load_cycle_run(&t->p[i], laws, margin, &t->cycle[i], error))
      return error->status;
  return LAB_OK;
}

/* ---- Rising edge: conclusions 1 to 4 ---- */

/* Largest over smallest velocity of an edge. */
static double range_of(const speed_edge *e)
{
  return speed_max(e) / speed_min(e);
}

/* Saved by P_1 >> P_2. */
static void inverse(const conclusion_trial *t, finding *f)
{
  const double far = speed_exponent(&t->pair[TRIAL_FAR_SUPPLY].up, t->p->ambient_pressure);
  finding_add(f, speed_exponent(&t->pair->up, t->p->ambient_pressure), "%s", "");
  finding_add_conditioned(f, far);
  lab_append(f->condition, FINDING_TEXT, "the supply is ten times the nominal");
  lab_append(f->note, FINDING_TEXT, "with ten times the supply %.3g", far);
}

static void rise_range(const conclusion_trial *t, finding *f)
{
  const speed_edge *up = &t->pair->up;
  finding_add(f, range_of(up), "%s", "");
  lab_append(f->note, FINDING_TEXT, "%.3g..%.3g mm/s", 1e3 * speed_min(up), 1e3 * speed_max(up));
}

/* Largest over smallest v(5 %)/p_s of the supplies from the i-th on. */
static double spread_from(const conclusion_trial *t, int i)
{
  double least = HUGE_VAL, most = 0;
  for (i += TRIAL_SUPPLIES; i < TRIAL_VARIANTS; i++) {
    const double ratio = t->pair[i].up.v[0] / t->p[i].supply_pressure;
    least = fmin(least, ratio);
    most = fmax(most, ratio);
  }
  return most / least;
}

/* Saved by a range of supplies that spans at least a factor of two. */
static void supply(const conclusion_trial *t, finding *f)
{
  const pneu_params *p = &t->p[TRIAL_SUPPLIES];
  const double top = p[CONCLUSION_SUPPLIES - 1].supply_pressure;
  int i, last = CONCLUSION_SUPPLIES - 1;
  finding_add(f, spread_from(t, 0), "from %.3g kPa", p[0].supply_pressure / kPa);
  while (last > 0 && 2 * p[last].supply_pressure > top)
    last--;
  for (i = 0; i < last && spread_from(t, i) > t->limit; i++)
    ;
  finding_add_conditioned(f, spread_from(t, last));
  lab_append(f->condition, FINDING_TEXT, "p_s is above");
  lab_append(f->where, FINDING_TEXT, "%.3g kPa", p[i].supply_pressure / kPa);
  lab_append(f->note, FINDING_TEXT, "%.3g from %.3g kPa, up to %g kPa", spread_from(t, i), p[i].supply_pressure / kPa,
             top / kPa);
}

static double last_over_first(const speed_edge *e)
{
  return e->arrival / e->v[0];
}

static void last_rise(const conclusion_trial *t, finding *f)
{
  const double far = last_over_first(&t->pair[TRIAL_NO_STOP].up);
  finding_add(f, last_over_first(&t->pair->up), "%s", "");
  finding_add_conditioned(f, far);
  lab_append(f->condition, FINDING_TEXT, "the stop is beyond the reach of the supply");
  lab_append(f->note, FINDING_TEXT, "without the stop %.4f", far);
}

/* ---- Falling edge: conclusions 5 to 11 ---- */

/* Widest bench set [Pa] on which the range in vacuum is within its limit, by bisection to 2 %. */
static double widest_in_vacuum(const conclusion_trial *t)
{
  double wide = t->scan.width, width = wide / NARROWEST;
  while (wide / width > 1.02) {
    const double middle = sqrt(wide * width);
    const pneu_params p = bench_params(&t->p[TRIAL_VACUUM], t->scan.low, middle);
    speed_pair pair;
    lab_error ignored;
    if (speeds_measure(&p, &t->laws, &pair, &ignored))
      return (double)NAN;
    *(range_of(&pair.down) <= t->limit ? &width : &wide) = middle;
  }
  return width;
}

/* Saved by the width of the bench set. */
static void vacuum(const conclusion_trial *t, finding *f)
{
  finding_add(f, range_of(&t->pair[TRIAL_VACUUM].down), "%s", "");
  finding_add_conditioned(f, range_of(&t->pair[TRIAL_NARROW_VACUUM].down));
  lab_append(f->condition, FINDING_TEXT, "the bench set is narrow, so that the pressure hardly changes: at most");
  lab_append(f->where, FINDING_TEXT, "%.2g kPa wide from %.3g kPa", widest_in_vacuum(t) / kPa, t->scan.low / kPa);
  lab_append(f->note, FINDING_TEXT, "P_a = %.2g kPa, %.3g kPa wide", t->p[TRIAL_VACUUM].ambient_pressure / kPa,
             t->scan.width / kPa);
}

/* On the springs of Table 1, F = 0; saved where they are left out. */
static void fixed_range(const conclusion_trial *t, finding *f)
{
  static const char *const names[] = {"", "half the orifice", "twice the supply", "twice the area", "12 springs for 6"};
  const double six = of_table_1(t->p, 80e3), six_top = of_table_1(t->p, 240e3);
  const double twelve = of_table_1(t->p, 180e3), twelve_top = of_table_1(t->p, 380e3);
  /* the range that both pass through between 6 % and 94 % of their travel */
  const double low = twelve + 0.06 * (twelve_top - twelve), high = six_top - 0.06 * (six_top - six);
  double change[5];
  int i;
  for (i = 0; i < 5; i++) {
    const speed_edge *down = &t->pair[TRIAL_SIX_SPRINGS + i].down;
    change[i] = 1 - speed_at_pressure(down, low) / speed_at_pressure(down, high);
    if (i)
      finding_add(f, fabs(change[i] - change[0]), "%s", names[i]);
    if (i && i < 4)
      finding_add_conditioned(f, fabs(change[i] - change[0]));
  }
  lab_append(f->condition, FINDING_TEXT, "orifice, supply and area are meant, not the spring");
  lab_append(f->note, FINDING_TEXT, "%.3g..%.3g kPa, %.3g on 6 springs, %.3g on 12", low / kPa, high / kPa, change[0],
             change[4]);
}

/* Where the bench set saves a limit: the value, and the words. */
static void save_by_bench(const conclusion_trial *t, int quantity, finding *f)
{
  const bench_scan *scan = &t->scan;
  const double first = scan->from[0], last = scan->from[SCAN_POINTS - 1];
  double from = (double)NAN, to = (double)NAN, least, most;
  lab_append(f->condition, FINDING_TEXT, "the bench set starts");
  lab_range(scan->value[quantity], SCAN_POINTS, &least, &most);
  finding_add_conditioned(f, least);
  bench_scan_range(scan, quantity, t->limit, &from, &to);
  if (from > first && to < last)
    lab_append(f->where, FINDING_TEXT, "at %.3g..%.3g kPa", from / kPa, to / kPa);
  else if (from > first)
    lab_append(f->where, FINDING_TEXT, "above %.3g kPa", from / kPa);
  else if (to < last)
    lab_append(f->where, FINDING_TEXT, "below %.3g kPa", to / kPa);
  else
    lab_append(f->where, FINDING_TEXT, "anywhere");
  lab_append(f->where, FINDING_TEXT, ", %.3g kPa wide", scan->width / kPa);
}

static void fall_range(const conclusion_trial *t, finding *f)
{
  double least, most;
  finding_add(f, range_of(&t->pair->down), "%s", "");
  save_by_bench(t, SCAN_FALL_RANGE, f);
  lab_range(t->scan.value[SCAN_FALL_RANGE], SCAN_POINTS, &least, &most);
  lab_append(f->note, FINDING_TEXT, "%.3g..%.3g over bench sets %.3g kPa wide", least, most, t->scan.width / kPa);
}

static void fall_supply(const conclusion_trial *t, finding *f)
{
  finding_add(f, log(speed_max(&t->pair[TRIAL_TOP].down) / speed_max(&t->pair[TRIAL_HALF_TOP].down)) / log(2.0),
              "p_s = %g..%g kPa", paper.typical_high / 2 / kPa, paper.typical_high / kPa);
}

static double last_over_largest(const speed_edge *e)
{
  return e->arrival / speed_max(e);
}

/* Broken by a preload below friction. */
static void last_fall(const conclusion_trial *t, finding *f)
{
  const double force = t->p->dry_friction / t->p->area, last = last_over_largest(&t->pair->down);
  lab_append(f->condition, FINDING_TEXT, "p_bl > F/A");
  finding_add(f, last, "%s", "");
  finding_add(f, last_over_largest(&t->pair[TRIAL_WEAK_PRELOAD].down), "with p_bl = %.2g kPa, F/A = %.2g kPa",
              0.5 * force / kPa, force / kPa);
  finding_add_conditioned(f, last);
}

/* Over all that a discharge can be, from p_s to ambient. */
static void fall_change(const conclusion_trial *t, finding *f)
{
  const speed_edge *down = &t->pair->down;
  finding_add(f, last_over_largest(&t->pair[TRIAL_WHOLE_DISCHARGE].down), "%s", "");
  lab_append(f->note, FINDING_TEXT, "1 - v(5 %%)/v(95 %%) of the travel itself %.3g",
             1 - down->v[0] / down->v[SPEED_POINTS - 1]);
}

/* ---- Both edges: conclusions 12 to 16 ---- */

/* An edge's slowest over the other's fastest, and the worst of it over the places of the bench set. */
static void slowest_over_fastest(const conclusion_trial *t, const speed_edge *slow, const speed_edge *fast,
                                 int quantity, finding *f)
{
  double least, most;
  finding_add(f, speed_min(slow) / speed_max(fast), "%s", "");
  lab_range(t->scan.value[quantity], SCAN_POINTS, &least, &most);
  finding_add(f, most, "at worst on bench sets %.3g kPa wide", t->scan.width / kPa);
}

static void first_over(const conclusion_trial *t, finding *f)
{
  slowest_over_fastest(t, &t->pair->down, &t->pair->up, SCAN_FIRST_OVER, f);
}

static void last_over(const conclusion_trial *t, finding *f)
{
  slowest_over_fastest(t, &t->pair->up, &t->pair->down, SCAN_LAST_OVER, f);
  save_by_bench(t, SCAN_LAST_OVER, f);
}

/* Without friction, travel prolonged to 97 % of the supply. */
static void crossing(const conclusion_trial *t, finding *f)
{
  const speed_pair *pair = &t->pair[TRIAL_PROLONGED];
  const double p = speed_crossing(pair);
  finding_add(f, p / t->p->supply_pressure, "%s", "");
  lab_append(f->note, FINDING_TEXT, "%.3g kPa, both %.3g mm/s", p / kPa, 1e3 * speed_at_pressure(&pair->up, p));
}

/* Slopes, that is durations; what shapes need is noted. */
static void symmetric(const conclusion_trial *t, finding *f)
{
  const double width = t->scan.width, nominal = t->pair->shape.asymmetry;
  double left, from, low = bench_equal(t->p, &t->laws, width, &left), narrow;
  finding_add(f, isnan(low) ? low : 0, "bench set at %.3g..%.3g kPa", low / kPa, (low + width) / kPa);
  narrow = bench_alike(t->p, &t->laws, width, t->limit * nominal, &from);
  lab_append(f->note, FINDING_TEXT,
             "asymmetry there %.3g for %.3g; shapes alike to %.3g on one %.2g kPa wide from %.3g kPa", left, nominal,
             t->limit * nominal, narrow / kPa, from / kPa);
}

static void fastest(const conclusion_trial *t, finding *f)
{
  const speed_edge *up = &t->pair->up, *down = &t->pair->down;
  const double rising = speed_position(speed_fastest(up)), falling = 1 - speed_position(speed_fastest(down));
  double from = 0, to = 0;
  finding_add(f, speed_max(up) > speed_max(down) ? rising : falling, "%.3g mm/s up, %.3g mm/s down",
              1e3 * speed_max(up), 1e3 * speed_max(down));
  bench_scan_range(&t->scan, SCAN_FASTEST, 1, &from, &to);
  lab_append(f->note, FINDING_TEXT,
             "rise alone %.3g, fall alone %.3g, rise the faster one on bench sets from %.3g..%.3g kPa", rising, falling,
             from / kPa, to / kPa);
}

/* ---- Energy: conclusions 17 and 18 ----
 *
 * Work that is measured, over energies that the paper and thermodynamics give to the air; saved by an idle return and a
 * bench set of p_bl + p_bh >= p_s. */

static const char idle_condition[] = "the return is idle and p_bl + p_bh >= p_s";

/* The paper's energy of the entering air, A p_s x_n [B, Eq. 43]. */
static double paper_energy(const pneu_params *p)
{
  return p->area * p->supply_pressure * p->stroke;
}

/* Work on a load both ways over what an isothermal machine could draw from the air at supply pressure. */
static double over_exergy(const pneu_params *p, const load_cycle *c)
{
  const double exergy =
      c->air * p->gas_constant * p->ambient_temperature * log(1 + p->supply_pressure / p->ambient_pressure);
  return (c->work_up + c->work_down) / exergy;
}

/* 1 - E_o/E_i of an idle stroke. */
static double kept(const conclusion_trial *t, int which)
{
  return 1 - t->pair[which].returned / paper_energy(&t->p[which]);
}

static void largest_efficiency(const conclusion_trial *t, finding *f)
{
  const pneu_params *ideal = &t->p[TRIAL_IDEAL];
  const load_cycle *cycle = &t->cycle[TRIAL_IDEAL];
  const double saved = kept(t, TRIAL_IDEAL_CENTRED);
  finding_add(f, kept(t, TRIAL_IDEAL), "idle return, 1 - E_o/E_i");
  finding_add(f, (cycle->work_up + cycle->work_down) / paper_energy(ideal), "loaded both ways");
  finding_add_conditioned(f, saved);
  lab_append(f->condition, FINDING_TEXT, "%s", idle_condition);
  lab_append(f->note, FINDING_TEXT,
             "over A p_s x_n; loaded, over the isothermal exergy of the air %.3g; idle with p_bl + p_bh = %g p_s %.3g",
             over_exergy(ideal, cycle), half_returned, saved);
}

static void efficiency(const conclusion_trial *t, finding *f)
{
  const load_cycle *cycle = t->cycle;
  const double energy = paper_energy(t->p), exergetic = over_exergy(t->p, cycle);
  finding_add(f, (cycle->work_up + cycle->work_down) / energy, "loaded both ways");
  finding_add(f, cycle->work_up / energy, "idle return");
  finding_add_conditioned(f, t->cycle[TRIAL_CENTRED].work_up / paper_energy(&t->p[TRIAL_CENTRED]));
  lab_append(f->condition, FINDING_TEXT, "%s", idle_condition);
  if (exergetic <= t->limit)
    lab_append(f->where, FINDING_TEXT, "or the energy is the isothermal exergy of the air");
  lab_append(f->note, FINDING_TEXT,
             "over A p_s x_n, %.3g J up and %.3g J down of %.3g J; over the isothermal exergy of the air %.3g",
             cycle->work_up, cycle->work_down, energy, exergetic);
}

/* ---- The conclusions ---- */

/* Words are numbers once and for all (PAPER.md 1): "approximately", "roughly", "constant" are 10 %, "does not
 * depend" is 1 %, "mainly" an exponent of at most 1/2; "50 %" is what rounds to it. */
const conclusion conclusions[CONCLUSIONS] = {
    {1, "slope of ln v over ln P, up", -1, -1, -1, 1, 0.1, inverse, "rise: velocity inverse to P",
     "it falls faster: P_1 - P_2 shrinks as well, and V dp/dt is not small"},
    {2, "largest over smallest v, up", 1, HUGE_VAL, 1, 0, 0.1, rise_range, "rise: no constant velocity", ""},
    {3, "largest over smallest v(5 %)/p_s over the supplies, up", -HUGE_VAL, 1, 0, 1, 0.1, supply,
     "rise: largest velocity in proportion to p_s",
     "the bench set and p_a count less as p_s grows; not where filling chokes"},
    {4, "v at the end of the rise over v(5 %)", -HUGE_VAL, 0, 0, 1, 0.1, last_rise,
     "rise: least velocity tends to zero", "that of the chamber does; the stem meets its stop before"},
    {5, "largest over smallest v with P_a/P lowered to 0.01, down", -HUGE_VAL, 1, 0, 1, 0.1, vacuum,
     "fall: constant for low P_2/P_1", "V dp/dt bends it even then, unless the pressure hardly changes"},
    {6, "difference between changes of v in one range of pressure, down", -HUGE_VAL, 0, 0, 1, 0.01, fixed_range,
     "fall: change in a fixed range free of parameters", "of orifice, supply and area, as said; not of the spring"},
    {7, "largest over smallest v, down", -HUGE_VAL, 1, 0, 1, 0.1, fall_range, "fall: roughly constant",
     "with the paper's own sqrt(2) for \"roughly\" it is conclusion 10"},
    {8, "d ln v_max/d ln p_s, down", -HUGE_VAL, 0.5, 0, 0, 0, fall_supply, "fall: largest velocity set by construction",
     ""},
    {9, "v at the end of the fall over the largest", 0.01, HUGE_VAL, 0, 0, 0, last_fall,
     "fall: least velocity is not zero", "not where friction holds the stem short of its lower stop"},
    {10, "largest over smallest v, down", -HUGE_VAL, 1.41421356, 0, 0, 0, fall_range,
     "fall: largest over least at most sqrt(2)", "the bench set bounds it; (29) does not"},
    {11, "what the change of v over the whole theoretical discharge lacks of 1", -HUGE_VAL, 0, 0, 1, 0.01, fall_change,
     "fall: theoretical change free of parameters",
     "as the theoretical change; over their travels the actuators differ"},
    {12, "smallest v down over largest v up", -HUGE_VAL, 1, 0, 0, 0, first_over,
     "largest velocity up exceeds least down", ""},
    {13, "smallest v up over largest v down", -HUGE_VAL, 1, 0, 0, 0, last_over,
     "least velocity up is below largest down", "where the bench set reaches beyond equal velocities"},
    {14, "p/p_s above which the fall is faster", -HUGE_VAL, 0.618, 0, 0, 0, crossing,
     "fall the faster one above 0.618 p_s",
     "a sufficient bound; not where venting chokes, which assumption 5 excludes"},
    {15, "difference of the mean slopes on the best bench set", -HUGE_VAL, 0.1, 0, 0, 0, symmetric,
     "bench set can symmetrise slopes", "slopes, yes; shapes need one so narrow that it is not practical"},
    {16, "part of the stroke made where v is largest of both edges", -HUGE_VAL, 0, 0, 1, 0.1, fastest,
     "look for the largest velocity after the start", "that of both edges; the fall alone can be fastest at its end"},
    {17, "efficiency without friction", -HUGE_VAL, 0.505, 0, 0, 0, largest_efficiency, "efficiency at most 50 %",
     "a load on the return stroke takes what (43) counts as lost"},
    {18, "efficiency of a loaded cycle with friction", -HUGE_VAL, 0.5, 0, 0, 0, efficiency,
     "efficiency below 50 % with friction", "depends on the denominator: A p_s x_n, or the exergy of the air"}};

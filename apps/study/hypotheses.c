#include "hypotheses.h"

#include <math.h>
#include <string.h>

#include "stroke.h"

/* ---- What is varied: figures 15 to 19 ---- */

/* H1: rate of the spring [N/m]; its force at rest stays. */
static void vary_rate(const study *s, double value, pneu_params *p)
{
  const double force = p->spring_rate * p->spring_preload;
  (void)s;
  p->spring_rate = value;
  p->spring_preload = force / value;
}

/* H2: force of the spring at rest [N]. */
static void vary_preload(const study *s, double value, pneu_params *p)
{
  (void)s;
  p->spring_preload = value / p->spring_rate;
}

/* H3: travel over nominal travel. */
static void vary_travel(const study *s, double value, pneu_params *p)
{
  (void)s;
  p->stroke *= value;
}

/* H4: class of bench set, from 1; the spring follows from it: k = A (p_h - p_l)/travel, x_0 = p_l A/k. */
static void vary_bench(const study *s, double value, pneu_params *p)
{
  const study_bench *bench = &s->bench[(int)value - 1];
  p->spring_rate = p->area * (bench->high - bench->low) / p->stroke;
  p->spring_preload = p->area * bench->low / p->spring_rate;
}

/* H5: C/C0 of both orifices. */
static void vary_orifices(const study *s, double value, pneu_params *p)
{
  (void)s;
  p->fill_area *= value;
  p->vent_area *= value;
}

typedef struct variation {
  const char *file, *unit; /* of the column; the scale brings SI to it */
  double scale;
  void (*apply)(const study *s, double value, pneu_params *p);
} variation;

static const variation variations[5] = {{"fig15.csv", "kN/m", 1e-3, vary_rate},
                                        {"fig16.csv", "N", 1, vary_preload},
                                        {"fig17.csv", "%", 100, vary_travel},
                                        {"fig18.csv", "class", 1, vary_bench},
                                        {"fig19.csv", "C/C0", 1, vary_orifices}};
enum { BENCHES = 3 };

static study_range range_of(const study *s, int which)
{
  study_range range = s->range[which];
  if (which == BENCHES) {
    range.from = 1;
    range.to = range.points = s->n_benches;
  }
  return range;
}

static double value_at(const study_range *range, int i)
{
  return range->points < 2 ? range->from : range->from + (range->to - range->from) * i / (range->points - 1);
}

/* One point in one law; a stroke that does not come back has no measures and stays in the table as a gap. */
static int measure_point(const study *s, const variation *v, double value, int gas, int flow, lab_asymmetry *r,
                         lab_error *error)
{
  const lab_rig *rig = &s->actuator[s->subject];
  pneu_params p = rig->params;
  const pneu_laws laws = study_laws(rig, gas, flow);
  int status;
  v->apply(s, value, &p);
  status = stroke_measure(&p, &laws, r, error);
  if (status == LAB_DATA) {
    r->T1 = r->T2 = r->asymmetry = NAN;
    return LAB_OK;
  }
  return status;
}

static int sweep_one(const study *s, int which, lab_error *error)
{
  enum { POINT_MAX = 10000 };
  static lab_asymmetry result[POINT_MAX];
  const variation *v = &variations[which];
  const study_range range = range_of(s, which);
  const int laws = s->n_gas * s->n_flow, n = range.points * laws;
  int i, status = LAB_OK;
  table t;
  if (n > POINT_MAX)
    return lab_fail(error, LAB_DATA, "%s: more than %d points in a figure", s->file, (int)POINT_MAX);
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++) {
    const int law = i % laws;
    lab_error mine;
    const int at = measure_point(s, v, value_at(&range, i / laws), s->gas[law / s->n_flow], s->flow[law % s->n_flow],
                                 &result[i], &mine);
    if (at != LAB_OK) {
#pragma omp critical(sweep_error)
      *error = mine, status = at;
    }
  }
  if (status != LAB_OK)
    return status;
  table_open(&t, "variable,gas,flow,T1_s,T2_s,asymmetry");
  for (i = 0; i < n; i++) {
    const int law = i % laws;
    table_row(&t, "gssggg", value_at(&range, i / laws) * v->scale, pneu_gas_key(s->gas[law / s->n_flow]),
              pneu_flow_key(s->flow[law % s->n_flow]), result[i].T1, result[i].T2, result[i].asymmetry);
  }
  status = study_save(s, v->file, &t, error);
  table_close(&t);
  return status;
}

int hypotheses_sweep(const study *s, lab_error *error)
{
  int which, status = LAB_OK;
  for (which = 0; which < 5 && status == LAB_OK; which++)
    status = sweep_one(s, which, error);
  return status;
}

/* ---- What is taken away: hypotheses.csv ---- */

/* H1: the spring pushes with the force it has at mid-travel, whatever the position. A hundredth of the rate is
 * left, so that a bench set exists. */
static void without_spring(pneu_params *p, pneu_laws *laws)
{
  const double middle = p->spring_rate * (p->spring_preload + p->stroke / 2);
  (void)laws;
  p->spring_rate /= 100;
  p->spring_preload = fmin(middle / p->spring_rate - p->stroke / 2, 1.0);
  p->external_force = middle - p->spring_rate * (p->spring_preload + p->stroke / 2);
}

/* H2: no more force at rest than brings the stem home against friction. */
static void without_preload(pneu_params *p, pneu_laws *laws)
{
  (void)laws;
  p->spring_preload = 1.25 * p->dry_friction / p->spring_rate;
}

/* H3: no upper limiter: supply and spring end the travel. */
static void without_limiter(pneu_params *p, pneu_laws *laws)
{
  (void)laws;
  p->stroke = 2 * p->supply_pressure * p->area / p->spring_rate;
}

/* H4: the bench set in the middle of the supply range, where neither stroke is favoured. */
static void without_bench_offset(pneu_params *p, pneu_laws *laws)
{
  (void)laws;
  p->spring_preload = p->supply_pressure / 2 * p->area / p->spring_rate - p->stroke / 2;
}

/* H5: the vent is sized so that both strokes take the same time. */
static void without_unequal_times(pneu_params *p, pneu_laws *laws)
{
  lab_asymmetry r;
  lab_error ignored;
  int i;
  for (i = 0; i < 20; i++) {
    if (stroke_measure(p, laws, &r, &ignored) != LAB_OK)
      return;
    p->vent_area *= r.duration_ratio;
    if (fabs(r.duration_ratio - 1) < 1e-9)
      return;
  }
}

/* H6: filling and venting are made the same process: flow in proportion to the pressure difference whatever the
 * density, the volume of mid-travel throughout, no change of temperature, the bench set in the middle. */
static void without_air_process(pneu_params *p, pneu_laws *laws)
{
  p->dead_volume += p->area * p->stroke / 2;
  p->swept_ratio = 0;
  laws->gas = PNEU_GAS_ISOTHERMAL;
  laws->flow = PNEU_FLOW_LINEAR;
  without_bench_offset(p, laws);
}

typedef struct removal {
  const char *hypothesis;
  void (*apply)(pneu_params *p, pneu_laws *laws);
} removal;

static const removal removals[6] = {{"H1", without_spring},        {"H2", without_preload},
                                    {"H3", without_limiter},       {"H4", without_bench_offset},
                                    {"H5", without_unequal_times}, {"H6", without_air_process}};

/* A cause that carries the asymmetry but does not make it: without it nothing is left, and alone it makes none. */
static int makes_it_alone(const lab_rig *rig, const removal *cause, double base, double below)
{
  pneu_params p = rig->params;
  pneu_laws laws = rig->laws;
  lab_asymmetry r;
  lab_error ignored;
  if (cause->apply == without_air_process)
    return 1;
  without_air_process(&p, &laws);
  return stroke_measure(&p, &laws, &r, &ignored) == LAB_OK && r.asymmetry >= below * base;
}

static const char *verdict(const study *s, const lab_rig *rig, const removal *cause, double base, double without)
{
  if (fabs(without - base) < 1e-6 * base)
    return "not confirmed: nothing to take away";
  if (!(without < s->confirmed_below * base))
    return "not confirmed";
  return makes_it_alone(rig, cause, base, s->confirmed_below) ? "confirmed"
                                                              : "confirmed as necessary; alone it makes no asymmetry";
}

static int verdict_row(const study *s, const lab_rig *rig, int gas, int flow, const removal *cause, table *t,
                       lab_error *error)
{
  pneu_params p = rig->params;
  pneu_laws laws = study_laws(rig, gas, flow);
  lab_asymmetry base, without;
  if (stroke_measure(&p, &laws, &base, error))
    return error->status;
  cause->apply(&p, &laws);
  if (stroke_measure(&p, &laws, &without, error))
    return lab_fail_in(error, "%s without its cause", cause->hypothesis);
  table_row(t, "sssggggs", cause->hypothesis, pneu_gas_key(gas), pneu_flow_key(flow), base.asymmetry, without.asymmetry,
            base.duration_ratio, without.duration_ratio, verdict(s, rig, cause, base.asymmetry, without.asymmetry));
  return LAB_OK;
}

static int verdict_table(const study *s, int actuator, lab_error *error)
{
  const lab_rig *rig = &s->actuator[actuator];
  char name[LAB_NAME_TEXT + 32] = "hypotheses.csv";
  int h, law, status = LAB_OK;
  table t;
  table_open(&t, "hypothesis,gas,flow,asymmetry_base,asymmetry_without_cause,duration_ratio_base,"
                 "duration_ratio_without_cause,verdict");
  for (h = 0; h < 6 && status == LAB_OK; h++)
    for (law = 0; law < s->n_gas * s->n_flow && status == LAB_OK; law++)
      status = verdict_row(s, rig, s->gas[law / s->n_flow], s->flow[law % s->n_flow], &removals[h], &t, error);
  if (actuator != s->subject)
    snprintf(name, sizeof name, "hypotheses_%s.csv", rig->name);
  if (status == LAB_OK)
    status = study_save(s, name, &t, error);
  table_close(&t);
  return status;
}

int hypotheses_verdicts(const study *s, lab_error *error)
{
  int i, status = LAB_OK;
  for (i = 0; i < s->n_actuators && status == LAB_OK; i++)
    status = verdict_table(s, i, error);
  return status;
}

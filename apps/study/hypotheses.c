#include "hypotheses.h"

#include <math.h>

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

/* How the strokes of the models differ: Eq. (1) of the paper, what the spring and the air do without each other, and
 * what makes a difference between the directions. */
#include <math.h>

#include "products.h"
#include "hypotheses.h"
#include "stroke.h"

/* ---- Eq. (1): a first-order lag up, an integrator down ---- */

static const double seen = 0.01; /* [1] of the travel: what a ramp may leave and still pass for the stroke */

static void add_edge(table *t, const study_cell *c, const char *stroke, const stroke_curve *curve)
{
  const lab_edge e = stroke_edge(curve);
  double lag_rms, ramp_rms;
  const double lag = lab_asymmetry_lag_time(&e, &lag_rms), ramp = lab_asymmetry_ramp_time(&e, &ramp_rms);
  table_row(t, "ssssggggs", c->rig->name, c->gas, c->flow, stroke, lag, lag_rms, ramp, ramp_rms,
            ramp_rms <= fmax(seen, lag_rms) ? "ramp" : "lag");
}

static int edge_rows(const study_cell *c, table *t, lab_error *error)
{
  stroke_pair pair;
  const int status = stroke_sample(&c->rig->params, &c->rig->params, &c->laws, &pair, error);
  if (status == LAB_OK) {
    add_edge(t, c, "rise", &pair.up);
    add_edge(t, c, "fall", &pair.down);
  }
  stroke_pair_free(&pair);
  return status;
}

const study_tables edges = {
    {STUDY_ALL, STUDY_EVERY_LAW},
    edge_rows,
    {{.file = "eq1.csv", .header = "actuator,gas,flow,stroke,lag_T_s,lag_rms,ramp_T_s,ramp_rms,shape"}}};

/* ---- Spring and air: each without the other ---- */

static int spring_and_air_rows(const study_cell *c, table *t, lab_error *error)
{
  /* 1: there; with neither there a breath of air would do for the whole stroke */
  static const struct {
    int spring, air;
  } rows[] = {{1, 1}, {0, 1}, {1, 0}};
  size_t i;
  for (i = 0; i < sizeof rows / sizeof *rows; i++) {
    pneu_params p = c->rig->params;
    pneu_laws laws = c->laws;
    speed_pair pair;
    if (!rows[i].spring)
      hypothesis_without(H1_RATE, &p, &laws);
    if (!rows[i].air)
      hypothesis_without(H6_AIR_PROCESS, &p, &laws);
    if (speeds_measure(&p, &laws, &pair, error))
      return error->status;
    table_row(t, "sssggggggg", c->rig->name, c->gas, c->flow, (double)rows[i].spring, (double)rows[i].air,
              pair.shape.asymmetry, pair.shape.duration_ratio, speed_max(&pair.up) / speed_min(&pair.up),
              speed_max(&pair.down) / speed_min(&pair.down), pair.shape.asymmetry_signed);
  }
  return LAB_OK;
}

const study_tables spring_and_air = {
    {STUDY_ALL, STUDY_EVERY_LAW},
    spring_and_air_rows,
    {{.file = "spring_and_air.csv",
      .header = "actuator,gas,flow,spring,air,asymmetry,duration_ratio,rise_speed_ratio,"
                "fall_speed_ratio,asymmetry_signed"}}};

/* ---- What differs between the directions ----
 *
 * Another spring rate on the way down than on the way up, as the paper varies it in Fig. 15 (hypothesis 1), and a vent
 * unlike the fill (hypothesis 5). Table A1 has neither, so that there is nothing to take away; here each is added. */

enum { RATE, ORIFICE, RATIOS = 7 };

static const struct {
  const char *name;
  double ratio[RATIOS]; /* down over up; 0 ends; the spring must let the supply fill the chamber before it falls */
} differences[] = {
    [RATE] = {"spring_rate", {0.25, 0.5, 0.8, 1, 1.25}}, [ORIFICE] = {"orifice", {0.25, 0.5, 0.8, 1, 1.25, 2, 4}}};

static int measure_difference(const study_cell *c, int which, double ratio, lab_asymmetry *r, lab_error *error)
{
  pneu_params down = c->rig->params;
  if (which == ORIFICE)
    down.vent_area *= ratio;
  else {
    down.spring_preload /= ratio; /* the force at rest stays */
    down.spring_rate *= ratio;
  }
  return stroke_measure(&c->rig->params, &down, &c->laws, r, error);
}

static void add_difference(table *t, const study_cell *c, const char *what, double ratio, const lab_asymmetry *r)
{
  table_row(t, "ssssgggg", c->rig->name, c->gas, c->flow, what, ratio, r->duration_ratio, r->asymmetry,
            r->asymmetry_signed);
}

/* The last row is that of the orifice that makes both strokes last equally long: the fall takes the longer the smaller
 * the vent is, so that a few corrections do. */
static int direction_rows(const study_cell *c, table *t, lab_error *error)
{
  double ratio = 1;
  lab_asymmetry r = {.duration_ratio = 1};
  int which, i;
  for (which = 0; which < 2; which++)
    for (i = 0; i < RATIOS && differences[which].ratio[i] > 0; i++) {
      if (measure_difference(c, which, differences[which].ratio[i], &r, error))
        return lab_fail_in(error, "%s", differences[which].name);
      add_difference(t, c, differences[which].name, differences[which].ratio[i], &r);
    }
  for (i = 0; i < 20; i++) {
    if (measure_difference(c, ORIFICE, ratio, &r, error))
      return error->status;
    if (fabs(r.duration_ratio - 1) < 1e-9)
      break;
    ratio *= r.duration_ratio;
  }
  add_difference(t, c, "orifice for equal times", ratio, &r);
  return LAB_OK;
}

const study_tables directions = {
    {STUDY_ALL, STUDY_EVERY_LAW},
    direction_rows,
    {{.file = "directions.csv",
      .header = "actuator,gas,flow,what,down_over_up,duration_ratio,asymmetry,asymmetry_signed"}}};

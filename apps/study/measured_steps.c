/* The servomotor's two step responses, measured as the paper's strokes are: both shapes, first-order lag and
 * integrator, fitted to both edges. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../lab/rig/rig.h"
#include "../lab/metrics/asymmetry.h"
#include "measured.h"
#include "measured_damadics.h"
#include "stroke.h"

static const char up_name[] = "damadics-servomotor-static-step/step_up_fig6.csv";
static const char down_name[] = "damadics-servomotor-static-step/step_down_fig7.csv";
static const char beside_name[] = "actuators/37-13.cfg"; /* the paper's actuator of the same kind and stroke */

enum { STEP_POINTS = 512 };

/* A stroke as the figure has it: travel in tenths of the full one. */
typedef struct record {
  size_t n;
  double t[STEP_POINTS], x[STEP_POINTS]; /* [s], [1] */
} record;

/* ---- Reading ---- */

static int add_point(void *context, const char *text, lab_error *error)
{
  record *r = context;
  double t_ms, x;
  if (sscanf(text, "%lf,%lf", &t_ms, &x) != 2)
    return lab_fail(error, LAB_DATA, "expected time and position, found \"%s\"", text);
  if (r->n == STEP_POINTS)
    return lab_fail(error, LAB_DATA, "more than %d points", STEP_POINTS);
  r->t[r->n] = 1e-3 * t_ms;
  r->x[r->n++] = x;
  return LAB_OK;
}

static int read_record(const char *path, record *r, lab_error *error)
{
  r->n = 0;
  return measured_lines(path, add_point, r, error);
}

/* Where the falling record meets 0: it goes on to -0.25, by an offset of the sensor or the smoothing of the chart. */
static record cut_at_zero(const record *r)
{
  record cut = *r;
  size_t i = 1;
  while (i < r->n && r->x[i] > 0)
    i++;
  if (i == r->n)
    return cut;
  cut.t[i] = r->t[i - 1] + (r->t[i] - r->t[i - 1]) * r->x[i - 1] / (r->x[i - 1] - r->x[i]);
  cut.x[i] = 0;
  cut.n = i + 1;
  return cut;
}

static lab_edge edge_of(const record *r)
{
  const lab_edge e = {r->n, r->t, r->x};
  return e;
}

/* ---- One row a pair of edges ---- */

static const char steps_header[] = "source,gas,flow,rise_time [s],fall_time [s],duration_ratio [1],asymmetry [1],"
                                   "rise_lag_T [s],rise_lag_rms [1],rise_ramp_T [s],rise_ramp_rms [1],"
                                   "fall_lag_T [s],fall_lag_rms [1],fall_ramp_T [s],fall_ramp_rms [1],note";

static int add_pair(table *t, const char *source, const char *gas, const char *flow, const lab_edge *up,
                    const lab_edge *down, const char *note, lab_error *error)
{
  lab_asymmetry a;
  double rise_ramp, rise_ramp_rms, fall_lag, fall_lag_rms;
  if (lab_asymmetry_measure(up, down, &a, error))
    return lab_fail_in(error, "%s", source);
  rise_ramp = lab_asymmetry_ramp_time(up, &rise_ramp_rms);
  fall_lag = lab_asymmetry_lag_time(down, &fall_lag_rms);
  table_row(t, "sssggggggggggggs", source, gas, flow, a.rise_time, a.fall_time, a.duration_ratio, a.asymmetry, a.T1,
            a.lag_error, rise_ramp, rise_ramp_rms, fall_lag, fall_lag_rms, a.T2, a.ramp_error, note);
  return LAB_OK;
}

static int add_model(table *t, const lab_rig *rig, int gas, int flow, lab_error *error)
{
  pneu_laws laws = rig->laws;
  stroke_pair pair;
  int status;
  laws.gas = gas;
  laws.flow = flow;
  status = stroke_sample(&rig->params, &laws, &pair, error);
  if (status == LAB_OK) {
    const lab_edge up = {pair.up.n, pair.up.t, pair.up.x}, down = {pair.down.n, pair.down.t, pair.down.x};
    status = add_pair(t, "model of the 37-13", pneu_gas_key(gas), pneu_flow_key(flow), &up, &down,
                      "parameters of the paper's Table A1", error);
  }
  stroke_pair_free(&pair);
  return status;
}

static int add_models(const char *beside_path, table *t, lab_error *error)
{
  static const int gas[] = {PNEU_GAS_ISOTHERMAL, PNEU_GAS_POLYTROPIC}, flow[] = {PNEU_FLOW_PAPER, PNEU_FLOW_CHOKED};
  lab_rig rig;
  int i;
  if (lab_rig_read(beside_path, &rig, error))
    return error->status;
  for (i = 0; i < 4; i++)
    if (add_model(t, &rig, gas[i / 2], flow[i % 2], error))
      return error->status;
  return LAB_OK;
}

/* ---- The fitted shapes, for the figure ---- */

/* Share of travel at sample i. */
static double share(const lab_edge *e, size_t i)
{
  return (e->x[i] - e->x[0]) / (e->x[e->n - 1] - e->x[0]);
}

/* Straight line share = a + b z over the samples between 5 % and 95 % of travel. */
static void line(const lab_edge *e, const double *z, double *a, double *b)
{
  double n = 0, sz = 0, sy = 0, szz = 0, szy = 0;
  size_t i;
  for (i = 0; i < e->n; i++) {
    const double y = share(e, i);
    if (y < 0.05 || y > 0.95)
      continue;
    n++;
    sz += z[i];
    sy += y;
    szz += z[i] * z[i];
    szy += z[i] * y;
  }
  *b = (n * szy - sz * sy) / (n * szz - sz * sz);
  *a = (sy - *b * sz) / n;
}

/* Data, first-order lag and integrator at each sample, in the figure's unit. */
static void add_edge(table *t, const char *name, const lab_edge *e)
{
  const double T = lab_asymmetry_lag_time(e, NULL), travel = e->x[e->n - 1] - e->x[0];
  double z[STEP_POINTS], lag_a, lag_b, ramp_a, ramp_b;
  size_t i;
  for (i = 0; i < e->n; i++)
    z[i] = -expm1(-e->t[i] / T);
  line(e, z, &lag_a, &lag_b);
  line(e, e->t, &ramp_a, &ramp_b);
  for (i = 0; i < e->n; i++) {
    const double y = share(e, i), inside = y >= 0.05 && y <= 0.95 ? 1 : (double)NAN;
    const double lag = lag_a + lag_b * z[i], ramp = ramp_a + ramp_b * e->t[i];
    table_row(t, "sgggggg", name, e->t[i], e->x[i], inside * (e->x[0] + travel * lag),
              inside * (e->x[0] + travel * ramp), inside * travel * (y - lag), inside * travel * (y - ramp));
  }
}

/* ---- All of it ---- */

static int fill(const char *beside_path, const record *up, const record *down, table *steps, table *edges,
                lab_error *error)
{
  const record cut = cut_at_zero(down);
  const lab_edge rise = edge_of(up), fall = edge_of(&cut), whole = edge_of(down);
  if (add_pair(steps, "measured", "", "", &rise, &fall, "fall taken to 0, where the travel ends", error) ||
      add_pair(steps, "measured", "", "", &rise, &whole, "fall as drawn, to -0.25 of 10", error) ||
      add_models(beside_path, steps, error))
    return error->status;
  add_edge(edges, "up", &rise);
  add_edge(edges, "down", &fall);
  return LAB_OK;
}

static int make(const char *beside_path, const record *up, const record *down, const char *results_dir,
                lab_error *error)
{
  table steps, edges;
  int status;
  table_open(&steps, steps_header);
  table_open(&edges, "edge,t [s],x [1],x_lag [1],x_ramp [1],lag_residual [1],ramp_residual [1]");
  status = fill(beside_path, up, down, &steps, &edges, error);
  if (status == LAB_OK)
    status = measured_save(results_dir, "measured_damadics_steps.csv", &steps, error);
  if (status == LAB_OK)
    status = measured_save(results_dir, "measured_damadics_edges.csv", &edges, error);
  table_close(&steps);
  table_close(&edges);
  return status;
}

int measured_damadics_steps(const char *study_dir, const char *data_dir, const char *results_dir, lab_error *error)
{
  char up_path[1024], down_path[1024], beside_path[1024];
  record up, down;
  int status;
  if ((status = measured_path(data_dir, up_name, up_path, sizeof up_path, error)) != LAB_OK ||
      (status = measured_path(data_dir, down_name, down_path, sizeof down_path, error)) != LAB_OK)
    return status;
  if (measured_join(study_dir, beside_name, beside_path, sizeof beside_path, error) ||
      read_record(up_path, &up, error) || read_record(down_path, &down, error))
    return error->status;
  return make(beside_path, &up, &down, results_dir, error);
}

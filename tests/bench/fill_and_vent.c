/* One fill-and-vent of the R1-400: the stepper against CVODE in one run, error against time.
 *
 * Both integrate the same right-hand side, Jacobian and events; CVODE keeps its memory from run to run. Error is the
 * largest difference of position from CVODE at 1e-12, over the stroke, on the 10 ms grid of the standard experiment.
 * Time is the median of repeated runs without samples, the two in turn.
 *
 * Usage: fill_and_vent RESULTS_DIR   writes work_precision.csv and bench.csv there.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "../../apps/lab/cvode.h"
#include "../../apps/lab/outfile.h"
#include "../../apps/lab/standard.h"
#include "../../apps/study/table.h"

enum { TOLERANCES = 11, REPEATS = 41, LAWS = 4 };

static const struct {
  int gas, flow;
} laws[LAWS] = {{PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER},
                {PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED},
                {PNEU_GAS_POLYTROPIC, PNEU_FLOW_PAPER},
                {PNEU_GAS_POLYTROPIC, PNEU_FLOW_CHOKED}};

static const char *const integrator_names[] = {"stepper", "cvode"};

/* One point of the diagram. */
typedef struct point {
  double tol, error, time; /* [1], [1] of stroke, [s] */
  long steps, rhs;
} point;

static double seconds(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int ascending(const void *a, const void *b)
{
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* The stretches of the standard experiment, without samples.  Returns: seconds, NaN on failure. */
static double run_once(lab_cvode *cvode, const pneu_model *model, int integrator, double tol, pneu_stats *stats)
{
  static const double duration[3] = {0.5, 15, 15}, command[3] = {0, 1, -1};
  static pneu_workspace work;
  pneu_options options;
  pneu_input input;
  pneu_state state;
  lab_error error;
  double start;
  int i, status = 0;
  memset(&work, 0, sizeof work);
  memset(stats, 0, sizeof *stats);
  pneu_options_default(&options);
  options.tol = tol;
  pneu_input_default(model, &input);
  pneu_state_rest(model, 0, model->p.ambient_temperature, 0, &input, &state);
  start = seconds();
  for (i = 0; i < 3 && status == 0; i++) {
    input.u = command[i];
    status = integrator == LAB_CVODE
                 ? lab_cvode_run(cvode, model, &state, &input, duration[i], tol, NULL, stats, &error)
                 : pneu_run(model, &state, &input, duration[i], &options, NULL, &work);
  }
  if (integrator == LAB_STEPPER)
    *stats = work.stats;
  return status == 0 ? seconds() - start : (double)NAN;
}

static double position_error(const pneu_model *model, int integrator, double tol, const lab_trace *reference)
{
  const lab_response_options options = {integrator, tol, 0, 0, 0};
  lab_trace trace;
  lab_error error;
  double gap = 0;
  size_t i;
  if (lab_standard_experiment(model, &options, &trace, &error))
    return (double)NAN;
  for (i = 0; i < trace.n; i++)
    gap = fmax(gap, fabs(trace.x[i] - reference->x[i]));
  lab_trace_free(&trace);
  return gap / model->p.stroke;
}

/* Both integrators at one tolerance, in turn. */
static void measure(lab_cvode *cvode, const pneu_model *model, const lab_trace *reference, double tol, point *pair)
{
  double time[2][REPEATS];
  pneu_stats stats;
  int i, r;
  for (r = 0; r < REPEATS; r++)
    for (i = 0; i < 2; i++) {
      time[i][r] = run_once(cvode, model, i, tol, &stats);
      pair[i].steps = stats.steps;
      pair[i].rhs = stats.rhs;
    }
  for (i = 0; i < 2; i++) {
    qsort(time[i], REPEATS, sizeof **time, ascending);
    pair[i].tol = tol;
    pair[i].time = time[i][REPEATS / 2];
    pair[i].error = position_error(model, i, tol, reference);
  }
}

/* Least time that reaches the error `wanted`: over all points that do, and over the straight lines in logarithms to the
 * point before where that does not. */
static double time_at(const point (*p)[2], int integrator, double wanted)
{
  double best = HUGE_VAL;
  int i;
  for (i = 0; i < TOLERANCES; i++) {
    const point *now = &p[i][integrator], *before = i ? &p[i - 1][integrator] : now;
    if (!(now->error <= wanted))
      continue;
    best = fmin(best, now->time);
    if (before->error > wanted)
      best = fmin(best, before->time * pow(now->time / before->time,
                                           log(wanted / before->error) / log(now->error / before->error)));
  }
  return best;
}

static void rows(const pneu_model *model, const point (*p)[2], table *diagram, table *summary)
{
  static const double wanted[] = {1e-4, 1e-6, 1e-8};
  const char *gas = pneu_gas_key(model->law.gas), *flow = pneu_flow_key(model->law.flow);
  int i, k;
  for (k = 0; k < 2; k++)
    for (i = 0; i < TOLERANCES; i++)
      table_row(diagram, "sssggggg", integrator_names[k], gas, flow, p[i][k].tol, p[i][k].error, p[i][k].time * 1e6,
                (double)p[i][k].steps, (double)p[i][k].rhs);
  for (i = 0; i < 3; i++) {
    const double ours = time_at(p, LAB_STEPPER, wanted[i]), theirs = time_at(p, LAB_CVODE, wanted[i]);
    table_row(summary, "ssgggg", gas, flow, wanted[i], ours * 1e6, theirs * 1e6, theirs / ours);
    printf("%-10s %-7s error %.0e of stroke: stepper %7.1f us, CVODE %s %7.1f us, ratio %.1f\n", gas, flow, wanted[i],
           ours * 1e6, lab_cvode_version(), theirs * 1e6, theirs / ours);
  }
}

static int bench_law(lab_cvode *cvode, int law, table *diagram, table *summary, lab_error *error)
{
  const lab_response_options tight = {LAB_CVODE, 1e-12, 0, 0, 0};
  point p[TOLERANCES][2];
  pneu_params params;
  pneu_laws chosen = {0};
  pneu_model model;
  lab_trace reference;
  int i;
  pneu_params_default(&params);
  chosen.gas = laws[law].gas;
  chosen.flow = laws[law].flow;
  if (pneu_model_init(&model, &params, &chosen, NULL) != PNEU_OK)
    return lab_fail(error, LAB_DATA, "the default parameters are refused");
  if (lab_standard_experiment(&model, &tight, &reference, error))
    return error->status;
  for (i = 0; i < TOLERANCES; i++)
    measure(cvode, &model, &reference, pow(10, -3 - i * 0.75), p[i]);
  rows(&model, (const point(*)[2])p, diagram, summary);
  lab_trace_free(&reference);
  return LAB_OK;
}

static int save(const char *folder, const char *name, const table *t, lab_error *error)
{
  char path[1024];
  lab_outfile out;
  snprintf(path, sizeof path, "%s/%s", folder, name);
  if (lab_out_open(&out, path, error))
    return error->status;
  if (table_write(t, out.file, error)) {
    lab_out_abandon(&out);
    return error->status;
  }
  return lab_out_close(&out, error);
}

int main(int argc, char **argv)
{
  lab_cvode *cvode = lab_cvode_new();
  lab_error error;
  table diagram, summary;
  int law, status = LAB_OK;
  if (argc != 2 || !cvode) {
    fprintf(stderr, "usage: fill_and_vent RESULTS_DIR\n");
    return LAB_USAGE;
  }
  table_open(&diagram, "integrator,gas,flow,tol,error,time_us,steps,rhs");
  table_open(&summary, "gas,flow,error_of_stroke,stepper_us,cvode_us,ratio");
  for (law = 0; law < LAWS && status == LAB_OK; law++)
    status = bench_law(cvode, law, &diagram, &summary, &error);
  if (status == LAB_OK)
    status = save(argv[1], "work_precision.csv", &diagram, &error);
  if (status == LAB_OK)
    status = save(argv[1], "bench.csv", &summary, &error);
  if (status != LAB_OK)
    fprintf(stderr, "fill_and_vent: %s\n", error.text);
  table_close(&diagram);
  table_close(&summary);
  lab_cvode_free(cvode);
  return status;
}

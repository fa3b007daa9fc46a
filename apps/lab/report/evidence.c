#include "evidence.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../run/response.h"
#include "../run/start.h"

static const double space_between_runs = 0.02; /* of the first run's length */

/* ---- Memory ---- */

static int find_channel(const lab_evidence *v, int channel)
{
  int c;
  for (c = 0; c < v->n_channels; c++)
    if (v->channel[c].channel == channel)
      return c;
  return -1;
}

/* Rows, and every channel that any run measures. */
static void survey(const lab_unknowns *u, lab_evidence *v)
{
  int e, c;
  for (e = 0; e < u->n_experiments; e++) {
    const lab_experiment *x = &u->experiment[e];
    v->n += x->n;
    for (c = 0; c < x->n_channels; c++)
      if (find_channel(v, x->channel[c]) < 0) {
        v->channel[v->n_channels].channel = x->channel[c];
        v->channel[v->n_channels++].sigma = x->sigma[c];
      }
  }
  v->n_runs = u->n_experiments;
}

static double *take(lab_evidence *v, size_t *used)
{
  double *array = v->memory + *used;
  size_t i;
  for (i = 0; i < v->n; i++)
    array[i] = (double)NAN;
  *used += v->n;
  return array;
}

static int allocate(lab_evidence *v, lab_error *error)
{
  const size_t arrays = 1 + LAB_ARGUMENT_COUNT + (size_t)v->n_channels * (1 + 2 * LAB_STAGE_COUNT);
  size_t used = 0;
  int c, i;
  v->memory = malloc(arrays * v->n * sizeof *v->memory);
  v->first = calloc((size_t)v->n_runs + 1, sizeof *v->first);
  if (!v->memory || !v->first)
    return lab_fail_memory(error, "the report");
  v->t = take(v, &used);
  for (i = 0; i < LAB_ARGUMENT_COUNT; i++)
    v->argument[i] = take(v, &used);
  for (c = 0; c < v->n_channels; c++) {
    v->channel[c].measured = take(v, &used);
    for (i = 0; i < LAB_STAGE_COUNT; i++) {
      v->channel[c].predicted[i] = take(v, &used);
      v->channel[c].residual[i] = take(v, &used);
    }
  }
  return LAB_OK;
}

void lab_evidence_free(lab_evidence *v)
{
  free(v->memory);
  free(v->first);
  memset(v, 0, sizeof *v);
}

/* ---- Time and arguments ---- */

/* The first run keeps its clock; each later one begins where the one before has ended. */
static void lay_out_time(const lab_unknowns *u, lab_evidence *v)
{
  double end = 0, space = 0;
  size_t i, row = 0;
  int e;
  for (e = 0; e < u->n_experiments; e++) {
    const lab_experiment *x = &u->experiment[e];
    const double *t = x->log->value[LAB_CHANNEL_TIME] + x->first;
    const double shift = e == 0 ? 0 : end + space - t[0];
    v->first[e] = row;
    for (i = 0; i < x->n; i++)
      v->t[row + i] = t[i] + shift;
    row += x->n;
    end = t[x->n - 1] + shift;
    if (e == 0)
      space = space_between_runs * (t[x->n - 1] - t[0]);
  }
  v->first[e] = row;
}

/* Arguments of one run: the model's response, with the commands at the rows that show them, which is near enough for
 * sorting a residual into bins. */
static int respond(const lab_unknowns *u, const lab_experiment *x, lab_evidence *v, size_t row, lab_error *error)
{
  const double *t = x->log->value[LAB_CHANNEL_TIME] + x->first;
  const lab_response_options options = {LAB_STEPPER, u->tol, t[x->n - 1], 0, 0, 0};
  const double *column[LAB_ARGUMENT_COUNT];
  pneu_model model;
  pneu_state start;
  lab_trace trace;
  int i;
  if (lab_rig_model(&u->rig, &model, error) ||
      lab_start_from_log(&model, x->drive.input, x->log, x->run, &start, error) ||
      lab_respond(&model, &start, &x->drive.schedule, t, x->n, &options, &trace, NULL, error))
    return error->status;
  column[LAB_ARGUMENT_P] = trace.p;
  column[LAB_ARGUMENT_X] = trace.x;
  column[LAB_ARGUMENT_V] = trace.v;
  column[LAB_ARGUMENT_U] = x->log->value[LAB_CHANNEL_U] ? x->log->value[LAB_CHANNEL_U] + x->first : trace.u;
  for (i = 0; i < LAB_ARGUMENT_COUNT; i++)
    memcpy(v->argument[i] + row, column[i], x->n * sizeof(double));
  lab_trace_free(&trace);
  return LAB_OK;
}

/* ---- Residuals ---- */

static void take_up(const lab_unknowns *u, const double *r, int stage, lab_evidence *v)
{
  int e, c;
  for (e = 0; e < u->n_experiments; e++) {
    const lab_experiment *x = &u->experiment[e];
    for (c = 0; c < x->n_channels; c++) {
      lab_evidence_channel *mine = &v->channel[find_channel(v, x->channel[c])];
      size_t i, row = v->first[e];
      for (i = 0; i < x->n; i++, row++, r++) {
        const double measured = lab_experiment_measured(x, c, i);
        if (isnan(measured))
          continue;
        mine->measured[row] = measured;
        mine->residual[stage][row] = *r;
        mine->predicted[stage][row] = measured - *r * x->sigma[c];
      }
    }
  }
}

static int collect_residuals(const lab_unknowns *u, int stage, lab_evidence *v, lab_error *error)
{
  double *r = malloc((u->n_rows + 1) * sizeof *r);
  int status = r ? lab_unknowns_errors(u, r, error) : lab_fail_memory(error, "residuals");
  if (status == LAB_OK)
    take_up(u, r, stage, v);
  free(r);
  return status;
}

static void test_whiteness(lab_evidence *v, lab_stretch *stretch)
{
  int c, stage, e;
  for (c = 0; c < v->n_channels; c++)
    for (stage = 0; stage < LAB_STAGE_COUNT; stage++) {
      for (e = 0; e < v->n_runs; e++)
        stretch[e] = (lab_stretch){v->channel[c].residual[stage] + v->first[e], v->first[e + 1] - v->first[e]};
      lab_whiteness_test(stretch, v->n_runs, &v->channel[c].whiteness[stage]);
    }
}

int lab_evidence_collect(const lab_story *story, lab_evidence *v, lab_error *error)
{
  const lab_unknowns *u = story->completed;
  lab_stretch *stretch;
  int e;
  memset(v, 0, sizeof *v);
  survey(u, v);
  if (allocate(v, error))
    return error->status;
  lay_out_time(u, v);
  for (e = 0; e < u->n_experiments; e++)
    if (respond(u, &u->experiment[e], v, v->first[e], error))
      return error->status;
  if (collect_residuals(story->declared, LAB_STAGE_BEFORE, v, error) ||
      collect_residuals(story->completed, LAB_STAGE_AFTER, v, error))
    return error->status;
  stretch = malloc((size_t)v->n_runs * sizeof *stretch);
  if (!stretch)
    return lab_fail_memory(error, "the report");
  test_whiteness(v, stretch);
  free(stretch);
  return LAB_OK;
}

/* ---- Names ---- */

const char *lab_argument_key(int argument)
{
  static const char *const key[LAB_ARGUMENT_COUNT] = {"p", "x", "v", "u"};
  return key[argument];
}

const char *lab_argument_unit(const lab_story *story, int argument)
{
  static const char *const unit[LAB_ARGUMENT_COUNT] = {"Pa", "m", "m/s", "1"};
  return argument == LAB_ARGUMENT_U && story->rig->params.proportional_band > 0 ? "Pa" : unit[argument];
}

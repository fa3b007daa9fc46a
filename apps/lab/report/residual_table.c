#include "figures.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../fit/drift.h"
#include "../metrics/recording.h"

static const double space_between_runs = 0.02; /* of the first run's length */

/* ---- Memory ---- */

const lab_residual_channel *lab_residual_table_channel(const lab_residual_table *v, int channel)
{
  int c;
  for (c = 0; c < v->n_channels; c++)
    if (v->channel[c].channel == channel)
      return &v->channel[c];
  return NULL;
}

/* Rows, and every channel that any run measures. */
static void survey(const lab_unknowns *u, lab_residual_table *v)
{
  int e, c;
  for (e = 0; e < u->n_runs; e++) {
    const lab_run *x = &u->run[e];
    v->n += x->n;
    for (c = 0; c < x->n_channels; c++)
      if (!lab_residual_table_channel(v, x->channel[c]))
        v->channel[v->n_channels++].channel = x->channel[c];
  }
  v->n_runs = u->n_runs;
}

static double *take(lab_residual_table *v, size_t *used)
{
  double *array = v->memory + *used;
  size_t i;
  for (i = 0; i < v->n; i++)
    array[i] = (double)NAN;
  *used += v->n;
  return array;
}

static int allocate(lab_residual_table *v, lab_error *error)
{
  const size_t arrays = 2 + LAB_ARGUMENT_COUNT + (size_t)v->n_channels * (1 + 2 * LAB_STAGE_COUNT);
  size_t used = 0;
  int c, i;
  v->memory = malloc(arrays * v->n * sizeof *v->memory);
  if (!v->memory)
    return lab_fail_memory(error, "the report");
  v->t = take(v, &used);
  v->set_position = take(v, &used);
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

void lab_residual_table_free(lab_residual_table *v)
{
  free(v->memory);
  memset(v, 0, sizeof *v);
}

/* ---- Time and arguments ---- */

/* The first run keeps its clock; each later one begins where the one before has ended. */
static void lay_out_time(const lab_unknowns *u, lab_residual_table *v)
{
  double end = 0, space = 0;
  size_t i, row = 0;
  int e;
  for (e = 0; e < u->n_runs; e++) {
    const lab_run *x = &u->run[e];
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

/* What the log has of a channel, if anything. */
static void put_logged(const lab_run *x, int channel, double *to)
{
  if (x->log->value[channel])
    memcpy(to, x->log->value[channel] + x->first, x->n * sizeof *to);
}

/* Arguments of one run: the model's response, with the commands at the rows that show them, which is near enough for
 * sorting a residual into bins; gaps where the model cannot be followed with those. */
static int respond(const lab_unknowns *u, int run, lab_residual_table *v, lab_error *error)
{
  const lab_run *x = &u->run[run];
  const size_t row = v->first[run];
  lab_response response;
  put_logged(x, LAB_CHANNEL_SP, v->set_position + row);
  if (lab_run_respond(u, run, &response, error) == LAB_OK) {
    memcpy(v->argument[LAB_ARGUMENT_P] + row, response.p, x->n * sizeof(double));
    memcpy(v->argument[LAB_ARGUMENT_X] + row, response.x, x->n * sizeof(double));
    memcpy(v->argument[LAB_ARGUMENT_V] + row, response.v, x->n * sizeof(double));
    memcpy(v->argument[LAB_ARGUMENT_U] + row, response.opening, x->n * sizeof(double));
    lab_response_free(&response);
  } else if (error->status != LAB_NUMERIC) {
    return error->status;
  }
  put_logged(x, LAB_CHANNEL_U, v->argument[LAB_ARGUMENT_U] + row);
  return LAB_OK;
}

/* ---- Residuals ---- */

static void take_up(const lab_unknowns *u, const double *r, int stage, lab_residual_table *v)
{
  int e, c;
  for (e = 0; e < u->n_runs; e++) {
    const lab_run *x = &u->run[e];
    for (c = 0; c < x->n_channels; c++) {
      const lab_residual_channel *mine = lab_residual_table_channel(v, x->channel[c]);
      size_t i, row = v->first[e];
      for (i = 0; i < x->n; i++, row++, r++) {
        const double measured = lab_run_measured(x, c, i);
        if (isnan(measured))
          continue;
        mine->measured[row] = measured;
        mine->residual[stage][row] = *r;
        mine->predicted[stage][row] = measured - *r * x->sigma[c];
      }
    }
  }
}

static int collect_residuals(const lab_unknowns *u, int stage, lab_residual_table *v, lab_error *error)
{
  double *r = malloc((u->n_rows + 1) * sizeof *r);
  int status = r ? LAB_OK : lab_fail_memory(error, "residuals");
  if (status == LAB_OK)
    status = stage == LAB_STAGE_BEFORE ? lab_unknowns_errors(u, r, error) : lab_drift_errors(u, r, error);
  if (status == LAB_OK)
    take_up(u, r, stage, v);
  free(r);
  return status;
}

int lab_residual_table_collect(const lab_report *report, lab_residual_table *v, lab_error *error)
{
  const lab_unknowns *u = report->completed;
  int e;
  memset(v, 0, sizeof *v);
  survey(u, v);
  if (allocate(v, error))
    return error->status;
  lay_out_time(u, v);
  for (e = 0; e < u->n_runs; e++)
    if (respond(u, e, v, error))
      return error->status;
  return collect_residuals(report->declared, LAB_STAGE_BEFORE, v, error) ||
                 collect_residuals(report->completed, LAB_STAGE_AFTER, v, error)
             ? error->status
             : LAB_OK;
}

/* ---- Names ---- */

const char *lab_argument_key(int argument)
{
  static const char *const key[LAB_ARGUMENT_COUNT] = {"p", "x", "v", "u"};
  return key[argument];
}

const char *lab_argument_unit(const lab_report *report, int argument)
{
  static const char *const unit[LAB_ARGUMENT_COUNT] = {"Pa", "m", "m/s", "1"};
  return argument == LAB_ARGUMENT_U && report->rig->params.proportional_band > 0 ? "Pa" : unit[argument];
}

/* ---- residual.csv ---- */

static void put_head(FILE *file, const lab_residual_table *v)
{
  int c;
  fputs("run [1],t [s]", file);
  for (c = 0; c < LAB_CHANNEL_COUNT; c++) {
    const lab_channel_info *info = &lab_channels[c];
    if (lab_residual_table_channel(v, c))
      fprintf(file, ",%s [%s],%s_before [%s],%s_after [%s],%s_residual_before [1],%s_residual_after [1]", info->key,
              info->unit, info->key, info->unit, info->key, info->unit, info->key, info->key);
  }
  fputc('\n', file);
}

/* One row of one channel; empty where the run does not have it, and in a gap. */
static void put_cell(FILE *file, const lab_residual_channel *mine, size_t row)
{
  if (isnan(mine->measured[row]))
    fputs(",,,,,", file);
  else
    fprintf(file, ",%.9g,%.9g,%.9g,%.5g,%.5g", mine->measured[row], mine->predicted[LAB_STAGE_BEFORE][row],
            mine->predicted[LAB_STAGE_AFTER][row], mine->residual[LAB_STAGE_BEFORE][row],
            mine->residual[LAB_STAGE_AFTER][row]);
}

static void put_run(FILE *file, const lab_residual_table *v, int run, const lab_run *x)
{
  size_t i;
  int c;
  for (i = 0; i < x->n; i++) {
    fprintf(file, "%d,%.9g", run + 1, x->log->value[LAB_CHANNEL_TIME][x->first + i]);
    for (c = 0; c < LAB_CHANNEL_COUNT; c++)
      if (lab_residual_table_channel(v, c))
        put_cell(file, lab_residual_table_channel(v, c), v->first[run] + i);
    fputc('\n', file);
  }
}

int lab_report_residual(FILE *file, const lab_sources *from, lab_error *error)
{
  const lab_residual_table *v = &from->figures->table;
  int run;
  (void)error;
  put_head(file, v);
  for (run = 0; run < v->n_runs; run++)
    put_run(file, v, run, &from->report->completed->run[run]);
  return LAB_OK;
}

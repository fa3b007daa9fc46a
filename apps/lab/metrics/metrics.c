#include "metrics.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "metrics_private.h"
#include "../base/noise.h"

static const double seen_share = 0.0005; /* a movement is seen from this share of the stroke on, and above noise */

/* ---- Setting a figure ---- */

const lab_metric_info lab_metric_infos[LAB_METRIC_COUNT] = {
#define X(name, key, unit, standard, meaning) {key, unit, standard, meaning},
    LAB_METRIC_LIST(X)
#undef X
};

int lab_command_is_set(int command)
{
  return command == LAB_COMMAND_SET_PRESSURE || command == LAB_COMMAND_SET_POSITION;
}

const char *lab_metrics_step_signal(int command)
{
  static const char *const text[] = {"opening of the transducer", "set pressure", "chamber pressure", "set position"};
  return text[command];
}

const char *lab_metrics_static_signal(int command)
{
  return lab_command_is_set(command) ? lab_metrics_step_signal(command) : "chamber pressure";
}

double lab_span(const lab_record *r)
{
  return r->signal_high - r->signal_low;
}

void lab_metric_set(lab_metrics_work *m, int metric, double value, double uncertainty, const char *format, ...)
{
  lab_metric *it = &m->metrics->metric[metric];
  va_list list;
  it->value = value;
  it->uncertainty = uncertainty;
  va_start(list, format);
  vsnprintf(it->text, sizeof it->text, format, list);
  va_end(list);
}

void lab_metric_absent(lab_metrics_work *m, int metric, const char *format, ...)
{
  lab_metric *it = &m->metrics->metric[metric];
  va_list list;
  it->value = it->uncertainty = (double)NAN;
  va_start(list, format);
  vsnprintf(it->text, sizeof it->text, format, list);
  va_end(list);
}

void lab_metrics_absent(lab_metrics_work *m, int first, int last, const char *reason)
{
  for (; first <= last; first++)
    lab_metric_absent(m, first, "%s", reason);
}

int lab_is_off_stops(const lab_metrics_work *m, double x)
{
  static const double inside = 0.02; /* share of the stroke that counts as the stop, at either end */
  return x > inside * m->record->stroke && x < (1 - inside) * m->record->stroke;
}

/* ---- Measuring all ---- */

/* Noise of a channel: declared, or estimated; 0 where there is too little to tell. */
static int noise_of(const double *value, size_t n, double declared, double *noise, lab_error *error)
{
  *noise = declared;
  if (isnan(declared) && value && lab_noise_estimate(value, n, noise, error))
    return error->status;
  if (!(*noise >= 0))
    *noise = 0;
  return LAB_OK;
}

static int measure(lab_metrics_work *m, lab_error *error)
{
  const lab_record *r = m->record;
  if (noise_of(r->p, r->n, r->noise_p, &m->noise_p, error) || noise_of(r->x, r->n, r->noise_x, &m->noise_x, error))
    return error->status;
  m->least = fmax(LAB_SEEN * m->noise_x, seen_share * r->stroke);
  if (lab_holds_find(m, error) || lab_steps_measure(m, error) || lab_steps_report(m, error) || lab_path_find(m, error))
    return error->status;
  lab_staircase_measure(m);
  lab_loop_measure(m);
  lab_energy_measure(m);
  return lab_strokes_measure(m, error);
}

int lab_metrics_measure(const lab_record *record, lab_metrics *metrics, lab_error *error)
{
  lab_metrics_work m = {0};
  int status = LAB_OK;
  memset(metrics, 0, sizeof *metrics);
  metrics->command = record->command;
  m.record = record;
  m.metrics = metrics;
  if (record->unfit)
    lab_metrics_absent(&m, 0, LAB_METRIC_COUNT - 1, record->unfit);
  else if (!(record->stroke > 0))
    lab_metrics_absent(&m, 0, LAB_METRIC_COUNT - 1, "there is no stem: the stroke is 0");
  else if (!record->x)
    lab_metrics_absent(&m, 0, LAB_METRIC_COUNT - 1, "the record has no position");
  else if (record->n == 0)
    lab_metrics_absent(&m, 0, LAB_METRIC_COUNT - 1, "the record has no rows");
  else
    status = measure(&m, error);
  free(m.hold);
  free(m.step);
  lab_path_free(&m.path);
  lab_path_free(&m.rows);
  return status;
}

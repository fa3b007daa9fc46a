#include "metrics.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "metrics_private.h"
#include "noise.h"

static const double seen_noise = 4;      /* a movement is seen from so many standard deviations on */
static const double seen_share = 0.0005; /* and from this share of the stroke on */

const lab_metric_info lab_metric_infos[LAB_METRIC_COUNT] = {
#define X(name, key, unit, standard, meaning) {key, unit, standard, meaning},
    LAB_METRIC_LIST(X)
#undef X
};

const char *lab_metrics_step_signal(int command)
{
  static const char *const text[] = {"opening of the transducer", "set pressure", "chamber pressure"};
  return text[command];
}

const char *lab_metrics_static_signal(int command)
{
  return command == LAB_COMMAND_SET_PRESSURE ? "set pressure" : "chamber pressure";
}

double lab_span(const lab_record *r)
{
  return r->signal_high - r->signal_low;
}

void lab_metric_give(lab_measuring *m, int metric, double value, double uncertainty, const char *format, ...)
{
  lab_metric *it = &m->metrics->metric[metric];
  va_list list;
  it->value = value;
  it->uncertainty = uncertainty;
  va_start(list, format);
  vsnprintf(it->text, sizeof it->text, format, list);
  va_end(list);
}

void lab_metric_deny(lab_measuring *m, int metric, const char *format, ...)
{
  lab_metric *it = &m->metrics->metric[metric];
  va_list list;
  it->value = it->uncertainty = (double)NAN;
  va_start(list, format);
  vsnprintf(it->text, sizeof it->text, format, list);
  va_end(list);
}

lab_part lab_part_mean(const lab_record *r, const double *value, size_t begin, size_t end, int k)
{
  const double from = r->t[begin], whole = r->t[end - 1] - from;
  lab_part part = {0, 0};
  size_t i;
  for (i = begin; i < end; i++) {
    const double share = whole > 0 ? (r->t[i] - from) / whole : 1;
    if (isnan(value[i]) || (int)fmin(LAB_PARTS * share, LAB_PARTS - 1) != k)
      continue;
    part.mean += value[i];
    part.n++;
  }
  part.mean = part.n ? part.mean / (double)part.n : (double)NAN;
  return part;
}

lab_rest lab_rest_of(const lab_record *r, const double *value, size_t begin, size_t end, double noise)
{
  const lab_part before = lab_part_mean(r, value, begin, end, LAB_PARTS - 2);
  const lab_part last = lab_part_mean(r, value, begin, end, LAB_PARTS - 1);
  lab_rest rest = {(double)NAN, (double)NAN, (double)NAN};
  if (last.n == 0 || before.n == 0)
    return rest;
  rest.level = last.mean;
  rest.error = 2 * noise / sqrt((double)last.n);
  noise *= seen_noise * sqrt(1 / (double)before.n + 1 / (double)last.n);
  rest.drift = fmax(fabs(last.mean - before.mean) - noise, 0);
  return rest;
}

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

static void deny_all(lab_measuring *m, const char *reason)
{
  int i;
  for (i = 0; i < LAB_METRIC_COUNT; i++)
    lab_metric_deny(m, i, "%s", reason);
}

static int measure(lab_measuring *m, lab_error *error)
{
  const lab_record *r = m->record;
  if (noise_of(r->p, r->n, r->noise_p, &m->noise_p, error) || noise_of(r->x, r->n, r->noise_x, &m->noise_x, error))
    return error->status;
  m->least = fmax(seen_noise * m->noise_x, seen_share * r->stroke);
  if (lab_holds_find(m, error) || lab_steps_measure(m, error) || lab_steps_report(m, error) || lab_path_find(m, error))
    return error->status;
  lab_staircase_measure(m);
  lab_loop_measure(m);
  lab_energy_measure(m);
  return lab_strokes_measure(m, error);
}

int lab_metrics_measure(const lab_record *record, lab_metrics *metrics, lab_error *error)
{
  lab_measuring m = {0};
  int status = LAB_OK;
  memset(metrics, 0, sizeof *metrics);
  metrics->command = record->command;
  m.record = record;
  m.metrics = metrics;
  if (record->unfit)
    deny_all(&m, record->unfit);
  else if (!(record->stroke > 0))
    deny_all(&m, "there is no stem: the stroke is 0");
  else if (!record->x)
    deny_all(&m, "the record has no position");
  else if (record->n == 0)
    deny_all(&m, "the record has no rows");
  else
    status = measure(&m, error);
  free(m.hold);
  free(m.step);
  lab_path_free(&m.path);
  lab_path_free(&m.rows);
  return status;
}

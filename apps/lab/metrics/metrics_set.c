#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "metrics_private.h"

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

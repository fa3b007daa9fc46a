#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "metrics_private.h"

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

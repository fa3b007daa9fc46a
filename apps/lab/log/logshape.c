#include "logread.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- The way back of a loop ---- */

static void swap_rows(lab_log *log, size_t a, size_t b)
{
  const int line = log->line[a];
  int c;
  log->line[a] = log->line[b];
  log->line[b] = line;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    if (log->value[c] && c != LAB_CHANNEL_TIME) {
      const double value = log->value[c][a];
      log->value[c][a] = log->value[c][b];
      log->value[c][b] = value;
    }
}

/* Each run goes up twice: from where the channel first falls, its rows are the way back, end first. */
static int reverse_way_back(lab_log *log, int channel, lab_error *error)
{
  const double *value = log->value[channel];
  size_t run;
  if (!value)
    return lab_fail(error, LAB_DATA, "%s: log.way_back needs a column %s", log->path, lab_channels[channel].key);
  for (run = 0; run < log->n_runs; run++) {
    size_t a = log->run[run] + 1, b = log->run[run + 1];
    while (a < b && !(value[a] < value[a - 1]))
      a++;
    if (a == b)
      return lab_fail(error, LAB_DATA, "%s:%d: expected %s to fall once in this run, where the way back begins",
                      log->path, log->line[log->run[run]], lab_channels[channel].key);
    while (a + 1 < b)
      swap_rows(log, a++, --b);
  }
  return LAB_OK;
}

/* ---- Fewer rows ---- */

static int keep_every(lab_log *log, size_t every, size_t offset, lab_error *error)
{
  size_t run, i, n = 0;
  for (run = 0; run < log->n_runs; run++) {
    const size_t first = log->run[run];
    if (first + offset >= log->run[run + 1])
      return lab_fail(error, LAB_DATA, "%s:%d: expected more than the %zu rows before log.first in this run", log->path,
                      log->line[first], offset);
    log->run[run] = n;
    for (i = first + offset; i < log->run[run + 1]; i += every, n++)
      lab_log_copy_row(log, i, n);
  }
  log->n = log->run[log->n_runs] = n;
  return LAB_OK;
}

/* ---- Rows of one instant into one ---- */

typedef struct instant {
  double t; /* [s] */
  size_t row;
  int line; /* of the file */
} instant;

/* Rows of one instant stay in the order of the log. */
static int by_time(const void *a, const void *b)
{
  const instant *x = a, *y = b;
  if (x->t != y->t)
    return x->t < y->t ? -1 : 1;
  return x->row < y->row ? -1 : x->row > y->row;
}

/* What becomes of a channel's values in n rows of one instant. */
typedef int rule(const lab_log *log, const instant *at, size_t n, int channel, double *value, lab_error *error);

/* The one value that is there. */
static int take_only(const lab_log *log, const instant *at, size_t n, int channel, double *value, lab_error *error)
{
  size_t i;
  *value = NAN;
  for (i = 0; i < n; i++) {
    const double now = log->value[channel][at[i].row];
    if (!isnan(now) && !isnan(*value) && *value != now)
      return lab_fail(error, LAB_DATA, "%s:%d: expected one value of %s at t = %g s, found another before", log->path,
                      at[i].line, lab_channels[channel].key, at[i].t);
    *value = isnan(now) ? *value : now;
  }
  return LAB_OK;
}

/* Gaps left out; a command is that of the first row. */
static int take_mean(const lab_log *log, const instant *at, size_t n, int channel, double *value, lab_error *error)
{
  const double *all = log->value[channel];
  double sum = 0;
  size_t i, there = 0;
  (void)error;
  for (i = 0; i < n; i++)
    if (!isnan(all[at[i].row])) {
      sum += all[at[i].row];
      there++;
    }
  *value = channel == lab_log_command(log) ? all[at[0].row] : sum / (double)there;
  return LAB_OK;
}

/* Rows from the i-th on that are of its instant. */
static size_t alike(const lab_log *log, const instant *order, size_t i)
{
  size_t n = 1;
  while (i + n < log->n && order[i + n].t == order[i].t)
    n++;
  return n;
}

/* Each instant becomes one row, whose line is that of its first. */
static int unite_all(lab_log *log, instant *order, double *made, rule *take, lab_error *error)
{
  size_t i, n = 0;
  int c;
  for (i = 0; i < log->n; i++)
    order[i] = (instant){log->value[LAB_CHANNEL_TIME][i], i, log->line[i]};
  qsort(order, log->n, sizeof *order, by_time);
  for (c = 0; c < LAB_CHANNEL_COUNT; c++) {
    for (i = n = 0; log->value[c] && i < log->n; i += alike(log, order, i))
      if (take(log, &order[i], alike(log, order, i), c, &made[n++], error))
        return error->status;
    if (log->value[c])
      memcpy(log->value[c], made, n * sizeof *made);
  }
  for (i = n = 0; i < log->n; i += alike(log, order, i))
    log->line[n++] = order[i].line;
  log->n = n;
  return LAB_OK;
}

static int unite(lab_log *log, rule *take, lab_error *error)
{
  instant *order = malloc(log->n * sizeof *order);
  double *made = malloc(log->n * sizeof *made);
  int status = order && made ? unite_all(log, order, made, take, error) : lab_fail_memory(error, log->path);
  free(order);
  free(made);
  return status;
}

static int mean_of_runs(lab_log *log, lab_error *error)
{
  if (unite(log, take_mean, error))
    return error->status;
  log->run[1] = log->n;
  log->n_runs = 1;
  return LAB_OK;
}

/* A command holds until the next one. */
static int hold_command(lab_log *log, lab_error *error)
{
  const int command = lab_log_command(log);
  double *u = command < 0 ? NULL : log->value[command];
  size_t i;
  if (u && isnan(u[0]))
    return lab_fail(error, LAB_DATA, "%s:%d: expected a command %s at the first instant, found none", log->path,
                    log->line[0], lab_channels[command].key);
  for (i = 1; u && i < log->n; i++)
    if (isnan(u[i]))
      u[i] = u[i - 1];
  return LAB_OK;
}

int lab_log_join(lab_log *log, lab_error *error)
{
  return unite(log, take_only, error) ? error->status : hold_command(log, error);
}

/* ---- Rows before each run ---- */

static int is_command(int channel)
{
  return channel == LAB_CHANNEL_U || channel == LAB_CHANNEL_SP;
}

/* Whether a row of the lead has anything in a channel. */
static int has_lead(const lab_log_format *format, int k, int channel)
{
  return !isnan(format->lead[k][channel]) || format->lead_first[k][channel] || format->lead_last[k][channel];
}

/* Room for the lead in every channel; one that only the lead has is a gap in all rows, or its last command. */
static int make_room(lab_log *log, const lab_log_format *format, lab_error *error)
{
  const size_t rows = log->n + log->n_runs * (size_t)format->n_lead;
  int *line = realloc(log->line, rows * sizeof *line);
  int c, k;
  size_t i;
  log->line = line ? line : log->line;
  for (c = 0; line && c < LAB_CHANNEL_COUNT; c++) {
    const int is_new = !log->value[c];
    double *value;
    for (k = 0; k < format->n_lead && is_new && !has_lead(format, k, c); k++)
      continue;
    if (k == format->n_lead)
      continue;
    if (!(value = realloc(log->value[c], rows * sizeof *value)))
      return lab_fail_memory(error, log->path);
    log->value[c] = value;
    for (i = 0; is_new && i < log->n; i++)
      value[i] = is_command(c) ? format->lead[format->n_lead - 1][c] : (double)NAN;
  }
  return line ? LAB_OK : lab_fail_memory(error, log->path);
}

/* The first or last value of a channel in rows first..end - 1 that is no gap; NaN if there is none. */
static double end_value(const double *value, size_t first, size_t end, int last)
{
  for (; value && first < end; first += !last, end -= (size_t)last)
    if (!isnan(value[last ? end - 1 : first]))
      return value[last ? end - 1 : first];
  return (double)NAN;
}

/* What the lead says of a channel in its row k, before a run in rows first..end - 1. */
static double lead_value(const lab_log *log, const lab_log_format *format, int k, int channel, size_t first, size_t end)
{
  const int from_first = format->lead_first[k][channel], from_last = format->lead_last[k][channel];
  double value = format->lead[k][channel];
  if (from_first || from_last)
    value = end_value(log->value[from_first ? from_first - 1 : from_last - 1], first, end, !from_first);
  return is_command(channel) && isnan(value) ? log->value[channel][first] : value;
}

/* Runs move back, the last one first, each by the leads of those before it and its own. */
static int put_lead(lab_log *log, const lab_log_format *format, lab_error *error)
{
  const double last = format->lead[format->n_lead - 1][LAB_CHANNEL_TIME];
  size_t run, end = log->n, to = log->n + log->n_runs * (size_t)format->n_lead;
  int c, k;
  for (run = 0; run < log->n_runs; run++)
    if (log->value[LAB_CHANNEL_TIME][log->run[run]] <= last)
      return lab_fail(error, LAB_DATA, "%s:%d: expected a run that begins after its lead, %g s, found %g s", log->path,
                      log->line[log->run[run]], last, log->value[LAB_CHANNEL_TIME][log->run[run]]);
  if (make_room(log, format, error))
    return error->status;
  log->n = log->run[log->n_runs] = to;
  while (run-- > 0) {
    const size_t rows = end - log->run[run], first = to - rows;
    while (end > log->run[run])
      lab_log_copy_row(log, --end, --to);
    for (k = format->n_lead - 1; k >= 0; k--) {
      log->line[--to] = log->line[first];
      for (c = 0; c < LAB_CHANNEL_COUNT; c++)
        if (log->value[c])
          log->value[c][to] = lead_value(log, format, k, c, first, first + rows);
    }
    log->run[run] = to;
  }
  return LAB_OK;
}

int lab_log_shape(lab_log *log, const lab_log_format *format, lab_error *error)
{
  if (format->way_back >= 0 && reverse_way_back(log, format->way_back, error))
    return error->status;
  if ((format->every > 1 || format->first > 0) && keep_every(log, (size_t)format->every, (size_t)format->first, error))
    return error->status;
  if (format->runs == LAB_RUNS_MEAN && mean_of_runs(log, error))
    return error->status;
  return format->n_lead > 0 ? put_lead(log, format, error) : LAB_OK;
}

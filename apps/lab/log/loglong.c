#include "loglong.h"

#include <math.h>
#include <stdlib.h>

#include "instants.h"

/* Put the rows of one channel in order, joined into `to[i]` for the i-th instant. */
static int join_channel(const lab_log *log, const lab_instant *order, const size_t *to, int channel, double *joined,
                        lab_error *error)
{
  double *value = log->value[channel];
  size_t i;
  for (i = 0; i < log->n; i++)
    joined[i] = NAN;
  for (i = 0; i < log->n; i++) {
    double now = value[order[i].row];
    double *place = &joined[to[i]];
    if (isnan(now))
      continue;
    if (!isnan(*place) && *place != now)
      return lab_fail(error, LAB_DATA, "%s:%d: expected one value of %s at t = %g s, found another before", log->path,
                      log->line[order[i].row], lab_channels[channel].key, order[i].t);
    *place = now;
  }
  for (i = 0; i < log->n; i++)
    value[i] = joined[i];
  return LAB_OK;
}

/* Where each row goes, by time.  Returns: the number of instants. */
static size_t number_instants(const lab_instant *order, size_t n, size_t *to)
{
  size_t i, last = 0;
  for (i = 0; i < n; i++) {
    last += i > 0 && order[i].t != order[i - 1].t;
    to[i] = last;
  }
  return last + 1;
}

/* Lines of the first row of each of n instants. */
static void join_lines(lab_log *log, const lab_instant *order, const size_t *to, size_t n, double *scratch)
{
  size_t i;
  for (i = log->n; i-- > 0;)
    scratch[to[i]] = log->line[order[i].row];
  for (i = 0; i < n; i++)
    log->line[i] = (int)scratch[i];
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

static int join(lab_log *log, lab_instant *order, size_t *to, double *scratch, lab_error *error)
{
  size_t i, n;
  int channel;
  for (i = 0; i < log->n; i++)
    scratch[i] = 0;
  lab_instants_of(log, order);
  n = number_instants(order, log->n, to);
  for (channel = 0; channel < LAB_CHANNEL_COUNT; channel++)
    if (log->value[channel] && join_channel(log, order, to, channel, scratch, error))
      return error->status;
  join_lines(log, order, to, n, scratch);
  log->n = n;
  return hold_command(log, error);
}

int lab_log_join(lab_log *log, lab_error *error)
{
  lab_instant *order = malloc(log->n * sizeof *order);
  size_t *to = malloc(log->n * sizeof *to);
  double *scratch = malloc(log->n * sizeof *scratch);
  int status = order && to && scratch ? join(log, order, to, scratch, error) : lab_fail_memory(error, log->path);
  free(order);
  free(to);
  free(scratch);
  return status;
}

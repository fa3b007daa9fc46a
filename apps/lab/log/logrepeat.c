#include "logread.h"

static const double fits = 1.5; /* steps of the clock that the rows of one stamp may take: some come late */

/* Rows of one stamp, from one on. */
static size_t rows_of_stamp(const double *t, size_t from, size_t end)
{
  size_t i = from + 1;
  while (i < end && t[i] == t[from])
    i++;
  return i - from;
}

static int refuse(const lab_log *log, size_t row, lab_error *error)
{
  const double t = log->value[LAB_CHANNEL_TIME][row];
  lab_fail(error, LAB_DATA, LAB_EXPECTED_LATER, t, t, "", LAB_LEAVE_OUT);
  return lab_fail_in(error, "%s:%d", log->path, log->line[row]);
}

static int spread_run(lab_log *log, size_t first, size_t end, lab_error *error)
{
  double *t = log->value[LAB_CHANNEL_TIME];
  const double usual = (t[end - 1] - t[first]) / (double)(end - first); /* distance of rows */
  double step = 0; /* to the next stamp; of the last one, that before */
  size_t i, k, m;
  for (i = first; i < end; i += m) {
    const double begin = t[i];
    m = rows_of_stamp(t, i, end);
    step = i + m < end ? t[i + m] - begin : step;
    if (m > 1 && !((double)(m - 1) * usual < fits * step))
      return refuse(log, i + 1, error);
    for (k = 1; k < m; k++)
      t[i + k] = begin + step * (double)k / (double)m;
    log->repeated += m - 1;
  }
  return LAB_OK;
}

int lab_log_spread_repeats(lab_log *log, lab_error *error)
{
  size_t run;
  for (run = 0; run < log->n_runs; run++)
    if (spread_run(log, log->run[run], log->run[run + 1], error))
      return error->status;
  return LAB_OK;
}

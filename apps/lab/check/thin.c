#include "mend.h"
#include "../base/text.h"

static int begins_or_ends(const lab_log *log, size_t run, size_t i)
{
  return i == log->run[run] || i + 1 == log->run[run + 1];
}

static int changes(const lab_log *log, size_t run, size_t i)
{
  const int command = lab_log_command(log);
  const double *u = command < 0 ? NULL : log->value[command];
  return u && i > log->run[run] && i < log->run[run + 1] && u[i] != u[i - 1];
}

static size_t count_changes(const lab_log *log)
{
  size_t run, i, n = 0;
  for (run = 0; run < log->n_runs; run++)
    for (i = log->run[run]; i < log->run[run + 1]; i++)
      n += (size_t)changes(log, run, i);
  return n;
}

/* The command of a row becomes its mean up to the next row kept. */
static void average_command(lab_log *log, size_t i, size_t end)
{
  double *u = log->value[lab_log_command(log)], sum = 0;
  size_t k;
  for (k = i; k < end; k++)
    sum += u[k];
  u[i] = sum / (double)(end - i);
}

/* Keep every step-th row of a run, and every change of command unless `busy`.  Returns: rows kept, to `to` on. */
static size_t thin_run(lab_log *log, size_t run, size_t step, int busy, size_t to)
{
  const size_t first = log->run[run], end = log->run[run + 1];
  size_t i, kept = 0;
  for (i = first; i < end; i++) {
    const int whole = (i - first) % step == 0;
    if (!whole && !begins_or_ends(log, run, i) && (busy || (!changes(log, run, i) && !changes(log, run, i + 1))))
      continue;
    if (busy && whole)
      average_command(log, i, i + step < end ? i + step : end);
    lab_log_copy_row(log, i, to + kept++);
  }
  return kept;
}

void lab_log_thin(lab_log *log, size_t most, lab_limitations *limitations)
{
  const size_t all = log->n, n_changes = count_changes(log);
  const int busy = n_changes > most / 4;
  const size_t room = busy ? most : most - 2 * n_changes;
  const size_t step = (all + room - 1) / room;
  size_t run, kept = 0;
  if (all <= most)
    return;
  for (run = 0; run < log->n_runs; run++) {
    const size_t n = thin_run(log, run, step, busy, kept);
    log->run[run] = kept;
    kept += n;
  }
  log->run[log->n_runs] = log->n = kept;
  lab_limitation(limitations, "%s: %zu of %zu rows are used, one in %zu%s.", lab_file_name(log->path), kept, all, step,
                 busy ? "; the command, which changes often, is averaged between them"
                      : " and those where the command changes");
}

/* Times of a clock that goes in steps. */
#include "logread.h"

#include <math.h>

#include "../base/format.h"
#include "../base/text.h"

enum { FEWEST = 20 };

static const double on_grid = 1e-6; /* of a step */
static const double coarse = 0.02;  /* of the distance of rows: a finer grid does no harm */
static const double rounded = 0.55; /* of a step: the farthest from even stamps that rounding takes a stamp */
static const double still_even = 2; /* the same where rows come late as well: by judgement; 0.72 in two logs */

/* Whether every stamp is a multiple of `step`. */
static int lies_on(const double *t, size_t n, double step)
{
  size_t i;
  for (i = 0; i < n; i++)
    if (fabs((t[i] - t[0]) / step - nearbyint((t[i] - t[0]) / step)) > on_grid * fmax(1, fabs(t[i]) / step * 1e-6))
      return 0;
  return 1;
}

/* The coarsest of 1 s, 0.5, 0.2, 0.1 ... 0.1 ms of which every stamp is a multiple; 0 without one. */
static double grid_of(const double *t, size_t n)
{
  static const double lead[] = {1, 0.5, 0.2};
  double decade = 1;
  int k;
  for (k = 0; k < 12; k++) {
    if (lies_on(t, n, decade * lead[k % 3]))
      return decade * lead[k % 3];
    decade *= k % 3 == 2 ? 0.1 : 1;
  }
  return 0;
}

/* A straight line through the stamps over the number of their row, rows that are missing counted. */
typedef struct line {
  double begin, step;
} line;

/* Rows from one stamp to the next, at a distance of `step`. */
static double rows_between(const double *t, size_t i, double grid, double step)
{
  const double gap = t[i] - t[i - 1];
  return gap < step + 1.5 * grid ? 1 : nearbyint(gap / step);
}

static line through(const double *t, size_t n, double grid, double step)
{
  double at = 0, sk = 0, skk = 0, st = 0, skt = 0;
  line l;
  size_t i;
  for (i = 0; i < n; i++) {
    at += i > 0 ? rows_between(t, i, grid, step) : 0;
    sk += at;
    skk += at * at;
    st += t[i] - t[0];
    skt += at * (t[i] - t[0]);
  }
  l.step = ((double)n * skt - sk * st) / ((double)n * skk - sk * sk);
  l.begin = t[0] + (st - l.step * sk) / (double)n;
  return l;
}

static double usual_step(const double *t, size_t n)
{
  double longest = HUGE_VAL, sum = 0, count = 0;
  int pass;
  size_t i;
  for (pass = 0; pass < 2; pass++) { /* the second without the gaps */
    for (sum = count = 0, i = 1; i < n; i++)
      if (t[i] - t[i - 1] < longest) {
        sum += t[i] - t[i - 1];
        count++;
      }
    longest = 2.5 * sum / count;
  }
  return sum / count;
}

/* Farthest that a stamp is from the line; sets the stamps onto it if `set`. */
static double farthest(double *t, size_t n, double grid, line l, int set)
{
  double at = 0, before = t[0], most = 0;
  size_t i;
  for (i = 0; i < n; i++) {
    const double now = t[i], pair[2] = {before, now};
    at += i > 0 ? rows_between(pair, 1, grid, l.step) : 0;
    most = fmax(most, fabs(now - (l.begin + l.step * at)));
    if (set)
      t[i] = l.begin + l.step * at;
    before = now;
  }
  return most;
}

/* Spread the stamps of a run evenly, if they are rounded and were even.
 * Out:  log->clock_step, log->stamp_step  the grid, of stamps that were spread and of those that are rounded as well */
static void spread(lab_log *log, size_t first, size_t n, double grid)
{
  double *t = log->value[LAB_CHANNEL_TIME] + first;
  const double step = usual_step(t, n);
  const line l = through(t, n, grid, step);
  const double most = farthest(t, n, grid, l, 0);
  if (!(grid > coarse * step && most > on_grid * grid))
    return;
  if (most < rounded * grid) {
    farthest(t, n, grid, l, 1);
    log->clock_step = grid;
  } else if (most < still_even * grid) {
    log->stamp_step = grid;
  }
}

/* As lab_log_even_stamps, in silence. */
static void make_even(lab_log *log)
{
  size_t run;
  double grid;
  if (log->n < FEWEST)
    return;
  grid = grid_of(log->value[LAB_CHANNEL_TIME], log->n);
  for (run = 0; run < log->n_runs && grid > 0; run++) {
    const size_t first = log->run[run], n = log->run[run + 1] - first;
    if (n >= FEWEST)
      spread(log, first, n, grid);
  }
}

void lab_log_even_stamps(lab_log *log, lab_limitations *limitations)
{
  char text[LAB_FORMAT_TEXT];
  if (log->clock_step == 0 && log->stamp_step == 0) /* not where times were one: those have been asked */
    make_even(log);
  if (log->clock_step > 0)
    lab_limitation(limitations, "%s: the time is rounded to %s; the rows are taken to be at even distances.",
                   lab_file_name(log->path), lab_format_quantity(log->clock_step, "s", 3, text));
}

/* ---- Rows of one time ---- */

static int refuse(const lab_log *log, size_t row, lab_error *error)
{
  const double t = log->value[LAB_CHANNEL_TIME][row];
  lab_fail(error, LAB_DATA, LAB_EXPECTED_LATER, t, t, "", LAB_LEAVE_OUT);
  return lab_fail_in(error, "%s:%d", log->path, log->line[row]);
}

/* Rows of one time, from one on. */
static size_t rows_of_time(const double *t, size_t from, size_t end)
{
  size_t i = from + 1;
  while (i < end && t[i] == t[from])
    i++;
  return i - from;
}

/* The step of the clock, which is the least from one time to the next, 0 if all are one.  Out: times  different ones */
static double step_of(const double *t, size_t first, size_t end, size_t *times)
{
  double step = 0;
  size_t i;
  *times = 1;
  for (i = first + 1; i < end; i++)
    if (t[i] > t[i - 1]) {
      step = *times == 1 ? t[i] - t[i - 1] : fmin(step, t[i] - t[i - 1]);
      ++*times;
    }
  return step;
}

static int part(lab_log *log, size_t first, size_t end, lab_error *error)
{
  double *t = log->value[LAB_CHANNEL_TIME];
  size_t times, i, k, m;
  const double step = step_of(t, first, end, &times);
  const size_t most = 2 * (end - first) / times + 1; /* rows of one time: some come late, by judgement */
  for (i = first; i < end; i += m) {
    const double begin = t[i];
    m = rows_of_time(t, i, end);
    if (m > 1 && (m > most || !(begin + step / (double)m > begin)))
      return refuse(log, i + 1, error);
    for (k = 1; k < m; k++)
      t[i + k] = begin + step * (double)k / (double)m;
    log->repeated += m - 1;
  }
  return LAB_OK;
}

int lab_log_part_repeats(lab_log *log, lab_error *error)
{
  size_t run;
  make_even(log);
  for (run = 0; run < log->n_runs; run++)
    if (part(log, log->run[run], log->run[run + 1], error))
      return error->status;
  return LAB_OK;
}

#include "weights.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "../base/format.h"
#include "../base/noise.h"
#include "drift.h"

static const double median_of_square = 0.45493642311957283; /* of a normal value */
static const double of_range = 0.005; /* of stroke or supply: noise of an ordinary transmitter, by judgement */
static const double few_still = 0.1;  /* share of the rows, by judgement */
static const double of_a_model = 0.3; /* correlation of errors from row to row, by judgement */
static const double still = 0.01;     /* square of what a row changes, in noise */
static const double at_rest = 0.25;   /* times the noise: what a prediction changes over a stretch at rest */
static const double unmoved = 1;      /* times that of x: what a set position moves there */
static const double white = 0.15; /* by which variances from first and from second differences of white noise differ */
static const double larger = 1.2; /* times the declared noise, from where on the log is believed */
static const double wanders = 10; /* times that: what is as large as this is no noise */
static const double certain = 5, likely = 2; /* deviations: of all rows, and of those in which little changes */
static const double usual_change = 16;       /* square of what changes in these, in noise */
static const double steps = 1.5;             /* times the noise, from where on the resolution shows */
static const double hidden = 2.5;            /* times the noise, up to which a resolution is rounded to at random */
static const double share_of_row = 0.5;      /* the longest error of a time */
static const double reach = 3;               /* deviations that a command may be outside of its rows */
enum { FEWEST = 100, SHORTEST = 24 };

/* Rows of all runs and channels: squares of second differences over their expectation, were there noise alone; mean
 * square of the slope over noise in the same rows [1/s2]; the same for the change a row. */
typedef struct rows {
  size_t n;
  double *square, *slope2, *change2;
} rows;

/* ---- Slopes and differences ---- */

/* Slope of what is predicted, over noise, at row i [1/s]; 0 beside a gap and at the ends. */
static double slope_at(const lab_run *x, int c, const double *r, size_t i)
{
  const double *t = x->log->value[LAB_CHANNEL_TIME] + x->first;
  double before, after;
  if (i == 0 || i + 1 >= x->n)
    return 0;
  before = lab_run_measured(x, c, i - 1) / x->sigma[c] - r[i - 1];
  after = lab_run_measured(x, c, i + 1) / x->sigma[c] - r[i + 1];
  return isnan(after - before) ? 0 : (after - before) / (t[i + 1] - t[i - 1]);
}

static double square(double a)
{
  return a * a;
}

static int has_row(const lab_run *x, int c, size_t i)
{
  return i > 0 && i + 1 < x->n &&
         !isnan(lab_run_measured(x, c, i - 1) + lab_run_measured(x, c, i) + lab_run_measured(x, c, i + 1));
}

static double spacing_at(const lab_run *x, size_t i)
{
  const double *t = x->log->value[LAB_CHANNEL_TIME] + x->first;
  return 0.5 * (t[i + 1] - t[i - 1]);
}

static double slope2_at(const lab_run *x, int c, const double *r, size_t i)
{
  return (square(slope_at(x, c, r, i - 1)) + 4 * square(slope_at(x, c, r, i)) + square(slope_at(x, c, r, i + 1))) / 6;
}

static double second(const double *r, size_t i)
{
  return square(r[i + 1] - 2 * r[i] + r[i - 1]) / 6;
}

/* What lies between two ends. */
typedef struct range {
  double low, high;
} range;

/* Returns: how far the ends are apart with one value more; a gap is left out */
static double widen_range(range *of, double value)
{
  of->low = fmin(of->low, value);
  of->high = fmax(of->high, value);
  return of->high - of->low;
}

/* By how much a set position moves the stem that follows it, over the noise of x; NULL: there is no set position. */
static const double *set_position(const lab_run *x, double *scale)
{
  int c;
  *scale = 0;
  for (c = 0; c < x->n_channels; c++)
    if (x->channel[c] == LAB_CHANNEL_X)
      *scale = (double)x->rig->params.stroke / x->sigma[c];
  return lab_log_command(x->log) == LAB_CHANNEL_SP ? x->log->value[LAB_CHANNEL_SP] + x->first : NULL;
}

/* Rows from i on in which the prediction of a channel stays where it is, and no set position asks for more. */
static size_t rows_at_rest(const lab_run *x, int c, const double *r, size_t i)
{
  double scale;
  const double *set = set_position(x, &scale);
  range predicted = {HUGE_VAL, -HUGE_VAL}, asked = predicted;
  size_t k;
  for (k = i; k < x->n; k++)
    if (widen_range(&predicted, lab_run_measured(x, c, k) / x->sigma[c] - r[k]) > at_rest ||
        (set && scale * widen_range(&asked, set[k]) > unmoved))
      break;
  return k - i;
}

/* Stretches at rest of one channel of a run.
 * Out:     value  n, with gaps as NaN
 *          rest   at most n / SHORTEST
 * Returns: their number */
static int find_rest(const lab_run *x, int c, const double *r, double *value, lab_stretch *rest)
{
  size_t i, k, many;
  int n = 0;
  for (i = 0; i < x->n; i += many) {
    many = rows_at_rest(x, c, r, i);
    for (k = i; k < i + many; k++)
      value[k] = isnan(lab_run_measured(x, c, k)) ? (double)NAN : r[k];
    if (many >= SHORTEST)
      rest[n++] = (lab_stretch){value + i, many};
  }
  return n;
}

static double deviation(double *size, size_t n)
{
  return sqrt(lab_median(size, n) / median_of_square);
}

/* Whether the noise does not hide the resolution. */
static int shows_steps(const lab_run *x, int c)
{
  return x->resolution[c] > steps * x->sigma[c];
}

/* The noise of a channel is so many times what it counted as.  In/out: r  errors over noise */
static void set_level(lab_run *x, int c, double level, double *r)
{
  size_t i;
  x->sigma[c] *= level;
  for (i = 0; i < x->n; i++)
    r[i] /= level;
}

/* ---- The colour of the noise ---- */

/* By all rests; else by the one before any command, where nothing can be missing. */
static int colour_of(lab_run *x, int c, const double *r, double *value, lab_stretch *rest, double *level,
                     lab_error *error)
{
  const int n = find_rest(x, c, r, value, rest);
  const lab_stretch first = n > 0 ? rest[0] : (lab_stretch){NULL, 0};
  if (lab_colour_estimate(rest, n, &x->colour[c], level, error) || x->colour[c].memory != 0 || first.value != value)
    return error->status;
  rest[0] = first;
  return lab_colour_estimate(rest, 1, &x->colour[c], level, error);
}

/* Noise that has no memory after all has not raised what it counts as.  In/out: r  errors over noise */
static void take_back_level(lab_run *x, int c, double *r)
{
  if (x->raised[c] > 0)
    set_level(x, c, 1 / x->raised[c], r);
  x->raised[c] = 0;
  x->level[c] = 0;
}

/* In/out: r  errors over noise  In: value  room for a run  Returns: whether some noise has another memory than before
 */
static int set_colours(lab_run *x, double *r, double *value, lab_error *error)
{
  lab_stretch *rest = malloc((x->n / SHORTEST + 1) * sizeof *rest);
  int c, any = 0, status = rest ? LAB_OK : lab_fail_memory(error, "stretches");
  for (c = 0; c < x->n_channels && status == LAB_OK; c++, r += x->n) {
    const double before = x->colour[c].memory;
    double level = 1;
    if (x->resolution[c] > hidden * x->sigma[c])
      continue;
    status = colour_of(x, c, r, value, rest, &level, error);
    if (!isnan(x->rig->noise[x->channel[c]]) && level > wanders)
      x->colour[c].memory = x->colour[c].share = 0;
    any |= x->colour[c].memory != before;
    if (x->colour[c].memory == 0) {
      if (before != 0)
        take_back_level(x, c, r);
      continue;
    }
    x->level[c] = level;
    if (isnan(x->rig->noise[x->channel[c]]) || level > larger) {
      set_level(x, c, level, r);
      x->raised[c] = level * (x->raised[c] > 0 ? x->raised[c] : 1);
    }
  }
  free(rest);
  return any;
}

/* ---- The level of the noise ---- */

/* Deviation of the noise of one channel of a run while nothing moves, over what it counts as; 0 where that is not to be
 * told: too few rows, noise with memory, or steps that hide it. */
static double level_of(const lab_run *x, int c, const double *r, double *first, double *room)
{
  double by_first, by_second;
  size_t i, n = 0;
  for (i = 1; i + 1 < x->n; i++)
    if (has_row(x, c, i) && slope2_at(x, c, r, i) * square(spacing_at(x, i)) < still) {
      first[n] = square(r[i] - r[i - 1]) / 2;
      room[n++] = second(r, i);
    }
  if (n < FEWEST)
    return 0;
  by_first = deviation(first, n);
  by_second = deviation(room, n);
  return fabs(by_first / by_second - 1) < white && by_second * x->sigma[c] > x->resolution[c] ? by_second : 0;
}

/* Whether the errors of a channel are plainly a model's and not noise of a sensor: next to nothing of it stands still,
 * and they go on from row to row. */
static int are_of_model(const lab_run *x, int c, const double *r)
{
  double along = 0, all = 0;
  size_t i, n = 0, still_rows = 0;
  for (i = 1; i + 1 < x->n; i++)
    if (has_row(x, c, i)) {
      still_rows += slope2_at(x, c, r, i) * square(spacing_at(x, i)) < still;
      along += r[i] * r[i - 1];
      all += r[i] * r[i];
      n++;
    }
  return n >= FEWEST && (double)still_rows < few_still * (double)n && along > of_a_model * all;
}

/* The noise of an ordinary transmitter, over what that of a channel counts as; infinite where there is no span for it.
 */
static double ordinary(const lab_run *x, int c)
{
  const double span = x->channel[c] == LAB_CHANNEL_X   ? (double)x->rig->params.stroke
                      : x->channel[c] == LAB_CHANNEL_P ? (double)x->rig->params.supply_pressure
                                                       : HUGE_VAL;
  return of_range * span / x->sigma[c];
}

/* By how much the noise of a channel of a run was plainly taken for too much, where no rig file tells it: it is no more
 * than all errors together, or where these are the model's than that of an ordinary transmitter; and the estimate from
 * rows side by side is too large where much moves between them. 1 where that is not to be told; no less than the steps
 * of the values leave.
 * In:      spare  times that errors are larger beside values that were not fitted to them */
static double overrated(const lab_run *x, int c, const double *r, double spare)
{
  const double *value = x->log->value[x->channel[c]] + x->first;
  double sum = 0, most;
  size_t i, n = 0;
  if (!isnan(x->rig->noise[x->channel[c]]) || x->rig->laws.pressure_input || x->jitter > 0 || x->raised[c] > 0)
    return 1;
  for (i = 0; i < x->n; i++)
    if (!isnan(lab_run_measured(x, c, i))) {
      sum += r[i] * r[i];
      n++;
    }
  most = spare * sqrt(sum / (double)n);
  if (are_of_model(x, c, r))
    most = fmin(most, ordinary(x, c));
  if (n < FEWEST / 2 || most * (1 + likely / sqrt(2 * (double)n)) > 1 / larger)
    return 1;
  return fmax(most, fmax(x->resolution[c], lab_smallest_step(value, x->n) / 4) / x->sigma[c]);
}

/* In/out: r  errors over noise  Returns: whether the noise counts as another now */
static int set_levels(lab_run *x, double *r, double spare, double *first, double *room)
{
  int c, any = 0;
  for (c = 0; c < x->n_channels; c++, r += x->n) {
    const double most = overrated(x, c, r, spare);
    if (most < 1) {
      set_level(x, c, most, r);
      any = 1;
    }
    if (x->colour[c].memory != 0)
      continue;
    x->level[c] = level_of(x, c, r, first, room);
    if (isnan(x->rig->noise[x->channel[c]]) || !(x->level[c] > larger))
      continue;
    set_level(x, c, x->level[c], r);
    any = 1;
  }
  return any;
}

/* ---- The clock ---- */

/* Take up the rows of a run, where steps do not spoil them. */
static void collect(const lab_run *x, const double *r, rows *to)
{
  int c;
  size_t i;
  for (c = 0; c < x->n_channels; c++, r += x->n)
    for (i = 1; i + 1 < x->n && !shows_steps(x, c); i++) {
      const double slope2 = has_row(x, c, i) ? slope2_at(x, c, r, i) : 0;
      if (!(slope2 > 0))
        continue;
      to->square[to->n] = second(r, i) / lab_colour_second_difference(&x->colour[c]);
      to->slope2[to->n] = slope2;
      to->change2[to->n++] = slope2 * square(spacing_at(x, i));
    }
}

/* By how much the squares exceed what noise and an error of the time of deviation s make of them, in deviations of that
 * sum. Rows count the more, the faster the channel moves, up to four times its noise a row; squares are cut where one
 * in a hundred of noise is.
 * In:      most  square of the change a row, in noise, beyond which a row does not take part */
static double surplus(const rows *a, double s, double most)
{
  static const double cut = 6.634896601021213, mean = 0.98186, variance = 1.72848; /* of chi-square, when it is cut */
  static const double together = 1.944; /* the same for a sum, neighbours of which share values */
  double sum = 0, square_of_weights = 0;
  size_t i;
  for (i = 0; i < a->n; i++) {
    const double w = a->change2[i] < most ? a->change2[i] / (16 + a->change2[i]) : 0;
    sum += w * (fmin(a->square[i] / (1 + s * s * a->slope2[i]), cut) - mean);
    square_of_weights += w * w;
  }
  return square_of_weights > 0 ? sum / sqrt(variance * together * square_of_weights) : 0;
}

/* The coarsest step [s] to which the times of logs are rounded; 0: to none that matters. */
static double rounding_of(const lab_run *run, int n)
{
  double step = 0;
  int e;
  for (e = 0; e < n; e++)
    step = fmax(step, run[e].log->stamp_step);
  return step;
}

/* Deviation [s] of the times of rows, at most `most`; 0 where it does not show. Where it shows only while a channel
 * moves fastest, as an error of the model does, it is at most what rounding to `step` makes. */
static double jitter_of(const rows *a, double most, double step)
{
  static const double of_step = 0.5; /* uniform: 0.29; more where a time is a step off */
  double low = 0, high = surplus(a, 0, usual_change) > likely ? most : fmin(most, of_step * step);
  int i;
  if (!(surplus(a, 0, HUGE_VAL) > certain) || surplus(a, high, HUGE_VAL) > 0)
    return 0;
  for (i = 0; i < 40; i++) {
    const double s = 0.5 * (low + high);
    *(surplus(a, s, HUGE_VAL) > 0 ? &low : &high) = s;
  }
  return high;
}

static double shortest_row(const lab_unknowns *u)
{
  double least = HUGE_VAL;
  int e;
  for (e = 0; e < u->n_runs; e++) {
    const lab_run *x = &u->run[e];
    const double *t = x->log->value[LAB_CHANNEL_TIME] + x->first;
    least = x->n > 1 ? fmin(least, (t[x->n - 1] - t[0]) / (double)(x->n - 1)) : least;
  }
  return least;
}

static void weigh(lab_run *x, const double *r, double jitter)
{
  double *w = x->weight;
  size_t i;
  int c;
  x->jitter = jitter;
  for (c = 0; c < x->n_channels; c++, r += x->n, w += x->n)
    for (i = 0; i < x->n; i++)
      w[i] /= sqrt(1 + square(w[i] * jitter * slope_at(x, c, r, i)));
}

/* Whether the command of a run changes at many rows, so that an instant cannot leave its own row. */
static int is_busy(const lab_unknowns *u, int run)
{
  int j, any = 0;
  for (j = 0; j < u->n; j++)
    any |= u->unknown[j].kind == LAB_UNKNOWN_INSTANT && u->unknown[j].index == LAB_ALL_INSTANTS &&
           u->unknown[j].run == run;
  return any;
}

/* A command may have changed before or after the rows between which the log shows it. */
static void widen(lab_unknowns *u, double jitter)
{
  int j;
  for (j = 0; j < u->n; j++) {
    lab_unknown *x = &u->unknown[j];
    if (x->kind != LAB_UNKNOWN_INSTANT || x->index == LAB_ALL_INSTANTS || is_busy(u, x->run))
      continue;
    x->lower -= reach * jitter;
    x->upper += reach * jitter;
    x->spread = hypot(x->spread, jitter);
  }
}

/* Whether the rows have their weights for the clock already. */
static int is_told(const lab_run *run, int n)
{
  int e, any = 0;
  for (e = 0; e < n; e++)
    any |= run[e].jitter > 0;
  return any;
}

/* ---- Both ---- */

static int look(lab_unknowns *u, lab_run *run, double *r, rows *a, lab_error *error)
{
  const double values = (double)u->n_values, spare = sqrt(values / fmax(values - u->n, 1));
  const double declared = run->rig->noise[LAB_CHANNEL_TIME];
  double jitter = 0, *at = r;
  int e, any = 0;
  if (lab_unknowns_errors(u, r, error))
    return 0;
  for (e = 0; e < u->n_runs; e++) {
    any |= set_colours(&run[e], at, a->square, error);
    any |= set_levels(&run[e], at, spare, a->square, a->slope2);
    at += run[e].n * (size_t)run[e].n_channels;
  }
  for (at = r, e = 0; e < u->n_runs; e++) {
    collect(&run[e], at, a);
    at += run[e].n * (size_t)run[e].n_channels;
  }
  if (error->status != LAB_OK)
    return 0;
  if (!is_told(run, u->n_runs))
    jitter = !isnan(declared) ? declared : jitter_of(a, share_of_row * shortest_row(u), rounding_of(run, u->n_runs));
  for (at = r, e = 0; jitter > 0 && e < u->n_runs; e++) {
    weigh(&run[e], at, jitter);
    at += run[e].n * (size_t)run[e].n_channels;
  }
  if (jitter > 0)
    widen(u, jitter);
  for (e = 0; e < u->n_runs && error->status == LAB_OK; e++)
    lab_drift_open(&run[e], error);
  return any || jitter > 0;
}

int lab_weigh_runs(lab_unknowns *u, lab_run *run, int *any, lab_error *error)
{
  const size_t n = u->n_rows + 1;
  double *memory = malloc(4 * n * sizeof *memory);
  rows a = {0, memory + n, memory + 2 * n, memory + 3 * n};
  *any = 0;
  error->status = LAB_OK;
  if (memory)
    *any = look(u, run, memory, &a, error);
  else
    lab_fail_memory(error, "weights");
  free(memory);
  return error->status;
}

int lab_weigh_unseen(const lab_rig *model, double jitter, lab_run *run, int n, lab_error *error)
{
  lab_unknowns *u = malloc(sizeof *u);
  double *r = NULL, *at;
  int e, status = u ? LAB_OK : lab_fail_memory(error, "weights");
  if (status == LAB_OK) {
    lab_unknowns_none(model, run, n, u);
    at = r = malloc((u->n_rows + 1) * sizeof *r);
    status = r ? lab_unknowns_errors(u, r, error) : lab_fail_memory(error, "weights");
  }
  for (e = 0; status == LAB_OK && e < n; e++) {
    weigh(&run[e], at, jitter);
    at += run[e].n * (size_t)run[e].n_channels;
  }
  free(r);
  free(u);
  return status;
}

/* ---- In words ---- */

/* The run with the largest value of what `of` tells of a channel. */
static double most_of(const lab_run *run, int n, int channel, double (*of)(const lab_run *x, int c))
{
  double most = 0;
  int e, c;
  for (e = 0; e < n; e++)
    for (c = 0; c < run[e].n_channels; c++)
      if (run[e].channel[c] == channel)
        most = fmax(most, of(&run[e], c));
  return most;
}

/* Times the noise that was declared; 0 where none was, or where the log agrees. */
static double off_level(const lab_run *x, int c)
{
  const int told = !isnan(x->rig->noise[x->channel[c]]) && x->level[c] > 0;
  return told && (x->level[c] > larger || x->level[c] < 1 / larger) ? x->level[c] : 0;
}

/* Resolution that the noise does not hide, where the rig file does not declare it. */
static double undeclared_step(const lab_run *x, int c)
{
  return isnan(x->rig->noise[x->channel[c]]) && shows_steps(x, c) ? x->resolution[c] : 0;
}

/* Correlation of the noise from row to row, by size. */
static double memory_of(const lab_run *x, int c)
{
  return fabs(x->colour[c].memory) * x->colour[c].share;
}

static double jitter_seen(const lab_run *x, int c)
{
  (void)c;
  return x->jitter;
}

void lab_weights_say(const lab_run *run, int n, lab_limitations *limitations)
{
  char text[LAB_FORMAT_TEXT];
  double jitter = 0, value;
  int c;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++) {
    const char *key = lab_channels[c].key;
    if ((value = most_of(run, n, c, off_level)) > 0)
      lab_limitation(limitations, "The noise of %s is %s times as large as the rig file says%s.", key,
                     lab_format_number(value, 2, text), value > 1 ? "; that is what counts" : "");
    if ((value = most_of(run, n, c, undeclared_step)) > 0)
      lab_limitation(limitations, "%s is recorded in steps of %s: rows within a step count as one.", key,
                     lab_format_quantity(value, lab_channels[c].unit, 3, text));
    if ((value = most_of(run, n, c, memory_of)) > 0)
      lab_limitation(limitations,
                     "The noise of %s is coloured, with a correlation of %s from row to row; it is whitened.", key,
                     lab_format_number(value, 2, text));
    jitter = fmax(jitter, most_of(run, n, c, jitter_seen));
  }
  if (jitter > 0)
    lab_limitation(limitations, "The times of the rows are uncertain by %s; rows count less the faster they move.",
                   lab_format_quantity(jitter, "s", 2, text));
}

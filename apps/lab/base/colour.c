#include "colour.h"

#include <math.h>
#include <nlopt.h>
#include <stdlib.h>
#include <string.h>

#include "array.h"
#include "whiteness.h"

enum { FEWEST = 100, TRIALS = 200, LONG = 160 };
static const double told = 13.8;   /* of twice the logarithm of the likelihood: two numbers at 1 in 1,000 */
static const double rougher = 4;   /* times the usual mean square: something moves */
static const double quiet = 0.4;   /* times the mean square of all: that of a stretch which has less noise */
static const double times = 8;     /* memories in the longest stretch, at least: more cannot be told from a level */
static const double within = 0.98; /* of the longest root: what ends there has no end in sight */

double lab_colour_whiten(const lab_colour *c, double *r, size_t n)
{
  const double fresh = (1 - c->memory * c->memory) * c->share, white = 1 - c->share;
  double mean = 0, variance = c->share, last = -1, gain = 0, size = 1, log_size = 0, sum = 0;
  size_t i;
  for (i = 0; i < n; i++) {
    double left = variance;
    if (r[i] != 0) {
      if (variance != last) { /* else as in the row before */
        size = sqrt(variance + white);
        gain = variance / (variance + white);
        log_size = 2 * log(size);
        last = variance;
      }
      sum += log_size;
      left = variance * (1 - gain);
      r[i] -= mean;
      mean += gain * r[i];
      r[i] /= size;
    }
    mean *= c->memory;
    left = c->memory * c->memory * left + fresh;
    variance = fabs(left - variance) < 1e-12 ? variance : left;
  }
  return sum;
}

double lab_colour_second_difference(const lab_colour *c)
{
  const double m = c->memory;
  return 1 - c->share + c->share * (1 - 4 * m / 3 + m * m / 3);
}

/* ---- Estimate ---- */

static const lab_colour white = {0, 0};

/* What a stretch may have beside noise: a level, a trend, and what still moves at its beginning. */
enum { LEVEL, TREND, QUICK, SLOW, COLUMNS };

static double column_at(int column, size_t i, size_t n)
{
  static const double decays[COLUMNS] = {[QUICK] = 16, [SLOW] = 4}; /* e-fold over the stretch */
  return column == LEVEL ? 1 : column == TREND ? (double)i + 1 : exp(-decays[column] * (double)i / (double)n);
}

/* Stretches that count, and room for the longest and the columns. */
typedef struct evidence {
  const lab_stretch *rest;
  int n;
  double *room;
  size_t longest;
} evidence;

/* One row more of a triangle R of least squares, the last column of which is the right-hand side, by Givens rotations.
 * Returns: what the rows before do not predict of the right-hand side, over its deviation (Brown, Durbin and Evans
 * 1975, J. Roy. Stat. Soc. B 37:149) */
static double add_row(double R[COLUMNS][COLUMNS + 1], double row[COLUMNS + 1])
{
  int k, l;
  for (k = 0; k < COLUMNS; k++) {
    const double r = sqrt(R[k][k] * R[k][k] + row[k] * row[k]);
    const double cosine = r > 0 ? R[k][k] / r : 1, sine = r > 0 ? row[k] / r : 0;
    for (l = k; l <= COLUMNS; l++) {
      const double above = R[k][l];
      R[k][l] = cosine * above + sine * row[l];
      row[l] = cosine * row[l] - sine * above;
    }
  }
  return row[COLUMNS];
}

/* A stretch without the columns, whitened; the first values tell the columns and are gaps.
 * Out:  y  as many values as the stretch has
 *       logs  of the variances of innovations, and of what the columns take
 * Returns: values that are no gaps */
static double innovations(const evidence *e, const lab_stretch *rest, const lab_colour *c, double *y, double *logs)
{
  double R[COLUMNS][COLUMNS + 1] = {{0}}, row[COLUMNS + 1];
  size_t i, n = 0;
  int k;
  for (i = 0; i < rest->n; i++)
    y[i] = isnan(rest->value[i]) ? 0 : rest->value[i];
  for (k = 0; k < COLUMNS; k++) {
    double *column = e->room + (size_t)k * e->longest;
    for (i = 0; i < rest->n; i++)
      column[i] = y[i] == 0 ? 0 : column_at(k, i, rest->n);
    lab_colour_whiten(c, column, rest->n);
  }
  *logs = lab_colour_whiten(c, y, rest->n);
  for (i = 0; i < rest->n; i++) {
    if (y[i] == 0)
      continue;
    for (k = 0; k < COLUMNS; k++)
      row[k] = e->room[(size_t)k * e->longest + i];
    row[COLUMNS] = y[i];
    y[i] = add_row(R, row);
    if (n++ < COLUMNS)
      y[i] = 0;
  }
  for (k = 0; k < COLUMNS && n > COLUMNS; k++)
    *logs += 2 * log(fabs(R[k][k]));
  return (double)n - COLUMNS;
}

/* Twice the logarithm of the likelihood, negative, at the best scale.  Out: scale */
static double unlikely(const evidence *e, const lab_colour *c, double *scale)
{
  double square = 0, all_logs = 0, n = 0, *y = e->room + COLUMNS * e->longest;
  int k;
  for (k = 0; k < e->n; k++) {
    double logs;
    n += innovations(e, &e->rest[k], c, y, &logs);
    square += lab_dot(y, y, e->rest[k].n);
    all_logs += logs;
  }
  *scale = sqrt(square / n);
  return n * log(square / n) + all_logs;
}

/* The same of one stretch, at a given scale. */
static double unlikely_there(const evidence *e, int k, const lab_colour *c, double scale)
{
  double logs, *y = e->room + COLUMNS * e->longest;
  const double n = innovations(e, &e->rest[k], c, y, &logs);
  return 2 * n * log(scale) + lab_dot(y, y, e->rest[k].n) / (scale * scale) + logs;
}

/* Whether the stretches that speak for a colour have more than half of the rows: where something moves in a few, these
 * alone do. */
static int is_common(const evidence *e, const lab_colour *c, double scale, double as_white)
{
  double rows_for = 0;
  int k;
  for (k = 0; k < e->n; k++) {
    const double rows = (double)e->rest[k].n;
    rows_for += unlikely_there(e, k, c, scale) < unlikely_there(e, k, &white, as_white) ? rows : -rows;
  }
  return rows_for > 0;
}

/* Whether the second halves of the stretches, whatever their size, speak for a colour: what arrives late moves in the
 * first ones.  In: half  room for all */
static int lasts(const evidence *e, const lab_colour *c, lab_stretch *half)
{
  evidence late = *e;
  double size;
  int k;
  for (k = 0; k < e->n; k++)
    half[k] = (lab_stretch){e->rest[k].value + e->rest[k].n / 2, e->rest[k].n - e->rest[k].n / 2};
  late.rest = half;
  return unlikely(&late, c, &size) < unlikely(&late, &white, &size);
}

/* What is looked for: memory where it is negative, else the root of its time constant in rows. */
static lab_colour colour_at(const double *at)
{
  const lab_colour c = {at[0] < 0 ? at[0] : exp(-1 / fmax(at[0] * at[0], 1e-3)), at[1]};
  return c;
}

static double unlikely_at(unsigned n, const double *at, double *slope, void *context)
{
  const lab_colour c = colour_at(at);
  double scale;
  (void)n;
  (void)slope;
  return unlikely(context, &c, &scale);
}

/* The root of the longest time constant, in rows. */
static double longest_root(const evidence *e)
{
  size_t rows = 0;
  int k;
  for (k = 0; k < e->n; k++)
    rows = e->rest[k].n > rows ? e->rest[k].n : rows;
  return sqrt((double)rows / times);
}

/* Best of a coarse grid, then downhill.  Out: at  Returns: twice the logarithm of the likelihood, negative */
static double search(evidence *e, double at[2])
{
  static const double lower[2] = {-0.95, 0.02}, step[2] = {0.3, 0.1};
  const double upper[2] = {longest_root(e), 1};
  static const double memory[] = {-0.5, 0.7, 1, 1.4, 2, 2.8, 4, 5.6, 8}, share[] = {0.1, 0.3, 0.6, 0.95};
  nlopt_opt opt = nlopt_create(NLOPT_LN_NELDERMEAD, 2);
  double best = HUGE_VAL;
  size_t i, k;
  if (!opt)
    return best;
  for (i = 0; i < sizeof memory / sizeof *memory; i++)
    for (k = 0; k < sizeof share / sizeof *share; k++) {
      const double try[2] = {memory[i], share[k]}, value = unlikely_at(2, try, NULL, e);
      if (memory[i] < upper[0] && value < best) {
        best = value;
        memcpy(at, try, sizeof try);
      }
    }
  nlopt_set_min_objective(opt, unlikely_at, e);
  nlopt_set_lower_bounds(opt, lower);
  nlopt_set_upper_bounds(opt, upper);
  nlopt_set_initial_step(opt, step);
  nlopt_set_ftol_abs(opt, 0.01);
  nlopt_set_maxeval(opt, TRIALS);
  if (isfinite(best))
    nlopt_optimize(opt, at, &best);
  nlopt_destroy(opt);
  return best;
}

/* Whether stretches that are long enough for it do not tell how long the memory is: a stem that moves has no end. */
static int has_no_end(const evidence *e, double root)
{
  return e->longest >= LONG && root > within * longest_root(e);
}

/* Whether the innovations are white.  In: y  room for all values */
static int explains(const evidence *e, const lab_colour *c, double *y, lab_stretch *stretch)
{
  lab_whiteness w;
  double logs;
  size_t i;
  int k;
  for (k = 0; k < e->n; k++) {
    innovations(e, &e->rest[k], c, y, &logs);
    for (i = 0; i < e->rest[k].n; i++)
      y[i] = y[i] == 0 ? (double)NAN : y[i];
    stretch[k] = (lab_stretch){y, e->rest[k].n};
    y += e->rest[k].n;
  }
  lab_whiteness_test(stretch, e->n, &w);
  return lab_is_white(&w);
}

/* Mean squares of the innovations of each stretch.  Out: square  Returns: the least */
static double sizes(const evidence *e, const lab_colour *c, double *square)
{
  double logs, least = HUGE_VAL, *y = e->room + COLUMNS * e->longest;
  int k;
  for (k = 0; k < e->n; k++) {
    const double values = innovations(e, &e->rest[k], c, y, &logs);
    square[k] = values > 0 ? lab_dot(y, y, e->rest[k].n) / values : HUGE_VAL;
    least = fmin(least, square[k]);
  }
  return least;
}

/* Leave out the stretches that scatter more than `most` times the median of all.  In: square  room for as many again */
static void leave_out_rough(lab_stretch *rest, evidence *e, double most, double *square)
{
  double *sorted = square + e->n, limit;
  int k, n = 0;
  memcpy(sorted, square, (size_t)e->n * sizeof *sorted);
  limit = e->n > 0 ? most * lab_median(sorted, (size_t)e->n) : 0;
  for (k = 0; k < e->n; k++)
    if (square[k] <= limit)
      rest[n++] = rest[k];
  e->n = n;
}

static size_t rows_in(const evidence *e)
{
  size_t rows = 0;
  int k;
  for (k = 0; k < e->n; k++)
    rows += e->rest[k].n;
  return rows;
}

/* Noise is alike everywhere. As long as some stretch has much less of it, something moves in the others. */
static int estimate(lab_stretch *rest, evidence *e, lab_stretch *stretch, double *square, lab_colour *c, double *scale)
{
  double at[2] = {0, 0}, most = rougher, as_white, coloured, own;
  *c = white;
  *scale = 1;
  do {
    const int before = e->n;
    sizes(e, c, square);
    leave_out_rough(rest, e, most, square);
    if (rows_in(e) < FEWEST || (most == 1 && e->n == before))
      return 0;
    as_white = unlikely(e, &white, &own);
    coloured = search(e, at);
    *c = colour_at(at);
    unlikely(e, c, scale);
    most = 1;
  } while (sizes(e, c, square) < quiet * *scale * *scale);
  return coloured < as_white - told && is_common(e, c, *scale, own) && lasts(e, c, stretch) && !has_no_end(e, at[0]) &&
         explains(e, c, e->room + COLUMNS * e->longest, stretch);
}

int lab_colour_estimate(lab_stretch *rest, int n, lab_colour *c, double *scale, lab_error *error)
{
  evidence e = {rest, n, NULL, 0};
  lab_stretch *stretch = malloc((size_t)(n + 1) * sizeof *stretch);
  double level;
  size_t all = 0;
  int k, known = 0;
  for (k = 0; k < n; k++) {
    all += rest[k].n;
    e.longest = rest[k].n > e.longest ? rest[k].n : e.longest;
  }
  e.room = malloc((COLUMNS * e.longest + all + 2 * (size_t)n + 1) * sizeof *e.room);
  error->status = LAB_OK;
  if (e.room && stretch)
    known = estimate(rest, &e, stretch, e.room + COLUMNS * e.longest + all, c, &level);
  else
    lab_fail_memory(error, "the noise");
  if (known)
    *scale = level;
  else
    *c = white;
  free(e.room);
  free(stretch);
  return error->status;
}

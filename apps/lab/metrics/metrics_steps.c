/* Responses to steps: dead time, T63, T86, settling, overshoot. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "metrics_private.h"
#include "../base/array.h"
#include "../base/text.h"

static const double share_63 = 0.632, share_86 = 0.865; /* ISA-75.25.01 */
static const double share_stroke = 0.99;                /* of the change: the end of a stroke */
static const double settled_share = 0.02;               /* of the change */
static const double rest_share = 0.01;                  /* of the change: what is still moving moves more */
static const double size_noise = 25;                    /* a change is measurable from so many standard deviations on */
static const double size_share = 0.002;                 /* and this share of the stroke */
static const double start_noise = 5;                    /* the start is seen at so many */
static const double start_share = 0.005;                /* and at this share of the change */
static const double level_noise = 3;                    /* a level is passed for good from so many on */
static const double band_noise = 8;    /* the band of settling has at least so many, of means of rows */
static const double alike = 0.8;       /* steps of this share of the largest count as large */
static const double rise_share = 0.05; /* of the hold that a signal may take to step */

/* A step being measured: rows from the last one before it, and the change as a positive number. */
typedef struct stepping {
  const lab_record *r;
  const lab_hold *hold;
  size_t begin, end;
  double sign, change, from, noise;
  double least; /* movement that can be seen */
  double doubt; /* of the change: noise, and twice what crept still, as a lag does */
} stepping;

/* A time and how well it is known. */
typedef struct instant {
  double t, error;
} instant;

static double height(const stepping *s, size_t i)
{
  return s->sign * (s->r->x[i] - s->from);
}

/* Straight line through rows lo..hi solved for `level`; the start of the step stands in for a row before all others.
 * In:      lo  may be s->begin - 1, for that */
static instant solve(const stepping *s, size_t lo, size_t hi, double level)
{
  double n = 0, st = 0, sy = 0, stt = 0, sty = 0, last = (double)NAN, widest = 0, slope;
  const double origin = s->r->t[hi];
  instant at;
  size_t i;
  for (i = lo; i <= hi; i++) {
    const int start = i + 1 == s->begin;
    const double y = start ? 0 : height(s, i), t = (start ? s->hold->t : s->r->t[i]) - origin;
    if (isnan(y))
      continue;
    if (!isnan(last))
      widest = fmax(widest, t - last);
    last = t;
    n++, st += t, sy += y, stt += t * t, sty += t * y;
  }
  slope = (n * sty - st * sy) / (n * stt - st * st);
  if (n < 2 || !(slope > 0)) {
    at.t = origin - widest / 2;
    at.error = widest / 2;
    return at;
  }
  at.t = origin + (st + (n * level - sy) / slope) / n;
  at.error = widest / 2 + (2 * s->noise / sqrt(n) + level / s->change * s->doubt) / slope;
  return at;
}

/* When the response first passes a level for good: beyond it by more than noise, from below it by as much. A level
 * that is four standard deviations below the final position is passed. */
static instant pass(const stepping *s, double level)
{
  const double margin = fmin(level_noise * s->noise, level);
  instant never = {(double)NAN, (double)NAN};
  size_t i, lo = s->begin - 1;
  for (i = s->begin; i < s->end; i++) {
    const double y = height(s, i);
    if (y <= level - margin)
      lo = i;
    if (y >= level + margin)
      return solve(s, lo, i, level);
  }
  return never;
}

static void measure_dead_time(const stepping *s, lab_step_response *step)
{
  const double level = fmax(start_noise * s->noise, start_share * s->change);
  const instant start = pass(s, level), later = pass(s, share_63 * s->change);
  const double slope = (share_63 * s->change - level) / (later.t - start.t);
  step->dead_time = fmax(start.t - s->hold->t, 0);
  step->dead_time_error = start.error + s->hold->bracket + (slope > 0 ? level / slope : 0);
}

static void measure_level(const stepping *s, double share, double *time, double *error)
{
  const double below = s->change - (level_noise + 1) * s->noise; /* so that noise lets it be passed */
  const instant at = pass(s, fmin(share * s->change, below));
  *time = at.t - s->hold->t;
  *error = at.error + s->hold->bracket;
}

/* Rows to average so that noise alone does not leave the band; 0 where the hold has not ten times as many. */
static size_t rows_to_average(const stepping *s, double band)
{
  const double needed = fmax(ceil(pow(band_noise * s->noise / band, 2)), 1);
  return 10 * needed <= (double)(s->end - s->begin) ? (size_t)needed : 0;
}

/* Between the last mean of some rows that is outside for certain and the first from which on all may be inside. */
static void measure_settling(const stepping *s, lab_step_response *step)
{
  const double band = settled_share * s->change;
  const size_t each = rows_to_average(s, band);
  const double margin = level_noise * s->noise / sqrt((double)each);
  double sure = s->r->t[s->begin], inside = sure, t = 0, y = 0;
  size_t i, n = 0;
  int out = 1; /* the last mean may have been outside */
  for (i = s->begin; i < s->end && each > 0; i++) {
    if (isnan(height(s, i)))
      continue;
    t += s->r->t[i] / (double)each;
    y += height(s, i) / (double)each;
    if (++n < each)
      continue;
    if (fabs(y - s->change) > band + margin)
      sure = t;
    if (out)
      inside = t;
    out = fabs(y - s->change) > band - margin;
    t = y = 0;
    n = 0;
  }
  step->settling_time = each > 0 ? (sure + inside) / 2 - s->hold->t : (double)NAN;
  step->settling_error = (inside - sure) / 2 + s->hold->bracket;
}

static void measure_overshoot(const stepping *s, lab_step_response *step)
{
  double peak = 0, n = 1, chance;
  size_t i;
  for (i = s->begin; i < s->end; i++)
    if (height(s, i) > s->change) {
      peak = fmax(peak, height(s, i) - s->change);
      n++;
    }
  chance = fmax(s->noise * (1 + sqrt(2 * log(2 * n))), s->least);
  step->overshoot = peak > chance ? 100 * peak / s->change : 0;
  step->overshoot_error = 100 * chance / s->change;
}

static void measure_times(const stepping *s, lab_step_response *step)
{
  measure_dead_time(s, step);
  measure_level(s, share_63, &step->t63, &step->t63_error);
  measure_level(s, share_86, &step->t86, &step->t86_error);
  measure_level(s, share_stroke, &step->stroke_time, &step->stroke_error);
  measure_settling(s, step);
  measure_overshoot(s, step);
}

/* Whether a step can be measured. */
static int judge(const lab_metrics_work *m, const lab_hold *hold, const lab_rest *before, const lab_rest *after)
{
  const double *t = m->record->t, change = fabs(after->level - before->level);
  const double least = size_share * m->record->stroke, allowed = fmax(least / 4, rest_share * change);
  if (isnan(change))
    return LAB_STEP_GAP;
  if (hold->rise > rise_share * (t[hold->end - 1] - hold->t))
    return LAB_STEP_NO_SIGNAL;
  if (before->drift > allowed)
    return LAB_STEP_NOT_AT_REST;
  if (after->drift > allowed)
    return LAB_STEP_NOT_SETTLED;
  return change < fmax(size_noise * m->noise_x, least) ? LAB_STEP_TOO_SMALL : LAB_STEP_GOOD;
}

static void measure_step(const lab_metrics_work *m, const lab_hold *from, const lab_hold *hold, lab_step_response *step)
{
  const lab_record *r = m->record;
  const lab_rest before = lab_rest_of(r, r->x, from->begin, from->end, m->noise_x);
  const lab_rest after = lab_rest_of(r, r->x, hold->begin, hold->end, m->noise_x);
  stepping s = {r, hold, from->end, hold->end, 0, 0, 0, m->noise_x, m->least, 0};
  step->t = hold->t;
  step->from = from->level;
  step->to = hold->level;
  step->x_from = before.level;
  step->x_to = after.level;
  step->dead_time = step->t63 = step->t86 = step->settling_time = step->overshoot = step->stroke_time = (double)NAN;
  step->fate = judge(m, hold, &before, &after);
  if (step->fate != LAB_STEP_GOOD)
    return;
  s.doubt = before.error + after.error + 2 * (before.drift + after.drift);
  s.sign = step->x_to > step->x_from ? 1 : -1;
  s.change = fabs(step->x_to - step->x_from);
  s.from = step->x_from;
  measure_times(&s, step);
}

int lab_steps_measure(lab_metrics_work *m, lab_error *error)
{
  size_t k;
  m->step = calloc(m->n_holds + 1, sizeof *m->step);
  if (!m->step)
    return lab_fail_memory(error, "figures of merit");
  for (k = 1; k < m->n_holds; k++)
    if (m->hold[k].run == m->hold[k - 1].run)
      measure_step(m, &m->hold[k - 1], &m->hold[k], &m->step[m->n_steps++]);
  m->metrics->n_steps = (int)m->n_steps;
  memcpy(m->metrics->step, m->step, (m->n_steps < LAB_METRIC_STEPS ? m->n_steps : LAB_METRIC_STEPS) * sizeof *m->step);
  return LAB_OK;
}

/* ---- Figures of a direction ---- */

static int goes_up(const lab_step_response *step)
{
  return step->to > step->from;
}

void lab_steps_deny(lab_metrics_work *m, int metric, int up)
{
  static const char *const fate[] = {NULL,
                                     "with a signal that takes its time",
                                     "in a gap of the record",
                                     "before the stem was at rest",
                                     "not settled before the next step or the end",
                                     "too small a movement"};
  int count[sizeof fate / sizeof *fate] = {0}, all = 0;
  char words[LAB_METRIC_TEXT] = "";
  size_t i;
  for (i = 0; i < m->n_steps; i++)
    if (goes_up(&m->step[i]) == up) {
      count[m->step[i].fate]++;
      all++;
    }
  for (i = 1; i < sizeof fate / sizeof *fate; i++) {
    if (count[i])
      lab_append(words, sizeof words, "%s%d %s", *words ? ", " : "", count[i], fate[i]);
  }
  if (all)
    lab_metric_absent(m, metric, "no step %s of the %s can be used: %.120s", up ? "up" : "down",
                      lab_metrics_step_signal(m->record->command), words);
  else
    lab_metric_absent(m, metric, "the record has no step %s of the %s", up ? "up" : "down",
                      lab_metrics_step_signal(m->record->command));
}

static double change_of(const lab_step_response *step)
{
  return fabs(step->x_to - step->x_from);
}

/* A figure of a step, and the two metrics that it makes. */
typedef struct figure {
  int up, down;
  size_t value, error;
} figure;

#define FIGURE(NAME, value, error)                                                                                     \
  {                                                                                                                    \
    LAB_METRIC_##NAME##_UP, LAB_METRIC_##NAME##_DOWN, offsetof(lab_step_response, value),                              \
        offsetof(lab_step_response, error)                                                                             \
  }
static const figure figures[] = {FIGURE(DEAD_TIME, dead_time, dead_time_error), FIGURE(T63, t63, t63_error),
                                 FIGURE(T86, t86, t86_error), FIGURE(SETTLING_TIME, settling_time, settling_error),
                                 FIGURE(OVERSHOOT, overshoot, overshoot_error)};
#undef FIGURE

static double field(const lab_step_response *step, size_t offset)
{
  return *(const double *)(const void *)((const char *)step + offset);
}

/* The large steps of a direction: the largest change, and how many come near it.
 * Out:     least, largest  [m] */
static int large_steps(const lab_metrics_work *m, int up, double *least, double *largest)
{
  int n = 0;
  size_t i;
  *largest = 0;
  for (i = 0; i < m->n_steps; i++)
    if (m->step[i].fate == LAB_STEP_GOOD && goes_up(&m->step[i]) == up)
      *largest = fmax(*largest, change_of(&m->step[i]));
  *least = *largest;
  for (i = 0; i < m->n_steps; i++)
    if (m->step[i].fate == LAB_STEP_GOOD && goes_up(&m->step[i]) == up && change_of(&m->step[i]) >= alike * *largest) {
      *least = fmin(*least, change_of(&m->step[i]));
      n++;
    }
  return n;
}

static void report_figure(lab_metrics_work *m, const figure *f, int up, double *value)
{
  const int metric = up ? f->up : f->down;
  const double stroke = m->record->stroke;
  double least, largest, error = 0;
  int n = 0;
  size_t i;
  if (large_steps(m, up, &least, &largest) == 0) {
    lab_steps_deny(m, metric, up);
    return;
  }
  for (i = 0; i < m->n_steps; i++)
    if (m->step[i].fate == LAB_STEP_GOOD && goes_up(&m->step[i]) == up && change_of(&m->step[i]) >= least &&
        !isnan(field(&m->step[i], f->value))) {
      value[n++] = field(&m->step[i], f->value);
      error = fmax(error, field(&m->step[i], f->error));
    }
  if (n == 0) {
    lab_metric_absent(m, metric, "noise hides when the stem comes to stay within 2 %% of the change");
    return;
  }
  lab_sort(value, (size_t)n);
  if (n > 1)
    lab_metric_set(m, metric, value[n / 2], fmax(error, (value[n - 1] - value[0]) / 2),
                   "median of %d steps %s of %.3g to %.3g %% of travel", n, up ? "up" : "down", 100 * least / stroke,
                   100 * largest / stroke);
  else
    lab_metric_set(m, metric, value[0], error, "one step %s of %.3g %% of travel", up ? "up" : "down",
                   100 * largest / stroke);
}

int lab_steps_report(lab_metrics_work *m, lab_error *error)
{
  double *value = malloc((m->n_steps + 1) * sizeof *value);
  size_t i;
  if (!value)
    return lab_fail_memory(error, "figures of merit");
  for (i = 0; i < sizeof figures / sizeof *figures; i++) {
    report_figure(m, &figures[i], 1, value);
    report_figure(m, &figures[i], 0, value);
  }
  free(value);
  return LAB_OK;
}

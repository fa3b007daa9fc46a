/* Responses to steps, from one level of the command to the next: dead time, T63, T86, settling, overshoot; and full
 * strokes: how long each way, and how differently. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "../base/text.h"
#include "asymmetry.h"
#include "metrics_private.h"

enum { FLAT = 5, PARTS = 8 };           /* rows that a level of a measured pressure has at least; parts of a hold */
static const double left_noise = 6;     /* a measured pressure has left its level beyond so many standard deviations */
static const double left_share = 0.002; /* and this share of its span */
static const double drift = 0.25;       /* share of the step by which a level may drift */
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

/* ---- Parts of a hold ---- */

typedef struct portion {
  size_t n;
  double mean;
} portion;

/* Mean of the finite values over the k-th of the parts of equal time of rows begin..end. */
static portion mean_of_part(const lab_record *r, const double *value, size_t begin, size_t end, int k)
{
  const double from = r->t[begin], whole = r->t[end - 1] - from;
  portion part = {0, 0};
  size_t i;
  for (i = begin; i < end; i++) {
    const double share = whole > 0 ? (r->t[i] - from) / whole : 1;
    if (isnan(value[i]) || (int)fmin(PARTS * share, PARTS - 1) != k)
      continue;
    part.mean += value[i];
    part.n++;
  }
  part.mean = part.n ? part.mean / (double)part.n : (double)NAN;
  return part;
}

/* ---- Levels of the command ---- */

/* A command is constant from row to row. */
static void commands_of_run(lab_metrics_work *m, int run)
{
  const lab_record *r = m->record;
  const size_t first = r->first[run], end = r->first[run + 1];
  size_t i = first;
  while (i < end) {
    lab_hold *hold = &m->hold[m->n_holds++];
    *hold = (lab_hold){run, i, i + 1, r->u[i], r->t[i], 0, 0, 0};
    if (r->bracketed && i > first)
      hold->bracket = r->t[i] - r->t[i - 1];
    while (hold->end < end && r->u[hold->end] == r->u[i])
      hold->end++;
    i = hold->end;
  }
}

/* Mean of the next few rows; NaN unless they agree. */
static double flat_level(const double *p, size_t i, size_t end, double band)
{
  double sum = 0;
  size_t j;
  if (end - i < FLAT)
    return (double)NAN;
  for (j = i; j < i + FLAT; j++)
    sum += p[j];
  for (j = i; j < i + FLAT; j++)
    if (!(fabs(p[j] - sum / FLAT) <= band))
      return (double)NAN;
  return sum / FLAT;
}

static void pressures_of_run(lab_metrics_work *m, int run)
{
  const lab_record *r = m->record;
  const double band = fmax(left_noise * m->noise_p, left_share * lab_span(r));
  const size_t first = r->first[run], end = r->first[run + 1];
  size_t i = first, left = first; /* the last row on the level before */
  while (i < end) {
    const double level = flat_level(r->p, i, end, band);
    lab_hold *hold;
    if (isnan(level)) {
      i++;
      continue;
    }
    hold = &m->hold[m->n_holds++];
    *hold = (lab_hold){run, i, i, level, r->t[left], 0, r->t[i] - r->t[left], 0};
    while (i < end && !(fabs(r->p[i] - level) > band))
      i++;
    hold->end = i;
    left = i - 1;
  }
}

/* Whether a level drifts by a good part of its step from or to a neighbour, as pieces of a ramp do. */
static int drifts(const lab_metrics_work *m, size_t k)
{
  const lab_hold *hold = &m->hold[k], *other = k > 0 ? hold - 1 : hold + 1;
  const portion first = mean_of_part(m->record, m->record->p, hold->begin, hold->end, 0);
  const portion last = mean_of_part(m->record, m->record->p, hold->begin, hold->end, PARTS - 1);
  return m->n_holds > 1 && fabs(last.mean - first.mean) > drift * fabs(hold->level - other->level);
}

/* Drop the pieces of ramps; what is left of the signal takes as long as they did. */
static void drop_ramps(lab_metrics_work *m)
{
  const double *t = m->record->t;
  size_t k, n = 0;
  for (k = 0; k < m->n_holds; k++)
    m->hold[k].dropped = drifts(m, k);
  for (k = 0; k < m->n_holds; k++) {
    lab_hold *hold = &m->hold[n];
    if (m->hold[k].dropped)
      continue;
    *hold = m->hold[k];
    if (n > 0 && hold->run == hold[-1].run) {
      hold->t = t[hold[-1].end - 1];
      hold->rise = t[hold->begin] - hold->t;
    }
    n++;
  }
  m->n_holds = n;
}

int lab_holds_find(lab_metrics_work *m, lab_error *error)
{
  const lab_record *r = m->record;
  const double *signal = r->command == LAB_COMMAND_PRESSURE ? r->p : r->u;
  int run;
  m->hold = calloc(r->n, sizeof *m->hold);
  if (!m->hold)
    return lab_fail_memory(error, "figures of merit");
  for (run = 0; run < r->n_runs && signal; run++)
    (r->command == LAB_COMMAND_PRESSURE ? pressures_of_run : commands_of_run)(m, run);
  if (r->command == LAB_COMMAND_PRESSURE)
    drop_ramps(m);
  return LAB_OK;
}

/* ---- Rest ---- */

lab_rest lab_rest_of(const lab_record *r, const double *value, size_t begin, size_t end, double noise)
{
  const portion before = mean_of_part(r, value, begin, end, PARTS - 2);
  const portion last = mean_of_part(r, value, begin, end, PARTS - 1);
  lab_rest rest = {(double)NAN, (double)NAN, (double)NAN};
  if (last.n == 0 || before.n == 0)
    return rest;
  rest.level = last.mean;
  rest.error = 2 * noise / sqrt((double)last.n);
  noise *= LAB_SEEN * sqrt(1 / (double)before.n + 1 / (double)last.n);
  rest.drift = fmax(fabs(last.mean - before.mean) - noise, 0);
  return rest;
}

/* ---- Steps ---- */

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
  if (n < 2 || !(slope > 0))
    return (instant){origin - widest / 2, widest / 2};
  return (instant){origin + (st + (n * level - sy) / slope) / n,
                   widest / 2 + (2 * s->noise / sqrt(n) + level / s->change * s->doubt) / slope};
}

/* When the response first passes a level for good: beyond it by more than noise, from below it by as much. A level
 * that is four standard deviations below the final position is passed. */
static instant pass(const stepping *s, double level)
{
  const double margin = fmin(level_noise * s->noise, level);
  size_t i, lo = s->begin - 1;
  for (i = s->begin; i < s->end; i++) {
    const double y = height(s, i);
    if (y <= level - margin)
      lo = i;
    if (y >= level + margin)
      return solve(s, lo, i, level);
  }
  return (instant){(double)NAN, (double)NAN};
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

/* Between the last mean of some rows that is outside for certain and the first from which on all may be inside. */
static void measure_settling(const stepping *s, lab_step_response *step)
{
  const double band = settled_share * s->change;
  const double needed = fmax(ceil(pow(band_noise * s->noise / band, 2)), 1); /* rows, so that noise does not leave it */
  const size_t each = 10 * needed <= (double)(s->end - s->begin) ? (size_t)needed : 0;
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
  measure_dead_time(&s, step);
  measure_level(&s, share_63, &step->t63, &step->t63_error);
  measure_level(&s, share_86, &step->t86, &step->t86_error);
  measure_level(&s, share_stroke, &step->stroke_time, &step->stroke_error);
  measure_settling(&s, step);
  measure_overshoot(&s, step);
}

static int measure_steps(lab_metrics_work *m, lab_error *error)
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

static double change_of(const lab_step_response *step)
{
  return fabs(step->x_to - step->x_from);
}

static int goes_up(const lab_step_response *step)
{
  return step->to > step->from;
}

/* Whether a step goes that way, can be measured and is no smaller than that [m]. */
static int counts(const lab_step_response *step, int up, double least)
{
  return step->fate == LAB_STEP_GOOD && goes_up(step) == up && change_of(step) >= least;
}

static void deny_steps(lab_metrics_work *m, int metric, int up)
{
  static const char *const fate[] = {NULL,
                                     "with a signal that takes its time",
                                     "in a gap of the record",
                                     "before the stem was at rest",
                                     "not settled before the next step or the end (hold longer)",
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

/* The largest change in a direction [m]; 0: no step that way can be measured. */
static double largest_step(const lab_metrics_work *m, int up)
{
  double largest = 0;
  size_t i;
  for (i = 0; i < m->n_steps; i++)
    if (counts(&m->step[i], up, largest))
      largest = change_of(&m->step[i]);
  return largest;
}

/* The median of the steps that come near the largest one.  In: value  room for all steps */
static void report_figure(lab_metrics_work *m, const figure *f, int up, double *value)
{
  const int metric = up ? f->up : f->down;
  const double stroke = m->record->stroke;
  const double largest = largest_step(m, up);
  double least = largest, error = 0;
  int n = 0;
  size_t i;
  if (largest == 0) {
    deny_steps(m, metric, up);
    return;
  }
  for (i = 0; i < m->n_steps; i++) {
    const lab_step_response *step = &m->step[i];
    if (!counts(step, up, alike * largest))
      continue;
    least = fmin(least, change_of(step));
    if (isnan(field(step, f->value)))
      continue;
    value[n++] = field(step, f->value);
    error = fmax(error, field(step, f->error));
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

static int report_steps(lab_metrics_work *m, lab_error *error)
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

/* ---- Full strokes ---- */

/* The first full stroke up or down, NULL where there is none; with the largest change of any step that way. */
static const lab_step_response *full_stroke(const lab_metrics_work *m, int up, double *largest)
{
  const lab_step_response *found = NULL;
  size_t i;
  *largest = 0;
  for (i = 0; i < m->n_steps; i++) {
    const lab_step_response *step = &m->step[i];
    const double change = up ? step->x_to - step->x_from : step->x_from - step->x_to;
    if (step->fate != LAB_STEP_GOOD)
      continue;
    *largest = fmax(*largest, change);
    if (!found && change >= LAB_FULL_STROKE * m->record->stroke)
      found = step;
  }
  return found;
}

static const lab_hold *hold_of(const lab_metrics_work *m, const lab_step_response *step)
{
  size_t k;
  for (k = 0; k + 1 < m->n_holds && m->hold[k].t < step->t; k++)
    ;
  return &m->hold[k];
}

static void deny(lab_metrics_work *m, int metric, int up, double largest)
{
  if (largest > 0)
    lab_metric_absent(m, metric, "no full stroke %s: the largest step covers %.3g %% of the travel", up ? "up" : "down",
                      100 * largest / m->record->stroke);
  else
    deny_steps(m, metric, up);
}

static void report_time(lab_metrics_work *m, int metric, int up, const lab_step_response *step, double largest)
{
  if (!step)
    deny(m, metric, up, largest);
  else
    lab_metric_set(m, metric, step->stroke_time, step->stroke_error, "full stroke %s at t = %.6g s, to %g %% of it",
                   up ? "up" : "down", step->t, 100 * share_stroke);
}

/* The samples of a stroke, its rest before and after as one sample each.
 * Out:     t, x  room for the rows of the hold and two more
 * Returns: how many */
static size_t samples(const lab_record *r, const lab_step_response *step, const lab_hold *hold, double *t, double *x)
{
  size_t i, n = 0;
  t[n] = step->t;
  x[n++] = step->x_from;
  for (i = hold->begin; i < hold->end; i++)
    if (!isnan(r->x[i]) && r->t[i] > t[n - 1]) {
      t[n] = r->t[i];
      x[n++] = r->x[i];
    }
  x[n - 1] = step->x_to;
  return n;
}

static int report_shape(lab_metrics_work *m, const lab_edge *up, const lab_edge *down, const lab_step_response *rise,
                        lab_error *error)
{
  const double noise = m->noise_x / fabs(rise->x_to - rise->x_from);
  lab_asymmetry a;
  double spacing;
  if (lab_asymmetry_measure(up, down, &a, error))
    return error->status;
  spacing = (up->t[up->n - 1] - up->t[0]) / (double)(up->n - 1);
  lab_metric_set(m, LAB_METRIC_DURATION_RATIO, a.duration_ratio,
                 a.duration_ratio * (spacing / a.rise_time + spacing / a.fall_time + 4 * noise),
                 "rise %.4g s, fall %.4g s from 5 %% to 95 %% of travel", a.rise_time, a.fall_time);
  /* |noise| of the difference of two curves: sqrt(2) sqrt(2/pi) */
  lab_metric_set(m, LAB_METRIC_ASYMMETRY, a.asymmetry,
                 1.13 * noise / 0.9 + spacing / a.rise_time + spacing / a.fall_time,
                 "first full stroke up and first full stroke down");
  return LAB_OK;
}

static int compare(lab_metrics_work *m, const lab_step_response *rise, const lab_step_response *fall, lab_error *error)
{
  const lab_hold *up = hold_of(m, rise), *down = hold_of(m, fall);
  const size_t n_up = up->end - up->begin + 2, n_down = down->end - down->begin + 2;
  double *memory = malloc(2 * (n_up + n_down) * sizeof *memory);
  lab_edge rising, falling;
  int status;
  if (!memory)
    return lab_fail_memory(error, "figures of merit");
  rising = (lab_edge){samples(m->record, rise, up, memory, memory + n_up), memory, memory + n_up};
  falling = (lab_edge){samples(m->record, fall, down, memory + 2 * n_up, memory + 2 * n_up + n_down), memory + 2 * n_up,
                       memory + 2 * n_up + n_down};
  status = report_shape(m, &rising, &falling, rise, error);
  free(memory);
  return status;
}

static int report_strokes(lab_metrics_work *m, lab_error *error)
{
  double most_up, most_down;
  const lab_step_response *rise = full_stroke(m, 1, &most_up), *fall = full_stroke(m, 0, &most_down);
  report_time(m, LAB_METRIC_STROKE_TIME_UP, 1, rise, most_up);
  report_time(m, LAB_METRIC_STROKE_TIME_DOWN, 0, fall, most_down);
  if (rise && fall)
    return compare(m, rise, fall, error);
  deny(m, LAB_METRIC_DURATION_RATIO, !rise, rise ? most_down : most_up);
  deny(m, LAB_METRIC_ASYMMETRY, !rise, rise ? most_down : most_up);
  return LAB_OK;
}

int lab_steps_measure(lab_metrics_work *m, lab_error *error)
{
  return measure_steps(m, error) || report_steps(m, error) || report_strokes(m, error) ? error->status : LAB_OK;
}

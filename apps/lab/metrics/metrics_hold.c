/* Levels: of the command, which a step goes from and to, and at which a channel comes to rest. */
#include <math.h>
#include <stdlib.h>

#include "metrics_private.h"

enum { FLAT = 5 };                      /* rows that a level of a measured pressure has at least */
static const double band_noise = 6;     /* a measured pressure has left its level beyond so many standard deviations */
static const double band_share = 0.002; /* and this share of its span */
static const double drift = 0.25;       /* share of the step by which a level may drift */

/* ---- Parts of a hold ---- */

enum { PARTS = 8 };

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
static size_t held_until(const double *u, size_t i, size_t end)
{
  size_t j = i + 1;
  while (j < end && u[j] == u[i])
    j++;
  return j;
}

static void commands_of_run(lab_metrics_work *m, int run)
{
  const lab_record *r = m->record;
  const size_t first = r->first[run], end = r->first[run + 1];
  size_t i, next;
  for (i = first; i < end; i = next) {
    lab_hold *hold = &m->hold[m->n_holds++];
    next = held_until(r->u, i, end);
    *hold = (lab_hold){run, i, next, r->u[i], r->t[i], 0, 0, 0};
    if (r->bracketed && i > first)
      hold->bracket = r->t[i] - r->t[i - 1];
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
  const double band = fmax(band_noise * m->noise_p, band_share * lab_span(r));
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

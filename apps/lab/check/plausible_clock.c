/* Checks of plausible.h on command and measurement: are they from one test, and on one clock? */
#include <math.h>

#include "../base/array.h"
#include "logview.h"

static const double alike = 0.4;         /* correlation of rates, measured and expected, below which they differ */
static const double alike_shifted = 0.8; /* and above which a shift in time is the reason */
static const double obedient = 0.75;     /* share of movement the way of the command, above which all is right */
static const double disobedient = 0.55;  /* and below which it is wrong, however alike */
static const double early_rate = 0.3;    /* of the usual rate with an open orifice */

/* ---- Likeness ---- */

/* Correlation of the rates of the measured channel, `lag` cells later, with the expected ones; each over a few cells,
 * so that a short peak at break-away does not outweigh the strokes. */
static double likeness(const lab_log_view *s, int lag)
{
  const double *m = s->cells[s->main].mean, *e = s->expected_cells.mean;
  const int over = 1 + s->n_cells / 64;
  double mm = 0, ee = 0, me = 0;
  int k;
  for (k = 0; k + over < s->n_cells; k++) {
    const double dm = m[k + over] - m[k], de = e[k + over] - e[k];
    mm += dm * dm;
    ee += de * de;
    if (k + lag >= 0 && k + lag + over < s->n_cells)
      me += de * (m[k + lag + over] - m[k + lag]);
  }
  return mm > 0 && ee > 0 ? me / sqrt(mm * ee) : 0;
}

/* Enough movement, measured and expected, for its rates to be seen above the noise. */
static int rates_are_seen(const lab_log_view *s)
{
  const double *m = s->cells[s->main].mean;
  const double per_cell = fmax((double)s->n / s->n_cells, 1), sigma = s->sigma[s->main];
  double mm = 0;
  int k;
  for (k = 0; k + 1 < s->n_cells; k++)
    mm += (m[k + 1] - m[k]) * (m[k + 1] - m[k]);
  return mm > 4 * 2 * sigma * sigma / per_cell * s->n_cells &&
         s->expected_cells.high - s->expected_cells.low > 10 * sigma;
}

/* The lag at which both are most alike, the shortest one of those within 2 %.  Returns: in cells; 0 if not to be told.
 * Out: best */
static int lag_of(const lab_log_view *s, double *best)
{
  const int most = s->n_cells / 3;
  int lag;
  *best = 1;
  if (!rates_are_seen(s))
    return 0;
  *best = 0;
  for (lag = -most; lag <= most; lag++)
    *best = fmax(*best, likeness(s, lag));
  for (lag = 0; lag < most; lag++) {
    if (likeness(s, lag) >= 0.98 * *best)
      return lag;
    if (likeness(s, -lag) >= 0.98 * *best)
      return -lag;
  }
  return 0;
}

int lab_check_early(const lab_log_view *s, lab_check_result *f)
{
  double best;
  const int lag = lag_of(s, &best);
  if (lag > -4 || best < alike_shifted)
    return 0;
  return lab_check_fail(
      f, LAB_NO_ROW,
      "the command does not match: %s moves %.3g s before u says so; are both from one test, and on one "
      "clock?",
      lab_channels[s->main].key, -lag * s->cell);
}

int lab_check_late(const lab_log_view *s, lab_check_result *f)
{
  double best;
  const int lag = lag_of(s, &best);
  if (lag < 4 || best < alike_shifted || lag * s->cell < LAB_VIEW_DEAD_TIME)
    return 0;
  return lab_check_fail(
      f, LAB_NO_ROW,
      "%s follows u about %.3g s late, longer than a dead time of a transducer or a line: command and "
      "measurement seem to be on different clocks",
      lab_channels[s->main].key, lag * s->cell);
}

/* Share of the movement that goes the way of the command, or may go on without one: falls while it is shut. A poor
 * guess of an area or a volume spoils the likeness, not this. */
static double obedience(const lab_log_view *s)
{
  const double *m = s->cells[s->main].mean, noise = LAB_VIEW_SIGNIFICANT * s->sigma[s->main];
  double good = 0, all = 0;
  lab_stretch stretch = {0, 0, 0, 0};
  int k, last;
  while (lab_log_view_next(s, &stretch)) {
    last = (int)((s->t[stretch.end - 1] - s->t[0]) / s->cell);
    for (k = (int)((s->t[stretch.first] - s->t[0]) / s->cell); k < last && k + 1 < s->n_cells; k++) {
      const double change = m[k + 1] - m[k];
      if (fabs(change) * LAB_VIEW_FEWEST < noise)
        continue;
      all += fabs(change);
      good += (change > 0) == (stretch.sign > 0) ? fabs(change) : 0;
    }
  }
  return all > 0 ? good / all : 1;
}

int lab_check_alike(const lab_log_view *s, lab_check_result *f)
{
  double best, now = -1, obeys;
  int k, lag = lag_of(s, &best);
  if (best >= 1 || (best > alike_shifted && lag != 0))
    return 0;
  for (k = 0; k < s->n_cells / 3 && k * s->cell < LAB_VIEW_DEAD_TIME; k++)
    now = fmax(now, likeness(s, k));
  obeys = obedience(s);
  if (obeys > (now > alike ? disobedient : obedient))
    return 0;
  return lab_check_fail(
      f, LAB_NO_ROW,
      "the command does not match: what %s does is not what the declared model makes of u (correlation of "
      "rates %.2f, %.0f %% of the movement the way of u); is u from another test, or the rig file of another "
      "rig?",
      lab_channels[s->main].key, now, 100 * obeys);
}

/* ---- Starts ---- */

/* What ought to follow the command, as means over cells: the main channel; or, where pressure and position are
 * measured, the air in the chamber, which no jump of the stem changes. */
struct follower {
  double mean[LAB_VIEW_CELLS];
  double least; /* a change that counts */
  double rate;  /* usual rate with an open orifice */
};

/* First and last cell that lie within a stretch.  Returns: 0 if they are too few to say anything. */
static int cells_in(const lab_log_view *s, const lab_stretch *stretch, int *first, int *last)
{
  *first = (int)((s->t[stretch->first] - s->t[0]) / s->cell) + 1;
  *last = (int)((s->t[stretch->end - 1] - s->t[0]) / s->cell) - 1;
  return *last - *first >= LAB_VIEW_FEWEST;
}

/* Median rate over the stretches in which an orifice is open, by size. */
static double open_rate(const lab_log_view *s, const double *mean)
{
  enum { MOST = 64 };
  double rate[MOST];
  lab_stretch stretch = {0, 0, 0, 0};
  int n = 0, first, last;
  while (n < MOST && lab_log_view_next(s, &stretch)) {
    if (stretch.sign == 0 || !cells_in(s, &stretch, &first, &last))
      continue;
    rate[n++] = fabs(mean[last] - mean[first]) / ((last - first) * s->cell);
  }
  lab_sort(rate, (size_t)n);
  return n > 0 ? rate[n / 2] : HUGE_VAL;
}

static void follow(const lab_log_view *s, double noise, struct follower *f)
{
  double low, high;
  lab_range(f->mean, (size_t)s->n_cells, &low, &high);
  f->least = fmax(LAB_VIEW_SIGNIFICANT * noise, 0.02 * (high - low));
  f->rate = open_rate(s, f->mean);
}

static void follow_channel(const lab_log_view *s, struct follower *f)
{
  int k;
  for (k = 0; k < s->n_cells; k++)
    f->mean[k] = s->cells[s->main].mean[k];
  follow(s, s->sigma[s->main], f);
}

/* Absolute pressure times volume, as the mass at constant temperature. */
static void follow_air(const lab_log_view *s, struct follower *f)
{
  const pneu_params *q = &s->rig->params;
  const double ambient = (double)q->ambient_pressure, dead = (double)q->dead_volume, area = (double)q->area;
  const double p = s->cells[LAB_CHANNEL_P].high + ambient, x = s->cells[LAB_CHANNEL_X].high;
  int k;
  for (k = 0; k < s->n_cells; k++)
    f->mean[k] = (s->cells[LAB_CHANNEL_P].mean[k] + ambient) * (dead + area * s->cells[LAB_CHANNEL_X].mean[k]);
  follow(s, hypot((dead + area * x) * s->sigma[LAB_CHANNEL_P], p * area * s->sigma[LAB_CHANNEL_X]), f);
}

/* Does it turn within a stretch and then move the way of the coming command, as fast as through an orifice, though the
 * present one does not allow it? What lasts from the command before, such as a delay, a line that fills up or a chamber
 * that warms, begins with the stretch; this begins within it. */
static int starts_early(const lab_log_view *s, const struct follower *f, const lab_stretch *now, int next_sign)
{
  int first, last, k, turn;
  double moved;
  if (next_sign == 0 || !cells_in(s, now, &first, &last))
    return 0;
  for (k = turn = first; k <= last; k++)
    if (next_sign * f->mean[k] < next_sign * f->mean[turn])
      turn = k;
  for (k = last; next_sign * (f->mean[k] - f->mean[turn]) > f->least / 2; k--)
    ;
  turn = k; /* where it leaves the extreme for good */
  moved = next_sign * (f->mean[last] - f->mean[turn]);
  return turn > first + 2 && moved > f->least && moved > early_rate * f->rate * (last - turn) * s->cell;
}

/* Does it go on against the command to the end of the stretch, as fast as through an orifice? What lasts from the
 * command before slows down. */
static int goes_against(const lab_log_view *s, const struct follower *f, const lab_stretch *now)
{
  const double way = now->sign > 0 ? -1 : 1;
  int first, last, half;
  double moved;
  if (!cells_in(s, now, &first, &last))
    return 0;
  half = (first + last) / 2;
  moved = way * (f->mean[last] - f->mean[half]);
  return moved > f->least && moved > early_rate * f->rate * (last - half) * s->cell &&
         moved > 0.8 * way * (f->mean[half] - f->mean[first]);
}

static int contradicts(const lab_log_view *s, const struct follower *f, const lab_stretch *now, int next_sign)
{
  return goes_against(s, f, now) || starts_early(s, f, now, next_sign);
}

/* A pressure alone cannot tell a jump of the stem, which compresses or expands the air, from a flow: more is asked of
 * it. */
static int are_many(int wrong, int all, int alone)
{
  return wrong >= (alone ? 3 : 2) && wrong * (alone ? 2 : 4) >= all;
}

int lab_check_starts(const lab_log_view *s, lab_check_result *f)
{
  const int stem = s->rig->params.stroke > 0, both = s->y[LAB_CHANNEL_P] && s->y[LAB_CHANNEL_X] && stem;
  const int alone = stem && !s->y[LAB_CHANNEL_X];
  struct follower channel, air;
  lab_stretch now, next = {0, 0, 0, 0};
  size_t where = 0;
  int wrong = 0, all = 0, first, last;
  if (!lab_log_view_next(s, &next))
    return 0;
  follow_channel(s, &channel);
  if (both)
    follow_air(s, &air);
  for (now = next; lab_log_view_next(s, &next); now = next) {
    all += cells_in(s, &now, &first, &last);
    if (!contradicts(s, &channel, &now, next.sign) || (both && !contradicts(s, &air, &now, next.sign)))
      continue;
    where = wrong++ == 0 ? now.end - 1 : where;
  }
  if (!are_many(wrong, all, alone))
    return 0;
  return lab_check_fail(
      f, where,
      "the command does not match: in %d of %d stretches of u %s moves against it or before it, the first "
      "time at t = %.6g s; is u from another test, or on another clock?",
      wrong, all, lab_channels[s->main].key, s->t[where]);
}

/* Checks of plausible.h on the command of a log: does it drive what was measured? */
#include <math.h>

#include "logscene.h"

static const double settled_low = 0.3;     /* of the supply, where a long fill ends */
static const double settled_high = 0.5;    /* of the ambient pressure, where a long vent ends */
static const double significant = 8;       /* in noise: a change over a stretch that counts */
static const double visible = 0.05;        /* of the range: likewise */
static const double against = 0.25;        /* of the range: changes against the command that are worth a word */
static const double thermal = 0.5;         /* of absolute pressure: a shut chamber that warms rises by less */
static const double pace_factor = 20;      /* between what is measured and declared, in time */
static const double alike = 0.4;           /* correlation of rates, measured and expected, below which they differ */
static const double alike_shifted = 0.8;   /* and above which a shift in time is the reason */
static const double obedient = 0.75;       /* share of movement the way of the command, above which all is right */
static const double disobedient = 0.55;    /* and below which it is wrong, however alike */
static const double early_rate = 0.3;      /* of the usual rate with an open orifice */
static const double longest_dead_time = 1; /* [s]: sound travels 340 m */

/* Something other than the command moves stem or chamber. */
static int is_driven(const lab_scene *s)
{
  return s->rig->input[LAB_CHANNEL_X] || s->rig->input[LAB_CHANNEL_P] || s->y[LAB_CHANNEL_FORCE];
}

static const char *kind_of(int sign)
{
  return sign > 0 ? "fills" : sign < 0 ? "vents" : "shuts both orifices";
}

/* ---- Levels ---- */

static int is_open(const lab_scene *s, const lab_stretch *stretch)
{
  size_t i;
  for (i = stretch->first; i < stretch->end; i++)
    if (fabs(s->u[i]) < 0.5)
      return 0;
  return stretch->sign != 0 && stretch->end - stretch->first >= LAB_SCENE_FEWEST;
}

/* Level at the end of a stretch; NaN if it still changes over the last half, or the stem moves. */
static double settles(const lab_scene *s, const double *y, const lab_stretch *stretch, double tolerance)
{
  const size_t late = stretch->end - (stretch->end - stretch->first) / 2;
  const double a = lab_scene_value(y, late, stretch->end, 0), b = lab_scene_value(y, late, stretch->end, 1);
  const double *x = s->y[LAB_CHANNEL_X];
  const double travel =
      x ? fabs(lab_scene_value(x, late, stretch->end, 1) - lab_scene_value(x, late, stretch->end, 0)) : 0;
  const int rests = !(travel > 0.02 * (double)s->rig->params.stroke);
  return late + 1 < stretch->end && rests && fabs(b - a) < tolerance ? b : (double)NAN;
}

int lab_check_settled(const lab_scene *s, lab_finding *f)
{
  const double supply = (double)s->rig->params.supply_pressure, ambient = (double)s->rig->params.ambient_pressure;
  lab_stretch stretch = {0, 0, 0, 0};
  char found[LAB_SHOW_TEXT], want[LAB_SHOW_TEXT];
  if (s->main != LAB_CHANNEL_P || !s->has_expected || is_driven(s))
    return 0;
  while (lab_scene_next(s, &stretch)) {
    const double tolerance = fmax(3 * s->sigma[LAB_CHANNEL_P], 0.005 * supply);
    double level, ought;
    if (!is_open(s, &stretch))
      continue;
    level = settles(s, s->y[LAB_CHANNEL_P], &stretch, tolerance);
    ought = settles(s, s->expected.p, &stretch, tolerance);
    if (stretch.sign > 0 && ought > 0.9 * supply && level < settled_low * supply)
      return lab_find_at(f, stretch.end - 1,
                         "p settles at %s while u fills, expected near the supply, %s: check the unit of p and "
                         "supply.pressure%s",
                         lab_show(LAB_CHANNEL_P, level, found), lab_show(LAB_CHANNEL_P, supply, want),
                         lab_unit_slip(LAB_CHANNEL_P, supply / level));
    if (stretch.sign < 0 && ought < 0.05 * supply && level > settled_high * ambient)
      return lab_find_at(f, stretch.end - 1, "p settles at %s while u vents, expected near 0 gauge%s",
                         lab_show(LAB_CHANNEL_P, level, found),
                         fabs(level - ambient) < 0.15 * ambient ? ": it is the ambient pressure; absolute, so that the "
                                                                  "column is p_abs?"
                                                                : ": check its unit and offset");
  }
  return 0;
}

/* ---- Direction ---- */

enum { RISES, FALLS };
enum { ALLOWED, AGAINST };

/* How far the main channel rises and falls as the command allows, and against it. */
struct account {
  double moved[2][2];
  lab_stretch worst; /* the largest change against its command */
};

/* A shut chamber may warm up. */
static int is_warming(const lab_scene *s, const lab_stretch *stretch)
{
  const double start = lab_scene_value(s->y[s->main], stretch->first, stretch->end, 0);
  return s->main == LAB_CHANNEL_P && stretch->sign == 0 &&
         stretch->change < thermal * (start + (double)s->rig->params.ambient_pressure);
}

/* Change over a stretch; where both orifices are shut without what lasts from the command before, up to a second. */
static double change_of(const lab_scene *s, const lab_stretch *stretch)
{
  size_t i = stretch->first;
  const size_t half = (stretch->first + stretch->end) / 2;
  if (stretch->sign != 0 || stretch->first == 0)
    return stretch->change;
  while (i < half && s->t[i] - s->t[stretch->first] < longest_dead_time)
    i++;
  return lab_scene_value(s->y[s->main], i, stretch->end, 1) - lab_scene_value(s->y[s->main], i, stretch->end, 0);
}

static void book(const lab_scene *s, const lab_stretch *stretch, struct account *a)
{
  const double change = change_of(s, stretch), size = fabs(change);
  const int way = change > 0 ? RISES : FALLS;
  const int kind = (way == RISES ? stretch->sign <= 0 : stretch->sign > 0) ? AGAINST : ALLOWED;
  if (!(size > significant * s->sigma[s->main] && size > visible * lab_scene_span(s, s->main)) ||
      (way == RISES && is_warming(s, stretch)))
    return;
  a->moved[way][kind] += size;
  if (kind == AGAINST && size > fabs(a->worst.change))
    a->worst = *stretch;
}

static int is_idle(const lab_scene *s)
{
  size_t i;
  for (i = 0; i < s->n; i++)
    if (s->u[i] != s->u[0])
      return 0;
  return 1;
}

/* More against the command than with it, and not just a trace. */
static int is_mismatch(const struct account *a, int way, double least)
{
  return a->moved[way][AGAINST] > fmax(a->moved[way][ALLOWED], least);
}

int lab_check_command(const lab_scene *s, lab_finding *f)
{
  struct account a = {{{0, 0}, {0, 0}}, {0, 0, 0, 0}};
  lab_stretch stretch = {0, 0, 0, 0};
  double least, turned;
  char size[LAB_SHOW_TEXT];
  if (s->main < 0 || is_driven(s))
    return 0;
  while (lab_scene_next(s, &stretch))
    book(s, &stretch, &a);
  least = against * lab_scene_span(s, s->main);
  turned = a.moved[RISES][AGAINST] + a.moved[FALLS][AGAINST] - a.moved[RISES][ALLOWED] - a.moved[FALLS][ALLOWED];
  if (!is_mismatch(&a, RISES, least) && (!is_mismatch(&a, FALLS, least) || s->y[LAB_CHANNEL_PS]))
    return 0;
  return lab_find_at(
      f, a.worst.first, "the command does not match: %s %s by %s from t = %.6g s to %.6g s while u = %g %s%s",
      lab_channels[s->main].key, a.worst.change > 0 ? "rises" : "falls", lab_show(s->main, fabs(a.worst.change), size),
      s->t[a.worst.first], s->t[a.worst.end - 1], s->u[a.worst.first], kind_of(a.worst.sign),
      is_idle(s)   ? "; u never changes: is the column right?"
      : turned > 0 ? "; is its sign turned (log.scale = { u = -1.0; }), or the column of another test?"
                   : "; is the column of another test, or does 0 stand for vent?");
}

/* ---- Pace ---- */

/* Rows until a channel has moved by `change` from the start of a stretch; n if it does not. */
static size_t rows_to(const double *y, const lab_stretch *stretch, double change)
{
  const double start = lab_scene_value(y, stretch->first, stretch->end, 0);
  size_t i = stretch->first;
  while (i < stretch->end && !((y[i] - start) * (change > 0 ? 1 : -1) >= fabs(change)))
    i++;
  return i - stretch->first;
}

/* Time from 10 % to 85 % of `change`, which leaves delays out, at least one row; where the stretch is too
 * short, as long as its mean rate would take. NaN if it goes the other way. */
static double time_of(const lab_scene *s, const double *y, const lab_stretch *stretch, double change)
{
  const size_t n = stretch->end - stretch->first, from = rows_to(y, stretch, 0.1 * change);
  const size_t to = rows_to(y, stretch, 0.85 * change);
  const double whole = s->t[stretch->end - 1] - s->t[stretch->first];
  const double moved = lab_scene_value(y, stretch->first, stretch->end, 1) - y[stretch->first];
  if (to >= n)
    return change / moved > 1 ? 0.75 * whole * change / moved : (double)NAN;
  return fmax(s->t[stretch->first + to] - s->t[stretch->first + from], whole / (double)n);
}

static void swap_up(double *value, int n)
{
  for (; n > 0 && value[n] < value[n - 1]; n--) {
    const double keep = value[n];
    value[n] = value[n - 1];
    value[n - 1] = keep;
  }
}

/* Median over large strokes of the time taken over the time expected; NaN without any. */
static double pace(const lab_scene *s)
{
  enum { MOST = 64 };
  const double *expected = lab_scene_expected(s, s->main);
  double ratio[MOST];
  lab_stretch stretch = {0, 0, 0, 0};
  int n = 0;
  while (n < MOST && lab_scene_next(s, &stretch)) {
    const double change = stretch.change;
    if (stretch.sign == 0 || stretch.end - stretch.first < 4 || !(fabs(change) > significant * s->sigma[s->main]) ||
        !(fabs(change) > 0.3 * lab_scene_span(s, s->main)))
      continue;
    ratio[n] = time_of(s, s->y[s->main], &stretch, change) / time_of(s, expected, &stretch, change);
    if (!isnan(ratio[n]))
      swap_up(ratio, n++);
  }
  return n > 0 ? ratio[n / 2] : (double)NAN;
}

int lab_check_pace(const lab_scene *s, lab_finding *f)
{
  double ratio;
  if (s->main < 0 || !s->has_expected || is_driven(s))
    return 0;
  ratio = pace(s);
  if (isnan(ratio) || (ratio < pace_factor && ratio > 1 / pace_factor))
    return 0;
  return lab_find(f,
                  "%s moves %.3g times %s than the declared model: check the unit of t, transducer.fill_area and "
                  "vent_area, and the volume%s",
                  lab_channels[s->main].key, ratio > 1 ? ratio : 1 / ratio, ratio > 1 ? "slower" : "faster",
                  lab_unit_slip(LAB_CHANNEL_TIME, ratio));
}

/* ---- Likeness ---- */

/* Correlation of the rates of the measured channel, `lag` cells later, with the expected ones; each over a few cells,
 * so that a short peak at break-away does not outweigh the strokes. */
static double likeness(const lab_scene *s, int lag)
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
static int rates_are_seen(const lab_scene *s)
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
static int lag_of(const lab_scene *s, double *best)
{
  const int most = s->n_cells / 3;
  int lag;
  *best = 1;
  if (s->main < 0 || !s->has_expected || is_driven(s) || !s->u || !rates_are_seen(s))
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

int lab_check_early(const lab_scene *s, lab_finding *f)
{
  double best;
  const int lag = lag_of(s, &best);
  if (lag > -4 || best < alike_shifted)
    return 0;
  return lab_find(f,
                  "the command does not match: %s moves %.3g s before u says so; are both from one test, and on one "
                  "clock?",
                  lab_channels[s->main].key, -lag * s->cell);
}

/* ---- Starts ---- */

/* What ought to follow the command, as means over cells: the main channel; or, where pressure and position are
 * measured, the air in the chamber, which no jump of the stem changes. */
struct follower {
  double mean[LAB_SCENE_CELLS];
  double least; /* a change that counts */
  double rate;  /* usual rate with an open orifice */
};

/* First and last cell that lie within a stretch.  Returns: 0 if they are too few to say anything. */
static int cells_in(const lab_scene *s, const lab_stretch *stretch, int *first, int *last)
{
  *first = (int)((s->t[stretch->first] - s->t[0]) / s->cell) + 1;
  *last = (int)((s->t[stretch->end - 1] - s->t[0]) / s->cell) - 1;
  return *last - *first >= LAB_SCENE_FEWEST;
}

/* Median rate over the stretches in which an orifice is open, by size. */
static double open_rate(const lab_scene *s, const double *mean)
{
  enum { MOST = 64 };
  double rate[MOST];
  lab_stretch stretch = {0, 0, 0, 0};
  int n = 0, first, last;
  while (n < MOST && lab_scene_next(s, &stretch)) {
    if (stretch.sign == 0 || !cells_in(s, &stretch, &first, &last))
      continue;
    rate[n] = fabs(mean[last] - mean[first]) / ((last - first) * s->cell);
    swap_up(rate, n++);
  }
  return n > 0 ? rate[n / 2] : HUGE_VAL;
}

static void follow(const lab_scene *s, double noise, struct follower *f)
{
  double low = f->mean[0], high = f->mean[0];
  int k;
  for (k = 1; k < s->n_cells; k++) {
    low = fmin(low, f->mean[k]);
    high = fmax(high, f->mean[k]);
  }
  f->least = fmax(significant * noise, 0.02 * (high - low));
  f->rate = open_rate(s, f->mean);
}

static void follow_channel(const lab_scene *s, struct follower *f)
{
  int k;
  for (k = 0; k < s->n_cells; k++)
    f->mean[k] = s->cells[s->main].mean[k];
  follow(s, s->sigma[s->main], f);
}

/* Absolute pressure times volume, as the mass at constant temperature. */
static void follow_air(const lab_scene *s, struct follower *f)
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
static int starts_early(const lab_scene *s, const struct follower *f, const lab_stretch *now, int next_sign)
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
static int goes_against(const lab_scene *s, const struct follower *f, const lab_stretch *now)
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

static int contradicts(const lab_scene *s, const struct follower *f, const lab_stretch *now, int next_sign)
{
  return goes_against(s, f, now) || starts_early(s, f, now, next_sign);
}

/* A pressure alone cannot tell a jump of the stem, which compresses or expands the air, from a flow: more is asked of
 * it. */
static int are_many(int wrong, int all, int alone)
{
  return wrong >= (alone ? 3 : 2) && wrong * (alone ? 2 : 4) >= all;
}

int lab_check_starts(const lab_scene *s, lab_finding *f)
{
  const int stem = s->rig->params.stroke > 0, both = s->y[LAB_CHANNEL_P] && s->y[LAB_CHANNEL_X] && stem;
  const int alone = stem && !s->y[LAB_CHANNEL_X];
  struct follower channel, air;
  lab_stretch now, next = {0, 0, 0, 0};
  size_t where = 0;
  int wrong = 0, all = 0, first, last;
  if (s->main < 0 || is_driven(s) || !lab_scene_next(s, &next))
    return 0;
  follow_channel(s, &channel);
  if (both)
    follow_air(s, &air);
  for (now = next; lab_scene_next(s, &next); now = next) {
    all += cells_in(s, &now, &first, &last);
    if (!contradicts(s, &channel, &now, next.sign) || (both && !contradicts(s, &air, &now, next.sign)))
      continue;
    where = wrong++ == 0 ? now.end - 1 : where;
  }
  if (!are_many(wrong, all, alone))
    return 0;
  return lab_find_at(
      f, where,
      "the command does not match: in %d of %d stretches of u %s moves against it or before it, the first "
      "time at t = %.6g s; is u from another test, or on another clock?",
      wrong, all, lab_channels[s->main].key, s->t[where]);
}

/* Share of the movement that goes the way of the command, or may go on without one: falls while it is shut. A poor
 * guess of an area or a volume spoils the likeness, not this. */
static double obedience(const lab_scene *s)
{
  const double *m = s->cells[s->main].mean, noise = significant * s->sigma[s->main];
  double good = 0, all = 0;
  lab_stretch stretch = {0, 0, 0, 0};
  int k, last;
  while (lab_scene_next(s, &stretch)) {
    last = (int)((s->t[stretch.end - 1] - s->t[0]) / s->cell);
    for (k = (int)((s->t[stretch.first] - s->t[0]) / s->cell); k < last && k + 1 < s->n_cells; k++) {
      const double change = m[k + 1] - m[k];
      if (fabs(change) * LAB_SCENE_FEWEST < noise)
        continue;
      all += fabs(change);
      good += (change > 0) == (stretch.sign > 0) ? fabs(change) : 0;
    }
  }
  return all > 0 ? good / all : 1;
}

int lab_check_alike(const lab_scene *s, lab_finding *f)
{
  double best, now = -1, obeys;
  int k, lag = lag_of(s, &best);
  if (best >= 1 || (best > alike_shifted && lag != 0))
    return 0;
  for (k = 0; k < s->n_cells / 3 && k * s->cell < longest_dead_time; k++)
    now = fmax(now, likeness(s, k));
  obeys = obedience(s);
  if (obeys > (now > alike ? disobedient : obedient))
    return 0;
  return lab_find(
      f,
      "the command does not match: what %s does is not what the declared model makes of u (correlation of "
      "rates %.2f, %.0f %% of the movement the way of u); is u from another test, or the rig file of another "
      "rig?",
      lab_channels[s->main].key, now, 100 * obeys);
}

int lab_check_late(const lab_scene *s, lab_finding *f)
{
  double best;
  const int lag = lag_of(s, &best);
  if (lag < 4 || best < alike_shifted || lag * s->cell < longest_dead_time)
    return 0;
  return lab_find(f,
                  "%s follows u about %.3g s late, longer than a dead time of a transducer or a line: command and "
                  "measurement seem to be on different clocks",
                  lab_channels[s->main].key, lag * s->cell);
}

/* ---- Commands from 0 to 1 ---- */

int lab_check_one_sided(const lab_scene *s, lab_finding *f)
{
  lab_stretch stretch = {0, 0, 0, 0};
  double fall = HUGE_VAL, rise = HUGE_VAL, span;
  if (s->main < 0 || is_driven(s))
    return 0;
  span = lab_scene_span(s, s->main);
  while (lab_scene_next(s, &stretch)) {
    const double change = stretch.change;
    if (stretch.sign < 0)
      return 0;
    if (fabs(stretch.change) < fmax(0.2 * span, significant * s->sigma[s->main]) || stretch.end - stretch.first < 2)
      continue;
    if (stretch.sign == 0 && change < 0)
      fall = fmin(fall, time_of(s, s->y[s->main], &stretch, change));
    if (stretch.sign > 0 && change > 0)
      rise = fmin(rise, s->u[stretch.first] * time_of(s, s->y[s->main], &stretch, change));
  }
  if (!isfinite(fall) || !isfinite(rise) || fall > 2 * rise)
    return 0;
  return lab_find(f,
                  "u is never negative, and %s falls while it is 0, in %.3g s: as fast as through an orifice; if "
                  "0 stands for vent, make it -1 by log.scale and log.offset",
                  lab_channels[s->main].key, fall);
}

/* Checks of plausible.h on the command of a log: does it drive what was measured? */
#include <math.h>

#include "../base/array.h"
#include "logview.h"

static const double settled_low = 0.3;  /* of the supply, where a long fill ends */
static const double settled_high = 0.5; /* of the ambient pressure, where a long vent ends */
static const double visible = 0.05;     /* of the range: a change over a stretch that counts */
static const double against = 0.25;     /* of the range: changes against the command that are worth a word */
static const double thermal = 0.5;      /* of absolute pressure: a shut chamber that warms rises by less */
static const double about_half = 0.02;  /* of a command: so near to one half it is one half */
static const double half_still = 0.2;   /* of what the model would do there: so little is standing still */
static const double pace_factor = 20;   /* between what is measured and declared, in time */

static const char *kind_of(int sign)
{
  return sign > 0 ? "fills" : sign < 0 ? "vents" : "shuts both orifices";
}

/* ---- Levels ---- */

static int is_open(const lab_log_view *s, const lab_stretch *stretch)
{
  size_t i;
  for (i = stretch->first; i < stretch->end; i++)
    if (fabs(s->u[i]) < 0.5)
      return 0;
  return stretch->sign != 0 && stretch->end - stretch->first >= LAB_VIEW_FEWEST;
}

/* Level at the end of a stretch; NaN if it still changes over the last half, or the stem moves. */
static double settles(const lab_log_view *s, const double *y, const lab_stretch *stretch, double tolerance)
{
  const size_t late = stretch->end - (stretch->end - stretch->first) / 2;
  const double a = lab_log_view_value(y, late, stretch->end, 0), b = lab_log_view_value(y, late, stretch->end, 1);
  const double *x = s->y[LAB_CHANNEL_X];
  const double travel =
      x ? fabs(lab_log_view_value(x, late, stretch->end, 1) - lab_log_view_value(x, late, stretch->end, 0)) : 0;
  const int rests = !(travel > 0.02 * (double)s->rig->params.stroke);
  return late + 1 < stretch->end && rests && fabs(b - a) < tolerance ? b : (double)NAN;
}

int lab_check_settled(const lab_log_view *s, lab_check_result *f)
{
  const double supply = (double)s->rig->params.supply_pressure, ambient = (double)s->rig->params.ambient_pressure;
  lab_stretch stretch = {0, 0, 0, 0};
  if (s->main != LAB_CHANNEL_P)
    return 0;
  while (lab_log_view_next(s, &stretch)) {
    const double tolerance = fmax(3 * s->sigma[LAB_CHANNEL_P], 0.005 * supply);
    double level, ought;
    if (!is_open(s, &stretch))
      continue;
    level = settles(s, s->y[LAB_CHANNEL_P], &stretch, tolerance);
    ought = settles(s, s->expected.p, &stretch, tolerance);
    if (stretch.sign > 0 && ought > 0.9 * supply && level < settled_low * supply)
      return lab_check_fail(f, stretch.end - 1,
                            "p settles at %s while u fills, expected near the supply, %s: check the unit of p and "
                            "supply.pressure%s",
                            lab_check_show(f, LAB_CHANNEL_P, level), lab_check_show(f, LAB_CHANNEL_P, supply),
                            lab_unit_slip(LAB_CHANNEL_P, supply / level));
    if (stretch.sign < 0 && ought < 0.05 * supply && level > settled_high * ambient)
      return lab_check_fail(f, stretch.end - 1, "p settles at %s while u vents, expected near 0 gauge%s",
                            lab_check_show(f, LAB_CHANNEL_P, level),
                            fabs(level - ambient) < 0.15 * ambient
                                ? ": it is the ambient pressure; absolute, so that the "
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
static int is_warming(const lab_log_view *s, const lab_stretch *stretch)
{
  const double start = lab_log_view_value(s->y[s->main], stretch->first, stretch->end, 0);
  return s->main == LAB_CHANNEL_P && stretch->sign == 0 &&
         stretch->change < thermal * (start + (double)s->rig->params.ambient_pressure);
}

/* Change over a stretch; where both orifices are shut without what lasts from the command before, up to a second. */
static double change_of(const lab_log_view *s, const lab_stretch *stretch)
{
  size_t i = stretch->first;
  const size_t half = (stretch->first + stretch->end) / 2;
  if (stretch->sign != 0 || stretch->first == 0)
    return stretch->change;
  while (i < half && s->t[i] - s->t[stretch->first] < LAB_VIEW_DEAD_TIME)
    i++;
  return lab_log_view_value(s->y[s->main], i, stretch->end, 1) - lab_log_view_value(s->y[s->main], i, stretch->end, 0);
}

static void book(const lab_log_view *s, const lab_stretch *stretch, struct account *a)
{
  const double change = change_of(s, stretch), size = fabs(change);
  const int way = change > 0 ? RISES : FALLS;
  const int kind = (way == RISES ? stretch->sign <= 0 : stretch->sign > 0) ? AGAINST : ALLOWED;
  if (!(size > LAB_VIEW_SIGNIFICANT * s->sigma[s->main] && size > visible * lab_log_view_span(s, s->main)) ||
      (way == RISES && is_warming(s, stretch)))
    return;
  a->moved[way][kind] += size;
  if (kind == AGAINST && size > fabs(a->worst.change))
    a->worst = *stretch;
}

/* More against the command than with it, and not just a trace. */
static int is_mismatch(const struct account *a, int way, double least)
{
  return a->moved[way][AGAINST] > fmax(a->moved[way][ALLOWED], least);
}

int lab_check_command(const lab_log_view *s, lab_check_result *f)
{
  struct account a = {{{0, 0}, {0, 0}}, {0, 0, 0, 0}};
  lab_stretch stretch = {0, 0, 0, 0};
  double least, turned;
  while (lab_log_view_next(s, &stretch))
    book(s, &stretch, &a);
  least = against * lab_log_view_span(s, s->main);
  turned = a.moved[RISES][AGAINST] + a.moved[FALLS][AGAINST] - a.moved[RISES][ALLOWED] - a.moved[FALLS][ALLOWED];
  if (!is_mismatch(&a, RISES, least) && (!is_mismatch(&a, FALLS, least) || s->y[LAB_CHANNEL_PS]))
    return 0;
  return lab_check_fail(
      f, a.worst.first, "the command does not match: %s %s by %s from t = %.6g s to %.6g s while u = %g %s%s",
      lab_channels[s->main].key, a.worst.change > 0 ? "rises" : "falls",
      lab_check_show(f, s->main, fabs(a.worst.change)), s->t[a.worst.first], s->t[a.worst.end - 1], s->u[a.worst.first],
      kind_of(a.worst.sign),
      s->u_low == s->u_high ? "; u never changes: is the column right?"
      : turned > 0          ? "; is its sign turned (log.scale = { u = -1.0; }), or the column of another test?"
                            : "; is the column of another test, or does 0 stand for vent?");
}

/* ---- 50 % that stands for shut ---- */

/* What the main channel does while the command is below, at and above one half. */
struct thirds {
  double up[3], down[3], time[3];
  double due;   /* change at one half, were the transducer half open as u says */
  size_t first; /* row from which it stays away */
};

static int third_of(double u)
{
  return u < 0.5 - about_half ? 0 : u > 0.5 + about_half ? 2 : 1;
}

/* The next rows of one kind.  In/out: end  Returns: 0 at the end */
static int next_third(const lab_log_view *s, size_t *first, size_t *end)
{
  *first = *end;
  while (*end < s->n && third_of(s->u[*end]) == third_of(s->u[*first]))
    ++*end;
  return *first < s->n;
}

static void sort_by_thirds(const lab_log_view *s, struct thirds *a)
{
  const double *y = s->y[s->main];
  size_t first, end = 0;
  while (next_third(s, &first, &end)) {
    const int third = third_of(s->u[first]);
    const double change = lab_log_view_value(y, first, end, 1) - lab_log_view_value(y, first, end, 0);
    if (!isnan(change))
      (change > 0 ? a->up : a->down)[third] += fabs(change);
    a->time[third] += s->t[end - 1] - s->t[first];
  }
}

/* At half the rate of a full opening, up to where filling ends. */
static void sum_up_due(const lab_log_view *s, double rate, struct thirds *a)
{
  const pneu_params *p = &s->rig->params;
  const double top = (double)(s->main == LAB_CHANNEL_P ? p->supply_pressure : p->stroke);
  size_t first, end = 0;
  while (next_third(s, &first, &end)) {
    const double room = top - lab_log_view_value(s->y[s->main], first, end, 0);
    const double due = fmin(0.5 * rate * (s->t[end - 1] - s->t[first]), room);
    if (third_of(s->u[first]) != 1 || !(due > 0))
      continue;
    if (a->due == 0)
      a->first = first;
    a->due += due;
  }
}

int lab_check_half(const lab_log_view *s, lab_check_result *f)
{
  struct thirds a = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0, 0};
  double least;
  int fills, vents;
  if (s->rig->log.command_is_pressure || s->u_low < 0 || s->u_high > 1)
    return 0;
  least = against * lab_log_view_span(s, s->main);
  sort_by_thirds(s, &a);
  fills = a.up[2] >= a.up[0] ? 2 : 0; /* turned */
  vents = 2 - fills;
  if (a.down[vents] < fmax(least, 4 * a.up[vents]) || a.up[fills] < fmax(least, 4 * a.down[fills]))
    return 0;
  sum_up_due(s, a.up[fills] / a.time[fills], &a);
  if (!(a.due > 0.5 * least) || a.up[1] + a.down[1] > half_still * a.due)
    return 0;
  return lab_check_fail(f, a.first,
                        "the %s does not follow the command from t = %.6g s: it falls while u is %s 0.5, rises while "
                        "u is %s it, and stays while u is 0.5: is u in percent (is 50 %% shut on this log? "
                        "log.scale = { u = %.1f; }; log.offset = { u = %.1f; })",
                        lab_channels[s->main].quantity, s->t[a.first], fills ? "below" : "above",
                        fills ? "above" : "below", fills ? 2.0 : -2.0, fills ? -1.0 : 1.0);
}

/* ---- Pressure that is lost ---- */

/* The largest fall within a stretch.  Out: from, to: its rows */
static double largest_fall(const lab_log_view *s, const lab_stretch *stretch, size_t *from, size_t *to)
{
  double top = -HUGE_VAL, fall = 0;
  size_t i, at = stretch->first;
  for (i = stretch->first; i < stretch->end; i++) {
    const double value = lab_log_view_value(s->y[s->main], i, stretch->end, 0);
    if (value > top) {
      top = value;
      at = i;
    }
    if (top - value > fall) {
      fall = top - value;
      *from = at;
      *to = i;
    }
  }
  return fall;
}

int lab_check_fall(const lab_log_view *s, lab_check_result *f)
{
  lab_stretch stretch = {0, 0, 0, 0};
  double least, u = 0, worst = 0;
  size_t from = 0, to = 0, a = 0, b = 0;
  int vents = 0;
  if (s->main != LAB_CHANNEL_P || s->y[LAB_CHANNEL_PS] || s->u_low == s->u_high)
    return 0;
  least = fmax(against * lab_log_view_span(s, s->main), LAB_VIEW_SIGNIFICANT * s->sigma[s->main]);
  while (lab_log_view_next(s, &stretch)) {
    const double fall = stretch.sign < 0 ? 0 : largest_fall(s, &stretch, &a, &b);
    vents |= stretch.sign < 0;
    if (fall > fmax(least, worst) && (stretch.sign > 0 || !vents)) {
      worst = fall;
      from = a;
      to = b;
      u = s->u[b];
    }
  }
  if (worst == 0 || (u == 0 && vents))
    return 0;
  return lab_check_fail(f, from, "p falls by %s from t = %.6g s to %.6g s while u = %g %s: %s",
                        lab_check_show(f, LAB_CHANNEL_P, worst), s->t[from], s->t[to], u, kind_of(u > 0),
                        u > 0 ? "the chamber leaks more than the orifice lets in, the supply has failed, or u is not "
                                "what the transducer got"
                              : "the chamber leaks, or 0 does not stand for shut, for u is never negative");
}

/* ---- Pace ---- */

/* Rows until a channel has moved by `change` from the start of a stretch; n if it does not. */
static size_t rows_to(const double *y, const lab_stretch *stretch, double change)
{
  const double start = lab_log_view_value(y, stretch->first, stretch->end, 0);
  size_t i = stretch->first;
  while (i < stretch->end && !((y[i] - start) * (change > 0 ? 1 : -1) >= fabs(change)))
    i++;
  return i - stretch->first;
}

/* Time from 10 % to 85 % of `change`, which leaves delays out, at least one row; where the stretch is too
 * short, as long as its mean rate would take. NaN if it goes the other way. */
static double time_of(const lab_log_view *s, const double *y, const lab_stretch *stretch, double change)
{
  const size_t n = stretch->end - stretch->first, from = rows_to(y, stretch, 0.1 * change);
  const size_t to = rows_to(y, stretch, 0.85 * change);
  const double whole = s->t[stretch->end - 1] - s->t[stretch->first];
  const double moved = lab_log_view_value(y, stretch->first, stretch->end, 1) - y[stretch->first];
  if (to >= n)
    return change / moved > 1 ? 0.75 * whole * change / moved : (double)NAN;
  return fmax(s->t[stretch->first + to] - s->t[stretch->first + from], whole / (double)n);
}

/* Median over large strokes of the time taken over the time expected; NaN without any. */
static double pace(const lab_log_view *s)
{
  enum { MOST = 64 };
  const double *expected = lab_log_view_expected(s, s->main);
  double ratio[MOST];
  lab_stretch stretch = {0, 0, 0, 0};
  int n = 0;
  while (n < MOST && lab_log_view_next(s, &stretch)) {
    const double change = stretch.change;
    if (stretch.sign == 0 || stretch.end - stretch.first < 4 ||
        !(fabs(change) > LAB_VIEW_SIGNIFICANT * s->sigma[s->main]) ||
        !(fabs(change) > 0.3 * lab_log_view_span(s, s->main)))
      continue;
    ratio[n] = time_of(s, s->y[s->main], &stretch, change) / time_of(s, expected, &stretch, change);
    n += !isnan(ratio[n]);
  }
  lab_sort(ratio, (size_t)n);
  return n > 0 ? ratio[n / 2] : (double)NAN;
}

/* A command that a positioner gave suits the rig, not the declared model, which runs away under it. */
int lab_check_pace(const lab_log_view *s, lab_check_result *f)
{
  const double ratio = s->log->value[LAB_CHANNEL_SP] ? (double)NAN : pace(s);
  if (isnan(ratio) || (ratio < pace_factor && ratio > 1 / pace_factor))
    return 0;
  return lab_check_fail(f, LAB_NO_ROW,
                        "%s moves %.3g times %s than the declared model: check the unit of t, transducer.fill_area and "
                        "vent_area, and the volume%s",
                        lab_channels[s->main].key, ratio > 1 ? ratio : 1 / ratio, ratio > 1 ? "slower" : "faster",
                        lab_unit_slip(LAB_CHANNEL_TIME, ratio));
}

/* ---- Commands from 0 to 1 ---- */

int lab_check_one_sided(const lab_log_view *s, lab_check_result *f)
{
  lab_stretch stretch = {0, 0, 0, 0};
  const double span = lab_log_view_span(s, s->main);
  double fall = HUGE_VAL, rise = HUGE_VAL;
  while (lab_log_view_next(s, &stretch)) {
    const double change = stretch.change;
    if (stretch.sign < 0)
      return 0;
    if (fabs(stretch.change) < fmax(0.2 * span, LAB_VIEW_SIGNIFICANT * s->sigma[s->main]) ||
        stretch.end - stretch.first < 2)
      continue;
    if (stretch.sign == 0 && change < 0)
      fall = fmin(fall, time_of(s, s->y[s->main], &stretch, change));
    if (stretch.sign > 0 && change > 0)
      rise = fmin(rise, s->u[stretch.first] * time_of(s, s->y[s->main], &stretch, change));
  }
  if (!isfinite(fall) || !isfinite(rise) || fall > 2 * rise)
    return 0;
  return lab_check_fail(f, LAB_NO_ROW,
                        "u is never negative, and %s falls while it is 0, in %.3g s: as fast as through an orifice; if "
                        "0 stands for vent, make it -1 by log.scale and log.offset",
                        lab_channels[s->main].key, fall);
}

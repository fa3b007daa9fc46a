/* Checks of plausible.h on the command of a log: does it drive what was measured? */
#include <math.h>

#include "logscene.h"

static const double settled_low = 0.3;  /* of the supply, where a long fill ends */
static const double settled_high = 0.5; /* of the ambient pressure, where a long vent ends */
static const double visible = 0.05;     /* of the range: a change over a stretch that counts */
static const double against = 0.25;     /* of the range: changes against the command that are worth a word */
static const double thermal = 0.5;      /* of absolute pressure: a shut chamber that warms rises by less */
static const double pace_factor = 20;   /* between what is measured and declared, in time */

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
  if (s->main != LAB_CHANNEL_P || !s->has_expected || lab_scene_is_driven(s))
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
  while (i < half && s->t[i] - s->t[stretch->first] < LAB_SCENE_DEAD_TIME)
    i++;
  return lab_scene_value(s->y[s->main], i, stretch->end, 1) - lab_scene_value(s->y[s->main], i, stretch->end, 0);
}

static void book(const lab_scene *s, const lab_stretch *stretch, struct account *a)
{
  const double change = change_of(s, stretch), size = fabs(change);
  const int way = change > 0 ? RISES : FALLS;
  const int kind = (way == RISES ? stretch->sign <= 0 : stretch->sign > 0) ? AGAINST : ALLOWED;
  if (!(size > LAB_SCENE_SIGNIFICANT * s->sigma[s->main] && size > visible * lab_scene_span(s, s->main)) ||
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
  if (s->main < 0 || lab_scene_is_driven(s))
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
    if (stretch.sign == 0 || stretch.end - stretch.first < 4 ||
        !(fabs(change) > LAB_SCENE_SIGNIFICANT * s->sigma[s->main]) ||
        !(fabs(change) > 0.3 * lab_scene_span(s, s->main)))
      continue;
    ratio[n] = time_of(s, s->y[s->main], &stretch, change) / time_of(s, expected, &stretch, change);
    if (!isnan(ratio[n]))
      lab_sort_in(ratio, n++);
  }
  return n > 0 ? ratio[n / 2] : (double)NAN;
}

int lab_check_pace(const lab_scene *s, lab_finding *f)
{
  double ratio;
  if (s->main < 0 || !s->has_expected || lab_scene_is_driven(s))
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

/* ---- Commands from 0 to 1 ---- */

int lab_check_one_sided(const lab_scene *s, lab_finding *f)
{
  lab_stretch stretch = {0, 0, 0, 0};
  double fall = HUGE_VAL, rise = HUGE_VAL, span;
  if (s->main < 0 || lab_scene_is_driven(s))
    return 0;
  span = lab_scene_span(s, s->main);
  while (lab_scene_next(s, &stretch)) {
    const double change = stretch.change;
    if (stretch.sign < 0)
      return 0;
    if (fabs(stretch.change) < fmax(0.2 * span, LAB_SCENE_SIGNIFICANT * s->sigma[s->main]) ||
        stretch.end - stretch.first < 2)
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

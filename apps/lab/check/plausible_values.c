/* Checks of plausible.h on the values of a log: ranges, units, sensors, noise. */
#include <math.h>
#include <string.h>

#include "../base/noise.h"
#include "logview.h"
#include "standstill.h"
#include "../base/array.h"
#include "../base/line.h"
#include "../run/start.h"

/* Wide of what effects of a usual size do: gains of a tenth, a bias of some kPa, a stop that ends the travel early. */
static const double over_supply = 1.3, vacuum = -0.3, beyond_stop = 0.25, still_noise = 3, reach_share = 0.25;
static const double force_low = 0.4, force_high = 2.5, hot = 1.7, cold = 0.5;

/* What a channel may differ by and be the same, for all that its noise says. */
static double within_noise(const lab_log_view *s, int c)
{
  return isnan(s->sigma[c]) ? 0 : still_noise * s->sigma[c];
}

static int moves(const lab_log_view *s, int c)
{
  return lab_log_view_span(s, c) > within_noise(s, c);
}

int lab_log_view_is_still(const lab_log_view *s)
{
  if (s->n < LAB_VIEW_FEWEST || s->main < 0)
    return 0;
  return !(lab_log_view_predicts(s, LAB_CHANNEL_P) && moves(s, LAB_CHANNEL_P)) &&
         !(lab_log_view_predicts(s, LAB_CHANNEL_X) && moves(s, LAB_CHANNEL_X));
}

static double supply_of(const lab_log_view *s)
{
  double low, high;
  if (!s->y[LAB_CHANNEL_PS] || !lab_range(s->y[LAB_CHANNEL_PS], s->n, &low, &high))
    return (double)s->rig->params.supply_pressure;
  return high;
}

/* Row at the middle of a cell where the mean is what is asked for. */
static size_t row_of(const lab_log_view *s, const lab_view_cells *cells, double mean)
{
  size_t i = 0;
  int k = 0;
  while (k + 1 < s->n_cells && cells->mean[k] != mean)
    k++;
  while (i + 1 < s->n && s->t[i] < s->t[0] + (k + 0.5) * s->cell)
    i++;
  return i;
}

/* Pressure at which the declared spring holds the stem.  In: direction  of dry friction, as in pneu_balance_pressure */
static double holding_pressure(const lab_log_view *s, double x, int direction)
{
  pneu_input input;
  pneu_input_default(&s->model, &input);
  return (double)pneu_balance_pressure(&s->model, (pneu_real)x, &input, direction);
}

/* Where the declared spring would hold the stem at the highest pressure of the log, friction against it. */
static double reach(const lab_log_view *s)
{
  const double friction = holding_pressure(s, 0, 1) - holding_pressure(s, 0, 0);
  pneu_input input;
  if (!s->y[LAB_CHANNEL_P] || s->y[LAB_CHANNEL_FORCE] || !(s->rig->params.spring_rate > 0))
    return 0;
  pneu_input_default(&s->model, &input);
  return lab_balance_position(&s->model, s->cells[LAB_CHANNEL_P].high - 1.5 * friction, &input);
}

/* ---- The declared supply ---- */

/* A stem that rises in the log, where half of what is declared to hold it is more than the supply. */
int lab_check_standstill(const lab_log_view *s, lab_check_result *f)
{
  const lab_view_cells *x = &s->cells[LAB_CHANNEL_X];
  char text[LAB_LIMITATION_TEXT];
  if (!lab_log_view_predicts(s, LAB_CHANNEL_X) || !lab_is_at_rest(s->rig, 0.5, text) ||
      !(x->high > x->mean[0] + 0.1 * (double)s->rig->params.stroke))
    return 0;
  return lab_check_fail(f, row_of(s, x, x->high), "x rises, but %s", text);
}

/* ---- Ranges ---- */

int lab_check_pressure_range(const lab_log_view *s, lab_check_result *f)
{
  const lab_view_cells *p = &s->cells[LAB_CHANNEL_P];
  const double supply = supply_of(s),
               most = s->main == LAB_CHANNEL_P && s->has_expected ? s->expected_cells.high : supply;
  if (!(s->u_high > 0) || !(p->high > over_supply * supply + within_noise(s, LAB_CHANNEL_P)))
    return 0;
  return lab_check_fail(
      f, row_of(s, p, p->high),
      "p is %s, expected no more than the supply, %s gauge: check the unit of p, supply.pressure, and "
      "whether the log is of this rig%s",
      lab_check_show(f, LAB_CHANNEL_P, p->high), lab_check_show(f, LAB_CHANNEL_P, supply),
      lab_unit_slip(LAB_CHANNEL_P, p->high / most));
}

int lab_check_vacuum(const lab_log_view *s, lab_check_result *f)
{
  const lab_view_cells *p = &s->cells[LAB_CHANNEL_P];
  if (!(p->low < vacuum * (double)s->rig->params.ambient_pressure))
    return 0;
  return lab_check_fail(
      f, row_of(s, p, p->low),
      "p is %s gauge, expected no vacuum: is it a gauge pressure in a column p_abs, or its offset wrong?",
      lab_check_show(f, LAB_CHANNEL_P, p->low));
}

int lab_check_position_range(const lab_log_view *s, lab_check_result *f)
{
  const lab_view_cells *x = &s->cells[LAB_CHANNEL_X];
  const double stroke = (double)s->rig->params.stroke;
  const int above = x->high > (1 + beyond_stop) * stroke, below = x->low < -beyond_stop * stroke;
  const double worst = above ? x->high : x->low;
  if (!(stroke > 0) || lab_rig_fits(s->rig, PNEU_PARAM_stroke) || (!above && !below))
    return 0;
  return lab_check_fail(
      f, row_of(s, x, worst),
      "x is %s, expected 0 to the stroke, %s: check the unit of x, its zero and direction (log.scale, "
      "log.offset), actuator.stroke, and whether the log is of this rig%s",
      lab_check_show(f, LAB_CHANNEL_X, worst), lab_check_show(f, LAB_CHANNEL_X, stroke),
      lab_unit_slip(LAB_CHANNEL_X, lab_log_view_span(s, LAB_CHANNEL_X) / fmax(reach(s), 0.25 * stroke)));
}

int lab_check_temperature(const lab_log_view *s, lab_check_result *f)
{
  const double ambient = (double)s->rig->params.ambient_temperature;
  double T;
  if (!s->y[LAB_CHANNEL_T])
    return 0;
  T = lab_log_view_value(s->y[LAB_CHANNEL_T], 0, s->n, 0);
  if (isnan(T) || (T > cold * ambient && T < hot * ambient))
    return 0;
  return lab_check_fail(f, 0, "T begins at %.4g K, expected something near the ambient, %.4g K; degC and K mixed up?",
                        T, ambient);
}

/* ---- Sensors that do not follow ---- */

/* By how much the channel ought to move: the position by the measured pressure where there is one. */
static double ought_to_move(const lab_log_view *s, int c)
{
  double low, high;
  if (c == LAB_CHANNEL_X && s->y[LAB_CHANNEL_P])
    return reach(s);
  return s->has_expected && lab_range(lab_log_view_expected(s, c), s->n, &low, &high) ? high - low : 0;
}

static double scale_of(const lab_log_view *s, int c)
{
  return c == LAB_CHANNEL_X ? (double)s->rig->params.stroke : supply_of(s);
}

int lab_check_dead(const lab_log_view *s, lab_check_result *f)
{
  static const double hardly = 0.01; /* of the stroke or the supply: what is rounded coarsely still changes */
  int c;
  for (c = LAB_CHANNEL_P; c <= LAB_CHANNEL_X; c++) {
    const double ought = lab_log_view_predicts(s, c) ? ought_to_move(s, c) : 0;
    if (!(ought > 0.25 * scale_of(s, c)) || ought < 30 * s->sigma[c] ||
        lab_log_view_span(s, c) > fmax(within_noise(s, c), hardly * scale_of(s, c)))
      continue;
    if (isnan(lab_log_view_span(s, c)))
      return lab_check_fail(f, LAB_NO_ROW, "channel %s has no values: name its column \"-\" to leave it out",
                            lab_channels[c].key);
    return lab_check_fail(
        f, LAB_NO_ROW,
        "channel %s stays constant within %s, expected it to move by about %s: is %s, the supply shut, the sensor "
        "dead, or is it the wrong log? Name a column \"-\" to leave it out%s",
        lab_channels[c].key, lab_check_show(f, c, lab_log_view_span(s, c)), lab_check_show(f, c, ought),
        c == LAB_CHANNEL_X ? "the stem stuck" : "the transducer shut",
        lab_unit_slip(c, ought / lab_log_view_span(s, c)));
  }
  return 0;
}

int lab_check_reach(const lab_log_view *s, lab_check_result *f)
{
  const double ought = lab_log_view_predicts(s, LAB_CHANNEL_X) ? reach(s) : 0;
  const double high = s->cells[LAB_CHANNEL_X].high;
  if (!(ought > 0.5 * (double)s->rig->params.stroke) || !(high < reach_share * ought))
    return 0;
  return lab_check_fail(
      f, LAB_NO_ROW,
      "x reaches %s, expected about %s where p is %s: check the units of x and p, actuator.stroke and the "
      "spring%s",
      lab_check_show(f, LAB_CHANNEL_X, high), lab_check_show(f, LAB_CHANNEL_X, ought),
      lab_check_show(f, LAB_CHANNEL_P, s->cells[LAB_CHANNEL_P].high), lab_unit_slip(LAB_CHANNEL_X, ought / high));
}

/* Median over cells in mid-travel of the force of the air and that of the declared spring.  Returns: cells. */
static int forces(const lab_log_view *s, double *air, double *spring)
{
  const pneu_params *q = &s->rig->params;
  const double stroke = (double)q->stroke, span = lab_log_view_span(s, LAB_CHANNEL_X);
  const double top = fmin(0.85 * stroke, s->cells[LAB_CHANNEL_X].low + 0.85 * span); /* it may end before its stroke */
  double a[LAB_VIEW_CELLS], b[LAB_VIEW_CELLS];
  int k, n = 0;
  for (k = 0; k < s->n_cells; k++) {
    const double x = s->cells[LAB_CHANNEL_X].mean[k];
    if (!(x > 0.15 * stroke && x < top))
      continue;
    a[n] = (double)q->area * s->cells[LAB_CHANNEL_P].mean[k];
    b[n++] = (double)q->area * holding_pressure(s, x, 0);
  }
  lab_sort(a, (size_t)n);
  lab_sort(b, (size_t)n);
  *air = n > 0 ? a[n / 2] : (double)NAN;
  *spring = n > 0 ? b[n / 2] : (double)NAN;
  return n;
}

int lab_check_balance(const lab_log_view *s, lab_check_result *f)
{
  const double friction = (double)s->rig->params.dry_friction;
  const int driven = s->rig->input[LAB_CHANNEL_X] || s->y[LAB_CHANNEL_FORCE];
  double air, spring;
  if (driven || !(s->rig->params.spring_rate > 0) || forces(s, &air, &spring) < 5)
    return 0;
  if (air > force_low * spring - friction && air < force_high * spring + friction)
    return 0;
  return lab_check_fail(
      f, LAB_NO_ROW,
      "in mid-travel p presses on the stem with %.4g N, expected about the %.4g N of the declared spring: "
      "check the unit of p, the area and the spring%s",
      air, spring, lab_unit_slip(LAB_CHANNEL_P, spring / air));
}

int lab_check_opposite(const lab_log_view *s, lab_check_result *f)
{
  const double *p = s->cells[LAB_CHANNEL_P].mean, *x = s->cells[LAB_CHANNEL_X].mean;
  lab_line line = {0};
  double correlation;
  int k;
  if (s->rig->input[LAB_CHANNEL_X] || s->y[LAB_CHANNEL_FORCE] ||
      !(lab_log_view_span(s, LAB_CHANNEL_X) > 0.1 * (double)s->rig->params.stroke) || !moves(s, LAB_CHANNEL_P))
    return 0;
  for (k = 0; k < s->n_cells; k++)
    lab_line_add(&line, p[k], x[k], 1);
  correlation = line.xy / sqrt(line.xx * line.yy);
  if (!(correlation < -0.3))
    return 0;
  return lab_check_fail(
      f, LAB_NO_ROW,
      "x falls as p rises (correlation %.2f), but x counts in the direction in which air drives the stem. "
      "Where air closes the valve, write actuator.fail = \"open\", where it opens it \"close\"; else turn x by "
      "log.scale = { x = -1.0; } and log.offset = { x = \"%g mm\"; }, or check the columns",
      correlation, 1e3 * (double)s->rig->params.stroke);
}

/* ---- What limits a log ---- */

/* A value often comes twice in a row where the steps of a recorder are coarser than the noise. */
static int has_repeats(const double *y, size_t n)
{
  size_t i, same = 0;
  for (i = 1; i < n; i++)
    same += y[i] == y[i - 1];
  return same > n / 10;
}

int lab_check_steps(const lab_log_view *s, lab_check_result *f)
{
  int c;
  for (c = LAB_CHANNEL_P; c <= LAB_CHANNEL_T; c++) {
    const double declared = s->rig->noise[c], step = s->y[c] ? lab_smallest_step(s->y[c], s->n) : 0;
    if (s->y[c] && step >= 2 * declared && has_repeats(s->y[c], s->n))
      return lab_check_fail(
          f, LAB_NO_ROW,
          "%s is recorded in steps of %s, coarser than the noise of %s that the rig file declares: nothing "
          "below the step can be seen",
          lab_channels[c].key, lab_check_show(f, c, step), lab_check_show(f, c, declared));
  }
  return 0;
}

/* Rows far apart differ by more than noise, so that a log must have many to be asked. */
int lab_check_noise(const lab_log_view *s, lab_check_result *f)
{
  enum { ENOUGH = 200 };
  int c;
  for (c = LAB_CHANNEL_P; c <= LAB_CHANNEL_T && s->n >= ENOUGH; c++) {
    const double declared = s->rig->noise[c], seen = s->seen[c];
    if (seen > 3 * declared || seen < declared / 3)
      return lab_check_fail(f, LAB_NO_ROW,
                            "the noise of %s is about %s from row to row, and %s in the rig file: the report "
                            "counts in the latter, and a wrong one hides effects or leaves the verdict undecided",
                            lab_channels[c].key, lab_check_show(f, c, seen), lab_check_show(f, c, declared));
  }
  return 0;
}

int lab_check_jump(const lab_log_view *s, lab_check_result *f)
{
  const double whole = s->t[s->n - 1] - s->t[0];
  double gap, usual;
  size_t i, at = 1;
  for (i = 2; i < s->n; i++)
    if (s->t[i] - s->t[i - 1] > s->t[at] - s->t[at - 1])
      at = i;
  gap = s->t[at] - s->t[at - 1];
  usual = (whole - gap) / (double)(s->n - 2);
  if (gap < fmax(20 * usual, 0.05 * whole))
    return 0;
  return lab_check_fail(f, at,
                        "no rows from t = %.6g s to t = %.6g s, where %.3g s apart is usual: the command is assumed to "
                        "hold; if a new test begins there, make it a log of its own",
                        s->t[at - 1], s->t[at], usual);
}

int lab_check_part(const lab_log_view *s, lab_check_result *f)
{
  const lab_view_cells *x = &s->cells[LAB_CHANNEL_X];
  const double stroke = (double)s->rig->params.stroke;
  if (!lab_log_view_predicts(s, LAB_CHANNEL_X) || lab_log_view_span(s, LAB_CHANNEL_X) > 0.5 * stroke)
    return 0;
  return lab_check_fail(f, LAB_NO_ROW, "x covers %s to %s of a stroke of %s: nothing is known of the rest",
                        lab_check_show(f, LAB_CHANNEL_X, x->low), lab_check_show(f, LAB_CHANNEL_X, x->high),
                        lab_check_show(f, LAB_CHANNEL_X, stroke));
}

/* Range of the middle nine tenths of some of the values, as spikes do not make it. */
static double inner_range(const double *y, size_t n)
{
  double some[LAB_VIEW_CELLS];
  const size_t step = n / LAB_VIEW_CELLS + 1;
  size_t i, m = 0;
  for (i = 0; i < n; i += step)
    if (!isnan(y[i]))
      some[m++] = y[i];
  lab_sort(some, m);
  return m > 0 ? some[m - 1 - m / 20] - some[m / 20] : 0;
}

/* What would drive the model, was measured, and does not count. */
int lab_check_unused(const lab_log_view *s, lab_check_result *f)
{
  const pneu_params *p = &s->rig->params;
  const struct {
    int channel;
    double scale;
    const char *instead;
  } drives[] = {{LAB_CHANNEL_PS, (double)p->supply_pressure, "supply pressure"},
                {LAB_CHANNEL_FORCE, (double)(p->supply_pressure * p->area), "external force"}};
  const double share = 0.01;
  size_t i;
  for (i = 0; i < sizeof drives / sizeof drives[0]; i++) {
    const int c = drives[i].channel;
    double range;
    if (!s->y[c] || s->rig->input[c] || s->rig->laws.position_input)
      continue;
    range = inner_range(s->y[c], s->n);
    if (range > share * drives[i].scale)
      return lab_check_fail(
          f, LAB_NO_ROW,
          "%s was measured and varies by %s, but the model takes the %s as declared: inputs = ( \"%s\" ) in "
          "the rig file makes it follow",
          lab_channels[c].key, lab_check_show(f, c, range), drives[i].instead, lab_channels[c].key);
  }
  return 0;
}

/* Whether the stem begins off its lower stop: a chamber without pressure cannot hold it there. */
static int begins_off_stop(const lab_log_view *s)
{
  const double off = 0.05 * (double)s->rig->params.stroke;
  return s->y[LAB_CHANNEL_X] && off > 0 && lab_log_view_value(s->y[LAB_CHANNEL_X], 0, s->n, 0) > off;
}

int lab_check_absolute(const lab_log_view *s, lab_check_result *f)
{
  const double ambient = (double)s->rig->params.ambient_pressure;
  const double start = lab_log_view_value(s->y[LAB_CHANNEL_P], 0, s->n, 0);
  if (s->rig->input[LAB_CHANNEL_P] || s->cells[LAB_CHANNEL_P].low < 0.9 * ambient ||
      fabs(start - ambient) > 0.03 * ambient || begins_off_stop(s))
    return 0;
  return lab_check_fail(
      f, 0,
      "p begins at %s, which is the ambient pressure, and never falls below: if it is absolute, the column "
      "is p_abs",
      lab_check_show(f, LAB_CHANNEL_P, start));
}

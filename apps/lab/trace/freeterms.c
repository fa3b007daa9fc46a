#include "freeterms.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "../base/quantile.h"
#include "../base/format.h"
#include "../check/mend.h"
#include "../fit/normal.h"
#include "../rig/rigterm.h"
#include "decide.h"

/* ---- Places ---- */

/* Where a free term may act, and how finely it is looked at. */
typedef struct place {
  int equation, argument, knots;
} place;

static const place places[] = {
    {PNEU_TERM_FRICTION, PNEU_TERM_OVER_POSITION, 25},      {PNEU_TERM_FORCE, PNEU_TERM_OVER_POSITION, 25},
    {PNEU_TERM_FRICTION, PNEU_TERM_OVER_PRESSURE, 13},      {PNEU_TERM_FORCE, PNEU_TERM_OVER_PRESSURE, 13},
    {PNEU_TERM_FORCE, PNEU_TERM_OVER_VELOCITY, 9},          {PNEU_TERM_FLOW, PNEU_TERM_OVER_PRESSURE, 17},
    {PNEU_TERM_FLOW, PNEU_TERM_OVER_POSITION, 17},          {PNEU_TERM_FLOW, PNEU_TERM_OVER_OPENING, 9},
    {PNEU_TERM_HEAT, PNEU_TERM_OVER_PRESSURE, 9},           {PNEU_TERM_SHOWN_PRESSURE, PNEU_TERM_OVER_PRESSURE, 13},
    {PNEU_TERM_SHOWN_POSITION, PNEU_TERM_OVER_POSITION, 13}};
static const place cyclic[] = {{PNEU_TERM_SUPPLY, PNEU_TERM_OVER_CYCLE, 2}, {PNEU_TERM_FORCE, PNEU_TERM_OVER_CYCLE, 2}};
enum { PLACES = sizeof places / sizeof *places, CYCLIC = sizeof cyclic / sizeof *cyclic };

/* Largest pressure and speed that the logs show. */
static void ranges(const lab_unknowns *u, double *pressure, double *speed)
{
  const double stroke = (double)u->rig.params.stroke;
  int e;
  size_t i;
  *pressure = (double)u->rig.params.supply_pressure;
  *speed = 0;
  for (e = 0; e < u->n_runs; e++) {
    const lab_run *x = &u->run[e];
    const double *p = x->log->value[LAB_CHANNEL_P], *at = x->log->value[LAB_CHANNEL_X],
                 *t = x->log->value[LAB_CHANNEL_TIME];
    for (i = 0; p && i < x->n; i++)
      *pressure = fmax(*pressure, p[x->first + i]);
    for (i = 32; at && i < x->n; i += 16) /* over 32 rows, so that noise and stick-slip do not count */
      *speed = fmax(*speed, fabs(at[x->first + i] - at[x->first + i - 32]) / (t[x->first + i] - t[x->first + i - 32]));
  }
  if (!(*speed > 0))
    *speed = stroke > 0 ? stroke : 1;
}

/* Flow [kg/s] through the open fill orifice into an empty chamber. */
static double choked_flow(const lab_unknowns *u)
{
  const pneu_params *p = &u->rig.params;
  lab_error ignored;
  pneu_model model;
  if (lab_rig_model(&u->rig, &model, &ignored))
    return 0;
  return (double)(p->fill_area * (p->supply_pressure + p->ambient_pressure) * model.choked_gain) /
         sqrt((double)p->supply_temperature);
}

/* A term at a place, before it is scored.  In: period  [s] of a cycle */
static lab_term_score at_place(const lab_unknowns *u, const place *where, double period)
{
  const pneu_params *p = &u->rig.params;
  const double force = fmax((double)p->dry_friction, 1e-3 * (double)(p->area * p->supply_pressure));
  const double flow = 0.04 * choked_flow(u);
  /* values that matter: shares of the largest there are */
  const double scales[PNEU_TERM_EQUATION_COUNT] = {
      1e-2 * (double)p->supply_pressure, force, force, flow, 1, 1e-3 * (double)p->supply_pressure,
      1e-3 * (double)p->stroke};
  double reach[PNEU_TERM_ARGUMENT_COUNT], pressure, speed;
  lab_term_score s;
  memset(&s, 0, sizeof s);
  ranges(u, &pressure, &speed);
  reach[PNEU_TERM_OVER_POSITION] = (double)p->stroke;
  reach[PNEU_TERM_OVER_PRESSURE] = pressure;
  reach[PNEU_TERM_OVER_VELOCITY] = speed;
  reach[PNEU_TERM_OVER_OPENING] = 1;
  reach[PNEU_TERM_OVER_CYCLE] = period;
  s.term.equation = where->equation;
  s.term.argument = where->argument;
  s.term.n = where->knots;
  s.term.to = (pneu_real)reach[where->argument];
  if (where->argument == PNEU_TERM_OVER_VELOCITY || where->argument == PNEU_TERM_OVER_OPENING)
    s.term.from = -s.term.to;
  s.scale = scales[where->equation];
  return s;
}

/* ---- Scores ---- */

static double surplus(const lab_term_score *s)
{
  return s->statistic - s->degrees;
}

static int by_surplus(const void *a, const void *b)
{
  const double x = surplus(a), y = surplus(b);
  return x < y ? 1 : x > y ? -1 : 0;
}

/* The model with a value at one knot of the term, or in one amplitude; `share` of the usual. */
static void add_knot(const lab_unknowns *u, const lab_term_score *s, int knot, double share, lab_rig *model)
{
  pneu_term *term;
  *model = u->rig;
  term = &model->term[model->n_terms++];
  *term = s->term;
  term->value[knot] = (pneu_real)(share * lab_constant(LAB_KNOT_STEP) * s->scale);
}

/* The slope in one of them. */
static int slope_of_knot(const lab_projection *p, const lab_term_score *s, int knot, double *slope, lab_error *error)
{
  lab_rig model;
  add_knot(p->u, s, knot, 1, &model);
  return lab_projection_slope(p, &model, slope, error);
}

/* Slopes in all knots from one run of each experiment.  Out: columns, done */
static int slopes_together(const lab_projection *p, const lab_term_score *s, double *columns, char *done,
                           lab_error *error)
{
  static const double share = 1e-3; /* lest a knot pass an edge where rates change at once */
  const size_t n = (size_t)s->term.n;
  lab_rig *model = malloc(n * sizeof *model);
  size_t k;
  int i, status = model ? LAB_OK : lab_fail_memory(error, "the slopes of a free term");
  for (i = 0; i < s->term.n && status == LAB_OK; i++)
    add_knot(p->u, s, i, share, &model[i]);
  if (status == LAB_OK)
    status = lab_unknowns_changes_with(p->u, model, s->term.n, columns, done, error);
  for (k = 0; k < n * p->m && status == LAB_OK; k++)
    columns[k] = done[k / p->m] ? columns[k] / share : 0;
  free(model);
  return status;
}

/* Project the residual on the span of the knots' slopes. */
static void score_knots(const lab_projection *p, lab_term_score *s, lab_error *all)
{
  double *columns = malloc((size_t)s->term.n * p->m * sizeof *columns);
  char done[PNEU_TERM_ROOM] = {0};
  lab_error error;
  size_t k;
  int i, status = columns ? LAB_OK : lab_fail_memory(&error, "the slopes of a free term");
  if (status == LAB_OK)
    status = slopes_together(p, s, columns, done, &error);
  if (status != LAB_OK)
    lab_fail_together(all, &error);
  for (i = 0; i < s->term.n && status == LAB_OK; i++) {
    double *column = columns + (size_t)i * p->m, *to = columns + (size_t)s->degrees * p->m, whole, left, along;
    if (!done[i] && slope_of_knot(p, s, i, column, &error)) {
      lab_fail_together(all, &error);
      continue;
    }
    whole = sqrt(lab_dot(column, column, p->m));
    left = lab_project_out(p->basis, p->n_basis, p->m, p->m, column);
    left = fmin(left, lab_project_out(columns, s->degrees, p->m, p->m, column));
    if (!(left > lab_constant(LAB_KNOT_ABSORBED) * whole && whole > lab_constant(LAB_KNOT_SEEN)))
      continue;
    for (k = 0; k < p->m; k++)
      to[k] = column[k] / left;
    along = lab_dot(to, p->r, p->m);
    s->statistic += along * along;
    s->degrees++;
  }
  free(columns);
}

/* Statistic of the two amplitudes of a cycle, and the amplitudes themselves. */
static void score_cycle(const lab_projection *p, lab_term_score *s, lab_error *all)
{
  double *column[2] = {malloc(p->m * sizeof(double)), malloc(p->m * sizeof(double))};
  const double step = lab_constant(LAB_KNOT_STEP) * s->scale;
  double gram[4], along[2], size[2];
  lab_error error = {LAB_OK, ""};
  int i, good = column[0] && column[1];
  if (!good)
    lab_fail_memory(&error, "the slopes of a cycle");
  for (i = 0; good && i < 2; i++)
    good = slope_of_knot(p, s, i, column[i], &error) == LAB_OK && lab_projection_visible(p, column[i]) > 0;
  for (i = 0; good && i < 4; i++)
    gram[i] = lab_dot(column[i / 2], column[i % 2], p->m);
  for (i = 0; good && i < 2; i++)
    size[i] = along[i] = -lab_dot(column[i], p->r, p->m);
  if (good && lab_solve_positive(2, 2, gram, size) == 0) {
    s->degrees = 3; /* the period is one */
    s->statistic = size[0] * along[0] + size[1] * along[1];
    for (i = 0; i < 2; i++)
      s->term.value[i] = (pneu_real)(size[i] * step);
  }
  lab_fail_together(all, &error);
  free(column[0]);
  free(column[1]);
}

/* The best few cycles in each equation.  In/out: n  entries of score */
static void score_cycles(const lab_projection *p, lab_term_score *score, int *n, lab_error *error)
{
  lab_term_score all[CYCLIC * LAB_PERIODS_MAX];
  double period[LAB_PERIODS_MAX];
  int i, k, found;
  if (lab_residual_periods(p->u, p->r, period, &found, error))
    return;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < CYCLIC * found; i++) {
    all[i] = at_place(p->u, &cyclic[i / found], period[i % found]);
    score_cycle(p, &all[i], error);
  }
  for (k = 0; k < CYCLIC; k++) {
    lab_term_score *mine = &all[k * found];
    qsort(mine, (size_t)found, sizeof *mine, by_surplus);
    for (i = 0; i < found && i < lab_count(LAB_CYCLES_EACH) && mine[i].degrees > 0; i++)
      score[(*n)++] = mine[i];
  }
}

/* Whether a term may act at a place: a vessel has no stem, and every knot needs its rows. */
static int has_place(const lab_unknowns *u, const place *where, int vessel)
{
  return !(where->knots * lab_constant(LAB_KNOT_ROWS) > (double)u->n_rows) &&
         (!vessel || where->argument == PNEU_TERM_OVER_PRESSURE || where->argument == PNEU_TERM_OVER_OPENING);
}

int lab_score_free_terms(const lab_projection *p, lab_term_score score[LAB_TERM_SCORES_MAX], int *n, lab_error *error)
{
  const int vessel = !(p->u->rig.params.stroke > 0);
  int i;
  *n = 0;
  error->status = LAB_OK;
  if (p->u->rig.n_terms == LAB_TERM_MAX)
    return LAB_OK;
  for (i = 0; i < PLACES; i++)
    if (has_place(p->u, &places[i], vessel))
      score[(*n)++] = at_place(p->u, &places[i], 0);
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < *n; i++)
    score_knots(p, &score[i], error);
  if (error->status == LAB_OK && !vessel && p->u->window == 0)
    score_cycles(p, score, n, error);
  qsort(score, (size_t)*n, sizeof *score, by_surplus);
  return error->status;
}

double lab_free_term_p_value(const pneu_term *term, double statistic, int degrees)
{
  const double tests = term->argument == PNEU_TERM_OVER_CYCLE ? lab_constant(LAB_CYCLE_TESTS) : 1;
  return fmin(1, tests * lab_chi2_tail(statistic, degrees));
}

/* ---- Periods of a residual ---- */

static const double two_pi = 6.283185307179586;
enum { CELLS = 2048, OVERSAMPLED = 4, AROUND = 48 };

/* Lines at equal distances in frequency, f = (first + i) step. */
typedef struct spectrum {
  size_t n, first;
  double step;
  double *power;  /* of one channel */
  double *height; /* of the channel that stands out most */
} spectrum;

static double length_of(const lab_run *x)
{
  const double *t = x->log->value[LAB_CHANNEL_TIME] + x->first;
  return t[x->n - 1] - t[0];
}

/* Means of the residual over cells of equal duration.  Returns: their number. */
static size_t fill_cells(const lab_run *x, const double *r, double cell[CELLS])
{
  const double *t = x->log->value[LAB_CHANNEL_TIME] + x->first;
  const size_t n = x->n < CELLS ? x->n : CELLS;
  unsigned count[CELLS] = {0};
  size_t i, k;
  memset(cell, 0, n * sizeof *cell);
  for (i = 0; i < x->n; i++) {
    k = (size_t)((double)n * (t[i] - t[0]) / (t[x->n - 1] - t[0]));
    k = k < n ? k : n - 1;
    cell[k] += r[i];
    count[k]++;
  }
  for (k = 0; k < n; k++)
    cell[k] /= count[k] ? count[k] : 1;
  return n;
}

/* Add the power of one channel of one log. */
static void add_power(const spectrum *s, const lab_run *x, const double *r)
{
  double cell[CELLS];
  const size_t n = fill_cells(x, r, cell);
  const double spacing = length_of(x) / (double)n;
  size_t i, k;
  for (i = 0; i < s->n; i++) {
    const double angle = two_pi * (double)(s->first + i) * s->step * spacing, c1 = cos(angle), s1 = sin(angle);
    double c = 1, sine = 0, re = 0, im = 0;
    for (k = 0; k < n; k++) {
      const double next = c * c1 - sine * s1;
      re += cell[k] * c;
      im += cell[k] * sine;
      sine = sine * c1 + c * s1;
      c = next;
    }
    s->power[i] += (re * re + im * im) / (double)n;
  }
}

/* Power over the median of its surroundings. */
static double prominence(const spectrum *s, size_t i)
{
  double around[2 * AROUND + 1];
  const size_t from = i > AROUND ? i - AROUND : 0, to = i + AROUND < s->n ? i + AROUND : s->n - 1;
  memcpy(around, s->power + from, (to - from + 1) * sizeof *around);
  lab_sort(around, to - from + 1);
  return s->power[i] / (around[(to - from) / 2] + 1);
}

/* Keep the highest peaks, in order. */
static void keep(double period[LAB_PERIODS_MAX], double rank[LAB_PERIODS_MAX], int *n, double candidate, double value)
{
  int i;
  if (*n == LAB_PERIODS_MAX && rank[*n - 1] >= value)
    return;
  for (i = *n < LAB_PERIODS_MAX ? (*n)++ : *n - 1; i > 0 && rank[i - 1] < value; i--) {
    rank[i] = rank[i - 1];
    period[i] = period[i - 1];
  }
  rank[i] = value;
  period[i] = candidate;
}

/* Lines that every log resolves. */
static int lay_out(const lab_unknowns *u, spectrum *s, lab_error *error)
{
  double longest = 0, fastest = INFINITY, last;
  int e;
  for (e = 0; e < u->n_runs; e++) {
    const lab_run *x = &u->run[e];
    const double length = length_of(x), cells = (double)(x->n < CELLS ? x->n : CELLS);
    longest = fmax(longest, length);
    fastest = fmin(fastest, cells / (lab_constant(LAB_CYCLE_ROWS) * length));
  }
  s->step = 1 / (OVERSAMPLED * longest);
  s->first = OVERSAMPLED * (size_t)lab_count(LAB_CYCLES_SHORTEST);
  last = fastest / s->step;
  s->n = last > (double)s->first ? (size_t)last - s->first + 1 : 0;
  s->power = calloc(s->n + 1, sizeof *s->power);
  s->height = calloc(s->n + 1, sizeof *s->height);
  return s->power && s->height ? LAB_OK : lab_fail_memory(error, "the spectrum of a residual");
}

/* See how far the lines of one channel stand out. */
static void look_at_channel(const lab_unknowns *u, const double *r, int channel, spectrum *s)
{
  size_t i;
  int e, c;
  memset(s->power, 0, s->n * sizeof *s->power);
  for (e = 0; e < u->n_runs; e++) {
    const lab_run *x = &u->run[e];
    for (c = 0; c < x->n_channels; c++, r += x->n)
      if (x->channel[c] == channel && length_of(x) > 0)
        add_power(s, x, r);
  }
  for (i = 0; i < s->n; i++)
    s->height[i] = fmax(s->height[i], prominence(s, i));
}

/* Whether some run makes a line of a hum. */
static int may_be_hum(const lab_unknowns *u, double f)
{
  int e, any = 0;
  for (e = 0; e < u->n_runs; e++)
    any |= lab_may_be_hum(f, (double)(u->run[e].n - 1) / length_of(&u->run[e]));
  return any;
}

int lab_residual_periods(const lab_unknowns *u, const double *r, double *period, int *n, lab_error *error)
{
  double rank[LAB_PERIODS_MAX];
  spectrum s;
  size_t i;
  const int status = lay_out(u, &s, error);
  int channel;
  *n = 0;
  if (status == LAB_OK && s.n > 2) {
    for (channel = 0; channel < LAB_CHANNEL_COUNT; channel++)
      look_at_channel(u, r, channel, &s);
    for (i = 1; i + 1 < s.n; i++)
      if (s.height[i] > lab_constant(LAB_CYCLE_CLEAR) && s.height[i] > s.height[i - 1] &&
          s.height[i] >= s.height[i + 1] && !may_be_hum(u, (double)(s.first + i) * s.step))
        keep(period, rank, n, 1 / ((double)(s.first + i) * s.step), s.height[i]);
  }
  free(s.power);
  free(s.height);
  return status;
}

/* ---- Where a term acts ---- */

static int ends_at_zero(const pneu_term *term)
{
  return term->value[0] == 0 && term->value[term->n - 1] == 0;
}

/* Knots first..end-1 that count. A fit that finds anything leaves no knot at exactly 0: at one end alone, such knots
 * lie where no log has been. At both ends they are held there; and more than half of them are the level. */
static void knots_reached(const pneu_term *term, int *first, int *end)
{
  int low = 0, high = term->n;
  while (low < high && term->value[low] == 0)
    low++;
  while (high > low && term->value[high - 1] == 0)
    high--;
  if (ends_at_zero(term) || high - low < term->n / 2 + 1) {
    low = 0;
    high = term->n;
  }
  *first = low;
  *end = high;
}

/* The median of n values; of an even number the upper one of the two in the middle. */
static double median(const pneu_real *from, int n)
{
  double value[PNEU_TERM_ROOM];
  int i;
  for (i = 0; i < n; i++)
    value[i] = (double)from[i];
  lab_sort(value, (size_t)n);
  return value[n / 2];
}

/* Largest amplitude of a cycle. */
static double amplitude(const pneu_term *term)
{
  double most = 0;
  int i;
  for (i = 0; i + 1 < term->n; i += 2)
    most = fmax(most, hypot((double)term->value[i], (double)term->value[i + 1]));
  return most;
}

int lab_free_term_stretch(const pneu_term *term, double *from, double *to, double *level, double *peak)
{
  const double knot = (double)(term->to - term->from) / (term->n - 1);
  double beside;
  int i, begin, end, first = -1, last = -1;
  *from = (double)term->from;
  *to = (double)term->to;
  *level = 0;
  *peak = 0;
  if (term->argument == PNEU_TERM_OVER_CYCLE) {
    *peak = amplitude(term);
    return 0;
  }
  knots_reached(term, &begin, &end);
  if (!ends_at_zero(term))
    *level = median(term->value + begin, end - begin);
  for (i = begin; i < end; i++)
    if (fabs((double)term->value[i] - *level) > fabs(*peak))
      *peak = (double)term->value[i] - *level;
  for (i = begin; i < end; i++)
    if (fabs((double)term->value[i] - *level) > lab_constant(LAB_TERM_ACTIVE) * fabs(*peak)) {
      first = first < 0 ? i : first;
      last = i;
    }
  beside = first >= 0 && first == last ? 0.5 : 0; /* one knot alone fades towards its neighbours */
  *to = *from + knot * fmin(fmax(last, 0) + beside, end - 1);
  *from += knot * fmax(first - beside, begin);
  return last - first < (end - begin) / 2;
}

/* ---- In words ---- */

static const struct {
  const char *equation, *what, *both;
} kinds[PNEU_TERM_EQUATION_COUNT] = {{"mass", "a change of the supply pressure", ""},
                                     {"force", "a force on the stem", ""},
                                     {"force", "dry friction", ", both directions"},
                                     {"mass", "a flow into or out of the chamber", ""},
                                     {"energy", "heat into the gas", ""},
                                     {"sensor", "an error of the pressure sensor", ""},
                                     {"sensor", "an error of the position sensor", ""}};

const char *lab_free_term_equation(const pneu_term *term)
{
  return kinds[term->equation].equation;
}

const char *lab_free_term_what(const pneu_term *term)
{
  return kinds[term->equation].what;
}

/* In seconds however short: beside a frequency, a factor of 1000 would only disturb. */
static void say_cycle(const pneu_term *term, char text[LAB_WHERE_TEXT])
{
  const double period = (double)(term->to - term->from);
  char seconds[LAB_FORMAT_TEXT], hertz[LAB_FORMAT_TEXT], most[LAB_FORMAT_TEXT];
  snprintf(text, LAB_WHERE_TEXT, "periodically, every %s s (%s Hz); amplitude %s",
           lab_format_number(period, 3, seconds), lab_format_number(1 / period, 3, hertz),
           lab_format_quantity(amplitude(term), lab_term_equations[term->equation].unit, 3, most));
}

static void say_stretch(const pneu_term *term, char text[LAB_WHERE_TEXT])
{
  const lab_term_word *argument = &lab_term_arguments[term->argument], *equation = &lab_term_equations[term->equation];
  const lab_format how = lab_format_as(argument->unit);
  char low[LAB_FORMAT_TEXT], high[LAB_FORMAT_TEXT], most[LAB_FORMAT_TEXT];
  double from, to, level, peak;
  const int is_short = lab_free_term_stretch(term, &from, &to, &level, &peak);
  snprintf(text, LAB_WHERE_TEXT, "%s%s = %s .. %s%s%s%s; largest value %s",
           is_short || ends_at_zero(term) ? "" : "nearly everywhere, ", argument->key,
           lab_format_number(how.scale * from, 3, low), lab_format_number(how.scale * to, 3, high),
           *how.unit ? " " : "", how.unit, kinds[term->equation].both,
           lab_format_quantity(peak, equation->unit, 3, most));
}

const char *lab_free_term_where(const pneu_term *term, char text[LAB_WHERE_TEXT])
{
  (term->argument == PNEU_TERM_OVER_CYCLE ? say_cycle : say_stretch)(term, text);
  return text;
}

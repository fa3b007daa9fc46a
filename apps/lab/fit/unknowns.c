#include "unknowns.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../rig/tolerance.h"

static const double two_pi = 6.283185307179586;
static const double uniform_spread = 0.28867513459481287; /* standard deviation of a uniform distribution of width 1 */
static const double knot_spread = 20;                     /* of a knot about 0: it must not run away unseen */

static lab_unknown *append(lab_unknowns *u)
{
  lab_unknown *x = u->n < LAB_FIT_MAX ? &u->unknown[u->n++] : NULL;
  if (x) {
    memset(x, 0, sizeof *x);
    x->run = LAB_ALL_RUNS;
  }
  return x;
}

static int no_room(lab_error *error)
{
  return lab_fail(error, LAB_DATA, "more than %d things to fit at once", (int)LAB_FIT_MAX);
}

static void describe_param(lab_unknown *x, int param)
{
  const pneu_param_info info = lab_param_info(param);
  x->kind = LAB_UNKNOWN_PARAM;
  x->index = param;
  lab_fit_name(param, x->name);
  snprintf(x->unit, sizeof x->unit, "%s", info.unit);
  x->lower = (double)info.lower;
  x->upper = (double)info.upper;
  x->scale = param == LAB_PARAM_ORIFICE_AREA
                 ? 1
                 : fabs((double)info.value - (param < PNEU_PARAM_BASE_COUNT || info.shape ? 0 : (double)info.neutral));
}

int lab_unknown_rests(const lab_unknown *x)
{
  return x->lower == x->upper;
}

int lab_unknown_is_absent(const lab_unknown *x)
{
  return lab_unknown_rests(x) && !lab_param_info(x->index).shape;
}

int lab_unknown_is_known(const lab_unknown *x)
{
  return x->spread > 0 && ((x->kind == LAB_UNKNOWN_PARAM && x->run == LAB_ALL_RUNS) || x->kind == LAB_UNKNOWN_INSTANT);
}

int lab_unknown_is_held(const lab_unknown *x)
{
  return x->tolerance > 0 && x->spread > 0;
}

int lab_unknown_differs(const lab_unknown *x)
{
  return x->kind == LAB_UNKNOWN_PARAM && x->run != LAB_ALL_RUNS && x->spread > 0;
}

double lab_unknown_reach(const lab_unknowns *u, const lab_unknown *x)
{
  return lab_unknown_is_held(x)   ? x->spread / u->misfit
         : lab_unknown_differs(x) ? x->spread / u->own_misfit
                                  : x->spread;
}

int lab_param_is_value(int param)
{
  return param < PNEU_PARAM_BASE_COUNT || param == LAB_PARAM_ORIFICE_AREA;
}

/* So many tolerances about the declared value; no ends where there is none. */
static void find_ends(const lab_unknowns *u, int param, double tolerances, double *lower, double *upper)
{
  lab_rig declared = u->rig;
  double value, room;
  declared.params = u->declared;
  value = lab_param_value(&declared, param);
  room = lab_param_is_value(param) ? tolerances * lab_tolerance(&declared, param) : 0;
  *lower = room > 0 ? value - room : -(double)INFINITY;
  *upper = room > 0 ? value + room : (double)INFINITY;
}

int lab_unknown_is_far(const lab_unknowns *u, int j, double tolerances)
{
  const lab_unknown *x = &u->unknown[j];
  double lower, upper;
  if (x->kind != LAB_UNKNOWN_PARAM)
    return 0;
  find_ends(u, x->index, tolerances, &lower, &upper);
  return x->value <= lower || x->value >= upper;
}

int lab_unknowns_is_far(const lab_unknowns *u, double tolerances)
{
  int j, any = 0;
  for (j = 0; j < u->n; j++)
    any |= lab_unknown_is_far(u, j, tolerances);
  return any;
}

/* The bounds of an unknown, by what its value may be at most. */
static void limit(const lab_unknowns *u, lab_unknown *x)
{
  double lower, upper;
  find_ends(u, x->index, u->most_off, &lower, &upper);
  x->lower = fmax(x->lower, lower);
  x->upper = fmin(x->upper, upper);
  x->value = fmin(fmax(x->value, x->lower), x->upper);
}

void lab_unknowns_stay_near(lab_unknowns *u, double tolerances)
{
  int j;
  u->most_off = tolerances;
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].kind == LAB_UNKNOWN_PARAM)
      limit(u, &u->unknown[j]);
  lab_unknowns_take(u);
}

/* A stem without damping oscillates for long after each move, which no valve does, and takes a hundred times as long to
 * simulate: damping stays above a share of what is declared. A positioner that opens fully at any error does so too:
 * its gain stays below a multiple. Both by judgement. */
static void keep_usual(const lab_unknowns *u, lab_unknown *x)
{
  static const double least = 0.02, most = 10;
  pneu_params declared = u->declared;
  if (x->index == PNEU_PARAM_damping)
    x->lower = fmax(x->lower, least * (double)u->declared.damping);
  if (x->index == pneu_param_find("positioner.gain"))
    x->upper = fmin(x->upper, most * (double)*pneu_param_at(&declared, x->index));
}

int lab_unknowns_leave_damping(lab_unknowns *u)
{
  static const double hardly = 0.3; /* of what is declared, by judgement */
  const int j = lab_unknowns_find(u, PNEU_PARAM_damping);
  int e, follows = 0;
  for (e = 0; e < u->n_runs; e++)
    follows |= lab_log_command(u->run[e].log) == LAB_CHANNEL_SP;
  if (j < 0 || !follows || u->unknown[j].value > hardly * (double)u->declared.damping)
    return 0;
  lab_unknowns_drop(u, PNEU_PARAM_damping);
  u->rig.params.damping = u->declared.damping;
  lab_unknowns_undo_fit(u); /* the others were fitted beside it */
  lab_unknowns_count(u);
  return 1;
}

int lab_unknowns_add(lab_unknowns *u, int param, double value, lab_error *error)
{
  const int held = lab_unknowns_find(u, param);
  lab_unknown *x = held >= 0 && u->unknown[held].tolerance > 0 ? &u->unknown[held] : append(u);
  if (!x)
    return no_room(error);
  x->spread = 0;
  describe_param(x, param);
  keep_usual(u, x);
  if (u->most_off > 0)
    limit(u, x);
  x->value = x->first = fmin(fmax(value, x->lower), x->upper);
  if (param < PNEU_PARAM_BASE_COUNT && x->value != 0)
    x->scale = fabs(x->value);
  if (param != LAB_PARAM_ORIFICE_AREA)
    *pneu_param_at(&u->rig.params, param) = (pneu_real)x->value;
  return LAB_OK;
}

int lab_unknowns_add_change(lab_unknowns *u, int param, int run, double spread, lab_error *error)
{
  lab_unknown *x = append(u);
  double now;
  if (!x)
    return no_room(error);
  describe_param(x, param);
  now = lab_param_value(&u->rig, param);
  x->kind = LAB_UNKNOWN_CHANGE;
  x->run = run;
  x->from = -HUGE_VAL;
  x->to = HUGE_VAL;
  x->lower -= now;
  x->upper -= now;
  if (spread > 0)
    x->scale = 100 * spread; /* whose thousandth is a step that shows beside the stepper's error */
  else if (param < PNEU_PARAM_BASE_COUNT && now != 0)
    x->scale = fabs(now);
  x->spread = spread;
  return LAB_OK;
}

static double longest_log(const lab_unknowns *u)
{
  double longest = 0;
  int e;
  for (e = 0; e < u->n_runs; e++) {
    const double *t = u->run[e].log->value[LAB_CHANNEL_TIME] + u->run[e].first;
    longest = fmax(longest, t[u->run[e].n - 1] - t[0]);
  }
  return longest;
}

/* The period of the last free term. What matters is what turns the phase at the end of the longest log by a radian. */
static void add_period(lab_unknowns *u)
{
  const pneu_term *term = &u->rig.term[u->rig.n_terms];
  const double period = (double)(term->to - term->from);
  lab_unknown *x = append(u);
  x->kind = LAB_UNKNOWN_PERIOD;
  x->term = u->rig.n_terms;
  snprintf(x->name, sizeof x->name, "unlisted_%d.period", x->term + 1);
  snprintf(x->unit, sizeof x->unit, "s");
  x->value = x->first = period;
  x->lower = period / 2;
  x->upper = period * 2;
  x->scale = period * period / (two_pi * fmax(longest_log(u), period));
}

int lab_unknowns_add_term(lab_unknowns *u, const pneu_term *term, double scale, int held, lab_error *error)
{
  const int cycles = term->argument == PNEU_TERM_OVER_CYCLE;
  int i;
  if (u->rig.n_terms == LAB_TERM_MAX || u->n + term->n + cycles > LAB_FIT_MAX)
    return no_room(error);
  u->rig.term[u->rig.n_terms] = *term;
  for (i = held; i < term->n - held; i++) {
    lab_unknown *x = append(u);
    x->kind = LAB_UNKNOWN_KNOT;
    x->term = u->rig.n_terms;
    x->index = i;
    snprintf(x->name, sizeof x->name, "unlisted_%d.%d", x->term + 1, i + 1);
    x->value = x->first = (double)term->value[i];
    x->lower = -1e3 * scale;
    x->upper = 1e3 * scale;
    x->scale = scale;
    x->spread = knot_spread * scale;
  }
  if (cycles)
    add_period(u);
  u->rig.n_terms++;
  return LAB_OK;
}

int lab_unknowns_add_onset(lab_unknowns *u, int param, double from, double value, lab_error *error)
{
  lab_unknown *x = u->rig.n_onsets < LAB_ONSETS_MAX ? append(u) : NULL;
  const size_t room = sizeof x->name - sizeof " later";
  if (!x)
    return no_room(error);
  describe_param(x, param);
  x->name[strlen(x->name) < room ? strlen(x->name) : room] = '\0';
  strcat(x->name, " later");
  x->kind = LAB_UNKNOWN_ONSET;
  x->index = u->rig.n_onsets;
  x->value = x->first = fmin(fmax(value, x->lower), x->upper);
  if (param < PNEU_PARAM_BASE_COUNT && x->value != 0)
    x->scale = fabs(x->value);
  u->rig.onset[u->rig.n_onsets++] = (lab_rig_onset){param, from, x->value};
  return LAB_OK;
}

/* A slope is taken over a thousandth of the scale: a row. */
int lab_unknowns_add_since(lab_unknowns *u, lab_error *error)
{
  const double *t = u->run[0].log->value[LAB_CHANNEL_TIME] + u->run[0].first;
  const size_t rows = u->run[0].n;
  lab_unknown *x = append(u);
  if (!x)
    return no_room(error);
  x->kind = LAB_UNKNOWN_SINCE;
  x->index = u->rig.n_onsets - 1;
  snprintf(x->name, sizeof x->name, "onset");
  snprintf(x->unit, sizeof x->unit, "s");
  x->value = x->first = u->rig.onset[x->index].from;
  x->lower = t[0];
  x->upper = t[rows - 1];
  x->scale = 1000 * (t[rows - 1] - t[0]) / (double)rows;
  return LAB_OK;
}

/* Drop the unknowns of one kind that belong to the last onset. */
static void drop_of_onset(lab_unknowns *u, int kind)
{
  int j, k;
  for (j = k = 0; j < u->n; j++)
    if (u->unknown[j].kind != kind || u->unknown[j].index != u->rig.n_onsets - 1)
      u->unknown[k++] = u->unknown[j];
  u->n = k;
}

void lab_unknowns_drop_since(lab_unknowns *u)
{
  drop_of_onset(u, LAB_UNKNOWN_SINCE);
}

void lab_unknowns_drop_onset(lab_unknowns *u)
{
  drop_of_onset(u, LAB_UNKNOWN_ONSET);
  u->rig.n_onsets--;
}

int lab_unknowns_find_onset(const lab_unknowns *u, int param)
{
  int j = u->n;
  while (--j >= 0 && (u->unknown[j].kind != LAB_UNKNOWN_ONSET || u->rig.onset[u->unknown[j].index].param != param))
    ;
  return j;
}

void lab_unknowns_drop(lab_unknowns *u, int param)
{
  const pneu_param_info info = lab_param_info(param);
  int j = lab_unknowns_find(u, param);
  if (j >= 0 && u->unknown[j].tolerance > 0) {
    u->unknown[j].spread = u->unknown[j].scale = u->unknown[j].tolerance;
    u->unknown[j].value = u->unknown[j].first = u->unknown[j].prior;
    *pneu_param_at(&u->rig.params, param) = (pneu_real)u->unknown[j].prior;
    return;
  }
  if (j >= 0)
    for (u->n--; j < u->n; j++)
      u->unknown[j] = u->unknown[j + 1];
  *pneu_param_at(&u->rig.params, param) = info.neutral;
}

static int is_of_term(const lab_unknown *x, int term)
{
  return (x->kind == LAB_UNKNOWN_KNOT || x->kind == LAB_UNKNOWN_PERIOD) && x->term == term;
}

void lab_unknowns_drop_term(lab_unknowns *u)
{
  int j, k;
  u->rig.n_terms--;
  for (j = k = 0; j < u->n; j++)
    if (!is_of_term(&u->unknown[j], u->rig.n_terms))
      u->unknown[k++] = u->unknown[j];
  u->n = k;
}

int lab_unknowns_find(const lab_unknowns *u, int param)
{
  int j;
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].kind == LAB_UNKNOWN_PARAM && u->unknown[j].index == param)
      return j;
  return -1;
}

/* Room for three effects with their shapes, or a free term. */
enum { SWITCHES_END = LAB_FIT_MAX - 40 };

static const double jump = 0.3; /* of the command: what half a row of it moves is far more than noise */

/* A change of command has an instant of its own where so many rows and more tell of each; of many changes more rows,
 * for as many are a controller's, which come at its rows: 173 in 2,001. By judgement. */
enum { ROWS_A_SWITCH = 10, MANY_SWITCHES = 100, ROWS_EACH_OF_MANY = 20 };

/* A change of command happened between the row before and the row that shows it: half the width, give or take what a
 * uniform distribution has. */
static void add_switch(lab_unknowns *u, int e, int index, double width, const char *unit)
{
  lab_unknown *x = append(u);
  x->kind = LAB_UNKNOWN_INSTANT;
  x->index = index;
  x->run = e;
  snprintf(x->name, sizeof x->name, "switch_%d.%d", e + 1, index + 1);
  snprintf(x->unit, sizeof x->unit, "%s", unit);
  x->value = x->first = x->prior = width / 2;
  x->upper = width;
  x->scale = width;
  x->spread = uniform_spread * width;
}

/* Whether a change of the command is a jump, of which a positioner makes one when its set position does. */
static int is_jump(const lab_run *x, size_t k)
{
  const lab_schedule *s = &x->inputs.schedule;
  const pneu_input before = lab_input_after(&s->input[k], s->t[k + 1] - s->t[k]);
  return fabs((double)(s->input[k + 1].u - before.u)) > jump;
}

/* Changes whose instant is not known; of these, if asked for, the jumps. */
static size_t count_bracketed(const lab_run *x, int jumps)
{
  size_t k, n = 0;
  for (k = 0; k < x->n_instants; k++)
    n += (size_t)(x->bracket[k] > 0 && (!jumps || is_jump(x, k)));
  return n;
}

/* Whether there are rows enough to tell n instants, and room for them. */
static int are_few(const lab_unknowns *u, const lab_run *x, size_t n)
{
  return n * (n > MANY_SWITCHES ? ROWS_EACH_OF_MANY : ROWS_A_SWITCH) <= x->n && (size_t)u->n + n <= SWITCHES_END;
}

/* The timing of the command in one experiment: an instant for each change where these are few beside the rows that tell
 * of them; else one share of the row for all of them but the jumps. */
static void add_switches(lab_unknowns *u, int e)
{
  const lab_run *x = &u->run[e];
  const size_t n = count_bracketed(x, 0), jumps = count_bracketed(x, 1);
  const int few = are_few(u, x, n);
  size_t k;
  if (x->on_rows)
    return;
  if (!few && u->n < SWITCHES_END)
    add_switch(u, e, LAB_ALL_INSTANTS, 1, "1");
  for (k = 0; k < x->n_instants && (few || are_few(u, x, jumps)); k++)
    if (x->bracket[k] > 0 && (few || is_jump(x, k)))
      add_switch(u, e, (int)k, x->bracket[k], "s");
}

int lab_unknowns_are_at_rows(const lab_unknowns *u)
{
  static const double of_any = 1.2; /* 1.4 and 1.6 in two logs of one row a second that a controller made */
  double sum = 0;
  int j, n = 0;
  for (j = 0; j < u->n; j++) {
    const lab_unknown *x = &u->unknown[j];
    if (x->kind != LAB_UNKNOWN_INSTANT)
      continue;
    n++;
    if (x->value > x->prior)
      continue;
    sum += (x->value - x->prior) * (x->value - x->prior) / (x->spread * x->spread);
  }
  return sum > of_any * n;
}

/* Whether a parameter says nothing of an experiment: a positioner's integral where it is not in the loop. */
static int is_of_no_part(const lab_run *run, int param)
{
  return param == pneu_param_find("positioner.integral_start") && lab_log_command(run->log) != LAB_CHANNEL_SP;
}

/* A parameter that each experiment has for itself, from one on. Where the rig file gives it a tolerance it is known to
 * that, in each. */
static int add_per_log(lab_unknowns *u, const lab_rig *rig, int param, int first, lab_error *error)
{
  const double tolerance = rig->tolerance[param];
  int e;
  for (e = first; e < u->n_runs; e++) {
    char name[LAB_PARAM_NAME_TEXT];
    lab_unknown *x;
    if (is_of_no_part(&u->run[e], param))
      continue;
    if (lab_unknowns_add(u, param, lab_param_value(rig, param), error))
      return error->status;
    x = &u->unknown[u->n - 1];
    x->run = e;
    if (tolerance > 0) {
      x->prior = x->value;
      x->spread = x->scale = tolerance;
    }
    snprintf(x->name, sizeof x->name, "%.80s.%d", lab_fit_name(param, name), e + 1);
  }
  return LAB_OK;
}

/* All that each experiment has for itself, from one on. */
static int add_own(lab_unknowns *u, int first, lab_error *error)
{
  int j;
  for (j = 0; j < u->rig.n_fit; j++)
    if (u->rig.fit_per_log[j] && add_per_log(u, &u->rig, u->rig.fit[j], first, error))
      return error->status;
  return LAB_OK;
}

/* Mean of what each log has for itself of a parameter.
 * Out:     deviation  standard deviation of one more log about it; NaN: of fewer than three logs it says nothing */
static double mean_of_logs(const lab_unknowns *u, int param, double *deviation)
{
  double sum = 0, square = 0, first = 0, off;
  int j, n = 0;
  for (j = 0; j < u->n; j++) {
    const lab_unknown *x = &u->unknown[j];
    if (x->kind != LAB_UNKNOWN_PARAM || x->index != param || x->run == LAB_ALL_RUNS)
      continue;
    first = n++ ? first : x->value;
    off = x->value - first;
    sum += off;
    square += off * off;
  }
  *deviation = n > 2 ? sqrt(fmax(square - sum * sum / n, 0) / (n - 1) * (1 + 1. / n)) : (double)NAN;
  return first + sum / n;
}

lab_rig lab_unknowns_expected(const lab_unknowns *u)
{
  lab_rig rig = u->rig;
  int j;
  for (j = 0; j < rig.n_fit; j++) {
    double deviation, mean;
    if (!rig.fit_per_log[j] || rig.fit[j] == LAB_PARAM_ORIFICE_AREA || rig.tolerance[rig.fit[j]] > 0)
      continue;
    mean = mean_of_logs(u, rig.fit[j], &deviation);
    *pneu_param_at(&rig.params, rig.fit[j]) = (pneu_real)mean;
    rig.tolerance[rig.fit[j]] = deviation;
  }
  return rig;
}

int lab_unknowns_own(const lab_rig *rig, const lab_run *run, int n_runs, lab_unknowns *u, lab_error *error)
{
  lab_unknowns_none(rig, run, n_runs, u);
  if (add_own(u, 0, error))
    return error->status;
  lab_unknowns_view(u, 0);
  return LAB_OK;
}

int lab_unknowns_join(lab_unknowns *u, const lab_run *run, int n_runs, lab_error *error)
{
  const int first = u->n_runs;
  int e;
  u->run = run;
  u->n_runs = n_runs;
  for (e = first; e < n_runs; e++)
    u->n_rows += run[e].n * (size_t)run[e].n_channels;
  if (add_own(u, first, error))
    return error->status;
  for (e = first; e < n_runs; e++)
    add_switches(u, e);
  lab_unknowns_view(u, u->window);
  return LAB_OK;
}

void lab_unknowns_none(const lab_rig *rig, const lab_run *run, int n_runs, lab_unknowns *u)
{
  int e;
  memset(u, 0, sizeof *u);
  u->run = run;
  u->n_runs = n_runs;
  u->rig = *rig;
  u->declared = rig->params;
  u->misfit = u->own_misfit = 1;
  for (e = 0; e < n_runs; e++)
    u->n_rows += run[e].n * (size_t)run[e].n_channels;
  lab_unknowns_view(u, 0);
}

int lab_unknowns_open(const lab_rig *rig, const lab_run *run, int n_runs, lab_unknowns *u, lab_error *error)
{
  int j, e;
  lab_unknowns_none(rig, run, n_runs, u);
  u->tol = 1e-6;
  for (j = 0; j < rig->n_fit; j++)
    if (rig->fit_per_log[j] ? add_per_log(u, rig, rig->fit[j], 0, error)
                            : lab_unknowns_add(u, rig->fit[j], lab_param_value(rig, rig->fit[j]), error))
      return error->status;
  for (e = 0; e < n_runs; e++)
    add_switches(u, e);
  lab_unknowns_view(u, 0);
  return LAB_OK;
}

int lab_param_twin(int param)
{
  return param == PNEU_PARAM_damping            ? (int)PNEU_PARAM_viscous_friction
         : param == PNEU_PARAM_viscous_friction ? (int)PNEU_PARAM_damping
                                                : -1;
}

double lab_unknowns_to_hold(const lab_unknowns *u, const lab_rig *declared, int param)
{
  const int area = param == PNEU_PARAM_fill_area || param == PNEU_PARAM_vent_area, twin = lab_param_twin(param);
  const int left = param == PNEU_PARAM_damping && lab_rig_fits(declared, param);
  const double tolerance = param == LAB_PARAM_ORIFICE_AREA ? 0
                           : left                          ? lab_param_value(declared, param)
                                                           : lab_tolerance(declared, param);
  if (lab_unknowns_find(u, param) >= 0 || (area && lab_unknowns_find(u, LAB_PARAM_ORIFICE_AREA) >= 0) ||
      (twin >= 0 && (lab_unknowns_find(u, twin) >= 0 || lab_tolerance(declared, twin) > tolerance)))
    return 0;
  return tolerance;
}

int lab_param_is_of_sensor(int param)
{
  const int effect = pneu_effect_of(param);
  return effect >= 0 && strcmp(pneu_effect_at(effect)->equation, "sensor") == 0;
}

/* Of a declared value, the least share that a fit takes it for: a stem of no mass and no friction would ring. */
static const double held_least = 0.2;

/* The highest pressure of air that weather and depth make, about [Pa]: 108.5 kPa was measured (Tosontsengel, 2001). */
static const double highest_ambient = 110e3;

/* Hold a declared value.  Returns: as lab_unknowns_add */
static int hold(lab_unknowns *u, const lab_rig *declared, int param, double tolerance, lab_error *error)
{
  lab_unknown *x;
  if (lab_unknowns_add(u, param, lab_param_value(&u->rig, param), error))
    return error->status;
  x = &u->unknown[u->n - 1];
  x->prior = x->first = lab_param_value(declared, param);
  if (x->prior > 0 && !lab_param_is_of_sensor(param))
    x->lower = fmax(x->lower, held_least * x->prior);
  if (param == PNEU_PARAM_ambient_pressure)
    x->upper = fmax(x->prior, highest_ambient);
  x->spread = x->tolerance = x->scale = tolerance;
  return LAB_OK;
}

int lab_unknowns_hold(lab_unknowns *u, lab_error *error)
{
  lab_rig declared = u->rig;
  int param, status = LAB_OK;
  declared.params = u->declared;
  for (param = 0; param < LAB_PARAM_COUNT && status == LAB_OK; param++) {
    const double tolerance = lab_unknowns_to_hold(u, &declared, param);
    if (tolerance > 0)
      status = hold(u, &declared, param, tolerance, error);
  }
  if (status == LAB_OK)
    lab_unknowns_view(u, u->window);
  return status;
}

int lab_unknowns_free_value(lab_unknowns *u, int param, lab_error *error)
{
  lab_rig declared = u->rig;
  declared.params = u->declared;
  if (hold(u, &declared, param, lab_tolerance(&declared, param), error))
    return error->status;
  lab_unknowns_let_go(u, u->n - 1);
  lab_unknowns_view(u, u->window);
  return LAB_OK;
}

void lab_unknowns_let_go(lab_unknowns *u, int j)
{
  lab_unknown *x = &u->unknown[j];
  x->spread = 0;
  x->scale = fmax(fabs(x->prior), x->tolerance);
}

int lab_unknown_is_let_go(const lab_unknown *x)
{
  return x->kind == LAB_UNKNOWN_PARAM && lab_param_is_value(x->index) && x->tolerance > 0 && x->spread == 0;
}

static void move_result(lab_fit_result *r, int from, int to)
{
  int i;
  r->state[to] = r->state[from];
  r->low[to] = r->low[from];
  r->high[to] = r->high[from];
  r->deviation[to] = r->deviation[from];
  for (i = 0; i < r->n; i++)
    r->covariance[i][to] = r->covariance[i][from];
  memcpy(r->covariance[to], r->covariance[from], sizeof r->covariance[to]);
}

void lab_unknowns_settle(lab_unknowns *u, lab_fit_result *result)
{
  int j, k;
  for (j = k = 0; j < u->n; j++) {
    if (lab_unknown_is_held(&u->unknown[j]))
      continue;
    if (result)
      move_result(result, j, k);
    u->unknown[k++] = u->unknown[j];
  }
  u->n = k;
  if (result)
    result->n = k;
  lab_rig_drop_idle(&u->rig);
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].kind == LAB_UNKNOWN_PARAM && u->unknown[j].run == LAB_ALL_RUNS &&
        u->unknown[j].index < PNEU_PARAM_COUNT)
      u->unknown[j].value = lab_param_value(&u->rig, u->unknown[j].index);
  lab_unknowns_count(u);
}

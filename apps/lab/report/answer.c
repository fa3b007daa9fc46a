#include "answer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../base/clock.h"
#include "../base/interrupt.h"
#include "../base/outfile.h"
#include "../base/text.h"
#include "../check/mend.h"
#include "../discriminate/forecast.h"
#include "../fit/drift.h"
#include "../fit/weights.h"
#include "../metrics/recording.h"
#include "../rig/tolerance.h"
#include "../trace/alone.h"
#include "../trace/apart.h"
#include "figures.h"
#include "judge.h"

static void on_progress(const lab_request *q, const char *what)
{
  if (q->on_progress)
    q->on_progress(q->context, what);
}

/* ---- Reading ---- */

/* Whether a log held out is one of those fitted, and the rig file does not say which of its rows are held out. */
static int is_fitted(const lab_request *q, const lab_rig *rig, const char *path)
{
  int i, same = 0;
  for (i = 0; i < q->n_logs; i++)
    same |= strcmp(q->log[i], path) == 0;
  return same && isnan(rig->log.holdout_from) && rig->log.holdout_first < 0;
}

static int read_held_out(const lab_request *q, lab_answer *a, lab_error *error)
{
  int i;
  a->rig_held = a->rig;
  a->held.is_whole = 1;
  a->held.by_set_position = a->now.logs.n_without_u == a->now.logs.n_logs;
  lab_log_format_hold_out(&a->rig_held.log);
  for (i = 0; i < q->n_holdout; i++) {
    if (is_fitted(q, &a->rig, q->holdout[i]))
      lab_limitation(&a->now.logs.limitations,
                     "%s is held out, but fitted too, so that it tests nothing: give another log, or hold out some of "
                     "its rows by log.holdout in the rig file.",
                     lab_file_name(q->holdout[i]));
    if (lab_logs_add(&a->held, &a->rig_held, q->holdout[i], error))
      return error->status;
  }
  lab_limitations_join(&a->now.logs.limitations, &a->held.limitations);
  return LAB_OK;
}

/* The least noise of the position in runs that a positioner follows by a set position; infinite without such a run.
 * In/out:  runs  their number grows */
static double least_noise(const lab_logs *logs, int *runs)
{
  double noise = HUGE_VAL;
  int e, c;
  for (e = 0; e < logs->n; e++) {
    const lab_run *x = &logs->run[e];
    if (lab_log_command(x->log) != LAB_CHANNEL_SP)
      continue;
    ++*runs;
    for (c = 0; c < x->n_channels; c++)
      if (x->channel[c] == LAB_CHANNEL_X)
        noise = fmin(noise, x->sigma[c]);
  }
  return noise;
}

/* What the loop was before the logs is unknown. Where a set position ramps, the stem goes in and out of the dead band
 * by less than the noise; a band whose edge is a share of the noise has it follow on a line, which takes a tenth of the
 * time, and has slopes. */
static void prepare_positioner(lab_answer *a)
{
  enum { FEW = LAB_FIT_MAX / 4 }; /* runs: each has an integral of its own */
  static const double share =
      0.4; /* by judgement; of an edge of 4 um, the stem was 0.2 um off in the mean on one ramp */
  int runs = 0;
  const double now = least_noise(&a->now.logs, &runs), noise = fmin(now, least_noise(&a->then.logs, &runs));
  if (isfinite(noise) && a->rig.params.stroke > 0)
    a->rig.band_edge = share * noise / (double)a->rig.params.stroke;
  if (runs > 0 && runs <= FEW)
    lab_rig_free_integral(&a->rig);
}

/* Read every log before any fit, so that a bad one costs no waiting. */
static int read_files(const lab_request *q, lab_answer *a, lab_error *error)
{
  int i;
  on_progress(q, "reading");
  if (lab_rig_read(q->rig, &a->rig, error))
    return error->status;
  for (i = 0; i < q->n_logs; i++)
    if (lab_logs_add(&a->now.logs, &a->rig, q->log[i], error))
      return error->status;
  for (i = 0; i < q->n_baseline; i++)
    if (lab_logs_add(&a->then.logs, &a->rig, q->baseline[i], error))
      return error->status;
  if (lab_plausible_content(&a->rig, &a->now.logs.content, &a->now.logs.limitations, error) ||
      (q->n_baseline && lab_plausible_content(&a->rig, &a->then.logs.content, &a->then.logs.limitations, error)))
    return error->status;
  if (a->now.logs.n_without_u > 0)
    lab_limitation(
        &a->now.logs.limitations,
        "The set position drives the model by its positioner; u does not, for between rows it is not known.");
  prepare_positioner(a);
  return read_held_out(q, a, error);
}

/* ---- How far a model is from logs that it has not seen ---- */

/* Errors on what was held out: of the models on the way there, and on each log by itself. */
static int judge_each(lab_answer *a, const lab_rig *before, const lab_rig *after, lab_error *error)
{
  lab_logs *held = &a->held;
  int i, first = 0;
  for (i = 0; i < a->now.result.n_path; i++) {
    const int status = lab_judge(&a->now.result.path[i].rig, held->run, held->n, &a->report.holdout_path[i], error);
    if (status == LAB_NUMERIC)
      lab_errors_none(&a->report.holdout_path[i]);
    else if (status != LAB_OK)
      return status;
  }
  for (i = 0; i < held->n_logs; i++) {
    lab_holdout_log *log = &a->report.held[i];
    int n = 0;
    while (first + n < held->n && held->run[first + n].log == &held->log[i])
      n++;
    log->name = lab_file_name(held->log[i].path);
    if (lab_judge(before, &held->run[first], n, &log->before, error) ||
        lab_judge(after, &held->run[first], n, &log->after, error))
      return error->status;
    first += n;
  }
  a->report.n_held = held->n_logs;
  return LAB_OK;
}

/* A model that cannot follow the held-out log has no error on it; that is said, and the rest is written. */
static int hold_out(lab_answer *a, lab_error *error)
{
  lab_report *report = &a->report;
  lab_logs *held = &a->held;
  const lab_rig before = lab_unknowns_expected(&a->now.declared), after = lab_unknowns_expected(&a->now.completed);
  if (held->n == 0)
    return LAB_OK;
  if (a->now.completed.rig.n_onsets > a->rig.n_onsets)
    lab_limitation(&a->now.logs.limitations,
                   "what begins at %.6g s of the log begins at the same time of a held-out log",
                   a->now.completed.rig.onset[a->rig.n_onsets].from);
  if (a->now.logs.run->jitter > 0 &&
      lab_weigh_unseen(&after, a->now.logs.run->jitter, held->run, held->n, error) == LAB_WORLD)
    return LAB_WORLD;
  report->has_holdout = !lab_judge(&before, held->run, held->n, &report->holdout_before, error) &&
                        !lab_judge(&after, held->run, held->n, &report->holdout_after, error) &&
                        !judge_each(a, &before, &after, error);
  if (report->has_holdout)
    return LAB_OK;
  if (error->status != LAB_NUMERIC)
    return error->status;
  lab_limitation(&a->now.logs.limitations, "held-out log not judged: %s", error->text);
  return LAB_OK;
}

/* ---- The test to record next ---- */

/* The rig and the longest of its records, as the search for a trial sees them. */
static void inquire(const lab_report *report, lab_advice_request *q)
{
  const lab_unknowns *u = report->completed;
  const lab_run *x = &u->run[0];
  const double *t;
  int e, c;
  for (e = 1; e < u->n_runs; e++)
    if (u->run[e].n > x->n)
      x = &u->run[e];
  t = x->log->value[LAB_CHANNEL_TIME] + x->first;
  *q = (lab_advice_request){.rig = report->rig,
                            .n_fit = report->rig->n_fit,
                            .fit = report->rig->fit,
                            .recorded = &x->inputs.schedule,
                            .recorded_duration = t[x->n - 1] - t[0]};
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    q->noise[c] = (double)NAN;
  for (c = 0; c < x->n_channels; c++)
    q->noise[x->channel[c]] = x->sigma[c];
  q->spacing = q->recorded_duration / (double)(x->n > 1 ? x->n - 1 : 1);
}

/* Whether anything was recorded that a test can be foreseen for. */
static int can_foresee(const lab_advice_request *q)
{
  int c;
  for (c = 0; c < LAB_FORECAST_CHANNELS; c++)
    if (q->noise[lab_forecast_channels[c]] > 0)
      return 1;
  return 0;
}

/* In:  until  [s] of CPU time; 0: no end */
static int advise(lab_answer *a, double until, lab_error *error)
{
  lab_report *report = &a->report;
  const lab_search_result *r = report->result;
  int fit[LAB_PARAM_COUNT], i, alike = 0;
  lab_advice_request q;
  lab_rig last;
  lab_rig_at(&report->completed->rig, INFINITY, &last);
  inquire(report, &q);
  q.until = until;
  if (!can_foresee(&q))
    return LAB_OK;
  for (i = 0; i < r->n_found; i++) {
    const lab_found *found = &r->found[i];
    alike += found->n_alike;
    if (found->n_alike > 0 && lab_discriminate(&q, &last.params, &found->alike_params[0], &report->separate[i], error))
      return error->status;
  }
  if (alike > 0 || r->window > 0 || report->completed->rig.n_terms > 0)
    return LAB_OK;
  memcpy(fit, q.fit, (size_t)q.n_fit * sizeof *fit);
  q.n_known = q.n_fit; /* what was found is to be known first */
  for (i = 0; i < r->n_found; i++)
    fit[q.n_fit++] = r->found[i].param;
  q.fit = fit;
  return lab_advise_precision(&q, &last.params, &report->next, error);
}

/* ---- The loop ---- */

/* The loop's result where the log cannot carry a name: the fit, and nothing traced. */
static int decline(lab_unknowns *u, lab_search_result *result, lab_error *error)
{
  if (lab_search_measure(u, LAB_STAGE_BEFORE, result, error) || lab_search_measure(u, LAB_STAGE_AFTER, result, error))
    return error->status;
  result->verdict = LAB_VERDICT_UNDECIDED;
  return lab_unknowns_intervals(u, &result->fit, error);
}

static int is_listed(const lab_deviations *all, const lab_deviation *d)
{
  int i, any = 0;
  for (i = 0; i < all->n; i++)
    any |= all->of[i].param == d->param;
  return any;
}

/* Say which held values the model has elsewhere, though no interval leaves out what was declared: together they fit
 * better. */
static void remark_moved(lab_answer *a)
{
  enum { SAID = 5 };
  static const double worth = 0.5; /* of a tolerance */
  const lab_unknowns *u = &a->now.completed;
  char text[LAB_LIMITATION_TEXT] = "", one[LAB_SENTENCE_TEXT];
  lab_deviation d;
  int j, n = 0;
  for (j = 0; j < u->n; j++) {
    const lab_unknown *x = &u->unknown[j];
    if (!lab_deviation_of(&a->rig, u, &a->now.result.fit, j, &d) || !d.held || is_listed(&a->report.deviations, &d) ||
        !(fabs(x->value - x->prior) > worth * x->tolerance) || n++ >= SAID)
      continue;
    lab_report_deviation(&a->report, &d, one);
    lab_append(text, sizeof text, "%s%s", n > 1 ? ", " : "", one);
  }
  if (n > SAID)
    lab_append(text, sizeof text, ", and %d more", n - SAID);
  if (n > 0)
    lab_limitation(&a->now.logs.limitations, "model.cfg also has what the log does not tell by itself: %s.", text);
}

/* How far off its sheet a value may be to be told, in tolerances: beside something that is missing it is bent to make
 * up for that, and beside much that is missing, or what begins and leaves more than may be noise, none is told. */
static double trusted(const lab_search_result *r)
{
  const double left = lab_report_in_noise(&r->after);
  if (r->sound_until > 0 && left * left > lab_constant(LAB_NOISE_DOUBTFUL))
    return 0;
  return r->verdict != LAB_VERDICT_UNDECIDED       ? (double)INFINITY
         : left < lab_constant(LAB_VALUES_TRUSTED) ? lab_constant(LAB_FAR_OFF)
                                                   : 0;
}

static int is_told_as_value(const lab_deviations *all, int effect)
{
  int i, any = 0;
  for (i = 0; i < all->n; i++)
    any |= pneu_effect_of(all->of[i].param) == effect;
  return any;
}

/* What is told as a value that is off is no effect that is too small to add. */
static void list_once(const lab_deviations *all, lab_search_result *r)
{
  int i, n = 0;
  for (i = 0; i < r->n_listed; i++)
    if (!is_told_as_value(all, r->listed[i]))
      r->listed[n++] = r->listed[i];
  r->n_listed = n;
}

/* What the fit says of the declared values, which are not unknowns from here on. */
static int conclude(lab_answer *a, lab_error *error)
{
  lab_search_result *r = &a->now.result;
  lab_deviations *all = &a->report.deviations;
  if (lab_deviations_find(&a->rig, &a->now.completed, &r->fit, trusted(r), all, error))
    return error->status;
  list_once(all, r);
  if (r->verdict == LAB_VERDICT_UNDECIDED && all->condition == LAB_CONDITION_AS_DECLARED)
    all->condition = LAB_CONDITION_CANNOT_TELL;
  if (lab_report_wanders(r))
    lab_limitation(&a->now.logs.limitations,
                   "What is left is %s times the noise, as much at rest as in motion: noise of a sensor that wanders.",
                   LAB_NUMBER(lab_report_in_noise(&r->after), 3));
  if (!lab_values_stand_in(r->verdict, r->fit.reduced_chi2))
    remark_moved(a);
  lab_unknowns_settle(&a->now.completed, &a->now.result.fit);
  return LAB_OK;
}

/* How much of a budget the search may take: what it leaves is for the intervals and for judging, a few simulations for
 * each unknown, of which the fit of the declared model has shown the cost: as much again, and as it took itself.
 * In:      budget, fit  [s] of CPU: what is given, and what the fit took */
static double for_search(double budget, double fit)
{
  static const double least = 0.5, most = 0.7;
  return fmax(fmin(most * budget, budget - 2 * fit), least * budget);
}

static void place_on_rows(lab_logs *logs, int on_rows)
{
  int e;
  for (e = 0; e < logs->n; e++)
    logs->run[e].on_rows = on_rows;
}

/* Whether the rows of all runs are farther apart than the lags and the clocks of the sensors are known. */
static int rows_are_apart(const lab_logs *logs)
{
  static const char *const instrument[] = {"pressure_lag.pressure_time", "position_lag.position_time",
                                           "channel_skew.channel_skew"};
  int e, i, apart = 1;
  for (e = 0; e < logs->n; e++) {
    const lab_run *x = &logs->run[e];
    const double *t = x->log->value[LAB_CHANNEL_TIME] + x->first;
    for (i = 0; i < 3; i++) {
      const int param = lab_param_index(instrument[i]);
      apart &= param < 0 || t[x->n - 1] - t[0] > (double)x->n * lab_tolerance(x->rig, param);
    }
  }
  return apart;
}

/* A controller makes its commands at the rows that it logs. Where a fit asks for that, the declared model is fitted so,
 * and stays so if that is plainly the better fit beside what it leaves. Of a model that is off, instants within a row
 * stand for what the sensors do.
 * In/out:  declared  fitted
 *          chi2      of that */
static int fit_on_rows(lab_logs *logs, lab_unknowns *declared, double chi2, lab_error *error)
{
  const double plainly = lab_constant(LAB_ALIKE_BIC) * fmax(chi2 / (double)declared->m, 1);
  lab_unknowns *u;
  double on_rows;
  int status;
  if ((chi2 > lab_constant(LAB_NOISE_DOUBTFUL) * (double)declared->n_values && !rows_are_apart(logs)) ||
      !lab_unknowns_are_at_rows(declared))
    return LAB_OK;
  u = malloc(sizeof *u);
  if (!u)
    return lab_fail_memory(error, "a fit");
  place_on_rows(logs, 1);
  status = lab_unknowns_open(logs->run[0].rig, logs->run, logs->n, u, error);
  u->until = declared->until;
  if (status == LAB_OK)
    status = lab_unknowns_fit(u, LAB_ROUNDS_ALL, &on_rows, error);
  if (status == LAB_OK && on_rows + plainly < chi2) {
    *declared = *u;
    lab_limitation(&logs->limitations,
                   "Commands change at the rows that show them, and not between two: that fits better.");
  } else {
    place_on_rows(logs, 0);
  }
  free(u);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

/* When so many seconds of CPU from now are used [s]; 0: never.  In: seconds  0: any */
static double after(double seconds)
{
  return seconds > 0 ? lab_cpu_time() + seconds : 0;
}

/* Take off the logs what of the mains a model leaves.  In/out: any  not 0 once there was some */
static int remove_hum(lab_logs *logs, const lab_unknowns *u, int *any, lab_error *error)
{
  double *left = malloc((u->n_rows + 1) * sizeof *left), *r = left;
  int e, c, lines, status = left ? lab_unknowns_errors(u, left, error) : lab_fail_memory(error, "hum");
  size_t i;
  for (e = 0; e < u->n_runs && status == LAB_OK; e++) {
    const lab_run *x = &u->run[e];
    for (c = 0; c < x->n_channels && status == LAB_OK; c++, r += x->n) {
      for (i = 0; i < x->n; i++)
        r[i] *= x->sigma[c];
      status = lab_log_remove_hum_left(&logs->log[x->log - logs->log], x->first, x->n, x->channel[c], r, &lines,
                                       &logs->limitations, error);
      *any |= lines > 0;
    }
  }
  free(left);
  return status;
}

/* Fit the declared model; once more where the logs show another noise or clock than is declared.
 * In:      most  [s] of CPU for each of these fits; 0: any */
static int fit_declared(lab_logs *logs, double most, lab_unknowns *declared, lab_error *error)
{
  double chi2;
  int e, any, hums = 0;
  for (e = 0; e < logs->n; e++)
    if (lab_drift_open(&logs->run[e], error))
      return error->status;
  declared->until = after(most);
  if (lab_unknowns_fit(declared, LAB_ROUNDS_ALL, &chi2, error))
    return error->status;
  declared->until = after(most);
  if (lab_unknowns_leave_damping(declared) && lab_unknowns_fit(declared, LAB_ROUNDS_ALL, &chi2, error))
    return error->status;
  if (fit_on_rows(logs, declared, chi2, error) || remove_hum(logs, declared, &hums, error) ||
      lab_weigh_runs(declared, logs->run, &any, error))
    return error->status;
  declared->until = after(most);
  lab_weights_say(logs->run, logs->n, &logs->limitations);
  return any || hums ? lab_unknowns_fit(declared, LAB_ROUNDS_ALL, NULL, error) : LAB_OK;
}

/* How much CPU time there is, from when on [s]; 0: no end. */
typedef struct allowance {
  double start, budget;
} allowance;

static double until(const allowance *time, double fit)
{
  return time->budget > 0 ? time->start + for_search(time->budget, fit) : 0;
}

/* Fit the declared model to the logs, for a part of the time: where something begins no values fit them all, and a fit
 * may go through models that take long to simulate.  Out: fit_s  [s] of CPU that it took */
static int fit_to(const lab_request *q, const lab_rig *rig, const allowance *time, lab_completion *c, double *fit_s,
                  lab_error *error)
{
  static const double most = 0.15; /* of the time, by judgement */
  const double used = lab_cpu_time();
  int status;
  on_progress(q, "fitting the declared model");
  if (lab_unknowns_open(rig, c->logs.run, c->logs.n, &c->declared, error))
    return error->status;
  status = fit_declared(&c->logs, most * time->budget, &c->declared, error);
  *fit_s = lab_cpu_time() - used;
  return status;
}

/* Whether an explanation leaves plainly less than noise in some channel: it was taken for too much, and may have hidden
 * something. */
static int may_overrate_noise(const lab_completion *c)
{
  static const double plainly_less = 0.7; /* by judgement */
  int i, any = 0;
  for (i = 0; i < LAB_CHANNEL_COUNT; i++)
    any |= c->result.after.in_noise[i] < plainly_less; /* NaN where it is not measured */
  return any && lab_search_explains(&c->result) && !c->result.cut_short;
}

/* Whether a model leaves so little more than noise that the noise may be told wrong, or has found a part of what was
 * taken for it. */
static int may_mistake_noise(const lab_completion *c)
{
  return c->result.verdict == LAB_VERDICT_UNDECIDED && !c->result.cut_short &&
         (c->result.n_found + c->completed.rig.n_onsets > 0 ||
          !lab_values_stand_in(c->result.verdict, c->result.fit.reduced_chi2));
}

/* Search; where a mistake in the noise may be all that is left, or may have hidden something, once more with that told.
 */
static int search_with_noise(const lab_search_options *how, lab_completion *c, lab_error *error)
{
  int hums = 0, any = 0, status = lab_search_run(&c->completed, how, &c->result, error);
  if (status == LAB_OK && c->result.verdict == LAB_VERDICT_UNDECIDED && !c->result.cut_short)
    status = remove_hum(&c->logs, &c->completed, &hums, error);
  if (status == LAB_OK && (hums || may_mistake_noise(c) || may_overrate_noise(c)))
    status = lab_weigh_runs(&c->completed, c->logs.run, &any, error);
  if (status != LAB_OK || !(any || hums))
    return status;
  if (lab_unknowns_fit(&c->declared, LAB_ROUNDS_ALL, NULL, error))
    return error->status;
  c->completed = c->declared;
  return lab_search_run(&c->completed, how, &c->result, error);
}

/* Whether a search near the sheet says as much as the first: it explains the logs as well, seen as finely, or it is the
 * better one where the first does not, and none of its values is at its end. */
static int says_as_much(const lab_completion *c, const lab_completion *first)
{
  const lab_search_result *near = &c->result, *any = &first->result;
  if (lab_unknowns_is_far(&c->completed, c->declared.most_off))
    return 0;
  if (!lab_search_explains(any))
    return lab_search_is_better(near, any);
  return lab_search_explains(near) && near->window == any->window && near->n_path > 0 && any->n_path > 0 &&
         near->path[near->n_path - 1].bic < any->path[any->n_path - 1].bic + lab_constant(LAB_ALIKE_BIC);
}

/* Search; where a value ends far from its sheet, once more with all of them near it, for half of the time that is left.
 */
static int search_near_sheet(const lab_search_options *how, lab_completion *c, lab_error *error)
{
  const double tolerances = lab_constant(LAB_FAR_OFF), until = c->declared.until;
  lab_completion *first;
  int cut_short, status = search_with_noise(how, c, error);
  if (status != LAB_OK || c->result.cut_short || !lab_unknowns_is_far(&c->completed, tolerances))
    return status;
  first = malloc(sizeof *first);
  if (!first)
    return lab_fail_memory(error, "a search near the sheet");
  *first = *c;
  lab_unknowns_stay_near(&c->declared, tolerances);
  c->declared.until = until > 0 ? (lab_cpu_time() + until) / 2 : 0;
  status = lab_unknowns_fit(&c->declared, LAB_ROUNDS_ALL, NULL, error);
  c->completed = c->declared;
  if (status == LAB_OK)
    status = lab_search_run(&c->completed, how, &c->result, error);
  cut_short = lab_cpu_is_spent(c->declared.until);
  c->declared.until = until;
  if (status != LAB_OK || !says_as_much(c, first)) {
    *c = *first;
    c->result.cut_short |= cut_short;
  }
  free(first);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

/* Search; where that takes values far off their sheet, once more from the one value that may be off alone. That answer
 * is taken if it explains the logs. */
static int search_alone(const lab_search_options *how, lab_completion *c, lab_error *error)
{
  lab_completion *first;
  int any, spent, status = search_near_sheet(how, c, error);
  if (status != LAB_OK || !c->result.is_far || lab_cpu_is_spent(c->declared.until))
    return status;
  first = malloc(sizeof *first);
  if (!first)
    return lab_fail_memory(error, "a search from one value");
  *first = *c;
  status = lab_alone_find(&c->declared, &c->completed, &any, error);
  if (status == LAB_OK && any)
    status = lab_search_run(&c->completed, how, &c->result, error);
  spent = lab_cpu_is_spent(c->declared.until);
  if (status != LAB_OK || !any || !lab_search_explains(&c->result)) {
    *c = *first;
    c->result.cut_short |= spent;
  }
  c->result.before = first->result.before;
  memcpy(c->result.left[LAB_STAGE_BEFORE], first->result.left[LAB_STAGE_BEFORE], sizeof first->result.left[0]);
  free(first);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

/* Search with what the logs share; where something seems to differ from log to log that is half of the time, and the
 * rest is for a search with values of each log. */
static int search_apart(const lab_search_options *how, lab_completion *c, lab_error *error)
{
  const double now = lab_cpu_time(), end = c->declared.until;
  lab_apart *apart = malloc(sizeof *apart);
  int status = apart ? lab_apart_find(&c->declared, apart, error) : lab_fail_memory(error, "values of each log");
  if (status == LAB_OK && apart->n > 0 && end > 0)
    c->declared.until = now + (end - now) / 2;
  c->completed = c->declared;
  if (status == LAB_OK)
    status = search_alone(how, c, error);
  if (status == LAB_OK && c->declared.most_off > 0)
    lab_unknowns_stay_near(&apart->declared, c->declared.most_off);
  if (status == LAB_OK)
    status = lab_search_without_outliers(how, &c->logs, &c->declared, &c->completed, &c->result, error);
  c->declared.until = c->completed.until = end;
  if (status == LAB_OK)
    status = lab_apart_search(apart, how, &c->logs, &c->completed, &c->result, error);
  free(apart);
  return status;
}

/* Add what the fitted model lacks.
 * In:      fit_s      of fit_to
 *          may_begin  whether it may begin within the log: a baseline is what it is throughout */
static int complete(const lab_request *q, const allowance *time, double fit_s, int may_begin, lab_completion *c,
                    lab_error *error)
{
  lab_search_options how;
  lab_search_options_default(&how);
  how.on_progress = q->on_progress;
  how.context = q->context;
  how.alpha = q->alpha;
  how.min_gain = q->min_gain;
  how.may_begin = may_begin;
  if (c->logs.limitations.doubt) {
    c->completed = c->declared;
    return decline(&c->completed, &c->result, error);
  }
  c->declared.until = until(time, fit_s);
  if (search_apart(&how, c, error))
    return error->status;
  if (lab_values_stand_in(c->result.verdict, c->result.fit.reduced_chi2)) /* then a drift may be anything */
    return LAB_OK;
  return lab_drift_say(&c->completed, &c->logs.limitations, error);
}

/* What has changed since the baseline. Where the logs of either side are in doubt, that is all that can be said.
 * In:      time  of all; a third is for the model of the baseline, what is left but a tenth for the comparison */
static int compare(const lab_request *q, const allowance *time, lab_answer *a, lab_error *error)
{
  static const double baseline = 1.0 / 3, both = 0.9;
  const allowance own = {lab_cpu_time(), baseline * time->budget};
  lab_completion *then = &a->then;
  const lab_limitations *doubtful = a->now.logs.limitations.doubt ? &a->now.logs.limitations : &then->logs.limitations;
  lab_suspect suspect[LAB_SUSPECTS_MAX];
  lab_comparison of = {.then = &then->completed, .now = a->now.logs.run, .n_now = a->now.logs.n, .suspect = suspect};
  double fit_s;
  if (then->logs.n == 0)
    return LAB_OK;
  a->report.changes = &a->changes;
  if (doubtful->doubt) {
    snprintf(a->changes.why, sizeof a->changes.why, "%s", doubtful->text[doubtful->doubt - 1]);
    return LAB_OK;
  }
  on_progress(q, "completing the model of the baseline");
  if (fit_to(q, &a->rig, &own, then, &fit_s, error) || complete(q, &own, fit_s, 0, then, error))
    return error->status;
  on_progress(q, "looking for what has changed");
  then->completed.until = time->budget > 0 ? time->start + both * time->budget : 0;
  of.alpha = q->alpha;
  of.decided = !lab_values_stand_in(then->result.verdict, then->result.fit.reduced_chi2);
  of.n_suspects = lab_suspects_find(&(lab_explained){&then->completed, &then->result},
                                    &(lab_explained){&a->now.completed, &a->now.result}, suspect);
  if (lab_changes_find(&of, &a->changes, error))
    return error->status;
  lab_unknowns_settle(&then->completed, &then->result.fit);
  a->report.baseline = &then->completed.rig;
  return LAB_OK;
}

/* With nothing to fit the declared model is judged as it stands: its command changes at the rows that show it. */
static int leave_as_declared(lab_answer *a, lab_error *error)
{
  if (a->rig.n_fit > 0)
    return LAB_OK;
  lab_unknowns_none(&a->rig, a->now.logs.run, a->now.logs.n, &a->now.declared);
  return lab_loop_errors(&a->now.declared, &a->now.result.before, error);
}

static int close_loop(const lab_request *q, lab_answer *a, lab_error *error)
{
  static const double without_u = 0.75, beside = 0.6; /* of the budget, by judgement: the rest is for u, the baseline */
  static const double most = 0.75; /* of it, until when a test to record is looked for; what is under way goes on */
  const allowance time = {lab_cpu_time(), (a->now.logs.n_without_u > 0 ? without_u : 1) * q->budget};
  const allowance own = {time.start, (a->then.logs.n > 0 ? beside : 1) * time.budget};
  const double start = lab_clock();
  double fit_s;
  a->report = (lab_report){.rig = &a->rig,
                           .declared = &a->now.declared,
                           .completed = &a->now.completed,
                           .result = &a->now.result,
                           .limitations = &a->now.logs.limitations,
                           .measured = &a->measured,
                           .predicted = &a->predicted};
  if (fit_to(q, &a->rig, &own, &a->now, &fit_s, error))
    return error->status;
  a->report.fit_s = lab_clock() - start;
  if (complete(q, &own, fit_s, 1, &a->now, error) || compare(q, &time, a, error) || conclude(a, error) ||
      leave_as_declared(a, error))
    return error->status;
  a->report.trace_s = a->now.result.score_s;
  on_progress(q, "evaluating on the held-out logs");
  if (hold_out(a, error) || lab_metrics_compare(&a->now.completed, &a->measured, &a->predicted, error))
    return error->status;
  if (!a->now.result.cut_short && a->then.logs.n == 0) { /* with a baseline the question is what has changed */
    on_progress(q, "looking for the test to record next");
    if (advise(a, time.budget > 0 ? time.start + most * time.budget : 0, error))
      return error->status;
  }
  a->report.total_s = lab_clock() - start;
  return LAB_OK;
}

/* In:      by_set_position  not 0: that drives where the logs have it beside u
 * Out:     answer           to be freed; NULL after an error
 *          without_u        logs of which u was left out for that */
static int find(const lab_request *request, int by_set_position, lab_answer **answer, int *without_u, lab_error *error)
{
  lab_answer *a = *answer = calloc(1, sizeof *a);
  int status;
  *without_u = 0;
  if (!a)
    return lab_fail_memory(error, "the answer");
  a->now.logs.by_set_position = by_set_position;
  status = read_files(request, a, error);
  if (status == LAB_OK)
    status = close_loop(request, a, error);
  *without_u = a->now.logs.n_without_u;
  if (status == LAB_OK)
    return LAB_OK;
  lab_answer_free(a);
  *answer = NULL;
  return status;
}

/* Whether an answer explains its logs by values that are near their sheet. */
static int convinces(const lab_completion *c)
{
  return lab_search_explains(&c->result) && !lab_unknowns_is_far(&c->completed, lab_constant(LAB_STRAINED));
}

/* What a model leaves, as Schwarz's criterion but for what is the same of two models of the same rows, whatever each
 * takes for noise. */
static double left_by(const lab_search_result *r)
{
  double sum = r->fit.n * log((double)r->after.n);
  int c, n = 0;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    n += isfinite(r->after.rmse[c]);
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    sum += isfinite(r->after.rmse[c]) ? 2 * (double)r->after.n / n * log(r->after.rmse[c]) : 0;
  return sum;
}

static int is_better(const lab_search_result *other, const lab_search_result *first)
{
  const int explains = lab_search_explains(other);
  if (explains != lab_search_explains(first) || other->window != first->window)
    return explains;
  return left_by(other) < left_by(first);
}

/* Between its rows the opening that a positioner gives is not known, and often it has come and gone there; what the
 * positioner follows is. So the set position drives first, and u does, for what is left of the budget, where that does
 * not explain the logs and u is the better. What has changed since a baseline is asked of u alone. */
int lab_answer_find(const lab_request *request, lab_answer **answer, lab_error *error)
{
  const double start = lab_cpu_time();
  lab_request rest = *request;
  lab_answer *by_u = NULL;
  lab_error of_u;
  int without_u, none, status = find(request, request->n_baseline == 0, answer, &without_u, error);
  if (without_u == 0 || status == LAB_DATA || status == LAB_WORLD || (*answer && convinces(&(*answer)->now)))
    return status;
  if (request->budget > 0)
    rest.budget = fmax(request->budget - (lab_cpu_time() - start), 1);
  if (find(&rest, 0, &by_u, &none, &of_u) == LAB_OK &&
      (!*answer || is_better(&by_u->now.result, &(*answer)->now.result))) {
    lab_answer *worse = *answer;
    *answer = by_u;
    by_u = worse;
  }
  if (by_u)
    lab_answer_free(by_u);
  return *answer ? LAB_OK : status;
}

void lab_answer_free(lab_answer *answer)
{
  lab_logs_close(&answer->now.logs);
  lab_logs_close(&answer->then.logs);
  lab_logs_close(&answer->held);
  free(answer);
}

/* ---- Writing ---- */

/* Files of an answer, the extent from which on each is always there, and what writes it; figures are drawn by
 * lab_figures_draw. */
static const struct {
  const char *name;
  int extent;
  int rows; /* 1: it needs rows and figures; these come last */
  lab_report_writer *write;
} files[] = {{"model.cfg", LAB_WRITE_PLAIN, 0, lab_report_model},
             {"model.h", LAB_WRITE_PLAIN, 0, lab_report_header},
             {"effects.def", LAB_WRITE_PLAIN, 0, lab_report_catalogue},
             {"report.json", LAB_WRITE_JSON, 0, lab_report_json},
             {"residual.csv", LAB_WRITE_PLAIN, 1, lab_report_residual},
             {"report.html", LAB_WRITE_PLAIN, 1, lab_report_html},
             {"response.svg", LAB_WRITE_FIGURES, 1, NULL},
             {"residual.svg", LAB_WRITE_FIGURES, 1, NULL}};

static int write_files(const lab_report *report, const char *folder, int extent, lab_error *error)
{
  lab_figures *figures = NULL;
  int status = lab_make_folder(folder, error);
  size_t i;
  for (i = 0; i < sizeof files / sizeof *files; i++) {
    if (!files[i].write || files[i].extent > extent)
      continue;
    if (status == LAB_OK && files[i].rows && !figures)
      status = lab_figures_make(report, &figures, error);
    if (status == LAB_OK)
      status = lab_report_file(folder, files[i].name, files[i].write, &(lab_sources){report, figures}, error);
  }
  if (status == LAB_OK && extent >= LAB_WRITE_PLAIN)
    status = lab_figures_draw(extent >= LAB_WRITE_DRAWN ? figures : NULL, folder, extent == LAB_WRITE_FIGURES, error);
  lab_figures_free(figures);
  return status;
}

int lab_answer_write(const lab_answer *answer, const char *folder, int extent, lab_error *error)
{
  int status;
  lab_interrupt_hold();
  status = write_files(&answer->report, folder, extent, error);
  lab_interrupt_release();
  return status;
}

void lab_answer_remove(const char *folder)
{
  lab_error error;
  size_t i;
  for (i = 0; i < sizeof files / sizeof *files; i++)
    remove(LAB_IN_FOLDER(folder, files[i].name));
  lab_figures_draw(NULL, folder, 0, &error);
}

int lab_answer_is_there(const char *folder, int extent)
{
  size_t i;
  for (i = 0; i < sizeof files / sizeof *files; i++)
    if (files[i].extent <= extent && access(LAB_IN_FOLDER(folder, files[i].name), R_OK))
      return 0;
  return 1;
}

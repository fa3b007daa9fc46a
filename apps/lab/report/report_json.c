/* report.json */
#include <math.h>

#include "../base/json.h"
#include "../base/text.h"
#include "../rig/rigterm.h"
#include "../trace/freeterms.h"
#include "report.h"

static void add_unit_and_interval(cJSON *to, const char *unit, double low, double high)
{
  cJSON_AddStringToObject(to, "unit", unit);
  lab_json_range(to, "ci95", low, high);
}

/* Unknown j of the completed model, as it was fitted. */
static cJSON *add_fitted(cJSON *to, const char *name, const lab_report *report, int j)
{
  const lab_unknown *x = &report->completed->unknown[j];
  const lab_fit_result *fit = &report->result->fit;
  cJSON *o = cJSON_AddObjectToObject(to, name);
  cJSON_AddNumberToObject(o, "value", x->value);
  add_unit_and_interval(o, x->unit, fit->low[j], fit->high[j]);
  return o;
}

/* "onset" or "end", where there is one. */
static void add_onset(cJSON *o, const char *name, const lab_onset *onset)
{
  cJSON *at;
  if (!onset || !onset->known)
    return;
  at = cJSON_AddObjectToObject(o, name);
  cJSON_AddNumberToObject(at, "t", onset->t);
  add_unit_and_interval(at, "s", onset->low, onset->high);
}

static void add_change(cJSON *list, const lab_change *change)
{
  char name[LAB_PARAM_NAME_TEXT];
  cJSON *o = lab_json_append(list), *alike;
  int i;
  cJSON_AddStringToObject(o, "what", lab_change_name(change->param, name));
  cJSON_AddStringToObject(o, "parameter", lab_fit_name(change->param, name));
  LAB_JSON_NUMBERS(o, {"then", change->then}, {"now", change->now});
  add_unit_and_interval(o, lab_change_unit(change), change->low, change->high);
  alike = cJSON_AddArrayToObject(o, "indistinguishable_from");
  for (i = 0; i < change->n_alike; i++)
    lab_json_say(alike, "%s", lab_change_name(change->alike[i], name));
  LAB_JSON_NUMBERS(o, {"statistic", change->statistic}, {"p_value", change->p_value});
  add_onset(o, "onset", &change->begin);
  add_onset(o, "end", &change->end);
}

static void add_changes(const lab_changes *changes, cJSON *root)
{
  cJSON *list;
  int i;
  cJSON_AddStringToObject(root, "condition", lab_since_text(changes->condition));
  list = cJSON_AddArrayToObject(root, "changes");
  for (i = 0; i < changes->n; i++)
    add_change(list, &changes->change[i]);
}

static void add_effect_param(cJSON *to, const lab_report *report, int param)
{
  const int j = lab_report_size(report, param);
  if (j >= 0)
    add_fitted(to, lab_param_info(param).name, report, j);
}

static void add_found(cJSON *to, const lab_report *report, int which)
{
  const lab_found *found = &report->result->found[which];
  const pneu_effect *effect = pneu_effect_at(found->effect);
  cJSON *o = lab_json_append(to), *list;
  char sentence[LAB_FOUND_SENTENCE];
  int i, count;
  const int first = pneu_effect_params(found->effect, &count);
  cJSON_AddStringToObject(o, "effect", effect->name);
  cJSON_AddStringToObject(o, "equation", effect->equation);
  cJSON_AddStringToObject(o, "sentence", lab_report_found_sentence(report, found, sentence));
  list = cJSON_AddObjectToObject(o, "parameters");
  add_effect_param(list, report, found->param);
  for (i = first; i < first + count; i++)
    if (lab_param_info(i).shape)
      add_effect_param(list, report, i);
  add_onset(o, "onset", lab_report_onset(report, found->param));
  LAB_JSON_NUMBERS(o, {"statistic", found->statistic}, {"p_value", found->p_value}, {"explained", found->explained});
  list = cJSON_AddArrayToObject(o, "indistinguishable_from");
  for (i = 0; i < found->n_alike; i++)
    lab_json_say(list, "%s", pneu_effect_at(found->alike[i])->name);
  cJSON_AddStringToObject(o, "would_separate", found->n_alike ? report->separate[which].text : "");
}

static void add_unlisted(cJSON *to, const lab_report *report, const lab_found *found)
{
  const pneu_term *term = lab_report_term(report, found);
  cJSON *o = lab_json_append(to);
  char where[LAB_WHERE_TEXT], sentence[LAB_FOUND_SENTENCE];
  cJSON_AddStringToObject(o, "equation", lab_free_term_equation(term));
  cJSON_AddStringToObject(o, "argument", lab_term_arguments[term->argument].key);
  cJSON_AddStringToObject(o, "what", lab_free_term_what(term));
  cJSON_AddStringToObject(o, "where", lab_free_term_where(term, where));
  cJSON_AddStringToObject(o, "sentence", lab_report_found_sentence(report, found, sentence));
  LAB_JSON_NUMBERS(o, {"statistic", found->statistic}, {"degrees", found->degrees},
                   {"p_value", lab_report_chance(report, found)}, {"explained", found->explained});
}

static void add_errors(cJSON *to, const char *name, const lab_errors *errors)
{
  cJSON *o = cJSON_AddObjectToObject(to, name);
  int c;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++) {
    cJSON *channel;
    if (isnan(errors->rmse[c]))
      continue;
    channel = cJSON_AddObjectToObject(o, lab_channels[c].quantity);
    cJSON_AddNumberToObject(channel, "rmse", errors->rmse[c]);
    cJSON_AddStringToObject(channel, "unit", lab_channels[c].unit);
    cJSON_AddNumberToObject(channel, "in_noise", errors->in_noise[c]);
  }
}

/* What the log does that is none of the rig's: of each channel of a log's first run the noise that counts, and what it
 * was declared to be, both in SI. */
static void add_log(cJSON *root, const lab_unknowns *u)
{
  cJSON *list = cJSON_AddArrayToObject(root, "log"), *o, *channel;
  const lab_log *last = NULL;
  int e, c;
  for (e = 0; e < u->n_runs; e++) {
    const lab_run *x = &u->run[e];
    if (x->log == last)
      continue;
    last = x->log;
    o = lab_json_append(list);
    cJSON_AddStringToObject(o, "log", lab_file_name(x->log->path));
    LAB_JSON_NUMBERS(o, {"clock_step_s", x->log->clock_step}, {"clock_jitter_s", x->jitter});
    for (c = 0; c < x->n_channels; c++) {
      const int at = x->channel[c];
      channel = cJSON_AddObjectToObject(o, lab_channels[at].quantity);
      cJSON_AddStringToObject(channel, "unit", lab_channels[at].unit);
      LAB_JSON_NUMBERS(channel, {"noise", x->sigma[c]}, {"noise_declared", x->rig->noise[at]},
                       {"resolution", x->resolution[c]}, {"correlation", x->colour[c].memory * x->colour[c].share},
                       {"hum", x->log->hum[at].amplitude}, {"hum_hz", x->log->hum[at].frequency});
    }
  }
}

/* On each channel, how white the declared and the completed model leave it: the test that the verdict goes by. */
static void add_whiteness(cJSON *root, const lab_search_result *r)
{
  static const char *const name[LAB_STAGE_COUNT] = {"declared", "completed"};
  cJSON *list = cJSON_AddObjectToObject(root, "whiteness"), *o, *stage;
  int c, i;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++) {
    if (isnan(r->after.rmse[c]))
      continue;
    o = cJSON_AddObjectToObject(list, lab_channels[c].quantity);
    for (i = 0; i < LAB_STAGE_COUNT; i++) {
      const lab_whiteness *w = &r->left[i][c].whiteness;
      stage = cJSON_AddObjectToObject(o, name[i]);
      LAB_JSON_NUMBERS(stage, {"lag1", w->correlation[1]}, {"statistic", w->statistic}, {"degrees", w->degrees},
                       {"p_value", w->p_value});
      cJSON_AddBoolToObject(stage, "white", lab_is_white(w));
    }
  }
}

/* Errors before and after on what was held out, and on each of its logs. */
static void add_holdout(cJSON *to, const lab_report *report)
{
  cJSON *o = cJSON_AddObjectToObject(to, "holdout"), *list;
  int i;
  add_errors(o, "before", &report->holdout_before);
  add_errors(o, "after", &report->holdout_after);
  list = cJSON_AddArrayToObject(o, "logs");
  for (i = 0; i < report->n_held; i++) {
    cJSON *log = lab_json_append(list);
    cJSON_AddStringToObject(log, "log", report->held[i].name);
    add_errors(log, "before", &report->held[i].before);
    add_errors(log, "after", &report->held[i].after);
  }
}

static void add_parameter(cJSON *to, const lab_report *report, int j)
{
  cJSON *o = add_fitted(to, report->completed->unknown[j].name, report, j);
  lab_deviation d;
  if (lab_deviation_of(report->rig, report->completed, &report->result->fit, j, &d))
    LAB_JSON_NUMBERS(o, {"declared", d.declared}, {"tolerance", d.tolerance});
}

static void add_parameters(cJSON *to, const lab_report *report)
{
  const lab_unknowns *u = report->completed;
  cJSON *o = cJSON_AddObjectToObject(to, "parameters");
  char undetermined[LAB_FIT_UNDETERMINED_TEXT];
  int j;
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].kind == LAB_UNKNOWN_PARAM)
      add_parameter(o, report, j);
  lab_report_undetermined(report, undetermined);
  if (*undetermined)
    cJSON_AddStringToObject(to, "undetermined", undetermined);
}

static void add_candidates(cJSON *to, const lab_search_result *r)
{
  const lab_scores *scores = &r->scores;
  cJSON *list = cJSON_AddArrayToObject(to, "candidates");
  int i;
  for (i = 0; i < scores->n; i++) {
    const lab_score *c = &scores->of[i];
    cJSON *o = lab_json_append(list);
    const pneu_param_info info = lab_param_info(c->param);
    cJSON_AddStringToObject(o, "effect", pneu_effect_at(c->effect)->name);
    cJSON_AddStringToObject(o, "parameter", info.name);
    LAB_JSON_NUMBERS(o, {"statistic", c->statistic}, {"p_value", c->p_value},
                     {"explained", lab_report_refit_explains(r, c)}, {"explained_by_slope", c->explained},
                     {"visible", c->visible});
  }
}

/* Whether the rig is as declared, and what is not. */
static void add_condition(cJSON *root, const lab_report *report)
{
  const lab_deviations *all = &report->deviations;
  cJSON *list;
  int i;
  if (!report->changes) /* with a baseline the condition is whether anything has changed */
    cJSON_AddStringToObject(root, "condition", lab_condition_text(all->condition));
  list = cJSON_AddArrayToObject(root, "deviations");
  for (i = 0; i < all->n; i++) {
    const lab_deviation *d = &all->of[i];
    cJSON *o = lab_json_append(list);
    cJSON_AddStringToObject(o, "parameter", d->name);
    LAB_JSON_NUMBERS(o, {"declared", d->declared}, {"found", d->found});
    add_unit_and_interval(o, d->unit, d->lower, d->upper);
    LAB_JSON_NUMBERS(o, {"ratio", d->ratio}, {"tolerance", d->tolerance});
    cJSON_AddBoolToObject(o, "beyond", d->beyond);
    cJSON_AddBoolToObject(o, "held", d->held);
    add_onset(o, "onset", lab_report_onset(report, d->param));
  }
}

static cJSON *add_model(cJSON *list, const char *name, double chi2, double bic)
{
  cJSON *o = lab_json_append(list);
  cJSON_AddStringToObject(o, "model", name);
  LAB_JSON_NUMBERS(o, {"chi2", chi2}, {"bic", bic});
  return o;
}

/* The way from the declared model to the final one, with the held-out error of each; and every model that was tried. */
static void add_steps(cJSON *root, const lab_report *report)
{
  const lab_search_result *r = report->result;
  cJSON *list = cJSON_AddArrayToObject(root, "path");
  int i;
  for (i = 0; i < r->n_path; i++) {
    cJSON *o = add_model(list, r->path[i].name, r->path[i].chi2, r->path[i].bic);
    add_errors(o, "error", &r->path[i].errors);
    if (report->has_holdout)
      add_errors(o, "holdout", &report->holdout_path[i]);
  }
  list = cJSON_AddArrayToObject(root, "steps");
  for (i = 0; i < r->n_steps; i++)
    add_model(list, r->step[i].name, r->step[i].chi2, r->step[i].bic);
}

/* Figures of merit of what was measured, and of what the completed model does in its place. */
static void add_metrics(cJSON *to, const lab_report *report)
{
  cJSON *o;
  if (!report->measured)
    return;
  o = cJSON_AddObjectToObject(to, "metrics");
  cJSON_AddStringToObject(o, "step_signal", lab_metrics_step_signal(report->measured->command));
  cJSON_AddStringToObject(o, "static_signal", lab_metrics_static_signal(report->measured->command));
  cJSON_AddItemToObject(o, "measured", lab_metrics_object(report->measured));
  cJSON_AddItemToObject(o, "predicted", lab_metrics_object(report->predicted));
}

/* What differs from log to log, if anything does. */
static void add_own(cJSON *root, const lab_search_result *result)
{
  cJSON *names = result->n_own > 0 ? cJSON_AddArrayToObject(root, "per_log") : NULL;
  char name[LAB_PARAM_NAME_TEXT];
  int i;
  for (i = 0; i < result->n_own; i++)
    lab_json_say(names, "%s", lab_fit_name(result->own[i], name));
}

static cJSON *json_of(const lab_report *report)
{
  const lab_search_result *result = report->result;
  cJSON *root = cJSON_CreateObject(), *o;
  char sentence[LAB_SENTENCE_TEXT];
  int i;
  lab_report_sentence(report, sentence);
  cJSON_AddStringToObject(root, "verdict", lab_verdict_text(result->verdict));
  cJSON_AddStringToObject(root, "sentence", sentence);
  if (lab_report_doubt(report))
    cJSON_AddStringToObject(root, "doubt", lab_report_doubt(report));
  cJSON_AddBoolToObject(root, "complete", !result->cut_short);
  if (report->changes)
    add_changes(report->changes, root);
  o = cJSON_AddArrayToObject(root, "found");
  for (i = 0; i < result->n_found; i++)
    if (result->found[i].effect >= 0)
      add_found(o, report, i);
  o = cJSON_AddArrayToObject(root, "unlisted");
  for (i = 0; i < result->n_found; i++)
    if (result->found[i].term >= 0)
      add_unlisted(o, report, &result->found[i]);
  add_own(root, result);
  add_condition(root, report);
  add_parameters(root, report);
  o = cJSON_AddObjectToObject(root, "error");
  add_errors(o, "before", &result->before);
  add_errors(o, "after", &result->after);
  if (report->has_holdout)
    add_holdout(o, report);
  add_whiteness(root, result);
  add_log(root, report->completed);
  add_candidates(root, result);
  o = cJSON_AddArrayToObject(root, "significant_but_small");
  for (i = 0; i < result->n_listed; i++)
    lab_json_say(o, "%s", pneu_effect_at(result->listed[i])->name);
  if (result->has_small)
    lab_json_say(o, "unlisted:%s", lab_free_term_equation(&result->small));
  if (result->sound_until > 0)
    cJSON_AddNumberToObject(root, "sound_until_s", result->sound_until);
  if (report->next.kind == LAB_ADVICE_TEST)
    cJSON_AddStringToObject(root, "record_next", report->next.text);
  add_steps(root, report);
  lab_report_limits(report, cJSON_AddArrayToObject(root, "limitations"));
  add_metrics(root, report);
  LAB_JSON_NUMBERS(cJSON_AddObjectToObject(root, "timing"), {"fit_s", report->fit_s}, {"trace_s", report->trace_s},
                   {"total_s", report->total_s});
  return root;
}

int lab_report_json(FILE *file, const lab_sources *from, lab_error *error)
{
  return lab_json_write(file, json_of(from->report), "report.json", error);
}

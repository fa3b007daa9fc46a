/* report.json */
#include <math.h>
#include <stdio.h>

#include <cjson/cJSON.h>

#include "../base/quantile.h"
#include "../metrics/metricstext.h"
#include "../rig/rigterm.h"
#include "../trace/unlisted.h"
#include "loopfiles.h"

static void add_number(cJSON *to, const char *name, double value)
{
  if (isfinite(value))
    cJSON_AddNumberToObject(to, name, value);
  else
    cJSON_AddNullToObject(to, name);
}

static cJSON *add_interval(cJSON *to, const char *name, double value, const char *unit, double low, double high)
{
  cJSON *o = cJSON_AddObjectToObject(to, name), *ci;
  add_number(o, "value", value);
  cJSON_AddStringToObject(o, "unit", unit);
  ci = cJSON_AddArrayToObject(o, "ci95");
  cJSON_AddItemToArray(ci, isfinite(low) ? cJSON_CreateNumber(low) : cJSON_CreateNull());
  cJSON_AddItemToArray(ci, isfinite(high) ? cJSON_CreateNumber(high) : cJSON_CreateNull());
  return o;
}

static void add_effect_param(cJSON *to, const lab_story *story, int param)
{
  const int j = param < 0 ? -1 : lab_unknowns_find(story->completed, param);
  pneu_param_info info;
  if (j < 0)
    return;
  pneu_param_describe(param, &info);
  add_interval(to, info.name, story->completed->unknown[j].value, info.unit, story->result->fit.low[j],
               story->result->fit.high[j]);
}

static void add_found(cJSON *to, const lab_story *story, int which)
{
  const lab_found *found = &story->result->found[which];
  const pneu_effect *effect = pneu_effect_at(found->effect);
  cJSON *o = cJSON_CreateObject(), *list;
  int i;
  cJSON_AddItemToArray(to, o);
  cJSON_AddStringToObject(o, "effect", effect->name);
  cJSON_AddStringToObject(o, "equation", effect->equation);
  list = cJSON_AddObjectToObject(o, "parameters");
  add_effect_param(list, story, found->param);
  add_effect_param(list, story, found->shape);
  add_number(o, "statistic", found->statistic);
  add_number(o, "p_value", found->p_value);
  add_number(o, "explained", found->explained);
  list = cJSON_AddArrayToObject(o, "indistinguishable_from");
  for (i = 0; i < found->n_alike; i++)
    cJSON_AddItemToArray(list, cJSON_CreateString(pneu_effect_at(found->alike[i])->name));
  cJSON_AddStringToObject(o, "would_separate", found->n_alike ? story->separate[which].text : "");
}

static void add_unlisted(cJSON *to, const lab_story *story, const lab_found *found)
{
  const pneu_term *term = &story->completed->rig.term[found->term];
  cJSON *o = cJSON_CreateObject();
  char where[LAB_WHERE_TEXT];
  cJSON_AddItemToArray(to, o);
  cJSON_AddStringToObject(o, "equation", lab_unlisted_equation(term));
  cJSON_AddStringToObject(o, "argument", lab_term_arguments[term->argument].key);
  cJSON_AddStringToObject(o, "what", lab_unlisted_what(term));
  cJSON_AddStringToObject(o, "where", lab_unlisted_where(term, where));
  add_number(o, "statistic", found->statistic);
  add_number(o, "degrees", found->degrees);
  add_number(o, "p_value", fmin(1, lab_slot_tests(term) * lab_chi2_tail(found->statistic, found->degrees)));
  add_number(o, "explained", found->explained);
}

/* "unlisted:force" */
static void add_small_term(cJSON *list, const pneu_term *term)
{
  char text[40];
  snprintf(text, sizeof text, "unlisted:%s", lab_unlisted_equation(term));
  cJSON_AddItemToArray(list, cJSON_CreateString(text));
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
    add_number(channel, "rmse", errors->rmse[c]);
    cJSON_AddStringToObject(channel, "unit", lab_channels[c].unit);
    add_number(channel, "in_noise", errors->in_noise[c]);
  }
}

/* Errors before and after on what was held out, and on each of its logs. */
static void add_holdout(cJSON *to, const lab_story *story)
{
  cJSON *o = cJSON_AddObjectToObject(to, "holdout"), *list;
  int i;
  add_errors(o, "before", &story->holdout_before);
  add_errors(o, "after", &story->holdout_after);
  list = cJSON_AddArrayToObject(o, "logs");
  for (i = 0; i < story->n_held; i++) {
    cJSON *log = cJSON_CreateObject();
    cJSON_AddItemToArray(list, log);
    cJSON_AddStringToObject(log, "log", story->held[i].name);
    add_errors(log, "before", &story->held[i].before);
    add_errors(log, "after", &story->held[i].after);
  }
}

static void add_parameters(cJSON *to, const lab_story *story)
{
  const lab_unknowns *u = story->completed;
  const lab_fit_result *fit = &story->result->fit;
  cJSON *o = cJSON_AddObjectToObject(to, "parameters");
  char undetermined[LAB_FIT_REMARK];
  int j;
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].kind == LAB_UNKNOWN_PARAM)
      add_interval(o, u->unknown[j].name, u->unknown[j].value, u->unknown[j].unit, fit->low[j], fit->high[j]);
  lab_story_undetermined(story, undetermined);
  if (*undetermined)
    cJSON_AddStringToObject(to, "undetermined", undetermined);
}

static void add_candidates(cJSON *to, const lab_trace_result *trace)
{
  cJSON *list = cJSON_AddArrayToObject(to, "candidates");
  int i;
  for (i = 0; i < trace->n; i++) {
    const lab_candidate *c = &trace->candidate[i];
    cJSON *o = cJSON_CreateObject();
    pneu_param_info info;
    pneu_param_describe(c->param, &info);
    cJSON_AddItemToArray(list, o);
    cJSON_AddStringToObject(o, "effect", pneu_effect_at(c->effect)->name);
    cJSON_AddStringToObject(o, "parameter", info.name);
    add_number(o, "statistic", c->statistic);
    add_number(o, "p_value", c->p_value);
    add_number(o, "explained", c->explained);
    add_number(o, "visible", c->visible);
  }
}

static cJSON *add_model(cJSON *list, const char *name, double chi2, double bic)
{
  cJSON *o = cJSON_CreateObject();
  cJSON_AddItemToArray(list, o);
  cJSON_AddStringToObject(o, "model", name);
  add_number(o, "chi2", chi2);
  add_number(o, "bic", bic);
  return o;
}

/* The way from the declared model to the final one, with the held-out error of each; and every model that was tried. */
static void add_steps(cJSON *root, const lab_story *story)
{
  const lab_loop_result *r = story->result;
  cJSON *list = cJSON_AddArrayToObject(root, "path");
  int i;
  for (i = 0; i < r->n_path; i++) {
    cJSON *o = add_model(list, r->path[i].name, r->path[i].chi2, r->path[i].bic);
    add_errors(o, "error", &story->fitted_path[i]);
    if (story->has_holdout)
      add_errors(o, "holdout", &story->holdout_path[i]);
  }
  list = cJSON_AddArrayToObject(root, "steps");
  for (i = 0; i < r->n_steps; i++)
    add_model(list, r->step[i].name, r->step[i].chi2, r->step[i].bic);
}

/* Figures of merit of what was measured, and of what the completed model does in its place. */
static void add_metrics(cJSON *to, const lab_story *story)
{
  cJSON *o;
  if (!story->measured)
    return;
  o = cJSON_AddObjectToObject(to, "metrics");
  cJSON_AddStringToObject(o, "step_signal", lab_metrics_step_signal(story->measured->command));
  cJSON_AddStringToObject(o, "static_signal", lab_metrics_static_signal(story->measured->command));
  cJSON_AddItemToObject(o, "measured", lab_metrics_object(story->measured));
  cJSON_AddItemToObject(o, "predicted", lab_metrics_object(story->predicted));
}

static cJSON *json_of(const lab_story *story)
{
  const lab_loop_result *result = story->result;
  cJSON *root = cJSON_CreateObject(), *o;
  char sentence[LAB_SENTENCE_TEXT];
  int i;
  lab_story_sentence(story, sentence, sizeof sentence);
  cJSON_AddStringToObject(root, "verdict", lab_verdict_text(result->verdict));
  cJSON_AddStringToObject(root, "sentence", sentence);
  o = cJSON_AddArrayToObject(root, "found");
  for (i = 0; i < result->n_found; i++)
    if (result->found[i].effect >= 0)
      add_found(o, story, i);
  o = cJSON_AddArrayToObject(root, "unlisted");
  for (i = 0; i < result->n_found; i++)
    if (result->found[i].term >= 0)
      add_unlisted(o, story, &result->found[i]);
  add_parameters(root, story);
  o = cJSON_AddObjectToObject(root, "error");
  add_errors(o, "before", &result->before);
  add_errors(o, "after", &result->after);
  if (story->has_holdout)
    add_holdout(o, story);
  add_candidates(root, &result->trace);
  o = cJSON_AddArrayToObject(root, "significant_but_small");
  for (i = 0; i < result->n_listed; i++)
    cJSON_AddItemToArray(o, cJSON_CreateString(pneu_effect_at(result->listed[i])->name));
  if (result->has_small)
    add_small_term(o, &result->small);
  if (story->next.kind == LAB_ADVICE_TRIAL)
    cJSON_AddStringToObject(root, "record_next", story->next.text);
  add_steps(root, story);
  lab_story_limits(story, cJSON_AddArrayToObject(root, "limitations"));
  add_metrics(root, story);
  o = cJSON_AddObjectToObject(root, "timing");
  add_number(o, "fit_s", story->fit_s);
  add_number(o, "trace_s", story->trace_s);
  add_number(o, "total_s", story->total_s);
  return root;
}

int lab_story_json(const lab_story *story, const char *folder, lab_error *error)
{
  lab_outfile out;
  cJSON *root;
  char *text;
  if (lab_report_open(folder, "report.json", &out, error))
    return error->status;
  root = json_of(story);
  text = cJSON_Print(root);
  cJSON_Delete(root);
  if (!text) {
    lab_out_abandon(&out);
    return lab_fail_memory(error, "report.json");
  }
  fprintf(out.file, "%s\n", text);
  cJSON_free(text);
  return lab_out_close(&out, error);
}

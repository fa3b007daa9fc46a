#include "loopfiles.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cjson/cJSON.h>

#include "../metrics/metricstext.h"
#include "../base/outfile.h"
#include "../base/quantile.h"
#include "../rig/rigterm.h"
#include "../trace/unlisted.h"

static int open_in(const char *folder, const char *name, lab_outfile *out, lab_error *error)
{
  char path[LAB_PATH_TEXT + 32];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  return lab_out_open(out, path, error);
}

/* ---- report.json ---- */

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
  int j;
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].kind == LAB_UNKNOWN_PARAM)
      add_interval(o, u->unknown[j].name, u->unknown[j].value, u->unknown[j].unit, fit->low[j], fit->high[j]);
  if (fit->remark[0])
    cJSON_AddStringToObject(to, "undetermined", fit->remark);
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

static void add_limitations(cJSON *to, const lab_remarks *remarks)
{
  cJSON *list = cJSON_AddArrayToObject(to, "limitations");
  int i;
  for (i = 0; remarks && i < remarks->n; i++)
    cJSON_AddItemToArray(list, cJSON_CreateString(remarks->text[i]));
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
  add_limitations(root, story->remarks);
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
  if (open_in(folder, "report.json", &out, error))
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

/* ---- model.cfg, model.h ---- */

int lab_story_model(const lab_story *story, const char *folder, lab_error *error)
{
  lab_rig rig = *story->rig;
  lab_outfile out;
  if (open_in(folder, "model.cfg", &out, error))
    return error->status;
  rig = story->completed->rig;
  rig.friction = LAB_FRICTION_COULOMB; /* its effects are written with their sizes */
  lab_rig_write(out.file, &rig, "The completed model, by closeloop.");
  return lab_out_close(&out, error);
}

int lab_story_header(const lab_story *story, const char *folder, lab_error *error)
{
  lab_outfile out;
  if (open_in(folder, "model.h", &out, error))
    return error->status;
  fprintf(out.file,
          "/* The completed model of %s, by closeloop; for libpneu " PNEU_VERSION " with its whole catalogue.\n"
          " * const pneu_params p = MODEL_PARAMS; const pneu_laws law = MODEL_LAWS; */\n",
          story->rig->name);
  lab_rig_write_c(out.file, &story->completed->rig);
  return lab_out_close(&out, error);
}

/* ---- residual.csv ---- */

/* Whether any experiment measures a channel. */
static int is_measured(const lab_unknowns *u, int channel)
{
  int e, c, any = 0;
  for (e = 0; e < u->n_experiments; e++)
    for (c = 0; c < u->experiment[e].n_channels; c++)
      any |= u->experiment[e].channel[c] == channel;
  return any;
}

static void residual_head(FILE *file, const lab_unknowns *u)
{
  int c;
  fputs("run [1],t [s]", file);
  for (c = 0; c < LAB_CHANNEL_COUNT; c++) {
    const lab_channel_info *info = &lab_channels[c];
    if (is_measured(u, c))
      fprintf(file, ",%s [%s],%s_before [%s],%s_after [%s],%s_residual_before [1],%s_residual_after [1]", info->key,
              info->unit, info->key, info->unit, info->key, info->unit, info->key, info->key);
  }
  fputc('\n', file);
}

/* One row of one channel; empty where the experiment does not have it, and in a gap. */
static void residual_cell(FILE *file, const lab_experiment *x, int channel, size_t i, const double *before,
                          const double *after)
{
  int c = 0;
  size_t at;
  double y;
  while (c < x->n_channels && x->channel[c] != channel)
    c++;
  y = c < x->n_channels ? lab_experiment_measured(x, c, i) : (double)NAN;
  at = (size_t)c * x->n + i;
  if (isnan(y))
    fputs(",,,,,", file);
  else
    fprintf(file, ",%.9g,%.9g,%.9g,%.5g,%.5g", y, y - before[at] * x->sigma[c], y - after[at] * x->sigma[c], before[at],
            after[at]);
}

static void residual_rows(FILE *file, const lab_unknowns *u, const double *before, const double *after)
{
  int e, c;
  for (e = 0; e < u->n_experiments; e++) {
    const lab_experiment *x = &u->experiment[e];
    size_t i;
    for (i = 0; i < x->n; i++) {
      fprintf(file, "%d,%.9g", e + 1, x->log->value[LAB_CHANNEL_TIME][x->first + i]);
      for (c = 0; c < LAB_CHANNEL_COUNT; c++)
        if (is_measured(u, c))
          residual_cell(file, x, c, i, before, after);
      fputc('\n', file);
    }
    before += x->n * (size_t)x->n_channels;
    after += x->n * (size_t)x->n_channels;
  }
}

int lab_story_residual(const lab_story *story, const char *folder, lab_error *error)
{
  const lab_unknowns *u = story->completed;
  double *before = malloc((u->n_rows + 1) * sizeof *before);
  double *after = malloc((u->n_rows + 1) * sizeof *after);
  lab_outfile out;
  int status = before && after ? LAB_OK : lab_fail_memory(error, "residuals");
  if (status == LAB_OK)
    status = lab_unknowns_errors(story->declared, before, error);
  if (status == LAB_OK)
    status = lab_unknowns_errors(u, after, error);
  if (status == LAB_OK)
    status = open_in(folder, "residual.csv", &out, error);
  if (status == LAB_OK) {
    residual_head(out.file, u);
    residual_rows(out.file, u, before, after);
    status = lab_out_close(&out, error);
  }
  free(before);
  free(after);
  return status;
}

/* ---- The sentence ---- */

/* "chamber_leak", "dry friction at x = 11 .. 13 mm, both directions" */
static void name_found(const lab_story *story, const lab_found *found, char *text, size_t size)
{
  char where[LAB_WHERE_TEXT];
  const pneu_term *term;
  if (found->effect >= 0) {
    snprintf(text, size, "%s", pneu_effect_at(found->effect)->name);
    return;
  }
  term = &story->completed->rig.term[found->term];
  snprintf(text, size, "something that has no name here (%s, %s)", lab_unlisted_what(term),
           lab_unlisted_where(term, where));
}

static const char *found_names(const lab_story *story, char *text, size_t size)
{
  const lab_loop_result *r = story->result;
  size_t used = 0;
  int i;
  for (i = 0; i < r->n_found && used < size; i++) {
    char name[LAB_WHERE_TEXT + 128];
    name_found(story, &r->found[i], name, sizeof name);
    used += (size_t)snprintf(text + used, size - used, "%s%s", i ? " and " : "", name);
  }
  return text;
}

void lab_story_sentence(const lab_story *story, char *text, size_t size)
{
  const lab_loop_result *r = story->result;
  const double before = sqrt(r->before.chi2 / (double)r->before.n), after = sqrt(r->after.chi2 / (double)r->after.n);
  char names[512];
  if (story->remarks && story->remarks->doubt)
    snprintf(text, size, "Undecided: %s", story->remarks->text[story->remarks->doubt - 1]);
  else if (r->verdict == LAB_VERDICT_UNDECIDED && r->n_found)
    snprintf(text, size,
             "Undecided: %s comes nearest and lowers the error from %.2f to %.2f times the noise, but what is left is "
             "not noise.",
             found_names(story, names, sizeof names), before, after);
  else if (r->verdict == LAB_VERDICT_UNDECIDED)
    snprintf(text, size,
             "Undecided: what is left, %.2f times the noise, is not noise, and the catalogue does not explain it.",
             after);
  else if (r->window > 0)
    snprintf(text, size,
             "The model lacks %s: the stem sticks and slips, and with it the model does so as much as the log, though "
             "no model keeps in step with every slip.",
             found_names(story, names, sizeof names));
  else if (r->n_found > 0)
    snprintf(text, size, "The model lacks %s: with it the error falls from %.2f to %.2f times the noise.",
             found_names(story, names, sizeof names), before, after);
  else
    snprintf(text, size, "Nothing of the catalogue is missing: the declared model leaves %.2f times the noise%s.",
             before, r->n_listed || r->has_small ? ", and what is significant would not change that" : "");
}

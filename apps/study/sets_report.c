#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "../lab/base/config.h"
#include "../lab/base/json.h"
#include "../lab/base/names.h"
#include "../lab/base/template.h"
#include "../lab/base/text.h"
#include "../lab/base/units.h"
#include "../lab/log/channel.h"
#include "../lab/rig/rig.h"
#include "sets.h"

#include "study/measured/report.md.inc" /* report_md; made by make */

enum { PATH_TEXT = 1024, NAMES_TEXT = 512 };

/* The error of a model: NaN where the report has none. */
typedef struct model_error {
  double value, in_noise; /* value in the unit asked for */
} model_error;

/* ---- What report.json says ---- */

/* report.json of a set.  Returns: NULL if there is none; else to be freed with cJSON_Delete */
static cJSON *json_of(const char *out_dir, const config_setting_t *set)
{
  char path[PATH_TEXT];
  lab_error ignored;
  lab_text text;
  cJSON *json;
  snprintf(path, sizeof path, "%s/%s/report.json", out_dir, sets_text(set, "name"));
  if (lab_text_read(path, &text, &ignored))
    return NULL;
  json = cJSON_ParseWithLength(text.data, text.size);
  lab_text_free(&text);
  return json;
}

/* A member of an object, by the keys on the way to it, which end with NULL; NULL if there is none, also for an object
 * that is NULL. */
static const cJSON *at_keys(const cJSON *at, ...)
{
  const char *key;
  va_list keys;
  va_start(keys, at);
  while ((key = va_arg(keys, const char *)) != NULL)
    at = cJSON_GetObjectItemCaseSensitive(at, key);
  va_end(keys);
  return at;
}

/* A number or text of an object; NaN or NULL if there is none. */
static double number_of(const cJSON *at, const char *key)
{
  return cJSON_GetNumberValue(at_keys(at, key, NULL));
}

static const char *words_of(const cJSON *at, const char *key)
{
  return cJSON_GetStringValue(at_keys(at, key, NULL));
}

/* In: errors  an object of channels ("pressure"), each with rmse, unit and in_noise */
static model_error channel_error(const cJSON *errors, const char *channel, const char *unit)
{
  const cJSON *found = at_keys(errors, channel, NULL);
  const char *own = words_of(found, "unit");
  model_error e = {(double)NAN, number_of(found, "in_noise")};
  double scale, offset;
  lab_error ignored;
  if (own && lab_unit_factor(own, unit, &scale, &offset, &ignored) == LAB_OK)
    e.value = scale * number_of(found, "rmse");
  return e;
}

/* A set with what its values are made from. */
typedef struct story {
  const sets_result *result;
  const config_setting_t *set;
  const char *out_dir;
  const cJSON *json; /* its report; NULL if it did not run */
  const char *channel, *unit;
  model_error before, after, held_before, held_after;
  double scale;         /* of its unit over SI */
  double noise, repeat; /* in its unit; NaN: not known */
} story;

/* ---- Numbers and errors ---- */

/* "0.123", "4711", "-" for NaN; good until the fourth call after this one. */
static const char *digits(double value)
{
  static char cell[4][32];
  static int turn;
  turn = (turn + 1) % 4;
  snprintf(cell[turn], sizeof *cell, isnan(value) ? "-" : fabs(value) < 999.5 ? "%.3g" : "%.0f", value);
  return cell[turn];
}

/* Numbers under names such as "mean worst". */
static void put_digits(cJSON *to, const char *names, ...)
{
  char name[32];
  va_list values;
  int n;
  va_start(values, names);
  for (; sscanf(names, "%31s%n", name, &n) == 1; names += n)
    lab_json_put(to, name, "%s", digits(va_arg(values, double)));
  va_end(values);
}

/* An error of a model: value and noise, and "115 Pa (16.5)" for a cell; nothing where there is none. */
static void put_error(cJSON *to, const char *name, model_error e, const char *unit)
{
  cJSON *item = isnan(e.value) ? NULL : cJSON_AddObjectToObject(to, name);
  if (!item)
    return;
  put_digits(item, "value in_noise", e.value, e.in_noise);
  if (isnan(e.in_noise))
    lab_json_put(item, "cell", "%s %s", digits(e.value), unit);
  else
    lab_json_put(item, "cell", "%s %s (%s)", digits(e.value), unit, digits(e.in_noise));
}

/* A list under a name, in an object with its length; nothing where it is empty. */
static void put_list(cJSON *to, const char *name, const char *items, cJSON *list)
{
  cJSON *item = cJSON_GetArraySize(list) ? cJSON_AddObjectToObject(to, name) : NULL;
  lab_json_put(item, "n", "%d", cJSON_GetArraySize(list));
  if (!cJSON_AddItemToObject(item, items, list))
    cJSON_Delete(list);
}

static model_error error_of(const story *s, const cJSON *errors)
{
  return channel_error(errors, s->channel, s->unit);
}

static model_error held_error(const story *s, const cJSON *model)
{
  return error_of(s, at_keys(model, "holdout", NULL));
}

static story story_of(const sets_result *result, const cJSON *json, const char *out_dir)
{
  const config_setting_t *set = result->set;
  const int channel = sets_channel(sets_text(set, "judged"));
  double offset;
  lab_error ignored;
  story s = {.result = result, .set = set, .out_dir = out_dir, .json = json, .channel = sets_text(set, "judged")};
  s.scale = (double)NAN;
  s.unit = sets_text(set, "unit");
  s.before = error_of(&s, at_keys(json, "error", "before", NULL));
  s.after = error_of(&s, at_keys(json, "error", "after", NULL));
  s.held_before = error_of(&s, at_keys(json, "error", "holdout", "before", NULL));
  s.held_after = error_of(&s, at_keys(json, "error", "holdout", "after", NULL));
  if (channel >= 0)
    lab_unit_factor(lab_channels[channel].unit, s.unit, &s.scale, &offset, &ignored);
  s.noise = s.before.value / s.before.in_noise;
  s.repeat = s.scale * result->repeat;
  return s;
}

/* Whether an error leaves nothing to explain: it is at most a fifth above what the sensor scatters, row by row, or what
 * the bench repeats. */
static int is_explained(const story *s, model_error e)
{
  return e.in_noise <= 1.2 || e.value <= 1.2 * s->repeat;
}

/* The error of the channel that was predicted and not fitted; it is that of a hold-out. */
static model_error check_error(const story *s, const char *when)
{
  model_error e =
      channel_error(at_keys(s->json, "error", when, NULL), sets_text(s->set, "check"), sets_text(s->set, "check_unit"));
  e.in_noise = (double)NAN;
  return e;
}

static void put_errors(const story *s, cJSON *to)
{
  put_digits(to, "noise repeat left", s->noise, s->repeat, s->after.in_noise);
  if (!isnan(s->repeat))
    put_digits(cJSON_AddObjectToObject(to, "repeats"), "value in_noise after held", s->repeat, s->repeat / s->noise,
               s->after.value / s->repeat, s->held_after.value / s->repeat);
  put_error(to, "before", s->before, s->unit);
  put_error(to, "after", s->after, s->unit);
  put_error(to, "held_before", s->held_before, s->unit);
  put_error(to, "held_after", s->held_after, s->unit);
  put_error(to, "check_before", check_error(s, "before"), sets_text(s->set, "check_unit"));
  put_error(to, "check_after", check_error(s, "after"), sets_text(s->set, "check_unit"));
}

/* ---- What was asked ---- */

static void put_logs(const config_setting_t *set, const char *key, const char *also_fitted, cJSON *to)
{
  const config_setting_t *logs = lab_config_member(set, key);
  cJSON *list = cJSON_CreateArray();
  int i;
  for (i = 0; i < config_setting_length(logs); i++) {
    const char *log = config_setting_get_string_elem(logs, i);
    lab_json_join(list, ", ", "%s%s", log, sets_is_fitted(set, log) ? also_fitted : "");
  }
  put_list(to, key, "logs", list);
}

/* The texts of its group as they are, and the logs. */
static void put_declared(const config_setting_t *set, cJSON *to)
{
  int i;
  for (i = 0; i < config_setting_length(set); i++) {
    const config_setting_t *member = config_setting_get_elem(set, (unsigned)i);
    if (config_setting_type(member) == CONFIG_TYPE_STRING)
      lab_json_put(to, config_setting_name(member), "%s", config_setting_get_string(member));
  }
  put_logs(set, "fit", "", to);
  put_logs(set, "holdout", " (rows that were not fitted)", to);
}

/* ---- Verdict and what was found ---- */

/* Verdicts in words of the table; the first column is closeloop's, and "fitted". */
static const char *const verdicts[][2] = {{"effect", "explained"},     {"unlisted", "explained, without a name"},
                                          {"none", "nothing missing"}, {"fitted", "explained on the runs fitted only"},
                                          {"undecided", "undecided"},  {"", "-"}};

enum { VERDICTS = sizeof verdicts / sizeof *verdicts };

/* What is left decides; where logs and rig file contradict each other, nothing does.  Returns: one of `verdicts` */
static const char *verdict_word(const story *s)
{
  if (words_of(s->json, "doubt") || !is_explained(s, s->after))
    return "undecided";
  if (!isnan(s->held_after.value) && !is_explained(s, s->held_after))
    return "fitted";
  if (cJSON_GetArraySize(at_keys(s->json, "unlisted", NULL)) > 0)
    return "unlisted";
  return cJSON_GetArraySize(at_keys(s->json, "found", NULL)) > 0 || at_keys(s->json, "per_log", NULL) ? "effect"
                                                                                                      : "none";
}

/* Returns: the last if there is no error to judge by */
static int verdict_of(const story *s)
{
  return lab_name_index(isnan(s->after.value) ? "" : verdict_word(s), verdicts, VERDICTS, sizeof *verdicts);
}

static void join(char names[NAMES_TEXT], const char *name)
{
  lab_append(names, NAMES_TEXT, "%s%s", *names ? ", " : "", name);
}

/* What was found: for the table with what is alike, for the sentence with what a term without a name acts on. */
static void put_found(const cJSON *json, cJSON *to, char names[NAMES_TEXT])
{
  const cJSON *unlisted = at_keys(json, "unlisted", NULL), *found, *other;
  cJSON *cell = cJSON_AddArrayToObject(to, "found"), *alike = cJSON_AddArrayToObject(to, "alike");
  char name[NAMES_TEXT];
  names[0] = '\0';
  cJSON_ArrayForEach(found, at_keys(json, "per_log", NULL))
  {
    snprintf(name, sizeof name, "a value of %s for each log", cJSON_GetStringValue(found));
    join(names, name);
    lab_json_join(cell, ", ", "%s", name);
  }
  cJSON_ArrayForEach(found, at_keys(json, "found", NULL))
  {
    const char *effect = words_of(found, "effect");
    name[0] = '\0';
    cJSON_ArrayForEach(other, at_keys(found, "indistinguishable_from", NULL)) join(name, cJSON_GetStringValue(other));
    join(names, effect);
    lab_json_join(cell, ", ", "%s%s%s%s", effect, *name ? " (or " : "", name, *name ? ")" : "");
    if (*name) {
      cJSON *item = lab_json_append(alike);
      lab_json_put(item, "others", "%s", name);
      lab_json_put(item, "effect", "%s", effect);
    }
  }
  if (cJSON_GetArraySize(unlisted) > 0)
    lab_json_join(cell, ", ", "a term without a name");
  cJSON_ArrayForEach(found, unlisted)
  {
    snprintf(name, sizeof name, "a term without a name (%s, %s)", words_of(found, "what"), words_of(found, "where"));
    join(names, name);
  }
}

static void put_verdict(const story *s, cJSON *to)
{
  const char *doubt = words_of(s->json, "doubt");
  const int verdict = verdict_of(s), is_open = !strcmp(verdicts[verdict][0], "undecided");
  char names[NAMES_TEXT];
  put_found(s->json, to, names);
  lab_json_put(to, "verdict", "%s", verdicts[verdict][1]);
  if (!strcmp(verdicts[verdict][0], "fitted"))
    cJSON_AddTrueToObject(to, "fitted_only");
  if (doubt)
    lab_json_put(to, "doubt", "%s", doubt);
  else if (is_open)
    lab_json_put(to, *names ? "nearest" : "unexplained", "%s", *names ? names : "yes");
  else
    lab_json_put(to, *names ? "lacking" : "complete", "%s", *names ? names : "yes");
}

/* An error of position as the pressure that makes up for it: spring rate over area, as declared. */
static void put_in_pressure(const story *s, const lab_rig *rig, cJSON *to)
{
  const char *unit = sets_text(s->set, "as_pressure");
  const double rate = (double)rig->params.spring_rate / (double)rig->params.area;
  double length, pressure, factor, offset;
  cJSON *item;
  lab_error ignored;
  if (!*unit || lab_unit_factor(s->unit, "m", &length, &offset, &ignored) ||
      lab_unit_factor("Pa", unit, &pressure, &offset, &ignored))
    return;
  factor = length * rate * pressure;
  item = cJSON_AddObjectToObject(to, "in_pressure");
  lab_json_put(item, "factor", "%.4g", factor);
  put_digits(item, "before after held_before held_after", factor * s->before.value, factor * s->after.value,
             factor * s->held_before.value, factor * s->held_after.value);
}

/* ---- Why: the way there, and the next best ---- */

static const char *name_of(const cJSON *model)
{
  return words_of(model, "model");
}

static const cJSON *last_of(const cJSON *list)
{
  return cJSON_GetArrayItem(list, cJSON_GetArraySize(list) - 1);
}

/* Share of the declared model's root chi-square that a model leaves [%]. */
static double root_chi2(const story *s, const cJSON *model)
{
  const cJSON *declared = cJSON_GetArrayItem(at_keys(s->json, "path", NULL), 0);
  return 100 * sqrt(number_of(model, "chi2") / number_of(declared, "chi2"));
}

static void put_way(const story *s, cJSON *to)
{
  const cJSON *model, *path = at_keys(s->json, "path", NULL);
  cJSON *list;
  if (cJSON_GetArraySize(path) < 2)
    return;
  list = cJSON_AddArrayToObject(cJSON_AddObjectToObject(to, "way"), "models");
  cJSON_ArrayForEach(model, path)
  {
    const model_error fitted = error_of(s, at_keys(model, "error", NULL)), held = held_error(s, model);
    cJSON *item;
    if (model->next && sets_within(name_of(model), name_of(model->next)) &&
        sets_within(name_of(model->next), name_of(model)))
      continue; /* the same effects refitted in another order */
    item = lab_json_append(list);
    lab_json_put(item, "model", "%s", name_of(model));
    put_digits(item, "fitted fitted_noise held held_noise", fitted.value, fitted.in_noise, held.value, held.in_noise);
  }
}

/* The model on the way whose error held out is lowest, where that of the final one is higher, to the digits shown.
 * Returns: NULL where the final one is lowest, or nothing was held out */
static const cJSON *best_on_the_way(const story *s)
{
  const cJSON *model, *best = NULL;
  cJSON_ArrayForEach(model, at_keys(s->json, "path", NULL))
  {
    if (!best || held_error(s, model).value < held_error(s, best).value)
      best = model;
  }
  return best && strcmp(digits(held_error(s, best).value), digits(s->held_after.value)) != 0 ? best : NULL;
}

/* An effect that lowers the error of what was fitted and raises that of what was held out has learnt these logs only.
 */
static void put_best(const story *s, cJSON *to)
{
  const cJSON *best = best_on_the_way(s);
  cJSON *item = best ? cJSON_AddObjectToObject(to, "best") : NULL;
  if (!item)
    return;
  lab_json_put(item, "model", "%s", name_of(best));
  put_digits(item, "held end", held_error(s, best).value, s->held_after.value);
}

/* Of the models tried the one of lowest criterion that does without a part of the final one. */
static void put_rival(const story *s, cJSON *to)
{
  const cJSON *path = at_keys(s->json, "path", NULL), *steps = at_keys(s->json, "steps", NULL);
  const cJSON *last = last_of(path), *model, *next = NULL;
  cJSON *item;
  if (cJSON_GetArraySize(path) > 1)
    cJSON_ArrayForEach(model, steps)
    {
      if (!sets_within(name_of(last), name_of(model)) && (!next || number_of(model, "bic") < number_of(next, "bic")))
        next = model;
    }
  if (!next)
    return;
  item = cJSON_AddObjectToObject(to, "rival");
  lab_json_put(item, "tried", "%d", cJSON_GetArraySize(steps));
  lab_json_put(item, "model", "%s", name_of(next));
  put_digits(item, "left own bic own_bic", root_chi2(s, next), root_chi2(s, last), number_of(next, "bic"),
             number_of(last, "bic"));
}

/* Whether a model of the same name, tried under another law of the effect, leaves less; or as much and came first. */
static int is_beaten(const cJSON *json, const cJSON *model)
{
  const double chi2 = number_of(model, "chi2");
  const cJSON *other;
  int before = 1;
  cJSON_ArrayForEach(other, at_keys(json, "steps", NULL))
  {
    if (other == model)
      before = 0;
    else if (!strcmp(name_of(other), name_of(model)) &&
             (number_of(other, "chi2") < chi2 || (before && number_of(other, "chi2") <= chi2)))
      return 1;
  }
  return 0;
}

/* What each effect does alone, if it does anything. */
static void put_singles(const story *s, cJSON *to)
{
  const cJSON *model, *steps = at_keys(s->json, "steps", NULL);
  cJSON *list = cJSON_CreateArray();
  cJSON_ArrayForEach(model, steps)
  {
    if (!strstr(name_of(model), " + ") && model != steps->child && !is_beaten(s->json, model) &&
        root_chi2(s, model) < 99)
      lab_json_join(list, ", ", "%s %s %%", name_of(model), digits(root_chi2(s, model)));
  }
  put_list(to, "singles", "models", list);
}

/* ---- Parameters ---- */

/* Whether the 95 % interval of a parameter is known.  Out: low, high */
static int interval_of(const cJSON *p, double *low, double *high)
{
  const cJSON *ci = at_keys(p, "ci95", NULL);
  *low = cJSON_GetNumberValue(cJSON_GetArrayItem(ci, 0));
  *high = cJSON_GetNumberValue(cJSON_GetArrayItem(ci, 1));
  return !isnan(*low) && !isnan(*high);
}

/* "name = value (low to high) unit"; no interval where the value is at a bound. */
static void put_parameters(const cJSON *json, cJSON *to)
{
  const char *remark = words_of(json, "undetermined");
  cJSON *list = cJSON_AddArrayToObject(to, "parameters");
  const cJSON *p;
  cJSON_ArrayForEach(p, at_keys(json, "parameters", NULL))
  {
    const char *unit = words_of(p, "unit");
    const double value = number_of(p, "value");
    char interval[64] = "";
    double low, high;
    if (isnan(value))
      continue;
    if (interval_of(p, &low, &high) && low < high)
      snprintf(interval, sizeof interval, " (%.4g to %.4g)", low, high);
    lab_json_say(list, "%s = %.4g%s %s", p->string, value, interval, unit && strcmp(unit, "1") ? unit : "(a ratio)");
  }
  if (remark)
    lab_json_put(to, "undetermined", "%s", remark);
}

/* A parameter that the source gives too: declared in the rig file as the source has it, fitted nonetheless. */
static int put_given(const story *s, lab_rig *rig, cJSON *to, lab_error *error)
{
  const char *name = sets_text(s->set, "given");
  const cJSON *p = at_keys(s->json, "parameters", name, NULL);
  const int i = pneu_param_find(name);
  double given, low, high;
  if (!*name)
    return LAB_OK;
  if (i < 0 || !interval_of(p, &low, &high))
    return lab_config_fail(s->set, error, "given: %s is not among the parameters that were fitted", name);
  given = lab_param_value(rig, i);
  lab_json_put(to, "known", "%s = %.4g %s; found %+.2g %% from it, which is %s", name, given, lab_param_info(i).unit,
               100 * (number_of(p, "value") / given - 1), given >= low && given <= high ? "within" : "outside");
  return LAB_OK;
}

/* ---- What is left, run by run, and the logs held out ---- */

static void put_left(const sets_left *left, double scale, double noise, cJSON *item)
{
  put_digits(item, "rms in_noise mean worst worst_t", scale * left->rms, scale * left->rms / noise, scale * left->mean,
             scale * left->worst, left->worst_t);
  lab_json_put(item, "lag1", "%.2f", left->lag1);
}

/* A row a run of one channel.  In: noise  in `unit`; NaN: the channel was not fitted */
static int put_channel(const config_setting_t *set, const table *residual, const char *quantity, const char *unit,
                       double noise, cJSON *list, lab_error *error)
{
  const config_setting_t *logs = lab_config_member(set, "fit");
  const int channel = sets_channel(quantity);
  const int runs = sets_left_runs(residual), is_log = config_setting_length(logs) == runs;
  double scale, offset;
  int run;
  if (channel < 0)
    return lab_config_fail(set, error, "%s is no channel", quantity);
  if (lab_unit_factor(lab_channels[channel].unit, unit, &scale, &offset, error))
    return error->status;
  for (run = 1; run <= runs; run++) {
    sets_left left;
    cJSON *item;
    if (sets_left_of(residual, run, lab_channels[channel].key, &left, error))
      return error->status;
    if (left.n == 0)
      continue;
    item = lab_json_append(list);
    if (is_log)
      lab_json_put(item, "run", "%s", sets_log(set, run - 1));
    else
      lab_json_put(item, "run", "run %d", run);
    lab_json_put(item, "channel", "%s [%s]", quantity, unit);
    put_left(&left, scale, noise, item);
  }
  return LAB_OK;
}

static int put_residual(const story *s, cJSON *to, lab_error *error)
{
  const char *check = sets_text(s->set, "check");
  cJSON *list = cJSON_AddArrayToObject(to, "left_by_run");
  char path[PATH_TEXT];
  table residual;
  int status;
  snprintf(path, sizeof path, "%s/%s/residual.csv", s->out_dir, sets_text(s->set, "name"));
  status = table_load_file(path, &residual, error);
  if (status == LAB_OK)
    status = put_channel(s->set, &residual, s->channel, s->unit, s->noise, list, error);
  if (status == LAB_OK && *check)
    status = put_channel(s->set, &residual, check, sets_text(s->set, "check_unit"), (double)NAN, list, error);
  table_close(&residual);
  return status;
}

/* Log by log, where several were held out.
 * Out:     better  how many the completed model predicts better than the declared one
 * Returns: how many there are */
static int put_held(const story *s, cJSON *to, int *better)
{
  const cJSON *log, *logs = at_keys(s->json, "error", "holdout", "logs", NULL);
  const int n = cJSON_GetArraySize(logs);
  cJSON *all = n > 1 ? cJSON_AddObjectToObject(to, "by_log") : NULL, *list = cJSON_AddArrayToObject(all, "logs");
  char farther[NAMES_TEXT] = "";
  *better = 0;
  cJSON_ArrayForEach(log, logs)
  {
    const model_error before = error_of(s, at_keys(log, "before", NULL)),
                      after = error_of(s, at_keys(log, "after", NULL));
    cJSON *item = lab_json_append(list);
    lab_json_put(item, "log", "%s", words_of(log, "log"));
    put_digits(item, "before before_noise after after_noise", before.value, before.in_noise, after.value,
               after.in_noise);
    if (after.value < before.value)
      ++*better;
    else
      join(farther, words_of(log, "log"));
  }
  lab_json_put(all, "n", "%d", n);
  lab_json_put(all, "better", "%d", *better);
  lab_json_put(all, "farther", "%s", farther);
  return n;
}

/* The values that a log tells, and how many it does not. */
static void put_values(const alone_fit *fit, cJSON *item)
{
  cJSON *list = cJSON_AddArrayToObject(item, "values");
  int i;
  for (i = 0; i < fit->n; i++) {
    const alone_value *x = &fit->value[i];
    const char *space = strcmp(x->unit, "1") ? " " : "", *unit = *space ? x->unit : "";
    if (x->half > 0)
      lab_json_join(list, "; ", "%s %.3g +- %.2g%s%s", x->name, x->value, x->half, space, unit);
    else
      lab_json_join(list, "; ", "%s %.3g%s%s, at a bound", x->name, x->value, space, unit);
  }
  if (fit->undetermined > 0)
    lab_json_join(list, "; ", "%d not determined", fit->undetermined);
}

/* The channel that was not fitted, as its sensor may show it. */
static void put_sensor(const story *s, cJSON *to)
{
  const alone_fit *sensor = &s->result->sensor;
  const int channel = sets_channel(sets_text(s->set, "check"));
  cJSON *item = sensor->left > 0 ? cJSON_AddObjectToObject(to, "through_sensor") : NULL;
  double scale, offset;
  lab_error ignored;
  if (!item || lab_unit_factor(lab_channels[channel].unit, sets_text(s->set, "check_unit"), &scale, &offset, &ignored))
    return;
  put_digits(item, "left", scale * sensor->left);
  put_values(sensor, item);
}

/* ---- What is counted over the sets ---- */

typedef struct tally {
  int ran, held, lower;
  int verdict[VERDICTS];
  int logs, logs_lower; /* the same over the logs held out */
  cJSON *not_lower;     /* sets whose error held out does not fall */
  cJSON *by_channel;    /* those that are judged by a channel that was not fitted */
  cJSON *raised;        /* those whose error held out was lower on the way */
  cJSON *own;           /* those whose logs held out are explained by values of their own */
} tally;

/* The error on what took no part is that of the runs held out, or of the channel that was not fitted. */
static void count(const story *s, tally *t)
{
  const char *title = sets_text(s->set, "title"), *check = sets_text(s->set, "check");
  const double before = *check ? check_error(s, "before").value : s->held_before.value;
  const double after = *check ? check_error(s, "after").value : s->held_after.value;
  const cJSON *best = best_on_the_way(s);
  t->ran++;
  t->verdict[verdict_of(s)]++;
  if (best)
    lab_json_join(t->raised, "; ", "%s (%s to %s %s)", title, digits(held_error(s, best).value),
                  digits(s->held_after.value), s->unit);
  if (isnan(before) || isnan(after))
    return;
  t->held++;
  t->lower += after < before;
  if (after >= before)
    lab_json_join(t->not_lower, "; ", "%s", title);
  if (*check)
    lab_json_join(t->by_channel, "; ", "%s (%s)", title, check);
}

/* Root mean square over some logs: of common values, and of their own. */
typedef struct over_logs {
  double common, own;
} over_logs;

static over_logs over(const sets_result *result, int first, double scale)
{
  over_logs all = {0, 0};
  double rows = 0;
  int i;
  for (i = first; i < result->n_alone; i++) {
    const alone_fit *fit = &result->alone[i];
    all.common += (double)fit->rows * fit->common * fit->common;
    all.own += (double)fit->rows * fit->left * fit->left;
    rows += (double)fit->rows;
  }
  all.common = scale * sqrt(all.common / rows);
  all.own = scale * sqrt(all.own / rows);
  return all;
}

/* Whether each log held out is explained by values of its own, and the logs are not by common ones. */
static int shows_between_logs(const story *s, int first)
{
  int i, all = !is_explained(s, s->held_after);
  for (i = first; i < s->result->n_alone; i++) {
    const alone_fit *fit = &s->result->alone[i];
    all &= is_explained(s, (model_error){s->scale * fit->left, fit->in_noise});
  }
  return all;
}

/* The completed model with values of each log, and how far it comes with these on the logs held out. */
static void put_alone(const story *s, tally *t, cJSON *to)
{
  const sets_result *result = s->result;
  const int fitted = config_setting_length(lab_config_member(s->set, "fit"));
  const over_logs held = over(result, fitted, s->scale);
  cJSON *all = result->n_alone ? cJSON_AddObjectToObject(to, "alone") : NULL;
  cJSON *list = cJSON_AddArrayToObject(all, "logs");
  int i;
  for (i = 0; i < result->n_alone; i++) {
    const alone_fit *fit = &result->alone[i];
    cJSON *item = lab_json_append(list);
    lab_json_put(item, "log", "%s", sets_log(s->set, i));
    put_digits(item, "common own in_noise", s->scale * fit->common, s->scale * fit->left, fit->in_noise);
    put_values(fit, item);
  }
  if (isnan(held.own))
    return;
  put_digits(all, "held common", held.own, held.common);
  if (!shows_between_logs(s, fitted)) {
    lab_json_put(all, "is_within", "yes");
    return;
  }
  lab_json_put(all, "is_between", "yes");
  lab_json_join(t->own, "; ", "%s (%s to %s %s)", sets_text(s->set, "title"), digits(held.common), digits(held.own),
                s->unit);
}

static void put_tally(const tally *t, int n, cJSON *page)
{
  cJSON *list = cJSON_AddArrayToObject(page, "verdicts");
  int i;
  lab_json_put(page, "n_sets", "%d", n);
  lab_json_put(page, "n_ran", "%d", t->ran);
  for (i = 0; i < VERDICTS - 1; i++)
    if (t->verdict[i] > 0)
      lab_json_say(list, "%s %d %s", cJSON_GetArraySize(list) ? "," : ":", t->verdict[i], verdicts[i][1]);
  lab_json_put(page, "held", "%d", t->held);
  lab_json_put(page, "lower", "%d", t->lower);
  lab_json_put(page, "logs", "%d", t->logs);
  lab_json_put(page, "logs_lower", "%d", t->logs_lower);
  put_list(page, "not_lower", "sets", t->not_lower);
  put_list(page, "by_channel", "sets", t->by_channel);
  put_list(page, "raised", "sets", t->raised);
  put_list(page, "own", "sets", t->own);
}

/* ---- The report ---- */

static int put_ran(const story *s, tally *t, cJSON *to, lab_error *error)
{
  static lab_rig rig;
  char path[PATH_TEXT];
  int better;
  snprintf(path, sizeof path, "study/measured/%s", sets_text(s->set, "rig"));
  if (lab_rig_read(path, &rig, error))
    return error->status;
  count(s, t);
  put_errors(s, to);
  put_verdict(s, to);
  put_in_pressure(s, &rig, to);
  put_way(s, to);
  put_singles(s, to);
  put_rival(s, to);
  put_best(s, to);
  put_parameters(s->json, to);
  put_sensor(s, to);
  put_alone(s, t, to);
  t->logs += put_held(s, to, &better);
  t->logs_lower += better;
  return put_given(s, &rig, to, error) ? error->status : put_residual(s, to, error);
}

static int put_all(const sets_result *result, int n, const char *out_dir, cJSON *page, lab_error *error)
{
  cJSON *list = cJSON_AddArrayToObject(page, "sets");
  tally t = {.not_lower = cJSON_CreateArray(),
             .by_channel = cJSON_CreateArray(),
             .raised = cJSON_CreateArray(),
             .own = cJSON_CreateArray()};
  int i, status = LAB_OK;
  for (i = 0; i < n && status == LAB_OK; i++) {
    cJSON *json = result[i].state == SETS_DONE ? json_of(out_dir, result[i].set) : NULL, *to = lab_json_append(list);
    const story s = story_of(&result[i], json, out_dir);
    put_declared(result[i].set, to);
    lab_json_put(to, "state", "%s", result[i].state == SETS_ABSENT ? "data absent" : "closeloop failed");
    if (json)
      status = put_ran(&s, &t, cJSON_AddObjectToObject(to, "ran"), error);
    cJSON_Delete(json);
  }
  put_tally(&t, n, page);
  return status;
}

int sets_report(const sets_result *result, int n, const char *out_dir, lab_error *error)
{
  cJSON *page = cJSON_CreateObject();
  char path[PATH_TEXT];
  int status = put_all(result, n, out_dir, page, error);
  snprintf(path, sizeof path, "%s/REPORT.md", out_dir);
  if (status == LAB_OK)
    status = lab_template_file(path, report_md, page, error);
  cJSON_Delete(page);
  return status;
}

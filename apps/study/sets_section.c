#include "sets_section.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../lab/log/channel.h"
#include "../lab/base/config.h"
#include "../lab/rig/rig.h"
#include "../lab/base/units.h"
#include "sets_left.h"
#include "tableread.h"

/* A set that ran, with what its section needs. */
typedef struct story {
  const config_setting_t *set;
  const cJSON *json;
  const char *channel, *unit;
  sets_errors errors;
} story;

/* ---- What was asked ---- */

static int is_fitted(const config_setting_t *set, const char *log)
{
  const config_setting_t *logs = config_setting_get_member((config_setting_t *)set, "fit");
  int i;
  for (i = 0; i < config_setting_length(logs); i++)
    if (!strcmp(config_setting_get_string_elem(logs, i), log))
      return 1;
  return 0;
}

static void write_logs(FILE *file, const config_setting_t *set, const char *list, const char *words)
{
  const int held = !strcmp(list, "holdout");
  const config_setting_t *logs = config_setting_get_member((config_setting_t *)set, list);
  int i;
  for (i = 0; i < config_setting_length(logs); i++)
    fprintf(file, "%s%s%s", i ? ", " : words, config_setting_get_string_elem(logs, i),
            held && is_fitted(set, config_setting_get_string_elem(logs, i)) ? " (rows that were not fitted)" : "");
  if (i > 0)
    fputs(".\n", file);
}

static void write_declared(FILE *file, const config_setting_t *set)
{
  fprintf(file, "\n## %s\n\n", sets_text(set, "title"));
  fprintf(file, "- Declared ([rig file](../../study/measured/%s)): %s.\n", sets_text(set, "rig"),
          sets_text(set, "declared"));
  write_logs(file, set, "fit", "- Fitted: ");
  write_logs(file, set, "holdout", "- Held out: ");
  fprintf(file, "- Independent check: %s\n", sets_text(set, "independent"));
}

/* ---- Errors and verdict ---- */

/* "115 Pa, 16.5 times the noise" */
static void write_error(FILE *file, const sets_error *e, const char *unit)
{
  char a[SETS_CELL_TEXT], b[SETS_CELL_TEXT];
  fprintf(file, "%s %s, %s times the noise", sets_digits(a, e->value), unit, sets_digits(b, e->in_noise));
}

static void write_errors(FILE *file, const story *s, const char *words, const sets_error *fitted,
                         const sets_error *held)
{
  fprintf(file, "- %s: ", words);
  write_error(file, fitted, s->unit);
  if (!isnan(held->value)) {
    fputs("; held out ", file);
    write_error(file, held, s->unit);
  }
  fputs(".\n", file);
}

static void write_verdict(FILE *file, const story *s)
{
  const char *verdict = cJSON_GetStringValue(sets_member(s->json, "verdict")), *doubt = sets_doubt(s->json);
  char names[SETS_NAMES_TEXT], a[SETS_CELL_TEXT];
  sets_names(names, s->json);
  sets_digits(a, s->errors.after.in_noise);
  fputs("- Verdict: ", file);
  if (doubt)
    fprintf(file, "undecided: %s\n", doubt);
  else if (verdict && !strcmp(verdict, "undecided") && *names)
    fprintf(file,
            "undecided, because what is left is %s times the noise: either something is missing beside these, or they "
            "stand in for something else. Nearest comes the model with %s.\n",
            a, names);
  else if (verdict && !strcmp(verdict, "undecided"))
    fprintf(file, "undecided, because what is left is %s times the noise and nothing of the catalogue explains it.\n",
            a);
  else if (*names)
    fprintf(file, "the declared model lacks %s; what is left then, %s times the noise, passes for noise.\n", names, a);
  else
    fprintf(file, "nothing of the catalogue is missing; the declared model leaves %s times the noise.\n", a);
}

static void write_alike(FILE *file, const cJSON *json)
{
  const cJSON *found, *other;
  cJSON_ArrayForEach(found, sets_member(json, "found"))
  {
    int any = 0;
    cJSON_ArrayForEach(other, sets_member(found, "indistinguishable_from"))
        fprintf(file, "%s%s", any++ ? ", " : "- The logs fitted cannot tell it from: ", cJSON_GetStringValue(other));
    if (any)
      fprintf(file, " (for %s).\n", cJSON_GetStringValue(sets_member(found, "effect")));
  }
}

/* ---- Why: the way there, and the next best ---- */

static const char *name_of(const cJSON *model)
{
  return cJSON_GetStringValue(sets_member(model, "model"));
}

static double root_chi2(const story *s, const cJSON *model)
{
  const cJSON *declared = cJSON_GetArrayItem(sets_member(s->json, "path"), 0);
  return 100 * sqrt(sets_number(model, "chi2") / sets_number(declared, "chi2"));
}

static sets_error held_error(const story *s, const cJSON *model)
{
  return sets_error_of(sets_member(model, "holdout"), s->channel, s->unit);
}

static void write_path(FILE *file, const story *s)
{
  const cJSON *model, *path = sets_member(s->json, "path");
  char a[SETS_CELL_TEXT], b[SETS_CELL_TEXT], c[SETS_CELL_TEXT], d[SETS_CELL_TEXT];
  if (cJSON_GetArraySize(path) < 2)
    return;
  fprintf(file,
          "\nThe way there:\n\n| model | fitted [%s] | fitted [noise] | held out [%s] | held out [noise] "
          "|\n|---|---|---|---|---|\n",
          s->unit, s->unit);
  cJSON_ArrayForEach(model, path)
  {
    const sets_error fitted = sets_error_of(sets_member(model, "error"), s->channel, s->unit);
    const sets_error held = held_error(s, model);
    if (model->next && sets_same_model(name_of(model), name_of(model->next)))
      continue; /* the same effects refitted in another order */
    fprintf(file, "| %s | %s | %s | %s | %s |\n", name_of(model), sets_digits(a, fitted.value),
            sets_digits(b, fitted.in_noise), sets_digits(c, held.value), sets_digits(d, held.in_noise));
  }
  fputs("\n", file);
}

/* An effect that lowers the error of what was fitted and raises that of what was held out has learnt these logs only.
 */
static void write_overfit(FILE *file, const story *s)
{
  const cJSON *best = sets_best_on_the_way(s->json, s->channel, s->unit);
  char a[SETS_CELL_TEXT], b[SETS_CELL_TEXT];
  if (best)
    fprintf(file,
            "- Held out, the error is lowest on the way, with %s: %s %s against %s at the end. What was added after "
            "that does not carry over to other runs.\n",
            name_of(best), sets_digits(a, held_error(s, best).value), s->unit,
            sets_digits(b, s->errors.held_after.value));
}

/* Of the models tried the one of lowest criterion that does without a part of the final one. */
static const cJSON *runner_up(const cJSON *json, const char *final)
{
  const cJSON *model, *best = NULL;
  cJSON_ArrayForEach(model, sets_member(json, "steps"))
  {
    if (!sets_within(final, name_of(model)) && (!best || sets_number(model, "bic") < sets_number(best, "bic")))
      best = model;
  }
  return best;
}

static void write_rival(FILE *file, const story *s)
{
  const cJSON *path = sets_member(s->json, "path"), *last = cJSON_GetArrayItem(path, cJSON_GetArraySize(path) - 1);
  const cJSON *next = cJSON_GetArraySize(path) > 1 ? runner_up(s->json, name_of(last)) : NULL;
  char a[SETS_CELL_TEXT], b[SETS_CELL_TEXT], c[SETS_CELL_TEXT], d[SETS_CELL_TEXT];
  if (!next)
    return;
  fprintf(file,
          "- Of %d models tried, the next best with other effects is %s: it leaves %s %% of the root chi-square, this "
          "one %s %% "
          "(BIC, lower is better: %s against %s).\n",
          cJSON_GetArraySize(sets_member(s->json, "steps")), name_of(next), sets_digits(a, root_chi2(s, next)),
          sets_digits(b, root_chi2(s, last)), sets_digits(c, sets_number(next, "bic")),
          sets_digits(d, sets_number(last, "bic")));
}

static int is_single(const cJSON *json, const cJSON *model)
{
  return !strstr(name_of(model), " + ") && model != cJSON_GetArrayItem(sets_member(json, "steps"), 0);
}

/* Whether a model of the same name, tried under another law of the effect, leaves less; or as much and came first. */
static int is_beaten(const cJSON *json, const cJSON *model)
{
  const double chi2 = sets_number(model, "chi2");
  const cJSON *other;
  int before = 1;
  cJSON_ArrayForEach(other, sets_member(json, "steps"))
  {
    if (other == model)
      before = 0;
    else if (!strcmp(name_of(other), name_of(model)) &&
             (sets_number(other, "chi2") < chi2 || (before && sets_number(other, "chi2") <= chi2)))
      return 1;
  }
  return 0;
}

/* What each effect does alone, if it does anything. */
static void write_singles(FILE *file, const story *s)
{
  const cJSON *model;
  char a[SETS_CELL_TEXT];
  int any = 0;
  cJSON_ArrayForEach(model, sets_member(s->json, "steps"))
  {
    if (is_single(s->json, model) && !is_beaten(s->json, model) && root_chi2(s, model) < 99)
      fprintf(file, "%s%s %s %%", any++ ? ", " : "- Each alone leaves of the root chi-square: ", name_of(model),
              sets_digits(a, root_chi2(s, model)));
  }
  if (any)
    fputs(".\n", file);
}

/* ---- Parameters ---- */

/* "name = value (low to high) unit"; no interval where the value is at a bound. */
static void write_parameters(FILE *file, const cJSON *json)
{
  const char *remark = cJSON_GetStringValue(sets_member(json, "undetermined"));
  const cJSON *p;
  fputs("- Parameters of the completed model (95 % intervals, which hold if nothing but noise is left):\n", file);
  cJSON_ArrayForEach(p, sets_member(json, "parameters"))
  {
    const cJSON *ci = sets_member(p, "ci95"), *low = cJSON_GetArrayItem(ci, 0), *high = cJSON_GetArrayItem(ci, 1);
    const char *unit = cJSON_GetStringValue(sets_member(p, "unit"));
    const double value = sets_number(p, "value");
    if (isnan(value))
      continue;
    fprintf(file, "  - %s = %.4g", p->string, value);
    if (cJSON_IsNumber(low) && cJSON_IsNumber(high) && low->valuedouble < high->valuedouble)
      fprintf(file, " (%.4g to %.4g)", low->valuedouble, high->valuedouble);
    fprintf(file, " %s\n", unit && strcmp(unit, "1") != 0 ? unit : "(a ratio)");
  }
  if (remark)
    fprintf(file, "- Not determined: %s.\n", remark);
}

/* A parameter that the source gives too: declared in the rig file as the source has it, fitted nonetheless. */
static int write_given(FILE *file, const story *s, lab_rig *rig, lab_error *error)
{
  const char *name = sets_text(s->set, "given");
  const cJSON *p = sets_member(sets_member(s->json, "parameters"), name);
  const cJSON *ci = sets_member(p, "ci95"), *low = cJSON_GetArrayItem(ci, 0), *high = cJSON_GetArrayItem(ci, 1);
  pneu_param_info info = {0};
  double given;
  int i;
  if (!*name)
    return LAB_OK;
  for (i = 0; i < PNEU_PARAM_COUNT && pneu_param_describe(i, &info) == PNEU_OK && strcmp(info.name, name) != 0; i++)
    ;
  if (i == PNEU_PARAM_COUNT || !cJSON_IsNumber(low) || !cJSON_IsNumber(high))
    return lab_config_fail(s->set, error, "given: %s is not among the parameters that were fitted", name);
  given = (double)*pneu_param_at(&rig->params, i);
  fprintf(file, "- Known from the source: %s = %.4g %s; found %+.2g %% from it, which is %s the interval.\n", name,
          given, info.unit, 100 * (sets_number(p, "value") / given - 1),
          given >= low->valuedouble && given <= high->valuedouble ? "within" : "outside");
  return LAB_OK;
}

/* An error of position as the pressure that makes up for it: spring rate over area, as declared. */
static void write_as_pressure(FILE *file, const story *s, const lab_rig *rig)
{
  const char *unit = sets_text(s->set, "as_pressure");
  const double rate = (double)rig->params.spring_rate / (double)rig->params.area;
  double length, pressure, factor, offset;
  char a[SETS_CELL_TEXT], b[SETS_CELL_TEXT], c[SETS_CELL_TEXT], d[SETS_CELL_TEXT];
  lab_error ignored;
  if (!*unit || lab_unit_factor(s->unit, "m", &length, &offset, &ignored) ||
      lab_unit_factor("Pa", unit, &pressure, &offset, &ignored))
    return;
  factor = length * rate * pressure;
  fprintf(file,
          "- In %s, at the declared spring rate over area of %.4g %s a %s: %s before, %s after; held out %s before, %s "
          "after.\n",
          unit, factor, unit, s->unit, sets_digits(a, factor * s->errors.before.value),
          sets_digits(b, factor * s->errors.after.value), sets_digits(c, factor * s->errors.held_before.value),
          sets_digits(d, factor * s->errors.held_after.value));
}

/* ---- What is left, run by run ---- */

static const lab_channel_info *channel_info(const char *quantity)
{
  int c;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    if (!strcmp(lab_channels[c].quantity, quantity))
      return &lab_channels[c];
  return NULL;
}

static void write_run(FILE *file, const config_setting_t *set, int run, int runs)
{
  const config_setting_t *logs = config_setting_get_member((config_setting_t *)set, "fit");
  if (config_setting_length(logs) == runs)
    fprintf(file, "| %s |", config_setting_get_string_elem(logs, run - 1));
  else
    fprintf(file, "| run %d |", run);
}

/* A row a run of one channel.  In: noise  in `unit`; NaN: the channel was not fitted */
static int write_left(FILE *file, const config_setting_t *set, const table *residual, const char *quantity,
                      const char *unit, double noise, lab_error *error)
{
  const lab_channel_info *info = channel_info(quantity);
  const int runs = sets_left_runs(residual);
  double scale, offset;
  char a[SETS_CELL_TEXT], b[SETS_CELL_TEXT], c[SETS_CELL_TEXT], d[SETS_CELL_TEXT], e[SETS_CELL_TEXT];
  int run;
  if (!info)
    return lab_config_fail(set, error, "%s is no channel", quantity);
  if (lab_unit_factor(info->unit, unit, &scale, &offset, error))
    return error->status;
  for (run = 1; run <= runs; run++) {
    sets_left left;
    if (sets_left_of(residual, run, info->key, &left, error))
      return error->status;
    if (left.n == 0)
      continue;
    write_run(file, set, run, runs);
    fprintf(file, " %s [%s] | %s | %s | %s | %s | %s | %.2f |\n", quantity, unit, sets_digits(a, scale * left.rms),
            sets_digits(b, scale * left.rms / noise), sets_digits(c, scale * left.mean),
            sets_digits(d, scale * left.worst), sets_digits(e, left.worst_t), left.lag1);
  }
  return LAB_OK;
}

static int write_residual(FILE *file, const story *s, const char *out_dir, lab_error *error)
{
  const char *check = sets_text(s->set, "check");
  char path[SETS_PATH_TEXT];
  table residual;
  int status;
  snprintf(path, sizeof path, "%s/%s/residual.csv", out_dir, sets_text(s->set, "name"));
  status = table_load_file(path, &residual, error);
  if (status == LAB_OK) {
    fputs("\nWhere what is left is (measured less predicted, runs fitted):\n\n"
          "| run | channel | root mean square | in noise | mean | largest | at t [s] | lag-1 autocorrelation |\n"
          "|---|---|---|---|---|---|---|---|\n",
          file);
    status = write_left(file, s->set, &residual, s->channel, s->unit, sets_noise(&s->errors), error);
  }
  if (status == LAB_OK && *check)
    status = write_left(file, s->set, &residual, check, sets_text(s->set, "check_unit"), (double)NAN, error);
  fputs("\n", file);
  table_close(&residual);
  return status;
}

/* ---- The logs held out, one by one ---- */

static void write_held(FILE *file, const story *s)
{
  const cJSON *log, *logs = sets_member(sets_member(sets_member(s->json, "error"), "holdout"), "logs");
  char a[SETS_CELL_TEXT], b[SETS_CELL_TEXT], c[SETS_CELL_TEXT], d[SETS_CELL_TEXT], worse[SETS_NAMES_TEXT];
  int better;
  const int n = sets_held_logs(s->json, s->channel, &better, worse);
  if (n < 2)
    return;
  fprintf(file,
          "Log by log of those held out:\n\n| log | before [%s] | before [noise] | after [%s] | after [noise] "
          "|\n|---|---|---|---|---|\n",
          s->unit, s->unit);
  cJSON_ArrayForEach(log, logs)
  {
    const sets_error before = sets_error_of(sets_member(log, "before"), s->channel, s->unit);
    const sets_error after = sets_error_of(sets_member(log, "after"), s->channel, s->unit);
    fprintf(file, "| %s | %s | %s | %s | %s |\n", cJSON_GetStringValue(sets_member(log, "log")),
            sets_digits(a, before.value), sets_digits(b, before.in_noise), sets_digits(c, after.value),
            sets_digits(d, after.in_noise));
  }
  fprintf(file, "\n- Of these %d the completed model is nearer in %d", n, better);
  if (*worse)
    fprintf(file, "; it is farther off than the declared one in: %s", worse);
  fputs(".\n", file);
}

/* ---- The section ---- */

static int write_found(FILE *file, const story *s, const char *out_dir, lab_error *error)
{
  char path[SETS_PATH_TEXT];
  static lab_rig rig;
  snprintf(path, sizeof path, "study/measured/%s", sets_text(s->set, "rig"));
  if (lab_rig_read(path, &rig, error))
    return error->status;
  write_errors(file, s, "Error before, of the declared model", &s->errors.before, &s->errors.held_before);
  write_verdict(file, s);
  write_errors(file, s, "Error after, of the completed model", &s->errors.after, &s->errors.held_after);
  write_as_pressure(file, s, &rig);
  write_path(file, s);
  write_singles(file, s);
  write_rival(file, s);
  write_overfit(file, s);
  write_alike(file, s->json);
  write_parameters(file, s->json);
  if (write_given(file, s, &rig, error))
    return error->status;
  if (write_residual(file, s, out_dir, error))
    return error->status;
  write_held(file, s);
  return LAB_OK;
}

int sets_section(FILE *file, const sets_result *r, const cJSON *json, const char *out_dir, lab_error *error)
{
  const char *channel = sets_text(r->set, "judged"), *unit = sets_text(r->set, "unit");
  const story s = {r->set, json, channel, unit, sets_errors_of(json, channel, unit)};
  write_declared(file, r->set);
  if (json && write_found(file, &s, out_dir, error))
    return error->status;
  fprintf(file, "- What that may mean: %s\n", sets_text(r->set, "remains"));
  return LAB_OK;
}

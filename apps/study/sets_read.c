#include "sets_read.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../lab/base/text.h"
#include "../lab/base/units.h"

const char *sets_text(const config_setting_t *set, const char *key)
{
  const char *text = "";
  config_setting_lookup_string(set, key, &text);
  return text;
}

cJSON *sets_json(const char *out_dir, const config_setting_t *set)
{
  char path[SETS_PATH_TEXT];
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

const cJSON *sets_member(const cJSON *at, const char *key)
{
  return cJSON_GetObjectItemCaseSensitive(at, key);
}

double sets_number(const cJSON *at, const char *key)
{
  const cJSON *number = sets_member(at, key);
  return cJSON_IsNumber(number) ? number->valuedouble : (double)NAN;
}

/* ---- Errors ---- */

sets_error sets_error_of(const cJSON *errors, const char *channel, const char *unit)
{
  const cJSON *found = sets_member(errors, channel);
  const char *own = cJSON_GetStringValue(sets_member(found, "unit"));
  sets_error e = {(double)NAN, sets_number(found, "in_noise")};
  double scale, offset;
  lab_error ignored;
  if (own && lab_unit_factor(own, unit, &scale, &offset, &ignored) == LAB_OK)
    e.value = scale * sets_number(found, "rmse");
  return e;
}

sets_errors sets_errors_of(const cJSON *json, const char *channel, const char *unit)
{
  const cJSON *error = sets_member(json, "error"), *held = sets_member(error, "holdout");
  const sets_errors e = {sets_error_of(sets_member(error, "before"), channel, unit),
                         sets_error_of(sets_member(error, "after"), channel, unit),
                         sets_error_of(sets_member(held, "before"), channel, unit),
                         sets_error_of(sets_member(held, "after"), channel, unit)};
  return e;
}

double sets_noise(const sets_errors *e)
{
  return e->before.value / e->before.in_noise;
}

/* ---- Words ---- */

const char *sets_digits(char *cell, double value)
{
  if (isnan(value))
    strcpy(cell, "-");
  else
    snprintf(cell, SETS_CELL_TEXT, fabs(value) < 999.5 ? "%.3g" : "%.0f", value);
  return cell;
}

static void join(char *names, const char *name)
{
  const size_t used = strlen(names);
  snprintf(names + used, SETS_NAMES_TEXT - used, "%s%s", used ? ", " : "", name);
}

const char *sets_names(char *names, const cJSON *json)
{
  const cJSON *found;
  names[0] = 0;
  cJSON_ArrayForEach(found, sets_member(json, "found")) join(names, cJSON_GetStringValue(sets_member(found, "effect")));
  cJSON_ArrayForEach(found, sets_member(json, "unlisted"))
  {
    char name[256];
    snprintf(name, sizeof name, "a term without a name (%s, %s)", cJSON_GetStringValue(sets_member(found, "what")),
             cJSON_GetStringValue(sets_member(found, "where")));
    join(names, name);
  }
  return names;
}

static double held_value(const cJSON *model, const char *channel, const char *unit)
{
  return sets_error_of(sets_member(model, "holdout"), channel, unit).value;
}

const cJSON *sets_best_on_the_way(const cJSON *json, const char *channel, const char *unit)
{
  const double final = sets_errors_of(json, channel, unit).held_after.value;
  const cJSON *model, *best = NULL;
  char a[SETS_CELL_TEXT], b[SETS_CELL_TEXT];
  cJSON_ArrayForEach(model, sets_member(json, "path"))
  {
    if (!best || held_value(model, channel, unit) < held_value(best, channel, unit))
      best = model;
  }
  return best && strcmp(sets_digits(a, held_value(best, channel, unit)), sets_digits(b, final)) != 0 ? best : NULL;
}

int sets_held_logs(const cJSON *json, const char *channel, int *better, char *worse)
{
  const cJSON *log, *logs = sets_member(sets_member(sets_member(json, "error"), "holdout"), "logs");
  *better = 0;
  worse[0] = 0;
  cJSON_ArrayForEach(log, logs)
  {
    const double before = sets_number(sets_member(sets_member(log, "before"), channel), "rmse");
    const double after = sets_number(sets_member(sets_member(log, "after"), channel), "rmse");
    if (after < before)
      ++*better;
    else
      join(worse, cJSON_GetStringValue(sets_member(log, "log")));
  }
  return cJSON_GetArraySize(logs);
}

const char *sets_doubt(const cJSON *json)
{
  static const char start[] = "Undecided: ";
  const char *sentence = cJSON_GetStringValue(sets_member(json, "sentence"));
  const cJSON *remark;
  if (!sentence || strncmp(sentence, start, strlen(start)) != 0)
    return NULL;
  cJSON_ArrayForEach(
      remark,
      sets_member(json, "limitations")) if (!strcmp(cJSON_GetStringValue(remark),
                                                    sentence + strlen(start))) return cJSON_GetStringValue(remark);
  return NULL;
}

/* Length of the part of "a + b" that begins at `at`. */
static size_t part_length(const char *at)
{
  const char *end = strstr(at, " + ");
  return end ? (size_t)(end - at) : strlen(at);
}

static int has_part(const char *model, const char *part, size_t length)
{
  for (;;) {
    const size_t n = part_length(model);
    if (n == length && !strncmp(model, part, n))
      return 1;
    if (!model[n])
      return 0;
    model += n + 3;
  }
}

int sets_within(const char *a, const char *b)
{
  for (;;) {
    const size_t n = part_length(a);
    if (!has_part(b, a, n))
      return 0;
    if (!a[n])
      return 1;
    a += n + 3;
  }
}

int sets_same_model(const char *a, const char *b)
{
  return sets_within(a, b) && sets_within(b, a);
}

#include "../lab/log/channel.h"
#include "sets.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../lab/base/text.h"
#include "../lab/base/units.h"
#include "../lab/base/whiteness.h"

const char *sets_text(const config_setting_t *set, const char *key)
{
  const char *text = "";
  config_setting_lookup_string(set, key, &text);
  return text;
}

cJSON *sets_json(const char *out_dir, const config_setting_t *set)
{
  char path[1024];
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

const cJSON *sets_at(const cJSON *at, ...)
{
  const char *key;
  va_list keys;
  va_start(keys, at);
  while ((key = va_arg(keys, const char *)) != NULL)
    at = cJSON_GetObjectItemCaseSensitive(at, key);
  va_end(keys);
  return at;
}

double sets_number(const cJSON *at, const char *key)
{
  const cJSON *number = sets_at(at, key, NULL);
  return cJSON_IsNumber(number) ? number->valuedouble : (double)NAN;
}

const char *sets_words(const cJSON *at, const char *key)
{
  return cJSON_GetStringValue(sets_at(at, key, NULL));
}

sets_error sets_error_of(const cJSON *errors, const char *channel, const char *unit)
{
  const cJSON *found = sets_at(errors, channel, NULL);
  const char *own = sets_words(found, "unit");
  sets_error e = {(double)NAN, sets_number(found, "in_noise")};
  double scale, offset;
  lab_error ignored;
  if (own && lab_unit_factor(own, unit, &scale, &offset, &ignored) == LAB_OK)
    e.value = scale * sets_number(found, "rmse");
  return e;
}

int sets_channel(const char *quantity)
{
  int c = 0;
  while (c < LAB_CHANNEL_COUNT && strcmp(lab_channels[c].quantity, quantity) != 0)
    c++;
  return c < LAB_CHANNEL_COUNT ? c : -1;
}

/* ---- Names of models ---- */

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

/* ---- What is left ---- */

int sets_left_runs(const table *residual)
{
  const size_t n = table_rows(residual);
  const double last = n ? table_number(residual, n - 1, "run") : 0;
  return isnan(last) ? 0 : (int)last;
}

static void add_value(sets_left *left, double t, double value)
{
  left->n++;
  left->mean += value;
  left->rms += value * value;
  if (left->n == 1 || fabs(value) > fabs(left->worst)) {
    left->worst = value;
    left->worst_t = t;
  }
}

int sets_left_of(const table *residual, int run, const char *key, sets_left *left, lab_error *error)
{
  const size_t rows = table_rows(residual);
  double *value = malloc((rows + 1) * sizeof *value);
  char after[32];
  lab_stretch all = {value, 0};
  lab_whiteness white;
  size_t i;
  if (!value)
    return lab_fail_memory(error, "residuals");
  snprintf(after, sizeof after, "%s_after", key);
  *left = (sets_left){0, 0, 0, (double)NAN, (double)NAN, (double)NAN};
  for (i = 0; i < rows; i++) {
    const double r = table_number(residual, i, key) - table_number(residual, i, after);
    if ((int)table_number(residual, i, "run") != run || isnan(r))
      continue;
    add_value(left, table_number(residual, i, "t"), r);
    value[all.n++] = r;
  }
  left->mean /= (double)left->n;
  left->rms = sqrt(left->rms / (double)left->n);
  lab_whiteness_test(&all, 1, &white);
  if (white.lags > 0)
    left->lag1 = white.correlation[1];
  free(value);
  return LAB_OK;
}

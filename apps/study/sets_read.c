#include "sets.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../lab/base/config.h"
#include "../lab/base/names.h"
#include "../lab/base/whiteness.h"
#include "../lab/log/channel.h"

const char *sets_text(const config_setting_t *set, const char *key)
{
  const char *text = "";
  config_setting_lookup_string(set, key, &text);
  return text;
}

const char *sets_log(const config_setting_t *set, int i)
{
  const config_setting_t *fit = lab_config_member(set, "fit"), *held = lab_config_member(set, "holdout");
  const int n = config_setting_length(fit);
  return i < n ? config_setting_get_string_elem(fit, i) : config_setting_get_string_elem(held, i - n);
}

int sets_is_fitted(const config_setting_t *set, const char *log)
{
  const int fitted = config_setting_length(lab_config_member(set, "fit"));
  int i, any = 0;
  for (i = 0; i < fitted; i++)
    any |= !strcmp(sets_log(set, i), log);
  return any;
}

int sets_channel(const char *quantity)
{
  return lab_name_index(quantity, &lab_channels->quantity, LAB_CHANNEL_COUNT, sizeof *lab_channels);
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

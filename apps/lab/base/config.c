#include "config.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "names.h"
#include "text.h"
#include "units.h"

enum { KEY_TEXT = 256, FOUND_TEXT = 96 };

/* The parser's words, and what to write where they do not say it. */
static int parse_failed(const config_t *config, const char *path, lab_error *error)
{
  const char *text = config_error_text(config);
  const char *advice = strstr(text, "mismatched element type")
                           ? ": between [ and ] write all numbers alike, 0.0 beside 0.1, or use ( and )"
                           : "";
  const char *included = config_error_file(config);
  return lab_fail(error, LAB_DATA, "%s:%d: %s%s", included ? included : path, config_error_line(config), text, advice);
}

int lab_config_parse(config_t *config, const char *text, const char *path, lab_error *error)
{
  config_init(config);
  if (!config_read_string(config, text))
    return parse_failed(config, path, error);
  config_setting_set_hook(config_root_setting(config), (void *)path);
  return LAB_OK;
}

int lab_config_read(config_t *config, const char *path, lab_error *error)
{
  lab_text text;
  int status = lab_text_read(path, &text, error);
  if (status != LAB_OK) {
    config_init(config);
    return status;
  }
  status = lab_config_parse(config, text.data, path, error);
  lab_text_free(&text);
  return status;
}

/* Append "group.key" or "list[2]"; nothing for the root. */
static void append_key(const config_setting_t *setting, char key[KEY_TEXT])
{
  const config_setting_t *parent = config_setting_parent(setting);
  size_t used;
  if (!parent)
    return;
  append_key(parent, key);
  used = strlen(key);
  if (config_setting_name(setting))
    snprintf(key + used, KEY_TEXT - used, "%s%s", used ? "." : "", config_setting_name(setting));
  else
    snprintf(key + used, KEY_TEXT - used, "[%d]", config_setting_index(setting));
}

int lab_config_fail_in(const config_setting_t *setting, lab_error *error)
{
  const char *path = config_setting_get_hook(config_root_setting(setting->config));
  char key[KEY_TEXT] = "";
  append_key(setting, key);
  return lab_fail_in(error, *key ? "%s:%d: %s" : "%s:%d", path, (int)config_setting_source_line(setting), key);
}

int lab_config_fail(const config_setting_t *setting, lab_error *error, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  vsnprintf(error->text, sizeof error->text, format, args);
  va_end(args);
  error->status = LAB_DATA;
  return lab_config_fail_in(setting, error); /* which makes it one line */
}

/* What a setting holds, for a message. */
static void describe(const config_setting_t *setting, char text[FOUND_TEXT])
{
  switch (config_setting_type(setting)) {
  case CONFIG_TYPE_STRING:
    snprintf(text, FOUND_TEXT, "\"%.80s\"", config_setting_get_string(setting));
    break;
  case CONFIG_TYPE_INT:
  case CONFIG_TYPE_INT64:
    snprintf(text, FOUND_TEXT, "%lld", config_setting_get_int64(setting));
    break;
  case CONFIG_TYPE_FLOAT:
    snprintf(text, FOUND_TEXT, "%g", config_setting_get_float(setting));
    break;
  case CONFIG_TYPE_BOOL:
    snprintf(text, FOUND_TEXT, "%s", config_setting_get_bool(setting) ? "true" : "false");
    break;
  default:
    snprintf(text, FOUND_TEXT, "a %s of %d entries", config_setting_is_group(setting) ? "group" : "list",
             config_setting_length(setting));
  }
}

int lab_config_expected(const config_setting_t *setting, const char *expected, lab_error *error)
{
  char found[FOUND_TEXT];
  describe(setting, found);
  return lab_config_fail(setting, error, "expected %s, found %s", expected, found);
}

int lab_config_unknown(const config_setting_t *setting, const void *table, size_t n, size_t stride, lab_error *error)
{
  return lab_config_fail(setting, error, "unknown key; the nearest known one is \"%s\"",
                         lab_name_nearest(config_setting_name(setting), table, n, stride));
}

int lab_config_known(const config_setting_t *group, const void *table, size_t n, size_t stride, lab_error *error)
{
  int i;
  if (lab_config_is_group(group, error))
    return error->status;
  for (i = 0; i < config_setting_length(group); i++) {
    const config_setting_t *member = config_setting_get_elem(group, (unsigned)i);
    if (lab_name_index(config_setting_name(member), table, n, stride) < 0)
      return lab_config_unknown(member, table, n, stride, error);
  }
  return LAB_OK;
}

int lab_config_is_group(const config_setting_t *setting, lab_error *error)
{
  return config_setting_is_group(setting) ? LAB_OK : lab_config_expected(setting, "a group { ... }", error);
}

const config_setting_t *lab_config_member(const config_setting_t *group, const char *key)
{
  return group ? config_setting_get_member((config_setting_t *)group, key) : NULL;
}

int lab_config_members(const config_setting_t *group, const char *const *keys, int n, int needed,
                       const config_setting_t **member, lab_error *error)
{
  char list[KEY_TEXT] = "";
  int i;
  if (lab_config_known(group, keys, (size_t)n, sizeof *keys, error))
    return error->status;
  for (i = 0; i < needed; i++)
    lab_append(list, sizeof list, "%s%s", i == 0 ? "" : i + 1 < needed ? ", " : " and ", keys[i]);
  for (i = 0; i < n; i++) {
    member[i] = lab_config_member(group, keys[i]);
    if (!member[i] && i < needed)
      return lab_config_fail(group, error, "expected the keys %s; %s is missing", list, keys[i]);
  }
  return LAB_OK;
}

/* The number as it stands, or the text by `read`.  Returns: LAB_OK, or a failure without its place. */
static int number_or_text(const config_setting_t *setting, const char *unit,
                          int (*read)(const char *, const char *, double *, lab_error *), double *value,
                          lab_error *error)
{
  char found[FOUND_TEXT];
  switch (config_setting_type(setting)) {
  case CONFIG_TYPE_INT:
  case CONFIG_TYPE_INT64:
    *value = (double)config_setting_get_int64(setting);
    return LAB_OK;
  case CONFIG_TYPE_FLOAT:
    *value = config_setting_get_float(setting) + 0.0; /* a zero without sign, as a text with a unit has it */
    return LAB_OK;
  case CONFIG_TYPE_STRING:
    return read(config_setting_get_string(setting), unit, value, error);
  default:
    describe(setting, found);
    return lab_fail(error, LAB_DATA, "expected \"number unit\" or a plain number in %s, found %s", unit, found);
  }
}

/* What to write where a number without a unit is too large or too small: it may be in another unit than SI's. */
static const char *unit_advice(const config_setting_t *setting, const char *unit)
{
  const char *text = config_setting_get_string(setting);
  const int is_bare = !text || !text[strspn(text, "+-.0123456789eE \t")];
  return is_bare && strcmp(unit, "1") != 0 ? "; if it is in another unit, write number and unit in quotes" : "";
}

int lab_config_quantity(const config_setting_t *setting, const char *unit, double lower, double upper, double *value,
                        lab_error *error)
{
  char found[FOUND_TEXT];
  if (number_or_text(setting, unit, lab_quantity, value, error))
    return lab_config_fail_in(setting, error);
  if (isfinite(*value) && *value >= lower && *value <= upper)
    return LAB_OK;
  describe(setting, found);
  return lab_config_fail(setting, error, "expected %g to %g %s, found %s, which is %g %s%s", lower, upper, unit, found,
                         *value, unit, unit_advice(setting, unit));
}

int lab_config_difference(const config_setting_t *setting, const char *unit, double *value, lab_error *error)
{
  if (number_or_text(setting, unit, lab_quantity_difference, value, error))
    return lab_config_fail_in(setting, error);
  return isfinite(*value) ? LAB_OK : lab_config_expected(setting, "a finite number", error);
}

int lab_config_count(const config_setting_t *setting, int lower, int upper, int *value, lab_error *error)
{
  char expected[FOUND_TEXT];
  if (config_setting_type(setting) == CONFIG_TYPE_INT) {
    *value = config_setting_get_int(setting);
    if (*value >= lower && *value <= upper)
      return LAB_OK;
  }
  snprintf(expected, sizeof expected, "a whole number, %d to %d", lower, upper);
  return lab_config_expected(setting, expected, error);
}

int lab_config_choice(const config_setting_t *setting, const void *table, size_t n, size_t stride, int *choice,
                      lab_error *error)
{
  const char *word = config_setting_get_string(setting);
  if (!word)
    return lab_config_expected(setting, "a word in quotes", error);
  *choice = lab_name_index(word, table, n, stride);
  if (*choice >= 0)
    return LAB_OK;
  if (n == 2)
    return lab_config_fail(setting, error, "unknown word \"%.80s\"; expected \"%s\" or \"%s\"", word,
                           *(const char *const *)table, *(const char *const *)((const char *)table + stride));
  return lab_config_fail(setting, error, "unknown word \"%.80s\"; the nearest known one is \"%s\"", word,
                         lab_name_nearest(word, table, n, stride));
}

int lab_config_text(const config_setting_t *setting, char *text, size_t size, lab_error *error)
{
  const char *found = config_setting_get_string(setting);
  if (!found)
    return lab_config_expected(setting, "a text in quotes", error);
  if (strlen(found) >= size)
    return lab_config_fail(setting, error, "expected a text of at most %zu bytes, found %zu", size - 1, strlen(found));
  snprintf(text, size, "%s", found);
  return LAB_OK;
}

int lab_config_list(const config_setting_t *setting, int n_min, int n_max, lab_error *error)
{
  char expected[FOUND_TEXT];
  int n = config_setting_length(setting);
  if ((config_setting_is_list(setting) || config_setting_is_array(setting)) && n >= n_min && n <= n_max)
    return LAB_OK;
  snprintf(expected, sizeof expected, "a list ( ... ) of %d to %d entries", n_min, n_max);
  return lab_config_expected(setting, expected, error);
}

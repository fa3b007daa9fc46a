#include "json.h"

#include <stdarg.h>
#include <stdlib.h>

#include "escape.h"
#include "text.h"

/* ---- Values ---- */

static cJSON *text_of(const char *before, const char *format, va_list list)
{
  lab_writing w;
  cJSON *value;
  char *text;
  if (lab_writing_begin(&w)) {
    fputs(before, w.file);
    vfprintf(w.file, format, list);
  }
  text = lab_writing_end(&w);
  value = text ? cJSON_CreateString(text) : NULL;
  free(text);
  return value;
}

/* A value that finds no place is dropped. */
static void add(cJSON *to, const char *name, cJSON *value)
{
  if (!(name ? cJSON_AddItemToObject(to, name, value) : cJSON_AddItemToArray(to, value)))
    cJSON_Delete(value);
}

void lab_json_put(cJSON *to, const char *name, const char *format, ...)
{
  va_list list;
  va_start(list, format);
  add(to, name, text_of("", format, list));
  va_end(list);
}

void lab_json_join(cJSON *to, const char *between, const char *format, ...)
{
  va_list list;
  va_start(list, format);
  add(to, NULL, text_of(cJSON_GetArraySize(to) > 0 ? between : "", format, list));
  va_end(list);
}

cJSON *lab_json_append(cJSON *list)
{
  cJSON *item = cJSON_CreateObject();
  if (cJSON_AddItemToArray(list, item))
    return item;
  cJSON_Delete(item);
  return NULL;
}

void lab_json_numbers(cJSON *to, const lab_json_named *number)
{
  for (; number->name; number++)
    cJSON_AddNumberToObject(to, number->name, number->value);
}

void lab_json_range(cJSON *to, const char *name, double low, double high)
{
  const double ends[] = {low, high};
  add(to, name, cJSON_CreateDoubleArray(ends, 2));
}

/* ---- Writing ---- */

/* Nine digits are more than any number of a document knows, and free of its rounding. */
static double to_nine_digits(double value)
{
  char text[32];
  snprintf(text, sizeof text, "%.9g", value);
  return strtod(text, NULL);
}

static void tidy_all(cJSON *item)
{
  for (; item; item = item->next) {
    if (cJSON_IsString(item))
      lab_make_plain(item->valuestring);
    if (cJSON_IsNumber(item))
      item->valuedouble = to_nine_digits(item->valuedouble);
    tidy_all(item->child);
  }
}

int lab_json_write(FILE *file, cJSON *root, const char *what, lab_error *error)
{
  char *text;
  tidy_all(root);
  text = cJSON_Print(root);
  cJSON_Delete(root);
  if (!text)
    return lab_fail_memory(error, what);
  fprintf(file, "%s\n", text);
  cJSON_free(text);
  return LAB_OK;
}

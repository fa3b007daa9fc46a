/* Values of the page: texts, numbers, what is known of an unknown. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "../base/shown.h"
#include "page_private.h"

const double page_white_level = 0.01;

void page_put(cJSON *to, const char *name, const char *format, ...)
{
  char text[1400];
  va_list list;
  va_start(list, format);
  vsnprintf(text, sizeof text, format, list);
  va_end(list);
  cJSON_AddStringToObject(to, name, text);
}

void page_say(cJSON *list, const char *format, ...)
{
  char text[1400];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  cJSON_AddItemToArray(list, cJSON_CreateString(text));
}

cJSON *page_append(cJSON *list)
{
  cJSON *item = cJSON_CreateObject();
  cJSON_AddItemToArray(list, item);
  return item;
}

void page_put_number(cJSON *to, const char *name, double value, int digits)
{
  char text[LAB_SHOWN_TEXT];
  cJSON_AddStringToObject(to, name, lab_shown_number(value, digits, text));
}

void page_put_quantity(cJSON *to, const char *name, double value, const char *unit, int digits)
{
  char text[LAB_SHOWN_TEXT];
  cJSON_AddStringToObject(to, name, lab_shown_quantity(value, unit, digits, text));
}

void page_put_p(cJSON *to, const char *name, double p)
{
  char text[LAB_SHOWN_TEXT];
  cJSON_AddStringToObject(to, name, lab_shown_p(p, text));
}

void page_put_share(cJSON *to, const char *name, double share)
{
  page_put(to, name, "%.3g %%", 100 * fmin(fmax(share, 0), 1));
}

const char *page_effect_name(int effect)
{
  return pneu_effect_at(effect)->name;
}

int page_has_completed(const telling *t)
{
  return t->story->result->n_found > 0;
}

const char *page_unit(const lab_unknown *x)
{
  pneu_param_info info;
  const int is_listed = x->kind == LAB_UNKNOWN_PARAM && x->index != LAB_FIT_ORIFICE_AREA;
  return is_listed && pneu_param_describe(x->index, &info) == PNEU_OK ? info.unit : x->unit;
}

int page_digits(const telling *t, int j)
{
  const lab_fit_result *fit = &t->story->result->fit;
  const double value = fabs(t->story->completed->unknown[j].value), width = fit->high[j] - fit->low[j];
  if (fit->state[j] != LAB_FIT_FREE || !(width > 0) || !(value > width))
    return 4;
  return (int)fmin(fmax(4, 2 + ceil(log10(value / width))), 9);
}

void page_put_interval(const telling *t, int j, cJSON *to)
{
  const lab_fit_result *fit = &t->story->result->fit;
  const double scale = lab_shown_as(page_unit(&t->story->completed->unknown[j])).scale;
  const char *state = lab_fit_state_text(fit->state[j]);
  char low[LAB_SHOWN_TEXT], high[LAB_SHOWN_TEXT];
  lab_shown_number(scale * fit->low[j], page_digits(t, j), low);
  lab_shown_number(scale * fit->high[j], page_digits(t, j), high);
  switch (fit->state[j]) {
  case LAB_FIT_FREE:
    page_put(to, "interval", "%s .. %s", low, high);
    break;
  case LAB_FIT_AT_LOWER:
    page_put(to, "interval", "%s, at most %s", state, high);
    break;
  case LAB_FIT_AT_UPPER:
    page_put(to, "interval", "%s, at least %s", state, low);
    break;
  default:
    page_put(to, "interval", "%s", state);
  }
}

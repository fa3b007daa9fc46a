/* Values of the page: texts, numbers, what is known of an unknown. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/escape.h"
#include "../base/format.h"
#include "page_private.h"

/* Length of "(name)" at `at`, 0 if it is no effect's. */
static size_t bracketed_name(const char *at)
{
  int i;
  for (i = 0; *at == '(' && i < PNEU_EFFECT_COUNT; i++) {
    const size_t n = strlen(lab_page_effect_name(i));
    if (!strncmp(at + 1, lab_page_effect_name(i), n) && at[n + 1] == ')')
      return n + 2;
  }
  return 0;
}

void lab_page_put_coded(cJSON *to, const char *name, const char *text)
{
  char *html = NULL;
  size_t size;
  FILE *file = open_memstream(&html, &size);
  while (file && *text) {
    const size_t n = bracketed_name(text), plain = n ? 0 : 1 + strcspn(text + 1, "(");
    char part[LAB_SENTENCE_TEXT];
    snprintf(part, sizeof part, "%.*s", (int)(n ? n - 2 : plain), text + (n > 0));
    fputs(n ? "<code>" : "", file);
    lab_put_html(file, part);
    fputs(n ? "</code>" : "", file);
    text += n + plain;
  }
  if (file && fclose(file) == 0)
    cJSON_AddStringToObject(to, name, html);
  free(html);
}

void lab_page_put_number(cJSON *to, const char *name, double value, int digits)
{
  char text[LAB_FORMAT_TEXT];
  cJSON_AddStringToObject(to, name, lab_format_number(value, digits, text));
}

void lab_page_put_quantity(cJSON *to, const char *name, double value, const char *unit, int digits)
{
  char text[LAB_FORMAT_TEXT];
  cJSON_AddStringToObject(to, name, lab_format_quantity(value, unit, digits, text));
}

void lab_page_put_p(cJSON *to, const char *name, double p)
{
  char text[LAB_FORMAT_TEXT];
  cJSON_AddStringToObject(to, name, lab_format_p(p, text));
}

void lab_page_put_share(cJSON *to, const char *name, double share)
{
  lab_json_put(to, name, "%.3g %%", 100 * fmin(fmax(share, 0), 1));
}

const char *lab_page_effect_name(int effect)
{
  return pneu_effect_at(effect)->name;
}

int lab_page_has_completed(const lab_sources *t)
{
  return t->report->result->n_found > 0 || t->report->completed->rig.n_onsets > 0 || t->report->rig->n_fit == 0;
}

const char *lab_page_unit(const lab_unknown *x)
{
  pneu_param_info info;
  const int is_listed = x->kind == LAB_UNKNOWN_PARAM && x->index != LAB_PARAM_ORIFICE_AREA;
  return is_listed && pneu_param_describe(x->index, &info) == PNEU_OK ? info.unit : x->unit;
}

int lab_page_digits(const lab_sources *t, int j)
{
  const lab_fit_result *fit = &t->report->result->fit;
  const double value = fabs(t->report->completed->unknown[j].value), width = fit->high[j] - fit->low[j];
  if (fit->state[j] != LAB_STATE_FREE || !(width > 0) || !(value > width))
    return 4;
  return (int)fmin(fmax(4, 2 + ceil(log10(value / width))), 9);
}

void lab_page_put_interval(const lab_sources *t, int j, cJSON *to)
{
  const lab_fit_result *fit = &t->report->result->fit;
  const double scale = lab_format_as(lab_page_unit(&t->report->completed->unknown[j])).scale;
  const char *state = lab_fit_state_text(fit->state[j]);
  char low[LAB_FORMAT_TEXT], high[LAB_FORMAT_TEXT];
  lab_format_number(scale * fit->low[j], lab_page_digits(t, j), low);
  lab_format_number(scale * fit->high[j], lab_page_digits(t, j), high);
  switch (fit->state[j]) {
  case LAB_STATE_FREE:
    lab_json_put(to, "interval", "%s .. %s", low, high);
    break;
  case LAB_STATE_AT_LOWER:
    lab_json_put(to, "interval", "%s, at most %s", state, high);
    break;
  case LAB_STATE_AT_UPPER:
    lab_json_put(to, "interval", "%s, at least %s", state, low);
    break;
  default:
    lab_json_put(to, "interval", "%s", state);
  }
}

cJSON *lab_page_put_size(const lab_sources *t, int param, cJSON *list)
{
  const lab_unknowns *u = t->report->completed;
  const int j = lab_report_size(t->report, param);
  pneu_param_info info;
  cJSON *item = j < 0 ? NULL : lab_json_append(list);
  if (!item)
    return NULL;
  pneu_param_describe(param, &info);
  lab_json_put(item, "meaning", "%s", info.meaning);
  lab_page_put_quantity(item, "value", u->unknown[j].value, lab_page_unit(&u->unknown[j]), lab_page_digits(t, j));
  lab_json_put(item, "unit", "%s", lab_format_as(lab_page_unit(&u->unknown[j])).unit);
  lab_page_put_interval(t, j, item);
  return item;
}

/* Numbers of the valve signature, and the declared values beside those that the log asks for. */
#include <math.h>
#include <stdio.h>

#include "../base/format.h"
#include "page_private.h"
#include "signature.h"

static void put_row(const char *name, const double *value, int n, const char *unit, cJSON *list)
{
  cJSON *row = lab_json_append(list), *cells = cJSON_AddArrayToObject(row, "cells");
  char text[LAB_FORMAT_TEXT];
  int i;
  lab_json_put(row, "name", "%s", name);
  for (i = 0; i < n; i++)
    lab_json_say(cells, "%s", lab_format_quantity(value[i], unit, 4, text));
}

/* Numbers of each model, a row a kind. */
void lab_page_signature(const lab_sources *t, cJSON *page)
{
  lab_signature_model model[LAB_SIGNATURE_MODELS];
  double value[4][LAB_SIGNATURE_MODELS];
  const int n = lab_signature_models(t->report, model);
  cJSON *headings = cJSON_AddArrayToObject(page, "signature_headings");
  cJSON *rows = cJSON_AddArrayToObject(page, "signature_rows");
  int i;
  for (i = 0; i < n; i++) {
    const lab_signature *s = &model[i].signature;
    lab_json_say(headings, "%s", lab_curve_keys[model[i].key].label);
    value[0][i] = s->bench_lower;
    value[1][i] = s->bench_upper;
    value[2][i] = s->spring_rate;
    value[3][i] = s->band;
  }
  put_row("bench set, lower", value[0], n, "Pa", rows);
  put_row("bench set, upper", value[1], n, "Pa", rows);
  put_row("spring rate", value[2], n, "N/m", rows);
  put_row("friction band", value[3], n, "Pa", rows);
}

/* A tolerance: a share of what is declared, or a quantity where that is 0. */
static void put_tolerance(const lab_deviation *d, cJSON *row)
{
  if (isnan(d->tolerance))
    lab_json_put(row, "tolerance", "none");
  else if (d->declared != 0)
    lab_json_put(row, "tolerance", "%.3g %%", 100 * d->tolerance);
  else
    lab_page_put_quantity(row, "tolerance", d->tolerance, d->unit, 3);
}

void lab_page_deviations(const lab_sources *t, cJSON *page)
{
  const lab_deviations *all = &t->report->deviations;
  cJSON *list = cJSON_AddArrayToObject(page, "deviations");
  int i;
  for (i = 0; i < all->n; i++) {
    const lab_deviation *d = &all->of[i];
    const double scale = lab_format_as(d->unit).scale;
    char low[LAB_FORMAT_TEXT], high[LAB_FORMAT_TEXT], since[LAB_SINCE_TEXT];
    cJSON *row = lab_json_append(list);
    lab_json_put(row, "name", "%s", d->name);
    lab_page_put_quantity(row, "declared", d->declared, d->unit, 4);
    lab_page_put_quantity(row, "value", d->found, d->unit, 4);
    lab_json_put(row, "interval", "%s .. %s", lab_format_number(scale * d->lower, 4, low),
                 lab_format_number(scale * d->upper, 4, high));
    lab_page_put_number(row, "ratio", d->ratio, 3);
    put_tolerance(d, row);
    lab_json_put(row, "mood", "%s", d->beyond ? "bad" : "good");
    lab_json_put(row, "words", "%s", d->beyond ? "beyond" : "within");
    lab_json_put(row, "held", "%s", d->held ? "yes" : "");
    lab_json_put(row, "since", "%s", lab_report_since(lab_report_onset(t->report, d->param), since));
  }
  lab_json_put(page, "has_deviations", "%s", all->n ? "yes" : "");
}

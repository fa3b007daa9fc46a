/* Figures of merit. */
#include <math.h>
#include <string.h>

#include "../metrics/metricstext.h"
#include "page_private.h"

static const char *merit_model(const lab_sources *t)
{
  return lab_page_has_completed(t) ? "completed model" : "declared model, fitted";
}

/* A figure, as measured and as the model has it. */
static void put_figure(const lab_sources *t, int i, cJSON *list)
{
  const lab_metric *const both[] = {&t->report->measured->metric[i], &t->report->predicted->metric[i]};
  const lab_metric_info *info = &lab_metric_infos[i];
  const char *unit = strcmp(info->unit, "1") ? info->unit : "";
  cJSON *row, *cells;
  char value[LAB_METRIC_SHOWN];
  int k;
  if (isnan(both[0]->value) && isnan(both[1]->value))
    return;
  row = lab_json_append(list);
  lab_json_put(row, "meaning", "%s", info->meaning);
  lab_json_put(row, "standard", "%s", info->standard);
  cells = cJSON_AddArrayToObject(row, "cells");
  for (k = 0; k < 2; k++) {
    cJSON *cell = lab_json_append(cells);
    lab_json_put(cell, "label", "%s", k ? merit_model(t) : "measured");
    lab_json_put(cell, "value", "%s%s%s", lab_metric_value(both[k], value), *unit ? " " : "", unit);
    if (isfinite(both[k]->value) && !both[k]->at_most)
      lab_page_put_number(cell, "uncertainty", both[k]->uncertainty, 2);
  }
}

void lab_page_merit(const lab_sources *t, cJSON *page)
{
  const lab_metrics *measured = t->report->measured;
  cJSON *list, *missing;
  int i;
  if (!measured)
    return;
  lab_json_put(page, "merit_model", "%s", merit_model(t));
  lab_json_put(page, "step_signal", "%s", lab_metrics_step_signal(measured->command));
  lab_json_put(page, "static_signal", "%s", lab_metrics_static_signal(measured->command));
  list = cJSON_AddArrayToObject(page, "merit");
  missing = cJSON_AddArrayToObject(page, "without_merit");
  for (i = 0; i < LAB_METRIC_COUNT; i++) {
    put_figure(t, i, list);
    if (isnan(measured->metric[i].value)) {
      cJSON *item = lab_json_append(missing);
      lab_json_put(item, "figure", "%s", lab_metric_infos[i].key);
      lab_json_put(item, "reason", "%s", measured->metric[i].text);
    }
  }
}

/* Figures of merit. */
#include <math.h>
#include <string.h>

#include "../metrics/metricstext.h"
#include "page_private.h"

/* A figure, as measured and as the model has it. */
static void put_figure(const telling *t, int i, cJSON *list)
{
  const lab_metric *const both[] = {&t->story->measured->metric[i], &t->story->predicted->metric[i]};
  const lab_metric_info *info = &lab_metric_infos[i];
  const char *unit = strcmp(info->unit, "1") ? info->unit : "";
  cJSON *row, *cells;
  char value[LAB_METRIC_SHOWN];
  int k;
  if (isnan(both[0]->value) && isnan(both[1]->value))
    return;
  row = page_append(list);
  page_put(row, "meaning", "%s", info->meaning);
  page_put(row, "standard", "%s", info->standard);
  cells = cJSON_AddArrayToObject(row, "cells");
  for (k = 0; k < 2; k++) {
    cJSON *cell = page_append(cells);
    page_put(cell, "value", "%s%s%s", lab_metric_value(both[k], value), *unit ? " " : "", unit);
    if (isfinite(both[k]->value) && !both[k]->at_most)
      page_put_number(cell, "uncertainty", both[k]->uncertainty, 2);
  }
}

void page_merit(const telling *t, cJSON *page)
{
  const lab_metrics *measured = t->story->measured;
  cJSON *list, *missing;
  int i;
  if (!measured)
    return;
  page_put(page, "merit_model", "%s", page_has_completed(t) ? "completed model" : "declared model, fitted");
  page_put(page, "step_signal", "%s", lab_metrics_step_signal(measured->command));
  page_put(page, "static_signal", "%s", lab_metrics_static_signal(measured->command));
  list = cJSON_AddArrayToObject(page, "merit");
  missing = cJSON_AddArrayToObject(page, "without_merit");
  for (i = 0; i < LAB_METRIC_COUNT; i++) {
    put_figure(t, i, list);
    if (isnan(measured->metric[i].value)) {
      cJSON *item = page_append(missing);
      page_put(item, "figure", "%s", lab_metric_infos[i].key);
      page_put(item, "reason", "%s", measured->metric[i].text);
    }
  }
}

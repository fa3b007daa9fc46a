#include "history.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cjson/cJSON.h>

#include "../base/quantile.h"
#include "../trace/decide.h"

/* ---- One value ---- */

static int grow(lab_history *history, lab_error *error)
{
  lab_sample *grown;
  if (history->n < history->room)
    return LAB_OK;
  history->room = 2 * history->room + 64;
  grown = realloc(history->of, (size_t)history->room * sizeof *grown);
  if (!grown)
    return lab_fail_memory(error, "trends");
  history->of = grown;
  return LAB_OK;
}

static double number(const cJSON *from, const char *name)
{
  const cJSON *item = cJSON_GetObjectItemCaseSensitive(from, name);
  return cJSON_IsNumber(item) ? item->valuedouble : (double)NAN;
}

static const char *word(const cJSON *from, const char *name)
{
  const char *found = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(from, name));
  return found ? found : "";
}

/* Standard deviation from an interval of 95 %.  Returns: NaN without one */
static double deviation_of(const cJSON *value)
{
  const cJSON *ends = cJSON_GetObjectItemCaseSensitive(value, "ci95");
  const cJSON *low = cJSON_GetArrayItem(ends, 0), *high = cJSON_GetArrayItem(ends, 1);
  return cJSON_IsNumber(low) && cJSON_IsNumber(high)
             ? (high->valuedouble - low->valuedouble) / (2 * sqrt(lab_chi2_threshold(0.05)))
             : (double)NAN;
}

/* In:  found  the name of the value in the report */
static int add(lab_history *history, const lab_fleet_entry *line, const char *parameter, const cJSON *value,
               const char *found, lab_error *error)
{
  lab_sample *s;
  if (grow(history, error))
    return error->status;
  s = &history->of[history->n];
  s->place = history->n;
  snprintf(s->parameter, sizeof s->parameter, "%s", parameter);
  snprintf(s->unit, sizeof s->unit, "%s", word(value, "unit"));
  snprintf(s->date, sizeof s->date, "%s", line->date);
  s->declared = number(value, "declared");
  s->tolerance = number(value, "tolerance");
  s->at = line->day;
  s->value = number(value, found);
  s->deviation = deviation_of(value);
  if (!isfinite(s->value) || !(s->deviation > 0))
    return LAB_OK;
  s->rig = strdup(line->rig);
  if (!s->rig)
    return lab_fail_memory(error, "trends");
  history->n++;
  return LAB_OK;
}

/* ---- A report ---- */

/* What is held stands under "deviations" alone. */
static int add_report(lab_history *history, const lab_fleet_entry *line, const cJSON *report, lab_error *error)
{
  const cJSON *value;
  if (!strcmp(word(report, "verdict"), lab_verdict_text(LAB_VERDICT_UNDECIDED)))
    return LAB_OK;
  cJSON_ArrayForEach(value, cJSON_GetObjectItemCaseSensitive(report, "parameters"))
  {
    if (add(history, line, value->string, value, "value", error))
      return error->status;
  }
  cJSON_ArrayForEach(value, cJSON_GetObjectItemCaseSensitive(report, "deviations"))
  {
    if (cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(value, "held")) &&
        add(history, line, word(value, "parameter"), value, "found", error))
      return error->status;
  }
  return LAB_OK;
}

int lab_history_add(lab_history *history, const lab_fleet_entry *line, const char *folder, lab_error *error)
{
  char path[LAB_PATH_TEXT + 32];
  lab_text file;
  cJSON *report;
  int status;
  if (!*line->date)
    return LAB_OK;
  snprintf(path, sizeof path, "%s/report.json", folder);
  if (lab_text_read(path, &file, error))
    return error->status;
  report = cJSON_Parse(file.data);
  lab_text_free(&file);
  status = report ? add_report(history, line, report, error)
                  : lab_fail(error, LAB_DATA, "%s: this is no whole report; remove it and run again", path);
  cJSON_Delete(report);
  return status;
}

/* ---- All of them ---- */

static int in_order(const void *a, const void *b)
{
  const lab_sample *p = a, *q = b;
  const int rig = strcmp(p->rig, q->rig), parameter = rig ? rig : strcmp(p->parameter, q->parameter);
  if (parameter || p->at == q->at)
    return parameter ? parameter : p->place - q->place;
  return p->at < q->at ? -1 : 1;
}

void lab_history_sort(lab_history *history)
{
  if (history->n > 0)
    qsort(history->of, (size_t)history->n, sizeof *history->of, in_order);
}

void lab_history_free(lab_history *history)
{
  int i;
  for (i = 0; i < history->n; i++)
    free(history->of[i].rig);
  free(history->of);
  memset(history, 0, sizeof *history);
}

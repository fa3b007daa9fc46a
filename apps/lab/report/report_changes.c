/* What has changed since the baseline, in report.json and in a sentence. */
#include <math.h>
#include <stdio.h>

#include "../base/format.h"
#include "../base/json.h"
#include "../base/text.h"
#include "report.h"

/* "onset" or "end", where there is one. */
void lab_report_onset_json(cJSON *o, const char *name, const lab_onset *onset)
{
  cJSON *at;
  if (!onset || !onset->known)
    return;
  at = cJSON_AddObjectToObject(o, name);
  cJSON_AddNumberToObject(at, "t", onset->t);
  cJSON_AddStringToObject(at, "unit", "s");
  lab_json_range(at, "ci95", onset->low, onset->high);
}

static void add_change(cJSON *list, const lab_change *change)
{
  char name[LAB_PARAM_NAME_TEXT];
  cJSON *o = lab_json_append(list), *alike;
  int i;
  cJSON_AddStringToObject(o, "what", lab_change_name(change->param, name));
  cJSON_AddStringToObject(o, "parameter", lab_fit_name(change->param, name));
  lab_json_numbers(o, (const lab_json_named[]){{"then", change->then}, {"now", change->now}, {NULL, 0}});
  cJSON_AddStringToObject(o, "unit", lab_change_unit(change));
  lab_json_range(o, "ci95", change->low, change->high);
  alike = cJSON_AddArrayToObject(o, "indistinguishable_from");
  for (i = 0; i < change->n_alike; i++)
    lab_json_say(alike, "%s", lab_change_name(change->alike[i], name));
  lab_json_numbers(o,
                   (const lab_json_named[]){{"statistic", change->statistic}, {"p_value", change->p_value}, {NULL, 0}});
  lab_report_onset_json(o, "onset", &change->begin);
  lab_report_onset_json(o, "end", &change->end);
}

void lab_report_changes(const lab_changes *changes, cJSON *root)
{
  cJSON *list;
  int i;
  cJSON_AddStringToObject(root, "condition", lab_since_text(changes->condition));
  list = cJSON_AddArrayToObject(root, "changes");
  for (i = 0; i < changes->n; i++)
    add_change(list, &changes->change[i]);
}

/* "dry_friction from 480 N to 724 N (1.51 times) since 14.2 s" */
static void say_change(const lab_change *change, char *text, size_t size)
{
  char name[LAB_PARAM_NAME_TEXT], then[LAB_FORMAT_TEXT], now[LAB_FORMAT_TEXT], ratio[LAB_FORMAT_TEXT];
  char begin[LAB_FORMAT_TEXT], end[LAB_FORMAT_TEXT];
  const char *unit = lab_change_unit(change);
  lab_change_name(change->param, name);
  lab_format_quantity(change->now, unit, 3, now);
  if (change->then == 0)
    lab_append(text, size, "%s of %s", name, now);
  else
    lab_append(text, size, "%s from %s to %s (%s times)", name, lab_format_quantity(change->then, unit, 3, then), now,
               lab_format_number(change->now / change->then, 3, ratio));
  if (change->begin.known)
    lab_append(text, size, " since %s s", lab_format_number(change->begin.t, 4, begin));
  if (change->end.known)
    lab_append(text, size, " until %s s", lab_format_number(change->end.t, 4, end));
}

void lab_report_change_sentence(const lab_changes *changes, char *text, size_t size)
{
  int i;
  if (changes->condition == LAB_SINCE_UNCHANGED)
    snprintf(text, size, "As it was: nothing has changed since the baseline. ");
  if (changes->condition == LAB_SINCE_CANNOT_TELL)
    snprintf(text, size, "Whether anything has changed since the baseline cannot be told: %s. ", changes->why);
  if (changes->condition != LAB_SINCE_CHANGED)
    return;
  snprintf(text, size, "Changed since the baseline: ");
  for (i = 0; i < changes->n; i++) {
    lab_append(text, size, "%s", i ? ", " : "");
    say_change(&changes->change[i], text, size);
  }
  lab_append(text, size, ". ");
}

#include "metricstext.h"

#include <math.h>

#include "../base/format.h"
#include "../base/json.h"

static const char *const fates[] = {"",
                                    "the signal takes its time",
                                    "gap",
                                    "the stem was not at rest before it",
                                    "not settled before the next step or the end",
                                    "too small a movement"};

/* ---- For people ---- */

const char *lab_metric_value(const lab_metric *metric, char text[LAB_METRIC_SHOWN])
{
  char number[LAB_FORMAT_TEXT];
  snprintf(text, LAB_METRIC_SHOWN, "%s%s", metric->at_most && isfinite(metric->value) ? "<= " : "",
           lab_format_number(metric->value, 4, number));
  return text;
}

static void print_figures(FILE *file, const lab_metrics *metrics)
{
  int i;
  fprintf(file, "%-21s %10s %9s %-4s %-39s %s\n", "figure", "value", "+/-", "unit", "standard", "from, or why not");
  for (i = 0; i < LAB_METRIC_COUNT; i++) {
    const lab_metric *metric = &metrics->metric[i];
    const lab_metric_info *info = &lab_metric_infos[i];
    char value[LAB_METRIC_SHOWN], error[LAB_FORMAT_TEXT];
    fprintf(file, "%-21s %10s %9s %-4s %-39s %s\n", info->key, lab_metric_value(metric, value),
            lab_format_number(metric->at_most ? (double)NAN : metric->uncertainty, 2, error), info->unit,
            info->standard, metric->text);
  }
}

static int kept(const lab_metrics *metrics)
{
  return metrics->n_steps < LAB_METRIC_STEPS ? metrics->n_steps : LAB_METRIC_STEPS;
}

static void print_step(FILE *file, const lab_metrics *metrics, const lab_step_response *step)
{
  const double scale =
      metrics->command == LAB_COMMAND_OPENING || metrics->command == LAB_COMMAND_SET_POSITION ? 1 : 1e-3;
  fprintf(file, "%9.6g %9.6g %9.6g %9.5g %9.5g ", step->t, scale * step->from, scale * step->to, 1e3 * step->x_from,
          1e3 * step->x_to);
  if (step->fate == LAB_STEP_GOOD)
    fprintf(file, "%9.4g %9.4g %9.4g %9.4g %9.3g\n", step->dead_time, step->t63, step->t86, step->settling_time,
            step->overshoot);
  else
    fprintf(file, "  %s\n", fates[step->fate]);
}

void lab_metrics_print(FILE *file, const lab_metrics *metrics)
{
  int i;
  fprintf(file, "Steps are of the %s; static figures set position against %s.\n\n",
          lab_metrics_step_signal(metrics->command), lab_metrics_static_signal(metrics->command));
  print_figures(file, metrics);
  if (metrics->n_steps == 0)
    return;
  fprintf(file, "\n%9s %9s %9s %9s %9s %9s %9s %9s %9s %9s\n", "step [s]", "from", "to", "x [mm]", "to [mm]", "Td [s]",
          "T63 [s]", "T86 [s]", "2 % [s]", "over [%]");
  for (i = 0; i < kept(metrics); i++)
    print_step(file, metrics, &metrics->step[i]);
  if (kept(metrics) < metrics->n_steps)
    fprintf(file, "and %d steps more\n", metrics->n_steps - kept(metrics));
}

/* ---- For programs ---- */

cJSON *lab_metrics_object(const lab_metrics *metrics)
{
  cJSON *all = cJSON_CreateObject();
  int i;
  for (i = 0; i < LAB_METRIC_COUNT; i++) {
    const lab_metric *metric = &metrics->metric[i];
    const lab_metric_info *info = &lab_metric_infos[i];
    cJSON *o = cJSON_AddObjectToObject(all, info->key);
    cJSON_AddNumberToObject(o, "value", metric->value);
    cJSON_AddStringToObject(o, "unit", info->unit);
    if (isnan(metric->value)) {
      cJSON_AddStringToObject(o, "reason", metric->text);
      continue;
    }
    cJSON_AddNumberToObject(o, "uncertainty", metric->uncertainty);
    cJSON_AddBoolToObject(o, "at_most", metric->at_most);
    cJSON_AddStringToObject(o, "standard", info->standard);
    cJSON_AddStringToObject(o, "basis", metric->text);
  }
  return all;
}

static void add_step(cJSON *list, const lab_step_response *step)
{
  cJSON *o = lab_json_append(list);
  LAB_JSON_NUMBERS(o, {"t", step->t}, {"from", step->from}, {"to", step->to}, {"x_from", step->x_from},
                   {"x_to", step->x_to}, {"dead_time", step->dead_time}, {"t63", step->t63}, {"t86", step->t86},
                   {"settling_time", step->settling_time}, {"overshoot", step->overshoot});
  if (step->fate != LAB_STEP_GOOD)
    cJSON_AddStringToObject(o, "reason", fates[step->fate]);
}

int lab_metrics_json(FILE *file, const lab_metrics *metrics, lab_error *error)
{
  cJSON *root = cJSON_CreateObject(), *list;
  int i;
  cJSON_AddStringToObject(root, "step_signal", lab_metrics_step_signal(metrics->command));
  cJSON_AddStringToObject(root, "static_signal", lab_metrics_static_signal(metrics->command));
  cJSON_AddItemToObject(root, "metrics", lab_metrics_object(metrics));
  list = cJSON_AddArrayToObject(root, "steps");
  for (i = 0; i < kept(metrics); i++)
    add_step(list, &metrics->step[i]);
  return lab_json_write(file, root, "figures of merit", error);
}

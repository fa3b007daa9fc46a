#include "sets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <cjson/cJSON.h>

#include "../lab/outfile.h"
#include "../lab/text.h"
#include "../lab/units.h"

enum { PATH_BYTES = 1024, CELL = 96 };

static const char *text_of(const config_setting_t *set, const char *key)
{
  const char *text = "";
  config_setting_lookup_string(set, key, &text);
  return text;
}

static cJSON *read_json(const char *out_dir, const config_setting_t *set)
{
  char path[PATH_BYTES];
  lab_error ignored;
  lab_text text;
  cJSON *json;
  snprintf(path, sizeof path, "%s/%s/report.json", out_dir, text_of(set, "name"));
  if (lab_text_read(path, &text, &ignored))
    return NULL;
  json = cJSON_ParseWithLength(text.data, text.size);
  lab_text_free(&text);
  return json;
}

static const cJSON *member(const cJSON *at, const char *key)
{
  return cJSON_GetObjectItemCaseSensitive(at, key);
}

/* One error of a report. */
typedef struct reading {
  double value, in_noise; /* NaN where the report has none */
} reading;

/* In:  when  "before", "after"; held  of the logs held out;  unit  to convert to */
static reading read_error(const cJSON *json, int held, const char *when, const char *channel, const char *unit)
{
  const cJSON *error = member(json, "error"), *at = member(held ? member(error, "holdout") : error, when);
  const cJSON *found = member(at, channel), *rmse = member(found, "rmse"), *noise = member(found, "in_noise");
  const char *own = cJSON_GetStringValue(member(found, "unit"));
  reading r = {(double)NAN, cJSON_IsNumber(noise) ? noise->valuedouble : (double)NAN};
  double scale, offset;
  lab_error ignored;
  if (cJSON_IsNumber(rmse) && own && lab_unit_factor(own, unit, &scale, &offset, &ignored) == LAB_OK)
    r.value = scale * rmse->valuedouble;
  return r;
}

static const char *number(char *cell, double value)
{
  if (isnan(value))
    strcpy(cell, "-");
  else
    snprintf(cell, CELL, value < 1000 ? "%.3g" : "%.0f", value);
  return cell;
}

/* "before | after | before in noise | after in noise" of a channel. */
static void write_pair(FILE *file, const cJSON *json, int held, const char *channel, const char *unit)
{
  const reading before = read_error(json, held, "before", channel, unit);
  const reading after = read_error(json, held, "after", channel, unit);
  char a[CELL], b[CELL], c[CELL], d[CELL];
  fprintf(file, " %s | %s | %s | %s |", number(a, before.value), number(b, after.value), number(c, before.in_noise),
          number(d, after.in_noise));
}

static void write_names(FILE *file, const cJSON *json)
{
  const cJSON *found, *list = member(json, "found");
  int any = 0;
  cJSON_ArrayForEach(found, list)
      fprintf(file, "%s%s", any++ ? ", " : " ", cJSON_GetStringValue(member(found, "effect")));
  if (cJSON_GetArraySize(member(json, "unlisted")) > 0)
    fprintf(file, "%sa term without a name", any++ ? ", " : " ");
  fputs(any ? " |\n" : " none |\n", file);
}

static void write_row(FILE *file, const sets_result *r, const cJSON *json)
{
  const char *judged = text_of(r->set, "judged"), *check = text_of(r->set, "check");
  fprintf(file, "| [%s](%s/report.json) | %s [%s] |", text_of(r->set, "title"), text_of(r->set, "name"), judged,
          text_of(r->set, "unit"));
  if (!json) {
    fputs(r->state == SETS_ABSENT ? " data absent | | | | | | | | |\n" : " closeloop failed | | | | | | | | |\n", file);
    return;
  }
  write_pair(file, json, 0, judged, text_of(r->set, "unit"));
  write_pair(file, json, 1, judged, text_of(r->set, "unit"));
  write_names(file, json);
  if (*check) {
    const char *unit = text_of(r->set, "check_unit");
    char a[CELL], b[CELL];
    fprintf(file, "| - held out: | %s [%s] | | | | | %s | %s | | | |\n", check, unit,
            number(a, read_error(json, 0, "before", check, unit).value),
            number(b, read_error(json, 0, "after", check, unit).value));
  }
}

/* "value +- half width unit" of each parameter in a group. */
static void write_parameters(FILE *file, const cJSON *group)
{
  const cJSON *p;
  cJSON_ArrayForEach(p, group)
  {
    const cJSON *value = member(p, "value"), *ci = member(p, "ci95");
    const cJSON *low = cJSON_GetArrayItem(ci, 0), *high = cJSON_GetArrayItem(ci, 1);
    if (!cJSON_IsNumber(value))
      continue;
    fprintf(file, "  - %s = %.4g", p->string, value->valuedouble);
    if (cJSON_IsNumber(low) && cJSON_IsNumber(high))
      fprintf(file, " (%.4g to %.4g)", low->valuedouble, high->valuedouble);
    fprintf(file, " %s\n", cJSON_GetStringValue(member(p, "unit")));
  }
}

static void write_alike(FILE *file, const cJSON *json)
{
  const cJSON *found, *other;
  cJSON_ArrayForEach(found, member(json, "found"))
  {
    const cJSON *list = member(found, "indistinguishable_from");
    int any = 0;
    cJSON_ArrayForEach(other, list)
        fprintf(file, "%s%s", any++ ? ", " : "- The log fitted cannot tell it from: ", cJSON_GetStringValue(other));
    if (any)
      fprintf(file, " (for %s).\n", cJSON_GetStringValue(member(found, "effect")));
  }
}

static void write_logs(FILE *file, const config_setting_t *set, const char *list, const char *words)
{
  const config_setting_t *logs = config_setting_get_member((config_setting_t *)set, list);
  int i;
  for (i = 0; i < config_setting_length(logs); i++)
    fprintf(file, "%s%s", i ? ", " : words, config_setting_get_string_elem(logs, i));
  if (i > 0)
    fputs(".\n", file);
}

/* An error in another quantity, by a factor that the set declares: 2.1 kPa per mm of a spring. */
static void write_converted(FILE *file, const sets_result *r, const cJSON *json)
{
  double factor = 0;
  char a[CELL], b[CELL], c[CELL], d[CELL];
  const char *judged = text_of(r->set, "judged"), *unit = text_of(r->set, "unit");
  if (!config_setting_lookup_float(r->set, "per_unit", &factor))
    return;
  fprintf(file, "- In %s, at %.4g a %s: %s before, %s after; held out %s and %s.\n", text_of(r->set, "per_name"),
          factor, unit, number(a, factor * read_error(json, 0, "before", judged, unit).value),
          number(b, factor * read_error(json, 0, "after", judged, unit).value),
          number(c, factor * read_error(json, 1, "before", judged, unit).value),
          number(d, factor * read_error(json, 1, "after", judged, unit).value));
}

static void write_section(FILE *file, const sets_result *r, const cJSON *json)
{
  const char *sentence = cJSON_GetStringValue(member(json, "sentence"));
  fprintf(file, "\n## %s\n\n", text_of(r->set, "title"));
  fprintf(file, "- Declared ([rig file](../../study/measured/%s)): %s.\n", text_of(r->set, "rig"),
          text_of(r->set, "declared"));
  write_logs(file, r->set, "fit", "- Fitted: ");
  write_logs(file, r->set, "holdout", "- Held out: ");
  fprintf(file, "- Independent check: %s\n", text_of(r->set, "independent"));
  if (json) {
    fprintf(file,
            "- closeloop says: %s\n- Parameters of the completed model (95 %% intervals, noise taken as white):\n",
            sentence ? sentence : "");
    write_parameters(file, member(json, "parameters"));
    write_alike(file, json);
    write_converted(file, r, json);
  }
  fprintf(file, "- What is left: %s\n", text_of(r->set, "remains"));
}

static const char head[] =
    "# Measured sets\n\n"
    "Made by `make measured`; every number below is read from a report.json that closeloop wrote. Each set is one rig "
    "file and some raw logs of other people ([where they are from](../../study/measured/fetch.sh)), read as they are: "
    "what is left out or put in before a fit is in the group `log` of the rig file. The declared model is fitted "
    "(`before`), what it lacks is traced and added (`after`), and both are tried on runs that took no part. Errors are "
    "root mean squares, in the unit of the row and in standard deviations of the sensor's noise (1 = nothing left).\n\n"
    "| set | channel | before | after | in noise | in noise | held out before | held out after | in noise | in noise | "
    "found |\n|---|---|---|---|---|---|---|---|---|---|---|\n";

int sets_report(const sets_result *result, int n, const char *out_dir, lab_error *error)
{
  cJSON *json[SETS_MAX];
  char path[PATH_BYTES];
  lab_outfile out;
  int i;
  snprintf(path, sizeof path, "%s/REPORT.md", out_dir);
  if (lab_out_open(&out, path, error))
    return error->status;
  fputs(head, out.file);
  for (i = 0; i < n; i++) {
    json[i] = result[i].state == SETS_DONE ? read_json(out_dir, result[i].set) : NULL;
    write_row(out.file, &result[i], json[i]);
  }
  for (i = 0; i < n; i++) {
    write_section(out.file, &result[i], json[i]);
    cJSON_Delete(json[i]);
  }
  return lab_out_close(&out, error);
}

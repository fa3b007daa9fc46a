#include "trends.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/escape.h"
#include "../base/format.h"
#include "../base/json.h"
#include "../base/outfile.h"
#include "../base/quantile.h"
#include "../base/text.h"
#include "../trace/decide.h"

static const double chance = 0.05; /* of an interval that leaves out the truth */

/* The view box of a sparkline, with room for the width of its lines. */
enum { WIDTH = 120, HEIGHT = 28, MARGIN = 2 };

/* ---- A value of a report ---- */

static double number(const cJSON *from, const char *name)
{
  return cJSON_GetNumberValue(cJSON_GetObjectItemCaseSensitive(from, name));
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
  const double low = cJSON_GetNumberValue(cJSON_GetArrayItem(ends, 0));
  return (cJSON_GetNumberValue(cJSON_GetArrayItem(ends, 1)) - low) / (2 * sqrt(lab_chi2_threshold(0.05)));
}

/* In:  found  the name of the value in the report */
static int add(lab_history *history, const lab_fleet_entry *line, const char *parameter, const cJSON *value,
               const char *found, lab_error *error)
{
  lab_sample *s = realloc(history->of, (size_t)(history->n + 1) * sizeof *s);
  if (!s)
    return lab_fail_memory(error, "trends");
  history->of = s;
  s += history->n;
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

/* ---- Trends ---- */

/* Days until the line is further from the declared value than the tolerance. */
static void find_days(lab_trend *t)
{
  const lab_sample *last = t->last;
  const double tolerance = last->declared != 0 ? last->tolerance * fabs(last->declared) : last->tolerance;
  int i;
  for (i = 0; i < 3; i++)
    t->days[i] = t->drifts && tolerance > 0 ? 0 : (double)NAN;
  if (t->days[0] == 0 && fabs(lab_line_value(&t->line, last->at) - last->declared) < tolerance &&
      lab_line_reaches(&t->line, last->declared + copysign(tolerance, t->slope), chance, t->days))
    for (i = 0; i < 3; i++)
      t->days[i] = fmax(t->days[i] - last->at, 0);
}

/* In:  n  trends of one rig */
static void judge(lab_trend *trend, int n)
{
  int i;
  trend->n_of_rig = n;
  for (i = 0; i < n; i++) {
    lab_trend *t = &trend[i];
    t->slope = lab_line_slope(&t->line);
    t->half = lab_line_half(&t->line, chance);
    t->drifts = fabs(t->slope) > lab_line_half(&t->line, chance / n);
    find_days(t);
  }
}

/* One trend from the samples of a parameter.  Returns: the sample after them */
static const lab_sample *gather(const lab_sample *first, const lab_sample *end, lab_trend *t)
{
  const lab_sample *s;
  *t = (lab_trend){.first = first};
  for (s = first; s < end && !strcmp(first->rig, s->rig) && !strcmp(first->parameter, s->parameter); s++)
    lab_line_add(&t->line, s->at, s->value, s->deviation);
  t->last = s - 1;
  return s;
}

int lab_trends_find(const lab_history *history, lab_trends *trends, lab_error *error)
{
  const lab_sample *s = history->of, *end = s + history->n;
  int from, i;
  trends->of = malloc(((size_t)history->n + 1) * sizeof *trends->of);
  if (!trends->of)
    return lab_fail_memory(error, "trends");
  while (s < end) {
    s = gather(s, end, &trends->of[trends->n]);
    trends->n += lab_line_is_there(&trends->of[trends->n].line);
  }
  for (from = 0, i = 1; i <= trends->n; i++)
    if (i == trends->n || strcmp(trends->of[from].first->rig, trends->of[i].first->rig) != 0) {
      judge(&trends->of[from], i - from);
      from = i;
    }
  return LAB_OK;
}

void lab_trends_free(lab_trends *trends)
{
  free(trends->of);
  *trends = (lab_trends){0};
}

/* ---- Sentences ---- */

/* "10 %", or "5.00 kPa" */
static const char *tolerance_text(const lab_sample *s, char text[LAB_FORMAT_TEXT])
{
  if (s->declared == 0)
    return lab_format_quantity(s->tolerance, s->unit, 3, text);
  snprintf(text, LAB_FORMAT_TEXT, "%.3g %%", 100 * s->tolerance);
  return text;
}

const char *lab_trend_sentence(const lab_trend *t, char sentence[LAB_TREND_SENTENCE])
{
  enum { ROOM = LAB_TREND_SENTENCE };
  const double size = fabs(t->slope), scale = lab_format_as(t->last->unit).scale;
  char tolerance[LAB_FORMAT_TEXT];
  *sentence = '\0';
  if (!t->drifts)
    return sentence;
  lab_append(sentence, ROOM, "%s ", t->last->parameter);
  tolerance_text(t->last, tolerance);
  if (t->days[0] > 0)
    lab_append(sentence, ROOM, "leaves its tolerance of %s in %.0f days (%.0f to %.0f)", tolerance, t->days[0],
               t->days[1], t->days[2]);
  if (t->days[0] == 0)
    lab_append(sentence, ROOM, "is outside its tolerance of %s and ", tolerance);
  if (!(t->days[0] > 0))
    lab_append(sentence, ROOM, "%s by %s a day (%s to %s)", t->slope > 0 ? "rises" : "falls",
               LAB_QUANTITY(size, t->last->unit, 3), LAB_NUMBER(scale * (size - t->half), 3),
               LAB_NUMBER(scale * (size + t->half), 3));
  return sentence;
}

/* ---- trends.csv ---- */

static void put_row(FILE *file, const lab_trend *t)
{
  const double number[] = {t->slope,
                           t->slope - t->half,
                           t->slope + t->half,
                           t->days[0],
                           t->days[1],
                           t->days[2],
                           lab_line_value(&t->line, t->last->at),
                           t->last->declared,
                           t->last->tolerance,
                           lab_line_scatter(&t->line)};
  size_t i;
  lab_put_users_cell(file, t->last->rig);
  fprintf(file, ",%s,%s,%d,", t->last->parameter, t->last->unit, t->line.n);
  lab_put_cell(file, t->first->date);
  fputc(',', file);
  lab_put_cell(file, t->last->date);
  for (i = 0; i < sizeof number / sizeof *number; i++)
    fprintf(file, isfinite(number[i]) ? ",%.6g" : ",", number[i]);
  fputc('\n', file);
}

int lab_trends_write(const lab_trends *trends, const char *path, lab_error *error)
{
  lab_outfile out;
  int i;
  if (trends->n == 0) {
    remove(path); /* it would be that of a list that had dates */
    return LAB_OK;
  }
  if (lab_out_open(&out, path, error))
    return error->status;
  fputs("rig,parameter,unit,n,first_date,last_date,slope_per_day,slope_low,slope_high,days_left,days_left_low,"
        "days_left_high,last_value,declared,tolerance,scatter\n",
        out.file);
  for (i = 0; i < trends->n; i++)
    put_row(out.file, &trends->of[i]);
  return lab_out_close(&out, error);
}

/* ---- On the page of a batch ---- */

/* What the view box shows. */
typedef struct view {
  double from, to, low, high;
} view;

static view view_of(const lab_trend *t)
{
  view v = {t->first->at, t->last->at, HUGE_VAL, -HUGE_VAL};
  const lab_sample *s;
  for (s = t->first; s <= t->last; s++) {
    v.low = fmin(v.low, s->value - 2 * s->deviation);
    v.high = fmax(v.high, s->value + 2 * s->deviation);
  }
  return v;
}

/* A point of a path; M: the pen moves there, L: it draws. */
static void put_point(FILE *file, char how, const view *v, double at, double value)
{
  fprintf(file, "%c%.1f %.1f", how, MARGIN + (WIDTH - 2 * MARGIN) * (at - v->from) / (v->to - v->from),
          HEIGHT - MARGIN - (HEIGHT - 2 * MARGIN) * (value - v->low) / (v->high - v->low));
}

/* A path of SVG: the intervals of 95 %, upright, and the fitted line. */
static void add_path(const lab_trend *t, cJSON *to)
{
  const view v = view_of(t);
  const lab_sample *s;
  lab_writing w;
  char *path;
  if (lab_writing_begin(&w)) {
    for (s = t->first; s <= t->last; s++) {
      put_point(w.file, 'M', &v, s->at, s->value - 2 * s->deviation);
      put_point(w.file, 'L', &v, s->at, s->value + 2 * s->deviation);
    }
    put_point(w.file, 'M', &v, v.from, lab_line_value(&t->line, v.from));
    put_point(w.file, 'L', &v, v.to, lab_line_value(&t->line, v.to));
  }
  path = lab_writing_end(&w);
  lab_json_put(to, "path", "%s", path ? path : "");
  free(path);
}

static void add_parameter(const lab_trend *t, cJSON *parameters, cJSON *sentences)
{
  cJSON *item = lab_json_append(parameters);
  char sentence[LAB_TREND_SENTENCE];
  lab_json_put(item, "name", "%s", t->last->parameter);
  lab_json_put(item, "drifts", "%s", t->drifts ? "drifts" : "");
  lab_json_put(item, "first", "%s", LAB_QUANTITY(lab_line_value(&t->line, t->first->at), t->last->unit, 3));
  lab_json_put(item, "last", "%s", LAB_QUANTITY(lab_line_value(&t->line, t->last->at), t->last->unit, 3));
  add_path(t, item);
  if (*lab_trend_sentence(t, sentence))
    lab_json_say(sentences, "%s", sentence);
}

void lab_trends_page(const lab_trends *trends, cJSON *page)
{
  cJSON *list = cJSON_AddArrayToObject(page, "trends"), *parameters = NULL, *sentences = NULL;
  int i;
  lab_json_put(page, "has_trends", "%s", trends->n ? "yes" : "");
  for (i = 0; i < trends->n; i++) {
    if (trends->of[i].n_of_rig) {
      cJSON *rig = lab_json_append(list);
      lab_json_put(rig, "rig", "%s", trends->of[i].first->rig);
      parameters = cJSON_AddArrayToObject(rig, "parameters");
      sentences = cJSON_AddArrayToObject(rig, "sentences");
    }
    add_parameter(&trends->of[i], parameters, sentences);
  }
}

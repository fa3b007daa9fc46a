/* The trends on the page of a batch. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "../base/format.h"
#include "../base/json.h"
#include "trends.h"

/* The view box of a sparkline, with room for the width of its lines. */
enum { WIDTH = 120, HEIGHT = 28, MARGIN = 2 };

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
static void put_path(FILE *file, const lab_trend *t)
{
  const view v = view_of(t);
  const lab_sample *s;
  for (s = t->first; s <= t->last; s++) {
    put_point(file, 'M', &v, s->at, s->value - 2 * s->deviation);
    put_point(file, 'L', &v, s->at, s->value + 2 * s->deviation);
  }
  put_point(file, 'M', &v, v.from, lab_line_value(&t->line, v.from));
  put_point(file, 'L', &v, v.to, lab_line_value(&t->line, v.to));
}

static void add_path(const lab_trend *t, cJSON *to)
{
  char *path = NULL;
  size_t size;
  FILE *file = open_memstream(&path, &size);
  if (file) {
    put_path(file, t);
    fclose(file);
  }
  cJSON_AddStringToObject(to, "path", path ? path : "");
  free(path);
}

static void add_parameter(const lab_trend *t, cJSON *parameters, cJSON *sentences)
{
  cJSON *item = lab_json_append(parameters);
  char value[LAB_FORMAT_TEXT], sentence[LAB_TREND_SENTENCE];
  lab_json_put(item, "name", "%s", t->last->parameter);
  lab_json_put(item, "drifts", "%s", t->drifts ? "drifts" : "");
  lab_json_put(item, "first", "%s",
               lab_format_quantity(lab_line_value(&t->line, t->first->at), t->last->unit, 3, value));
  lab_json_put(item, "last", "%s", lab_format_quantity(lab_line_value(&t->line, t->last->at), t->last->unit, 3, value));
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

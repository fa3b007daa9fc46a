/* The figures: their words and switches, and the data that the script draws. */
#include <stdio.h>
#include <stdlib.h>

#include "../base/template.h"
#include "page_private.h"
#include "pagetext.h"

/* The switches of a figure: those of its curves that can be told from others. */
static void put_keys(const lab_figure *figure, cJSON *list)
{
  int key;
  for (key = 0; key < LAB_KEYS; key++) {
    cJSON *item;
    if (!*lab_curve_keys[key].label || !lab_figure_curve(figure, key))
      continue;
    item = lab_json_append(list);
    lab_json_put(item, "key", "%s", lab_curve_keys[key].name);
    lab_json_put(item, "label", "%s", lab_curve_keys[key].label);
  }
}

/* A figure as HTML, under its name.  Returns: 0 without memory */
static int put_figure(const lab_figure *figure, const char *template, cJSON *page)
{
  char *text = NULL;
  size_t size;
  FILE *file = open_memstream(&text, &size);
  cJSON *values = cJSON_CreateObject();
  lab_error error;
  int failed = !file;
  lab_json_put(values, "name", "%s", figure->name);
  lab_json_put(values, "title", "%s", figure->title);
  lab_json_put(values, "subtitle", "%s", figure->subtitle);
  lab_json_put(values, "reading", "%s", figure->reading);
  lab_json_put(values, "alt", "%s", figure->alt);
  lab_json_put(values, "across", "%d", figure->across);
  put_keys(figure, cJSON_AddArrayToObject(values, "keys"));
  if (file) {
    failed = lab_template_write(file, template, values, &error) != LAB_OK;
    failed |= fclose(file) != 0;
  }
  cJSON_Delete(values);
  if (!failed)
    cJSON_AddStringToObject(page, figure->name, text);
  free(text);
  return !failed;
}

/* The data of all, under "curves".  Returns: 0 without memory */
static int put_data(const lab_figures *figures, cJSON *page)
{
  char *text = NULL;
  size_t size;
  FILE *file = open_memstream(&text, &size);
  if (!file)
    return 0;
  lab_figures_json(figures, file);
  if (fclose(file) == 0)
    cJSON_AddStringToObject(page, "curves", text);
  free(text);
  return cJSON_GetObjectItem(page, "curves") != NULL;
}

int lab_page_figures(const lab_sources *t, cJSON *page)
{
  char *template = lab_page_text("figure", NULL);
  int i, done = template && put_data(t->figures, page);
  for (i = 0; i < t->figures->n && done; i++)
    done = put_figure(&t->figures->figure[i], template, page);
  free(template);
  return done;
}

/* The drawings, their switches, and what can be read off them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/template.h"
#include "page_private.h"
#include "pagetext.h"
#include "svginline.h"

/* What the keys of curves mean. */
static const struct {
  const char *key, *label;
  const char *brief; /* beside a value */
  int is_switch;     /* whether a curve of it can be switched off */
} curves[] = {{"measured", "measured", "measured", 1},
              {"before", "declared model, fitted", "declared", 1},
              {"after", "completed model", "completed", 1},
              {"band", "99 % of white noise", "99 % of noise", 1},
              {"term", "fitted term", "", 0},
              {"command", "command", "", 0}};
enum { CURVES = sizeof curves / sizeof *curves };

/* The switches of a figure: those of its keys that there is something of. */
static void put_keys(const telling *t, const lab_figure *figure, cJSON *list)
{
  size_t i;
  for (i = 0; i < CURVES; i++) {
    cJSON *item;
    if (!curves[i].is_switch || !strstr(figure->keys, curves[i].key) ||
        (!strcmp(curves[i].key, "after") && !page_has_completed(t)))
      continue;
    item = page_append(list);
    page_put(item, "key", "%s", curves[i].key);
    page_put(item, "label", "%s", curves[i].label);
  }
}

/* A figure as HTML, to be freed; NULL without memory. */
static char *figure_html(const telling *t, const lab_figure *figure, const char *template)
{
  char *svg = lab_svg_inline(figure->svg, figure->name, figure->alt, figure->head), *text = NULL;
  size_t size;
  FILE *file = svg ? open_memstream(&text, &size) : NULL;
  cJSON *values = cJSON_CreateObject();
  lab_error error;
  int failed = !file;
  page_put(values, "name", "%s", figure->name);
  page_put(values, "title", "%s", figure->title);
  page_put(values, "subtitle", "%s", figure->subtitle);
  page_put(values, "reading", "%s", figure->reading);
  put_keys(t, figure, cJSON_AddArrayToObject(values, "keys"));
  if (file) {
    cJSON_AddItemToObject(values, "svg", cJSON_CreateStringReference(svg));
    failed = lab_template_write(file, template, values, &error) != LAB_OK;
    failed |= fclose(file) != 0;
  }
  cJSON_Delete(values);
  free(svg);
  if (failed) {
    free(text);
    text = NULL;
  }
  return text;
}

/* Each figure under its name. Those whose name is that of a list, too, have _figure after it. */
static int put_figures(const telling *t, cJSON *page)
{
  char *template = lab_page_text(LAB_PAGE_FIGURE);
  int i, done = template != NULL;
  for (i = 0; i < t->figures->n && done; i++) {
    const lab_figure *figure = &t->figures->figure[i];
    char name[64], *html = figure_html(t, figure, template);
    snprintf(name, sizeof name, "%s%s", figure->name, cJSON_GetObjectItem(page, figure->name) ? "_figure" : "");
    if (html)
      cJSON_AddStringToObject(page, name, html);
    done = html != NULL;
    free(html);
  }
  free(template);
  return done;
}

/* What the script reads curves from, as JSON.  Returns: 0 without memory */
static int put_readings(const telling *t, cJSON *page)
{
  cJSON *labels;
  char *text;
  size_t i;
  if (t->figures->n == 0)
    return 1;
  labels = cJSON_CreateObject();
  for (i = 0; i < CURVES; i++)
    if (page_has_completed(t) || strcmp(curves[i].key, "after") != 0)
      cJSON_AddStringToObject(labels, curves[i].key, curves[i].brief);
  cJSON_DeleteItemFromObject(t->figures->readings, "labels");
  cJSON_AddItemToObject(t->figures->readings, "labels", labels);
  text = cJSON_PrintUnformatted(t->figures->readings);
  if (text)
    cJSON_AddStringToObject(page, "readings", text);
  cJSON_free(text);
  return text != NULL;
}

int page_figures(const telling *t, cJSON *page)
{
  return put_figures(t, page) && put_readings(t, page);
}

#include "pagetext.h"

#include <stdlib.h>
#include <string.h>

#include "../base/template.h"

/* In pieces; made by make. */
static const char *const common_css[] = {
#include "apps/lab/report/page/common.css.inc"
    NULL};
static const char *const page_html[] = {
#include "apps/lab/report/page/page.html.inc"
    NULL};
static const char *const page_css[] = {
#include "apps/lab/report/page/page.css.inc"
    NULL};
static const char *const page_js[] = {
#include "apps/lab/report/page/page.js.inc"
    NULL};
static const char *const figure_html[] = {
#include "apps/lab/report/page/figure.html.inc"
    NULL};
static const char *const uplot_js[] = {
#include "apps/lab/report/page/uplot/uPlot.iife.min.js.inc"
    NULL};
static const char *const uplot_css[] = {
#include "apps/lab/report/page/uplot/uPlot.min.css.inc"
    NULL};
static const char *const uplot_licence[] = {
#include "apps/lab/report/page/uplot/LICENSE.inc"
    NULL};
static const char *const index_html[] = {
#include "apps/lab/report/page/index.html.inc"
    NULL};
static const char *const index_css[] = {
#include "apps/lab/report/page/index.css.inc"
    NULL};
static const char *const index_js[] = {
#include "apps/lab/report/page/index.js.inc"
    NULL};

/* By page, and by the name that its template has for them; the template itself has none. */
static const struct {
  const char *page, *name;
  const char *const *piece;
} texts[] = {{"report", NULL, page_html},
             {"report", "common_style", common_css},
             {"report", "style", page_css},
             {"report", "script", page_js},
             {"report", "plot", uplot_js},
             {"report", "plot_style", uplot_css},
             {"report", "plot_licence", uplot_licence},
             {"figure", NULL, figure_html},
             {"index", NULL, index_html},
             {"index", "common_style", common_css},
             {"index", "style", index_css},
             {"index", "script", index_js}};

/* Returns: 0 without memory */
static int carry(const char *name, const char *const *piece, cJSON *values)
{
  char *text = lab_template_text(piece);
  const int done = text && cJSON_AddStringToObject(values, name, text);
  free(text);
  return done;
}

char *lab_page_text(const char *page, cJSON *values)
{
  char *template = NULL;
  size_t i;
  int done = 1;
  for (i = 0; i < sizeof texts / sizeof *texts && done; i++)
    if (strcmp(texts[i].page, page) == 0 && texts[i].name)
      done = carry(texts[i].name, texts[i].piece, values);
    else if (strcmp(texts[i].page, page) == 0)
      done = (template = lab_template_text(texts[i].piece)) != NULL;
  if (done)
    return template;
  free(template);
  return NULL;
}

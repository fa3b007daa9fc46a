/* report.html: a template with the page's values, its styles and scripts, its figures and their data. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/escape.h"
#include "../base/template.h"
#include "../base/text.h"
#include "page_private.h"

/* ---- What the program carries: arrays by the names of the files, made by make ---- */

#include "apps/lab/report/page/common.css.inc"
#include "apps/lab/report/page/page.html.inc"
#include "apps/lab/report/page/page.css.inc"
#include "apps/lab/report/page/page.js.inc"
#include "apps/lab/report/page/figure.html.inc"
#include "apps/lab/report/page/uplot/uPlot.iife.min.js.inc"
#include "apps/lab/report/page/uplot/uPlot.min.css.inc"
#include "apps/lab/report/page/uplot/LICENSE.inc"
#include "apps/lab/report/page/index.html.inc"
#include "apps/lab/report/page/index.css.inc"
#include "apps/lab/report/page/index.js.inc"

/* By page, and by the name that its template has for them; the template itself has none. */
static const struct {
  const char *page, *name;
  const char *const *piece;
} texts[] = {{"report", NULL, page_html},           {"report", "common_style", common_css},
             {"report", "style", page_css},         {"report", "script", page_js},
             {"report", "plot", uPlot_iife_min_js}, {"report", "plot_style", uPlot_min_css},
             {"report", "plot_licence", LICENSE},   {"index", NULL, index_html},
             {"index", "common_style", common_css}, {"index", "style", index_css},
             {"index", "script", index_js}};

char *lab_page_text(const char *page, cJSON *values)
{
  char *template = NULL;
  size_t i;
  int done = 1;
  for (i = 0; i < sizeof texts / sizeof *texts && done; i++) {
    char *text;
    if (strcmp(texts[i].page, page) != 0)
      continue;
    text = lab_template_text(texts[i].piece);
    done = text && (!texts[i].name || cJSON_AddStringToObject(values, texts[i].name, text));
    if (texts[i].name)
      free(text);
    else
      template = text;
  }
  if (done)
    return template;
  free(template);
  return NULL;
}

/* ---- Texts ---- */

/* Add what was written to the page, if all went well.  Returns: 0 without memory */
static int end(lab_writing *w, int failed, const char *name, cJSON *page)
{
  char *text = lab_writing_end(w);
  const int done = text && !failed && cJSON_AddStringToObject(page, name, text);
  free(text);
  return done;
}

/* Length of "(name)" at `at`, 0 if it is no effect's. */
static size_t bracketed_name(const char *at)
{
  int i;
  for (i = 0; *at == '(' && i < PNEU_EFFECT_COUNT; i++) {
    const size_t n = strlen(pneu_effect_at(i)->name);
    if (!strncmp(at + 1, pneu_effect_at(i)->name, n) && at[n + 1] == ')')
      return n + 2;
  }
  return 0;
}

void lab_page_put_coded(cJSON *to, const char *name, const char *text)
{
  lab_writing w;
  if (!lab_writing_begin(&w))
    return;
  while (*text) {
    const size_t n = bracketed_name(text), plain = n ? 0 : 1 + strcspn(text + 1, "(");
    char part[LAB_SENTENCE_TEXT];
    snprintf(part, sizeof part, "%.*s", (int)(n ? n - 2 : plain), text + (n > 0));
    fputs(n ? "<code>" : "", w.file);
    lab_put_html(w.file, part);
    fputs(n ? "</code>" : "", w.file);
    text += n + plain;
  }
  end(&w, 0, name, to);
}

/* ---- Figures ---- */

/* A figure as HTML, under its name.  Returns: 0 without memory */
static int put_figure(const lab_figure *figure, const char *template, cJSON *page)
{
  cJSON *values = cJSON_CreateObject(), *keys = cJSON_AddArrayToObject(values, "keys");
  lab_error error;
  lab_writing w;
  int key, done;
  lab_json_put(values, "name", "%s", figure->name);
  lab_json_put(values, "title", "%s", figure->title);
  lab_json_put(values, "subtitle", "%s", figure->subtitle);
  lab_json_put(values, "reading", "%s", figure->reading);
  lab_json_put(values, "alt", "%s", figure->alt);
  lab_json_put(values, "across", "%d", figure->across);
  for (key = 0; key < LAB_KEYS; key++) /* its switches: of the curves that can be told from others */
    if (*lab_curve_keys[key].label && lab_figure_curve(figure, key)) {
      cJSON *item = lab_json_append(keys);
      lab_json_put(item, "key", "%s", lab_curve_keys[key].name);
      lab_json_put(item, "label", "%s", lab_curve_keys[key].label);
    }
  done = lab_writing_begin(&w) && end(&w, lab_template_write(w.file, template, values, &error), figure->name, page);
  cJSON_Delete(values);
  return done;
}

/* All of them, and their data under "curves".  Returns: 0 without memory */
static int put_figures(const lab_figures *figures, cJSON *page)
{
  char *template = lab_template_text(figure_html);
  lab_writing w;
  int i, done = template && lab_writing_begin(&w);
  if (done) {
    lab_figures_json(figures, w.file);
    done = end(&w, 0, "curves", page);
  }
  for (i = 0; i < figures->n && done; i++)
    done = put_figure(&figures->figure[i], template, page);
  free(template);
  return done;
}

/* ---- The page ---- */

int lab_report_html(FILE *file, const lab_sources *from, lab_error *error)
{
  cJSON *page = cJSON_CreateObject();
  char *text;
  int status;
  lab_page_answer(from, page);
  lab_page_tables(from, page);
  text = put_figures(from->figures, page) ? lab_page_text("report", page) : NULL;
  status = text ? lab_template_write(file, text, page, error) : lab_fail_memory(error, "report.html");
  cJSON_Delete(page);
  free(text);
  return status;
}

#include "pagetext.h"

#include <stdio.h>
#include <stdlib.h>

/* A line a string; made by make. */
static const char *const page_html[] = {
#include "apps/lab/report/page/page.html.inc"
    NULL};
static const char *const figure_html[] = {
#include "apps/lab/report/page/figure.html.inc"
    NULL};
static const char *const page_css[] = {
#include "apps/lab/report/page/page.css.inc"
    NULL};
static const char *const page_js[] = {
#include "apps/lab/report/page/page.js.inc"
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
static const char *const common_css[] = {
#include "apps/lab/report/page/common.css.inc"
    NULL};

static const char *const *const texts[LAB_PAGE_TEXTS] = {page_html,  figure_html, page_css, page_js,
                                                         index_html, index_css,   index_js, common_css};

static void put(FILE *file, int which)
{
  const char *const *line;
  for (line = texts[which]; *line; line++)
    fputs(*line, file);
}

static char *close_text(FILE *file, char **text)
{
  if (file && fclose(file) == 0)
    return *text;
  free(*text);
  return NULL;
}

char *lab_page_text(int which)
{
  char *text = NULL;
  size_t size;
  FILE *file = open_memstream(&text, &size);
  if (file)
    put(file, which);
  return close_text(file, &text);
}

char *lab_page_texts(int first, int second)
{
  char *text = NULL;
  size_t size;
  FILE *file = open_memstream(&text, &size);
  if (file) {
    put(file, first);
    put(file, second);
  }
  return close_text(file, &text);
}

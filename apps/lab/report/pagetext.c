#include "pagetext.h"

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

static const char *const *const texts[LAB_PAGE_TEXTS] = {common_css,  page_html, page_css,  page_js,
                                                         figure_html, uplot_js,  uplot_css, uplot_licence,
                                                         index_html,  index_css, index_js};

char *lab_page_text(int which)
{
  return lab_template_text(texts[which]);
}

#include "report_html.h"

#include <stdlib.h>

#include "../base/template.h"
#include "page_private.h"
#include "pagetext.h"

static const struct {
  const char *name;
  int which;
} carried[] = {
    {"common_style", LAB_PAGE_STYLE},    {"style", LAB_PAGE_REPORT_STYLE},   {"plot", LAB_PAGE_PLOT},
    {"plot_style", LAB_PAGE_PLOT_STYLE}, {"script", LAB_PAGE_REPORT_SCRIPT}, {"plot_licence", LAB_PAGE_PLOT_LICENCE}};

static int put_carried(cJSON *page)
{
  size_t i;
  for (i = 0; i < sizeof carried / sizeof *carried; i++) {
    char *text = lab_page_text(carried[i].which);
    if (!text)
      return 0;
    cJSON_AddStringToObject(page, carried[i].name, text);
    free(text);
  }
  return 1;
}

static cJSON *values_of(const page_context *t)
{
  cJSON *page = cJSON_CreateObject();
  lab_page_head(t, page);
  lab_page_changes(t, page);
  lab_page_why(t, page);
  lab_page_limits(t, page);
  lab_page_first(t, lab_page_next(t, page), page);
  lab_page_signature(t, page);
  lab_page_deviations(t, page);
  lab_page_parameters(t, page);
  lab_page_whiteness(t, page);
  lab_page_candidates(t, page);
  lab_page_merit(t, page);
  if (lab_page_figures(t, page) && put_carried(page))
    return page;
  cJSON_Delete(page);
  return NULL;
}

static int write_page(const cJSON *page, const char *text, const char *folder, lab_error *error)
{
  lab_outfile out;
  if (lab_report_file_open(folder, "report.html", &out, error))
    return error->status;
  if (lab_template_write(out.file, text, page, error)) {
    lab_out_abandon(&out);
    return error->status;
  }
  return lab_out_close(&out, error);
}

int lab_report_html(const lab_report *report, const lab_residual_table *table, const lab_figures *figures,
                    const char *folder, lab_error *error)
{
  const page_context t = {report, table, figures};
  cJSON *page = values_of(&t);
  char *text = lab_page_text(LAB_PAGE_REPORT);
  const int status = page && text ? write_page(page, text, folder, error) : lab_fail_memory(error, "report.html");
  cJSON_Delete(page);
  free(text);
  return status;
}

#include "report_html.h"

#include <stdlib.h>

#include "../base/template.h"
#include "page_private.h"
#include "pagetext.h"

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
  if (lab_page_figures(t, page))
    return page;
  cJSON_Delete(page);
  return NULL;
}

static int write_page(const cJSON *page, const char *text, const char *folder, lab_error *error)
{
  lab_outfile out;
  if (lab_report_file_open(folder, "report.html", &out, error))
    return error->status;
  return lab_out_end(&out, lab_template_write(out.file, text, page, error), error);
}

int lab_report_html(const lab_report *report, const lab_residual_table *table, const lab_figures *figures,
                    const char *folder, lab_error *error)
{
  const page_context t = {report, table, figures};
  cJSON *page = values_of(&t);
  char *text = page ? lab_page_text("report", page) : NULL;
  const int status = text ? write_page(page, text, folder, error) : lab_fail_memory(error, "report.html");
  cJSON_Delete(page);
  free(text);
  return status;
}

#include <stdlib.h>

#include "../base/template.h"
#include "page_private.h"
#include "pagetext.h"

static cJSON *values_of(const lab_sources *t)
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

int lab_report_html(FILE *file, const lab_sources *from, lab_error *error)
{
  cJSON *page = values_of(from);
  char *text = page ? lab_page_text("report", page) : NULL;
  const int status = text ? lab_template_write(file, text, page, error) : lab_fail_memory(error, "report.html");
  cJSON_Delete(page);
  free(text);
  return status;
}

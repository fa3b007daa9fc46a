#include "report_html.h"

#include <stdlib.h>

#include "../base/template.h"
#include "page_private.h"
#include "pagetext.h"

static int put_text(cJSON *page, const char *name, char *text)
{
  if (text)
    cJSON_AddStringToObject(page, name, text);
  free(text);
  return text != NULL;
}

static cJSON *values_of(const telling *t)
{
  cJSON *page = cJSON_CreateObject();
  page_head(t, page);
  page_why(t, page);
  page_limits(t, page);
  page_first(t, page_next(t, page), page);
  page_parameters(t, page);
  page_whiteness(t, page);
  page_candidates(t, page);
  page_merit(t, page);
  if (page_figures(t, page) && put_text(page, "style", lab_page_texts(LAB_PAGE_STYLE, LAB_PAGE_REPORT_STYLE)) &&
      put_text(page, "script", lab_page_text(LAB_PAGE_REPORT_SCRIPT)))
    return page;
  cJSON_Delete(page);
  return NULL;
}

static int write_page(const cJSON *page, const char *text, const char *folder, lab_error *error)
{
  lab_outfile out;
  if (lab_report_open(folder, "report.html", &out, error))
    return error->status;
  if (lab_template_write(out.file, text, page, error)) {
    lab_out_abandon(&out);
    return error->status;
  }
  return lab_out_close(&out, error);
}

int lab_report_html(const lab_story *story, const lab_evidence *evidence, const lab_figures *figures,
                    const char *folder, lab_error *error)
{
  const telling t = {story, evidence, figures};
  cJSON *page = values_of(&t);
  char *text = lab_page_text(LAB_PAGE_REPORT);
  const int status = page && text ? write_page(page, text, folder, error) : lab_fail_memory(error, "report.html");
  cJSON_Delete(page);
  free(text);
  return status;
}

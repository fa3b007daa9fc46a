/* Templates, styles and scripts of the pages, which the program carries inside (apps/lab/report/).
 * SPDX-License-Identifier: MIT */
#ifndef LAB_PAGETEXT_H
#define LAB_PAGETEXT_H

#include <cjson/cJSON.h>

/* The template of a page, and to its values what it carries.
 * In:      page    "report", "figure" of a report, or "index" of a batch
 * In/out:  values  of the template; may be NULL for one that carries nothing
 * Returns: to be freed; NULL without memory */
char *lab_page_text(const char *page, cJSON *values);

#endif

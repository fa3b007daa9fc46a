/* report.html: the answer in a page that needs nothing else, figures inside.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_REPORT_HTML_H
#define LAB_REPORT_HTML_H

#include "figures.h"

/* Write the page; the same bytes for the same report.
 * Returns: LAB_OK, LAB_WORLD. */
int lab_report_html(const lab_report *report, const lab_residual_table *table, const lab_figures *figures,
                    const char *folder, lab_error *error);

#endif

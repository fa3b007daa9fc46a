/* Templates, styles and scripts of the pages, which the program carries inside (apps/lab/report/).
 * SPDX-License-Identifier: MIT */
#ifndef LAB_PAGETEXT_H
#define LAB_PAGETEXT_H

enum lab_page_text {
  LAB_PAGE_STYLE,  /* what both pages have in common */
  LAB_PAGE_REPORT, /* template of report.html */
  LAB_PAGE_REPORT_STYLE,
  LAB_PAGE_REPORT_SCRIPT,
  LAB_PAGE_FIGURE, /* template of a figure in it */
  LAB_PAGE_PLOT,   /* the library that draws its curves, with its style and licence */
  LAB_PAGE_PLOT_STYLE,
  LAB_PAGE_PLOT_LICENCE,
  LAB_PAGE_INDEX, /* template of the head and foot of index.html */
  LAB_PAGE_INDEX_STYLE,
  LAB_PAGE_INDEX_SCRIPT,
  LAB_PAGE_TEXTS
};

/* One of them, to be freed; NULL without memory. */
char *lab_page_text(int which);

#endif

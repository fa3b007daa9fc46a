/* What the files of report.html share. Each section of the page has a file that adds its values to a tree;
 * page/page.html says where they stand. SPDX-License-Identifier: MIT */
#ifndef LAB_PAGE_PRIVATE_H
#define LAB_PAGE_PRIVATE_H

#include <cjson/cJSON.h>

#include "figures.h"

/* What the values of the page are made from. */
typedef struct telling {
  const lab_story *story;
  const lab_evidence *evidence;
  const lab_figures *figures;
} telling;

extern const double page_white_level; /* p-value below which a residual is called not white */

/* ---- Values ---- */

/* Add a text, under a name. */
void page_put(cJSON *to, const char *name, const char *format, ...) LAB_PRINTF(3, 4);

/* Add a text to a list. */
void page_say(cJSON *list, const char *format, ...) LAB_PRINTF(2, 3);

/* Add an item that has values of its own to a list. */
cJSON *page_append(cJSON *list);

/* Add a number, in the form in which it is shown. */
void page_put_number(cJSON *to, const char *name, double value, int digits);
void page_put_quantity(cJSON *to, const char *name, double value, const char *unit, int digits);
void page_put_p(cJSON *to, const char *name, double p);
void page_put_share(cJSON *to, const char *name, double share);

const char *page_effect_name(int effect);
int page_has_completed(const telling *t);

/* ---- Unknowns of the completed model ---- */

/* The whole unit of an unknown: x->unit has no room for the longest. */
const char *page_unit(const lab_unknown *x);

/* Digits at which both ends of the interval of an unknown can be told apart. */
int page_digits(const telling *t, int j);

/* "0.0136 .. 0.0138", or why there is none */
void page_put_interval(const telling *t, int j, cJSON *to);

/* ---- Sections ---- */

void page_head(const telling *t, cJSON *page);   /* verdict and model, and the table of errors */
void page_why(const telling *t, cJSON *page);    /* what was found, or why nothing was */
void page_limits(const telling *t, cJSON *page); /* what the answer does not settle */

/* What to record next.  Returns: its list */
const cJSON *page_next(const telling *t, cJSON *page);

/* The answer in three boxes: what, how sure, what to do; of `next` the first is named. */
void page_first(const telling *t, const cJSON *next, cJSON *page);

void page_parameters(const telling *t, cJSON *page);
void page_whiteness(const telling *t, cJSON *page);
void page_candidates(const telling *t, cJSON *page);
void page_merit(const telling *t, cJSON *page);

/* Drawings, and what is read off them; after all other sections, whose names they keep clear of.
 * Returns: 0 without memory */
int page_figures(const telling *t, cJSON *page);

#endif

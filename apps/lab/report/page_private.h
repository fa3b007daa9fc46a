/* What the files of report.html share. Each section of the page has a file that adds its values to a tree;
 * page/page.html says where they stand. SPDX-License-Identifier: MIT */
#ifndef LAB_PAGE_PRIVATE_H
#define LAB_PAGE_PRIVATE_H

#include "../base/json.h"
#include "figures.h"

/* ---- Values ---- */

/* Add a text as HTML: a name of an effect in brackets becomes one in code style. */
void lab_page_put_coded(cJSON *to, const char *name, const char *text);

/* Add a number, in the form in which it is shown. */
void lab_page_put_number(cJSON *to, const char *name, double value, int digits);
void lab_page_put_quantity(cJSON *to, const char *name, double value, const char *unit, int digits);
void lab_page_put_p(cJSON *to, const char *name, double p);
void lab_page_put_share(cJSON *to, const char *name, double share);

const char *lab_page_effect_name(int effect);

/* Whether the completed model is another than the declared one: something was added, or, with nothing to fit, the
 * instants of commands were. */
int lab_page_has_completed(const lab_sources *t);

/* ---- Unknowns of the completed model ---- */

/* The whole unit of an unknown: x->unit has no room for the longest. */
const char *lab_page_unit(const lab_unknown *x);

/* Digits at which both ends of the interval of an unknown can be told apart. */
int lab_page_digits(const lab_sources *t, int j);

/* "0.0136 .. 0.0138", or why there is none */
void lab_page_put_interval(const lab_sources *t, int j, cJSON *to);

/* Add a parameter of an effect to a list: what it means, how large it is, with unit and interval.
 * Returns: the item; NULL where it was not fitted */
cJSON *lab_page_put_size(const lab_sources *t, int param, cJSON *list);

/* ---- Sections ---- */

void lab_page_head(const lab_sources *t, cJSON *page);    /* verdict and model, and the table of errors */
void lab_page_changes(const lab_sources *t, cJSON *page); /* since the baseline */
void lab_page_why(const lab_sources *t, cJSON *page);     /* what was found, or why nothing was */
void lab_page_limits(const lab_sources *t, cJSON *page);  /* what the answer does not settle */

/* What to record next.  Returns: its list */
const cJSON *lab_page_next(const lab_sources *t, cJSON *page);

/* The answer in three boxes: what, how sure, what to do; of `next` the first is named. */
void lab_page_first(const lab_sources *t, const cJSON *next, cJSON *page);

void lab_page_signature(const lab_sources *t, cJSON *page);
void lab_page_deviations(const lab_sources *t, cJSON *page); /* of declared values */
void lab_page_parameters(const lab_sources *t, cJSON *page);
void lab_page_whiteness(const lab_sources *t, cJSON *page);
void lab_page_candidates(const lab_sources *t, cJSON *page);
void lab_page_merit(const lab_sources *t, cJSON *page);

/* Returns: 0 without memory */
int lab_page_figures(const lab_sources *t, cJSON *page);

#endif

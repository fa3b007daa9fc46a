/* What the files of report.html share: page.c, and its values as page/page.html has them.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_PAGE_PRIVATE_H
#define LAB_PAGE_PRIVATE_H

#include "../base/json.h"
#include "figures.h"

/* Add a text as HTML: a name of an effect in brackets becomes one in code style. */
void lab_page_put_coded(cJSON *to, const char *name, const char *text);

void lab_page_put_share(cJSON *to, const char *name, double share);

/* Add a parameter of an effect to a list: what it means, how large it is, with unit and interval.
 * Returns: the item; NULL where it was not fitted */
cJSON *lab_page_put_size(const lab_sources *t, int param, cJSON *list);

void lab_page_answer(const lab_sources *t, cJSON *page); /* what is said in words */
void lab_page_tables(const lab_sources *t, cJSON *page);

#endif

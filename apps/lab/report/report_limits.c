/* What the answer has to be read with: remarks on the logs, and what the fit could not determine. */
#include <stdio.h>
#include <string.h>

#include "loopfiles.h"

/* The remark of a fit, a clause an item; those on instants of the command are of no use to a reader. */
static void add_clauses(const char *remark, cJSON *list)
{
  while (*remark) {
    const char *end = strstr(remark, "; ");
    const int length = (int)(end ? end - remark : (long)strlen(remark));
    char clause[LAB_FIT_REMARK + 2];
    snprintf(clause, sizeof clause, "%.*s.", length, remark);
    if (!strstr(clause, "switch_"))
      cJSON_AddItemToArray(list, cJSON_CreateString(clause));
    remark += length + (end ? 2 : 0);
  }
}

void lab_story_limits(const lab_story *story, cJSON *list)
{
  int i;
  for (i = 0; story->remarks && i < story->remarks->n; i++)
    cJSON_AddItemToArray(list, cJSON_CreateString(story->remarks->text[i]));
  add_clauses(story->result->fit.remark, list);
}

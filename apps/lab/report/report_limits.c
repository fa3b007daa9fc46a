/* What the answer has to be read with: remarks on the logs, and what the fit could not determine. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "loopfiles.h"

static const double wider = 1.1; /* times, from which on it is worth a word */

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

/* Intervals that are wide because there is more noise than declared, or because the model is not the whole truth. */
static void add_widening(const lab_loop_result *r, cJSON *list)
{
  const double times = sqrt(r->fit.reduced_chi2);
  char text[160];
  if (!(times > wider) || r->window > 0)
    return;
  snprintf(
      text, sizeof text,
      r->verdict == LAB_VERDICT_UNDECIDED || r->verdict == LAB_VERDICT_UNLISTED
          ? "More than noise is left: intervals are %.2g times as wide as noise alone would have them."
          : "The sensors seem to be %.2g times as noisy as the rig file says, for what is left is white; intervals "
            "allow for that.",
      times);
  cJSON_AddItemToArray(list, cJSON_CreateString(text));
}

void lab_story_limits(const lab_story *story, cJSON *list)
{
  int i;
  for (i = 0; story->remarks && i < story->remarks->n; i++)
    cJSON_AddItemToArray(list, cJSON_CreateString(story->remarks->text[i]));
  add_widening(story->result, list);
  add_clauses(story->result->fit.remark, list);
}

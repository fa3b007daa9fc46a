/* What the answer has to be read with: remarks on the logs, and what the fit could not determine. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "loopfiles.h"

static const double wider = 1.1; /* times, from which on it is worth a word */

/* The next clause of the remark of a fit that is of use to a reader: not one on instants of the command, which have no
 * name.
 * In/out:  remark  moves on
 * Out:     clause  where it begins
 * Returns: its length, 0 at the end */
static int next_clause(const char **remark, const char **clause)
{
  while (**remark) {
    const char *end = strstr(*remark, "; "), *name = strstr(*remark, "switch_");
    const int length = (int)(end ? end - *remark : (long)strlen(*remark));
    *clause = *remark;
    *remark += length + (end ? 2 : 0);
    if (!name || name >= *clause + length)
      return length;
  }
  return 0;
}

void lab_story_undetermined(const lab_story *story, char text[LAB_FIT_REMARK])
{
  const char *remark = story->result->fit.remark, *clause;
  int length;
  char *to = text;
  for (*to = '\0'; (length = next_clause(&remark, &clause)) > 0;)
    to += sprintf(to, "%s%.*s", to > text ? "; " : "", length, clause);
}

static void add_clauses(const char *remark, cJSON *list)
{
  const char *clause;
  int length;
  while ((length = next_clause(&remark, &clause)) > 0) {
    char text[LAB_FIT_REMARK + 2];
    snprintf(text, sizeof text, "%.*s.", length, clause);
    cJSON_AddItemToArray(list, cJSON_CreateString(text));
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

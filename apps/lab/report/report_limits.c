/* What the answer has to be read with: remarks on the logs, and what the fit could not determine. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../base/json.h"
#include "report.h"

static const double wider = 1.1; /* times, from which on it is worth a word */

/* The next clause of the remark of a fit that is of use to a reader: not one on instants of the command, which have no
 * name.
 * In/out:  remark  moves on
 * Out:     clause  where it begins
 * Returns: its length, 0 at the end */
static int next_clause(const char **limitation, const char **clause)
{
  while (**limitation) {
    const char *end = strstr(*limitation, "; "), *name = strstr(*limitation, "switch_");
    const int length = (int)(end ? end - *limitation : (long)strlen(*limitation));
    *clause = *limitation;
    *limitation += length + (end ? 2 : 0);
    if (!name || name >= *clause + length)
      return length;
  }
  return 0;
}

void lab_report_undetermined(const lab_report *report, char text[LAB_FIT_UNDETERMINED_TEXT])
{
  const char *limitation = report->result->fit.undetermined, *clause;
  const char *const full = limitation + LAB_FIT_UNDETERMINED_TEXT - 1; /* what ends here was cut */
  int length;
  char *to = text;
  for (*to = '\0'; (length = next_clause(&limitation, &clause)) > 0 && clause + length < full;)
    to += sprintf(to, "%s%.*s", to > text ? "; " : "", length, clause);
}

static void add_clauses(const lab_report *report, cJSON *list)
{
  char text[LAB_FIT_UNDETERMINED_TEXT];
  const char *limitation = text, *clause;
  int length;
  lab_report_undetermined(report, text);
  while ((length = next_clause(&limitation, &clause)) > 0)
    lab_json_say(list, "Among the fitted values, %.*s.", length, clause);
}

/* Intervals that are wide because there is more noise than declared, or because the model is not the whole truth. */
static void add_widening(const lab_search_result *r, cJSON *list)
{
  const double times = sqrt(r->fit.reduced_chi2);
  if (!(times > wider) || r->window > 0)
    return;
  lab_json_say(
      list,
      r->verdict == LAB_VERDICT_UNDECIDED || r->verdict == LAB_VERDICT_UNLISTED
          ? "More than noise is left, so intervals are %.2g times as wide as noise alone would make them."
      : lab_residual_stats_white(r->left[LAB_STAGE_AFTER])
          ? "The residual is white, so the sensors seem to be %.2g times as noisy as the rig file says. The intervals "
            "allow for that."
          : "The sensors seem to be %.2g times as noisy as the rig file says. The intervals allow for that.",
      times);
}

void lab_report_limits(const lab_report *report, cJSON *list)
{
  int i;
  for (i = 0; report->limitations && i < report->limitations->n; i++)
    lab_json_say(list, "%s", report->limitations->text[i]);
  add_widening(report->result, list);
  add_clauses(report, list);
}

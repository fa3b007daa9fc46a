/* The head of the page, and the table of errors. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../base/text.h"
#include "page_private.h"

static void put_verdict(const telling *t, cJSON *page)
{
  static const char *const badge[] = {"nothing missing", "effect found", "something unlisted", "undecided"};
  const lab_story *story = t->story;
  const int verdict = story->result->verdict;
  char sentence[LAB_SENTENCE_TEXT];
  lab_story_sentence(story, sentence, sizeof sentence);
  page_put(page, "sentence", "%s", sentence);
  page_put(page, "verdict", "%s", lab_verdict_text(verdict));
  page_put(page, "badge", "%s", badge[verdict]);
  page_put(page, "rig", "%s", story->rig->name);
  page_put(page, "rig_file", "%s", lab_file_name(story->rig->file));
  page_put(page, "gas", "%s", pneu_gas_key(story->rig->laws.gas));
  page_put(page, "flow", "%s", pneu_flow_key(story->rig->laws.flow));
  page_put(page, "version", "%s", PNEU_VERSION);
  page_put(page, "completed", "%s", page_has_completed(t) ? "yes" : "");
  page_put(page, "holdout", "%s", story->has_holdout ? "yes" : "");
}

/* "5356 rows in 2 runs of a.csv, b.csv" */
static void put_logs(const telling *t, cJSON *page)
{
  const lab_unknowns *u = t->story->completed;
  const lab_log *last = NULL;
  char names[1024] = "";
  int e;
  for (e = 0; e < u->n_experiments; e++) {
    const size_t used = strlen(names);
    if (u->experiment[e].log != last)
      snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "", lab_file_name(u->experiment[e].log->path));
    last = u->experiment[e].log;
  }
  if (u->n_experiments > 1)
    page_put(page, "rows", "%zu rows in %d runs", t->evidence->n, u->n_experiments);
  else
    page_put(page, "rows", "%zu rows", t->evidence->n);
  page_put(page, "logs", "%s", names);
}

/* A column of the table of errors. */
typedef struct column {
  const char *heading;
  const lab_errors *errors;
  int shown, stage;
} column;

/* The largest error over its noise of a channel, which has the longest bar. */
static double largest_of(const column *columns, size_t n, int channel)
{
  double largest = 1;
  size_t i;
  for (i = 0; i < n; i++)
    if (columns[i].shown)
      largest = fmax(largest, columns[i].errors->in_noise[channel]);
  return largest;
}

static void put_errors(const telling *t, cJSON *page)
{
  const lab_story *story = t->story;
  const int both = page_has_completed(t), held = story->has_holdout;
  const column columns[] = {{"declared model, fitted", &story->result->before, 1, LAB_STAGE_BEFORE},
                            {"completed model", &story->result->after, both, LAB_STAGE_AFTER},
                            {"held-out log, declared model", &story->holdout_before, held, LAB_STAGE_BEFORE},
                            {"held-out log, completed model", &story->holdout_after, both && held, LAB_STAGE_AFTER}};
  const size_t n = sizeof columns / sizeof *columns;
  cJSON *headings = cJSON_AddArrayToObject(page, "headings"), *errors = cJSON_AddArrayToObject(page, "errors");
  size_t i;
  int c;
  for (i = 0; i < n; i++)
    if (columns[i].shown)
      page_say(headings, "%s", columns[i].heading);
  for (c = 0; c < LAB_CHANNEL_COUNT; c++) {
    cJSON *row, *cells;
    if (isnan(story->result->before.rmse[c]))
      continue;
    row = page_append(errors);
    page_put(row, "channel", "%s %s", lab_channels[c].quantity, lab_channels[c].key);
    cells = cJSON_AddArrayToObject(row, "columns");
    for (i = 0; i < n; i++)
      if (columns[i].shown) {
        cJSON *cell = page_append(cells);
        page_put_quantity(cell, "rmse", columns[i].errors->rmse[c], lab_channels[c].unit, 3);
        page_put_number(cell, "in_noise", columns[i].errors->in_noise[c], 3);
        page_put(cell, "stage", "%s", columns[i].stage ? "after" : "before");
        page_put(cell, "share", "%.0f", 100 * fmax(columns[i].errors->in_noise[c], 0) / largest_of(columns, n, c));
      }
  }
}

void page_head(const telling *t, cJSON *page)
{
  put_verdict(t, page);
  put_logs(t, page);
  put_errors(t, page);
}

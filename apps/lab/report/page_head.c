/* The head of the page, and the table of errors. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../base/text.h"
#include "page_private.h"

static void put_verdict(const lab_sources *t, cJSON *page)
{
  static const char *const badge[] = {"nothing missing", "effect found", "not in the catalogue", "undecided"};
  const lab_report *report = t->report;
  const int verdict = report->result->verdict;
  char text[LAB_SENTENCE_TEXT];
  lab_report_headline(report, text, sizeof text);
  lab_json_put(page, "headline", "%s", text);
  lab_page_put_coded(page, "coded_headline", text);
  lab_report_evidence(report, text, sizeof text);
  lab_json_put(page, "evidence", "%s", text);
  lab_json_put(page, "verdict", "%s", lab_verdict_text(verdict));
  lab_json_put(page, "badge", "%s", badge[verdict]);
  lab_json_put(page, "rig", "%s", report->rig->name);
  lab_json_put(page, "rig_file", "%s", lab_file_name(report->rig->file));
  lab_json_put(page, "gas", "%s", pneu_gas_key(report->rig->laws.gas));
  lab_json_put(page, "flow", "%s", pneu_flow_key(report->rig->laws.flow));
  lab_json_put(page, "version", "%s", PNEU_VERSION);
  lab_json_put(page, "completed", "%s", lab_page_has_completed(t) ? "yes" : "");
  lab_json_put(page, "holdout", "%s", report->has_holdout ? "yes" : "");
}

/* "5356 rows in 2 runs of a.csv, b.csv" */
static void put_logs(const lab_sources *t, cJSON *page)
{
  const lab_unknowns *u = t->report->completed;
  const lab_log *last = NULL;
  char names[1024] = "";
  int e;
  for (e = 0; e < u->n_runs; e++) {
    if (u->run[e].log != last)
      lab_append(names, sizeof names, "%s%s", *names ? ", " : "", lab_file_name(u->run[e].log->path));
    last = u->run[e].log;
  }
  if (u->n_runs > 1)
    lab_json_put(page, "rows", "%zu rows in %d runs", t->table->n, u->n_runs);
  else
    lab_json_put(page, "rows", "%zu rows", t->table->n);
  lab_json_put(page, "logs", "%s", names);
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

static void put_errors(const lab_sources *t, cJSON *page)
{
  const lab_report *report = t->report;
  const int both = lab_page_has_completed(t), held = report->has_holdout;
  const column columns[] = {{"declared model, fitted", &report->result->before, 1, LAB_STAGE_BEFORE},
                            {"completed model", &report->result->after, both, LAB_STAGE_AFTER},
                            {"held-out log, declared model", &report->holdout_before, held, LAB_STAGE_BEFORE},
                            {"held-out log, completed model", &report->holdout_after, both && held, LAB_STAGE_AFTER}};
  const size_t n = sizeof columns / sizeof *columns;
  cJSON *headings = cJSON_AddArrayToObject(page, "headings"), *errors = cJSON_AddArrayToObject(page, "errors");
  size_t i;
  int c;
  for (i = 0; i < n; i++)
    if (columns[i].shown)
      lab_json_say(headings, "%s", columns[i].heading);
  for (c = 0; c < LAB_CHANNEL_COUNT; c++) {
    cJSON *row, *cells;
    if (isnan(report->result->before.rmse[c]))
      continue;
    row = lab_json_append(errors);
    lab_json_put(row, "channel", "%s %s", lab_channels[c].quantity, lab_channels[c].key);
    cells = cJSON_AddArrayToObject(row, "columns");
    for (i = 0; i < n; i++)
      if (columns[i].shown) {
        cJSON *cell = lab_json_append(cells);
        lab_json_put(cell, "heading", "%s", columns[i].heading);
        lab_page_put_quantity(cell, "rmse", columns[i].errors->rmse[c], lab_channels[c].unit, 3);
        lab_page_put_number(cell, "in_noise", columns[i].errors->in_noise[c], 3);
        lab_json_put(cell, "stage", "%s", columns[i].stage ? "after" : "before");
        lab_json_put(cell, "share", "%.0f", 100 * fmax(columns[i].errors->in_noise[c], 0) / largest_of(columns, n, c));
      }
  }
}

void lab_page_head(const lab_sources *t, cJSON *page)
{
  put_verdict(t, page);
  put_logs(t, page);
  put_errors(t, page);
}

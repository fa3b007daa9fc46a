#include "batchrow.h"

#include <math.h>
#include <string.h>

#include "../base/escape.h"
#include "../base/format.h"
#include "../rig/rigterm.h"
#include "../trace/freeterms.h"

/* Channels that a model predicts. */
static const int channels[LAB_ROW_CHANNELS] = {LAB_CHANNEL_P, LAB_CHANNEL_X, LAB_CHANNEL_T, LAB_CHANNEL_FORCE};

/* Errors over the noise. */
static const char *const stages[LAB_ROW_STAGES] = {"before", "after", "holdout_before", "holdout_after"};

void lab_row_header(FILE *file)
{
  int c, s;
  fputs("name,verdict,found,size,alike", file);
  for (c = 0; c < LAB_ROW_CHANNELS; c++)
    for (s = 0; s < LAB_ROW_STAGES; s++)
      fprintf(file, ",%s_%s", lab_channels[channels[c]].quantity, stages[s]);
  fputs(",limitations,message,condition,deviations\n", file);
}

/* ---- What was found ---- */

/* "chamber_leak", or "unlisted force over x" */
static void put_name(FILE *file, const lab_answer *a, const lab_found *found)
{
  const pneu_term *term = &a->now.completed.rig.term[found->term < 0 ? 0 : found->term];
  if (found->effect >= 0)
    fputs(pneu_effect_at(found->effect)->name, file);
  else
    fprintf(file, "unlisted %s over %s", lab_free_term_equation(term), lab_term_arguments[term->argument].key);
}

/* The effect's parameter with its unit; where a free term acts. */
static void put_size(FILE *file, const lab_answer *a, const lab_found *found)
{
  char where[LAB_WHERE_TEXT];
  const int j = found->effect >= 0 ? lab_report_size(&a->report, found->param) : -1;
  if (found->effect < 0)
    fputs(lab_free_term_where(&a->now.completed.rig.term[found->term], where), file);
  else if (j >= 0)
    fprintf(file, "%.6g %s", a->now.completed.unknown[j].value, a->now.completed.unknown[j].unit);
}

/* What the log cannot tell from it. */
static void put_alike(FILE *file, const lab_answer *a, const lab_found *found)
{
  int i;
  (void)a;
  for (i = 0; i < found->n_alike; i++)
    fprintf(file, "%s%s", i ? " " : "", pneu_effect_at(found->alike[i])->name);
}

/* One cell about all that was found, joined with " + ". */
static void put_found(FILE *row, const lab_answer *a, void (*put)(FILE *, const lab_answer *, const lab_found *))
{
  char text[LAB_ROW_TEXT / 2];
  FILE *cell = fmemopen(text, sizeof text, "w");
  int i;
  text[0] = '\0';
  for (i = 0; cell && i < a->now.result.n_found; i++) {
    fputs(i ? " + " : "", cell);
    put(cell, a, &a->now.result.found[i]);
  }
  if (cell)
    fclose(cell);
  text[sizeof text - 1] = '\0';
  fputc(',', row);
  lab_put_cell(row, text);
}

/* ---- Numbers ---- */

static void put_number(FILE *row, double value)
{
  if (isfinite(value))
    fprintf(row, ",%.6g", value);
  else
    fputc(',', row);
}

static void put_errors(FILE *row, const lab_answer *a)
{
  const lab_report *report = &a->report;
  const lab_errors *error[LAB_ROW_STAGES] = {&a->now.result.before, &a->now.result.after, &report->holdout_before,
                                             &report->holdout_after};
  int c, s;
  for (c = 0; c < LAB_ROW_CHANNELS; c++)
    for (s = 0; s < LAB_ROW_STAGES; s++)
      put_number(row, (s < 2 || report->has_holdout) && !isnan(error[s]->rmse[channels[c]])
                          ? error[s]->in_noise[channels[c]]
                          : (double)NAN);
}

/* ---- Condition ---- */

/* Over what was declared; where that is 0, as it was found. */
static void put_deviation(FILE *file, const lab_deviation *d)
{
  char found[LAB_FORMAT_TEXT];
  if (isfinite(d->ratio))
    fprintf(file, "%s x%.3g", d->name, d->ratio);
  else
    fprintf(file, "%s %s", d->name, lab_format_quantity(d->found, d->unit, 3, found));
}

static void put_condition(FILE *row, const lab_deviations *all)
{
  int i;
  fprintf(row, ",%s,", lab_condition_text(all->condition));
  for (i = 0; i < all->n; i++) {
    fputs(i ? " + " : "", row);
    put_deviation(row, &all->of[i]);
  }
}

/* ---- Rows ---- */

static FILE *open_row(lab_outcome *outcome)
{
  memset(outcome, 0, sizeof *outcome);
  return fmemopen(outcome->row, sizeof outcome->row, "w");
}

static void close_row(FILE *row, lab_outcome *outcome)
{
  if (row)
    fclose(row);
  outcome->row[sizeof outcome->row - 1] = '\0';
}

void lab_row_answer(const lab_answer *a, lab_outcome *outcome)
{
  char sentence[LAB_SENTENCE_TEXT];
  FILE *row = open_row(outcome);
  if (row) {
    fputs(lab_verdict_text(a->now.result.verdict), row);
    put_found(row, a, put_name);
    put_found(row, a, put_size);
    put_found(row, a, put_alike);
    put_errors(row, a);
    fprintf(row, ",%d,", a->now.logs.limitations.n);
    lab_report_sentence(&a->report, sentence);
    lab_put_users_cell(row, sentence);
    put_condition(row, &a->report.deviations);
  }
  close_row(row, outcome);
}

void lab_row_error(const lab_error *error, lab_outcome *outcome)
{
  FILE *row = open_row(outcome);
  int i;
  outcome->status = error->status;
  if (row) {
    fputs("error,,,", row);
    for (i = 0; i < LAB_ROW_CHANNELS * LAB_ROW_STAGES + 1; i++)
      fputc(',', row);
    fputc(',', row);
    lab_put_users_cell(row, error->text);
    fputs(",,", row);
  }
  close_row(row, outcome);
}

#include "batchrow.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "../base/escape.h"
#include "../base/format.h"
#include "../base/outfile.h"
#include "../base/text.h"
#include "../rig/rigterm.h"
#include "../trace/freeterms.h"

/* Channels that a model predicts. */
static const int channels[LAB_ROW_CHANNELS] = {LAB_CHANNEL_P, LAB_CHANNEL_X, LAB_CHANNEL_T, LAB_CHANNEL_FORCE};

enum { FOUND_CELLS = LAB_ROW_ERRORS - LAB_ROW_FOUND };

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

/* "chamber_leak", "1.36e-08 m2", and what the log cannot tell from it; or "unlisted force over x", and where it acts.
 */
static void add_found(const lab_answer *a, const lab_found *found, char cell[FOUND_CELLS][LAB_ROW_TEXT / 2])
{
  enum { ROOM = LAB_ROW_TEXT / 2 };
  char where[LAB_WHERE_TEXT];
  int i, j;
  if (found->effect < 0) {
    const pneu_term *term = lab_report_term(&a->report, found);
    lab_append(cell[0], ROOM, "unlisted %s over %s", lab_free_term_equation(term),
               lab_term_arguments[term->argument].key);
    lab_append(cell[1], ROOM, "%s", lab_free_term_where(term, where));
  } else {
    lab_append(cell[0], ROOM, "%s", pneu_effect_at(found->effect)->name);
    if ((j = lab_report_size(&a->report, found->param)) >= 0)
      lab_append(cell[1], ROOM, "%.6g %s", a->now.completed.unknown[j].value, a->now.completed.unknown[j].unit);
  }
  for (i = 0; i < found->n_alike; i++)
    lab_append(cell[2], ROOM, "%s%s", i ? " " : "", pneu_effect_at(found->alike[i])->name);
}

/* Cells about all that was found, joined with " + ". */
static void put_found(FILE *row, const lab_answer *a)
{
  char cell[FOUND_CELLS][LAB_ROW_TEXT / 2] = {"", "", ""};
  int i, k;
  for (i = 0; i < a->now.result.n_found; i++) {
    for (k = 0; i > 0 && k < FOUND_CELLS; k++)
      lab_append(cell[k], sizeof cell[k], " + ");
    add_found(a, &a->now.result.found[i], cell);
  }
  for (k = 0; k < FOUND_CELLS; k++) {
    fputc(',', row);
    lab_put_cell(row, cell[k]);
  }
}

/* ---- Numbers ---- */

static void put_errors(FILE *row, const lab_answer *a)
{
  const lab_report *report = &a->report;
  const lab_errors *error[LAB_ROW_STAGES] = {&a->now.result.before, &a->now.result.after, &report->holdout_before,
                                             &report->holdout_after};
  int c, s;
  for (c = 0; c < LAB_ROW_CHANNELS; c++)
    for (s = 0; s < LAB_ROW_STAGES; s++)
      if ((s < 2 || report->has_holdout) && !isnan(error[s]->rmse[channels[c]]) &&
          isfinite(error[s]->in_noise[channels[c]]))
        fprintf(row, ",%.6g", error[s]->in_noise[channels[c]]);
      else
        fputc(',', row);
}

/* ---- Condition ---- */

/* Deviations over what was declared; where that is 0, as they were found. */
static void put_condition(FILE *row, const lab_deviations *all)
{
  int i;
  fprintf(row, ",%s,", lab_condition_text(all->condition));
  for (i = 0; i < all->n; i++) {
    const lab_deviation *d = &all->of[i];
    fprintf(row, "%s%s ", i ? " + " : "", d->name);
    if (isfinite(d->ratio))
      fprintf(row, "x%.3g", d->ratio);
    else
      fputs(LAB_QUANTITY(d->found, d->unit, 3), row);
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
    put_found(row, a);
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

/* ---- On the disk ---- */

static const char done_name[] = ".done";

/* Two lines: numbers, and the row. The end of the second tells that it is whole. */
static int read_lines(FILE *file, lab_done *done)
{
  lab_cost *cost = &done->outcome.cost;
  char line[160];
  size_t length;
  if (!fgets(line, sizeof line, file) || sscanf(line, "%" SCNx64 " %d %d %lf %lf %lf", &done->key, &done->extent,
                                                &done->outcome.status, &cost->seconds, &cost->cpu, &cost->memory) != 6)
    return 0;
  if (!fgets(done->outcome.row, sizeof done->outcome.row, file))
    return 0;
  length = strlen(done->outcome.row);
  if (length == 0 || done->outcome.row[length - 1] != '\n')
    return 0;
  done->outcome.row[length - 1] = '\0';
  return 1;
}

int lab_done_read(const char *folder, lab_done *done)
{
  FILE *file = fopen(LAB_IN_FOLDER(folder, done_name), "r");
  int whole;
  memset(done, 0, sizeof *done);
  whole = file && read_lines(file, done);
  if (file)
    fclose(file);
  return whole;
}

int lab_done_write(const char *folder, const lab_done *done, lab_error *error)
{
  const lab_cost *cost = &done->outcome.cost;
  lab_outfile out;
  if (lab_out_open(&out, LAB_IN_FOLDER(folder, done_name), error))
    return error->status;
  fprintf(out.file, "%016" PRIx64 " %d %d %.3f %.3f %.1f\n%s\n", done->key, done->extent, done->outcome.status,
          cost->seconds, cost->cpu, cost->memory, done->outcome.row);
  return lab_out_close(&out, error);
}

void lab_done_remove(const char *folder)
{
  remove(LAB_IN_FOLDER(folder, done_name));
}

#include "plausible.h"

#include <stdio.h>

#include "logview.h"
#include "standstill.h"
#include "../base/text.h"

enum severity { WRONG, LIMIT, DOUBT };
enum { P = LAB_NEEDS_P, X = LAB_NEEDS_X, U = LAB_NEEDS_U, FREE = LAB_NEEDS_FREE, EXPECTED = LAB_NEEDS_EXPECTED };
enum { VALUES_EACH = 7 }; /* measured values for each unknown, below which nothing is named */

static const struct check {
  int (*find)(const lab_log_view *, lab_check_result *);
  int severity, needs; /* enum lab_check_need */
} checks[] = {
#define LAB_CHECK(name, severity, needs) {lab_check_##name, severity, needs},
#include "checks.def"
#undef LAB_CHECK
};

/* "log.csv:12", "log.csv", or "log.csv, run 3" */
static void place(const lab_log_view *s, const lab_check_result *f, const char *file, char *text, size_t size)
{
  int used = snprintf(text, size, "%s", file);
  if (f->row != LAB_NO_ROW && used > 0 && (size_t)used < size)
    snprintf(text + used, size - (size_t)used, ":%d", s->log->line[s->first + f->row]);
  else if (s->log->n_runs > 1 && used > 0 && (size_t)used < size)
    snprintf(text + used, size - (size_t)used, ", run %zu", s->run + 1);
}

/* What there is of what checks need. */
static int what_is_there(const lab_log_view *s)
{
  return (s->y[LAB_CHANNEL_P] ? P : 0) | (s->y[LAB_CHANNEL_X] ? X : 0) | (s->u ? U : 0) |
         (s->main >= 0 && !lab_log_view_is_driven(s) ? FREE : 0) | (s->has_expected ? EXPECTED : 0);
}

static int check_run(const lab_log_view *s, lab_limitations *limitations, lab_error *error)
{
  const int there = what_is_there(s);
  size_t i;
  for (i = 0; i < sizeof checks / sizeof checks[0]; i++) {
    lab_check_result f = {.n_shown = 0};
    char where[LAB_PATH_TEXT];
    if ((checks[i].needs & there) != checks[i].needs || !checks[i].find(s, &f))
      continue;
    place(s, &f, checks[i].severity == WRONG ? s->log->path : lab_file_name(s->log->path), where, sizeof where);
    if (checks[i].severity == WRONG)
      return lab_fail(error, LAB_DATA, "%s: %s", where, f.text);
    if (checks[i].severity == DOUBT)
      lab_limitation_no_verdict(limitations, "%s: %s.", where, f.text);
    else
      lab_limitation(limitations, "%s: %s.", where, f.text);
  }
  return LAB_OK;
}

/* Whether a fit has something to compare with a channel; a force only where it holds a driven stem. */
static int is_compared(const lab_log_view *s, int channel)
{
  return lab_log_view_predicts(s, channel) ||
         (channel == LAB_CHANNEL_FORCE && s->y[channel] && !s->rig->input[channel] && s->rig->laws.position_input);
}

void lab_say_idle_columns(const lab_rig *rig, const lab_log *log, lab_limitations *limitations)
{
  const struct {
    int channel, is_used;
    const char *why;
  } columns[] = {{LAB_CHANNEL_FORCE, rig->input[LAB_CHANNEL_FORCE] || rig->laws.position_input,
                  "it is predicted only where x is an input, and drives the model only as an input itself"},
                 {LAB_CHANNEL_P2, 0, "the model does not predict the far end of a line"}};
  size_t i;
  for (i = 0; i < sizeof columns / sizeof columns[0]; i++)
    if (log->value[columns[i].channel] && !columns[i].is_used)
      lab_limitation(limitations, "The column %s is not used: %s.", lab_channels[columns[i].channel].key,
                     columns[i].why);
}

static size_t count_values(const lab_log_view *s)
{
  size_t i, n = 0;
  int c;
  for (c = LAB_CHANNEL_P; c < LAB_CHANNEL_COUNT; c++)
    for (i = 0; is_compared(s, c) && i < s->n; i++)
      n += s->y[c][i] == s->y[c][i];
  return n;
}

int lab_plausible(const lab_rig *rig, const lab_log *log, lab_limitations *limitations, lab_content *content,
                  lab_error *error)
{
  size_t run;
  lab_say_idle_columns(rig, log, limitations);
  for (run = 0; run < log->n_runs; run++) {
    lab_log_view view;
    int status = lab_log_view_open(rig, log, run, &view, error);
    if (status == LAB_OK) {
      content->runs++;
      content->still += lab_log_view_is_still(&view);
      content->values += count_values(&view);
      if (view.n >= LAB_VIEW_FEWEST)
        status = check_run(&view, limitations, error);
    }
    lab_log_view_close(&view);
    if (status != LAB_OK)
      return status;
  }
  return LAB_OK;
}

int lab_plausible_content(const lab_rig *rig, const lab_content *content, lab_limitations *limitations,
                          lab_error *error)
{
  const size_t unknowns = rig->n_fit > 0 ? (size_t)rig->n_fit : 1;
  char still[LAB_LIMITATION_TEXT];
  if (content->values <= unknowns)
    return lab_fail(error, LAB_DATA, "the log is too short: %zu measured values for %zu unknowns determine nothing",
                    content->values, unknowns);
  if (content->runs > 0 && content->still == content->runs)
    return lab_fail(
        error, LAB_DATA,
        "nothing moves by more than the noise in any log: they determine nothing; record at least a fill and "
        "a vent");
  if (lab_is_at_rest(rig, 1, still))
    lab_limitation(limitations, "%s: %s.", lab_file_name(rig->file), still);
  if (content->values < VALUES_EACH * unknowns)
    lab_limitation_no_verdict(limitations,
                              "the log is short: %zu measured values for %zu unknowns are too few to name an effect.",
                              content->values, unknowns);
  return LAB_OK;
}

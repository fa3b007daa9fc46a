#include "recorded_summary.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "recorded_score.h"

static int is(const char *text, const char *word)
{
  return strcmp(text, word) == 0;
}

static int class_is(const blind_record *r, int class)
{
  return is(r->class, blind_class_text(class));
}

static int has_word(const char *words, const char *word)
{
  const size_t length = strlen(word);
  const char *at = words;
  while ((at = strstr(at, word)) && !((at == words || at[-1] == '+') && (at[length] == '+' || !at[length])))
    at += length;
  return at != NULL;
}

/* ---- Bars ---- */

static int all(const blind_record *r)
{
  (void)r;
  return 1;
}

static int nothing(const blind_record *r)
{
  return is(r->kind, "nothing");
}

static int visible(const blind_record *r)
{
  return r->ratio >= 2;
}

static int begins(const blind_record *r)
{
  return r->onset_due;
}

static int from_start(const blind_record *r)
{
  return isnan(r->onset);
}

static int false_alarm(const blind_record *r)
{
  return class_is(r, BLIND_FALSE_ALARM);
}

static int right(const blind_record *r)
{
  return class_is(r, BLIND_RIGHT);
}

static int undecided(const blind_record *r)
{
  return class_is(r, BLIND_UNDECIDED);
}

static int right_or_undecided(const blind_record *r)
{
  return right(r) || undecided(r);
}

static int partly(const blind_record *r)
{
  return class_is(r, BLIND_PARTLY);
}

static int overlooked(const blind_record *r)
{
  return class_is(r, BLIND_OVERLOOKED);
}

static int wrong(const blind_record *r)
{
  return class_is(r, BLIND_WRONG);
}

static int confidently_wrong(const blind_record *r)
{
  return false_alarm(r) || overlooked(r) || wrong(r);
}

static int no_answer(const blind_record *r)
{
  return class_is(r, BLIND_NO_ANSWER);
}

static int far_due(const blind_record *r)
{
  return r->far_due;
}

static int far_found(const blind_record *r)
{
  return r->far_found;
}

static int onset_within(const blind_record *r)
{
  return r->onset_within;
}

static int onset_said(const blind_record *r)
{
  return r->onset_said;
}

static int instrument(const blind_record *r)
{
  return r->instrument;
}

const blind_bar blind_recorded_bars[] = {
    {"nothing missing: something named (false alarm)", nothing, false_alarm, 0, 0.02},
    {"all logs: right or honestly undecided", all, right_or_undecided, 1, 0.90},
    {"all logs: confidently wrong (false alarm, overlooked, wrong)", all, confidently_wrong, 0, 0.02},
    {"all logs: no answer in the CPU time allowed, or an error", all, no_answer, 0, 0},
    {"all logs: right", all, right, -1, 0},
    {"all logs: undecided", all, undecided, -1, 0},
    {"all logs: partly right", all, partly, -1, 0},
    {"all logs: overlooked", all, overlooked, -1, 0},
    {"all logs: wrong", all, wrong, -1, 0},
    {"nothing missing: right", nothing, right, -1, 0},
    {"nothing missing: undecided", nothing, undecided, -1, 0},
    {"something visible missing: right", visible, right, -1, 0},
    {"something visible missing: right or undecided", visible, right_or_undecided, -1, 0},
    {"the value far beyond its tolerance is due: found", far_due, far_found, -1, 0},
    {"what begins within the log was named or found: the stated interval holds the instant", begins, onset_within, -1,
     0},
    {"all is from the start: an onset is stated", from_start, onset_said, -1, 0},
    {"all logs: the sensors' filter named", all, instrument, -1, 0},
};
const int blind_recorded_bar_count = sizeof blind_recorded_bars / sizeof blind_recorded_bars[0];

/* Deviations are counted one by one, not log by log. */
static const blind_bar due_bar = {"deviations beyond twice their interval: found", NULL, NULL, 1, 0.95};
static const blind_bar wrong_bar = {"deviations stated: more than twice their interval off the truth", NULL, NULL, -1,
                                    0};

static blind_count due_count(const blind_record *r, int n)
{
  blind_count c = {0, 0};
  int i;
  for (i = 0; i < n; i++) {
    c.k += r[i].n_found;
    c.n += r[i].n_due;
  }
  return c;
}

static blind_count wrong_count(const blind_record *r, int n)
{
  blind_count c = {0, 0};
  int i;
  for (i = 0; i < n; i++) {
    c.k += r[i].n_wrong;
    c.n += r[i].n_said;
  }
  return c;
}

/* ---- Totals ---- */

static void write_times(FILE *file, const blind_record *record, int n, double *time)
{
  int i;
  for (i = 0; i < n; i++)
    time[i] = record[i].cpu;
  if (n)
    fprintf(
        file,
        "\nCPU time: median %.3g s, 90th percentile %.3g s, longest %.3g s (where it was stopped that is the limit). "
        "Asked for: median below 1 s, none above 30 s.\n",
        blind_quantile(time, n, 0.5), blind_quantile(time, n, 0.9), blind_quantile(time, n, 1));
}

static void write_totals(FILE *file, const blind_record *record, int n)
{
  int i;
  blind_bar_header(file);
  for (i = 0; i < blind_recorded_bar_count; i++)
    blind_bar_row(file, &blind_recorded_bars[i], blind_bar_counts(&blind_recorded_bars[i], record, n));
  blind_bar_row(file, &due_bar, due_count(record, n));
  blind_bar_row(file, &wrong_bar, wrong_count(record, n));
}

/* ---- By groups ---- */

/* Trials of a group: those of which the text at an offset is, or has among others, a word. */
typedef int blind_group(const blind_record *r, const char *word);

static int of_imperfection(const blind_record *r, const char *word)
{
  return *word ? has_word(r->imperfections, word) : !*r->imperfections;
}

static int of_log(const blind_record *r, const char *word)
{
  return is(r->log, word);
}

static int of_effect(const blind_record *r, const char *word)
{
  return *word ? is(r->effect[0], word) || is(r->effect[1], word) : nothing(r);
}

static int of_beyond(const blind_record *r, const char *word)
{
  return is(r->beyond, word);
}

static int of_rate(const blind_record *r, const char *word)
{
  static const double edge[] = {0, 5, 20, 50, HUGE_VAL};
  const int at = *word - '0';
  return r->rate >= edge[at] && r->rate < edge[at + 1];
}

static void group_header(FILE *file, const char *title, const char *of)
{
  int i;
  fprintf(file, "\n## %s\n\n| %s | n |", title, of);
  for (i = 0; i < BLIND_CLASSES; i++)
    fprintf(file, " %s |", blind_class_text(i));
  fputs(" deviations found | CPU median, longest [s] |\n|---|---|", file);
  for (i = 0; i < BLIND_CLASSES; i++)
    fputs("---|", file);
  fputs("---|---|\n", file);
}

static void group_row(FILE *file, const char *name, const blind_record *record, int n, blind_group *belongs,
                      const char *word, double *time)
{
  int count[BLIND_CLASSES] = {0}, i, k, members = 0;
  blind_count due = {0, 0};
  for (i = 0; i < n; i++) {
    if (!belongs(&record[i], word))
      continue;
    time[members++] = record[i].cpu;
    for (k = 0; k < BLIND_CLASSES; k++)
      count[k] += class_is(&record[i], k);
    due.k += record[i].n_found;
    due.n += record[i].n_due;
  }
  if (!members)
    return;
  fprintf(file, "| %s | %d |", name, members);
  for (k = 0; k < BLIND_CLASSES; k++)
    fprintf(file, count[k] ? " %d |" : " |", count[k]);
  fprintf(file, " %d/%d | %.3g; %.3g |\n", due.k, due.n, blind_quantile(time, members, 0.5),
          blind_quantile(time, members, 1));
}

static void write_groups(FILE *file, const blind_record *record, int n, double *time)
{
  static const char *const rates[] = {"below 5 rows a second", "5 .. 20", "20 .. 50", "above 50"}, *const bins[] = {
                                                                                                       "0", "1", "2",
                                                                                                       "3"};
  int i;
  group_header(file, "By imperfection", "imperfection");
  group_row(file, "none but values within tolerance", record, n, of_imperfection, "", time);
  for (i = 0; i < BLIND_IMPERFECTIONS; i++)
    group_row(file, blind_imperfections[i].name, record, n, of_imperfection, blind_imperfections[i].name, time);
  group_header(file, "By channels and rows", "log");
  for (i = 0; i < BLIND_LOOPS; i++)
    group_row(file, blind_loop_text(i), record, n, of_log, blind_loop_text(i), time);
  for (i = 0; i < 4; i++)
    group_row(file, rates[i], record, n, of_rate, bins[i], time);
  group_header(file, "By effect, alone or as one of two", "effect");
  group_row(file, "nothing", record, n, of_effect, "", time);
  for (i = 0; i < blind_effect_count; i++)
    if (blind_effect_named(blind_effects[i].name) == &blind_effects[i])
      group_row(file, blind_effects[i].name, record, n, of_effect, blind_effects[i].name, time);
  group_header(file, "By the value that is far beyond its tolerance", "value");
  for (i = 0; i < BLIND_VALUES; i++)
    group_row(file, blind_values[i].name, record, n, of_beyond, blind_values[i].name, time);
}

/* ---- One by one ---- */

static int is_miss(const blind_record *r)
{
  return !right(r) || r->n_found < r->n_due || r->n_wrong || (r->onset_due && !r->onset_within) ||
         (from_start(r) && r->onset_said);
}

static void write_truth(FILE *file, const blind_record *r)
{
  const double over[BLIND_AT_ONCE] = {fabs(r->size[0]) / r->limit[0], r->second_ratio};
  int i;
  if (!*r->effect[0])
    fputs("nothing", file);
  for (i = 0; i < BLIND_AT_ONCE && *r->effect[i]; i++)
    fprintf(file, "%s%s %.3g %s (%.3g x)", i ? "; " : "", r->effect[i], r->size[i], r->unit[i], over[i]);
  if (*r->begins)
    fprintf(file, "; %s from %.5g s", r->begins, r->onset);
}

static void write_said(FILE *file, const blind_record *r)
{
  fprintf(file, "%s%s%s", r->verdict, *r->found ? ": " : "", r->found);
  if (is(r->verdict, "unlisted"))
    fprintf(file, " in %s", r->equation);
  if (*r->since)
    fprintf(file, " since %s", r->since);
  if (no_answer(r))
    fprintf(file, " %.120s", r->why);
}

void blind_recorded_misses(FILE *file, const blind_record *record, int n)
{
  int i;
  fputs("| trial | log, rows a second | class | truth (size over limit) | said | deviations due | deviations stated | "
        "imperfections | CPU [s] |\n|---|---|---|---|---|---|---|---|---|\n",
        file);
  for (i = 0; i < n; i++) {
    const blind_record *r = &record[i];
    if (!is_miss(r))
      continue;
    fprintf(file, "| %d | %s, %.3g | %s | ", r->trial, is(r->log, "open") ? r->channels : r->log, r->rate, r->class);
    write_truth(file, r);
    fputs(" | ", file);
    write_said(file, r);
    fprintf(file, " | %s | %s | %s | %.3g |\n", r->due, r->deviations, r->imperfections, r->cpu);
  }
}

/* ---- The whole ---- */

int blind_recorded_summary_write(FILE *file, const blind_record *record, int n, uint64_t seed, int seconds)
{
  double *time = malloc((size_t)(n ? n : 1) * sizeof *time);
  if (!time)
    return 1;
  fprintf(
      file,
      "# Blind trials of closeloop on logs as they are recorded\n\n%d trials, seed %" PRIu64
      ", written by `make blind`. Rigs and effects are those of the clean series (blind.md). What is declared is off "
      "by what its tolerance allows, one value in some rigs by 3 to 6 times that; a positioner holds the stem in some, "
      "along slow ramps or after work before the log; some lines resist as orifices; sensors have filters, hum, noise "
      "with memory, drift; loggers round time, jitter and lose rows; what is wrong may begin within the log. closeloop "
      "gets one log and the rig file, and %d s of CPU. Every trial is a line of the "
      "table beside this; `make blind-trial K=n SERIES=blind_recorded` repeats one.\n\n"
      "What counts as what, and what the log can show at best, is written in tests/blind/recorded_score.h and "
      "recorded_limit.h.\n\n",
      n, seed, seconds);
  write_totals(file, record, n);
  write_times(file, record, n, time);
  write_groups(file, record, n, time);
  fputs("\n## Misses, one by one\n\nAll that are not right, and those right ones of which a deviation or an onset is "
        "not. Deviations: true value over declared, of the vent the share by which it is narrower than "
        "the fill orifice; NOT: not found.\n\n",
        file);
  blind_recorded_misses(file, record, n);
  free(time);
  return 0;
}

#include "recorded_summary.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

#include "recorded_score.h"

static int class_is(const blind_record *r, int class)
{
  return blind_is(r->class, blind_class_text(class));
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

/* Traits of a trial: its class, what is true of it, what was said. */
enum {
  RIGHT = 1 << BLIND_RIGHT,
  UNDECIDED = 1 << BLIND_UNDECIDED,
  PARTLY = 1 << BLIND_PARTLY,
  FALSE_ALARM = 1 << BLIND_FALSE_ALARM,
  OVERLOOKED = 1 << BLIND_OVERLOOKED,
  WRONG = 1 << BLIND_WRONG,
  NO_ANSWER = 1 << BLIND_NO_ANSWER,
  ANY = 1 << BLIND_CLASSES,
  NOTHING = ANY << 1,
  VISIBLE = ANY << 2,
  FAR_DUE = ANY << 3,
  FAR_FOUND = ANY << 4,
  ONSET_DUE = ANY << 5,
  ONSET_WITHIN = ANY << 6,
  ONSET_SAID = ANY << 7,
  FROM_START = ANY << 8,
  INSTRUMENT = ANY << 9
};

static unsigned traits_of(const blind_record *r)
{
  unsigned traits = ANY | blind_mark(blind_is(r->kind, "nothing"), NOTHING) | blind_mark(r->ratio >= 2, VISIBLE) |
                    blind_mark(r->far_due, FAR_DUE) | blind_mark(r->far_found, FAR_FOUND) |
                    blind_mark(r->onset_due, ONSET_DUE) | blind_mark(r->onset_within, ONSET_WITHIN) |
                    blind_mark(r->onset_said, ONSET_SAID) | blind_mark(isnan(r->onset), FROM_START) |
                    blind_mark(r->instrument, INSTRUMENT);
  int k;
  for (k = 0; k < BLIND_CLASSES; k++)
    traits |= blind_mark(class_is(r, k), 1u << k);
  return traits;
}

static const blind_bar bars[] = {
    {"nothing missing: something named (false alarm)", NOTHING, FALSE_ALARM, 0, 0.02},
    {"all logs: right or honestly undecided", ANY, RIGHT | UNDECIDED, 1, 0.90},
    {"all logs: confidently wrong (false alarm, overlooked, wrong)", ANY, FALSE_ALARM | OVERLOOKED | WRONG, 0, 0.02},
    {"all logs: no answer in the CPU time allowed, or an error", ANY, NO_ANSWER, 0, 0},
    {"all logs: right", ANY, RIGHT, -1, 0},
    {"all logs: undecided", ANY, UNDECIDED, -1, 0},
    {"all logs: partly right", ANY, PARTLY, -1, 0},
    {"all logs: overlooked", ANY, OVERLOOKED, -1, 0},
    {"all logs: wrong", ANY, WRONG, -1, 0},
    {"nothing missing: right", NOTHING, RIGHT, -1, 0},
    {"nothing missing: undecided", NOTHING, UNDECIDED, -1, 0},
    {"something visible missing: right", VISIBLE, RIGHT, -1, 0},
    {"something visible missing: right or undecided", VISIBLE, RIGHT | UNDECIDED, -1, 0},
    {"the value far beyond its tolerance is due: found", FAR_DUE, FAR_FOUND, -1, 0},
    {"what begins within the log was named or found: the stated interval holds the instant", ONSET_DUE, ONSET_WITHIN,
     -1, 0},
    {"all is from the start: an onset is stated", FROM_START, ONSET_SAID, -1, 0},
    {"all logs: the sensors' filter named", ANY, INSTRUMENT, -1, 0},
};
const blind_bar_list blind_recorded_bars = {bars, sizeof bars / sizeof *bars, traits_of};

/* Deviations are counted one by one, not log by log. */
static const blind_bar due_bar = {"deviations beyond twice their interval: found", 0, 0, 1, 0.95};
static const blind_bar wrong_bar = {"deviations stated: more than twice their interval off the truth", 0, 0, -1, 0};

static void write_deviations(FILE *file, const blind_record *r, int n)
{
  blind_count due = {0, 0}, wrong = {0, 0};
  int i;
  for (i = 0; i < n; i++) {
    due.k += r[i].n_found;
    due.n += r[i].n_due;
    wrong.k += r[i].n_wrong;
    wrong.n += r[i].n_said;
  }
  blind_bar_row(file, &due_bar, due);
  blind_bar_row(file, &wrong_bar, wrong);
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

/* ---- By groups ---- */

/* Trials of a group: those of which the text at an offset is, or has among others, a word. */
typedef int blind_group(const blind_record *r, const char *word);

static int of_imperfection(const blind_record *r, const char *word)
{
  return *word ? has_word(r->imperfections, word) : !*r->imperfections;
}

static int of_log(const blind_record *r, const char *word)
{
  return blind_is(r->log, word);
}

static int of_effect(const blind_record *r, const char *word)
{
  return *word ? blind_is(r->effect[0], word) || blind_is(r->effect[1], word) : blind_is(r->kind, "nothing");
}

static int of_beyond(const blind_record *r, const char *word)
{
  return blind_is(r->beyond, word);
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
  return !class_is(r, BLIND_RIGHT) || r->n_found < r->n_due || r->n_wrong || (r->onset_due && !r->onset_within) ||
         (isnan(r->onset) && r->onset_said);
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
  if (blind_is(r->verdict, "unlisted"))
    fprintf(file, " in %s", r->equation);
  if (*r->since)
    fprintf(file, " since %s", r->since);
  if (class_is(r, BLIND_NO_ANSWER))
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
    fprintf(file, "| %d | %s, %.3g | %s | ", r->trial, blind_is(r->log, "open") ? r->channels : r->log, r->rate,
            r->class);
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
  blind_bar_table(file, &blind_recorded_bars, record, n);
  write_deviations(file, record, n);
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

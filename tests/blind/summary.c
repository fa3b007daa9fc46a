#include "summary.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

/* ---- Small parts ---- */

static int is_pressure_and_position(const blind_record *r)
{
  return strncmp(r->channels, "px", 2) == 0;
}

/* "12/13", or a dash where there is nothing to count. */
static const char *ratio_text(blind_count c, char text[32])
{
  if (c.n)
    snprintf(text, 32, "%d/%d", c.k, c.n);
  else
    strcpy(text, "-");
  return text;
}

static const char *number_text(double x, char text[32])
{
  if (isfinite(x))
    snprintf(text, 32, "%.3g", x);
  else
    strcpy(text, "-");
  return text;
}

static void add(blind_count *c, int hit)
{
  c->n++;
  c->k += hit != 0;
}

/* ---- Totals ---- */

void blind_bar_row(FILE *file, const blind_bar *bar, blind_count c)
{
  static const char *const words[] = {"**no**", "**no**, but it may be chance", "in this sample", "yes"};
  double low, high;
  blind_wilson(c, &low, &high);
  fprintf(file, "| %s | %d/%d | ", bar->what, c.k, c.n);
  if (c.n)
    fprintf(file, "%.1f %% | %.1f .. %.1f | ", 100.0 * c.k / c.n, 100 * low, 100 * high);
  else
    fputs("- | - | ", file);
  if (bar->at_least >= 0)
    fprintf(file, "%s %g %% | %s |\n", bar->at_least ? "at least" : "at most", 100 * bar->share,
            words[blind_bar_word(bar, c)]);
  else
    fputs("| |\n", file);
}

void blind_bar_table(FILE *file, const blind_bar_list *bars, const blind_record *record, int n)
{
  int i;
  fputs("## Totals\n\nIntervals are Wilson's, 95 %; a bar is met where the whole interval meets it, \"in this sample\" "
        "where only the share does.\n\n| what | count | share | 95 % | bar | met |\n|---|---|---|---|---|---|\n",
        file);
  for (i = 0; i < bars->n; i++)
    blind_bar_row(file, &bars->bar[i], blind_bar_counts(bars, i, record, n));
}

static void write_totals(FILE *file, const blind_record *record, int n)
{
  blind_bar_table(file, &blind_bars, record, n);
  fputs("\n\"Above\": of a size of at least twice the information limit. \"Listed\": closeloop says that the effect is "
        "significant, but adds nothing, because the error would fall by less than --min-gain, 2 %.\n",
        file);
}

/* ---- Effect by effect ---- */

/* Trials with one and the same effect missing, by its name and unit; of listed ones with p and x. */
static int is_row(const blind_record *r, const blind_effect *e)
{
  const int kind = blind_is_listed(e) ? blind_is(r->kind, "single") : blind_is(r->kind, "unlisted");
  return kind && is_pressure_and_position(r) && blind_is(r->effect[0], e->name) && blind_is(r->unit[0], e->unit);
}

typedef struct tally {
  int n, above, n_held;
  blind_count detected, name, stated, family; /* above twice the limit */
  double *held, *limit;                       /* held-out errors above; information limits */
  blind_sized *sized;                         /* found against size */
} tally;

static int open_tally(tally *t, int n)
{
  const size_t room = (size_t)(n ? n : 1);
  memset(t, 0, sizeof *t);
  t->held = malloc(room * sizeof *t->held);
  t->limit = malloc(room * sizeof *t->limit);
  t->sized = malloc(room * sizeof *t->sized);
  return t->held && t->limit && t->sized;
}

static void close_tally(tally *t)
{
  free(t->held);
  free(t->limit);
  free(t->sized);
}

static void count_in(const blind_record *r, tally *t)
{
  t->sized[t->n] = (blind_sized){fabs(r->size[0]), r->stated};
  t->limit[t->n++] = r->limit[0];
  if (!(r->ratio >= 2))
    return;
  t->above++;
  add(&t->detected, r->detected);
  add(&t->name, r->name);
  add(&t->stated, r->stated);
  add(&t->family, r->family);
  if (isfinite(r->holdout_after))
    t->held[t->n_held++] = r->holdout_after;
}

static void write_row(FILE *file, const blind_effect *e, tally *t)
{
  char a[32], b[32], c[32], d[32], h[32], i[32], j[32], k[32];
  const double nan = (double)NAN;
  fprintf(file, "| %s | %d | %d | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", e->name, t->n, t->above,
          ratio_text(t->detected, a), ratio_text(t->name, b), ratio_text(t->stated, c), ratio_text(t->family, d),
          number_text(t->n_held ? blind_quantile(t->held, t->n_held, 0.5) : nan, h),
          number_text(t->n_held ? blind_quantile(t->held, t->n_held, 0.9) : nan, i),
          number_text(blind_nine_in_ten(t->sized, t->n), j), number_text(blind_quantile(t->limit, t->n, 0.5), k),
          e->unit);
}

static int write_effects(FILE *file, const blind_record *record, int n, int listed)
{
  int e, i, status = 0;
  fprintf(
      file,
      "\n## %s\n\nAlone in a log with p and x. Detected, right, stated, family and the error of the completed model "
      "on held-out data (over noise) count trials above twice the information limit. Limit of being stated: "
      "isotonic regression of \"%s\" on size over all trials, the smallest drawn size from which it is 0.9 or "
      "more.\n\n"
      "| effect | n | above | detected | right | right or stated | right family | held-out error, median | 90th "
      "percentile | limit of being stated | information limit, median | unit |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      listed ? "Effects of the catalogue" : "Effects that are not in the catalogue",
      listed ? "right or stated" : "unlisted, in the right equation");
  for (e = 0; e < blind_effect_count; e++) {
    tally t;
    if (blind_is_listed(&blind_effects[e]) != listed)
      continue;
    status |= !open_tally(&t, n);
    for (i = 0; i < n && !status; i++)
      if (is_row(&record[i], &blind_effects[e]))
        count_in(&record[i], &t);
    if (t.n)
      write_row(file, &blind_effects[e], &t);
    close_tally(&t);
  }
  return status;
}

/* ---- By size ---- */

static const double edges[] = {0, 1, 2, 5, 20, 100, HUGE_VAL};
enum { BINS = sizeof edges / sizeof edges[0] - 1 };

static int bin_of(double ratio)
{
  int b = 0;
  while (b + 1 < BINS && ratio >= edges[b + 1])
    b++;
  return b;
}

static void bin_title(int b, char text[32])
{
  if (b == 0)
    snprintf(text, 32, "below %g", edges[1]);
  else if (b + 1 == BINS)
    snprintf(text, 32, "above %g", edges[b]);
  else
    snprintf(text, 32, "%g .. %g", edges[b], edges[b + 1]);
}

static void write_sizes(FILE *file, const blind_record *record, int n)
{
  int b, i;
  fputs("\n## By size\n\nOne effect of the catalogue missing, p and x; size over information limit.\n\n"
        "| size over limit | n | detected | right | right or stated | right family |\n|---|---|---|---|---|---|\n",
        file);
  for (b = 0; b < BINS; b++) {
    blind_count c[4] = {{0, 0}};
    char title[32], text[4][32];
    for (i = 0; i < n; i++)
      if (blind_is(record[i].kind, "single") && is_pressure_and_position(&record[i]) && bin_of(record[i].ratio) == b) {
        add(&c[0], record[i].detected);
        add(&c[1], record[i].name);
        add(&c[2], record[i].stated);
        add(&c[3], record[i].family);
      }
    bin_title(b, title);
    fprintf(file, "| %s | %d | %s | %s | %s | %s |\n", title, c[0].n, ratio_text(c[0], text[0]),
            ratio_text(c[1], text[1]), ratio_text(c[2], text[2]), ratio_text(c[3], text[3]));
  }
}

static void write_sizes_of_effects(FILE *file, const blind_record *record, int n)
{
  int e, b, i;
  char text[32];
  fputs("\nRight or stated, effect by effect:\n\n| effect |", file);
  for (b = 0; b < BINS; b++) {
    bin_title(b, text);
    fprintf(file, " %s |", text);
  }
  fputs("\n|---|", file);
  for (b = 0; b < BINS; b++)
    fputs("---|", file);
  for (e = 0; e < blind_effect_count; e++) {
    blind_count c[BINS] = {{0, 0}};
    int any = 0;
    for (i = 0; i < n; i++)
      if (is_row(&record[i], &blind_effects[e])) {
        add(&c[bin_of(record[i].ratio)], record[i].stated);
        any = 1;
      }
    if (!any)
      continue;
    fprintf(file, "\n| %s [%s] |", blind_effects[e].name, blind_effects[e].unit);
    for (b = 0; b < BINS; b++)
      fprintf(file, " %s |", ratio_text(c[b], text));
  }
  fputc('\n', file);
}

/* ---- One by one ---- */

static void write_truth(FILE *file, const blind_record *r)
{
  int i;
  if (!*r->effect[0])
    fputs("nothing", file);
  for (i = 0; i < BLIND_AT_ONCE && *r->effect[i]; i++)
    fprintf(file, "%s%s %.3g %s (%.3g x)", i ? "; " : "", r->effect[i], r->size[i], r->unit[i],
            fabs(r->size[i]) / r->limit[i]);
}

static void write_miss(FILE *file, const blind_record *r)
{
  char text[32];
  fprintf(file, "| %d | %s | ", r->trial, r->channels);
  write_truth(file, r);
  fprintf(file, " | %s%s%s%s%s | %s | %s |\n", r->verdict, *r->found ? ": " : "", r->found,
          blind_is(r->verdict, "unlisted") ? " in " : "", blind_is(r->verdict, "unlisted") ? r->equation : "",
          number_text(r->holdout_after, text), r->why);
}

/* Trials of a set, in their order. */
static void write_list(FILE *file, const char *title, const blind_record *record, int n,
                       int (*belongs)(const blind_record *))
{
  int i, any = 0;
  fprintf(file, "\n## %s\n\n", title);
  for (i = 0; i < n; i++)
    if (belongs(&record[i])) {
      if (!any++)
        fputs("| trial | channels | missing (size over limit) | said | held-out error | why "
              "|\n|---|---|---|---|---|---|\n",
              file);
      write_miss(file, &record[i]);
    }
  if (!any)
    fputs("None.\n", file);
}

static int is_false_alarm(const blind_record *r)
{
  return blind_is(r->kind, "nothing") && !r->name;
}

static int is_miss_above(const blind_record *r)
{
  return !blind_is(r->kind, "nothing") && r->ratio >= 2 && !r->stated;
}

static int is_stated_only(const blind_record *r)
{
  return r->stated && !r->name;
}

static int is_miss_below(const blind_record *r)
{
  return !blind_is(r->kind, "nothing") && !(r->ratio >= 2) && !r->stated;
}

/* ---- The whole ---- */

int blind_summary_write(FILE *file, const blind_record *record, int n, uint64_t seed, const char *what)
{
  int failed;
  fprintf(file,
          "# Blind trials of closeloop\n\n%d trials, seed %" PRIu64
          ", written by `make blind`. %sRigs, effects, sizes, "
          "noise and commands are drawn at random; the logs come from the independent simulator of tests/second; "
          "closeloop sees the logs and the rig file, which has the true laws, supply and ambient, and a start for what "
          "is fitted. Noise is white and Gaussian. Every trial is a line of the table beside this; `make blind-trial "
          "K=n` repeats "
          "one.\n\nInformation limit: the size at which the projected statistic reaches 25, computed from the "
          "simulator alone (tests/blind/limit.h).\n\n",
          n, seed, what);
  write_totals(file, record, n);
  failed = write_effects(file, record, n, 1);
  write_sizes(file, record, n);
  write_sizes_of_effects(file, record, n);
  failed |= write_effects(file, record, n, 0);
  write_list(file, "False alarms", record, n, is_false_alarm);
  write_list(file, "Misses above twice the information limit", record, n, is_miss_above);
  write_list(file,
             "Not added under their names, but stated: indistinguishable from what was named, or significant but below "
             "--min-gain",
             record, n, is_stated_only);
  write_list(file, "Misses below twice the information limit", record, n, is_miss_below);
  return failed;
}

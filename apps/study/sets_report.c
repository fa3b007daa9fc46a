#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "../lab/base/outfile.h"
#include "sets_read.h"
#include "sets_section.h"

/* ---- The table ---- */

/* " 115 Pa (16.5) |" */
static void write_cell(FILE *file, const sets_error *e, const char *unit)
{
  char a[SETS_CELL_TEXT], b[SETS_CELL_TEXT];
  if (isnan(e->value))
    fputs(" - |", file);
  else if (isnan(e->in_noise))
    fprintf(file, " %s %s |", sets_digits(a, e->value), unit);
  else
    fprintf(file, " %s %s (%s) |", sets_digits(a, e->value), unit, sets_digits(b, e->in_noise));
}

static void write_alike(FILE *file, const cJSON *found)
{
  const cJSON *other;
  int any = 0;
  cJSON_ArrayForEach(other, sets_member(found, "indistinguishable_from"))
      fprintf(file, "%s%s", any++ ? ", " : " (or ", cJSON_GetStringValue(other));
  if (any)
    fputs(")", file);
}

static void write_found(FILE *file, const cJSON *json)
{
  const cJSON *found;
  int any = 0;
  cJSON_ArrayForEach(found, sets_member(json, "found"))
  {
    fprintf(file, "%s%s", any++ ? ", " : " ", cJSON_GetStringValue(sets_member(found, "effect")));
    write_alike(file, found);
  }
  if (cJSON_GetArraySize(sets_member(json, "unlisted")) > 0)
    fprintf(file, "%sa term without a name", any++ ? ", " : " ");
  fputs(any ? " |\n" : " none |\n", file);
}

/* Verdicts of closeloop in words of the table. */
static const char *const verdicts[][2] = {{"effect", "explained"},
                                          {"unlisted", "explained, without a name"},
                                          {"none", "nothing missing"},
                                          {"undecided", "undecided"}};

enum { VERDICTS = sizeof verdicts / sizeof *verdicts };

/* Returns: VERDICTS if it is none of them */
static int verdict_of(const cJSON *json)
{
  const char *verdict = cJSON_GetStringValue(sets_member(json, "verdict"));
  int i = 0;
  while (i < VERDICTS && (!verdict || strcmp(verdict, verdicts[i][0]) != 0))
    i++;
  return i;
}

static const char *verdict_words(const cJSON *json)
{
  const int i = verdict_of(json);
  return i < VERDICTS ? verdicts[i][1] : "-";
}

/* A channel that is predicted and not fitted: its errors are those of a hold-out. */
static void write_check(FILE *file, const config_setting_t *set, const cJSON *json)
{
  const char *check = sets_text(set, "check"), *unit = sets_text(set, "check_unit");
  sets_errors e = sets_errors_of(json, check, unit);
  if (!*check)
    return;
  e.before.in_noise = e.after.in_noise = (double)NAN;
  fprintf(file, "| - the same, not fitted | %s | - | - | - |", check);
  write_cell(file, &e.before, unit);
  write_cell(file, &e.after, unit);
  fputs(" | |\n", file);
}

static void write_row(FILE *file, const sets_result *r, const cJSON *json)
{
  const char *unit = sets_text(r->set, "unit");
  const sets_errors e = sets_errors_of(json, sets_text(r->set, "judged"), unit);
  char a[SETS_CELL_TEXT];
  fprintf(file, "| [%s](%s/report.json) | %s |", sets_text(r->set, "title"), sets_text(r->set, "name"),
          sets_text(r->set, "judged"));
  if (!json) {
    fprintf(file, " - | - | - | - | - | %s | |\n", r->state == SETS_ABSENT ? "data absent" : "closeloop failed");
    return;
  }
  fprintf(file, " %s %s |", sets_digits(a, sets_noise(&e)), unit);
  write_cell(file, &e.before, unit);
  write_cell(file, &e.after, unit);
  write_cell(file, &e.held_before, unit);
  write_cell(file, &e.held_after, unit);
  fprintf(file, " %s |", verdict_words(json));
  write_found(file, json);
  write_check(file, r->set, json);
}

/* ---- What the table says ---- */

/* Names in a row. */
typedef struct names {
  char text[4 * SETS_NAMES_TEXT];
  int n;
} names;

static void add_name(names *to, const char *format, ...)
{
  const size_t used = strlen(to->text);
  const size_t comma = (size_t)snprintf(to->text + used, sizeof to->text - used, "%s", to->n++ ? "; " : "");
  va_list rest;
  if (used + comma >= sizeof to->text)
    return;
  va_start(rest, format);
  vsnprintf(to->text + used + comma, sizeof to->text - used - comma, format, rest);
  va_end(rest);
}

/* What is counted over the sets, and what breaks it. */
typedef struct tally {
  int ran, held, lower;
  int verdict[VERDICTS + 1];
  int logs, logs_lower; /* the same over the logs held out */
  names not_lower;      /* sets whose error held out does not fall */
  names by_channel;     /* those that are judged by a channel that was not fitted */
  names raised;         /* those whose error held out was lower on the way */
} tally;

/* The error on what took no part: of the runs held out, or of the channel that was not fitted. */
static void independent_error(const config_setting_t *set, const cJSON *json, double *before, double *after)
{
  const char *check = sets_text(set, "check");
  const sets_errors held = sets_errors_of(json, sets_text(set, "judged"), sets_text(set, "unit"));
  const sets_errors other = sets_errors_of(json, check, sets_text(set, "check_unit"));
  *before = *check ? other.before.value : held.held_before.value;
  *after = *check ? other.after.value : held.held_after.value;
}

static void count_raised(tally *t, const config_setting_t *set, const cJSON *json)
{
  const char *channel = sets_text(set, "judged"), *unit = sets_text(set, "unit");
  const cJSON *best = sets_best_on_the_way(json, channel, unit);
  char a[SETS_CELL_TEXT], b[SETS_CELL_TEXT];
  if (best)
    add_name(&t->raised, "%s (%s to %s %s)", sets_text(set, "title"),
             sets_digits(a, sets_error_of(sets_member(best, "holdout"), channel, unit).value),
             sets_digits(b, sets_errors_of(json, channel, unit).held_after.value), unit);
}

static void count(tally *t, const sets_result *r, const cJSON *json)
{
  const char *title = sets_text(r->set, "title"), *check = sets_text(r->set, "check");
  char worse[SETS_NAMES_TEXT];
  double before, after;
  int better;
  if (!json)
    return;
  t->ran++;
  t->verdict[verdict_of(json)]++;
  t->logs += sets_held_logs(json, sets_text(r->set, "judged"), &better, worse);
  t->logs_lower += better;
  count_raised(t, r->set, json);
  independent_error(r->set, json, &before, &after);
  if (isnan(before) || isnan(after))
    return;
  t->held++;
  t->lower += after < before;
  if (after >= before)
    add_name(&t->not_lower, "%s", title);
  if (*check)
    add_name(&t->by_channel, "%s (%s)", title, check);
}

static void write_tally(FILE *file, const tally *t, int n)
{
  int i, any = 0;
  fprintf(file, "\nOf %d sets %d ran", n, t->ran);
  for (i = 0; i < VERDICTS; i++)
    if (t->verdict[i] > 0)
      fprintf(file, "%s %d %s", any++ ? "," : ":", t->verdict[i], verdicts[i][1]);
  fprintf(file, ". On what took no part in the fit the completed model is nearer than the declared one in %d of %d",
          t->lower, t->held);
  if (t->not_lower.n > 0)
    fprintf(file, "; not in: %s", t->not_lower.text);
  fprintf(file, ". Of %d logs held out, each taken by itself, it is nearer in %d; the sections name the others.\n",
          t->logs, t->logs_lower);
  if (t->by_channel.n > 0)
    fprintf(file, "\nWhat took no part is a channel that was not fitted, not a run held out, in: %s.\n",
            t->by_channel.text);
  if (t->raised.n > 0)
    fprintf(file,
            "\nNearer than the declared model is not nearest: the error held out was lower on the way, and what was "
            "added after that raised it, in %d: %s.\n",
            t->raised.n, t->raised.text);
}

/* ---- The report ---- */

static const char head[] =
    "# Measured sets\n\n"
    "Made by `make measured`; every number below is read from the files that closeloop wrote, but for what a rig file "
    "declares. Each set is one rig file and some raw logs of other people ([where they are "
    "from](../../study/measured/fetch.sh)), read as they are: what is left out or put in before a fit is in the group "
    "`log` of the rig file.\n\n"
    "- Before: the declared model, its unknowns fitted. After: what it lacks traced, added and fitted.\n"
    "- Held out: other runs, or where there is one record other rows of it, which took no part in the fit or in the "
    "choice of what to add.\n"
    "- Errors are root mean squares over all values of the channel. In brackets: the same over the sensor's noise, "
    "which the rig file declares with where it is from. At 1 nothing but noise is left.\n"
    "- Explained: what is left passes for noise. Undecided: it does not, so that the effects found come nearest but "
    "may stand in for others.\n"
    "- Root chi-square: what the fit makes small, the root of the sum of squares over the noise, as a share of that of "
    "the declared model. It takes into account that noise is correlated in time, which root mean squares do not.\n"
    "- BIC: Schwarz's criterion, chi-square and a penalty for each parameter.\n"
    "- Lag-1 autocorrelation of what is left: at 0 it is noise, near 1 a slow wave.\n\n"
    "| set | channel | noise | before | after | held out, before | held out, after | verdict | effects found |\n"
    "|---|---|---|---|---|---|---|---|---|\n";

static int write_all(FILE *file, const sets_result *result, int n, cJSON *const *json, const char *out_dir,
                     lab_error *error)
{
  static tally t;
  int i, status = LAB_OK;
  memset(&t, 0, sizeof t);
  fputs(head, file);
  for (i = 0; i < n; i++) {
    write_row(file, &result[i], json[i]);
    count(&t, &result[i], json[i]);
  }
  write_tally(file, &t, n);
  for (i = 0; i < n && status == LAB_OK; i++)
    status = sets_section(file, &result[i], json[i], out_dir, error);
  return status;
}

int sets_report(const sets_result *result, int n, const char *out_dir, lab_error *error)
{
  cJSON *json[SETS_MAX];
  char path[SETS_PATH_TEXT];
  lab_outfile out;
  int i, status;
  snprintf(path, sizeof path, "%s/REPORT.md", out_dir);
  if (lab_out_open(&out, path, error))
    return error->status;
  for (i = 0; i < n; i++)
    json[i] = result[i].state == SETS_DONE ? sets_json(out_dir, result[i].set) : NULL;
  status = write_all(out.file, result, n, json, out_dir, error);
  for (i = 0; i < n; i++)
    cJSON_Delete(json[i]);
  if (status != LAB_OK) {
    lab_out_abandon(&out);
    return status;
  }
  return lab_out_close(&out, error);
}

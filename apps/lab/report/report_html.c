#include "report_html.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cjson/cJSON.h>

#include "../metrics/metricstext.h"
#include "../base/outfile.h"
#include "pagetext.h"
#include "../base/quantile.h"
#include "../base/shown.h"
#include "../trace/unlisted.h"
#include "svginline.h"
#include "../base/template.h"
#include "../base/text.h"

static const double white_level = 0.01; /* p-value below which a residual is called not white */
static const double rough = 0.1;        /* half an interval over the value, from which on it is worth a word */

/* What the values of the page are made from. */
typedef struct telling {
  const lab_story *story;
  const lab_evidence *evidence;
  const lab_figures *figures;
} telling;

/* ---- Values ---- */

static void put(cJSON *to, const char *name, const char *format, ...) LAB_PRINTF(3, 4);
static void put(cJSON *to, const char *name, const char *format, ...)
{
  char text[1400];
  va_list list;
  va_start(list, format);
  vsnprintf(text, sizeof text, format, list);
  va_end(list);
  cJSON_AddStringToObject(to, name, text);
}

/* Add a text to a list. */
static void say(cJSON *list, const char *format, ...) LAB_PRINTF(2, 3);
static void say(cJSON *list, const char *format, ...)
{
  char text[1400];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  cJSON_AddItemToArray(list, cJSON_CreateString(text));
}

static cJSON *append(cJSON *list)
{
  cJSON *item = cJSON_CreateObject();
  cJSON_AddItemToArray(list, item);
  return item;
}

static void put_number(cJSON *to, const char *name, double value, int digits)
{
  char text[LAB_SHOWN_TEXT];
  cJSON_AddStringToObject(to, name, lab_shown_number(value, digits, text));
}

static void put_quantity(cJSON *to, const char *name, double value, const char *unit, int digits)
{
  char text[LAB_SHOWN_TEXT];
  cJSON_AddStringToObject(to, name, lab_shown_quantity(value, unit, digits, text));
}

static void put_p(cJSON *to, const char *name, double p)
{
  char text[LAB_SHOWN_TEXT];
  cJSON_AddStringToObject(to, name, lab_shown_p(p, text));
}

static void put_share(cJSON *to, const char *name, double share)
{
  put(to, name, "%.3g %%", 100 * fmin(fmax(share, 0), 1));
}

static const char *effect_name(int effect)
{
  return pneu_effect_at(effect)->name;
}

static int has_completed(const telling *t)
{
  return t->story->result->n_found > 0;
}

/* ---- Head and errors ---- */

static void put_head(const telling *t, cJSON *page)
{
  static const char *const badge[] = {"nothing missing", "effect found", "something unlisted", "undecided"};
  const lab_story *story = t->story;
  const int verdict = story->result->verdict;
  char sentence[LAB_SENTENCE_TEXT];
  lab_story_sentence(story, sentence, sizeof sentence);
  put(page, "sentence", "%s", sentence);
  put(page, "verdict", "%s", lab_verdict_text(verdict));
  put(page, "badge", "%s", badge[verdict]);
  put(page, "rig", "%s", story->rig->name);
  put(page, "rig_file", "%s", lab_file_name(story->rig->file));
  put(page, "gas", "%s", pneu_gas_key(story->rig->laws.gas));
  put(page, "flow", "%s", pneu_flow_key(story->rig->laws.flow));
  put(page, "version", "%s", PNEU_VERSION);
  put(page, "completed", "%s", has_completed(t) ? "yes" : "");
  put(page, "holdout", "%s", story->has_holdout ? "yes" : "");
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
    put(page, "rows", "%zu rows in %d runs", t->evidence->n, u->n_experiments);
  else
    put(page, "rows", "%zu rows", t->evidence->n);
  put(page, "logs", "%s", names);
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
  const int both = has_completed(t), held = story->has_holdout;
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
      say(headings, "%s", columns[i].heading);
  for (c = 0; c < LAB_CHANNEL_COUNT; c++) {
    cJSON *row, *cells;
    if (isnan(story->result->before.rmse[c]))
      continue;
    row = append(errors);
    put(row, "channel", "%s %s", lab_channels[c].quantity, lab_channels[c].key);
    cells = cJSON_AddArrayToObject(row, "columns");
    for (i = 0; i < n; i++)
      if (columns[i].shown) {
        cJSON *cell = append(cells);
        put_quantity(cell, "rmse", columns[i].errors->rmse[c], lab_channels[c].unit, 3);
        put_number(cell, "in_noise", columns[i].errors->in_noise[c], 3);
        put(cell, "stage", "%s", columns[i].stage ? "after" : "before");
        put(cell, "share", "%.0f", 100 * fmax(columns[i].errors->in_noise[c], 0) / largest_of(columns, n, c));
      }
  }
}

/* ---- Why ---- */

/* The whole unit of an unknown: x->unit has no room for the longest. */
static const char *unit_of(const lab_unknown *x)
{
  pneu_param_info info;
  const int is_listed = x->kind == LAB_UNKNOWN_PARAM && x->index != LAB_FIT_ORIFICE_AREA;
  return is_listed && pneu_param_describe(x->index, &info) == PNEU_OK ? info.unit : x->unit;
}

/* Digits at which both ends of the interval of an unknown can be told apart. */
static int digits_of(const telling *t, int j)
{
  const lab_fit_result *fit = &t->story->result->fit;
  const double value = fabs(t->story->completed->unknown[j].value), width = fit->high[j] - fit->low[j];
  if (fit->state[j] != LAB_FIT_FREE || !(width > 0) || !(value > width))
    return 4;
  return (int)fmin(fmax(4, 2 + ceil(log10(value / width))), 9);
}

/* "0.0136 .. 0.0138", or why there is none */
static void put_interval(const telling *t, int j, cJSON *to)
{
  const lab_fit_result *fit = &t->story->result->fit;
  const double scale = lab_shown_as(unit_of(&t->story->completed->unknown[j])).scale;
  char low[LAB_SHOWN_TEXT], high[LAB_SHOWN_TEXT];
  if (fit->state[j] == LAB_FIT_FREE)
    put(to, "interval", "%s .. %s", lab_shown_number(scale * fit->low[j], digits_of(t, j), low),
        lab_shown_number(scale * fit->high[j], digits_of(t, j), high));
  else
    put(to, "interval", "%s", lab_fit_state_text(fit->state[j]));
}

/* All parameters of an effect that were fitted. */
static void put_sizes(const telling *t, int effect, cJSON *list)
{
  const lab_unknowns *u = t->story->completed;
  int i, count, first = pneu_effect_params(effect, &count);
  for (i = first; i < first + count; i++) {
    const int j = lab_unknowns_find(u, i);
    pneu_param_info info;
    cJSON *item;
    if (j < 0)
      continue;
    pneu_param_describe(i, &info);
    item = append(list);
    put(item, "meaning", "%s", info.meaning);
    put_quantity(item, "value", u->unknown[j].value, unit_of(&u->unknown[j]), digits_of(t, j));
    put_interval(t, j, item);
  }
}

/* What was found and has no name. */
static void put_unlisted(const telling *t, const lab_found *found, cJSON *list)
{
  const pneu_term *term = &t->story->completed->rig.term[found->term];
  char where[LAB_WHERE_TEXT];
  cJSON *item = append(list);
  put(item, "name", "Not in the catalogue");
  put(item, "what", "Something acts like %s: %s.", lab_unlisted_what(term), lab_unlisted_where(term, where));
  put(item, "footprint", "%s", lab_unlisted_where(term, where));
  put(item, "source", "a free term; its values are in model.cfg");
  put(item, "equation", "%s", lab_unlisted_equation(term));
  cJSON_AddArrayToObject(item, "sizes");
  put_share(item, "explained", found->explained);
  put_number(item, "statistic", found->statistic, 3);
  put_number(item, "threshold", lab_chi2_threshold(t->story->result->level), 3);
  put_p(item, "p_value", lab_chi2_tail(found->statistic, found->degrees));
}

static void put_found(const telling *t, const lab_found *found, cJSON *list)
{
  static const struct {
    const char *key, *words;
  } equations[] = {{"mass", "balance of mass in the chamber"},
                   {"energy", "balance of energy in the chamber"},
                   {"force", "balance of forces on the stem"},
                   {"command", "from the command to the opening"},
                   {"sensor", "what a sensor shows"}};
  const pneu_effect *effect = pneu_effect_at(found->effect);
  cJSON *item = append(list);
  size_t i;
  put(item, "name", "%s", effect->name);
  put(item, "what", "%s", effect->what);
  put(item, "footprint", "%s", effect->footprint);
  put(item, "source", "%s", effect->source);
  for (i = 0; i < sizeof equations / sizeof *equations; i++)
    if (!strcmp(equations[i].key, effect->equation))
      put(item, "equation", "%s: %s", effect->equation, equations[i].words);
  put_sizes(t, found->effect, cJSON_AddArrayToObject(item, "sizes"));
  put_share(item, "explained", found->explained);
  put_number(item, "statistic", found->statistic, 3);
  put_number(item, "threshold", lab_chi2_threshold(t->story->result->level), 3);
  put_p(item, "p_value", found->p_value);
}

/* Why nothing was added, or nothing more. */
static void put_reasons(const telling *t, cJSON *list)
{
  const lab_loop_result *r = t->story->result;
  char statistic[LAB_SHOWN_TEXT], threshold[LAB_SHOWN_TEXT], where[LAB_WHERE_TEXT];
  int i;
  if (r->n_found == 0 && r->n_listed == 0 && r->trace.n > 0 && r->level > 0)
    say(list, "Of all effects %s comes nearest, with a statistic of %s; it would take %s to be more than chance.",
        effect_name(r->trace.candidate[0].effect), lab_shown_number(r->trace.candidate[0].statistic, 3, statistic),
        lab_shown_number(lab_chi2_threshold(r->level), 3, threshold));
  for (i = 0; i < r->n_listed; i++)
    say(list, "%s is more than chance, but would lower the error by less than --min-gain asks for, and was not added.",
        effect_name(r->listed[i]));
  if (r->has_small)
    say(list,
        "Something without a name, like %s (%s), is more than chance, but would lower the error by less than "
        "--min-gain asks for, and was not added.",
        lab_unlisted_what(&r->small), lab_unlisted_where(&r->small, where));
  if (r->verdict == LAB_VERDICT_UNDECIDED)
    say(list, "What is left is not noise, and no effect of the catalogue explains it. The figures below show when and "
              "where it arises.");
}

/* ---- The first look ---- */

static const char *size_heading(const lab_loop_result *r)
{
  if (r->n_found == 0)
    return "What is left";
  return r->verdict == LAB_VERDICT_UNDECIDED ? "What comes nearest, and how much" : "What is missing, and how much";
}

/* The size of each effect that was found, with its interval. */
static void put_main(const telling *t, cJSON *list)
{
  const lab_unknowns *u = t->story->completed;
  const lab_loop_result *r = t->story->result;
  int i;
  for (i = 0; i < r->n_found; i++) {
    const int j = r->found[i].effect < 0 ? -1 : lab_unknowns_find(u, r->found[i].param);
    pneu_param_info info;
    cJSON *item;
    if (j < 0)
      continue;
    pneu_param_describe(r->found[i].param, &info);
    item = append(list);
    put(item, "name", "%s", effect_name(r->found[i].effect));
    put(item, "meaning", "%s", info.meaning);
    put_quantity(item, "value", u->unknown[j].value, unit_of(&u->unknown[j]), digits_of(t, j));
    put(item, "unit", "%s", lab_shown_as(unit_of(&u->unknown[j])).unit);
    put_interval(t, j, item);
  }
}

static double in_noise(const lab_errors *errors)
{
  return sqrt(errors->chi2 / (double)errors->n);
}

/* What is left, and where something without a name acts. */
static void put_remainder(const telling *t, cJSON *list)
{
  const lab_loop_result *r = t->story->result;
  char where[LAB_WHERE_TEXT], number[LAB_SHOWN_TEXT];
  cJSON *item;
  int i;
  for (i = 0; i < r->n_found; i++)
    if (r->found[i].effect < 0) {
      const pneu_term *term = &t->story->completed->rig.term[r->found[i].term];
      item = append(list);
      put(item, "value", "%s", lab_unlisted_what(term));
      put(item, "words", "%s", lab_unlisted_where(term, where));
    }
  if (r->n_found > 0 || r->before.n == 0)
    return;
  item = append(list);
  put(item, "value", "%s × noise", lab_shown_number(in_noise(&r->before), 3, number));
  put(item, "words", "is the error of the declared model, fitted");
}

/* Channels whose residual is not white, the declared model's or the completed one's. */
static int count_coloured(const telling *t)
{
  int c, n = 0;
  for (c = 0; c < t->evidence->n_channels; c++)
    n += t->evidence->channel[c].whiteness[LAB_STAGE_AFTER].p_value < white_level;
  return n;
}

/* How much more than chance one thing is that was added. */
static void say_chance(const telling *t, const lab_found *found, cJSON *list)
{
  char p[LAB_SHOWN_TEXT], statistic[LAB_SHOWN_TEXT], threshold[LAB_SHOWN_TEXT];
  say(list, "%s is more than chance: p-value %s (score statistic %s, where %s would do).",
      found->effect < 0 ? "It" : effect_name(found->effect),
      lab_shown_p(found->effect < 0 ? lab_chi2_tail(found->statistic, found->degrees) : found->p_value, p),
      lab_shown_number(found->statistic, 3, statistic),
      lab_shown_number(lab_chi2_threshold(t->story->result->level), 3, threshold));
}

static int count_alike(const lab_loop_result *r)
{
  int i, n = 0;
  for (i = 0; i < r->n_found; i++)
    n += r->found[i].n_alike;
  return n;
}

/* The first effect that the log cannot tell from another, or the first that looks like it. */
static const char *alike_name(const lab_loop_result *r, int other)
{
  int i = 0;
  while (r->found[i].n_alike == 0)
    i++;
  return effect_name(other ? r->found[i].alike[0] : r->found[i].effect);
}

/* Whether anything else would do as well. */
static void say_alike(const lab_loop_result *r, cJSON *list)
{
  int i, named = 0;
  for (i = 0; i < r->n_found; i++) {
    const lab_found *found = &r->found[i];
    named += found->effect >= 0;
    if (found->n_alike > 0)
      say(list, "But the log cannot tell it apart: %s explains it as well as %s%s.", effect_name(found->alike[0]),
          effect_name(found->effect), found->n_alike > 1 ? ", and so do others, see below" : "");
  }
  if (named > 0 && count_alike(r) == 0)
    say(list, "No other effect of the catalogue explains the log as well.");
}

static void say_held_out(const lab_story *story, cJSON *list)
{
  char before[LAB_SHOWN_TEXT], after[LAB_SHOWN_TEXT];
  if (!story->has_holdout)
    say(list, "Not tried on a log that was held out.");
  else if (story->result->n_found > 0)
    say(list, "On a log that was not used for the fit, the error goes from %s to %s times the noise.",
        lab_shown_number(in_noise(&story->holdout_before), 3, before),
        lab_shown_number(in_noise(&story->holdout_after), 3, after));
  else
    say(list, "On a log that was not used for the fit, the error is %s times the noise.",
        lab_shown_number(in_noise(&story->holdout_before), 3, before));
}

static void put_sure(const telling *t, cJSON *list)
{
  const lab_loop_result *r = t->story->result;
  char statistic[LAB_SHOWN_TEXT], threshold[LAB_SHOWN_TEXT];
  const int coloured = count_coloured(t);
  int i;
  if (r->verdict == LAB_VERDICT_UNDECIDED)
    say(list, "Not sure enough for a name.");
  for (i = 0; i < r->n_found; i++)
    say_chance(t, &r->found[i], list);
  if (r->n_found == 0 && r->trace.n > 0 && r->level > 0)
    say(list, "%s comes nearest of all effects: statistic %s, where it would take %s.",
        effect_name(r->trace.candidate[0].effect), lab_shown_number(r->trace.candidate[0].statistic, 3, statistic),
        lab_shown_number(lab_chi2_threshold(r->level), 3, threshold));
  say_alike(r, list);
  say_held_out(t->story, list);
  if (coloured == 0)
    say(list, "What is left is white noise, on every channel.");
  else
    say(list, "What is left is not white noise on %d of %d channels.", coloured, t->evidence->n_channels);
}

static void put_todo(const telling *t, const cJSON *next, cJSON *list)
{
  const lab_loop_result *r = t->story->result;
  const cJSON *first = cJSON_GetArrayItem(next, 0);
  char where[LAB_WHERE_TEXT];
  int i;
  if (t->story->remarks && t->story->remarks->doubt)
    say(list, "Correct the log or the rig file first: no effect is named while they contradict each other.");
  for (i = 0; i < r->n_found && r->verdict != LAB_VERDICT_UNDECIDED; i++)
    if (r->found[i].effect >= 0)
      say(list, "See on the rig whether it is so: %s", pneu_effect_at(r->found[i].effect)->what);
    else
      say(list, "See what the rig has there: %s.",
          lab_unlisted_where(&t->story->completed->rig.term[r->found[i].term], where));
  if (r->verdict == LAB_VERDICT_NONE)
    say(list, "Nothing on the rig. The fitted model, model.cfg, can be used.");
  else if (r->n_found > 0 && r->verdict != LAB_VERDICT_UNDECIDED)
    say(list, "Where it is meant to be so, go on with model.cfg, which has it.");
  if (first && t->story->next.kind == LAB_ADVICE_TRIAL)
    say(list, "To know more, record: %s.", t->story->next.text);
  else if (count_alike(r) > 0)
    say(list, "Record what tells %s from %s: see What to record next.", alike_name(r, 0), alike_name(r, 1));
  else if (first && r->verdict != LAB_VERDICT_NONE)
    say(list, "%s", first->valuestring);
}

/* ---- Limits and advice ---- */

/* The remark of a fit, a clause an item; those on instants of the command are of no use to a reader. */
static void put_remarks(const char *remark, cJSON *list)
{
  while (*remark) {
    const char *end = strstr(remark, "; ");
    const int length = (int)(end ? end - remark : (long)strlen(remark));
    char clause[LAB_FIT_REMARK];
    snprintf(clause, sizeof clause, "%.*s", length, remark);
    if (!strstr(clause, "switch_"))
      say(list, "%s.", clause);
    remark += length + (end ? 2 : 0);
  }
}

static void put_rough(const telling *t, cJSON *list)
{
  const lab_unknowns *u = t->story->completed;
  const lab_fit_result *fit = &t->story->result->fit;
  int j, knots = 0;
  for (j = 0; j < u->n; j++) {
    const double half = 0.5 * (fit->high[j] - fit->low[j]);
    if (u->unknown[j].kind == LAB_UNKNOWN_SWITCH || fit->state[j] != LAB_FIT_FREE ||
        !(half > rough * fabs(u->unknown[j].value)))
      continue;
    if (u->unknown[j].kind == LAB_UNKNOWN_KNOT)
      knots++;
    else
      say(list, "%s is known only within %.2g %% either way.", u->unknown[j].name,
          100 * half / fabs(u->unknown[j].value));
  }
  if (knots > 0)
    say(list,
        "%d values of the free term are known only within more than %g %% of themselves: those near 0, and those where "
        "the model hardly ever is.",
        knots, 100 * rough);
}

/* Effects none of whose candidates leaves a trace. */
static void put_invisible(const lab_trace_result *trace, cJSON *list)
{
  unsigned char tried[PNEU_EFFECT_COUNT + 1] = {0}, visible[PNEU_EFFECT_COUNT + 1] = {0};
  char names[512] = "";
  int i;
  for (i = 0; i < trace->n; i++) {
    tried[trace->candidate[i].effect] = 1;
    visible[trace->candidate[i].effect] |= trace->candidate[i].visible > 0;
  }
  for (i = 0; i < PNEU_EFFECT_COUNT; i++) {
    const size_t used = strlen(names);
    if (tried[i] && !visible[i])
      snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "", effect_name(i));
  }
  if (*names)
    say(list, "With the declared laws this log could not show: %s.", names);
}

static void put_limits(const telling *t, cJSON *list)
{
  const lab_loop_result *r = t->story->result;
  int i, k;
  for (i = 0; i < r->n_found; i++)
    for (k = 0; k < r->found[i].n_alike; k++)
      say(list, "%s from %s: both explain it equally well.", effect_name(r->found[i].effect),
          effect_name(r->found[i].alike[k]));
  for (i = 0; t->story->remarks && i < t->story->remarks->n; i++)
    say(list, "%s", t->story->remarks->text[i]);
  put_rough(t, list);
  put_remarks(r->fit.remark, list);
  put_invisible(&r->trace, list);
  if (cJSON_GetArraySize(list) == 0)
    say(list, "Nothing to report: every parameter is determined, and no two effects are confused.");
}

static void put_next(const telling *t, cJSON *list)
{
  const lab_loop_result *r = t->story->result;
  int i, k;
  for (i = 0; i < r->n_found; i++)
    for (k = 0; k < r->found[i].n_alike; k++)
      if (k == 0 && t->story->separate[i].kind != LAB_ADVICE_NONE)
        say(list, "To tell %s from %s: %s. %s", effect_name(r->found[i].effect), effect_name(r->found[i].alike[k]),
            t->story->separate[i].text, t->story->separate[i].why);
      else
        say(list, "To tell %s from %s, a test in which one of them shows alone. %s: %s. %s: %s.",
            effect_name(r->found[i].effect), effect_name(r->found[i].alike[k]), effect_name(r->found[i].effect),
            pneu_effect_at(r->found[i].effect)->footprint, effect_name(r->found[i].alike[k]),
            pneu_effect_at(r->found[i].alike[k])->footprint);
  if (t->story->next.kind == LAB_ADVICE_TRIAL)
    say(list, "%s. %s", t->story->next.text, t->story->next.why);
  if (r->verdict == LAB_VERDICT_UNDECIDED || r->verdict == LAB_VERDICT_UNLISTED)
    say(list, "Tests that part the equations: hold with both orifices shut at several positions (mass), slow full "
              "strokes both ways (forces), rest on either stop (sensors).");
  if (!t->story->has_holdout)
    say(list, "Another log with other commands, given by --holdout: the only test that a fit cannot flatter.");
  if (cJSON_GetArraySize(list) == 0)
    say(list, "Nothing is needed to settle this verdict.");
}

/* ---- Parameters ---- */

static void put_parameter(const telling *t, int j, cJSON *list)
{
  const lab_unknown *x = &t->story->completed->unknown[j];
  const lab_shown shown = lab_shown_as(unit_of(x));
  pneu_params declared = t->story->rig->params;
  pneu_param_info info = {0};
  cJSON *item = append(list);
  put(item, "name", "%s", x->name);
  put(item, "unit", "%s", *shown.unit ? shown.unit : "1");
  put_number(item, "value", shown.scale * x->value, digits_of(t, j));
  put_interval(t, j, item);
  if (x->kind != LAB_UNKNOWN_PARAM)
    return;
  if (x->index == LAB_FIT_ORIFICE_AREA) {
    put(item, "declared", "1");
    put(item, "meaning", "factor on fill_area and vent_area");
  } else if (pneu_param_describe(x->index, &info) == PNEU_OK) {
    put(item, "meaning", "%s", info.meaning);
    if (x->index < PNEU_PARAM_BASE_COUNT || *pneu_param_at(&declared, x->index) != info.neutral)
      put_number(item, "declared", shown.scale * (double)*pneu_param_at(&declared, x->index), 4);
    else
      put(item, "declared", "absent");
  }
}

static void put_parameters(const telling *t, cJSON *page)
{
  const lab_unknowns *u = t->story->completed;
  cJSON *list = cJSON_AddArrayToObject(page, "parameters"), *knots = cJSON_AddArrayToObject(page, "knots");
  int j, switches = 0;
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].kind == LAB_UNKNOWN_SWITCH)
      switches++;
    else
      put_parameter(t, j, u->unknown[j].kind == LAB_UNKNOWN_KNOT ? knots : list);
  put(page, "has_knots", "%s", cJSON_GetArraySize(knots) ? "yes" : "");
  if (switches > 0) {
    list = cJSON_AddArrayToObject(page, "switches");
    say(list, "Fitted as well: the instants of %d changes of command, each between the two rows that bracket it.",
        switches);
  }
}

/* ---- Whiteness and candidates ---- */

static void put_whiteness(const telling *t, cJSON *list)
{
  int c;
  for (c = 0; c < t->evidence->n_channels; c++) {
    const lab_evidence_channel *mine = &t->evidence->channel[c];
    const lab_whiteness *after = &mine->whiteness[LAB_STAGE_AFTER];
    const int white = after->p_value >= white_level;
    cJSON *item = append(list);
    put(item, "channel", "%s %s", lab_channels[mine->channel].quantity, lab_channels[mine->channel].key);
    put(item, "before", "%.3f", mine->whiteness[LAB_STAGE_BEFORE].correlation[1]);
    if (has_completed(t))
      put(item, "after", "%.3f", after->correlation[1]);
    put_number(item, "q", after->statistic, 3);
    put(item, "lags", "%d", after->degrees);
    put_p(item, "p_value", after->p_value);
    put(item, "mood", "%s", white ? "good" : "bad");
    put(item, "words", "%s", isnan(after->p_value) ? "too few values" : white ? "white" : "not white");
  }
}

static void put_candidates(const telling *t, cJSON *page)
{
  const lab_trace_result *trace = &t->story->result->trace;
  cJSON *list = cJSON_AddArrayToObject(page, "candidates");
  char threshold[LAB_SHOWN_TEXT];
  int i;
  for (i = 0; i < trace->n; i++) {
    const lab_candidate *c = &trace->candidate[i];
    pneu_param_info info;
    cJSON *item = append(list);
    pneu_param_describe(c->param, &info);
    put(item, "effect", "%s", effect_name(c->effect));
    put(item, "parameter", "%s", info.name);
    put_number(item, "statistic", c->statistic, 3);
    put_p(item, "p_value", c->p_value);
    put_share(item, "explained", c->explained);
    put_number(item, "visible", c->visible, 2);
  }
  put(page, "tried", "%d effects and parameters, %d slopes in all; the threshold is %s", trace->n, trace->tests,
      t->story->result->level > 0 ? lab_shown_number(lab_chi2_threshold(t->story->result->level), 3, threshold) : "-");
}

/* ---- Figures of merit ---- */

/* A figure, as measured and as the model has it. */
static void put_figure(const telling *t, int i, cJSON *list)
{
  const lab_metric *const both[] = {&t->story->measured->metric[i], &t->story->predicted->metric[i]};
  const lab_metric_info *info = &lab_metric_infos[i];
  const char *unit = strcmp(info->unit, "1") ? info->unit : "";
  cJSON *row, *cells;
  char value[LAB_METRIC_SHOWN];
  int k;
  if (isnan(both[0]->value) && isnan(both[1]->value))
    return;
  row = append(list);
  put(row, "meaning", "%s", info->meaning);
  put(row, "standard", "%s", info->standard);
  cells = cJSON_AddArrayToObject(row, "cells");
  for (k = 0; k < 2; k++) {
    cJSON *cell = append(cells);
    put(cell, "value", "%s%s%s", lab_metric_value(both[k], value), *unit ? " " : "", unit);
    if (isfinite(both[k]->value) && !both[k]->at_most)
      put_number(cell, "uncertainty", both[k]->uncertainty, 2);
  }
}

static void put_merit(const telling *t, cJSON *page)
{
  const lab_metrics *measured = t->story->measured;
  cJSON *list, *missing;
  int i;
  if (!measured)
    return;
  put(page, "merit_model", "%s", has_completed(t) ? "completed model" : "declared model, fitted");
  put(page, "step_signal", "%s", lab_metrics_step_signal(measured->command));
  put(page, "static_signal", "%s", lab_metrics_static_signal(measured->command));
  list = cJSON_AddArrayToObject(page, "merit");
  missing = cJSON_AddArrayToObject(page, "without_merit");
  for (i = 0; i < LAB_METRIC_COUNT; i++) {
    put_figure(t, i, list);
    if (isnan(measured->metric[i].value)) {
      cJSON *item = append(missing);
      put(item, "figure", "%s", lab_metric_infos[i].key);
      put(item, "reason", "%s", measured->metric[i].text);
    }
  }
}

/* ---- Figures ---- */

/* What the keys of curves mean. */
static const struct {
  const char *key, *label;
  const char *brief; /* beside a value */
  int is_switch;     /* whether a curve of it can be switched off */
} curves[] = {{"measured", "measured", "measured", 1},
              {"before", "declared model, fitted", "declared", 1},
              {"after", "completed model", "completed", 1},
              {"band", "99 % of white noise", "99 % of noise", 1},
              {"term", "fitted term", "", 0},
              {"command", "command", "", 0}};
enum { CURVES = sizeof curves / sizeof *curves };

/* The switches of a figure: those of its keys that there is something of. */
static void put_keys(const telling *t, const lab_figure *figure, cJSON *list)
{
  size_t i;
  for (i = 0; i < CURVES; i++) {
    cJSON *item;
    if (!curves[i].is_switch || !strstr(figure->keys, curves[i].key) ||
        (!strcmp(curves[i].key, "after") && !has_completed(t)))
      continue;
    item = append(list);
    put(item, "key", "%s", curves[i].key);
    put(item, "label", "%s", curves[i].label);
  }
}

/* A figure as HTML, to be freed; NULL without memory. */
static char *figure_html(const telling *t, const lab_figure *figure, const char *template)
{
  char *svg = lab_svg_inline(figure->svg, figure->name, figure->alt, figure->head), *text = NULL;
  size_t size;
  FILE *file = svg ? open_memstream(&text, &size) : NULL;
  cJSON *values = cJSON_CreateObject();
  lab_error error;
  int failed = !file;
  put(values, "name", "%s", figure->name);
  put(values, "title", "%s", figure->title);
  put(values, "subtitle", "%s", figure->subtitle);
  put(values, "reading", "%s", figure->reading);
  put_keys(t, figure, cJSON_AddArrayToObject(values, "keys"));
  if (file) {
    cJSON_AddItemToObject(values, "svg", cJSON_CreateStringReference(svg));
    failed = lab_template_write(file, template, values, &error) != LAB_OK;
    failed |= fclose(file) != 0;
  }
  cJSON_Delete(values);
  free(svg);
  if (failed) {
    free(text);
    text = NULL;
  }
  return text;
}

/* Each figure under its name. Those whose name is that of a list, too, have _figure after it. */
static int put_figures(const telling *t, cJSON *page)
{
  char *template = lab_page_text(LAB_PAGE_FIGURE);
  int i, done = template != NULL;
  for (i = 0; i < t->figures->n && done; i++) {
    const lab_figure *figure = &t->figures->figure[i];
    char name[64], *html = figure_html(t, figure, template);
    snprintf(name, sizeof name, "%s%s", figure->name, cJSON_GetObjectItem(page, figure->name) ? "_figure" : "");
    if (html)
      cJSON_AddStringToObject(page, name, html);
    done = html != NULL;
    free(html);
  }
  free(template);
  return done;
}

/* What the script reads curves from, as JSON.  Returns: 0 without memory */
static int put_readings(const telling *t, cJSON *page)
{
  cJSON *labels;
  char *text;
  size_t i;
  if (t->figures->n == 0)
    return 1;
  labels = cJSON_CreateObject();
  for (i = 0; i < CURVES; i++)
    if (has_completed(t) || strcmp(curves[i].key, "after") != 0)
      cJSON_AddStringToObject(labels, curves[i].key, curves[i].brief);
  cJSON_DeleteItemFromObject(t->figures->readings, "labels");
  cJSON_AddItemToObject(t->figures->readings, "labels", labels);
  text = cJSON_PrintUnformatted(t->figures->readings);
  if (text)
    cJSON_AddStringToObject(page, "readings", text);
  cJSON_free(text);
  return text != NULL;
}

static int put_text(cJSON *page, const char *name, char *text)
{
  if (text)
    cJSON_AddStringToObject(page, name, text);
  free(text);
  return text != NULL;
}

/* ---- The page ---- */

static cJSON *values_of(const telling *t)
{
  cJSON *page = cJSON_CreateObject(), *found = cJSON_AddArrayToObject(page, "found"), *next;
  int i;
  put_head(t, page);
  put_logs(t, page);
  put_errors(t, page);
  put(page, "size_heading", "%s", size_heading(t->story->result));
  put_main(t, cJSON_AddArrayToObject(page, "main"));
  put_remainder(t, cJSON_AddArrayToObject(page, "remainder"));
  put_sure(t, cJSON_AddArrayToObject(page, "sure"));
  for (i = 0; i < t->story->result->n_found; i++)
    (t->story->result->found[i].effect < 0 ? put_unlisted : put_found)(t, &t->story->result->found[i], found);
  put_reasons(t, cJSON_AddArrayToObject(page, "reasons"));
  put_limits(t, cJSON_AddArrayToObject(page, "limits"));
  put_next(t, next = cJSON_AddArrayToObject(page, "next"));
  put_todo(t, next, cJSON_AddArrayToObject(page, "todo"));
  put_parameters(t, page);
  put_whiteness(t, cJSON_AddArrayToObject(page, "whiteness"));
  put_candidates(t, page);
  put_merit(t, page);
  if (put_figures(t, page) && put_readings(t, page) &&
      put_text(page, "style", lab_page_texts(LAB_PAGE_STYLE, LAB_PAGE_REPORT_STYLE)) &&
      put_text(page, "script", lab_page_text(LAB_PAGE_REPORT_SCRIPT)))
    return page;
  cJSON_Delete(page);
  return NULL;
}

static int write_page(const cJSON *page, const char *text, const char *folder, lab_error *error)
{
  char path[LAB_PATH_TEXT + 32];
  lab_outfile out;
  snprintf(path, sizeof path, "%s/report.html", folder);
  if (lab_out_open(&out, path, error))
    return error->status;
  if (lab_template_write(out.file, text, page, error)) {
    lab_out_abandon(&out);
    return error->status;
  }
  return lab_out_close(&out, error);
}

int lab_report_html(const lab_story *story, const lab_evidence *evidence, const lab_figures *figures,
                    const char *folder, lab_error *error)
{
  const telling t = {story, evidence, figures};
  cJSON *page = values_of(&t);
  char *text = lab_page_text(LAB_PAGE_REPORT);
  const int status = page && text ? write_page(page, text, folder, error) : lab_fail_memory(error, "report.html");
  cJSON_Delete(page);
  free(text);
  return status;
}

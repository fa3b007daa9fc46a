/* What the page says in words: verdict, how certain it is, what to do, why, what has changed, what stays open. */
#include <math.h>
#include <string.h>

#include "../base/format.h"
#include "../base/names.h"
#include "../base/quantile.h"
#include "../base/text.h"
#include "../trace/freeterms.h"
#include "page_private.h"

static const double rough = 0.1; /* half an interval over the value, from which on it is worth a word */

static const char *name_of(int effect)
{
  return pneu_effect_at(effect)->name;
}

/* Where something without a name acts.  Out: where  Returns: where */
static const char *where_of(const lab_report *report, const lab_found *found, char where[LAB_WHERE_TEXT])
{
  return lab_free_term_where(lab_report_term(report, found), where);
}

/* ---- Head ---- */

static void put_verdict(const lab_sources *t, cJSON *page)
{
  static const char *const badges[] = {"nothing missing", "effect found", "not in the catalogue", "undecided"};
  const lab_report *report = t->report;
  const int verdict = report->result->verdict;
  const char *badge = verdict == LAB_VERDICT_NONE && lab_report_count_told(report) ? "values are off" : badges[verdict];
  char text[LAB_SENTENCE_TEXT];
  lab_report_headline(report, text);
  lab_json_put(page, "headline", "%s", text);
  lab_page_put_coded(page, "coded_headline", text);
  lab_report_evidence(report, text);
  lab_json_put(page, "evidence", "%s", text);
  lab_json_put(page, "verdict", "%s", lab_verdict_text(verdict));
  lab_json_put(page, "badge", "%s", badge);
  lab_json_put(page, "rig", "%s", report->rig->name);
  lab_json_put(page, "rig_file", "%s", lab_file_name(report->rig->file));
  lab_json_put(page, "gas", "%s", pneu_gas_key(report->rig->laws.gas));
  lab_json_put(page, "flow", "%s", pneu_flow_key(report->rig->laws.flow));
  lab_json_put(page, "version", "%s", PNEU_VERSION);
  lab_json_put(page, "completed", "%s", lab_report_is_completed(t->report) ? "yes" : "");
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
    lab_json_put(page, "rows", "%zu rows in %d runs", t->figures->table.n, u->n_runs);
  else
    lab_json_put(page, "rows", "%zu rows", t->figures->table.n);
  lab_json_put(page, "logs", "%s", names);
}

/* ---- Since the baseline ---- */

static void put_change(const lab_change *change, cJSON *list)
{
  const lab_format shown = lab_format_as(lab_change_unit(change));
  char name[LAB_PARAM_NAME_TEXT];
  cJSON *item = lab_json_append(list);
  lab_json_put(item, "name", "%s", lab_change_name(change->param, name));
  lab_json_put(item, "unit", "%s", *shown.unit ? shown.unit : "1");
  lab_json_put(item, "then", "%s", LAB_NUMBER(shown.scale * change->then, 4));
  lab_json_put(item, "now", "%s", LAB_NUMBER(shown.scale * change->now, 4));
  lab_json_put(item, "interval", "%s .. %s", LAB_NUMBER(shown.scale * change->low, 4),
               LAB_NUMBER(shown.scale * change->high, 4));
  lab_json_put(item, "p_value", "%s", LAB_P_VALUE(change->p_value));
}

/* "chamber_leak acts since 14.2 s (95 %: 14.1 .. 14.3)." */
static void say_when(const char *name, const lab_onset *onset, const char *word, cJSON *list)
{
  if (onset->known)
    lab_json_say(list, "%s acts %s %s s (95 %%: %s .. %s).", name, word, LAB_NUMBER(onset->t, 5),
                 LAB_NUMBER(onset->low, 5), LAB_NUMBER(onset->high, 5));
}

/* "The logs are explained by laminar_leak, porous_leak as well as by chamber_leak.", and when it acts */
static void say_more(const lab_change *change, cJSON *list)
{
  char name[LAB_PARAM_NAME_TEXT], alike[LAB_PARAM_NAME_TEXT], names[LAB_CHANGE_LEADERS * LAB_PARAM_NAME_TEXT] = "";
  int i;
  lab_change_name(change->param, name);
  for (i = 0; i < change->n_alike; i++)
    lab_append(names, sizeof names, "%s%s", i ? ", " : "", lab_change_name(change->alike[i], alike));
  if (change->n_alike)
    lab_json_say(list, "The logs are explained by %s as well as by %s.", names, name);
  if (change->low <= change->then && change->then <= change->high)
    lab_json_say(list,
                 "The interval of %s reaches the value then: it is that of now alone, with what is not known of then "
                 "and what the model leaves. The p-value is of the difference.",
                 name);
  say_when(name, &change->begin, "since", list);
  say_when(name, &change->end, "until", list);
}

static void put_changes(const lab_changes *changes, cJSON *page)
{
  cJSON *list, *remarks;
  int i;
  lab_json_put(page, "has_baseline", "%s", changes ? "yes" : "");
  if (!changes)
    return;
  lab_json_put(page, "has_changes", "%s", changes->n ? "yes" : "");
  list = cJSON_AddArrayToObject(page, "changes");
  remarks = cJSON_AddArrayToObject(page, "change_remarks");
  if (changes->condition == LAB_SINCE_UNCHANGED && changes->tests)
    lab_json_say(remarks, "Nothing has changed: %d differences were tried, and none passes.", changes->tests);
  else if (changes->condition == LAB_SINCE_UNCHANGED)
    lab_json_say(
        remarks,
        "The model explains neither side, but it leaves no more of the new log, %.2f times what counts as noise, "
        "than of the baseline, %.2f times: no difference was tried.",
        changes->now, changes->then);
  for (i = 0; i < changes->n; i++) {
    put_change(&changes->change[i], list);
    say_more(&changes->change[i], remarks);
  }
  if (*changes->why)
    lab_json_say(remarks, "%s%s.",
                 changes->condition == LAB_SINCE_CANNOT_TELL ? "It cannot be told: " : "There is more: ", changes->why);
  if (changes->tests)
    lab_json_say(remarks, "What differs from day to day on a sound rig does not count: supply, weather, zeros and "
                          "gains of sensors, a little of friction and spring.");
}

/* ---- Why ---- */

/* How much it explains, and how far that is from chance. */
static void put_strength(const lab_sources *t, const lab_found *found, cJSON *item)
{
  char sentence[LAB_FOUND_SENTENCE];
  lab_json_put(item, "sentence", "%s", lab_report_found_sentence(t->report, found, sentence));
  lab_page_put_share(item, "explained", found->explained);
  lab_json_put(item, "statistic", "%s", LAB_NUMBER(found->statistic, 3));
  if (found->effect >= 0) /* that of a free term depends on its values */
    lab_json_put(item, "threshold", "%s", LAB_NUMBER(lab_chi2_threshold(t->report->result->level), 3));
  lab_json_put(item, "p_value", "%s", LAB_P_VALUE(lab_report_chance(t->report, found)));
}

static void put_unlisted(const lab_sources *t, const lab_found *found, cJSON *item)
{
  char where[LAB_WHERE_TEXT];
  lab_json_put(item, "name", "Not in the catalogue");
  lab_json_put(item, "footprint", "%s", where_of(t->report, found, where));
  lab_json_put(item, "source", "A free term was added; its values are in model.cfg.");
  lab_json_put(item, "equation", "%s", lab_free_term_equation(lab_report_term(t->report, found)));
  cJSON_AddArrayToObject(item, "sizes");
}

static void put_effect(const lab_sources *t, const lab_found *found, cJSON *item)
{
  static const struct {
    const char *key, *words;
  } equations[] = {{"mass", "balance of mass in the chamber"},
                   {"energy", "balance of energy in the chamber"},
                   {"force", "balance of forces on the stem"},
                   {"command", "from the command to the opening"},
                   {"sensor", "reading of a sensor"}};
  const pneu_effect *effect = pneu_effect_at(found->effect);
  cJSON *sizes = cJSON_AddArrayToObject(item, "sizes");
  const int i = lab_name_index(effect->equation, equations, sizeof equations / sizeof *equations, sizeof *equations);
  int k, count, first = pneu_effect_params(found->effect, &count);
  lab_json_put(item, "code", "%s", effect->name);
  lab_json_put(item, "footprint", "%s", effect->footprint);
  lab_json_put(item, "source", "%s", effect->source);
  if (i >= 0)
    lab_json_put(item, "equation", "%s: %s", effect->equation, equations[i].words);
  for (k = first; k < first + count; k++)
    lab_page_put_size(t, k, sizes);
}

/* What was found and how sure that is; why nothing was added, or nothing more. */
static void put_why(const lab_sources *t, cJSON *page)
{
  const lab_search_result *r = t->report->result;
  cJSON *found = cJSON_AddArrayToObject(page, "found"), *reasons = cJSON_AddArrayToObject(page, "reasons");
  char where[LAB_WHERE_TEXT];
  int i;
  for (i = 0; i < r->n_found; i++) {
    cJSON *item = lab_json_append(found);
    (r->found[i].effect < 0 ? put_unlisted : put_effect)(t, &r->found[i], item);
    put_strength(t, &r->found[i], item);
  }
  if (r->n_found == 0 && r->n_listed == 0 && r->scores.n > 0 && r->level > 0 &&
      r->scores.of[0].statistic < lab_chi2_threshold(r->level))
    lab_json_say(reasons, "The effect with the highest score is %s: %s. Above %s it would be significant.",
                 name_of(r->scores.of[0].effect), LAB_NUMBER(r->scores.of[0].statistic, 3),
                 LAB_NUMBER(lab_chi2_threshold(r->level), 3));
  for (i = 0; i < r->n_listed; i++)
    lab_json_say(reasons,
                 "The effect %s shows, but too little to be worth adding: it would lower the error by less than "
                 "--min-gain, or the "
                 "log can as well be without it.",
                 name_of(r->listed[i]));
  if (r->has_small)
    lab_json_say(reasons,
                 "A free term that acts like %s (%s) shows, but too little to be worth adding: it would lower "
                 "the error by less than --min-gain.",
                 lab_free_term_what(&r->small), lab_free_term_where(&r->small, where));
  if (r->is_far)
    lab_json_say(reasons, "The residual is about as large as noise, but only with several values far off their sheet.");
  else if (lab_report_is_ambiguous(r))
    lab_json_say(reasons, "What is left is about as large as noise, and other candidates may leave no more.");
  else if (r->verdict == LAB_VERDICT_UNDECIDED && !lab_report_is_unfinished(r))
    lab_json_say(reasons, "The residual is not noise, and nothing that was tried explains it. The figures below show "
                          "when and where it arises.");
}

/* ---- What is missing, and how large it is ---- */

/* The size of each effect that was found, with its interval; where something without a name acts; or what is left. */
static void put_size(const lab_sources *t, cJSON *page)
{
  const lab_search_result *r = t->report->result;
  cJSON *effects = cJSON_AddArrayToObject(page, "main"), *others = cJSON_AddArrayToObject(page, "remainder"), *item;
  char where[LAB_WHERE_TEXT];
  int i;
  lab_json_put(page, "size_heading",
               r->n_found == 0                       ? "Residual"
               : r->verdict == LAB_VERDICT_UNDECIDED ? "Best candidate, and its size"
                                                     : "What the model lacks, and its size");
  for (i = 0; i < r->n_found; i++)
    if (r->found[i].effect < 0) {
      item = lab_json_append(others);
      lab_json_put(item, "value", "%s", lab_free_term_what(lab_report_term(t->report, &r->found[i])));
      lab_json_put(item, "words", "%s", where_of(t->report, &r->found[i], where));
    } else if ((item = lab_page_put_size(t, r->found[i].param, effects)))
      lab_json_put(item, "name", "%s", name_of(r->found[i].effect));
  if (r->n_found > 0 || r->before.n == 0)
    return;
  item = lab_json_append(others);
  lab_json_put(item, "value", "%s × noise", LAB_NUMBER(lab_report_in_noise(&r->after), 3));
  lab_json_put(item, "words",
               lab_report_count_told(t->report) ? "is the error of the model with the values found"
                                                : "is the error of the declared model, fitted");
}

/* ---- How certain, and what to do ---- */

/* How much more than chance one thing is that was added. */
static void say_chance(const lab_sources *t, const lab_found *found, cJSON *list)
{
  const char *p = LAB_P_VALUE(lab_report_chance(t->report, found)), *statistic = LAB_NUMBER(found->statistic, 3);
  if (found->effect < 0)
    lab_json_say(list, "The free term is significant: p-value %s (score %s over %d values).", p, statistic,
                 found->degrees);
  else
    lab_json_say(list, "The effect %s is significant: p-value %s (score %s, threshold %s).", name_of(found->effect), p,
                 statistic, LAB_NUMBER(lab_chi2_threshold(t->report->result->level), 3));
}

/* When it began, of whatever did not act from the start. */
static void say_onsets(const lab_sources *t, cJSON *list)
{
  const lab_rig *rig = &t->report->completed->rig;
  char name[LAB_PARAM_NAME_TEXT], since[LAB_SINCE_TEXT];
  int k;
  for (k = 0; k < rig->n_onsets; k++) {
    const lab_onset *onset = lab_report_onset(t->report, rig->onset[k].param);
    if (onset)
      lab_json_say(list, "The value of %s is another one%s; in brackets the interval of 95 %%.",
                   lab_fit_name(rig->onset[k].param, name), lab_report_since(onset, since));
  }
}

/* The first that was found and that the log cannot tell from others; NULL: there is none. */
static const lab_found *first_alike(const lab_search_result *r)
{
  int i;
  for (i = 0; i < r->n_found; i++)
    if (r->found[i].n_alike > 0)
      return &r->found[i];
  return NULL;
}

/* Whether another model that was tried comes as near as the best one by odds; alike ones are told by name. */
static int has_rival(const lab_search_result *r)
{
  const lab_path_model *best = &r->path[r->n_path - 1];
  int i, any = 0;
  for (i = 0; i < r->n_steps; i++)
    any |= strcmp(r->step[i].name, best->name) != 0 && r->step[i].bic < best->bic + lab_constant(LAB_ALIKE_BIC);
  return any;
}

/* Whether anything else would do as well. */
static void say_alike(const lab_search_result *r, cJSON *list)
{
  int i, named = 0;
  for (i = 0; i < r->n_found; i++) {
    const lab_found *found = &r->found[i];
    named += found->effect >= 0;
    if (found->n_alike > 0)
      lab_json_say(list, "The log cannot tell %s from %s: each explains it equally well%s.", name_of(found->effect),
                   name_of(found->alike[0]), found->n_alike > 1 ? ", and so do others, see below" : "");
  }
  if (named > 0 && !first_alike(r) && !has_rival(r))
    lab_json_say(list, "No other effect of the catalogue explains the log as well.");
}

static void say_held_out(const lab_report *report, cJSON *list)
{
  if (!report->has_holdout)
    lab_json_say(list, "The model was not tested on a held-out log.");
  else if (report->result->n_found > 0)
    lab_json_say(list, "On a log that was not used for the fit, the error goes from %s to %s times the noise.",
                 LAB_NUMBER(lab_report_in_noise(&report->holdout_before), 3),
                 LAB_NUMBER(lab_report_in_noise(&report->holdout_after), 3));
  else
    lab_json_say(list,
                 "On a log that was not used for the fit, the error is %s times the noise. Nothing is fitted there, "
                 "not even when a command came between two rows.",
                 LAB_NUMBER(lab_report_in_noise(&report->holdout_before), 3));
}

/* Whether what is left is noise: as the verdict has it. */
static void say_left(const lab_sources *t, cJSON *list)
{
  const lab_search_result *r = t->report->result;
  const lab_residual_stats *left = r->left[LAB_STAGE_AFTER];
  const int coloured = lab_residual_stats_coloured(left);
  if (r->window > 0 && r->n_found > 0)
    lab_json_say(list,
                 "The stem sticks and slips, and no model predicts the instants of single slips: the log was compared "
                 "in windows of %zu rows, and the error row by row need not fall.",
                 r->window);
  else if (lab_report_wanders(r))
    lab_json_say(list, "The residual is larger than the declared noise, as much at rest as in motion: a sensor's.");
  else if (coloured > 0 && r->window == 0 && (r->verdict == LAB_VERDICT_NONE || r->verdict == LAB_VERDICT_EFFECT))
    lab_json_say(list, "The residual is no larger than noise, but not white on %d of %d channels.", coloured,
                 t->figures->table.n_channels);
  else if (coloured > 0)
    lab_json_say(list, "The residual is not white on %d of %d channels.", coloured, t->figures->table.n_channels);
  else if (!lab_residual_stats_white(left))
    lab_json_say(list, "There are too few values to tell whether the residual is white.");
  else if (r->verdict == LAB_VERDICT_UNDECIDED && !lab_report_doubt(t->report) && !lab_report_is_unfinished(r) &&
           !lab_report_is_ambiguous(r) && !r->is_far)
    lab_json_say(list, "The residual is white on every channel, but its size differs from the declared noise.");
  else
    lab_json_say(list, "The residual is white on every channel.");
}

/* Of an undecided verdict: what is certain, and what is not. */
static void say_undecided(const lab_sources *t, cJSON *list)
{
  const lab_search_result *r = t->report->result;
  const lab_residual_stats *left = r->left[LAB_STAGE_AFTER];
  const char *why =
      r->cut_short ? "There was no time to find which effect it is." : "Which effect it is, the log does not tell.";
  double p = 1;
  int c;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    if (left[c].whiteness.n > 0)
      p = fmin(p, left[c].whiteness.p_value);
  if (lab_report_doubt(t->report))
    lab_json_say(list, "No effect is named, because the log and the rig file contradict each other.");
  else if (lab_report_is_unfinished(r))
    lab_json_say(list, "The residual may be noise, but the search was ended before everything was tried.");
  else if (r->is_far)
    lab_json_say(list, "With these values what is left is about as much as noise, but a rig is seldom off its sheet in "
                       "several of them. Whether something else is missing, the log does not tell.");
  else if (lab_report_is_ambiguous(r))
    lab_json_say(list,
                 "Something is missing: what the candidates leave is about as much as noise, and others may leave no "
                 "more. Which it is, the log does not tell.");
  else if (lab_residual_stats_coloured(left) > 0)
    lab_json_say(list, "Something is missing: the residual is not white, p-value %s. %s", LAB_P_VALUE(p), why);
  else
    lab_json_say(list, "Something is missing: the residual is %s times the noise. %s",
                 LAB_NUMBER(lab_report_in_noise(&r->after), 3), why);
}

static void put_sure(const lab_sources *t, cJSON *page)
{
  cJSON *list = cJSON_AddArrayToObject(page, "sure");
  const lab_search_result *r = t->report->result;
  int i;
  if (r->verdict == LAB_VERDICT_UNDECIDED)
    say_undecided(t, list);
  for (i = 0; i < r->n_found; i++)
    say_chance(t, &r->found[i], list);
  if (r->n_found == 0 && r->scores.n > 0 && r->level > 0)
    lab_json_say(list, "The effect %s has the highest score: %s; the threshold is %s.", name_of(r->scores.of[0].effect),
                 LAB_NUMBER(r->scores.of[0].statistic, 3), LAB_NUMBER(lab_chi2_threshold(r->level), 3));
  say_onsets(t, list);
  say_alike(r, list);
  say_held_out(t->report, list);
  say_left(t, list);
}

/* What to look at where an effect was found, or what it does. */
static const char *inspect(const lab_report *report, const lab_found *found, char sentence[LAB_FOUND_SENTENCE])
{
  static const struct {
    const char *effect, *text;
  } table[] = {
#define X(effect, text) {#effect, text},
#include "inspect.def"
#undef X
  };
  const int i = found->effect < 0
                    ? -1
                    : lab_name_index(name_of(found->effect), table, sizeof table / sizeof *table, sizeof *table);
  return i >= 0 ? table[i].text : lab_report_found_sentence(report, found, sentence);
}

/* Each declared value that is told to be off. */
static void say_values_to_check(const lab_report *report, cJSON *list)
{
  const lab_deviations *all = &report->deviations;
  char text[LAB_SENTENCE_TEXT];
  int i;
  for (i = 0; i < all->n; i++)
    if (lab_report_is_told(report, &all->of[i])) {
      lab_report_deviation(report, &all->of[i], text);
      lab_json_say(list, "Check on the rig, or correct in the rig file: %s.", text);
    }
}

/* In:  next  what to record, of which the first is named */
static void put_todo(const lab_sources *t, const cJSON *next, cJSON *page)
{
  cJSON *list = cJSON_AddArrayToObject(page, "todo");
  const lab_search_result *r = t->report->result;
  const lab_found *alike = first_alike(r);
  const cJSON *first = cJSON_GetArrayItem(next, 0);
  char where[LAB_WHERE_TEXT], sentence[LAB_FOUND_SENTENCE], name[LAB_PARAM_NAME_TEXT];
  int i;
  if (lab_report_doubt(t->report))
    lab_json_say(list, "Correct the log or the rig file first: no effect is named while they contradict each other.");
  for (i = 0; i < r->n_found && r->verdict != LAB_VERDICT_UNDECIDED; i++)
    if (r->found[i].effect >= 0)
      lab_json_say(list, "%s", inspect(t->report, &r->found[i], sentence));
    else
      lab_json_say(list, "Check what acts there on the rig: %s.", where_of(t->report, &r->found[i], where));
  say_values_to_check(t->report, list);
  if (r->verdict == LAB_VERDICT_NONE && cJSON_GetArraySize(list) == 0)
    lab_json_say(list, "Nothing on the rig. The fitted model, model.cfg, can be used.");
  else if (r->verdict != LAB_VERDICT_UNDECIDED)
    lab_json_say(list, "To predict the rig as it is now, use model.cfg, which has all of this.");
  if (t->report->next.kind == LAB_ADVICE_TEST)
    lab_json_say(list, "To know %s better, record: %s.", lab_fit_name(t->report->next.param, name),
                 t->report->next.text);
  else if (alike)
    lab_json_say(list, "Record a test that separates %s from %s; see What to record next.", name_of(alike->effect),
                 name_of(alike->alike[0]));
  else if (first && r->verdict != LAB_VERDICT_NONE)
    lab_json_say(list, "%s", first->valuestring);
}

/* ---- What the answer does not settle ---- */

/* What is known, but not well. */
static void put_rough(const lab_sources *t, cJSON *list)
{
  const lab_unknowns *u = t->report->completed;
  const lab_fit_result *fit = &t->report->result->fit;
  int j, knots = 0;
  for (j = 0; j < u->n; j++) {
    const double half = 0.5 * (fit->high[j] - fit->low[j]);
    if (u->unknown[j].kind == LAB_UNKNOWN_INSTANT || fit->state[j] != LAB_STATE_FREE ||
        !(half > rough * fabs(u->unknown[j].value)))
      continue;
    if (u->unknown[j].kind == LAB_UNKNOWN_KNOT)
      knots++;
    else if (half > fabs(u->unknown[j].value))
      lab_json_say(list, "The log hardly tells the parameter %s: its interval is wider than its value.",
                   u->unknown[j].name);
    else
      lab_json_say(list, "The parameter %s is known to within ±%.2g %%.", u->unknown[j].name,
                   100 * half / fabs(u->unknown[j].value));
  }
  if (knots > 0)
    lab_json_say(list,
                 "%d values of the free term have an uncertainty of more than %g %%: those near 0, and those that the "
                 "model hardly reaches.",
                 knots, 100 * rough);
}

/* Effects none of whose candidates leaves a trace. */
static void put_invisible(const lab_scores *scores, cJSON *list)
{
  unsigned char tried[PNEU_EFFECT_COUNT + 1] = {0}, visible[PNEU_EFFECT_COUNT + 1] = {0};
  char names[PNEU_EFFECT_COUNT * 32 + 1] = "";
  int i;
  for (i = 0; i < scores->n; i++) {
    tried[scores->of[i].effect] = 1;
    visible[scores->of[i].effect] |= scores->of[i].visible > 0;
  }
  for (i = 0; i < PNEU_EFFECT_COUNT; i++)
    if (tried[i] && !visible[i])
      lab_append(names, sizeof names, "%s%s", *names ? ", " : "", name_of(i));
  if (*names)
    lab_json_say(list, "With the declared laws this log cannot show these effects: %s.", names);
}

static void put_limits(const lab_sources *t, cJSON *page)
{
  cJSON *list = cJSON_AddArrayToObject(page, "limits");
  const lab_search_result *r = t->report->result;
  int i, k;
  for (i = 0; i < r->n_found; i++)
    for (k = 0; k < r->found[i].n_alike; k++)
      lab_json_say(list, "The effects %s and %s explain the log equally well.", name_of(r->found[i].effect),
                   name_of(r->found[i].alike[k]));
  lab_report_limits(t->report, list);
  put_rough(t, list);
  put_invisible(&r->scores, list);
  if (cJSON_GetArraySize(list) == 0)
    lab_json_say(list, "There is no limitation: every parameter is determined, and no two effects look alike.");
}

/* What to record next.  Returns: its list */
static const cJSON *put_next(const lab_sources *t, cJSON *page)
{
  cJSON *list = cJSON_AddArrayToObject(page, "next");
  const lab_search_result *r = t->report->result;
  int i, k;
  for (i = 0; i < r->n_found; i++)
    for (k = 0; k < r->found[i].n_alike; k++)
      if (k == 0 && t->report->separate[i].kind != LAB_ADVICE_NONE)
        lab_json_say(list, "To tell %s from %s: %s. %s", name_of(r->found[i].effect), name_of(r->found[i].alike[k]),
                     t->report->separate[i].text, t->report->separate[i].why);
      else
        lab_json_say(list, "To tell %s from %s, record a test in which only one of them acts. %s: %s. %s: %s.",
                     name_of(r->found[i].effect), name_of(r->found[i].alike[k]), name_of(r->found[i].effect),
                     pneu_effect_at(r->found[i].effect)->footprint, name_of(r->found[i].alike[k]),
                     pneu_effect_at(r->found[i].alike[k])->footprint);
  if (t->report->next.kind == LAB_ADVICE_TEST)
    lab_json_say(list, "Record this: %s. %s", t->report->next.text, t->report->next.why);
  if (r->verdict == LAB_VERDICT_UNDECIDED || r->verdict == LAB_VERDICT_UNLISTED)
    lab_json_say(list, "These tests separate the equations: a hold with both orifices shut at several positions "
                       "(mass), slow full strokes both ways (forces), rest on either stop (sensors).");
  if (!t->report->has_holdout)
    lab_json_say(list, "Record another log with other commands and give it by --holdout: a fit cannot adapt to a log "
                       "that it does not see.");
  if (cJSON_GetArraySize(list) == 0)
    lab_json_say(list, t->report->changes ? "Beside a baseline no test is sought; the new logs alone have one."
                                          : "No further test is needed for this verdict.");
  return list;
}

void lab_page_answer(const lab_sources *t, cJSON *page)
{
  put_verdict(t, page);
  put_logs(t, page);
  put_changes(t->report->changes, page);
  put_why(t, page);
  put_limits(t, page);
  put_size(t, page);
  put_sure(t, page);
  put_todo(t, put_next(t, page), page);
}

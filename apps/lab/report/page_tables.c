/* The tables of the page: errors, signature, deviations, parameters, whiteness, candidates, figures of merit. */
#include <math.h>
#include <string.h>

#include "../base/format.h"
#include "../base/quantile.h"
#include "page_private.h"

static void put_number(cJSON *to, const char *name, double value, int digits)
{
  lab_json_put(to, name, "%s", LAB_NUMBER(value, digits));
}

static void put_quantity(cJSON *to, const char *name, double value, const char *unit, int digits)
{
  lab_json_put(to, name, "%s", LAB_QUANTITY(value, unit, digits));
}

void lab_page_put_share(cJSON *to, const char *name, double share)
{
  lab_json_put(to, name, "%.3g %%", 100 * fmin(fmax(share, 0), 1));
}

/* ---- Errors ---- */

/* A column of the table of errors. */
typedef struct column {
  const char *heading;
  const lab_errors *errors;
  int shown;
  const char *stage;
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
  const int both = lab_report_is_completed(t->report), held = report->has_holdout;
  const column columns[] = {{"declared model, fitted", &report->result->before, 1, "before"},
                            {"completed model", &report->result->after, both, "after"},
                            {"held-out log, declared model", &report->holdout_before, held, "before"},
                            {"held-out log, completed model", &report->holdout_after, both && held, "after"}};
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
        put_quantity(cell, "rmse", columns[i].errors->rmse[c], lab_channels[c].unit, 3);
        put_number(cell, "in_noise", columns[i].errors->in_noise[c], 3);
        lab_json_put(cell, "stage", "%s", columns[i].stage);
        lab_json_put(cell, "share", "%.0f", 100 * fmax(columns[i].errors->in_noise[c], 0) / largest_of(columns, n, c));
      }
  }
}

/* ---- Valve signature ---- */

/* Numbers of each model, a row a kind. */
static void put_signature(const lab_sources *t, cJSON *page)
{
  static const struct {
    const char *name, *unit;
    size_t at;
  } kinds[] = {{"bench set, lower", "Pa", offsetof(lab_signature, bench_lower)},
               {"bench set, upper", "Pa", offsetof(lab_signature, bench_upper)},
               {"spring rate", "N/m", offsetof(lab_signature, spring_rate)},
               {"friction band", "Pa", offsetof(lab_signature, band)}};
  lab_signature_model model[LAB_SIGNATURE_MODELS];
  const int n = lab_signature_models(t->report, model);
  cJSON *headings = cJSON_AddArrayToObject(page, "signature_headings");
  cJSON *rows = cJSON_AddArrayToObject(page, "signature_rows");
  size_t k;
  int i;
  for (i = 0; i < n; i++)
    lab_json_say(headings, "%s", lab_curve_keys[model[i].key].label);
  for (k = 0; k < sizeof kinds / sizeof *kinds; k++) {
    cJSON *row = lab_json_append(rows), *cells = cJSON_AddArrayToObject(row, "cells");
    lab_json_put(row, "name", "%s", kinds[k].name);
    for (i = 0; i < n; i++)
      lab_json_say(cells, "%s",
                   LAB_QUANTITY(*(const double *)((const char *)&model[i].signature + kinds[k].at), kinds[k].unit, 4));
  }
}

/* ---- Declared values beside those that the log asks for ---- */

/* A tolerance: a share of what is declared, or a quantity where that is 0. */
static void put_tolerance(const lab_deviation *d, cJSON *row)
{
  if (isnan(d->tolerance))
    lab_json_put(row, "tolerance", "none");
  else if (d->declared != 0)
    lab_json_put(row, "tolerance", "%.3g %%", 100 * d->tolerance);
  else
    put_quantity(row, "tolerance", d->tolerance, d->unit, 3);
}

static const char *beyond_or_within(const lab_deviation *d)
{
  if (d->beyond)
    return "beyond";
  return fabs(d->found - d->declared) > d->tolerance * (d->declared != 0 ? fabs(d->declared) : 1) ? "perhaps beyond"
                                                                                                  : "within";
}

static void put_deviations(const lab_sources *t, cJSON *page)
{
  const lab_deviations *all = &t->report->deviations;
  cJSON *list = cJSON_AddArrayToObject(page, "deviations");
  int i;
  for (i = 0; i < all->n; i++) {
    const lab_deviation *d = &all->of[i];
    const double scale = lab_format_as(d->unit).scale;
    char since[LAB_SINCE_TEXT];
    cJSON *row = lab_json_append(list);
    lab_json_put(row, "name", "%s", d->name);
    put_quantity(row, "declared", d->declared, d->unit, 4);
    put_quantity(row, "value", d->found, d->unit, 4);
    lab_json_put(row, "interval", "%s .. %s", LAB_NUMBER(scale * d->lower, 4), LAB_NUMBER(scale * d->upper, 4));
    put_number(row, "ratio", d->ratio, 3);
    put_tolerance(d, row);
    lab_json_put(row, "mood", d->beyond ? "bad" : "good");
    lab_json_put(row, "words", "%s", beyond_or_within(d));
    lab_json_put(row, "held", d->held ? "yes" : "");
    lab_json_put(row, "since", "%s", lab_report_since(lab_report_onset(t->report, d->param), since));
  }
  lab_json_put(page, "has_deviations", all->n ? "yes" : "");
}

/* ---- Parameters ---- */

/* Digits at which both ends of the interval of an unknown can be told apart. */
static int digits_of(const lab_sources *t, int j)
{
  const lab_fit_result *fit = &t->report->result->fit;
  const double value = fabs(t->report->completed->unknown[j].value), width = fit->high[j] - fit->low[j];
  if (fit->state[j] != LAB_STATE_FREE || !(width > 0) || !(value > width))
    return 4;
  return (int)fmin(fmax(4, 2 + ceil(log10(value / width))), 9);
}

/* "0.0136 .. 0.0138", or why there is none */
static void put_interval(const lab_sources *t, int j, cJSON *to)
{
  const lab_fit_result *fit = &t->report->result->fit;
  const double scale = lab_format_as(t->report->completed->unknown[j].unit).scale;
  const int digits = digits_of(t, j), state = fit->state[j];
  const char *low = LAB_NUMBER(scale * fit->low[j], digits), *high = LAB_NUMBER(scale * fit->high[j], digits);
  if (state == LAB_STATE_FREE)
    lab_json_put(to, "interval", "%s .. %s", low, high);
  else if (state == LAB_STATE_AT_LOWER || state == LAB_STATE_AT_UPPER)
    lab_json_put(to, "interval", "%s, at %s %s", lab_fit_state_text(state),
                 state == LAB_STATE_AT_LOWER ? "most" : "least", state == LAB_STATE_AT_LOWER ? high : low);
  else
    lab_json_put(to, "interval", "%s", lab_fit_state_text(state));
}

cJSON *lab_page_put_size(const lab_sources *t, int param, cJSON *list)
{
  const int j = lab_report_size(t->report, param);
  const lab_unknown *x = &t->report->completed->unknown[j < 0 ? 0 : j];
  cJSON *item = j < 0 ? NULL : lab_json_append(list);
  if (!item)
    return NULL;
  lab_json_put(item, "meaning", "%s", lab_param_info(param).meaning);
  put_quantity(item, "value", x->value, x->unit, digits_of(t, j));
  lab_json_put(item, "unit", "%s", lab_format_as(x->unit).unit);
  put_interval(t, j, item);
  return item;
}

/* The same unknown as it was before anything was added: of the same log, or else what all logs shared.
 * Returns: NULL: it was none */
static const lab_unknown *before_of(const lab_unknowns *before, const lab_unknown *x)
{
  const lab_unknown *shared = NULL;
  int i;
  for (i = 0; i < before->n; i++) {
    const lab_unknown *y = &before->unknown[i];
    if (y->kind != x->kind || y->index != x->index || y->term != x->term)
      continue;
    if (y->run == x->run)
      return y;
    shared = y->run == LAB_ALL_RUNS ? y : shared;
  }
  return shared;
}

static void put_parameter(const lab_sources *t, int j, cJSON *list)
{
  const lab_unknown *x = &t->report->completed->unknown[j];
  const lab_format shown = lab_format_as(x->unit);
  pneu_params declared = t->report->rig->params;
  pneu_param_info info = {0};
  const lab_unknown *before = before_of(t->report->declared, x);
  cJSON *item = lab_json_append(list);
  lab_json_put(item, "name", "%s", x->name);
  lab_json_put(item, "unit", "%s", *shown.unit ? shown.unit : "1");
  put_number(item, "value", shown.scale * x->value, digits_of(t, j));
  if (before)
    put_number(item, "before", shown.scale * before->value, digits_of(t, j));
  put_interval(t, j, item);
  if (x->kind != LAB_UNKNOWN_PARAM)
    return;
  if (x->index == LAB_PARAM_ORIFICE_AREA) {
    lab_json_put(item, "declared", "1");
    lab_json_put(item, "meaning", "factor on fill_area and vent_area");
  } else if (pneu_param_describe(x->index, &info) == PNEU_OK) {
    lab_json_put(item, "meaning", "%s", info.meaning);
    if (x->index < PNEU_PARAM_BASE_COUNT || *pneu_param_at(&declared, x->index) != info.neutral)
      put_number(item, "declared", shown.scale * (double)*pneu_param_at(&declared, x->index), 4);
    else
      lab_json_put(item, "declared", "absent");
  }
}

static void put_parameters(const lab_sources *t, cJSON *page)
{
  const lab_unknowns *u = t->report->completed;
  cJSON *list = cJSON_AddArrayToObject(page, "parameters"), *knots = cJSON_AddArrayToObject(page, "knots");
  int j, switches = 0, clocks = 0;
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].kind == LAB_UNKNOWN_INSTANT && u->unknown[j].index == LAB_ALL_INSTANTS)
      clocks++;
    else if (u->unknown[j].kind == LAB_UNKNOWN_INSTANT)
      switches++;
    else
      put_parameter(t, j, u->unknown[j].kind == LAB_UNKNOWN_KNOT ? knots : list);
  lab_json_put(page, "has_knots", cJSON_GetArraySize(knots) ? "yes" : "");
  list = cJSON_AddArrayToObject(page, "switches");
  if (switches > 0)
    lab_json_say(list,
                 "Also fitted: the instants of %d changes of command, each between the two rows that bracket it. On "
                 "logs held out a command changes at the row that shows it.",
                 switches);
  if (clocks > 0)
    lab_json_say(list,
                 "Also fitted: by what share of a row the command is ahead of the log, one for each of %d runs in "
                 "which it changes often. On logs held out a command changes at the row that shows it.",
                 clocks);
}

/* ---- Whether what is left is white, and which effects the residual of the declared model asks for ---- */

static void put_whiteness(const lab_sources *t, cJSON *page)
{
  cJSON *list = cJSON_AddArrayToObject(page, "whiteness");
  const lab_search_result *r = t->report->result;
  int c;
  for (c = 0; c < t->figures->table.n_channels; c++) {
    const int channel = t->figures->table.channel[c].channel;
    const lab_whiteness *before = &r->left[LAB_STAGE_BEFORE][channel].whiteness;
    const lab_whiteness *after = &r->left[LAB_STAGE_AFTER][channel].whiteness;
    const int white = lab_is_white(after);
    cJSON *item = lab_json_append(list);
    lab_json_put(item, "channel", "%s %s", lab_channels[channel].quantity, lab_channels[channel].key);
    lab_json_put(item, "before", "%.3f", before->correlation[1]);
    if (lab_report_is_completed(t->report))
      lab_json_put(item, "after", "%.3f", after->correlation[1]);
    put_number(item, "q", after->statistic, 3);
    lab_json_put(item, "lags", "%d", after->degrees);
    lab_json_put(item, "p_value", "%s", LAB_P_VALUE(after->p_value));
    lab_json_put(item, "mood", white ? "good" : "bad");
    lab_json_put(item, "words", isnan(after->p_value) ? "too few values" : white ? "white" : "not white");
  }
}

/* The bar of a statistic: how long, in per cent on a scale of logarithms, and what became of its effect. */
static void put_bar(const lab_sources *t, const lab_score *c, double threshold, cJSON *item)
{
  const lab_search_result *result = t->report->result;
  const double least = 0.5, most = fmax(threshold, result->scores.of[0].statistic);
  int i, found = 0;
  for (i = 0; i < result->n_found; i++)
    found |= result->found[i].effect == c->effect;
  lab_json_put(item, "mood", found ? "after" : c->statistic > threshold ? "passes" : "fails");
  lab_json_put(item, "share", "%.0f", c->statistic > least ? 100 * log(c->statistic / least) / log(most / least) : 0);
}

static void put_candidates(const lab_sources *t, cJSON *page)
{
  const lab_scores *scores = &t->report->result->scores;
  cJSON *list = cJSON_AddArrayToObject(page, "candidates");
  const double threshold = t->report->result->level > 0 ? lab_chi2_threshold(t->report->result->level) : (double)NAN;
  int i;
  for (i = 0; i < scores->n; i++) {
    const lab_score *c = &scores->of[i];
    const double explained = lab_report_refit_explains(t->report->result, c);
    cJSON *item = lab_json_append(list);
    const pneu_param_info info = lab_param_info(c->param);
    lab_json_put(item, "effect", "%s", pneu_effect_at(c->effect)->name);
    lab_json_put(item, "parameter", "%s", info.name);
    put_number(item, "statistic", c->statistic, 3);
    lab_json_put(item, "p_value", "%s", LAB_P_VALUE(c->p_value));
    if (isnan(explained))
      lab_json_put(item, "explained", "-");
    else
      lab_page_put_share(item, "explained", explained);
    lab_page_put_share(item, "by_slope", c->explained);
    put_number(item, "visible", c->visible, 2);
    put_bar(t, c, threshold, item);
  }
  lab_json_put(page, "tried", "%d effects and parameters, %d slopes in all; the threshold is %s", scores->n,
               scores->tests, LAB_NUMBER(threshold, 3));
}

/* ---- Figures of merit ---- */

/* A figure, as measured and as the model has it. */
static void put_figure(const lab_report *report, int i, const char *model, cJSON *list)
{
  const lab_metric *const both[] = {&report->measured->metric[i], &report->predicted->metric[i]};
  const lab_metric_info *info = &lab_metric_infos[i];
  const char *unit = strcmp(info->unit, "1") ? info->unit : "";
  cJSON *row, *cells;
  char value[LAB_METRIC_SHOWN];
  int k;
  if (isnan(both[0]->value) && isnan(both[1]->value))
    return;
  row = lab_json_append(list);
  lab_json_put(row, "meaning", "%s", info->meaning);
  lab_json_put(row, "standard", "%s", info->standard);
  cells = cJSON_AddArrayToObject(row, "cells");
  for (k = 0; k < 2; k++) {
    cJSON *cell = lab_json_append(cells);
    lab_json_put(cell, "label", "%s", k ? model : "measured");
    lab_json_put(cell, "value", "%s%s%s", lab_metric_value(both[k], value), *unit ? " " : "", unit);
    if (isfinite(both[k]->value) && !both[k]->at_most)
      put_number(cell, "uncertainty", both[k]->uncertainty, 2);
  }
}

static void put_merit(const lab_sources *t, cJSON *page)
{
  const lab_metrics *measured = t->report->measured;
  const char *model = lab_report_is_completed(t->report) ? "completed model" : "declared model, fitted";
  cJSON *list, *missing;
  int i;
  if (!measured)
    return;
  lab_json_put(page, "merit_model", "%s", model);
  lab_json_put(page, "step_signal", "%s", lab_metrics_step_signal(measured->command));
  lab_json_put(page, "static_signal", "%s", lab_metrics_static_signal(measured->command));
  list = cJSON_AddArrayToObject(page, "merit");
  missing = cJSON_AddArrayToObject(page, "without_merit");
  for (i = 0; i < LAB_METRIC_COUNT; i++) {
    put_figure(t->report, i, model, list);
    if (isnan(measured->metric[i].value)) {
      cJSON *item = lab_json_append(missing);
      lab_json_put(item, "figure", "%s", lab_metric_infos[i].key);
      lab_json_put(item, "reason", "%s", measured->metric[i].text);
    }
  }
}

void lab_page_tables(const lab_sources *t, cJSON *page)
{
  put_errors(t, page);
  put_signature(t, page);
  put_deviations(t, page);
  put_parameters(t, page);
  put_whiteness(t, page);
  put_candidates(t, page);
  put_merit(t, page);
}

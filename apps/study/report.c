/* REPORT.md of the study, from its tables. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../lab/base/json.h"
#include "../lab/base/template.h"
#include "conclusions.h"
#include "hypotheses.h"

#include "study/paper/report.md.inc" /* report_md; made by make */

/* Smallest and largest value met. */
typedef struct span {
  double low, high;
} span;

static const span no_span = {HUGE_VAL, -HUGE_VAL};

static void widen(span *of, double value)
{
  of->low = fmin(of->low, value);
  of->high = fmax(of->high, value);
}

/* ---- The study ---- */

static void put_study(const study *s, cJSON *page)
{
  cJSON *laws = cJSON_AddArrayToObject(page, "laws"), *printed = cJSON_AddArrayToObject(page, "printed");
  cJSON *actuators = cJSON_AddArrayToObject(page, "actuators");
  int i;
  lab_json_put(page, "below", "%.0f", 100 * s->confirmed_below);
  lab_json_put(page, "n_laws", "%d", s->n_gas * s->n_flow);
  for (i = 0; i < s->n_gas * s->n_flow; i++)
    lab_json_say(laws, "%s, %s", pneu_gas_key(s->gas[i / s->n_flow]), pneu_flow_key(s->flow[i % s->n_flow]));
  for (i = 0; i < s->n_actuators; i++)
    lab_json_say(actuators, "%s", s->actuator[i].name);
  for (i = 0; i < s->n_printed; i++)
    lab_json_say(printed, "%s", s->actuator[i].name);
}

/* ---- The paper's statements, from paper_numbers.csv ---- */

/* A counted row that disagrees. */
static int disagrees(const table *t, size_t row)
{
  return table_is(t, row, "counted", "yes") && table_is(t, row, "agrees", "no");
}

/* A disagreeing row that no row above equals in two columns. */
static int is_new(const table *t, size_t row, const char *one, const char *other)
{
  size_t i;
  if (!disagrees(t, row))
    return 0;
  for (i = 0; i < row; i++)
    if (disagrees(t, i) && table_is(t, i, one, table_text(t, row, one)) &&
        table_is(t, i, other, table_text(t, row, other)))
      return 0;
  return 1;
}

/* First row of a statement none of whose rows disagrees. */
static int begins_reproduced(const table *t, size_t row)
{
  size_t i;
  if (!table_is(t, row, "counted", "yes"))
    return 0;
  for (i = 0; i < table_rows(t); i++)
    if (table_is(t, i, "statement", table_text(t, row, "statement")) && (i < row || disagrees(t, i)))
      return 0;
  return 1;
}

static int begins_number(const table *t, size_t row)
{
  return *table_text(t, row, "printed") && is_new(t, row, "statement", "printed");
}

/* A cause, the statements that it spoils, and the first number in print among them. */
static void put_cause(const table *t, size_t first, cJSON *cause)
{
  const char *words = table_text(t, first, "cause");
  cJSON *spoilt = cJSON_AddArrayToObject(cause, "spoilt");
  size_t row;
  lab_json_put(cause, "cause", "%s", words);
  lab_json_put(cause, "kind", "%s", table_text(t, first, "kind"));
  for (row = first; row < table_rows(t); row++) {
    if (!table_is(t, row, "cause", words))
      continue;
    if (is_new(t, row, "cause", "statement"))
      lab_json_join(spoilt, "; ", "%s", table_text(t, row, "statement"));
    if (begins_number(t, row) && !cJSON_GetObjectItem(cause, "first"))
      lab_json_put(cause, "first", "%.4g, %.4g", table_number(t, row, "printed"), table_number(t, row, "computed"));
  }
}

/* A slip that changes a number: "Table 1: sign (arithmetic; -0.29 printed, 0.423 computed)". */
static void put_slip(const table *t, size_t row, cJSON *slips)
{
  char print[64] = "";
  if (begins_number(t, row))
    snprintf(print, sizeof print, "; %.4g printed, %.4g computed", table_number(t, row, "printed"),
             table_number(t, row, "computed"));
  lab_json_join(slips, "; ", "%s (%s%s)", table_text(t, row, "cause"), table_text(t, row, "kind"), print);
}

/* What disagreements change: conclusions in a table, numbers and matters of form in a list each. */
static void put_causes(const table *t, cJSON *page)
{
  cJSON *causes = cJSON_AddArrayToObject(page, "causes"), *slips = cJSON_AddArrayToObject(page, "slips");
  cJSON *forms = cJSON_AddArrayToObject(page, "forms");
  size_t row;
  for (row = 0; row < table_rows(t); row++) {
    if (!is_new(t, row, "cause", "cause"))
      continue;
    if (table_is(t, row, "severity", "conclusion"))
      put_cause(t, row, lab_json_append(causes));
    else if (table_is(t, row, "severity", "number"))
      put_slip(t, row, slips);
    else
      lab_json_join(forms, "; ", "%s", table_text(t, row, "cause"));
  }
}

static void put_paper(const study *s, const table *t, cJSON *page)
{
  cJSON *reproduced = cJSON_AddArrayToObject(page, "reproduced");
  int wrong = 0, numbers = 0, causes = 0;
  size_t row;
  (void)s;
  for (row = 0; row < table_rows(t); row++) {
    wrong += is_new(t, row, "statement", "statement");
    numbers += begins_number(t, row);
    causes += is_new(t, row, "cause", "cause");
    if (begins_reproduced(t, row))
      lab_json_join(reproduced, "; ", "%s", table_text(t, row, "statement"));
  }
  lab_json_put(page, "statements", "%d", cJSON_GetArraySize(reproduced) + wrong);
  lab_json_put(page, "right", "%d", cJSON_GetArraySize(reproduced));
  lab_json_put(page, "wrong", "%d", wrong);
  lab_json_put(page, "numbers", "%d", numbers);
  lab_json_put(page, "n_causes", "%d", causes);
  put_causes(t, page);
}

/* ---- Eq. (1), from eq1.csv ---- */

/* "0.6 / 4.2 lag": what a lag and a ramp leave of a stroke, and which of them it is. */
static void put_edges(const study *s, const table *t, cJSON *page)
{
  static const char *const strokes[] = {"rise", "fall"};
  cJSON *list = cJSON_AddArrayToObject(page, "strokes");
  size_t row;
  int i;
  for (i = 0; i < 2 * s->n_printed; i++) {
    const char *actuator = s->actuator[i / 2].name;
    cJSON *item = lab_json_append(list), *cells = cJSON_AddArrayToObject(item, "cells");
    lab_json_put(item, "stroke", "%s, %s", actuator, strokes[i % 2]);
    for (row = 0; row < table_rows(t); row++)
      if (table_is(t, row, "actuator", actuator) && table_is(t, row, "stroke", strokes[i % 2]))
        lab_json_say(cells, "%.2f / %.2f %s", 100 * table_number(t, row, "lag_rms"),
                     100 * table_number(t, row, "ramp_rms"), table_text(t, row, "shape"));
  }
}

/* ---- Six hypotheses, from hypotheses_thresholds.csv, directions.csv, influence.csv ---- */

/* "65..92 %: not confirmed †" over the laws of an actuator.  Returns: whether it depends on the threshold */
static int add_verdict(const table *t, const char *actuator, const char *name, double below, cJSON *to)
{
  span left = no_span;
  int agreed = -2, depends = 0; /* -1: laws differ */
  size_t row;
  for (row = 0; row < table_rows(t); row++) {
    const verdict_shares shares = {table_number(t, row, "share_left"), table_number(t, row, "share_left_signed"),
                                   table_number(t, row, "share_alone"), table_number(t, row, "share_alone_signed")};
    const int v = (int)verdict_judge(&shares, below);
    if (!table_is(t, row, "actuator", actuator) || !table_is(t, row, "hypothesis", name))
      continue;
    widen(&left, floor(100 * shares.left_signed + 0.5));
    agreed = agreed == -2 || agreed == v ? v : -1;
    depends |= table_is(t, row, "depends_on_threshold", "yes");
  }
  if (agreed == VERDICT_NOT_TESTED)
    lab_json_say(to, "%s", verdict_brief(VERDICT_NOT_TESTED));
  else {
    char low[32] = "";
    if (left.low < left.high)
      snprintf(low, sizeof low, "%.0f..", left.low);
    lab_json_say(to, "%s%.0f %%: %s%s", low, left.high, agreed < 0 ? "differs by law" : verdict_brief((verdict)agreed),
                 depends ? " †" : "");
  }
  return depends;
}

static void put_verdicts(const study *s, const table *t, cJSON *page)
{
  cJSON *list = cJSON_AddArrayToObject(page, "hypotheses");
  int h, a, depends = 0;
  for (h = 0; h < HYPOTHESES; h++) {
    cJSON *item = lab_json_append(list), *cells = cJSON_AddArrayToObject(item, "verdicts");
    lab_json_put(item, "name", "%s", hypotheses[h].name);
    lab_json_put(item, "words", "%s", hypotheses[h].words);
    lab_json_put(item, "paper", "%s", hypotheses[h].paper);
    for (a = 0; a < s->n_actuators; a++)
      depends |= add_verdict(t, s->actuator[a].name, hypotheses[h].name, s->confirmed_below, cells);
  }
  lab_json_put(page, "turning", "%s", depends ? "† turns" : "None turns");
}

/* The asymmetry of a row over that of the same actuator and laws with nothing added [%]. */
static double change_by(const table *t, size_t row)
{
  static const char *const same[] = {"actuator", "gas", "flow"};
  size_t base, k;
  for (base = 0; base < table_rows(t); base++) {
    for (k = 0; k < 3 && table_is(t, base, same[k], table_text(t, row, same[k])); k++)
      ;
    if (k == 3 && table_number(t, base, "down_over_up") == 1)
      return 100 * (table_number(t, row, "asymmetry_signed") / table_number(t, base, "asymmetry_signed") - 1);
  }
  return (double)NAN;
}

/* Over all actuators and laws: what is added in one direction, and how much it changes. */
static void put_directions(const study *s, const table *t, cJSON *page)
{
  span rates = no_span, by_rate = no_span, vents = no_span, by_vent = no_span;
  size_t row;
  (void)s;
  for (row = 0; row < table_rows(t); row++) {
    const int is_rate = table_is(t, row, "what", "spring_rate");
    if (!is_rate && !table_is(t, row, "what", "orifice for equal times"))
      continue;
    widen(is_rate ? &rates : &vents, table_number(t, row, "down_over_up"));
    widen(is_rate ? &by_rate : &by_vent, change_by(t, row));
  }
  lab_json_put(page, "rates", "%.2f to %.2f", rates.low, rates.high);
  lab_json_put(page, "by_rate", "%.0f to %+.0f", by_rate.low, by_rate.high);
  lab_json_put(page, "vents", "%.2f to %.2f", vents.low, vents.high);
  lab_json_put(page, "by_vent", "%.1f to %+.1f", by_vent.low, by_vent.high);
}

static void put_influence(const study *s, const table *t, cJSON *page)
{
  cJSON *list = cJSON_AddArrayToObject(page, "influence");
  int h;
  for (h = H1_RATE; h <= H4_BENCH_OFFSET; h++) {
    span a = no_span;
    size_t row;
    for (row = 0; row < table_rows(t); row++)
      if (table_is(t, row, "actuator", s->actuator[s->subject].name) &&
          table_is(t, row, "hypothesis", hypotheses[h].name)) {
        widen(&a, table_number(t, row, "asymmetry_min"));
        widen(&a, table_number(t, row, "asymmetry_max"));
      }
    lab_json_join(list, ", ", "%.3f to %.3f (%s)", a.low, a.high, hypotheses[h].name);
  }
}

/* ---- Eighteen conclusions, from conclusions_actuators.csv and conclusions_thresholds.csv ---- */

static int verdict_of(const char *text)
{
  int v = FINDING_CONTRADICTED;
  while (v > FINDING_HOLDS && strncmp(text, finding_word(v), strlen(finding_word(v))) != 0)
    v--;
  return v;
}

static int is_of(const table *t, size_t row, int number)
{
  return atoi(table_text(t, row, "conclusion")) == number;
}

/* One word where all laws agree, else each with the number of laws. */
static void add_conclusion(const table *t, int number, const char *actuator, cJSON *to)
{
  int laws[FINDING_CONTRADICTED + 1] = {0}, all = 0, v;
  char text[128] = "";
  size_t row;
  for (row = 0; row < table_rows(t); row++)
    if (is_of(t, row, number) && table_is(t, row, "actuator", actuator)) {
      laws[verdict_of(table_text(t, row, "verdict"))]++;
      all++;
    }
  for (v = FINDING_HOLDS; v <= FINDING_CONTRADICTED; v++) {
    if (laws[v] == all)
      lab_append(text, sizeof text, "%s", finding_word(v));
    else if (laws[v])
      lab_append(text, sizeof text, "%s%s (%d of %d)", *text ? ", " : "", finding_word(v), laws[v], all);
  }
  lab_json_say(to, "%s", text);
}

static void put_conclusions(const study *s, const table *t, cJSON *page)
{
  cJSON *list = cJSON_AddArrayToObject(page, "conclusions");
  int i, a;
  for (i = 0; i < CONCLUSIONS; i++) {
    cJSON *item = lab_json_append(list), *cells = cJSON_AddArrayToObject(item, "verdicts");
    lab_json_put(item, "number", "%d", conclusions[i].number);
    lab_json_put(item, "says", "%s", conclusions[i].says);
    lab_json_put(item, "remark", "%s", conclusions[i].remark);
    for (a = 0; a < s->n_printed; a++)
      add_conclusion(t, conclusions[i].number, s->actuator[a].name, cells);
  }
}

/* Whether a conclusion holds under every law on every actuator, whatever the threshold and the set. */
static int is_held(const cJSON *item)
{
  const cJSON *cell;
  cJSON_ArrayForEach(cell, cJSON_GetObjectItem(item, "verdicts"))
  {
    if (strcmp(cell->valuestring, finding_word(FINDING_HOLDS)) != 0)
      return 0;
  }
  return !cJSON_GetArraySize(cJSON_GetObjectItem(item, "marks"));
}

/* Those that are held leave the list of the others for one of their own. */
static void part_held(cJSON *page)
{
  cJSON *list = cJSON_GetObjectItem(page, "conclusions"), *held = cJSON_AddArrayToObject(page, "held"), *item, *next;
  for (item = list ? list->child : NULL; item; item = next) {
    const char *remark = cJSON_GetStringValue(cJSON_GetObjectItem(item, "remark"));
    next = item->next;
    if (!is_held(item))
      continue;
    lab_json_join(held, "; ", "%s %s%s%s%s", cJSON_GetStringValue(cJSON_GetObjectItem(item, "number")),
                  cJSON_GetStringValue(cJSON_GetObjectItem(item, "says")), *remark ? " (" : "", remark,
                  *remark ? ")" : "");
    cJSON_Delete(cJSON_DetachItemViaPointer(list, item));
  }
}

/* What each verdict depends on in some law: the words of the column of the thresholds. */
static void put_marks(const study *s, const table *t, cJSON *page)
{
  static const char *const marks[] = {"threshold", "set"};
  cJSON *item;
  size_t k, row;
  int number = 0;
  (void)s;
  cJSON_ArrayForEach(item, cJSON_GetObjectItem(page, "conclusions"))
  {
    cJSON *list = cJSON_AddArrayToObject(item, "marks");
    number++;
    for (k = 0; k < 2; k++) {
      for (row = 0; row < table_rows(t); row++)
        if (is_of(t, row, number) && strstr(table_text(t, row, "depends_on"), marks[k]))
          break;
      if (row < table_rows(t))
        lab_json_say(list, "%s%s", cJSON_GetArraySize(list) ? ", " : " ", marks[k]);
    }
  }
  part_held(page);
}

/* ---- The solver, from agreement.csv ---- */

static void put_trust(const study *s, const table *t, cJSON *page)
{
  static const char *const gaps[][2] = {{"position_gap", "position_gap_over_stroke"},
                                        {"pressure_gap", "pressure_gap_over_supply"}};
  size_t k, row;
  (void)s;
  for (k = 0; k < 2; k++) {
    double most = 0;
    for (row = 0; row < table_rows(t); row++)
      most = fmax(most, table_number(t, row, gaps[k][1]));
    lab_json_put(page, gaps[k][0], "%.0e", most);
  }
}

/* ---- The report ---- */

static const struct {
  const char *file;
  void (*put)(const study *s, const table *t, cJSON *page);
} sections[] = {{"paper_numbers.csv", put_paper},
                {"eq1.csv", put_edges},
                {"hypotheses_thresholds.csv", put_verdicts},
                {"directions.csv", put_directions},
                {"influence.csv", put_influence},
                {"conclusions_actuators.csv", put_conclusions},
                {"conclusions_thresholds.csv", put_marks},
                {"agreement.csv", put_trust}};

static int put_all(const study *s, cJSON *page, lab_error *error)
{
  size_t i;
  put_study(s, page);
  for (i = 0; i < sizeof sections / sizeof *sections; i++) {
    table t;
    const int status = table_load(s, sections[i].file, &t, error);
    if (status == LAB_OK)
      sections[i].put(s, &t, page);
    table_close(&t);
    if (status != LAB_OK)
      return status;
  }
  return LAB_OK;
}

int report_make(const study *s, lab_error *error)
{
  cJSON *page = cJSON_CreateObject();
  char path[STUDY_PATH_TEXT + 16];
  int status = put_all(s, page, error);
  snprintf(path, sizeof path, "%s/REPORT.md", s->results);
  if (status == LAB_OK)
    status = lab_template_file(path, report_md, page, error);
  cJSON_Delete(page);
  if (status == LAB_OK)
    study_note_saved(s, "REPORT.md");
  return status;
}

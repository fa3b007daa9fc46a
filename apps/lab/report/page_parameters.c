/* The table of parameters. */
#include "../base/format.h"
#include "page_private.h"

/* The same unknown before anything was added, if it was fitted then. */
static void put_before(const lab_sources *t, const lab_unknown *x, double scale, int digits, cJSON *item)
{
  const lab_unknowns *u = t->report->declared;
  int j;
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].kind == x->kind && u->unknown[j].index == x->index)
      lab_page_put_number(item, "before", scale * u->unknown[j].value, digits);
}

static void put_parameter(const lab_sources *t, int j, cJSON *list)
{
  const lab_unknown *x = &t->report->completed->unknown[j];
  const lab_format shown = lab_format_as(lab_page_unit(x));
  pneu_params declared = t->report->rig->params;
  pneu_param_info info = {0};
  cJSON *item = lab_json_append(list);
  lab_json_put(item, "name", "%s", x->name);
  lab_json_put(item, "unit", "%s", *shown.unit ? shown.unit : "1");
  lab_page_put_number(item, "value", shown.scale * x->value, lab_page_digits(t, j));
  put_before(t, x, shown.scale, lab_page_digits(t, j), item);
  lab_page_put_interval(t, j, item);
  if (x->kind != LAB_UNKNOWN_PARAM)
    return;
  if (x->index == LAB_PARAM_ORIFICE_AREA) {
    lab_json_put(item, "declared", "1");
    lab_json_put(item, "meaning", "factor on fill_area and vent_area");
  } else if (pneu_param_describe(x->index, &info) == PNEU_OK) {
    lab_json_put(item, "meaning", "%s", info.meaning);
    if (x->index < PNEU_PARAM_BASE_COUNT || *pneu_param_at(&declared, x->index) != info.neutral)
      lab_page_put_number(item, "declared", shown.scale * (double)*pneu_param_at(&declared, x->index), 4);
    else
      lab_json_put(item, "declared", "absent");
  }
}

void lab_page_parameters(const lab_sources *t, cJSON *page)
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
  lab_json_put(page, "has_knots", "%s", cJSON_GetArraySize(knots) ? "yes" : "");
  list = cJSON_AddArrayToObject(page, "switches");
  if (switches > 0)
    lab_json_say(
        list,
        "Also fitted: the instants of %d changes of command, each between the two rows that bracket it. On logs "
        "held out a command changes at the row that shows it.",
        switches);
  if (clocks > 0)
    lab_json_say(
        list,
        "Also fitted: by what share of a row the command is ahead of the log, one for each of %d runs in which it "
        "changes often. On logs held out a command changes at the row that shows it.",
        clocks);
}

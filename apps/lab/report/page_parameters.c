/* The table of parameters. */
#include "../base/shown.h"
#include "page_private.h"

static void put_parameter(const telling *t, int j, cJSON *list)
{
  const lab_unknown *x = &t->story->completed->unknown[j];
  const lab_shown shown = lab_shown_as(page_unit(x));
  pneu_params declared = t->story->rig->params;
  pneu_param_info info = {0};
  cJSON *item = page_append(list);
  page_put(item, "name", "%s", x->name);
  page_put(item, "unit", "%s", *shown.unit ? shown.unit : "1");
  page_put_number(item, "value", shown.scale * x->value, page_digits(t, j));
  page_put_interval(t, j, item);
  if (x->kind != LAB_UNKNOWN_PARAM)
    return;
  if (x->index == LAB_FIT_ORIFICE_AREA) {
    page_put(item, "declared", "1");
    page_put(item, "meaning", "factor on fill_area and vent_area");
  } else if (pneu_param_describe(x->index, &info) == PNEU_OK) {
    page_put(item, "meaning", "%s", info.meaning);
    if (x->index < PNEU_PARAM_BASE_COUNT || *pneu_param_at(&declared, x->index) != info.neutral)
      page_put_number(item, "declared", shown.scale * (double)*pneu_param_at(&declared, x->index), 4);
    else
      page_put(item, "declared", "absent");
  }
}

void page_parameters(const telling *t, cJSON *page)
{
  const lab_unknowns *u = t->story->completed;
  cJSON *list = cJSON_AddArrayToObject(page, "parameters"), *knots = cJSON_AddArrayToObject(page, "knots");
  int j, switches = 0;
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].kind == LAB_UNKNOWN_SWITCH)
      switches++;
    else
      put_parameter(t, j, u->unknown[j].kind == LAB_UNKNOWN_KNOT ? knots : list);
  page_put(page, "has_knots", "%s", cJSON_GetArraySize(knots) ? "yes" : "");
  if (switches > 0) {
    list = cJSON_AddArrayToObject(page, "switches");
    page_say(list, "Fitted as well: the instants of %d changes of command, each between the two rows that bracket it.",
             switches);
  }
}

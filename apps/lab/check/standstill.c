#include "standstill.h"

#include <math.h>
#include <stdio.h>

#include "../base/format.h"

static const double may_be_less = 0.1; /* times what is declared, where it is fitted */
static const double highest = 2e6;     /* [Pa] supply of a bench */

static int is_any_fitted(const lab_rig *rig, const int *param, int n)
{
  int k, any = 0;
  for (k = 0; k < n; k++)
    any |= lab_rig_fits(rig, param[k]);
  return any;
}

static int has_other_drive(const lab_rig *rig)
{
  int i, any = rig->input[LAB_CHANNEL_P] || rig->input[LAB_CHANNEL_X] || rig->input[LAB_CHANNEL_PS] ||
               rig->input[LAB_CHANNEL_FORCE] || lab_rig_fits(rig, PNEU_PARAM_supply_pressure);
  for (i = 0; i < rig->n_terms; i++)
    any |= rig->term[i].equation == PNEU_TERM_SUPPLY || rig->term[i].equation == PNEU_TERM_FORCE;
  return any;
}

/* Gauge pressure at which the stem leaves its lower stop; NaN for a rig that is no model. */
static double lift_off(const lab_rig *rig)
{
  lab_error ignored;
  pneu_model model;
  pneu_input input;
  if (lab_rig_model(rig, &model, &ignored))
    return (double)NAN;
  pneu_input_default(&model, &input);
  return (double)pneu_balance_pressure(&model, 0, &input, 1);
}

/* "2.5 Pa", "389.8 kPa" */
static const char *show(double pressure, char text[LAB_FORMAT_TEXT])
{
  if (!(pressure < 1e3))
    return lab_format_quantity(pressure, "Pa", 4, text);
  snprintf(text, LAB_FORMAT_TEXT, "%.4g Pa", pressure);
  return text;
}

/* "did you mean "2.5 bar"?" for a plain number that is a pressure which lifts the stem in another unit. */
static void suggest_unit(double number, double least, char *text, size_t size)
{
  static const struct unit {
    const char *name;
    double pascal;
  } unit[] = {{"bar", 1e5}, {"kPa", 1e3}, {"psi", 6894.757}};
  size_t i = 0;
  while (i < sizeof unit / sizeof unit[0] && !(number * unit[i].pascal > least && number * unit[i].pascal < highest))
    i++;
  if (i < sizeof unit / sizeof unit[0])
    snprintf(text, size, "; plain numbers are SI: did you mean \"%.6g %s\"?", number, unit[i].name);
}

int lab_is_at_rest(const lab_rig *rig, double share, char text[LAB_LIMITATION_TEXT])
{
  static const int holds[] = {PNEU_PARAM_area, PNEU_PARAM_spring_rate, PNEU_PARAM_spring_preload,
                              PNEU_PARAM_external_force, PNEU_PARAM_dry_friction};
  const double supply = (double)rig->params.supply_pressure, least = lift_off(rig);
  const double counted = is_any_fitted(rig, holds, sizeof holds / sizeof holds[0]) ? fmin(share, may_be_less) : share;
  char found[LAB_FORMAT_TEXT], needed[LAB_FORMAT_TEXT], meant[80] = "";
  *text = '\0';
  if (!(rig->params.stroke > 0) || has_other_drive(rig) || !(supply < counted * least))
    return 0;
  suggest_unit(supply, least, meant, sizeof meant);
  snprintf(text, LAB_LIMITATION_TEXT,
           "the model's stem cannot leave its stop: supply.pressure is %s, and spring, load and friction as declared "
           "hold it up to %s%s",
           show(supply, found), show(least, needed), meant);
  return 1;
}

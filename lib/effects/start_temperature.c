/* Gas that does not begin at the temperature it is taken to have: T = T_0 + b where a state of rest begins. Air that
 * was compressed shortly before is warmer than its wall, air that was let off is colder; pressure is as measured, so
 * that there is less or more air of it. A thermometer begins at what it was taken to show. Size: 3 to 26 K in four
 * runs of two tanks that had been charged shortly before (results/measured). */
#include "../internal.h"

enum { EXCESS };

static const pneu_param_info params[] = {
    {"start_excess", "K", PNEU_C(-150.0), PNEU_C(150.0), PNEU_C(10.0), 0, 0, "how much warmer the gas begins"}};

static int acts(const pneu_model *model, const pneu_real *param)
{
  return !model->law.pressure_input &&
         (model->law.gas != PNEU_GAS_ISOTHERMAL || model->thermal || model->exponent_rise > 0) && param[EXCESS] != 0;
}

static void prepare(pneu_model *model, const pneu_real *param)
{
  model->start_excess = param[EXCESS];
}

const pneu_effect pneu_effect_record_start_temperature = {
    "start_temperature",
    "The gas begins warmer or colder than it is taken to, as after a charge or a blow-down.",
    "first law for a vessel that is charged: Moran and Shapiro 2006, section 4.4",
    "energy",
    "the first fall of pressure is quicker or slower than later ones; once heat has passed nothing is left of it",
    PNEU_STAGE_WALL,
    params,
    .acts = acts,
    .prepare = prepare};

const char pneu_effect_sentence_start_temperature[] = "The gas begins {size} {+warmer|colder} than it is taken to.";

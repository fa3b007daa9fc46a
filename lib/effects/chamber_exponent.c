/* Air that neither keeps its temperature nor all its heat: p V^n = const while the orifices are shut, by the balance of
 * the polytropic law, n - 1 over the isothermal law's n = 1. The polytropic law has an n of its own, and beside a film
 * (heat_transfer) the heat that passes decides under either; a film that passes none is the adiabatic chamber, so n
 * ends before it. Many models put n before the rate of the isothermal pressure and let the temperature stay (Richer and
 * Hurmuzlu 2000); that keeps p V^n too, but no balance of mass, and acts where the temperature is no state. */
#include "../internal.h"

enum { RISE, RATE_RISE };

static const pneu_param_info params[] = {
    {"exponent_rise", "1", 0, PNEU_C(0.35), PNEU_C(0.2), 0, 0, "n - 1, n the exponent of the chamber"},
    {"rate_exponent_rise", "1", 0, PNEU_C(0.4), PNEU_C(0.2), 0, 0,
     "n - 1, n the exponent of the rate of pressure alone; the temperature stays"}};

static int acts(const pneu_model *model, const pneu_real *param)
{
  return !model->law.pressure_input && model->law.gas == PNEU_GAS_ISOTHERMAL &&
         (param[RISE] > 0 || param[RATE_RISE] > 0);
}

static void prepare(pneu_model *model, const pneu_real *param)
{
  model->exponent_rise = param[RISE];
  model->rate_exponent_rise = param[RATE_RISE];
}

const pneu_effect pneu_effect_record_chamber_exponent = {
    "chamber_exponent",
    "The air warms when compressed and cools when expanding, by a fixed exponent between isothermal and adiabatic.",
    "Carneiro and Almeida 2006, Proc. IMechE I 220 (polytropic model); Richer and Hurmuzlu 2000, ASME J. Dyn. Syst. "
    "Meas. Control 122:416 (rate of pressure)",
    "energy",
    "filling and venting are quicker than isothermal all along the stroke, and nothing moves on after it",
    PNEU_STAGE_GEOMETRY,
    params,
    .acts = acts,
    .prepare = prepare};

const char pneu_effect_sentence_chamber_exponent[] =
    "The chamber is not isothermal: the exponent of its air is {exponent}, not 1.";

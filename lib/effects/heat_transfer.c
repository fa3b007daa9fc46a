/* Heat between gas and wall: Q = (G + c (rho/rho_a)^(2/3) |T_w - T|^(1/3)) (T_w - T), wall at ambient temperature,
 * rho_a the density of ambient air. Under the isothermal law the film is perfect; its resistance 1/G makes it real.
 * Under the other laws there is no film; its conductance makes one. An exponent stands for heat that passes, so that
 * beside a film the polytropic law has gamma in its place, and is the energy law, but takes no free term of heat. c is
 * turbulent natural convection in a closed vessel, Nu ~ Ra^(1/3): the length cancels, and Ra grows with the square of
 * density. */
#include "../internal.h"

enum { RESISTANCE, CONDUCTANCE, FREE };

static const pneu_param_info params[] = {
    {"film_resistance", "K/W", 0, PNEU_C(1e4), PNEU_C(0.2), 0, 0, "1/(h A) of the film, for the isothermal law"},
    {"film_conductance", "W/K", 0, PNEU_C(1e5), PNEU_C(5.0), 0, 0,
     "h A of the film, for the energy and polytropic laws"},
    {"free_convection", "W/K^1.333333333333333", 0, PNEU_C(1e4), PNEU_C(1.0), 0, 0,
     "natural convection at ambient density: heat per 4/3 power of the temperature difference"}};

static int acts(const pneu_model *model, const pneu_real *param)
{
  if (model->law.pressure_input)
    return 0;
  if (model->law.gas == PNEU_GAS_ISOTHERMAL)
    return param[RESISTANCE] > 0;
  return param[CONDUCTANCE] > 0 || param[FREE] > 0;
}

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  const pneu_params *p = &t->model->p;
  const pneu_real dT = p->ambient_temperature - t->T;
  const pneu_real density = t->p * p->ambient_temperature / (p->ambient_pressure * t->T); /* over ambient */
  pneu_real conductance = t->model->law.gas == PNEU_GAS_ISOTHERMAL ? 1 / param[RESISTANCE] : param[CONDUCTANCE];
  (void)state, (void)rate;
  if (param[FREE] > 0)
    conductance += param[FREE] * PNEU_M(cbrt)(density * density * PNEU_M(fabs)(dT));
  t->film += conductance;
  t->heat += conductance * dT;
}

const pneu_effect pneu_effect_record_heat_transfer = {
    "heat_transfer",
    "The gas warms when compressed and cools when expanding, and the wall takes time to level that.",
    "Carneiro and Almeida 2006, Proc. IMechE I 220; natural convection: McAdams 1954 (Nu ~ Ra^(1/3))",
    "energy",
    "pressure moves on after the orifices shut; the tails of filling and venting are slow",
    PNEU_STAGE_HEAT,
    params,
    .add = add,
    .acts = acts};

const char pneu_effect_sentence_heat_transfer[] = "Heat passes between gas and wall, but not at once: {size}.";

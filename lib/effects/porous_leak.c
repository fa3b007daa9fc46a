/* Leak through a porous wall: laminar while it is slow, held back by the inertia of the gas in the pores when it is
 * fast. Forchheimer's law, p^2 - p_a^2 = q/c + k q^2, solved for the flow with k = 1/(c p_c)^2:
 *   q = 2 c s/(1 + sqrt(1 + 4 s/p_c^2)),  s = p^2 - p_a^2.
 * At s = 2 p_c^2 the flow is half of the laminar one; with p_c far above the pressures it is laminar_leak.
 * What it stands for: printed, cast or sintered walls, diaphragm fabric, packing.
 * Size: a printed chamber of some 0.1 L that lost half its 7.6 bar in 11 s had c of the order of 1e-16 kg/s/Pa2 and p_c
 * of 5 bar (results/measured/REPORT.md). */
#include "../internal.h"

enum { CONDUCTANCE, CROSSOVER };

static const pneu_param_info params[] = {
    {"porous_leak", "kg/s/Pa2", 0, PNEU_C(1e-9), PNEU_C(1e-16), 0, 0,
     "mass flow over the difference of squared pressures, where the flow is slow"},
    {"crossover_pressure", "Pa", PNEU_C(1e3), PNEU_C(1e8), PNEU_C(3e5), PNEU_C(3e5), 1,
     "root of half the difference of squared pressures at which inertia halves the flow"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  const pneu_real pa = t->model->p.ambient_pressure, s = (t->p - pa) * (t->p + pa), crossover = param[CROSSOVER];
  const pneu_real slow = PNEU_M(sqrt)(1 + 4 * PNEU_M(fabs)(s) / (crossover * crossover));
  (void)state, (void)rate;
  pneu_let_in(t, -2 * param[CONDUCTANCE] * s / (1 + slow));
}

const pneu_effect pneu_effect_record_porous_leak = {
    "porous_leak",
    "Air leaves through a porous wall.",
    "Forchheimer 1901, Z. VDI 45:1782; for gases with squared pressures: Green and Duwez 1951, J. Appl. Mech. 18:39",
    "mass",
    "pressure falls while both orifices are shut, at high pressure less than a laminar leak, at low pressure less than "
    "an "
    "orifice",
    PNEU_STAGE_LEAK,
    params,
    .add = add};

const char pneu_effect_sentence_porous_leak[] =
    "The chamber leaks through a porous wall: {leak}, {leak_share} of what the fill orifice passes.";

/* Leak through a gap so narrow that the flow is laminar: q = c (p^2 - p_a^2), c = pi d^4/(256 mu R T L) for a tube.
 * What it stands for: a worn stem seal, a porous diaphragm, a thread that is not tight.
 * Size: 0.1 to 5 % of what the transducer passes. */
#include "../internal.h"

enum { CONDUCTANCE };

static const pneu_param_info params[] = {{"laminar_leak", "kg/s/Pa2", 0, PNEU_C(1e-9), PNEU_C(1e-16), 0, 0,
                                          "mass flow over the difference of squared pressures"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  const pneu_real pa = t->model->p.ambient_pressure;
  (void)state, (void)rate;
  pneu_let_in(t, param[CONDUCTANCE] * (pa - t->p) * (pa + t->p));
}

const pneu_effect pneu_effect_record_laminar_leak = {
    "laminar_leak",
    "Air seeps from the chamber through a narrow gap.",
    "Hagen 1839, Poiseuille 1840, integrated along the gap for an ideal gas at constant temperature",
    "mass",
    "pressure falls while both orifices are shut, the more slowly the lower it is: more than an orifice's leak at high "
    "pressure",
    PNEU_STAGE_LEAK,
    params,
    .add = add};

const char pneu_effect_sentence_laminar_leak[] =
    "The chamber leaks through a narrow gap: {leak}, {leak_share} of what the fill orifice passes.";

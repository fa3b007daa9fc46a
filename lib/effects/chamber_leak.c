/* Leak through an orifice: q = flow(area, p, p_a), the declared flow law.
 * What it stands for: a torn diaphragm, a loose fitting, a worn stem seal.
 * Size: 0.1 to 5 % of the transducer's effective area. */
#include "../internal.h"

enum { LEAK_AREA };

static const pneu_param_info params[] = {
    {"leak_area", "m2", 0, PNEU_C(1e-2), PNEU_C(1e-8), 0, 0, "effective area C*a of the leak"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  const pneu_params *p = &t->model->p;
  (void)state, (void)rate;
  if (!t->model->law.pressure_input)
    pneu_exchange(t, param[LEAK_AREA], p->ambient_pressure, p->ambient_temperature, NULL);
}

const pneu_effect pneu_effect_record_chamber_leak = {
    "chamber_leak",
    "Air leaves the chamber through a hole.",
    "ISO 6358-1:2013 for the flow; DAMADICS f9, f10 (Bartys 2003) for the fault",
    "mass",
    "pressure falls while both orifices are shut; the final pressure at full opening is low",
    PNEU_STAGE_LEAK,
    params,
    .add = add};

const char pneu_effect_sentence_chamber_leak[] = "The chamber leaks: {size}, {of_fill} of the fill orifice, {leak}.";

/* Dry friction grows with chamber pressure, which presses the seals: F + f p, p gauge and not below 0.
 * Size: f is friction coefficient times sealed surface; 0.1 to 2 % of the diaphragm's area. */
#include "../internal.h"

enum { SLOPE };

static const pneu_param_info params[] = {
    {"friction_per_pressure", "m2", 0, PNEU_C(1.0), PNEU_C(4e-4), 0, 0, "growth of dry friction with pressure"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  const pneu_real p = t->p - t->model->p.ambient_pressure;
  (void)state, (void)rate;
  t->friction += p > 0 ? param[SLOPE] * p : 0;
}

const pneu_effect pneu_effect_record_friction_pressure = {
    "friction_pressure",
    "Seals rub harder the higher the pressure.",
    "Belforte, Raparelli, Velardocchia 1993, Lubrication Engineering 49:775",
    "force",
    "the loop of pressure over position widens where pressure is high, also under an added load at the same position",
    PNEU_STAGE_FORCE,
    params,
    .add = add};

const char pneu_effect_sentence_friction_pressure[] = "Seals rub harder under pressure: {friction_rise} more at the "
                                                      "supply pressure, {of_friction_rise} of the dry friction.";

/* The spring stiffens (or softens) with travel: force k3 x^3 besides k (x + x0).
 * Size: 1 to 5 % of the spring force at full stroke. */
#include "../internal.h"

enum { CUBIC };

static const pneu_param_info params[] = {
    {"spring_cubic", "N/m3", PNEU_C(-1e13), PNEU_C(1e13), PNEU_C(5e7), 0, 0, "coefficient of the cubed travel"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  (void)state, (void)rate;
  t->force -= param[CUBIC] * t->x * t->x * t->x;
}

const pneu_effect pneu_effect_record_spring_hardening = {
    "spring_hardening",
    "The spring's force is not a straight line over travel.",
    "Duffing 1918, Erzwungene Schwingungen bei veraenderlicher Eigenfrequenz",
    "force",
    "the middle of the pressure-position loop bends; most at the far end, the same in both directions",
    PNEU_STAGE_FORCE,
    params,
    .add = add};

const char pneu_effect_sentence_spring_hardening[] =
    "The spring {+stiffens|softens} with travel: at full stroke its force is {of_spring} off the straight line.";

/* LuGre friction: bristles bend before the stem slides. With s(v) = F(v) the level of dry friction
 * (Stribeck's, if that is active) and z the bristle force over the Coulomb level F,
 *   z' = (v - |v| z F/F(v)) / d,    friction = F z + sigma_1 d z',
 * d = F/sigma_0 the travel in which friction builds up. d = 0 is Coulomb friction. */
#include "../internal.h"

enum { LENGTH, BRISTLE_DAMPING };

static const pneu_param_info params[] = {
    {"presliding_length", "m", 0, PNEU_C(1e-2), PNEU_C(2e-5), 0, 0, "travel in which friction builds up, F/sigma_0"},
    {"bristle_damping", "N.s/m", 0, PNEU_C(1e6), PNEU_C(1e3), PNEU_C(1e3), 1, "sigma_1 of the bristles"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  const pneu_real F = t->model->p.dry_friction;
  const pneu_real ratio = t->friction > 0 ? F / t->friction : 1;
  const pneu_real slip = t->v - t->sense * t->v * state[0] * ratio;
  rate[0] = slip / param[LENGTH];
  t->bristle_force = F * state[0] + param[BRISTLE_DAMPING] * slip;
}

const pneu_effect pneu_effect_record_presliding = {
    "presliding",
    "Friction builds up over a small elastic travel instead of at once.",
    "Canudas de Wit, Olsson, Astrom, Lischinsky 1995, IEEE TAC 40, Eqs. 4-6",
    "force",
    "the stem moves by micrometres before break-away and after each reversal",
    PNEU_STAGE_BRISTLE,
    params,
    .add = add};

const char pneu_effect_sentence_presliding[] = "Friction builds up over {size} of travel instead of at once.";

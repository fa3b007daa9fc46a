/* Dry friction changes along the stroke: F (1 + a x/stroke), not below 0.
 * What it stands for: a bent stem, packing that is worn where the stem mostly stands, a guide out of line. */
#include "../internal.h"

enum { SLOPE };

static const pneu_param_info params[] = {{"friction_slope", "1", PNEU_C(-1.0), PNEU_C(20.0), PNEU_C(0.5), 0, 0,
                                          "friction at full stroke over that at 0, less one"}};

static int acts(const pneu_model *model, const pneu_real *param)
{
  return model->p.stroke > 0 && param[SLOPE] != 0;
}

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  const pneu_real factor = 1 + param[SLOPE] * t->x / t->model->p.stroke;
  (void)state, (void)rate;
  t->friction *= factor > 0 ? factor : 0;
}

const pneu_effect pneu_effect_record_friction_position = {
    "friction_position",
    "Dry friction is not the same all along the stroke.",
    "DAMADICS f8, bent stem: Bartys et al. 2006, Control Eng. Practice 14:577",
    "force",
    "the loop of pressure over position between both directions of travel widens towards one end",
    PNEU_STAGE_FORCE,
    params,
    .add = add,
    .acts = acts};

const char pneu_effect_sentence_friction_position[] = "Dry friction {+grows|falls} by {percent} over the stroke.";

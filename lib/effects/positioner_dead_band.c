/* The positioner ignores more than declared: worn linkage, or a band set wider.
 * Size: 0.1 to 2 % of the stroke. */
#include "../internal.h"

enum { EXCESS };

static const pneu_param_info params[] = {{"dead_band_excess", "1", 0, PNEU_C(0.5), PNEU_C(0.005), 0, 0,
                                          "share of the stroke added to the dead band, either way"}};

static void prepare(pneu_model *model, const pneu_real *param)
{
  model->dead_band += param[EXCESS];
}

const pneu_effect pneu_effect_record_positioner_dead_band = {
    "positioner_dead_band",
    "The positioner ignores larger errors than it should.",
    "dead band of a positioner: IEC 61514",
    "command",
    "the stem comes to rest off its set position, on the side from which it came, by up to the same either way",
    PNEU_STAGE_POSITIONER,
    params,
    .prepare = prepare};

const char pneu_effect_sentence_positioner_dead_band[] =
    "The positioner ignores errors that are {percent} of the stroke larger than its declared dead band.";

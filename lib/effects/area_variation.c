/* The effective area falls with travel as the diaphragm rolls: A(x) = A (1 - a x/stroke). The volume is its integral,
 * V_0 + r A x (1 - a x/(2 stroke)), r the swept ratio. Geometry belongs to the model: see pneu_volume.
 * Size: 1 to 5 % for a rolling or convoluted diaphragm, up to 20 % for a flat one; a < 0 where it grows. */
#include "../internal.h"

enum { LOSS };

static const pneu_param_info params[] = {{"area_loss", "1", PNEU_C(-1.0), PNEU_C(0.9), PNEU_C(0.05), 0, 0,
                                          "share of the effective area lost over the stroke"}};

static int acts(const pneu_model *model, const pneu_real *param)
{
  return model->p.stroke > 0 && param[LOSS] != 0;
}

static void prepare(pneu_model *model, const pneu_real *param)
{
  model->area_slope = param[LOSS] / model->p.stroke;
}

const pneu_effect pneu_effect_record_area_variation = {
    "area_variation",
    "The diaphragm's effective area changes along the stroke.",
    "diaphragm makers' data, e.g. 10 to 12 in2 over the stroke of a flat one (gas measurement course PT-18)",
    "force",
    "pressure over position bends upwards, more than a spring would at high pressure; also under an added load",
    PNEU_STAGE_GEOMETRY,
    params,
    .acts = acts,
    .prepare = prepare};

const char pneu_effect_sentence_area_variation[] =
    "The diaphragm's effective area {+falls|grows} by {percent} over the stroke.";

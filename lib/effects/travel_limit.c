/* The upper stop comes early: travel = stroke - loss, a thousandth of the stroke at least.
 * What it stands for: a travel stop set short, a seat that wears or holds a foreign body, a stem coupled too long. */
#include "../internal.h"

enum { LOSS };

static const pneu_param_info params[] = {
    {"travel_loss", "m", 0, PNEU_C(2.0), PNEU_C(1e-3), 0, 0, "stroke that is missing at the upper end"}};

static void prepare(pneu_model *model, const pneu_real *param)
{
  const pneu_real least = model->p.stroke * PNEU_C(1e-3), travel = model->p.stroke - param[LOSS];
  model->travel = travel > least ? travel : least;
  model->upper_stop = model->travel;
}

const pneu_effect pneu_effect_record_travel_limit = {
    "travel_limit",
    "The stem stops before it has made its stroke.",
    "rated and actual travel: IEC 60534-1:2005; DAMADICS f1 (Bartys et al. 2006) for a blocked stroke",
    "force",
    "position ends short while pressure goes on to the supply; below that all is right",
    PNEU_STAGE_GEOMETRY,
    params,
    .prepare = prepare};

const char pneu_effect_sentence_travel_limit[] = "The stem stops {size} short of its stroke, {of_stroke} of it.";

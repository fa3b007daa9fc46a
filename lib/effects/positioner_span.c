/* The positioner sees too much travel in proportion: x (1 + s) is fed back. Its span is out of adjustment, or its lever
 * is hooked in at the wrong place. */
#include "../internal.h"

enum { EXCESS };

static const pneu_param_info params[] = {{"span_excess", "1", PNEU_C(-0.9), PNEU_C(10.0), PNEU_C(0.02), 0, 0,
                                          "what is fed back too much, over the true position"}};

static void prepare(pneu_model *model, const pneu_real *param)
{
  model->feedback_span = param[EXCESS];
}

const pneu_effect pneu_effect_record_positioner_span = {
    "positioner_span",
    "The positioner sees too much travel in proportion.",
    "span error: IEC 61298-2; feedback fault of a positioner: DAMADICS f14 (Bartys et al. 2006, Control Eng. Practice "
    "14:577)",
    "command",
    "the stem comes to rest right at the lower end and off its set position in proportion above it",
    PNEU_STAGE_POSITIONER,
    params,
    .prepare = prepare};

const char pneu_effect_sentence_positioner_span[] =
    "The positioner sees {percent} of the travel too {+much|little}: its span is off.";

/* The positioner sees too much travel by a constant: x + z is fed back. Its zero has shifted, or its lever has slipped.
 */
#include "../internal.h"

enum { SHIFT };

static const pneu_param_info params[] = {
    {"zero_shift", "m", PNEU_C(-1.0), PNEU_C(1.0), PNEU_C(2e-4), 0, 0, "what is fed back too much"}};

static void prepare(pneu_model *model, const pneu_real *param)
{
  model->feedback_zero = param[SHIFT];
}

const pneu_effect pneu_effect_record_positioner_zero = {
    "positioner_zero",
    "The zero of the positioner has shifted.",
    "zero error: IEC 61298-2; feedback fault of a positioner: DAMADICS f14 (Bartys et al. 2006, Control Eng. Practice "
    "14:577)",
    "command",
    "the stem comes to rest off its set position by the same everywhere",
    PNEU_STAGE_POSITIONER,
    params,
    .prepare = prepare};

const char pneu_effect_sentence_positioner_zero[] =
    "The zero of the positioner has shifted: it sees {size} too {+much|little}, {of_stroke} of the stroke.";

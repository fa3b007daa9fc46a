/* The command acts late: u(t - d). The delay is a constant of the model; what is on its way is in pneu_input.delay.
 * Size: 3 ms per metre of tube (speed of sound), 5 to 30 ms for the transducer's electronics and bus. */
#include "../internal.h"

enum { DELAY };

static const pneu_param_info params[] = {
    {"dead_time", "s", 0, PNEU_C(100.0), PNEU_C(0.02), 0, 0, "delay of the command"}};

static void prepare(pneu_model *model, const pneu_real *param)
{
  model->command_delay = param[DELAY];
}

const pneu_effect pneu_effect_record_dead_time = {
    "dead_time",
    "Nothing happens for a while after a change of command.",
    "transport lag L/c in pneumatic lines: Richer and Hurmuzlu 2000, ASME J. Dyn. Syst. Meas. Control 122:416",
    "command",
    "pressure starts late by the same time after every change of command, both ways, and then has the right slope at "
    "once",
    PNEU_STAGE_COMMAND,
    params,
    NULL,
    NULL,
    NULL,
    prepare};

const char pneu_effect_sentence_dead_time[] = "Every command acts {size} late.";

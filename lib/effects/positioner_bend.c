/* The ports open out of proportion: u (1 - b (1 - |u|)). Full opening is as declared; b > 0: small openings pass less,
 * b < 0: more. */
#include "../internal.h"

enum { BEND };

static const pneu_param_info params[] = {
    {"flow_bend", "1", PNEU_C(-1.0), PNEU_C(1.0), PNEU_C(0.2), 0, 0, "share of a small opening that is missing"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  (void)state, (void)rate;
  t->opening *= 1 - param[BEND] * (1 - PNEU_M(fabs)(t->opening));
}

const pneu_effect pneu_effect_record_positioner_bend = {
    "positioner_bend",
    "The ports of the positioner open out of proportion.",
    "flow gain of shaped ports: Blackburn, Reethof, Shearer 1960, Fluid Power Control, ch. 7",
    "command",
    "flow at part openings is off both ways, most at half of it; full openings are right",
    PNEU_STAGE_SPOOL,
    params,
    .add = add};

const char pneu_effect_sentence_positioner_bend[] =
    "Small openings of the positioner pass {percent} {+less|more} than in proportion.";

/* Choking: the flow follows the isentropic nozzle instead of the declared law, by a share c:
 * q = (1 - c) q_law + c q_nozzle. c is 0 or 1 in nature; values between carry the fit across. */
#include "../internal.h"

enum { SHARE };

static const pneu_param_info params[] = {
    {"choked_share", "1", 0, 1, 1, 0, 0, "share of the flow that follows the choking nozzle"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  (void)state, (void)rate;
  t->choked_share += param[SHARE];
}

const pneu_effect pneu_effect_record_choked_flow = {
    "choked_flow",
    "Flow does not grow further once the orifice is sonic.",
    "Saint-Venant and Wantzel 1839; ISO 6358-1:2013",
    "mass",
    "the model fills and vents too fast while the pressure ratio is below 0.53, with an orifice fitted too small",
    PNEU_STAGE_BOUNDARY,
    params,
    .add = add};

const char pneu_effect_sentence_choked_flow[] =
    "Flow stops growing once the orifice is sonic: {percent} of it follows the choking nozzle.";

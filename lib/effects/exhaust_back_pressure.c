/* The exhaust gives way under flow: p_e = p_a + R q behind the vent orifice.
 * Size: a silencer builds up 1 to 10 kPa at full flow. */
#include "../internal.h"

enum { RESISTANCE };

static const pneu_param_info params[] = {
    {"exhaust_resistance", "Pa.s/kg", 0, PNEU_C(1e10), PNEU_C(1e7), 0, 0, "pressure built up per mass flow vented"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  (void)state, (void)rate;
  t->exhaust_line.resistance += param[RESISTANCE];
}

const pneu_effect pneu_effect_record_exhaust_back_pressure = {
    "exhaust_back_pressure",
    "Pressure builds up behind the vent while air leaves.",
    "series restriction as in ISO 6358-3:2014, here linear",
    "mass",
    "venting is too slow towards its end, where flow is not choked; filling and choked venting are right",
    PNEU_STAGE_BOUNDARY,
    params,
    .add = add};

const char pneu_effect_sentence_exhaust_back_pressure[] =
    "Air leaves against a pressure: {vent_drop} at the full flow of the vent orifice.";

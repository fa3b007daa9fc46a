/* The supply gives way under flow: p_s = p_s0 - R q. */
#include "../internal.h"

enum { RESISTANCE };

static const pneu_param_info params[] = {
    {"supply_resistance", "Pa.s/kg", 0, PNEU_C(1e10), PNEU_C(1e6), 0, 0, "pressure lost per mass flow drawn"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  (void)state, (void)rate;
  t->supply_resistance += param[RESISTANCE];
}

const pneu_effect pneu_effect_record_supply_droop = {
    "supply_droop",
    "The supply pressure falls while air is drawn.",
    "linear regulator droop; Valve Magazine, spring 2008: 10 to 20 % at full travel",
    "mass",
    "filling is slow at first, where flow is largest; venting is right",
    PNEU_STAGE_BOUNDARY,
    params,
    add,
    NULL,
    NULL,
    NULL};

const char pneu_effect_sentence_supply_droop[] =
    "The supply gives way: it loses {fill_drop} at the full flow of the fill orifice.";

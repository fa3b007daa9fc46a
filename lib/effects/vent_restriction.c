/* The vent passes less than declared: area_vent (1 - r). A clogged silencer has r > 0; a vent larger
 * than the fill orifice r < 0. */
#include "../internal.h"

enum { SHARE };

static const pneu_param_info params[] = {{"vent_restriction", "1", PNEU_C(-10.0), PNEU_C(0.999), PNEU_C(0.1), 0, 0,
                                          "share of the declared vent area that is missing"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  (void)state, (void)rate;
  t->vent_area *= 1 - param[SHARE];
}

const pneu_effect pneu_effect_record_vent_restriction = {
    "vent_restriction",
    "Fill and vent orifices are not alike.",
    "[B], hypothesis 5",
    "mass",
    "venting is slower (or faster) than filling explains, in proportion at every pressure",
    PNEU_STAGE_BOUNDARY,
    params,
    .add = add};

const char pneu_effect_sentence_vent_restriction[] = "The vent passes {percent} {+less|more} than declared.";

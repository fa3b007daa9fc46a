/* The lands of the spool are wider than its ports by w: fill opens by max(0, (u - w)/(1 - w)), vent by
 * max(0, (-u - w)/(1 - w)), so that u = 1 and -1 are fully open as declared. w < 0 is underlap: about the middle both
 * ports are open, and air leaks from the supply through the spool.
 * Size: 0.5 to 5 % of the spool's way. */
#include "../internal.h"

enum { OVERLAP };

static const pneu_param_info params[] = {{"overlap", "1", PNEU_C(-0.5), PNEU_C(0.5), PNEU_C(0.02), 0, 0,
                                          "share of the spool's way that opens nothing; below 0 both ports are open"}};

static pneu_real port(pneu_real u, pneu_real overlap)
{
  return u > overlap ? (u - overlap) / (1 - overlap) : 0;
}

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  const pneu_real fill = port(t->opening, param[OVERLAP]), vent = port(-t->opening, param[OVERLAP]);
  (void)state, (void)rate;
  t->opening = fill > vent ? fill : -vent;
  t->crossing = fill > vent ? -vent : fill;
}

const pneu_effect pneu_effect_record_positioner_overlap = {
    "positioner_overlap",
    "The spool of the positioner opens late, or never shuts.",
    "lap of a spool valve: Blackburn, Reethof, Shearer 1960, Fluid Power Control, ch. 7",
    "command",
    "small openings pass nothing both ways; with underlap pressure drifts while the opening is small",
    PNEU_STAGE_SPOOL,
    params,
    .add = add};

const char pneu_effect_sentence_positioner_overlap[] =
    "The spool of the positioner {+opens only after|is still open at} {percent} of its way.";

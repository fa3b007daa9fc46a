#include "verdicts.h"

#include <math.h>

#include "products.h"
#include "stroke.h"

/* A model without one cause, or with HYPOTHESES, whole. */
static int measure(const lab_rig *rig, const pneu_laws *laws, int cause, lab_asymmetry *r, lab_error *error)
{
  pneu_params p = rig->params;
  pneu_laws own = *laws;
  if (cause < HYPOTHESES)
    hypotheses[cause].without(&p, &own);
  return stroke_measure(&p, &p, &own, r, error);
}

int verdict_measure(const lab_rig *rig, const pneu_laws *laws, verdict_strokes *out, lab_error *error)
{
  static const lab_asymmetry untried = {.asymmetry = NAN, .asymmetry_signed = NAN};
  int c;
  if (measure(rig, laws, HYPOTHESES, &out->base, error))
    return error->status;
  for (c = 0; c < HYPOTHESES; c++) {
    out->alone[c] = untried;
    if (measure(rig, laws, c, &out->without[c], error))
      return lab_fail_in(error, "%s without its cause", hypotheses[c].name);
  }
  out->alone[H1_RATE] = out->without[H6_AIR_PROCESS];
  out->alone[H6_AIR_PROCESS] = out->without[H1_RATE];
  return LAB_OK;
}

verdict_shares verdict_shares_of(const verdict_strokes *strokes, int cause)
{
  const lab_asymmetry *base = &strokes->base, *without = &strokes->without[cause], *alone = &strokes->alone[cause];
  const verdict_shares shares = {without->asymmetry / base->asymmetry,
                                 without->asymmetry_signed / base->asymmetry_signed, alone->asymmetry / base->asymmetry,
                                 alone->asymmetry_signed / base->asymmetry_signed};
  return shares;
}

verdict verdict_judge(const verdict_shares *shares, double below)
{
  if (fabs(shares->left - 1) < 1e-6)
    return VERDICT_NOT_TESTED;
  if (!(shares->left < below))
    return shares->left_signed < -below ? VERDICT_REVERSED : VERDICT_NOT_CONFIRMED;
  if (shares->alone < below)
    return VERDICT_NECESSARY;
  return shares->alone_signed < -below ? VERDICT_OPPOSITE : VERDICT_CONFIRMED;
}

static const struct {
  const char *text, *brief;
} verdict_words[] = {
    [VERDICT_NOT_TESTED] = {"not tested: nothing to take away", "not tested"},
    [VERDICT_NOT_CONFIRMED] = {"not confirmed", "not confirmed"},
    [VERDICT_REVERSED] = {"not confirmed; without it the strokes bend the other way", "not confirmed, reversed"},
    [VERDICT_NECESSARY] = {"confirmed as necessary; alone it makes no asymmetry", "necessary, alone nothing"},
    [VERDICT_OPPOSITE] = {"confirmed as necessary; alone it bends the strokes the other way",
                          "necessary, alone reversed"},
    [VERDICT_CONFIRMED] = {"confirmed", "confirmed"}};

const char *verdict_brief(verdict v)
{
  return verdict_words[v].brief;
}

/* ---- Tables ---- */

static const char *judged(const verdict_shares *shares, double below)
{
  return verdict_words[verdict_judge(shares, below)].text;
}

enum { VERDICTS, THRESHOLDS };

static int verdict_rows(const study_cell *cell, table *t, lab_error *error)
{
  static const double below[] = {0.05, 0.10, 0.20, 0.30};
  verdict_strokes strokes;
  int c;
  if (verdict_measure(cell->rig, &cell->laws, &strokes, error))
    return error->status;
  for (c = 0; c < HYPOTHESES; c++) {
    const lab_asymmetry *base = &strokes.base, *without = &strokes.without[c], *alone = &strokes.alone[c];
    const verdict_shares share = verdict_shares_of(&strokes, c);
    const int depends = verdict_judge(&share, below[0]) != verdict_judge(&share, below[3]);
    table_row(&t[VERDICTS], "sssggggsgggg", hypotheses[c].name, cell->gas, cell->flow, base->asymmetry,
              without->asymmetry, base->duration_ratio, without->duration_ratio,
              judged(&share, cell->s->confirmed_below), base->asymmetry_signed, without->asymmetry_signed,
              alone->asymmetry, alone->asymmetry_signed);
    table_row(&t[THRESHOLDS], "ssssggggsssss", cell->rig->name, hypotheses[c].name, cell->gas, cell->flow, share.left,
              share.left_signed, share.alone, share.alone_signed, judged(&share, below[0]), judged(&share, below[1]),
              judged(&share, below[2]), judged(&share, below[3]), depends ? "yes" : "no");
  }
  return LAB_OK;
}

const study_tables verdicts = {
    {STUDY_ALL, STUDY_EVERY_LAW},
    verdict_rows,
    {[VERDICTS] = {"hypotheses",
                   "hypothesis,gas,flow,asymmetry_base,asymmetry_without_cause,duration_ratio_base,"
                   "duration_ratio_without_cause,verdict,asymmetry_signed_base,asymmetry_signed_without_cause,"
                   "asymmetry_alone,asymmetry_signed_alone",
                   STUDY_BY_ACTUATOR, STUDY_ACTUATOR_FILE, 0},
     [THRESHOLDS] = {"hypotheses_thresholds.csv",
                     "actuator,hypothesis,gas,flow,share_left,share_left_signed,share_alone,share_alone_signed,"
                     "below_5_percent,below_10_percent,below_20_percent,below_30_percent,depends_on_threshold",
                     STUDY_BY_ACTUATOR, STUDY_WHOLE, 0}}};

#include "hypotheses.h"

#include <math.h>

#include "benchscan.h"
#include "products.h"

/* ---- What is taken away, and what is varied ---- */

void hypothesis_without(int cause, pneu_params *p, pneu_laws *laws)
{
  const double middle = p->spring_rate * (p->spring_preload + p->stroke / 2); /* force of the spring at mid-travel */
  switch (cause) {
  case H1_RATE: /* the force at mid-travel stays, in its one direction, at every position; a hundredth of the rate is
                   left, so that a bench set exists */
    p->spring_rate /= 100;
    p->spring_preload = fmin(middle / p->spring_rate - p->stroke / 2, 1.0);
    p->external_force = middle - p->spring_rate * (p->spring_preload + p->stroke / 2);
    break;
  case H2_PRELOAD: /* no more force at rest than brings the stem home against friction */
    p->spring_preload = 1.25 * p->dry_friction / p->spring_rate;
    break;
  case H3_LIMITER: /* no upper limiter: supply and spring end the travel */
    p->stroke = 2 * p->supply_pressure * p->area / p->spring_rate;
    break;
  case H4_BENCH_OFFSET: /* the bench set in the middle of the supply range, where neither stroke is favoured */
    p->spring_preload = p->supply_pressure / 2 * p->area / p->spring_rate - p->stroke / 2;
    break;
  case H5_UNEQUAL_ORIFICES: /* the vent is as wide as the fill */
    p->vent_area = p->fill_area;
    break;
  case H6_AIR_PROCESS: /* filling and venting are made the same process: flow in proportion to the pressure difference
                          whatever the density, the volume of mid-travel throughout, no change of temperature. The bench
                          set stays where it is: it belongs to the spring and to H4. */
    p->dead_volume += p->area * p->stroke / 2;
    p->swept_ratio = 0;
    laws->gas = PNEU_GAS_ISOTHERMAL;
    laws->flow = LINEAR_FLOW;
  }
}

/* Figures 15 to 19.  In: value  of what a hypothesis varies */
static void vary_by(const study *s, int which, double value, pneu_params *p)
{
  const double force = p->spring_rate * p->spring_preload;
  const study_bench *bench;
  switch (which) {
  case H1_RATE: /* rate of the spring [N/m]; its force at rest stays */
    p->spring_rate = value;
    p->spring_preload = force / value;
    break;
  case H2_PRELOAD: /* force of the spring at rest [N] */
    p->spring_preload = value / p->spring_rate;
    break;
  case H3_LIMITER: /* travel over nominal travel */
    p->stroke *= value;
    break;
  case H4_BENCH_OFFSET: /* class of bench set, from 1 */
    bench = &s->bench[(int)value - 1];
    *p = bench_params(p, bench->low, bench->high - bench->low);
    break;
  default: /* H5: C/C0 of both orifices */
    p->fill_area *= value;
    p->vent_area *= value;
  }
}

const hypothesis hypotheses[HYPOTHESES] = {[H1_RATE] = {"H1", "rate of the spring", "not confirmed", 1e-3},
                                           [H2_PRELOAD] = {"H2", "preload of the spring", "not confirmed", 1},
                                           [H3_LIMITER] = {"H3", "travel limiters", "not confirmed", 100},
                                           [H4_BENCH_OFFSET] = {"H4", "place of the bench set", "not confirmed", 1},
                                           [H5_UNEQUAL_ORIFICES] = {"H5", "unequal fill and vent", "not confirmed", 1},
                                           [H6_AIR_PROCESS] = {"H6", "different air processes", "confirmed", 0}};

/* ---- Figures 15 to 19 ---- */

enum { VARIED = H5_UNEQUAL_ORIFICES + 1, INFLUENCE = VARIED, MEASURES = 4 };

static study_range range_of(const study *s, int which)
{
  const study_range benches = {1, s->n_benches, s->n_benches};
  return which == H4_BENCH_OFFSET ? benches : s->range[which];
}

static double value_at(const study_range *range, int i)
{
  return range->points < 2 ? range->from : range->from + (range->to - range->from) * i / (range->points - 1);
}

/* One point; a stroke that does not come back has no measures and stays in the table as a gap. */
static int measure_point(const study_cell *c, int which, double value, double measure[MEASURES], lab_error *error)
{
  lab_asymmetry r = {.T1 = NAN, .T2 = NAN, .asymmetry = NAN, .asymmetry_signed = NAN};
  pneu_params p = c->rig->params;
  int status;
  vary_by(c->s, which, value, &p);
  status = stroke_measure(&p, &p, &c->laws, &r, error);
  measure[0] = r.T1;
  measure[1] = r.T2;
  measure[2] = r.asymmetry;
  measure[3] = r.asymmetry_signed;
  return status == LAB_DATA ? LAB_OK : status;
}

/* One figure in one law, and the smallest and the largest of each measure; gaps do not count. */
static int vary(const study_cell *c, int which, table *figure, table *influence, lab_error *error)
{
  const study_range range = range_of(c->s, which);
  double low[MEASURES] = {NAN, NAN, NAN, NAN}, high[MEASURES] = {NAN, NAN, NAN, NAN};
  int i, k;
  for (i = 0; i < range.points; i++) {
    const double value = value_at(&range, i);
    double m[MEASURES];
    if (measure_point(c, which, value, m, error))
      return error->status;
    for (k = 0; k < MEASURES; k++) {
      low[k] = fmin(low[k], m[k]);
      high[k] = fmax(high[k], m[k]);
    }
    if (c->actuator == c->s->subject)
      table_row(figure, "gssgggg", value * hypotheses[which].scale, c->gas, c->flow, m[0], m[1], m[2], m[3]);
  }
  table_row(influence, "ssssgggggggg", c->rig->name, hypotheses[which].name, c->gas, c->flow, low[0], high[0], low[1],
            high[1], low[2], high[2], low[3], high[3]);
  return LAB_OK;
}

static int sweep_rows(const study_cell *c, table *t, lab_error *error)
{
  int which;
  for (which = 0; which < VARIED; which++)
    if (vary(c, which, &t[which], &t[INFLUENCE], error))
      return error->status;
  return LAB_OK;
}

static const char figure_header[] = "variable,gas,flow,T1_s,T2_s,asymmetry,asymmetry_signed";

const study_tables sweeps = {{STUDY_SUBJECT_AND_TWIN, STUDY_EVERY_LAW},
                             sweep_rows,
                             {{"fig15.csv", figure_header, STUDY_BY_ROW, STUDY_WHOLE, 0},
                              {"fig16.csv", figure_header, STUDY_BY_ROW, STUDY_WHOLE, 0},
                              {"fig17.csv", figure_header, STUDY_BY_ROW, STUDY_WHOLE, 0},
                              {"fig18.csv", figure_header, STUDY_BY_ROW, STUDY_WHOLE, 0},
                              {"fig19.csv", figure_header, STUDY_BY_ROW, STUDY_WHOLE, 0},
                              {"influence.csv",
                               "actuator,hypothesis,gas,flow,T1_min_s,T1_max_s,T2_min_s,T2_max_s,asymmetry_min,"
                               "asymmetry_max,asymmetry_signed_min,asymmetry_signed_max",
                               STUDY_BY_ROW, STUDY_WHOLE, 0}}};

/* ---- Verdicts ---- */

/* A model without one cause, or with HYPOTHESES, whole. */
static int measure(const lab_rig *rig, const pneu_laws *laws, int cause, lab_asymmetry *r, lab_error *error)
{
  pneu_params p = rig->params;
  pneu_laws own = *laws;
  hypothesis_without(cause, &p, &own);
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

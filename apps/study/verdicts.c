#include "verdicts.h"

#include <math.h>
#include <stdio.h>

#include "stroke.h"

/* A model with the causes of a bit set taken away; the spring last, for the others reckon with its rate. */
static int measure(const lab_rig *rig, int gas, int flow, int taken, lab_asymmetry *r, lab_error *error)
{
  pneu_params p = rig->params;
  pneu_laws laws = study_laws(rig, gas, flow);
  int c;
  for (c = REMOVALS - 1; c >= 0; c--)
    if (taken >> c & 1)
      removals[c].apply(&p, &laws);
  return stroke_measure(&p, &laws, r, error);
}

static int is_necessary(const verdicts_law *law, int cause, double below)
{
  return law->without[cause] < below * law->base;
}

static int necessary_causes(const verdicts_law *law, double below)
{
  int c, set = 0;
  for (c = 0; c < REMOVALS; c++)
    set |= is_necessary(law, c, below) << c;
  return set;
}

int verdicts_measure(const lab_rig *rig, int gas, int flow, double below, verdicts_law *out, lab_error *error)
{
  lab_asymmetry r;
  int c, needed;
  if (measure(rig, gas, flow, 0, &r, error))
    return error->status;
  out->base = r.asymmetry;
  out->base_ratio = r.duration_ratio;
  for (c = 0; c < REMOVALS; c++) {
    if (measure(rig, gas, flow, 1 << c, &r, error))
      return lab_fail_in(error, "%s without its cause", removals[c].hypothesis);
    out->without[c] = r.asymmetry;
    out->without_ratio[c] = r.duration_ratio;
  }
  needed = necessary_causes(out, below);
  for (c = 0; c < REMOVALS; c++) {
    out->alone[c] = (double)NAN;
    if (!(needed >> c & 1))
      continue;
    if (measure(rig, gas, flow, needed & ~(1 << c), &r, error))
      return lab_fail_in(error, "%s alone", removals[c].hypothesis);
    out->alone[c] = r.asymmetry;
  }
  return LAB_OK;
}

const char *verdicts_text(const verdicts_law *law, int cause, double below)
{
  if (fabs(law->without[cause] - law->base) < 1e-6 * law->base)
    return "not confirmed: nothing to take away";
  if (!is_necessary(law, cause, below))
    return "not confirmed";
  if (law->alone[cause] < below * law->base)
    return "confirmed as necessary; alone it makes no asymmetry";
  return "confirmed";
}

static void add_row(table *t, int cause, int gas, int flow, const verdicts_law *law, double below)
{
  table_row(t, "sssggggs", removals[cause].hypothesis, pneu_gas_key(gas), pneu_flow_key(flow), law->base,
            law->without[cause], law->base_ratio, law->without_ratio[cause], verdicts_text(law, cause, below));
}

static int add_rows(table *t, const study *s, const lab_rig *rig, lab_error *error)
{
  verdicts_law law[STUDY_LAW_MAX * STUDY_LAW_MAX];
  const int laws = s->n_gas * s->n_flow;
  int c, i;
  for (i = 0; i < laws; i++)
    if (verdicts_measure(rig, s->gas[i / s->n_flow], s->flow[i % s->n_flow], s->confirmed_below, &law[i], error))
      return error->status;
  for (c = 0; c < REMOVALS; c++)
    for (i = 0; i < laws; i++)
      add_row(t, c, s->gas[i / s->n_flow], s->flow[i % s->n_flow], &law[i], s->confirmed_below);
  return LAB_OK;
}

static int verdict_table(const study *s, int actuator, lab_error *error)
{
  const lab_rig *rig = &s->actuator[actuator];
  char name[LAB_NAME_TEXT + 32] = "hypotheses.csv";
  int status;
  table t;
  table_open(&t, "hypothesis,gas,flow,asymmetry_base,asymmetry_without_cause,duration_ratio_base,"
                 "duration_ratio_without_cause,verdict");
  status = add_rows(&t, s, rig, error);
  if (actuator != s->subject)
    snprintf(name, sizeof name, "hypotheses_%s.csv", rig->name);
  if (status == LAB_OK)
    status = study_save(s, name, &t, error);
  table_close(&t);
  return status;
}

int verdicts_make(const study *s, lab_error *error)
{
  int i, status = LAB_OK;
  for (i = 0; i < s->n_actuators && status == LAB_OK; i++)
    status = verdict_table(s, i, error);
  return status;
}

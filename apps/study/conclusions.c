#include "conclusions.h"

#include <math.h>
#include <stdlib.h>

/* Words are numbers once and for all (PAPER.md 1): "approximately", "roughly", "constant" are 10 %, "does not
 * depend" is 1 %, "mainly" an exponent of at most 1/2. */
const conclusion conclusions[CONCLUSIONS] = {
    {1, "slope of ln v over ln P, up", -1.1, -0.9, conclusion_inverse},
    {2, "largest over smallest v, up", 1.1, HUGE_VAL, conclusion_rise_range},
    {3, "largest over smallest v(5 %)/p_s over the supplies, up", -HUGE_VAL, 1.1, conclusion_supply},
    {4, "v at the end of the rise over v(5 %)", -HUGE_VAL, 0.1, conclusion_last_rise},
    {5, "largest over smallest v with P_a/P lowered to 0.01, down", -HUGE_VAL, 1.1, conclusion_vacuum},
    {6, "difference between changes of v in one range of pressure, down", -HUGE_VAL, 0.01, conclusion_fixed_range},
    {7, "largest over smallest v, down", -HUGE_VAL, 1.1, conclusion_fall_range},
    {8, "d ln v_max/d ln p_s, down", -HUGE_VAL, 0.5, conclusion_fall_supply},
    {9, "v at the end of the fall over the largest", 0.01, HUGE_VAL, conclusion_last_fall},
    {10, "largest over smallest v, down", -HUGE_VAL, 1.41421356, conclusion_fall_range},
    {11, "difference of 1 - v(5 %)/v(95 %) between actuators, down", -HUGE_VAL, 0.01, conclusion_fall_change},
    {12, "smallest v down over largest v up", -HUGE_VAL, 1, conclusion_first_over},
    {13, "smallest v up over largest v down", -HUGE_VAL, 1, conclusion_last_over},
    {14, "p/p_s above which the fall is faster", -HUGE_VAL, 0.618, conclusion_crossing},
    {15, "asymmetry at equal durations over that at the nominal bench set", -HUGE_VAL, 0.1, conclusion_symmetric},
    {16, "part of the stroke made where v is largest", -HUGE_VAL, 0.1, conclusion_fastest},
    {17, "efficiency without friction", -HUGE_VAL, 0.5, conclusion_largest_efficiency},
    {18, "efficiency of a loaded cycle with friction", -HUGE_VAL, 0.5, conclusion_efficiency}};

enum { VERDICT_TEXT = FINDING_TEXT + 32, EVIDENCE_TEXT = 3 * FINDING_TEXT };

/* All findings under one pair of laws. */
static int try_law(const study *s, int gas, int flow, finding found[CONCLUSIONS], lab_error *error)
{
  conclusion_trial *t = malloc(sizeof *t);
  int i, status;
  if (!t)
    return lab_fail_memory(error, "the conclusions");
  status = conclusion_trial_run(s, gas, flow, t, error);
  for (i = 0; i < CONCLUSIONS && status == LAB_OK; i++)
    if ((status = conclusions[i].measure(t, &conclusions[i], &found[i], error)) != LAB_OK)
      lab_fail_in(error, "conclusion %d", conclusions[i].number);
  free(t);
  return status == LAB_OK ? LAB_OK : lab_fail_in(error, "%s, %s", pneu_gas_key(gas), pneu_flow_key(flow));
}

static int try_laws(const study *s, finding *found, lab_error *error)
{
  const int laws = s->n_gas * s->n_flow;
  int law, worst = laws, status = LAB_OK;
#pragma omp parallel for schedule(dynamic, 1)
  for (law = 0; law < laws; law++) {
    lab_error mine;
    const int at =
        try_law(s, s->gas[law / s->n_flow], s->flow[law % s->n_flow], found + (size_t)law * CONCLUSIONS, &mine);
    if (at != LAB_OK) {
#pragma omp critical(conclusions_error)
      if (law < worst) /* the first in order, whichever thread was first */
        *error = mine, status = at, worst = law;
    }
  }
  return status;
}

static void add_row(const study *s, const conclusion *c, int law, const finding *f, table *t)
{
  char verdict[VERDICT_TEXT], evidence[EVIDENCE_TEXT], number[8];
  finding_verdict_text(f, finding_judge(f, c->low, c->high), verdict, sizeof verdict);
  finding_evidence(f, c->what, c->low, c->high, evidence, sizeof evidence);
  snprintf(number, sizeof number, "%d", c->number);
  table_row(t, "sssss", number, pneu_gas_key(s->gas[law / s->n_flow]), pneu_flow_key(s->flow[law % s->n_flow]), verdict,
            evidence);
}

int conclusions_table(const study *s, table *t, lab_error *error)
{
  const int laws = s->n_gas * s->n_flow;
  finding *found = calloc((size_t)laws * CONCLUSIONS, sizeof *found);
  int i, law, status;
  table_open(t, "conclusion,gas,flow,verdict,evidence");
  if (!found)
    return lab_fail_memory(error, "the conclusions");
  status = try_laws(s, found, error);
  for (i = 0; i < CONCLUSIONS && status == LAB_OK; i++)
    for (law = 0; law < laws; law++)
      add_row(s, &conclusions[i], law, &found[law * CONCLUSIONS + i], t);
  free(found);
  return status;
}

int conclusions_make(const study *s, lab_error *error)
{
  table t;
  int status = conclusions_table(s, &t, error);
  if (status == LAB_OK)
    status = study_save(s, "conclusions.csv", &t, error);
  table_close(&t);
  return status;
}

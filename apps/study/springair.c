#include "springair.h"

#include "removals.h"
#include "speeds.h"

/* What is taken away in each row. With neither there a breath of air would do for the whole stroke. */
static const struct {
  int spring, air; /* 1: there */
} rows[] = {{1, 1}, {0, 1}, {1, 0}};

enum { ROWS = sizeof rows / sizeof *rows };

static int add_row(table *t, const lab_rig *rig, int gas, int flow, int spring, int air, lab_error *error)
{
  pneu_params p = rig->params;
  pneu_laws laws = study_laws(rig, gas, flow);
  speed_pair pair;
  if (!spring)
    removals[REMOVE_SPRING].apply(&p, &laws);
  if (!air)
    removals[REMOVE_AIR_PROCESS].apply(&p, &laws);
  if (speeds_measure(&p, &laws, &pair, error))
    return lab_fail_in(error, "%s, %s, %s", rig->name, pneu_gas_key(gas), pneu_flow_key(flow));
  table_row(t, "sssgggggg", rig->name, pneu_gas_key(gas), pneu_flow_key(flow), (double)spring, (double)air,
            pair.shape.asymmetry, pair.shape.duration_ratio, speed_max(&pair.up) / speed_min(&pair.up),
            speed_max(&pair.down) / speed_min(&pair.down));
  return LAB_OK;
}

static int add_law(table *t, const lab_rig *rig, int gas, int flow, lab_error *error)
{
  int i, status = LAB_OK;
  for (i = 0; i < ROWS && status == LAB_OK; i++)
    status = add_row(t, rig, gas, flow, rows[i].spring, rows[i].air, error);
  return status;
}

int springair_make(const study *s, lab_error *error)
{
  int a, g, f, status = LAB_OK;
  table t;
  table_open(&t, "actuator,gas,flow,spring,air,asymmetry,duration_ratio,rise_speed_ratio,fall_speed_ratio");
  for (a = 0; a < s->n_actuators && status == LAB_OK; a++)
    for (g = 0; g < s->n_gas && status == LAB_OK; g++)
      for (f = 0; f < s->n_flow && status == LAB_OK; f++)
        status = add_law(&t, &s->actuator[a], s->gas[g], s->flow[f], error);
  if (status == LAB_OK)
    status = study_save(s, "spring_and_air.csv", &t, error);
  table_close(&t);
  return status;
}

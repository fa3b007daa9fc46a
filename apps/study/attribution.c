#include "attribution.h"

#include <math.h>
#include <stdio.h>

#include "stroke.h"

/* The causes. With all of them present the model is the nozzle flow with the chamber law of the row. */
enum { DENSITY, VOLUME, CHOKING, TEMPERATURE, PLACE, CAUSES, CELLS = 1 << CAUSES };

static const char *const cause_names[CAUSES] = {"flow depends on upstream density", "volume grows with travel",
                                                "choking", "temperature changes",
                                                "place of the bench set in the supply range"};

/* Flow law with and without density and choking. */
static int flow_law(int present)
{
  const int choked = present >> CHOKING & 1;
  if (present >> DENSITY & 1)
    return choked ? PNEU_FLOW_CHOKED : PNEU_FLOW_PAPER;
  return choked ? PNEU_FLOW_LINEAR_CHOKED : PNEU_FLOW_LINEAR;
}

/* Asymmetry with the causes of a bit set present and the others taken away. */
static int cell(const lab_rig *rig, int gas, int present, double *asymmetry, lab_error *error)
{
  pneu_params p = rig->params;
  pneu_laws laws = study_laws(rig, present >> TEMPERATURE & 1 ? gas : PNEU_GAS_ISOTHERMAL, flow_law(present));
  lab_asymmetry r;
  if (!(present >> VOLUME & 1)) {
    p.dead_volume += p.area * p.stroke / 2;
    p.swept_ratio = 0;
  }
  if (!(present >> PLACE & 1))
    p.spring_preload = p.supply_pressure / 2 * p.area / p.spring_rate - p.stroke / 2;
  if (stroke_measure(&p, &laws, &r, error))
    return error->status;
  *asymmetry = r.asymmetry;
  return LAB_OK;
}

static int all_cells(const lab_rig *rig, int gas, double *f, lab_error *error)
{
  int i, status = LAB_OK;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < CELLS; i++) {
    lab_error mine;
    const int at = cell(rig, gas, i, &f[i], &mine);
    if (at != LAB_OK) {
#pragma omp critical(attribution_error)
      *error = mine, status = at;
    }
  }
  return status;
}

static int members(int set)
{
  int n = 0;
  for (; set; set &= set - 1)
    n++;
  return n;
}

static double factorial(int n)
{
  return n < 2 ? 1 : n * factorial(n - 1);
}

/* Shapley 1953: mean gain by a cause over all orders in which the causes can be added. */
static double shapley(const double *f, int cause)
{
  double sum = 0;
  int set;
  for (set = 0; set < CELLS; set++) {
    const int k = members(set);
    if (!(set >> cause & 1))
      sum += factorial(k) * factorial(CAUSES - k - 1) / factorial(CAUSES) * (f[set | 1 << cause] - f[set]);
  }
  return sum;
}

/* A share sums up; alone and without show how the causes work against each other inside it. */
static void share_rows(table *t, int gas, const double *f)
{
  const double whole = f[CELLS - 1];
  int i;
  for (i = 0; i < CAUSES; i++)
    table_row(t, "ssgggg", pneu_gas_key(gas), cause_names[i], shapley(f, i) / whole, shapley(f, i), f[1 << i],
              f[(CELLS - 1) & ~(1 << i)]);
  table_row(t, "ssgggg", pneu_gas_key(gas), "remainder", f[0] / whole, f[0], f[0], f[0]);
}

static void cell_rows(table *t, int gas, const double *f)
{
  int set;
  for (set = 0; set < CELLS; set++)
    table_row(t, "sgggggg", pneu_gas_key(gas), (double)(set & 1), (double)(set >> VOLUME & 1),
              (double)(set >> CHOKING & 1), (double)(set >> TEMPERATURE & 1), (double)(set >> PLACE & 1), f[set]);
}

static int attribution_of(const study *s, int actuator, lab_error *error)
{
  const lab_rig *rig = &s->actuator[actuator];
  const int first = actuator == s->subject;
  char shares_name[LAB_NAME_TEXT + 32] = "attribution.csv", cells_name[LAB_NAME_TEXT + 32] = "attribution_cells.csv";
  double f[CELLS];
  int i, status = LAB_OK;
  table shares, cells;
  if (!first) {
    snprintf(shares_name, sizeof shares_name, "attribution_%s.csv", rig->name);
    snprintf(cells_name, sizeof cells_name, "attribution_cells_%s.csv", rig->name);
  }
  table_open(&shares, "gas,cause,share,shapley,asymmetry_alone,asymmetry_without");
  table_open(&cells, "gas,density,volume,choking,temperature,place,asymmetry");
  for (i = 0; i < s->n_gas && status == LAB_OK; i++) {
    status = all_cells(rig, s->gas[i], f, error);
    if (status == LAB_OK) {
      share_rows(&shares, s->gas[i], f);
      cell_rows(&cells, s->gas[i], f);
    }
  }
  if (status == LAB_OK)
    status = study_save(s, shares_name, &shares, error);
  if (status == LAB_OK)
    status = study_save(s, cells_name, &cells, error);
  table_close(&shares);
  table_close(&cells);
  return status;
}

int attribution_make(const study *s, lab_error *error)
{
  int i, status = LAB_OK;
  for (i = 0; i < s->n_actuators && status == LAB_OK; i++)
    status = attribution_of(s, i, error);
  return status;
}

/* Which part of the air process makes the asymmetry: every combination of its causes, and the Shapley share of each. */
#include "products.h"
#include "hypotheses.h"
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
  return choked ? LINEAR_CHOKED_FLOW : LINEAR_FLOW;
}

/* The strokes with the causes of a bit set present and the others taken away. */
static int measure(const study_cell *c, int present, lab_asymmetry *r, lab_error *error)
{
  pneu_params p = c->rig->params;
  const int gas = present >> TEMPERATURE & 1 ? c->laws.gas : PNEU_GAS_ISOTHERMAL;
  pneu_laws laws = study_laws(c->rig, gas, flow_law(present));
  if (!(present >> VOLUME & 1)) {
    p.dead_volume += p.area * p.stroke / 2;
    p.swept_ratio = 0;
  }
  if (!(present >> PLACE & 1))
    hypothesis_without(H4_BENCH_OFFSET, &p, &laws);
  return stroke_measure(&p, &p, &laws, r, error);
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

/* Shapley 1953: mean gain of the signed asymmetry by a cause over all orders in which the causes can be added. */
static double shapley(const lab_asymmetry *f, int cause)
{
  double sum = 0;
  int set;
  for (set = 0; set < CELLS; set++) {
    const int k = members(set);
    if (!(set >> cause & 1))
      sum += factorial(k) * factorial(CAUSES - k - 1) / factorial(CAUSES) *
             (f[set | 1 << cause].asymmetry_signed - f[set].asymmetry_signed);
  }
  return sum;
}

/* A share sums up; alone and without show how the causes work against each other inside it. */
static void add_share(table *t, const char *gas, const char *cause, double value, double whole,
                      const lab_asymmetry *alone, const lab_asymmetry *without)
{
  table_row(t, "ssgggggg", gas, cause, value / whole, value, alone->asymmetry, without->asymmetry,
            alone->asymmetry_signed, without->asymmetry_signed);
}

enum { SHARES, COMBINATIONS };

static int attribution_rows(const study_cell *c, table *t, lab_error *error)
{
  lab_asymmetry f[CELLS];
  double whole;
  int i, set;
  for (set = 0; set < CELLS; set++) {
    if (measure(c, set, &f[set], error))
      return error->status;
    table_row(&t[COMBINATIONS], "sggggggg", c->gas, (double)(set & 1), (double)(set >> VOLUME & 1),
              (double)(set >> CHOKING & 1), (double)(set >> TEMPERATURE & 1), (double)(set >> PLACE & 1),
              f[set].asymmetry, f[set].asymmetry_signed);
  }
  whole = f[CELLS - 1].asymmetry_signed;
  for (i = 0; i < CAUSES; i++)
    add_share(&t[SHARES], c->gas, cause_names[i], shapley(f, i), whole, &f[1 << i], &f[(CELLS - 1) & ~(1 << i)]);
  add_share(&t[SHARES], c->gas, "remainder", f[0].asymmetry_signed, whole, &f[0], &f[0]);
  return LAB_OK;
}

const study_tables attribution = {
    {STUDY_ALL, STUDY_GAS_LAWS},
    attribution_rows,
    {[SHARES] = {"attribution",
                 "gas,cause,share,shapley,asymmetry_alone,asymmetry_without,asymmetry_signed_alone,"
                 "asymmetry_signed_without",
                 STUDY_BY_CELL, STUDY_ACTUATOR_FILE, 0},
     [COMBINATIONS] = {"attribution_cells", "gas,density,volume,choking,temperature,place,asymmetry,asymmetry_signed",
                       STUDY_BY_CELL, STUDY_ACTUATOR_FILE, 0}}};

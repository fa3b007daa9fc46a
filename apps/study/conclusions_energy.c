/* Conclusions 17 and 18: work that is measured, over energies that the paper and thermodynamics give to the air. */
#include <math.h>

#include "conclusions_measure.h"
#include "loadcycle.h"

static const double margin = 0.01; /* force that moves a loaded stem, over supply pressure times area */

/* The paper's energy of the entering air, A p_s x_n [B, Eq. 43]. */
static double paper_energy(const pneu_params *p)
{
  return p->area * p->supply_pressure * p->stroke;
}

/* What an isothermal machine could draw from air at supply pressure. */
static double exergy(const pneu_params *p, double air)
{
  return air * p->gas_constant * p->ambient_temperature * log(1 + p->supply_pressure / p->ambient_pressure);
}

static int loaded(const conclusion_trial *t, int a, const pneu_params *p, load_cycle *cycle, lab_error *error)
{
  const lab_rig *rig = &t->s->actuator[a];
  const pneu_laws laws = study_laws(rig, t->gas, t->flow);
  return load_cycle_run(p, &laws, margin, cycle, error) ? lab_fail_in(error, "%s", rig->name) : LAB_OK;
}

/* The actuator on the springs of its bench set, without friction. */
static pneu_params ideal(const conclusion_trial *t, int a)
{
  pneu_params p = bench_params(&t->s->actuator[a].params, t->scan[a].low, t->scan[a].width);
  p.dry_friction = 0;
  return p;
}

int conclusion_largest_efficiency(const conclusion_trial *t, const struct conclusion *c, finding *f, lab_error *error)
{
  int a;
  (void)c;
  finding_note(f, "over A p_s x_n; loaded, over the isothermal exergy of the air taken in ");
  for (a = 0; a < t->n; a++) {
    const lab_rig *rig = &t->s->actuator[a];
    const pneu_laws laws = study_laws(rig, t->gas, t->flow);
    const pneu_params p = ideal(t, a);
    load_cycle cycle;
    speed_pair idle;
    double work;
    if (speeds_measure(&p, &laws, &idle, error) || loaded(t, a, &p, &cycle, error))
      return error->status;
    work = cycle.work_up + cycle.work_down;
    finding_add(f, 1 - idle.returned / paper_energy(&p), "%s idle, 1 - E_o/E_i", rig->name);
    finding_add(f, work / paper_energy(&p), "loaded both ways");
    finding_note(f, "%s%.3g", a ? ", " : "", work / exergy(&p, cycle.air));
  }
  return LAB_OK;
}

int conclusion_efficiency(const conclusion_trial *t, const struct conclusion *c, finding *f, lab_error *error)
{
  int a;
  (void)c;
  for (a = 0; a < t->n; a++) {
    const pneu_params p = t->s->actuator[a].params;
    load_cycle cycle;
    if (loaded(t, a, &p, &cycle, error))
      return error->status;
    finding_add(f, (cycle.work_up + cycle.work_down) / paper_energy(&p), "%s", t->s->actuator[a].name);
    finding_note(f, "%s%.3g J up and %.3g J down of %.3g J", a ? ", " : "", cycle.work_up, cycle.work_down,
                 paper_energy(&p));
  }
  return LAB_OK;
}

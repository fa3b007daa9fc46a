#include "drive.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "nuisance.h"

/* Add to what all runs have, within the bounds. */
static void apply_change(const lab_unknown *x, double value, lab_rig *rig)
{
  const pneu_param_info info = lab_param_info(x->index);
  pneu_real *at;
  if (x->index == LAB_PARAM_ORIFICE_AREA) {
    rig->params.fill_area *= 1 + (pneu_real)value;
    rig->params.vent_area *= 1 + (pneu_real)value;
    return;
  }
  at = pneu_param_at(&rig->params, x->index);
  *at = (pneu_real)fmin(fmax((double)*at + value, (double)info.lower), (double)info.upper);
}

void lab_unknown_apply(const lab_unknown *x, double value, const pneu_params *declared, lab_rig *rig)
{
  if (x->kind == LAB_UNKNOWN_KNOT) {
    rig->term[x->term].value[x->index] = (pneu_real)value;
  } else if (x->kind == LAB_UNKNOWN_ONSET) {
    rig->onset[x->index].value = value;
  } else if (x->kind == LAB_UNKNOWN_SINCE) {
    rig->onset[x->index].from = value;
  } else if (x->kind == LAB_UNKNOWN_PERIOD) {
    rig->term[x->term].to = rig->term[x->term].from + (pneu_real)value;
  } else if (x->kind == LAB_UNKNOWN_PARAM && x->index == LAB_PARAM_ORIFICE_AREA) {
    rig->params.fill_area = declared->fill_area * (pneu_real)value;
    rig->params.vent_area = declared->vent_area * (pneu_real)value;
  } else if (x->kind == LAB_UNKNOWN_PARAM) {
    *pneu_param_at(&rig->params, x->index) = (pneu_real)value;
  } else if (x->kind == LAB_UNKNOWN_CHANGE) {
    apply_change(x, value, rig);
  }
}

int lab_unknown_acts(const lab_unknown *x, int e)
{
  return x->run == LAB_ALL_RUNS || (x->kind == LAB_UNKNOWN_CHANGE ? e >= x->run : e == x->run);
}

/* How early one unknown has the changes of command of its experiment. */
static void early_of(const lab_unknown *x, double value, const lab_run *e, double *early)
{
  size_t i;
  if (x->kind != LAB_UNKNOWN_INSTANT)
    return;
  if (x->index != LAB_ALL_INSTANTS)
    early[x->index] = value;
  for (i = 0; x->index == LAB_ALL_INSTANTS && i < e->n_instants; i++)
    early[i] = value * e->bracket[i];
}

/* The instants within a run at which a change begins or ends, in order, each once.  Returns: their number */
static int cuts_of(const lab_unknowns *u, int e, double cut[LAB_EPISODES_MAX - 1])
{
  int j, k, side, n = 0;
  for (j = 0; j < u->n; j++)
    for (side = 0; side < 2 && u->unknown[j].kind == LAB_UNKNOWN_CHANGE && lab_unknown_acts(&u->unknown[j], e);
         side++) {
      const double at = side ? u->unknown[j].to : u->unknown[j].from;
      for (k = 0; k < n && cut[k] < at; k++)
        ;
      if (!isfinite(at) || n == LAB_EPISODES_MAX - 1 || (k < n && cut[k] == at))
        continue;
      memmove(cut + k + 1, cut + k, (size_t)(n - k) * sizeof *cut);
      cut[k] = at;
      n++;
    }
  return n;
}

/* Apply what acts in a run from an instant on: first what is its own, then what is added to that. */
static void apply_from(const lab_unknowns *u, const double *theta, int e, double from, lab_rig *rig)
{
  int j, change;
  for (change = 0; change < 2; change++)
    for (j = 0; j < u->n; j++) {
      const lab_unknown *x = &u->unknown[j];
      if (x->run == LAB_ALL_RUNS || !lab_unknown_acts(x, e) || (x->kind == LAB_UNKNOWN_CHANGE) != change)
        continue;
      if (!change || (x->from <= from && from < x->to))
        lab_unknown_apply(x, theta[j], &u->declared, rig);
    }
}

void lab_drive_close(lab_drive *d)
{
  free(d->early);
  free(d->rig);
}

int lab_drive_open(const lab_unknowns *u, const lab_rig *model, const double *theta, int e, lab_drive *d,
                   lab_error *error)
{
  const lab_run *x = &u->run[e];
  double cut[LAB_EPISODES_MAX - 1];
  int j, k;
  d->n = 1 + cuts_of(u, e, cut);
  d->early = calloc(x->n_instants + 1, sizeof *d->early);
  d->rig = malloc((size_t)d->n * sizeof *d->rig);
  if (!d->early || !d->rig)
    return lab_fail_memory(error, "a schedule");
  for (k = 0; k < d->n; k++) {
    d->episode[k].from = k ? cut[k - 1] : x->log->value[LAB_CHANNEL_TIME][x->first];
    d->episode[k].rig = &d->rig[k];
    d->rig[k] = *model;
    apply_from(u, theta, e, d->episode[k].from, &d->rig[k]);
  }
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].run == e)
      early_of(&u->unknown[j], theta[j], x, d->early);
  for (j = 0; u->nuisance && j < u->nuisance->n; j++)
    if (u->nuisance->of[j].run == e)
      early_of(&u->nuisance->of[j], u->nuisance->of[j].value, x, d->early);
  return LAB_OK;
}

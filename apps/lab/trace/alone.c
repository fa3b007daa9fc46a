#include "alone.h"

#include <stdlib.h>

#include "../base/clock.h"
#include "../rig/tolerance.h"
#include "decide.h"

/* Whether a value is declared to a tolerance and does not vary yet, by itself or by its scale or twin. */
static int is_as_declared(const lab_unknowns *u, int param)
{
  const int is_area = param == PNEU_PARAM_fill_area || param == PNEU_PARAM_vent_area, twin = lab_param_twin(param);
  return lab_param_is_value(param) && lab_tolerance(&u->rig, param) > 0 && lab_unknowns_find(u, param) < 0 &&
         (twin < 0 || lab_unknowns_find(u, twin) < 0) &&
         (!is_area || lab_unknowns_find(u, LAB_PARAM_ORIFICE_AREA) < 0) &&
         (param != LAB_PARAM_ORIFICE_AREA ||
          (lab_unknowns_find(u, PNEU_PARAM_fill_area) < 0 && lab_unknowns_find(u, PNEU_PARAM_vent_area) < 0));
}

/* The declared model with one value let go.
 * In:      steps  as for lab_unknowns_fit */
static int fit_with(const lab_unknowns *declared, int param, int steps, lab_unknowns *u, double *chi2, lab_error *error)
{
  lab_unknown *x;
  *u = *declared;
  u->slopes = NULL; /* those are of fewer unknowns */
  if (lab_unknowns_add(u, param, lab_param_value(&u->rig, param), error))
    return error->status;
  x = &u->unknown[u->n - 1];
  x->prior = x->first = x->value;
  x->tolerance = lab_tolerance(&u->rig, param);
  lab_unknowns_let_go(u, u->n - 1);
  lab_unknowns_view(u, u->window);
  return lab_unknowns_fit(u, steps, chi2, error);
}

int lab_alone_find(const lab_unknowns *declared, lab_unknowns *with, int *any, lab_error *error)
{
  static const double enough = 0.5; /* of chi-square, by judgement */
  lab_unknowns *u = malloc(sizeof *u);
  int param, best = -1, status = u ? LAB_OK : lab_fail_memory(error, "a value alone");
  double least, chi2;
  *any = 0;
  if (status == LAB_OK) {
    *u = *declared;
    status = lab_unknowns_fit(u, 1, &least, error);
  }
  least *= enough;
  for (param = 0; param < LAB_PARAM_COUNT && status != LAB_WORLD && !lab_cpu_is_spent(declared->until); param++) {
    if (!is_as_declared(declared, param))
      continue;
    status = fit_with(declared, param, lab_count(LAB_BRIEF_STEPS), u, &chi2, error);
    if (status == LAB_OK && chi2 < least) {
      best = param;
      least = chi2;
    }
  }
  if (best >= 0 && status != LAB_WORLD)
    *any = fit_with(declared, best, LAB_ROUNDS_ALL, with, &chi2, error) == LAB_OK;
  free(u);
  return status == LAB_WORLD ? status : LAB_OK;
}

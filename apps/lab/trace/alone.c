#include "alone.h"

#include "../base/clock.h"
#include "decide.h"

/* Whether a value is declared to a tolerance and does not vary yet; the factor of both areas, if neither does. */
static int is_as_declared(const lab_unknowns *u, int param)
{
  if (param == LAB_PARAM_ORIFICE_AREA)
    return is_as_declared(u, PNEU_PARAM_fill_area) && is_as_declared(u, PNEU_PARAM_vent_area);
  return lab_param_is_value(param) && lab_unknowns_to_hold(u, &u->rig, param) > 0;
}

/* The declared model with one value free.
 * In:      steps  as for lab_unknowns_fit */
static int fit_with(const lab_unknowns *declared, int param, int steps, lab_unknowns *u, double *chi2, lab_error *error)
{
  *u = *declared;
  u->slopes = NULL; /* those are of fewer unknowns */
  return lab_unknowns_free_value(u, param, error) ? error->status : lab_unknowns_fit(u, steps, chi2, error);
}

/* The value that takes most off chi-square, half of it at least; -1 if there is none.  Returns: LAB_OK, LAB_WORLD */
static int find_value(const lab_unknowns *declared, lab_unknowns *u, int *best, lab_error *error)
{
  static const double enough = 0.5; /* by judgement */
  double least, chi2;
  int param, status;
  *best = -1;
  *u = *declared;
  status = lab_unknowns_fit(u, 1, &least, error);
  if (status != LAB_OK)
    return status == LAB_WORLD ? status : LAB_OK;
  least *= enough;
  for (param = 0; param < LAB_PARAM_COUNT && status != LAB_WORLD && !lab_cpu_is_spent(declared->until); param++) {
    if (!is_as_declared(declared, param))
      continue;
    status = fit_with(declared, param, lab_count(LAB_BRIEF_STEPS), u, &chi2, error);
    if (status == LAB_OK && chi2 < least) {
      *best = param;
      least = chi2;
    }
  }
  return status == LAB_WORLD ? status : LAB_OK;
}

int lab_alone_find(const lab_unknowns *declared, lab_unknowns *with, int *any, lab_error *error)
{
  int best, status = find_value(declared, with, &best, error);
  *any = 0;
  if (status == LAB_OK && best >= 0) {
    double chi2;
    status = fit_with(declared, best, LAB_ROUNDS_ALL, with, &chi2, error);
    *any = status == LAB_OK;
  }
  return status == LAB_WORLD ? status : LAB_OK;
}

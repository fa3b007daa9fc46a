/* A fit in words. */
#include <math.h>

#include "fit.h"

const char *lab_fit_finish_text(int finish)
{
  static const char *const text[] = {"converged", "converged to rounding", "stopped at the allowed count"};
  return finish >= 0 && finish < 3 ? text[finish] : "unknown";
}

const char *lab_fit_state_text(int state)
{
  static const char *const text[] = {"free", "at its lower bound", "at its upper bound", "undetermined"};
  return state >= 0 && state < 4 ? text[state] : "unknown";
}

static void print_param(FILE *file, const lab_fit_param *p, const lab_fit_result *result, int j)
{
  fprintf(file, "  %-24s %12.6g %-8s", p->name, result->theta[j], p->unit);
  if (result->state[j] == LAB_FIT_FREE)
    fprintf(file, " 95 %%: %.6g .. %.6g\n", result->low[j], result->high[j]);
  else
    fprintf(file, " %s\n", lab_fit_state_text(result->state[j]));
}

void lab_fit_print(FILE *file, const lab_fit_problem *problem, const lab_fit_result *result)
{
  int j;
  for (j = 0; j < result->n; j++)
    print_param(file, &problem->param[j], result, j);
  fprintf(file, "  rmse %.4g, reduced chi2 %.4g, %g degrees of freedom, %ld evaluations, %s\n", result->rmse,
          result->reduced_chi2, result->degrees, result->evaluations, lab_fit_finish_text(result->finish));
  if (result->starts > 1)
    fprintf(file, "  %d of %d starts ended here\n", result->agree, result->starts);
  if (result->remark[0])
    fprintf(file, "  %s\n", result->remark);
}

#include "onset_sizes.h"

#include <math.h>
#include <stdlib.h>

#include "../base/clock.h"
#include "../base/quantile.h"

/* By judgement: a declared value falls or grows to these shares of itself, an effect has these shares of its usual
 * size; the best LEADERS are tried at PLACES rows. */
enum { LEADERS = 6, PLACES = 6, SIZES_MAX = 10 };
static const double of_value[] = {0.3, 0.5, 0.7, 0.85, 1.2, 1.5, 2.2, 3.3};
static const double of_effect[SIZES_MAX] = {-4, -2, -1, -0.5, -0.25, 0.25, 0.5, 1, 2, 4};

/* The values that a parameter may have from an onset on; of orifice_area a factor.  Returns: how many */
static int list_values(const lab_rig *rig, const lab_score *score, double value[SIZES_MAX])
{
  const pneu_param_info info = lab_param_info(score->param);
  const double now = lab_param_value(rig, score->param), usual = (double)(info.value - info.neutral);
  const int is_value = score->effect < 0;
  const size_t sizes = is_value ? sizeof of_value / sizeof *of_value : sizeof of_effect / sizeof *of_effect;
  size_t k;
  int n = 0;
  for (k = 0; k < sizes; k++) {
    value[n] = is_value ? now * of_value[k] : now + of_effect[k] * usual;
    n += score->param == LAB_PARAM_ORIFICE_AREA || ((double)info.lower <= value[n] && value[n] <= (double)info.upper);
  }
  return n;
}

int lab_onset_try(const lab_unknowns *model, int param, double from, double value, double *chi2, lab_error *error)
{
  lab_unknowns *u = malloc(sizeof *u);
  int status = u ? LAB_OK : lab_fail_memory(error, "a model");
  if (status == LAB_OK) {
    *u = *model;
    status = isfinite(from) ? lab_unknowns_add_onset(u, param, from, value, error)
                            : lab_unknowns_add(u, param, value, error);
  }
  if (status == LAB_OK) {
    lab_unknowns_take(u);
    status = lab_unknowns_chi2(u, chi2, error);
  }
  if (status != LAB_OK)
    *chi2 = HUGE_VAL;
  free(u);
  return status == LAB_WORLD ? status : LAB_OK;
}

/* Keep the best size of what begins at a row, if it is better than what is known.  Returns: sizes tried */
static int try_sizes(const lab_candidate *frozen, size_t row, lab_score *score, lab_error *all)
{
  const lab_run *x = frozen->u.run;
  const double now = lab_param_value(&frozen->u.rig, score->param);
  double value[SIZES_MAX];
  lab_error error = {LAB_OK, ""};
  const int n = list_values(&frozen->u.rig, score, value);
  int k;
  for (k = 0; k < n && !lab_cpu_is_spent(frozen->u.until); k++) {
    double chi2;
    if (lab_onset_try(&frozen->u, score->param, x->log->value[LAB_CHANNEL_TIME][x->first + row], value[k], &chi2,
                      &error))
      break;
    if (!(frozen->quality.chi2 - chi2 > score->statistic))
      continue;
    score->statistic = frozen->quality.chi2 - chi2;
    score->size = value[k] - now;
    score->onset = row;
  }
  lab_fail_together(all, &error);
  return k;
}

/* Try each score of the first n at one row. */
static int try_at(const lab_candidate *frozen, size_t row, int n, lab_onset_scores *scores, lab_error *error)
{
  int i, tests = 0;
  error->status = LAB_OK;
#pragma omp parallel for schedule(dynamic) reduction(+ : tests)
  for (i = 0; i < n; i++)
    tests += try_sizes(frozen, row, &scores->of[i], error);
  scores->tests += tests;
  qsort(scores->of, (size_t)scores->n, sizeof *scores->of, lab_score_by_statistic);
  return error->status;
}

int lab_onset_sizes_find(lab_candidate *frozen, size_t earliest, size_t latest, lab_onset_scores *scores,
                         lab_error *error)
{
  int i, k, status = lab_unknowns_chi2(&frozen->u, &frozen->quality.chi2, error);
  frozen->quality.values = (double)frozen->u.n_values;
  lab_onset_scores_list(&frozen->u, scores);
  if (status == LAB_OK)
    status = try_at(frozen, latest, scores->n, scores, error);
  for (k = 1; k < PLACES && status == LAB_OK; k++)
    status = try_at(frozen, latest - (latest - earliest) * (size_t)k / (PLACES - 1),
                    scores->n < LEADERS ? scores->n : LEADERS, scores, error);
  for (i = 0; i < scores->n; i++)
    scores->of[i].p_value = lab_chi2_tail(scores->of[i].statistic, 1);
  return status;
}

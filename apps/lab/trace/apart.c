#include "apart.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/format.h"

/* What a rig may begin anew with from log to log. Its areas, springs and friction are its own: where these seem to
 * differ, something acts that depends on what the logs were recorded at. */
static int is_anew(int param)
{
  static const char *const names[] = {"spring_preload",
                                      "external_force",
                                      "ambient_pressure",
                                      "supply_pressure",
                                      "dead_time.dead_time",
                                      "pressure_bias.pressure_bias",
                                      "position_bias.position_bias"};
  size_t i;
  int any = 0;
  for (i = 0; i < sizeof names / sizeof names[0]; i++)
    any |= param == pneu_param_find(names[i]);
  return any;
}

/* The model with its j-th fitted parameter for each log by itself.  Returns: as lab_unknowns_fit */
static int fit_apart(const lab_unknowns *declared, int j, lab_unknowns *u, double *chi2, lab_error *error)
{
  lab_rig rig = declared->rig;
  rig.fit_per_log[j] = 1;
  rig.tolerance[rig.fit[j]] = (double)NAN; /* that of a value in "fit" is no prior */
  if (lab_unknowns_open(&rig, declared->run, declared->n_runs, u, error))
    return error->status;
  u->declared = declared->declared;
  u->until = declared->until;
  return lab_unknowns_fit(u, LAB_ROUNDS_ALL, chi2, error);
}

/* Set apart the parameter by which that takes most off chi-square.
 * In/out:  chi2  of the model
 * Out:     any   whether one takes enough */
static int set_apart(lab_apart *apart, double *chi2, int *any, lab_error *error)
{
  const lab_unknowns before = apart->declared;
  double least = (1 - lab_constant(LAB_DIFFER_SHARE)) * *chi2;
  lab_unknowns *u = malloc(sizeof *u);
  int j, status = u ? LAB_OK : lab_fail_memory(error, "values of each log");
  *any = 0;
  for (j = 0; j < before.rig.n_fit && status != LAB_WORLD; j++) {
    double with;
    if (before.rig.fit_per_log[j] || !is_anew(before.rig.fit[j]))
      continue;
    status = fit_apart(&before, j, u, &with, error);
    if (status != LAB_OK || !(with < least))
      continue;
    apart->declared = *u;
    apart->param[apart->n] = before.rig.fit[j];
    *chi2 = least = with;
    *any = 1;
  }
  apart->n += *any;
  free(u);
  return status == LAB_WORLD ? status : LAB_OK;
}

int lab_apart_find(const lab_unknowns *declared, lab_apart *apart, lab_error *error)
{
  double chi2;
  int any = declared->n_runs > 1 && declared->window == 0, status;
  apart->n = 0;
  apart->declared = *declared;
  status = any ? lab_unknowns_chi2(declared, &chi2, error) : LAB_OK;
  while (status == LAB_OK && any && apart->n < LAB_OWN_MAX && chi2 > (double)apart->declared.n_data)
    status = set_apart(apart, &chi2, &any, error);
  return status == LAB_WORLD ? status : LAB_OK;
}

/* What differs, and in what range. */
static void say(const lab_apart *apart, const lab_unknowns *completed, lab_limitations *limitations)
{
  char name[LAB_PARAM_NAME_TEXT], low_text[LAB_FORMAT_TEXT], high_text[LAB_FORMAT_TEXT];
  int i, j;
  for (i = 0; i < apart->n; i++) {
    const lab_unknown *lowest = NULL, *highest = NULL;
    for (j = 0; j < completed->n; j++) {
      const lab_unknown *x = &completed->unknown[j];
      if (x->kind != LAB_UNKNOWN_PARAM || x->index != apart->param[i])
        continue;
      lowest = lowest && lowest->value < x->value ? lowest : x;
      highest = highest && highest->value > x->value ? highest : x;
    }
    if (lowest)
      lab_limitation(
          limitations,
          "The logs differ in %s, from %s to %s: each has its own, as by \"fit_per_log\" in the rig file. No "
          "log says why.",
          lab_fit_name(apart->param[i], name), lab_format_quantity(lowest->value, lowest->unit, 3, low_text),
          lab_format_quantity(highest->value, highest->unit, 3, high_text));
  }
}

/* The declared model stays what the logs share; that values are of each log is the first that was added to it. */
static void follow_on(const lab_apart *apart, const lab_search_result *shared, lab_search_result *own)
{
  own->before = shared->before;
  own->n_own = apart->n;
  memcpy(own->own, apart->param, sizeof own->own);
  memcpy(own->left[LAB_STAGE_BEFORE], shared->left[LAB_STAGE_BEFORE], sizeof own->left[LAB_STAGE_BEFORE]);
  if (own->n_path == LAB_SEARCH_PATH) /* the last is the one that the search ends with */
    own->path[LAB_SEARCH_PATH - 2] = own->path[--own->n_path];
  memmove(own->path + 1, own->path, (size_t)own->n_path++ * sizeof *own->path);
  own->path[0] = shared->path[0];
  snprintf(own->path[1].name, sizeof own->path[1].name, "values of each log");
  snprintf(own->step[0].name, sizeof own->step[0].name, "values of each log");
}

int lab_apart_search(const lab_apart *apart, const lab_search_options *options, lab_logs *bench,
                     lab_unknowns *completed, lab_search_result *result, lab_error *error)
{
  lab_search_result *own;
  lab_unknowns *u;
  int status;
  if (apart->n == 0 || lab_search_explains(result))
    return LAB_OK;
  own = calloc(1, sizeof *own);
  u = malloc(sizeof *u);
  status = own && u ? LAB_OK : lab_fail_memory(error, "a search with values of each log");
  if (status == LAB_OK) {
    *u = apart->declared;
    u->until = completed->until;
    status = lab_search_run(u, options, own, error);
  }
  if (status == LAB_OK && lab_search_is_better(own, result)) {
    follow_on(apart, result, own);
    *completed = *u;
    *result = *own;
    say(apart, completed, &bench->limitations);
  }
  free(own);
  free(u);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

/* Stems that stick and slip. */
#include "slips.h"

#include <stdlib.h>

#include "contest.h"

/* What was found coarsely, row by row, where that leaves only noise as well: then no slip asked for the coarse view. */
static int see_row_by_row(lab_finding *coarse, lab_error *error)
{
  lab_candidate *rows = malloc(sizeof *rows);
  int status = rows ? LAB_OK : lab_fail_memory(error, "a candidate");
  if (status == LAB_OK) {
    *rows = coarse->best;
    lab_unknowns_view(&rows->u, 0);
    status = lab_candidate_fit(rows, LAB_ROUNDS_ALL, error);
  }
  if (status == LAB_OK && lab_is_noise(&rows->quality)) {
    coarse->best = *rows;
    coarse->result.window = 0;
  }
  free(rows);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

/* Whether friction that falls with speed was found, by which stems stick and slip. Anything else may leave only noise
 * in a coarse view because that sees little, and has to explain the log row by row. */
static int is_of_slips(const lab_candidate *c)
{
  const int falls = pneu_effect_find("stribeck_friction");
  int i, any = 0;
  for (i = 0; i < c->n_found; i++)
    any |= c->found[i].effect >= 0 && c->found[i].effect == falls;
  return any;
}

/* Whether such friction, which the declared model lacks, explains much of what that leaves, from its usual size and one
 * shape after the other.
 * In:      declared  seen coarsely, fitted
 * Out:     with      room */
static int slips_explain_much(const lab_candidate *declared, lab_candidate *with, int *much, lab_error *error)
{
  const int effect = pneu_effect_find("stribeck_friction"), param = effect < 0 ? 0 : pneu_effect_params(effect, NULL);
  lab_score score = {.effect = effect, .param = param, .shape = param + 1};
  const int lacks = effect >= 0 && lab_score_lacks(&declared->u, effect);
  int which, status = LAB_OK;
  *much = 0;
  for (which = 0; lacks && which < LAB_SCORE_SHAPES && status != LAB_WORLD && !*much; which++) {
    *with = *declared;
    score.shape_value = lab_score_shape(&declared->u.rig.params, &score, which);
    status = lab_candidate_add_effect(with, &score, lab_score_usual(&declared->u, param), error);
    if (status == LAB_OK)
      status = lab_candidate_fit(with, lab_count(LAB_BRIEF_STEPS), error);
    *much = status == LAB_OK && !lab_is_poor(&declared->quality, &with->quality);
  }
  return status == LAB_WORLD ? status : LAB_OK;
}

/* Whether a coarse view is worth a search.
 * In/out:  declared  as it is viewed; then fitted */
static int may_slip(lab_candidate *declared, int *may, lab_error *error)
{
  lab_candidate *with = malloc(sizeof *with);
  int status = with ? LAB_OK : lab_fail_memory(error, "a candidate");
  *may = 0;
  if (status == LAB_OK)
    status = lab_candidate_fit(declared, LAB_ROUNDS_ALL, error);
  if (status == LAB_OK)
    status = slips_explain_much(declared, with, may, error);
  free(with);
  return status == LAB_WORLD ? status : LAB_OK;
}

int lab_slips_search(const lab_unknowns *u, const lab_search_options *options, lab_finding *f, int *done,
                     lab_error *error)
{
  lab_finding *coarse = malloc(sizeof *coarse);
  int may = 0, status;
  *done = 0;
  if (!coarse)
    return lab_fail_memory(error, "the search");
  *coarse = *f;
  status = lab_unknowns_sticks_and_slips(u, 0, &coarse->result.window, error);
  if (status == LAB_OK && coarse->result.window > 0)
    status = lab_contest_hold(u, coarse, error) == LAB_WORLD ? LAB_WORLD : LAB_OK;
  if (status == LAB_OK && coarse->result.window > 0 && !lab_is_noise(&f->held->quality)) {
    coarse->declared.u = *u;
    lab_unknowns_view(&coarse->declared.u, coarse->result.window);
    status = may_slip(&coarse->declared, &may, error);
    if (status == LAB_OK && may)
      status = lab_rounds_run(coarse, NULL, NULL, options, error);
    *done = may && status == LAB_OK && lab_is_noise(&coarse->best.quality) && is_of_slips(&coarse->best);
  }
  if (*done) {
    status = see_row_by_row(coarse, error);
    *f = *coarse;
  }
  free(coarse);
  return status;
}

#include "resume.h"

#include "rivals.h"

/* What the logs do not ask for goes, and each effect is put against those that may stand in its place. */
static int put_to_test(lab_candidate *c, lab_error *error)
{
  int changed, status = lab_candidate_drop_needless(c, c->n_found, error);
  return status == LAB_OK && c->n_found > 0 ? lab_rivals_try(c, &changed, error) : status;
}

int lab_resume(const lab_unknowns *u, const lab_search_options *options, lab_finding *begun, lab_finding *whole,
               lab_error *error)
{
  const int any = begun->best.n_found > 0 || lab_candidate_begins(&begun->best);
  lab_candidate *declared = &whole->declared;
  if (put_to_test(&begun->best, error))
    return error->status;
  whole->exact = NULL;
  *declared = any ? begun->declared : begun->best;
  declared->u.run = u->run;
  declared->u.until = begun->best.u.until;
  lab_unknowns_view(&declared->u, 0);
  if (any && lab_candidate_fit(declared, 1, error))
    return error->status;
  return lab_rounds_run(whole, any ? begun : NULL, NULL, options, error);
}

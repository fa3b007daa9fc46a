/* Every extension of a model by one effect. */
#include <stdlib.h>

#include "loop_private.h"
#include "refit.h"
#include "../base/clock.h"

/* Every extension of a model by one effect, with the scan of its residual. */
static int extend_scanned(search *s, const lab_attempt *base, const lab_scan *scan, double start, lab_error *error)
{
  double level;
  lab_trace_result trace;
  int n = 0;
  loop_tell(s, "tracing the residual");
  if (lab_trace_effects(scan, &trace, error))
    return error->status;
  if (s->result->trace.n == 0)
    s->result->trace_s = lab_clock() - start;
  level = trace.tests > 0 ? s->options->alpha / trace.tests : 0;
  if (loop_try_slots_first(s, base, scan, trace.candidate[0].statistic, error))
    return error->status;
  loop_tell(s, "fitting the leaders");
  if (!lab_any_is_noise(s->nameless, 1) && lab_refit_effects(base, &trace, level, s->pool + s->n_pool, &n, error))
    return error->status;
  s->n_pool += n;
  if (s->result->trace.n == 0) {
    s->result->trace = trace;
    s->result->level = level;
  }
  return LAB_OK;
}

int loop_extend(search *s, const lab_attempt *base, lab_error *error)
{
  const double start = lab_clock();
  lab_attempt copy = *base;
  lab_scan scan;
  int status = lab_scan_open(&copy.u, &scan, error);
  if (status == LAB_OK)
    status = extend_scanned(s, base, &scan, start, error);
  lab_scan_close(&scan);
  return status;
}

void loop_rank(search *s)
{
  int i, k, n = 0;
  qsort(s->pool, (size_t)s->n_pool, sizeof *s->pool, lab_attempt_by_bic);
  for (i = 0; i < s->n_pool && s->pool[i].fitted; i++) {
    int again = 0;
    for (k = 0; k < n; k++)
      again |= loop_is_same(&s->pool[k], &s->pool[i]);
    if (again)
      continue;
    if (n != i)
      s->pool[n] = s->pool[i];
    loop_note_step(s->result, &s->pool[n]);
    n++;
  }
  s->n_pool = n;
}

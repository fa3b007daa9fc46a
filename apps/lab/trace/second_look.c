#include "second_look.h"

#include <stdlib.h>

#include "../fit/outliers.h"

/* What the loop makes of a bench. */
typedef struct outcome {
  lab_unknowns declared, completed;
  lab_loop_result result;
} outcome;

/* How much there is to explain or to doubt: each effect counts, what has no name more than all of these, and not to
 * know most. */
static int doubt(const lab_loop_result *result)
{
  static const int of_verdict[] = {0, 0, LAB_LOOP_EFFECTS, 2 * LAB_LOOP_EFFECTS + 1}; /* enum lab_verdict */
  return of_verdict[result->verdict] + result->n_found;
}

/* Whether the values can be accidents. What an effect does comes back with every change of the command, or with every
 * other one, and may last a row where rows are far between. */
static int can_be_accidents(const lab_outliers *out, const lab_bench *bench)
{
  size_t changes = 0;
  int i;
  for (i = 0; i < bench->n; i++)
    changes += bench->experiment[i].n_switches;
  return out->n > 0 && (out->n_soon == 0 || 2 * out->n_soon < changes);
}

static int run_again(const lab_loop_options *options, outcome *o, lab_error *error)
{
  lab_unknowns_view(&o->declared, 0); /* counts the values that are left */
  if (lab_unknowns_fit(&o->declared, LAB_FIT_WHOLE, NULL, error))
    return error->status;
  o->completed = o->declared;
  return lab_loop_run(&o->completed, options, &o->result, error);
}

static void accept(const outcome *o, lab_unknowns *declared, lab_unknowns *completed, lab_loop_result *result)
{
  *declared = o->declared;
  *completed = o->completed;
  *result = o->result;
}

int lab_second_look(const lab_loop_options *options, lab_bench *bench, lab_unknowns *declared, lab_unknowns *completed,
                    lab_loop_result *result, size_t *left_out, lab_error *error)
{
  lab_outliers out = {0};
  outcome *o = NULL;
  int status = LAB_OK;
  *left_out = 0;
  if (doubt(result) == 0 || result->window > 0)
    return LAB_OK;
  status = lab_outliers_take(result->verdict == LAB_VERDICT_UNDECIDED ? completed : declared, bench->log, &out, error);
  if (status == LAB_OK && can_be_accidents(&out, bench) && !(o = malloc(sizeof *o)))
    status = lab_fail_memory(error, "a second look");
  if (o) {
    o->declared = *declared;
    status = run_again(options, o, error);
  }
  if (o && status == LAB_OK && doubt(&o->result) < doubt(result)) {
    accept(o, declared, completed, result);
    lab_remarks_join(&bench->remarks, &out.remarks);
    *left_out = out.n;
  } else {
    lab_outliers_put_back(&out);
  }
  free(o);
  lab_outliers_free(&out);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

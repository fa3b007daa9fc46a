#include "second_look.h"

#include <stdlib.h>

#include "../fit/outliers.h"

/* What the loop makes of a bench. */
typedef struct outcome {
  lab_unknowns declared, completed;
  lab_loop_result result;
} outcome;

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
  if (result->verdict != LAB_VERDICT_UNDECIDED)
    return LAB_OK;
  status = lab_outliers_take(completed, bench->log, &out, error);
  if (status == LAB_OK && out.n > 0 && !(o = malloc(sizeof *o)))
    status = lab_fail_memory(error, "a second look");
  if (o) {
    o->declared = *declared;
    status = run_again(options, o, error);
  }
  if (o && status == LAB_OK && o->result.verdict != LAB_VERDICT_UNDECIDED) {
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

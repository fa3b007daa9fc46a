#include "appraise.h"

#include "tape.h"

static int measure(int (*record)(const lab_unknowns *u, lab_tape *tape, lab_error *error), const lab_unknowns *u,
                   lab_metrics *metrics, lab_error *error)
{
  lab_tape tape;
  int status = record(u, &tape, error);
  if (status == LAB_OK)
    status = lab_metrics_measure(&tape.record, metrics, error);
  lab_tape_close(&tape);
  return status;
}

int lab_appraise(const lab_unknowns *u, lab_metrics *measured, lab_metrics *predicted, lab_error *error)
{
  lab_record none = {0};
  int status = measure(lab_tape_measured, u, measured, error);
  if (status != LAB_OK)
    return status;
  status = measure(lab_tape_predicted, u, predicted, error);
  if (status == LAB_OK || status == LAB_WORLD)
    return status;
  none.command = measured->command;
  none.unfit = error->text;
  return lab_metrics_measure(&none, predicted, error);
}

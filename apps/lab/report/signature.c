#include "signature.h"

#include <math.h>

#include "figures.h"

int lab_signature_make(const lab_rig *rig, lab_signature *s, lab_error *error)
{
  enum { LAST = LAB_SIGNATURE_POINTS - 1 };
  lab_rig last;
  pneu_model model;
  pneu_input input;
  int i, line;
  lab_rig_at(rig, INFINITY, &last);
  if (lab_rig_model(&last, &model, error))
    return error->status;
  if (!(model.p.stroke > 0))
    return lab_fail(error, LAB_DATA, "a vessel has no travel");
  pneu_input_default(&model, &input);
  for (i = 0; i <= LAST; i++) {
    s->x[i] = (double)model.p.stroke * i / LAST;
    for (line = 0; line < LAB_SIGNATURE_LINES; line++)
      s->p[line][i] = (double)pneu_balance_pressure(&model, (pneu_real)s->x[i], &input, line - LAB_SIGNATURE_SPRING);
  }
  s->bench_lower = s->p[LAB_SIGNATURE_SPRING][0];
  s->bench_upper = s->p[LAB_SIGNATURE_SPRING][LAST];
  s->spring_rate = (s->bench_upper - s->bench_lower) * (double)model.p.area / (double)model.p.stroke;
  s->band = s->p[LAB_SIGNATURE_UP][LAST / 2] - s->p[LAB_SIGNATURE_DOWN][LAST / 2];
  return LAB_OK;
}

int lab_signature_models(const lab_report *report, lab_signature_model model[LAB_SIGNATURE_MODELS])
{
  const lab_signature_model all[LAB_SIGNATURE_MODELS] = {{.key = LAB_KEY_SHEET, .rig = report->rig},
                                                         {.key = LAB_KEY_FOUND, .rig = &report->completed->rig},
                                                         {.key = LAB_KEY_BASELINE, .rig = report->baseline}};
  lab_error error;
  int i, n = 0;
  for (i = 0; i < LAB_SIGNATURE_MODELS; i++) {
    model[n] = all[i];
    n += all[i].rig && lab_signature_make(all[i].rig, &model[n].signature, &error) == LAB_OK;
  }
  return n;
}

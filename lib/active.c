/* The active effects of a model at work. */
#include "internal.h"

int pneu_lag_acts(const pneu_model *model, const pneu_real *param)
{
  static const pneu_real shortest = PNEU_C(1e-9);
  (void)model;
  return *param >= shortest;
}

void pneu_add_effects(pneu_terms *t, const pneu_real *y, int stage, int *next, pneu_real *rate)
{
  const pneu_model *model = t->model;
  pneu_real unused[PNEU_EXTRA_MAX];
  const pneu_real *extra = y + 1 + model->thermal;
  if (!rate)
    rate = unused;
  for (; *next < model->n_active; ++*next) {
    const int e = model->active[*next];
    const pneu_effect *effect = pneu_effect_at(e);
    if (effect->stage > stage)
      return;
    if (effect->add)
      effect->add(&model->p.effect[model->param_of[e]], extra + model->state_of[e], t, rate + model->state_of[e]);
  }
}

#include "sampler.h"

#include <math.h>

void lab_sampler_take(lab_sampler *s, const pneu_state *state)
{
  pneu_input now = *s->input;
  now.elapsed += s->t[s->next] - s->origin;
  s->take(s->context, s->next, state, &now);
  s->next++;
}

double lab_sampler_due(const lab_sampler *s)
{
  return s->next < s->n ? s->t[s->next] - s->origin : HUGE_VAL;
}

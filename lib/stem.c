/* The stem: forces and motion. */
#include "stem.h"

void pneu_stem_force(pneu_terms *t)
{
  /* p A - k (x + x0) - external [B, Eq. 2], gauge pressure; friction and viscous terms come apart */
  const pneu_params *p = &t->model->p;
  t->force = (t->p - p->ambient_pressure) * t->area - p->spring_rate * (t->x + p->spring_preload) - p->external_force -
             t->input->force;
  t->friction = p->dry_friction;
}

pneu_real pneu_stem_acceleration(const pneu_terms *t)
{
  /* M x'' = force - c v - F sgn(v); the print has sgn(x) in [B, Eqs. 2-3] */
  const pneu_real dry = t->model->bristle ? t->bristle_force : t->sense * t->friction;
  return (t->force - t->model->viscous * t->v - dry) / t->model->p.moving_mass;
}

pneu_real pneu_stem_holding(const pneu_terms *t)
{
  /* what the balance of forces leaves at the present velocity; at rest dry friction may take any part of it */
  const pneu_real dry = t->model->bristle ? t->bristle_force : t->sense * t->friction;
  return t->force + t->input->force - t->model->viscous * t->v - dry;
}

pneu_real pneu_stem_extension(const pneu_model *model, pneu_real x, int reverse)
{
  return reverse ? model->p.stroke - x : x;
}

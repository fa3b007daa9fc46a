/* The electro-pneumatic transducer: from command to opening to flow. */
#include "internal.h"
#include "transducer.h"

pneu_real pneu_regulator_opening(pneu_real set, pneu_real p, pneu_real band)
{
  const pneu_real opening = (set - p) / band;
  return opening > 1 ? 1 : opening < -1 ? -1 : opening;
}

pneu_real pneu_command_opening(const pneu_terms *t)
{
  const pneu_params *p = &t->model->p;
  if (p->proportional_band > 0)
    return pneu_regulator_opening(t->input->u, t->p - p->ambient_pressure, p->proportional_band);
  return t->input->u;
}

void pneu_transducer_flow(pneu_terms *t)
{
  const pneu_params *p = &t->model->p;
  if (t->opening > 0) {
    t->choked = pneu_exchange(t, t->opening * t->fill_area, t->supply, p->supply_temperature, t->supply_resistance);
    t->drawn = t->mass_in; /* the first flow of all */
  } else if (t->opening < 0)
    t->choked = pneu_exchange(t, -t->opening * t->vent_area, t->exhaust, p->ambient_temperature, t->exhaust_resistance);
}

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
  const pneu_delay *late = pneu_commands(t->input);
  const pneu_real given = late && t->model->command_delay > 0 ? late->acting : t->input->u;
  const pneu_real u = given + t->input->u_rate * t->input->elapsed;
  if (p->proportional_band > 0)
    return pneu_regulator_opening(u, t->p - p->ambient_pressure, p->proportional_band);
  return u;
}

static void flow_through(pneu_terms *t, pneu_real opening)
{
  const pneu_params *p = &t->model->p;
  const pneu_real before = t->mass_in - t->mass_out; /* without effects nobody asks */
  if (opening > 0) {
    t->choked = pneu_exchange(t, opening * t->fill_area, t->supply, p->supply_temperature, &t->supply_line);
    if (PNEU_EFFECT_COUNT > 0)
      t->drawn = t->mass_in - t->mass_out - before;
  } else if (opening < 0)
    t->choked = pneu_exchange(t, -opening * t->vent_area, t->exhaust, p->ambient_temperature, &t->exhaust_line);
}

void pneu_transducer_flow(pneu_terms *t)
{
  flow_through(t, t->opening);
  if (PNEU_EFFECT_COUNT > 0 && t->crossing != 0)
    flow_through(t, t->crossing);
}

void pneu_transducer_at(pneu_terms *t, pneu_real p, pneu_real T)
{
  const pneu_real p_chamber = t->p, T_chamber = t->T;
  t->mass_in = t->mass_out = t->drawn = t->mass_in_T = t->supply_line.lost = 0;
  t->p = p;
  t->T = T;
  pneu_transducer_flow(t);
  t->p = p_chamber;
  t->T = T_chamber;
}

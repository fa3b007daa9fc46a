/* The supply gives way under flow: p_s - p_l = R (1 - c) q + (p_s - p_l) (q/q_o)^2, p_l at the transducer, q_o as of a
 * connecting tube: c = 0 is a regulator's droop, c = 1 a filter, a valve or a line too narrow for the
 * flow. With a volume V between that and the transducer, p_l' = R T_s/V (q - q_transducer); air at the supply's
 * temperature. The state is p_l over the absolute supply pressure; at rest that of the supply. R counts as 1e4 Pa s/kg
 * at least there, as a tube's does. */
#include "../internal.h"

#define LEAST_VOLUME PNEU_C(1e-9) /* [m3]: a smaller one is none */

enum { RESISTANCE, TURBULENCE, VOLUME };

static const pneu_param_info params[] = {
    {"supply_resistance", "Pa.s/kg", 0, PNEU_C(1e10), PNEU_C(1e6), 0, 0, "pressure lost per mass flow drawn"},
    {"supply_turbulence", "1", 0, 1, PNEU_C(0.5), 0, PNEU_FORM_OPTION,
     "share of that, at the full flow of the fill orifice, that grows with the flow"},
    {"supply_volume", "m3", 0, PNEU_C(1e3), PNEU_C(1e-4), 0, PNEU_FORM_OPTION,
     "volume between that and the transducer; 0: none"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  const pneu_params *p = &t->model->p;
  const pneu_real scale = t->model->scale[0], T = p->supply_temperature;
  const pneu_real supply = t->input->supply_pressure + p->ambient_pressure;
  pneu_real q, slope;
  rate[0] = 0;
  if (!(param[VOLUME] >= LEAST_VOLUME) || t->model->law.pressure_input)
    return;
  q = pneu_line_pass(t, param[RESISTANCE], param[TURBULENCE], supply, T, state[0] * scale, T, &slope);
  rate[0] = p->gas_constant * T / (param[VOLUME] * scale) * (q - t->drawn);
}

static void start(const pneu_real *param, const pneu_terms *t, pneu_real *state)
{
  (void)param;
  state[0] = (t->input->supply_pressure + t->model->p.ambient_pressure) / t->model->scale[0];
}

static void prepare(pneu_model *model, const pneu_real *param)
{
  if (param[VOLUME] >= LEAST_VOLUME && !model->law.pressure_input)
    model->supply_line = model->n_extra - 1;
  else
    model->supply_loss = (pneu_line){param[RESISTANCE], param[TURBULENCE], 0, 0};
}

const pneu_effect pneu_effect_record_supply_droop = {
    "supply_droop",
    "The supply pressure falls while air is drawn.",
    "linear regulator droop; Valve Magazine, spring 2008: 10 to 20 % at full travel",
    "mass",
    "filling is slow at first, where flow is largest; venting is right",
    PNEU_STAGE_FEED,
    params,
    .add = add,
    .start = start,
    .prepare = prepare};

const char pneu_effect_sentence_supply_droop[] =
    "The supply gives way: it loses {fill_drop} at the full flow of the fill orifice.";

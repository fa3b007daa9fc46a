/* A tube between transducer and chamber, as a volume V_t next to the transducer and then a restriction:
 * p_t' = R T_a/V_t (q_transducer - q), p_t - p = R_t (1 - c) q + (p_t - p) (q/q_o)^2 into the chamber. q_o is what
 * passes the orifice that by itself would lose R_t c q_f at the full flow q_f of the fill orifice, were that little
 * beside the pressure; it follows the law of the model. Air in the tube has ambient temperature.
 * Air passes the end of the tube both ways while the pressures differ by less than a millionth of the supply's: a stiff
 * flow whose temperature changed at a point would hold the steps short at every rest.
 * The state is p_t over the absolute supply pressure. R_t counts as 1e4 Pa s/kg at least (10 Pa at 1 g/s): with less
 * the two pressures are one to rounding, and the equations stiff for nothing.
 * Size: 12.6 mL/m and 128 mu L/(pi rho d^4) = 8e5 Pa s/kg per metre of 4 mm bore at 3 bar abs; bends and fittings add
 * to it. That is laminar flow, c = 0: it holds below Re = 4 q/(pi d mu) = 2300, which is 0.13 g/s. The fill orifice of
 * the R1-400 passes 1 g/s when choked, Re 18,000, where by Blasius the tube resists eight times as much and in
 * proportion to q^0.75. A kink, a filter or a fitting is an orifice, which resists in proportion to q: c = 1. */
#include "../internal.h"

#define MIXING (PNEU_C(1e-6) + 100 * PNEU_EPS) /* share of full pressure, above its rounding */

enum { RESISTANCE, VOLUME, TURBULENCE };

static const pneu_param_info params[] = {
    {"tube_resistance", "Pa.s/kg", 0, PNEU_C(1e12), PNEU_C(1e7), 0, 0, "pressure lost along the tube per mass flow"},
    {"tube_volume", "m3", PNEU_C(1e-9), PNEU_C(1.0), PNEU_C(2e-5), PNEU_C(2e-5), 1, "volume of the tube"},
    {"tube_turbulence", "1", 0, 1, PNEU_C(0.5), 0, PNEU_FORM_OPTION,
     "share of the resistance, at the full flow of the fill orifice, that grows with the flow"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  const pneu_params *p = &t->model->p;
  const pneu_real scale = t->model->scale[0], p_tube = state[0] * scale;
  pneu_real q, mixing, slope;
  rate[0] = 0;
  if (t->model->law.pressure_input)
    return;
  q = pneu_line_pass(t, param[RESISTANCE], param[TURBULENCE], p_tube, p->ambient_temperature, t->p, t->T, &slope);
  mixing = MIXING * scale * slope;
  pneu_transducer_at(t, p_tube, p->ambient_temperature);
  rate[0] = p->gas_constant * p->ambient_temperature / (param[VOLUME] * scale) * (t->mass_in - t->mass_out - q);
  t->mass_in = (q + PNEU_M(sqrt)(q * q + mixing * mixing)) / 2;
  t->mass_out = t->mass_in - q;
  t->mass_in_T = t->mass_in * p->ambient_temperature;
}

static void start(const pneu_real *param, const pneu_terms *t, pneu_real *state)
{
  (void)param;
  state[0] = t->p / t->model->scale[0];
}

const pneu_effect pneu_effect_record_connecting_tube = {
    "connecting_tube",
    "A tube between transducer and chamber stores air and resists its flow.",
    "Iberall 1950, J. Res. NBS 45:85 (RP2115), lumped into one volume and one resistance; turbulent: Darcy and "
    "Weisbach",
    "mass",
    "pressure starts late and rounded after every change of command, and flow near equal pressures is too slow both "
    "ways",
    PNEU_STAGE_LINE,
    params,
    .add = add,
    .start = start};

const char pneu_effect_sentence_connecting_tube[] = "A tube between transducer and chamber holds up the air: it takes "
                                                    "{fill_drop} at the full flow of the fill orifice.";

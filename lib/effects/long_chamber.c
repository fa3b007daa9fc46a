/* A chamber as long as a tube, in two volumes: p_n' = R T_a/V_n (q_in - q) at the valve, where V_n is l/(1 + l) of the
 * volume V, and the rest at the far end, where the sensor is and p the pressure. Between them the air has inertia and
 * resists: q' = A/L (p_n - p) - f k q, L = l V/A, with k = 32 mu/(rho D^2) of laminar flow and, above, 0.158 mu
 * Re^0.75/(rho D^2) of turbulent flow in a smooth bore (Blasius: lambda = 0.3164 Re^-0.25). The fourth root of the sum
 * of their fourth powers stands for both. Air has ambient temperature on its way.
 * At l = 1 the wave has 0.90 of its true frequency in a tube that is open at its valve and 0.64 in one that is shut at
 * both ends; the pressure lost is 0.82 of what turbulent flow loses that falls evenly towards the closed end, and all
 * of what laminar flow does. While a stem moves L counts as constant. Lengths below a thousandth count as none: the
 * equations are stiff for nothing. It takes the place of a connecting_tube.
 * States: p_n over the absolute supply pressure; q sqrt(R T_a)/A over the same.
 * Size: isothermal sound takes 24 ms to the end of 7 m. Chambers up to 20 times as long as wide count as short. */
#include "../internal.h"

#define LEAST     PNEU_C(1e-3)
#define VISCOSITY PNEU_C(1.82e-5) /* [Pa s] of air at 295 K */

enum { LENGTH, FRICTION };
enum { NEAR, FLOW };

static const pneu_param_info params[] = {
    {"line_length", "1", 0, 3, 1, 0, 0, "length of the line between valve and far end, as a share of the chamber's"},
    {"line_friction", "1", PNEU_C(0.1), 20, 1, 1, 1, "its friction, as a share of a smooth bore's"}};

static pneu_real bore_of(pneu_real area)
{
  return PNEU_M(sqrt)(area) * PNEU_C(1.12837916709551257); /* 2/sqrt(pi) */
}

static int acts(const pneu_model *model, const pneu_real *param)
{
  const pneu_params *p = &model->p;
  return !model->law.pressure_input && param[LENGTH] >= LEAST &&
         p->dead_volume + p->area * p->swept_ratio * p->stroke > 20 * bore_of(p->area) * p->area;
}

/* Rate at which friction takes flow q from itself [1/s], at density rho. */
static pneu_real friction(pneu_real q, pneu_real rho, pneu_real area)
{
  const pneu_real bore = bore_of(area), unit = VISCOSITY / (rho * bore * bore);
  const pneu_real reynolds = PNEU_M(fabs)(q) * bore / (area * VISCOSITY);
  const pneu_real laminar = 32, turbulent = PNEU_C(0.1582) * PNEU_M(pow)(reynolds, PNEU_C(0.75));
  const pneu_real l2 = laminar * laminar, t2 = turbulent * turbulent;
  return unit * PNEU_M(sqrt)(PNEU_M(sqrt)(l2 * l2 + t2 * t2));
}

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  const pneu_params *p = &t->model->p;
  const pneu_real scale = t->model->scale[0], RT = p->gas_constant * p->ambient_temperature, area = t->area;
  const pneu_real unit = area * scale / PNEU_M(sqrt)(RT), p_near = state[NEAR] * scale, q = state[FLOW] * unit;
  const pneu_real share = param[LENGTH] / (1 + param[LENGTH]), length = param[LENGTH] * t->volume / area;
  const pneu_real rho = (p_near + t->p) / (2 * RT);
  pneu_transducer_at(t, p_near, p->ambient_temperature);
  rate[NEAR] = (RT * (t->mass_in - t->mass_out - q) / (t->volume * share) -
                p_near * (t->swept_area * t->v + t->growth) / t->volume) /
               scale;
  rate[FLOW] = (area / length * (p_near - t->p) - param[FRICTION] * friction(q, rho, area) * q) / unit;
  t->mass_in = q > 0 ? q : 0;
  t->mass_out = q > 0 ? 0 : -q;
  t->mass_in_T = t->mass_in * p->ambient_temperature;
  t->volume *= 1 - share;
  t->swept_area *= 1 - share;
  t->growth *= 1 - share;
}

static void start(const pneu_real *param, const pneu_terms *t, pneu_real *state)
{
  (void)param;
  state[NEAR] = t->p / t->model->scale[0];
}

const pneu_effect pneu_effect_record_long_chamber = {
    "long_chamber",
    "The chamber is as long as a tube: its air has inertia and resists on its way to the far end.",
    "staggered cells: Patankar 1980, Numerical Heat Transfer and Fluid Flow; Blasius 1913, Forschungsarb. VDI 131",
    "mass",
    "pressure at the far end starts late, at first too steeply, and swings or lags after every change of command",
    PNEU_STAGE_LINE,
    params,
    .add = add,
    .start = start,
    .acts = acts};

const char pneu_effect_sentence_long_chamber[] =
    "Air takes time along the chamber, {size} of its length: it is late at the far end, and swings there.";

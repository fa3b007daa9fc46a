/* What the library says of an instance's state. */
#include <math.h>

#include "private.h"

/* Hysteresis of the event functions beyond where they stand: above rounding, and far below what can be seen. */
#define SPEED_MARGIN  1e-10 /* of full speed */
#define TRAVEL_MARGIN 1e-12 /* of the stroke */

/* An input on its line, now. */
static double on_line(const fmu_memory *m, int input, int rate)
{
  return m->input[input] + m->input[rate] * (m->time - m->set_at[input]);
}

double fmu_driven_pressure(const fmu_instance *i)
{
  return on_line(&i->m, FMU_INPUT_PRESSURE, FMU_INPUT_PRESSURE_RATE);
}

double fmu_driven_position(const fmu_instance *i)
{
  return fmax(0, fmin(on_line(&i->m, FMU_INPUT_POSITION, FMU_INPUT_VELOCITY), (double)i->m.params.stroke));
}

/* Beyond a stop it rests; a line that ends on one may be beyond by rounding. */
static double driven_velocity(const fmu_instance *i)
{
  const double beyond = on_line(&i->m, FMU_INPUT_POSITION, FMU_INPUT_VELOCITY) - fmu_driven_position(i);
  return fabs(beyond) <= TRAVEL_MARGIN * i->model.scale[2] ? i->m.input[FMU_INPUT_VELOCITY] : 0;
}

double fmu_command(const fmu_instance *i, double u)
{
  return fmu_command_kind(&i->m.params) == FMU_COMMAND_OPENING ? fmax(-1, fmin(1, u)) : u;
}

void fmu_drive(const fmu_instance *i, pneu_input *input)
{
  const fmu_memory *m = &i->m;
  pneu_input_default(&i->model, input);
  input->u = fmu_command(i, m->delay.length > 0 ? fmu_delay_value(&m->delay, m->time) : m->input[FMU_INPUT_U]);
  input->set_position = fmu_command_kind(&m->params) == FMU_COMMAND_POSITION;
  input->supply_pressure = m->input[FMU_INPUT_SUPPLY];
  input->force = m->input[FMU_INPUT_FORCE];
  input->pressure_rate = m->input[FMU_INPUT_PRESSURE_RATE];
  input->position_rate = driven_velocity(i);
}

static void compress(const pneu_model *model, double x, pneu_state *s)
{
  const double ratio = pneu_volume(model, s->x) / pneu_volume(model, x), ambient = model->p.ambient_pressure;
  const double exponent = model->thermal ? model->g : 1;
  s->p = (s->p + ambient) * pow(ratio, exponent) - ambient;
  s->T *= pow(ratio, exponent - 1);
}

void fmu_impose(fmu_instance *i)
{
  pneu_state *s = &i->m.state;
  if (i->model.law.position_input) {
    const double x = fmu_driven_position(i);
    if (i->m.phase == FMU_STEPPING && x != s->x)
      compress(&i->model, x, s);
    s->x = x;
    s->v = driven_velocity(i);
  }
  if (i->model.law.pressure_input)
    s->p = fmu_driven_pressure(i);
}

void fmu_within(const fmu_instance *i, pneu_state *s)
{
  const pneu_params *p = &i->m.params;
  const double swept = p->area * p->swept_ratio;
  s->p = fmax(s->p, -0.999 * p->ambient_pressure);
  s->T = fmax(s->T, 0.01 * p->ambient_temperature);
  if (swept > 0)
    s->x = fmax(s->x, i->model.lower_stop - 0.5 * pneu_volume(&i->model, i->model.lower_stop) / swept);
}

void fmu_pass_to(fmu_instance *i, double time)
{
  i->m.time = time;
  if (i->model.clock >= 0)
    i->m.state.extra[i->model.clock] = time;
}

/* The event functions of the present mode; those that it does not have are far below 0. */
static void event_functions(const fmu_instance *i, double *g)
{
  pneu_state state = i->m.state;
  pneu_input input;
  double y[PNEU_STATE_MAX];
  int n, k;
  fmu_within(i, &state);
  fmu_drive(i, &input);
  pneu_pack(&i->model, &state, y);
  n = pneu_events(&i->model, &state, &input, y, g);
  for (k = n; k < PNEU_EVENT_MAX; k++)
    g[k] = -1;
}

static int is_choked(const fmu_instance *i)
{
  pneu_state state = i->m.state;
  pneu_input input;
  pneu_output out;
  fmu_within(i, &state);
  fmu_drive(i, &input);
  return pneu_observe(&i->model, &state, &input, &out) == PNEU_OK ? out.choked : i->m.choked;
}

/* What event function k measures decides its margin: forces at rest, else speed and then travel; of the edge, travel.
 */
static double margin(const fmu_instance *i, int k)
{
  const int mode = i->m.state.mode, slides = mode == PNEU_MODE_UP || mode == PNEU_MODE_DOWN;
  if (slides && k == 0)
    return SPEED_MARGIN * i->model.scale[3];
  return slides || k == PNEU_EVENT_EDGE ? TRAVEL_MARGIN * i->model.scale[2] : i->model.force_noise;
}

void fmu_arm(fmu_instance *i)
{
  double g[PNEU_EVENT_MAX];
  int k;
  event_functions(i, g);
  for (k = 0; k < PNEU_EVENT_MAX; k++)
    i->m.threshold[k] = fmax(g[k], 0) + margin(i, k);
  i->m.choked = is_choked(i);
}

void fmu_indicators(const fmu_instance *i, double *z)
{
  double g[PNEU_EVENT_MAX];
  int k;
  event_functions(i, g);
  for (k = 0; k < PNEU_EVENT_MAX; k++)
    z[k < PNEU_EVENT_EDGE ? k : k + 1] = g[k] - i->m.threshold[k];
  /* the library tells whether flow is choked, not how far from it: a step, which root finders bisect */
  z[PNEU_EVENT_EDGE] = is_choked(i) == i->m.choked ? -1 : 1;
}

int fmu_fired(const fmu_instance *i)
{
  double g[PNEU_EVENT_MAX];
  int k;
  event_functions(i, g);
  for (k = PNEU_EVENT_EDGE - 1; k >= 0; k--) /* a stop before a reversal: who is beyond the stop has hit it */
    if (g[k] >= i->m.threshold[k])
      return k;
  return g[PNEU_EVENT_EDGE] >= i->m.threshold[PNEU_EVENT_EDGE] ? PNEU_EVENT_EDGE : -1;
}

int fmu_rates(const fmu_instance *i, double *rate)
{
  pneu_state state = i->m.state;
  pneu_input input;
  double y[PNEU_STATE_MAX], dydt[PNEU_STATE_MAX];
  int k, at;
  fmu_within(i, &state);
  fmu_drive(i, &input);
  pneu_pack(&i->model, &state, y);
  if (pneu_rhs(&i->model, &state, &input, y, dydt) != PNEU_OK)
    return FMU_DISCARD;
  for (k = 0; k < i->shape.n; k++) {
    at = fmu_packed_at(&i->model, state.mode, i->shape.kind[k]);
    rate[k] = at < 0 ? 0 : dydt[at];
  }
  return FMU_OK;
}

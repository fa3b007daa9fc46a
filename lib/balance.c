/* Where the forces on a stem at rest balance. */
#include "internal.h"

/* Secant steps: one is enough where forces are straight lines over pressure, as most are. */
enum { ROUNDS = 16 };

pneu_real pneu_balance_pressure(const pneu_model *model, pneu_real x, const pneu_input *input, int direction)
{
  const pneu_real rounding = 8 * PNEU_EPS;
  pneu_real p = 0, before = 0, lacking_before = 0, y[PNEU_STATE_MAX];
  pneu_state state;
  pneu_terms t;
  int i;
  memset(&state, 0, sizeof state);
  state.T = model->p.ambient_temperature;
  state.x = x;
  state.mode = PNEU_MODE_STUCK;
  pneu_start_effects(model, input, &state);
  for (i = 0; i < ROUNDS; i++) {
    pneu_real lacking, slope, step;
    state.p = p;
    pneu_pack(model, &state, y);
    if (pneu_evaluate(model, &state, input, y, PNEU_EXTENT_FORCES, &t, NULL) != PNEU_OK)
      return p; /* below vacuum: on the straight line through what is above */
    lacking = (pneu_real)direction * t.friction - t.force;
    slope = i == 0 ? t.area : (lacking_before - lacking) / (p - before);
    step = lacking / slope;
    if (PNEU_M(fabs)(step) <= rounding * (PNEU_M(fabs)(p) + model->scale[0]))
      return p;
    if (!(slope > 0))
      break;
    before = p;
    lacking_before = lacking;
    p += step;
  }
  return (pneu_real)NAN;
}

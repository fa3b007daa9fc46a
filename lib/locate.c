/* Where inside a step an event happens. */
#include "internal.h"

enum { BISECTIONS = 40, ARMINGS = 30 };

/* g of event `which` at theta of the present step. */
static pneu_real event_at(const pneu_model *model, const pneu_state *state, const pneu_input *input,
                          const pneu_workspace *work, int which, pneu_real theta)
{
  pneu_real y[PNEU_STATE_MAX], g[PNEU_EVENT_MAX];
  pneu_dense_packed(work, pneu_dimension(model, state->mode), theta, y);
  return pneu_events(model, state, input, y, g) > which ? g[which] : -1;
}

/* Root of g along the dense output between 0 and end, by the Illinois variant of the regula falsi. */
static pneu_real dense_root(const pneu_model *model, const pneu_state *state, const pneu_input *input,
                            const pneu_workspace *work, int which, pneu_real end, pneu_real g_end)
{
  pneu_real lo = 0, hi = end, g_lo = event_at(model, state, input, work, which, 0), g_hi = g_end;
  int i;
  for (i = 0; g_lo >= 0 && i < ARMINGS; i++) { /* just fired: the root lies after it has left zero */
    const pneu_real theta = end * PNEU_M(pow)(PNEU_C(0.5), (pneu_real)(i + 1)),
                    g = event_at(model, state, input, work, which, theta);
    if (g < 0) {
      lo = theta;
      g_lo = g;
    }
  }
  if (g_lo >= 0) /* it never does */
    return 8 * PNEU_EPS;
  for (i = 0; i < BISECTIONS && hi - lo > 8 * PNEU_EPS; i++) {
    pneu_real theta = lo + (hi - lo) * g_lo / (g_lo - g_hi), g;
    if (!(theta > lo && theta < hi))
      theta = (lo + hi) / 2;
    g = event_at(model, state, input, work, which, theta);
    if (g > 0) {
      hi = theta;
      g_hi = g;
      g_lo /= 2;
    } else {
      lo = theta;
      g_lo = g;
      g_hi /= 2;
    }
  }
  return hi;
}

/* Of a position [m], with room. */
static pneu_real rounding(const pneu_model *model)
{
  return 20 * PNEU_EPS * model->p.stroke;
}

/* An edge counts once it is resolved. At rest between the stops an event counts once its push can be resolved; it is
 * then dated back to its zero. A stem that creeps to rest ends its slide within rounding of the balance, on either side
 * of it. */
static int is_masked(const pneu_model *model, const pneu_state *state, int which, pneu_real g)
{
  if (which == PNEU_EVENT_EDGE)
    return g <= rounding(model);
  return state->mode == PNEU_MODE_STUCK && g <= model->force_resolved;
}

/* A stem on bristles turns round if it does at the end of the step: dense output of what is stiff may swing over zero
 * on the way. */
static int may_swing(const pneu_model *model, const pneu_state *state, int which, pneu_real theta)
{
  return model->bristle && which == 0 && theta < 1 && (state->mode == PNEU_MODE_UP || state->mode == PNEU_MODE_DOWN);
}

/* By how much an entry may leave the line from start to end of the step: theta (1 - theta) <= 1/4, with room for
 * rounding. */
static pneu_real bulge(const pneu_workspace *work, int l)
{
  pneu_real sum = 0;
  int i;
  for (i = 0; i < PNEU_DENSE_COUNT; i++)
    sum += PNEU_M(fabs)(work->dense[i][l]);
  return PNEU_C(0.26) * sum;
}

/* Whether a sliding stem slides all through the step and touches no stop: most steps, told without looking inside. */
static int only_slides(const pneu_model *model, const pneu_state *state, const pneu_input *input,
                       const pneu_workspace *work)
{
  const int i_x = model->n_gas, i_v = i_x + 1;
  const pneu_real v = bulge(work, i_v), x = bulge(work, i_x);
  pneu_real start[PNEU_EVENT_MAX], end[PNEU_EVENT_MAX];
  const int n = pneu_events(model, state, input, work->y0, start);
  pneu_events(model, state, input, work->y1, end);
  return start[0] < -v && end[0] < -v && start[1] < -x && end[1] < -x &&
         (n <= PNEU_EVENT_EDGE || (start[PNEU_EVENT_EDGE] < -x && end[PNEU_EVENT_EDGE] < -x));
}

/* Earliest event inside the step, judged at quarters of it while moving and at halves at rest.  Returns: theta; Out:
 * which, -1 if none. */
static pneu_real first_event(const pneu_model *model, const pneu_state *state, const pneu_input *input,
                             const pneu_workspace *work, int *which)
{
  const int n = pneu_dimension(model, state->mode);
  pneu_real y[PNEU_STATE_MAX], g[PNEU_EVENT_MAX], first = 2;
  const int parts = n > model->n_gas ? 4 : 2;
  int part, i, count;
  *which = -1;
  if ((state->mode == PNEU_MODE_UP || state->mode == PNEU_MODE_DOWN) && only_slides(model, state, input, work))
    return first;
  for (part = 1; part <= parts && *which < 0; part++) {
    const pneu_real theta = (pneu_real)part / (pneu_real)parts;
    pneu_dense_packed(work, n, theta, y);
    count = pneu_events(model, state, input, y, g);
    for (i = 0; i < count; i++) {
      pneu_real at;
      if (!(g[i] > 0) || is_masked(model, state, i, g[i]) || may_swing(model, state, i, theta))
        continue;
      at = dense_root(model, state, input, work, i, theta, g[i]);
      if (at < first) {
        first = at;
        *which = i;
      }
    }
  }
  return first;
}

/* Repeat the step to end on the event: each repeat is exact to the order of the method, so that the
 * root moves by ever less. */
int pneu_locate(const pneu_model *model, const pneu_state *state, const pneu_input *input, pneu_workspace *work,
                pneu_real *h, int *which, pneu_real *error)
{
  pneu_real theta, length, slope;
  int i;
  pneu_dense_step(model, state->mode, *h, work);
  theta = first_event(model, state, input, work, which);
  length = theta * *h;
  if (*which < 0)
    return PNEU_OK;
  for (i = 0; i < PNEU_LOCATE_MAX; i++) {
    int status = pneu_step_try(model, state, input, length, work, error);
    pneu_real g0, g1, correction;
    if (status != PNEU_OK)
      return status;
    pneu_dense_step(model, state->mode, length, work);
    g1 = event_at(model, state, input, work, *which, 1);
    g0 = event_at(model, state, input, work, *which, PNEU_C(0.99));
    slope = (g1 - g0) / (PNEU_C(0.01) * length);
    correction = 0;
    if (slope > 0)
      correction = g1 / slope;
    else if (g1 < 0 && !(*which == PNEU_EVENT_EDGE && g1 > -rounding(model))) /* only the long step had the event */
      return PNEU_RETRY_STATE;
    if (PNEU_M(fabs)(correction) < PNEU_EVENT_TIME)
      break;
    length -= correction;
    if (!(length > 0))
      length = PNEU_EVENT_TIME;
    if (length > *h) /* shorter steps see no event where the whole one had it */
      return PNEU_RETRY_STATE;
  }
  *h = length;
  return PNEU_OK;
}

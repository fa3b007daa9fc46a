#include "loadcycle.h"

#include <math.h>
#include <string.h>

static const double period = 0.02; /* [s] between settings of the load */
static const double longest = 400; /* [s] for one stroke */
static const double settling = 30; /* [s] to fill up to the supply */

typedef struct bench {
  const pneu_model *model;
  pneu_state state;
  pneu_input input;
  pneu_options options;
  pneu_workspace work;
} bench;

static int run_for(bench *b, double duration, lab_error *error)
{
  const int status = pneu_run(b->model, &b->state, &b->input, duration, &b->options, NULL, &b->work);
  if (status != PNEU_OK)
    return lab_fail(error, LAB_NUMERIC, "%s in a loaded cycle, %s, p = %.6g Pa, x = %.6g m", pneu_status_text(status),
                    pneu_mode_text(b->state.mode), b->state.p, b->state.x);
  return LAB_OK;
}

/* Move until the stop; spring and load together make `resistance` [N].  Out: work [J] on the load */
static int stroke(bench *b, double u, double resistance, double *work, lab_error *error)
{
  const pneu_params *p = &b->model->p;
  const double stop = u > 0 ? p->stroke : 0;
  double t, x;
  *work = 0;
  b->input.u = u;
  for (t = 0; b->state.x != stop; t += period) {
    x = b->state.x;
    b->input.force = resistance - p->spring_rate * (x + p->spring_preload);
    if (run_for(b, period, error))
      return error->status;
    *work += b->input.force * (b->state.x - x);
    if (t > longest)
      return lab_fail(error, LAB_NUMERIC, "a loaded stem stays at x = %.6g m", b->state.x);
  }
  return LAB_OK;
}

static int cycle(bench *b, double margin, load_cycle *out, lab_error *error)
{
  const pneu_params *p = &b->model->p;
  const double full = p->supply_pressure * p->area;
  const double start = pneu_mass(b->model, &b->state);
  if (stroke(b, 1, (1 - margin) * full - p->dry_friction, &out->work_up, error) || run_for(b, settling, error))
    return error->status;
  out->air = pneu_mass(b->model, &b->state) - start;
  return stroke(b, -1, margin * full + p->dry_friction, &out->work_down, error);
}

int load_cycle_run(const pneu_params *params, const pneu_laws *law, double margin, load_cycle *out, lab_error *error)
{
  pneu_model model;
  bench b;
  const int status = pneu_model_init(&model, params, law, NULL);
  if (status != PNEU_OK)
    return lab_fail(error, LAB_DATA, "%s", pneu_status_text(status));
  memset(&b, 0, sizeof b);
  b.model = &model;
  pneu_options_default(&b.options);
  pneu_input_default(&model, &b.input);
  pneu_state_rest(&model, 0, model.p.ambient_temperature, 0, &b.input, &b.state);
  return cycle(&b, margin, out, error);
}

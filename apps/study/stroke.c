#include "stroke.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "linearflow.h"

static const double longest = 400.0; /* [s] for one stroke */
static const double spacing = 0.02;  /* [s] longest step */

static int grow(stroke_curve *s)
{
  double **const column[] = {&s->t, &s->x, &s->v, &s->p};
  const size_t room = s->room ? 2 * s->room : 1024;
  size_t i;
  for (i = 0; i < sizeof column / sizeof *column; i++) {
    double *wider = realloc(*column[i], room * sizeof *wider);
    if (!wider)
      return s->full = 1;
    *column[i] = wider;
  }
  s->room = room;
  return 0;
}

static int append(stroke_curve *s, double t, const pneu_state *at)
{
  if (s->n == s->room && grow(s))
    return 1;
  s->t[s->n] = t;
  s->x[s->n] = at->x;
  s->v[s->n] = at->v;
  s->p[s->n++] = at->p;
  return 0;
}

static int at_rest(const pneu_step_view *view)
{
  pneu_state end;
  pneu_output out;
  pneu_dense(view, 1, &end);
  if (end.v != 0 && fabs(end.v) > 1e-9)
    return 0;
  return pneu_observe(view->model, &end, view->input, &out) == PNEU_OK && fabs(out.mass_in - out.mass_out) < 1e-12;
}

/* Collect dense output; stop the run once the flow has died out. */
static int collect(void *context, const pneu_step_view *view)
{
  stroke_curve *s = context;
  int i;
  for (i = 1; i <= 4; i++) {
    pneu_state at;
    pneu_dense(view, i / 4.0, &at);
    if (append(s, view->t + view->h * i / 4.0, &at))
      return 1;
  }
  return at_rest(view);
}

static int one_stroke(const pneu_model *model, pneu_state *state, double u, stroke_curve *s, lab_error *error)
{
  pneu_observer observer = {collect, NULL, s};
  pneu_options options;
  pneu_workspace work;
  pneu_input input;
  int status;
  memset(&work, 0, sizeof work);
  pneu_options_default(&options);
  pneu_input_default(model, &input);
  options.tol = 1e-8;
  options.h_max = spacing;
  input.u = u;
  append(s, 0, state);
  status = pneu_run(model, state, &input, longest, &options, &observer, &work);
  if (s->full)
    return lab_fail_memory(error, "a stroke");
  if (status != PNEU_OK && status != PNEU_E_STOPPED)
    return lab_fail(error, LAB_NUMERIC, "%s during a stroke with u = %g, %s, p = %.6g Pa, x = %.6g m",
                    pneu_status_text(status), u, pneu_mode_text(state->mode), state->p, state->x);
  return LAB_OK;
}

static int make_model(const pneu_params *params, const pneu_laws *law, pneu_model *model, lab_error *error)
{
  pneu_param_info info;
  int bad, status = linear_model_init(model, params, law, &bad);
  if (status == PNEU_E_PARAM) {
    pneu_param_describe(bad, &info);
    return lab_fail(error, LAB_DATA, "%s is outside %g .. %g %s", info.name, info.lower, info.upper, info.unit);
  }
  return status == PNEU_OK ? LAB_OK : lab_fail(error, LAB_DATA, "%s", pneu_status_text(status));
}

int stroke_sample(const pneu_params *up, const pneu_params *down, const pneu_laws *law, stroke_pair *pair,
                  lab_error *error)
{
  pneu_model rising, falling;
  pneu_input shut;
  pneu_state state;
  memset(pair, 0, sizeof *pair);
  if (make_model(up, law, &rising, error) || make_model(down, law, &falling, error))
    return error->status;
  pneu_input_default(&rising, &shut);
  pneu_state_rest(&rising, 0, rising.p.ambient_temperature, 0, &shut, &state);
  if (one_stroke(&rising, &state, 1, &pair->up, error))
    return error->status;
  return one_stroke(&falling, &state, -1, &pair->down, error);
}

static void free_curve(stroke_curve *s)
{
  free(s->t);
  free(s->x);
  free(s->v);
  free(s->p);
}

void stroke_pair_free(stroke_pair *pair)
{
  free_curve(&pair->up);
  free_curve(&pair->down);
  memset(pair, 0, sizeof *pair);
}

lab_edge stroke_edge(const stroke_curve *s)
{
  const lab_edge edge = {s->n, s->t, s->x};
  return edge;
}

int stroke_measure(const pneu_params *up, const pneu_params *down, const pneu_laws *law, lab_asymmetry *out,
                   lab_error *error)
{
  stroke_pair pair;
  int status = stroke_sample(up, down, law, &pair, error);
  if (status == LAB_OK) {
    const lab_edge rising = stroke_edge(&pair.up), falling = stroke_edge(&pair.down);
    status = lab_asymmetry_measure(&rising, &falling, out, error);
  }
  stroke_pair_free(&pair);
  return status;
}

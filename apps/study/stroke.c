#include "stroke.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../lab/base/line.h"
#include "../lab/rig/rig.h"

static const double longest = 400; /* [s] for one stroke */

/* ---- Flow laws ---- */

static void held_below(const pneu_model *model, double critical, double area, double p_up, double p_down,
                       pneu_flow *flow)
{
  const double k = area * model->paper_gain / sqrt(model->p.ambient_temperature), r = p_down / p_up;
  flow->choked = r <= critical;
  flow->q = k * p_up * (1 - (flow->choked ? critical : r));
  flow->dq_dup = flow->choked ? k * (1 - critical) : k;
  flow->dq_ddown = flow->choked ? 0 : -k;
  flow->dq_dT = 0;
}

static void linear(const pneu_model *model, double area, double p_up, double T_up, double p_down, pneu_flow *flow)
{
  (void)T_up;
  held_below(model, -1, area, p_up, p_down, flow);
}

static void linear_choked(const pneu_model *model, double area, double p_up, double T_up, double p_down,
                          pneu_flow *flow)
{
  (void)T_up;
  held_below(model, model->critical_ratio, area, p_up, p_down, flow);
}

int linear_model_init(pneu_model *model, const pneu_params *p, const pneu_laws *laws, int *bad)
{
  const int is_linear = laws->flow == LINEAR_FLOW || laws->flow == LINEAR_CHOKED_FLOW;
  pneu_laws known = *laws;
  int status;
  if (is_linear)
    known.flow = PNEU_FLOW_PAPER;
  status = pneu_model_init(model, p, &known, bad);
  if (is_linear)
    model->own_flow = laws->flow == LINEAR_FLOW ? linear : linear_choked;
  return status;
}

/* ---- A full stroke ---- */

static const double spacing = 0.02; /* [s] longest step */

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
  int bad, status = linear_model_init(model, params, law, &bad);
  if (status == PNEU_E_PARAM) {
    const pneu_param_info info = lab_param_info(bad);
    return lab_fail(error, LAB_DATA, "%s is outside %g .. %g %s", info.name, info.lower, info.upper, info.unit);
  }
  return status == PNEU_OK ? LAB_OK : lab_fail(error, LAB_DATA, "%s", pneu_status_text(status));
}

/* A model at rest on its lower stop, in a chamber at ambient pressure. */
static int begin(const pneu_params *params, const pneu_laws *law, pneu_model *model, pneu_input *shut,
                 pneu_state *state, lab_error *error)
{
  if (make_model(params, law, model, error))
    return error->status;
  pneu_input_default(model, shut);
  pneu_state_rest(model, 0, model->p.ambient_temperature, 0, shut, state);
  return LAB_OK;
}

int stroke_sample(const pneu_params *up, const pneu_params *down, const pneu_laws *law, stroke_pair *pair,
                  lab_error *error)
{
  pneu_model rising, falling;
  pneu_input shut;
  pneu_state state;
  memset(pair, 0, sizeof *pair);
  if (begin(up, law, &rising, &shut, &state, error) || make_model(down, law, &falling, error) ||
      one_stroke(&rising, &state, 1, &pair->up, error))
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

static int measure_shape(const stroke_pair *pair, lab_asymmetry *out, lab_error *error)
{
  const lab_edge rising = stroke_edge(&pair->up), falling = stroke_edge(&pair->down);
  return lab_asymmetry_measure(&rising, &falling, out, error);
}

int stroke_measure(const pneu_params *up, const pneu_params *down, const pneu_laws *law, lab_asymmetry *out,
                   lab_error *error)
{
  stroke_pair pair;
  int status = stroke_sample(up, down, law, &pair, error);
  if (status == LAB_OK)
    status = measure_shape(&pair, out, error);
  stroke_pair_free(&pair);
  return status;
}

/* ---- Velocities ---- */

static const double window_from = 0.05, window_to = 0.95;

double speed_position(int i)
{
  return window_from + (window_to - window_from) * i / (SPEED_POINTS - 1);
}

/* State of the curve between samples i - 1 and i where it passes x. */
static void read_at(const stroke_curve *c, size_t i, double x, double *v, double *p)
{
  const double part = (x - c->x[i - 1]) / (c->x[i] - c->x[i - 1]);
  *v = fabs(c->v[i - 1] + part * (c->v[i] - c->v[i - 1]));
  *p = c->p[i - 1] + part * (c->p[i] - c->p[i - 1]);
}

static double arrival(const stroke_curve *c)
{
  const double near = 1e-6 * fabs(c->x[c->n - 1] - c->x[0]); /* a stop is met to the accuracy of an event */
  size_t i = 0;
  while (fabs(c->x[i] - c->x[c->n - 1]) > near)
    i++;
  return fabs(c->v[i]);
}

/* Entries in the order in which the stem passes them; `sign` is that of the motion. */
static void read_edge(const stroke_curve *c, int sign, speed_edge *e)
{
  const double from = c->x[0], travel = c->x[c->n - 1] - from;
  size_t at = 1;
  int i;
  for (i = 0; i < SPEED_POINTS; i++) {
    const double x = from + travel * speed_position(i);
    const int entry = sign > 0 ? i : SPEED_POINTS - 1 - i;
    while (at + 1 < c->n && sign * c->x[at] < sign * x)
      at++;
    read_at(c, at, x, &e->v[entry], &e->p[entry]);
  }
  e->arrival = arrival(c);
}

/* Trapezoidal rule over -A p dx. */
static double work_on_air(const stroke_curve *c, double area)
{
  double sum = 0;
  size_t i;
  for (i = 1; i < c->n; i++)
    sum -= 0.5 * (c->p[i] + c->p[i - 1]) * (c->x[i] - c->x[i - 1]);
  return area * sum;
}

int speeds_measure(const pneu_params *params, const pneu_laws *law, speed_pair *out, lab_error *error)
{
  stroke_pair pair;
  int status = stroke_sample(params, params, law, &pair, error);
  if (status == LAB_OK)
    status = measure_shape(&pair, &out->shape, error);
  if (status == LAB_OK) {
    read_edge(&pair.up, 1, &out->up);
    read_edge(&pair.down, -1, &out->down);
    out->returned = work_on_air(&pair.down, params->area);
  }
  stroke_pair_free(&pair);
  return status;
}

int speed_fastest(const speed_edge *e)
{
  int i, best = 0;
  for (i = 1; i < SPEED_POINTS; i++)
    if (e->v[i] > e->v[best])
      best = i;
  return best;
}

double speed_max(const speed_edge *e)
{
  return e->v[speed_fastest(e)];
}

double speed_min(const speed_edge *e)
{
  double least = e->v[0];
  int i;
  for (i = 1; i < SPEED_POINTS; i++)
    least = fmin(least, e->v[i]);
  return least;
}

/* Pressure grows with position on either edge: the spring balances it. */
double speed_at_pressure(const speed_edge *e, double p)
{
  int i = 1;
  if (!(p >= e->p[0] && p <= e->p[SPEED_POINTS - 1]))
    return (double)NAN;
  while (i + 1 < SPEED_POINTS && e->p[i] < p)
    i++;
  return e->v[i - 1] + (e->v[i] - e->v[i - 1]) * (p - e->p[i - 1]) / (e->p[i] - e->p[i - 1]);
}

double speed_exponent(const speed_edge *e, double P_a)
{
  lab_line line = {0};
  int i;
  for (i = 0; i < SPEED_POINTS; i++)
    lab_line_add(&line, log(e->p[i] + P_a), log(e->v[i]), 1);
  return lab_line_slope(&line);
}

double speed_crossing(const speed_pair *pair)
{
  const speed_edge *up = &pair->up, *down = &pair->down;
  int i = SPEED_POINTS - 1;
  double lead = (double)NAN, before;
  for (; i >= 0; i--) {
    before = lead;
    lead = speed_at_pressure(down, up->p[i]) - up->v[i];
    if (lead < 0)
      return isnan(before) ? (double)NAN : up->p[i] + (up->p[i + 1] - up->p[i]) * lead / (lead - before);
  }
  return (double)NAN;
}

/* ---- A loaded cycle ---- */

static const double period = 0.02; /* [s] between settings of the load */
static const double settling = 30; /* [s] to fill up to the supply */

typedef struct loaded {
  const pneu_model *model;
  pneu_state state;
  pneu_input input;
  pneu_options options;
  pneu_workspace work;
} loaded;

static int run_for(loaded *b, double duration, lab_error *error)
{
  const int status = pneu_run(b->model, &b->state, &b->input, duration, &b->options, NULL, &b->work);
  if (status != PNEU_OK)
    return lab_fail(error, LAB_NUMERIC, "%s in a loaded cycle, %s, p = %.6g Pa, x = %.6g m", pneu_status_text(status),
                    pneu_mode_text(b->state.mode), b->state.p, b->state.x);
  return LAB_OK;
}

/* Move until the stop; spring and load together make `resistance` [N].  Out: work [J] on the load */
static int loaded_stroke(loaded *b, double u, double resistance, double *work, lab_error *error)
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

static int loaded_cycle(loaded *b, double margin, load_cycle *out, lab_error *error)
{
  const pneu_params *p = &b->model->p;
  const double full = p->supply_pressure * p->area;
  const double start = pneu_mass(b->model, &b->state);
  if (loaded_stroke(b, 1, (1 - margin) * full - p->dry_friction, &out->work_up, error) || run_for(b, settling, error))
    return error->status;
  out->air = pneu_mass(b->model, &b->state) - start;
  return loaded_stroke(b, -1, margin * full + p->dry_friction, &out->work_down, error);
}

int load_cycle_run(const pneu_params *params, const pneu_laws *law, double margin, load_cycle *out, lab_error *error)
{
  pneu_model model;
  loaded b;
  memset(&b, 0, sizeof b);
  b.model = &model;
  if (begin(params, law, &model, &b.input, &b.state, error))
    return error->status;
  pneu_options_default(&b.options);
  return loaded_cycle(&b, margin, out, error);
}

/* Runs with adaptive steps, and single steps of fixed length. */
#include "internal.h"

enum { EVENTS_AT_ONE_TIME = 16 };

#define PNEU_SHORTEST PNEU_C(1e-14) /* [s] step */
/* Local error at which a fixed step is split; what it is raised to when the parts run short, so that a stem that rings
 * is damped rather than held; and for the gas, the stem held. */
#define PNEU_STEP_TOL   PNEU_C(1e-4)
#define PNEU_COARSE_TOL PNEU_C(1e-3)
#define PNEU_HELD_TOL   PNEU_C(1e-2)
#define PNEU_AIM        PNEU_C(0.6) /* share of it that the next part aims at, lest every other be refused */

/* One run in progress. */
typedef struct run {
  const pneu_model *model;
  const pneu_input *given;
  pneu_input input; /* it, now */
  const pneu_options *options;
  const pneu_observer *observer;
  pneu_state *state;
  pneu_workspace *work;
  pneu_real t, end;
  pneu_real carry;                  /* what rounding has taken from t (Kahan 1965) */
  pneu_real event_t;                /* of the last event */
  pneu_real h;                      /* to try next; 0: choose */
  pneu_real h_before, error_before; /* of the last accepted step; 0: none */
  int steps, events_here;           /* events without progress in time beyond their exactness */
} run;

/* Time to go, and time that passes: single precision would lose short steps late in a long run. */
static pneu_real left_of(const run *r)
{
  return (r->end - r->t) + r->carry;
}

static void pass_time(run *r, pneu_real h)
{
  const pneu_real step = h - r->carry, t = r->t + step;
  r->carry = (t - r->t) - step;
  r->t = t;
}

/* A step's length goes with the tolerance by this root, of the method's order; square roots cost a processor without a
 * power less. */
static pneu_real root(pneu_real ratio)
{
  return PNEU_ORDER == 4 ? PNEU_M(sqrt)(PNEU_M(sqrt)(ratio)) : PNEU_M(pow)(ratio, PNEU_C(1.0) / PNEU_ORDER);
}

/* First step in a mode: with mu the rate at which the slope changes along the solution,
 * |J f|/|f|, the local error is about |f| mu^4 h^5 / 1000, in units of full scale; of order 4, |f| mu^3 h^4 / 100.
 * And no longer than the slope needs for the full scale, which a choked flow, whose slope does not change, would leave
 * far behind. */
static pneu_real first_step(const run *r)
{
  const pneu_workspace *w = r->work;
  const int n = pneu_dimension(r->model, r->state->mode);
  pneu_real scale[PNEU_STATE_MAX], f = 0, jf = 0, mu, h;
  int i, j;
  pneu_scales(r->model, scale);
  for (i = 0; i < n; i++) {
    pneu_real sum = 0;
    for (j = 0; j < n; j++)
      sum += w->jac[i][j] * w->f0[j];
    f = PNEU_M(fmax)(f, PNEU_M(fabs)(w->f0[i]) / scale[i]);
    jf = PNEU_M(fmax)(jf, PNEU_M(fabs)(sum) / scale[i]);
  }
  if (!(f > 0))
    return left_of(r);
  mu = jf / f + PNEU_EPS;
  h = PNEU_ORDER == 4 ? root(100 * r->options->tol / (f * mu * mu * mu))
                      : root(1000 * r->options->tol / (f * mu * mu * mu * mu));
  return PNEU_M(fmin)(h, 1 / f);
}

static int notify_step(run *r, pneu_real h)
{
  pneu_step_view view;
  if (!r->observer || !r->observer->step)
    return PNEU_OK;
  view.model = r->model;
  view.input = &r->input;
  view.work = r->work;
  view.start = r->state;
  view.t = r->t;
  view.h = h;
  return r->observer->step(r->observer->context, &view) ? PNEU_E_STOPPED : PNEU_OK;
}

/* Take over the end of the step; switch the mode where an event ended it. */
static int accept(run *r, pneu_real h, int which)
{
  const int mode = r->state->mode;
  int status = notify_step(r, h);
  if (status != PNEU_OK)
    return status;
  pneu_unpack(r->model, r->work->y1, r->state);
  pass_time(r, which < 0 && h >= left_of(r) ? left_of(r) : h);
  r->work->stats.steps++;
  if (which < 0)
    return PNEU_OK;
  r->events_here = r->t - r->event_t > 8 * PNEU_EVENT_TIME ? 0 : r->events_here + 1;
  r->event_t = r->t;
  if (r->events_here > EVENTS_AT_ONE_TIME)
    return PNEU_E_EVENTS;
  pneu_switch(r->model, &r->input, which, r->state);
  r->work->stats.events++;
  r->h = r->h_before = 0;
  if (r->observer && r->observer->event && r->observer->event(r->observer->context, r->t, r->state, mode))
    return PNEU_E_STOPPED;
  return PNEU_OK;
}

static pneu_real clip(pneu_real value, pneu_real lo, pneu_real hi)
{
  return value < lo ? lo : value > hi ? hi : value;
}

/* Whether a step at rest leapt over the point of equal pressures, where the slope of the flow is so steep that the
 * error estimate can miss it: flow through the open orifice brings pressure up to that point and not beyond. Judged at
 * quarters of the step's curve, with a share of that pressure as margin, the width of the blend at least; the opening,
 * at its end. */
static int leaps(const pneu_model *model, const pneu_state *state, const pneu_input *input, pneu_real h,
                 pneu_real share, pneu_workspace *w)
{
  const pneu_real ambient = model->p.ambient_pressure;
  pneu_input end;
  pneu_terms t;
  pneu_real equal, before;
  int quarter;
  if (pneu_dimension(model, state->mode) != model->n_gas || model->law.pressure_input)
    return 0;
  end = *input;
  end.elapsed += h;
  if (pneu_evaluate(model, state, &end, w->y1, PNEU_EXTENT_FORCES, &t, NULL) != PNEU_OK)
    return 1;
  equal = t.opening > 0 ? t.supply : t.exhaust;
  before = w->y0[0] + ambient - equal;
  pneu_dense_prepare(1, w);
  for (quarter = 1; quarter <= 4 && t.opening != 0; quarter++) {
    pneu_real p;
    pneu_dense_packed(w, 1, (pneu_real)quarter * PNEU_C(0.25), &p);
    p += ambient - equal;
    if (p * before < 0 && PNEU_M(fabs)(p) > share * equal && PNEU_M(fabs)(before) > PNEU_BLEND * equal)
      return 1;
  }
  return 0;
}

/* Growth of the step that its error allows: a tenth at least, also where the error is no number, and sixfold at most,
 * about. */
static pneu_real growth(pneu_real tol, pneu_real error)
{
  const pneu_real least = PNEU_C(1e-4) * tol;
  return PNEU_C(0.9) * root(error < PNEU_C(1e5) * tol ? tol / (error > least ? error : least) : PNEU_C(1e-5));
}

/* Growth of the step by the error of this one, and by the trend since the last where that asks for
 * less (Gustafsson 1994, ACM TOMS 20: the error of an accepted step predicts the next). */
static pneu_real next_factor(const run *r, pneu_real h, pneu_real error)
{
  const pneu_real tol = r->options->tol, factor = growth(tol, error);
  pneu_real trend;
  if (!(r->h_before > 0))
    return factor;
  error = PNEU_M(fmax)(error, PNEU_C(1e-4) * tol);
  trend = factor * h / r->h_before * root(r->error_before / error);
  return PNEU_M(fmin)(factor, trend);
}

/* Whether a state is made of numbers and physical. */
static int is_sound(const pneu_model *model, const pneu_state *state)
{
  pneu_real zero = 0 * (state->p + state->x + state->v);
  int i;
  if (model->thermal)
    zero += 0 * state->T;
  for (i = 0; i < model->n_extra; i++)
    zero += 0 * state->extra[i];
  return zero == 0 && pneu_is_physical(model, state);
}

static int all_finite(const pneu_input *input)
{
  const pneu_real sum = input->u + input->supply_pressure + input->force + input->pressure_rate + input->position_rate;
  return 0 * (sum + input->u_rate + input->elapsed) == 0;
}

/* Whether a position is between the stops, with a thousandth of the stroke for sensors and rounding. */
static int between_stops(const pneu_model *model, pneu_real x)
{
  const pneu_real margin = PNEU_C(1e-3) * model->p.stroke;
  return model->law.position_input || (x >= model->lower_stop - margin && x <= model->upper_stop + margin);
}

/* Whether a command is an opening or, in other units, need not be one. */
static int is_opening(const pneu_model *model, const pneu_input *input, pneu_real elapsed)
{
  return model->p.proportional_band > 0 || input->set_position ||
         PNEU_M(fabs)(input->u + input->u_rate * elapsed) <= PNEU_C(1.00001);
}

/* Whether state and input lie in their documented ranges, from now until the end. */
static int usable(const pneu_model *model, const pneu_state *state, const pneu_input *input, pneu_real duration)
{
  const pneu_params *p = &model->p;
  if (!is_sound(model, state) || !all_finite(input) || state->mode < 0 || state->mode >= PNEU_MODE_COUNT)
    return 0;
  if (input->supply_pressure <= -p->ambient_pressure)
    return 0;
  return is_opening(model, input, input->elapsed) && is_opening(model, input, input->elapsed + duration) &&
         between_stops(model, state->x);
}

/* Whether duration and tolerance lie in their documented ranges; tolerance with room for rounding. */
static int in_range(pneu_real duration, pneu_real tol)
{
  return duration >= 0 && duration * 0 == 0 && tol >= PNEU_C(0.9999e-10) && tol <= PNEU_C(1.0001e-2);
}

/* Whether a step has carried the stem through a stop: the repeat that ends on another event may miss it. */
static int is_through(const run *r)
{
  return pneu_dimension(r->model, r->state->mode) > r->model->n_gas &&
         !between_stops(r->model, r->work->y1[r->model->n_gas]);
}

/* Try steps from the present state until one is accepted. */
static int advance(run *r)
{
  const pneu_real tol = r->options->tol, left = left_of(r);
  pneu_workspace *w = r->work;
  int status, fresh = r->h <= 0, refused = 0;
  r->input = *r->given;
  r->input.elapsed += r->t;
  pneu_pack(r->model, r->state, w->y0);
  status = pneu_step_prepare(r->model, r->state, &r->input, w);
  if (status != PNEU_OK)
    return PNEU_E_NONFINITE;
  if (fresh)
    r->h = first_step(r);
  for (;;) {
    pneu_real error = 0, h = r->h, factor, tried, located;
    int which = -1;
    if (r->options->h_max > 0)
      h = PNEU_M(fmin)(h, r->options->h_max);
    if (r->model->term_step > 0)
      h = PNEU_M(fmin)(h, r->model->term_step);
    if (h > left * PNEU_C(0.999))
      h = left;
    if (!(h > PNEU_SHORTEST))
      return PNEU_E_STEP_SIZE;
    status = pneu_step_try(r->model, r->state, &r->input, h, w, &error);
    if (status < 0)
      return status;
    if (status != PNEU_OK || !(error <= tol) || leaps(r->model, r->state, &r->input, h, PNEU_BLEND, w)) {
      factor = status == PNEU_OK && error > tol && error < PNEU_C(1e30)
                   ? clip(PNEU_C(0.9) * root(tol / error), PNEU_C(0.1), PNEU_C(0.8))
                   : PNEU_C(0.2);
      r->h = h * factor;
      w->stats.rejected++;
      refused = 1;
      continue;
    }
    tried = h;
    factor = clip(next_factor(r, h, error), PNEU_C(0.2), refused ? 1 : fresh ? 10 : 6);
    status = pneu_locate(r->model, r->state, &r->input, w, &h, &which, &located);
    if (status < 0)
      return status;
    if (status != PNEU_OK || is_through(r)) {
      r->h = tried * PNEU_C(0.2);
      w->stats.rejected++;
      refused = 1;
      continue;
    }
    r->h_before = tried;
    r->error_before = PNEU_M(fmax)(error, PNEU_C(1e-4) * tol);
    if (tried < left || factor < 1) /* a step cut short by the end says little about the next */
      r->h = tried * factor;
    return accept(r, h, which);
  }
}

/* The command joins those on their way. */
static int give_command(const pneu_model *model, const pneu_input *input)
{
  pneu_delay *late = pneu_commands(input);
  const pneu_real delay = pneu_is_in_loop(model, input) ? 0 : model->command_delay;
  if (late)
    return pneu_delay_give(late, delay, input->u);
  return pneu_has_dead_time() && delay > 0 ? PNEU_E_DELAY : PNEU_OK;
}

/* Time passes, and the next command acts. */
static void pass_commands(pneu_delay *late, pneu_real dt)
{
  pneu_delay_pass(late, dt);
  pneu_delay_release(late);
}

/* On to r->end, under one command. */
static int run_stretch(run *r)
{
  int status = PNEU_OK;
  pneu_settle(r->model, r->given, r->state);
  while (left_of(r) > 8 * PNEU_EPS * r->end && status == PNEU_OK) {
    if (r->steps++ >= r->options->max_steps)
      return PNEU_E_STEP_COUNT;
    status = advance(r);
  }
  r->h = r->h_before = 0;
  return status;
}

int pneu_run(const pneu_model *model, pneu_state *state, const pneu_input *input, pneu_real duration,
             const pneu_options *options, const pneu_observer *observer, pneu_workspace *work)
{
  pneu_delay *late = pneu_commands(input);
  run r;
  int status;
  if (!usable(model, state, input, duration) || !in_range(duration, options->tol))
    return PNEU_E_NONFINITE;
  status = give_command(model, input);
  if (status != PNEU_OK)
    return status;
  r.model = model;
  r.given = input;
  r.options = options;
  r.observer = observer;
  r.state = state;
  r.work = work;
  r.t = 0;
  r.h = work->h;
  r.h_before = 0;
  r.error_before = 0;
  r.steps = 0;
  r.events_here = 0;
  r.event_t = -1;
  r.carry = 0;
  do {
    const pneu_real begin = r.t, left = duration - begin, stretch = late ? pneu_delay_until(late, left) : left;
    r.end = stretch < left ? begin + stretch : duration;
    status = run_stretch(&r);
    if (late)
      pass_commands(late, status == PNEU_OK ? stretch : r.t - begin);
  } while (status == PNEU_OK && r.end < duration);
  work->h = 0;
  return status;
}

/* The longest part that follows a stem whose velocity grows by itself, as where Stribeck friction lets go: the method
 * would damp what grows more than e-fold. */
static pneu_real longest_part(int n, int i_v, const pneu_workspace *work, pneu_real h)
{
  const pneu_real rate = n > i_v ? work->jac[i_v][i_v] : 0;
  return rate * h > 1 ? 1 / rate : h;
}

/* One part of a step. */
typedef struct step_part {
  pneu_real h;     /* [s] */
  pneu_real error; /* or one that asks for a shorter part */
  int which;       /* event that ends it, -1 if none */
} step_part;

/* One part of a step from `now`, shortened to end on an event. Its error is looked at again there: the event may have
 * been seen only because the estimate of the whole part was fooled.
 * Returns: PNEU_OK; PNEU_RETRY_STATE where a shorter part may do; < 0 */
static int part_of_step(const pneu_model *model, pneu_state *now, const pneu_input *input, pneu_workspace *work,
                        pneu_real tol, step_part *p)
{
  pneu_state next = *now;
  int status = pneu_step_try(model, now, input, p->h, work, &p->error);
  if (status == PNEU_OK && !(p->error <= tol))
    return PNEU_RETRY_STATE;
  if (status == PNEU_OK && !leaps(model, now, input, p->h, PNEU_BLEND + tol, work)) {
    status = pneu_locate(model, now, input, work, &p->h, &p->which, &p->error);
    pneu_unpack(model, work->y1, &next);
    if (!model->law.position_input)
      next.x = clip(next.x, model->lower_stop, model->upper_stop);
    if (status == PNEU_OK && p->error <= tol && is_sound(model, &next)) {
      *now = next;
      return PNEU_OK;
    }
  }
  p->error = 1000 * tol;
  return status < 0 ? status : PNEU_RETRY_STATE;
}

/* The parts are used up, as by a stem that bounces between its stops: it stands for what is left of the step, as if
 * there were none, and the gas goes on. */
static void hold(const pneu_model *model, pneu_state *now)
{
  if (model->law.position_input)
    return;
  now->mode = PNEU_MODE_FIXED;
  now->v = 0;
}

/* A step under one command, from a state and with an input in range.  In/out: input  as it is at the end */
static int step_on(const pneu_model *model, pneu_state *state, pneu_input *input, pneu_real dt, pneu_workspace *work)
{
  enum { FREE = PNEU_PARTS_MAX - PNEU_PARTS_HELD, FINE = FREE - PNEU_PARTS_COARSE }; /* the stem moves in FREE parts */
  pneu_state now = *state;
  pneu_real left = dt, h = dt, tol = PNEU_STEP_TOL;
  int i, status = PNEU_OK;
  pneu_settle(model, input, &now);
  for (i = 0; i < PNEU_PARTS_MAX && left > 0; i++) {
    step_part p = {0, 0, -1};
    if (i == FINE)
      tol = PNEU_COARSE_TOL;
    if (i == FREE) {
      hold(model, &now);
      h = left;
      tol = PNEU_HELD_TOL;
      status = PNEU_OK;
    }
    if (status == PNEU_OK) { /* from a new state */
      const int n = pneu_pack(model, &now, work->y0);
      if (pneu_step_prepare(model, &now, input, work) != PNEU_OK)
        return PNEU_E_NONFINITE;
      h = longest_part(n, model->n_gas + 1, work, h);
    }
    p.h = h;
    status = part_of_step(model, &now, input, work, tol, &p);
    if (status < 0)
      return status;
    if (status == PNEU_OK) {
      left -= p.h;
      input->elapsed += p.h;
      work->stats.steps++;
      if (p.which >= 0) {
        pneu_switch(model, input, p.which, &now);
        work->stats.events++;
        if (left <= PNEU_EVENT_TIME)
          left = 0;
      }
    } else
      work->stats.rejected++;
    if (left > 0)
      h = PNEU_M(fmin)(left, h * growth(PNEU_AIM * tol, p.error));
  }
  if (left > 0)
    return PNEU_E_STEP_COUNT;
  if (i > FREE)
    pneu_settle(model, input, &now);
  *state = now;
  return i > FREE ? PNEU_HELD : PNEU_OK;
}

int pneu_step(const pneu_model *model, pneu_state *state, const pneu_input *input, pneu_real dt, pneu_workspace *work)
{
  pneu_delay *late = pneu_commands(input), before;
  pneu_state now = *state;
  pneu_input acting = *input;
  int status;
  if (!usable(model, state, input, dt) || !(dt > 0 && dt * 0 == 0))
    return PNEU_E_NONFINITE;
  if (!late) {
    status = give_command(model, input);
    return status == PNEU_OK ? step_on(model, state, &acting, dt, work) : status;
  }
  before = *late;
  status = give_command(model, input);
  while (status >= 0 && dt > 0) {
    const pneu_real h = pneu_delay_until(late, dt);
    const int part = step_on(model, &now, &acting, h, work);
    status = part < 0 || part > status ? part : status;
    pass_commands(late, h);
    dt -= h;
  }
  if (status >= 0)
    *state = now;
  else
    *late = before;
  return status;
}

void pneu_dense(const pneu_step_view *view, pneu_real theta, pneu_state *state)
{
  pneu_real y[PNEU_STATE_MAX];
  *state = *view->start;
  pneu_dense_packed(view->work, pneu_dimension(view->model, state->mode), theta, y);
  pneu_unpack(view->model, y, state);
}

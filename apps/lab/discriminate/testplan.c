#include "testplan.h"

#include <math.h>
#include <string.h>

/* One move of a template: open by u until travel passes `level`, and stay so for some seconds more. */
typedef struct move {
  double u;       /* [1] */
  double level;   /* [1] of travel; ANYWHERE: do not wait for it */
  double seconds; /* [s] */
} move;

enum { ANYWHERE = -1 };

static const double longest = 300;   /* [s] of a trial; more is nobody's patience */
static const double patience = 600;  /* [s] for one full stroke */
static const double arrived = 0.999; /* of travel, counts as on the stop */

typedef struct template
{
  const char *text;
  move step[LAB_TEST_PLAN_STEPS]; /* up to one that takes no time and goes nowhere */
}
template;

/* clang-format off */

/* Moves: both orifices shut for some seconds, fully open up or down to a travel, home to the lower stop. */
#define SHUT(seconds)  {0, ANYWHERE, seconds}
#define UP_TO(level)   {1, level, 0}
#define DOWN_TO(level) {-1, level, 0}
#define HOME           {-1, 0, 2}

static const template usual = {"fill and vent", {SHUT(0.5), {1, 1, 2}, HOME}};

static const template templates[] = {
    {"hold at 20 % travel with both orifices shut for 10 s", {SHUT(0.5), UP_TO(0.2), SHUT(10), HOME}},
    {"hold at 50 % travel with both orifices shut for 10 s", {SHUT(0.5), UP_TO(0.5), SHUT(10), HOME}},
    {"hold at 80 % travel with both orifices shut for 10 s", {SHUT(0.5), UP_TO(0.8), SHUT(10), HOME}},
    {"hold at 20 % travel with both orifices shut for 30 s", {SHUT(0.5), UP_TO(0.2), SHUT(30), HOME}},
    {"hold at 50 % travel with both orifices shut for 30 s", {SHUT(0.5), UP_TO(0.5), SHUT(30), HOME}},
    {"hold at 80 % travel with both orifices shut for 30 s", {SHUT(0.5), UP_TO(0.8), SHUT(30), HOME}},
    {"staircase of short openings, five steps up and five down, with both orifices shut for 2 s after each",
     {SHUT(0.5), UP_TO(0.2), SHUT(2), UP_TO(0.4), SHUT(2), UP_TO(0.6), SHUT(2), UP_TO(0.8), SHUT(2), UP_TO(1),
      SHUT(2), DOWN_TO(0.8), SHUT(2), DOWN_TO(0.6), SHUT(2), DOWN_TO(0.4), SHUT(2), DOWN_TO(0.2), SHUT(2), HOME}},
    {"slow stroke from 45 to 55 % travel and back with 5 % opening",
     {SHUT(0.5), UP_TO(0.45), {0.05, 0.55, 0}, {-0.05, 0.45, 0}, HOME}},
    {"slow stroke from 45 to 55 % travel and back with 10 % opening",
     {SHUT(0.5), UP_TO(0.45), {0.1, 0.55, 0}, {-0.1, 0.45, 0}, HOME}},
    {"three full strokes up and down, fully open, with 1 s on each stop",
     {SHUT(0.5), {1, 1, 1}, {-1, 0, 1}, {1, 1, 1}, {-1, 0, 1}, {1, 1, 1}, {-1, 0, 1}}},
    {"staged vent from full travel: shut for 3 s at 75, 50 and 25 % travel",
     {SHUT(0.5), {1, 1, 2}, DOWN_TO(0.75), SHUT(3), DOWN_TO(0.5), SHUT(3), DOWN_TO(0.25), SHUT(3), HOME}},
    {"small steps between 45 and 55 % travel, with both orifices shut for 1 s after each",
     {SHUT(0.5), UP_TO(0.5), SHUT(1), UP_TO(0.55), SHUT(1), DOWN_TO(0.45), SHUT(1), UP_TO(0.55), SHUT(1),
      DOWN_TO(0.45), SHUT(1), UP_TO(0.55), SHUT(1), DOWN_TO(0.45), SHUT(1), HOME}},
    {"fill and vent with 15 s on each stop", {SHUT(0.5), {1, 1, 15}, {-1, 0, 15}}},
    {"vent only, from rest on the upper stop", {{1, -1, 0.5}, {-1, 0, 5}}},
};

/* clang-format on */

enum { TEMPLATES = sizeof templates / sizeof templates[0] };

/* ---- Times ---- */

/* Wait for a stem to pass a place. */
typedef struct crossing {
  double x;  /* [m] */
  int down;  /* which way */
  double at; /* [s] when it did, from the start of the run */
} crossing;

static int beyond(const crossing *c, const pneu_state *state)
{
  return c->down ? (double)state->x <= c->x : (double)state->x >= c->x;
}

static int watch(void *context, const pneu_step_view *view)
{
  crossing *c = context;
  double low = 0, high = 1;
  pneu_state state;
  int i;
  pneu_dense(view, 1, &state);
  if (!beyond(c, &state))
    return 0;
  for (i = 0; i < 30; i++) {
    const double middle = (low + high) / 2;
    pneu_dense(view, (pneu_real)middle, &state);
    *(beyond(c, &state) ? &high : &low) = middle;
  }
  c->at = (double)view->t + high * (double)view->h;
  return 1;
}

/* Under a command that has been acting: a dead time is over. */
static int run(const pneu_model *model, const pneu_input *input, double duration, const pneu_observer *observer,
               pneu_state *state)
{
  pneu_delay late;
  pneu_input acting = *input;
  pneu_workspace work;
  pneu_options options;
  pneu_delay_begin(&late, NULL, 0, input->u);
  acting.delay = &late;
  memset(&work, 0, sizeof work);
  pneu_options_default(&options);
  options.tol = 1e-5; /* times to a few milliseconds will do */
  pneu_settle(model, &acting, state);
  return pneu_run(model, state, &acting, (pneu_real)duration, &options, observer, &work);
}

/* Time [s] until the stem passes a level of travel.  Returns: the time; `limit` where it does not. */
static double time_to(const pneu_model *model, const pneu_input *input, double level, double limit,
                      const pneu_state *start)
{
  const double stop = fmin(fmax(level, 1 - arrived), arrived);
  crossing c = {(double)model->lower_stop + stop * (double)model->travel, input->u < 0, limit};
  const pneu_observer observer = {watch, NULL, &c};
  pneu_state state = *start;
  if (beyond(&c, start))
    return 0;
  return run(model, input, limit, &observer, &state) == PNEU_E_STOPPED ? c.at : limit;
}

/* ---- Building ---- */

/* A rig on its way through a template. */
typedef struct walk {
  const pneu_model *model;
  double stroke_time; /* [s] of a full stroke, fully open */
  pneu_state state;
} walk;

int lab_test_plan_start(const pneu_model *model, const pneu_input *input, double settle, pneu_state *state,
                        lab_error *error)
{
  int status = pneu_state_rest(model, 0, model->p.ambient_temperature, 0, input, state);
  if (status == PNEU_OK && input->u > 0)
    status = run(model, input, settle, NULL, state);
  if (status != PNEU_OK)
    return lab_fail(error, LAB_NUMERIC, "no state at rest to start from: %s", pneu_status_text(status));
  return LAB_OK;
}

/* Do one move.  Returns: whether it can be done. */
static int make_move(walk *w, const move *m, lab_test_plan *plan)
{
  const double limit = m->u != 0 ? 4 * w->stroke_time / fabs(m->u) : 0;
  double seconds = 0;
  pneu_input input;
  pneu_input_default(w->model, &input);
  input.u = (pneu_real)m->u;
  if (m->level >= 0)
    seconds = time_to(w->model, &input, m->level, limit, &w->state);
  if (seconds >= limit && m->level > 0 && m->level < 1)
    return 0; /* on the way to a stop it may end short of it: that too is a record */
  seconds += m->seconds;
  if (seconds > 0) {
    plan->t[plan->n] = plan->duration;
    plan->u[plan->n++] = m->u;
    plan->duration += seconds;
  }
  return plan->duration <= longest && run(w->model, &input, seconds, NULL, &w->state) == PNEU_OK;
}

/* Follow a template.  Returns: whether the rig can. */
static int follow(const pneu_model *model, const template *from, double stroke_time, double settle, lab_test_plan *plan)
{
  walk w = {.model = model, .stroke_time = stroke_time};
  pneu_input input;
  lab_error ignored;
  int i;
  memset(plan, 0, sizeof *plan);
  plan->text = from->text;
  pneu_input_default(model, &input);
  input.u = (pneu_real)from->step[0].u;
  if (lab_test_plan_start(model, &input, settle, &w.state, &ignored))
    return 0;
  for (i = 0; i < LAB_TEST_PLAN_STEPS && (from->step[i].seconds > 0 || from->step[i].u != 0); i++)
    if (!make_move(&w, &from->step[i], plan))
      return 0;
  return 1;
}

/* Whether commands move the stem of this rig. */
static int check(const lab_rig *rig, lab_error *error)
{
  if (rig->laws.pressure_input || rig->laws.position_input)
    return lab_fail(error, LAB_DATA, "measured %s drives the model: commands to the orifices do not act on it",
                    rig->laws.pressure_input ? "pressure" : "position");
  if (!(rig->params.stroke > 0))
    return lab_fail(error, LAB_DATA, "a vessel has no travel to step through");
  if (rig->params.proportional_band > 0)
    return lab_fail(error, LAB_DATA, "commands are set pressures of a regulator, not openings of the orifices");
  return LAB_OK;
}

/* Time of a full stroke, fully open. */
static int stroke_time(const pneu_model *model, double *seconds, lab_error *error)
{
  pneu_input input;
  pneu_state state;
  pneu_input_default(model, &input);
  if (lab_test_plan_start(model, &input, 0, &state, error))
    return error->status;
  input.u = 1;
  *seconds = time_to(model, &input, 0.95, patience, &state);
  if (!(*seconds > 0 && *seconds < patience))
    return lab_fail(error, LAB_DATA, "the supply does not move the stem through its travel within %g s", patience);
  return LAB_OK;
}

int lab_test_plans_build(const lab_rig *rig, lab_test_plans *plans, lab_error *error)
{
  pneu_model model;
  double seconds = 0;
  int i;
  memset(plans, 0, sizeof *plans);
  if (check(rig, error) || lab_rig_model(rig, &model, error) || stroke_time(&model, &seconds, error))
    return error->status;
  plans->settle = 10 * seconds + 5;
  if (!follow(&model, &usual, seconds, plans->settle, &plans->usual))
    return lab_fail(error, LAB_DATA, "a fill and vent of this rig takes more than %g s", longest);
  for (i = 0; i < TEMPLATES; i++)
    if (follow(&model, &templates[i], seconds, plans->settle, &plans->plan[plans->n]))
      plans->n++;
  return LAB_OK;
}

#include "cvode.h"

#include <stdlib.h>

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_version.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#if SUNDIALS_VERSION_MAJOR >= 7
#define CONTEXT_CREATE(context) SUNContext_Create(SUN_COMM_NULL, context)
typedef sunrealtype real;
#else
#define CONTEXT_CREATE(context) SUNContext_Create(NULL, context)
typedef realtype real;
#endif

/* A solver for one dimension of the packed vector; the dimension changes with the mode. */
typedef struct solver {
  void *memory;
  N_Vector y;
  SUNMatrix matrix;
  SUNLinearSolver linear;
} solver;

struct lab_cvode {
  SUNContext context;
  solver by_size[PNEU_STATE_MAX + 1];
  /* of the run in progress */
  const pneu_model *model;
  const lab_cvode_stretch *run;
  pneu_state *state;
};

#if SUNDIALS_VERSION_MAJOR >= 7
static void quiet(int line, const char *func, const char *file, const char *msg, SUNErrCode code, void *data,
                  SUNContext context)
{
  (void)line, (void)func, (void)file, (void)msg, (void)code, (void)data, (void)context;
}
#else
static void quiet(int code, const char *module, const char *function, char *msg, void *data)
{
  (void)code, (void)module, (void)function, (void)msg, (void)data;
}
#endif

lab_cvode *lab_cvode_new(void)
{
  lab_cvode *c = calloc(1, sizeof *c);
  if (c && CONTEXT_CREATE(&c->context)) {
    free(c);
    return NULL;
  }
#if SUNDIALS_VERSION_MAJOR >= 7
  if (c) {
    SUNContext_ClearErrHandlers(c->context);
    SUNContext_PushErrHandler(c->context, quiet, NULL);
  }
#endif
  return c;
}

static void solver_free(solver *s)
{
  if (s->memory)
    CVodeFree(&s->memory);
  if (s->linear)
    SUNLinSolFree(s->linear);
  if (s->matrix)
    SUNMatDestroy(s->matrix);
  if (s->y)
    N_VDestroy(s->y);
}

void lab_cvode_free(lab_cvode *c)
{
  int i;
  if (!c)
    return;
  for (i = 0; i <= PNEU_STATE_MAX; i++)
    solver_free(&c->by_size[i]);
  SUNContext_Free(&c->context);
  free(c);
}

/* What drives the model at a time of the stretch [s]. */
static pneu_input input_at(const lab_cvode *c, real t)
{
  pneu_input now = *c->run->input;
  now.elapsed += t;
  return now;
}

static int rhs(real t, N_Vector y, N_Vector dydt, void *data)
{
  lab_cvode *c = data;
  const pneu_input now = input_at(c, t);
  return pneu_rhs(c->model, c->state, &now, N_VGetArrayPointer(y), N_VGetArrayPointer(dydt));
}

static int jacobian(real t, N_Vector y, N_Vector f, SUNMatrix matrix, void *data, N_Vector w1, N_Vector w2, N_Vector w3)
{
  lab_cvode *c = data;
  const pneu_input now = input_at(c, t);
  pneu_real jac[PNEU_STATE_MAX][PNEU_STATE_MAX];
  const long n = SUNDenseMatrix_Rows(matrix);
  long i, j;
  int status;
  (void)w1, (void)w2, (void)w3;
  status = pneu_jacobian(c->model, c->state, &now, N_VGetArrayPointer(y), N_VGetArrayPointer(f), jac);
  if (status != PNEU_OK)
    return status;
  for (j = 0; j < n; j++)
    for (i = 0; i < n; i++)
      SM_ELEMENT_D(matrix, i, j) = jac[i][j];
  return 0;
}

static int events(real t, N_Vector y, real *g, void *data)
{
  lab_cvode *c = data;
  const pneu_input now = input_at(c, t);
  const int n = pneu_events(c->model, c->state, &now, N_VGetArrayPointer(y), g);
  int i;
  for (i = n; i < PNEU_EVENT_MAX; i++)
    g[i] = -1;
  return 0;
}

/* The same weights as the stepper's. */
static int weights(N_Vector y, N_Vector w, void *data)
{
  lab_cvode *c = data;
  pneu_real scale[PNEU_STATE_MAX], *out = N_VGetArrayPointer(w);
  long i, n = N_VGetLength(w);
  (void)y;
  pneu_scales(c->model, scale);
  for (i = 0; i < n; i++)
    out[i] = 1 / (c->run->tol * scale[i]);
  return 0;
}

static int solver_create(lab_cvode *c, solver *s, int n)
{
  int direction[PNEU_EVENT_MAX] = {1, 1, 1};
  s->y = N_VNew_Serial(n, c->context);
  s->matrix = SUNDenseMatrix(n, n, c->context);
  s->memory = CVodeCreate(CV_BDF, c->context);
  if (!s->y || !s->matrix || !s->memory)
    return -1;
  s->linear = SUNLinSol_Dense(s->y, s->matrix, c->context);
#if SUNDIALS_VERSION_MAJOR < 7
  CVodeSetErrHandlerFn(s->memory, quiet, NULL);
#endif
  if (!s->linear || CVodeInit(s->memory, rhs, 0.0, s->y) || CVodeWFtolerances(s->memory, weights) ||
      CVodeSetUserData(s->memory, c) || CVodeSetLinearSolver(s->memory, s->linear, s->matrix) ||
      CVodeSetJacFn(s->memory, jacobian) || CVodeRootInit(s->memory, PNEU_EVENT_MAX, events) ||
      CVodeSetRootDirection(s->memory, direction) || CVodeSetMaxNumSteps(s->memory, 1000000))
    return -1;
  CVodeSetNoInactiveRootWarn(s->memory);
  return 0;
}

/* The solver for the mode's dimension, started at t. */
static solver *solver_start(lab_cvode *c, double t, double end)
{
  const int n = pneu_dimension(c->model, c->state->mode);
  solver *s = &c->by_size[n];
  if (!s->memory && solver_create(c, s, n))
    return NULL;
  pneu_pack(c->model, c->state, N_VGetArrayPointer(s->y));
  if (CVodeReInit(s->memory, t, s->y) || CVodeSetStopTime(s->memory, end) ||
      CVodeSetMaxStep(s->memory, c->model->term_step))
    return NULL;
  return s;
}

static void count(solver *s, pneu_stats *stats)
{
  long steps, rhs_calls, failed, jacobians;
  if (!stats)
    return;
  CVodeGetNumSteps(s->memory, &steps);
  CVodeGetNumRhsEvals(s->memory, &rhs_calls);
  CVodeGetNumErrTestFails(s->memory, &failed);
  CVodeGetNumJacEvals(s->memory, &jacobians);
  stats->steps += steps;
  stats->rhs += rhs_calls;
  stats->rejected += failed;
  stats->jacobians += jacobians;
}

static int give_up(lab_cvode *c, int flag, double t, lab_error *error)
{
  char *name = CVodeGetReturnFlagName(flag);
  lab_fail(error, LAB_NUMERIC,
           "CVODE stopped with %s at t = %.9g s, %s, p = %.9g Pa, T = %.6g K, x = %.9g m, v = %.6g m/s", name, t,
           pneu_mode_text(c->state->mode), c->state->p, c->state->T, c->state->x, c->state->v);
  free(name);
  return LAB_NUMERIC;
}

static int fired(solver *s)
{
  int info[PNEU_EVENT_MAX], i;
  CVodeGetRootInfo(s->memory, info);
  for (i = 0; i < PNEU_EVENT_MAX; i++)
    if (info[i])
      return i;
  return 0;
}

static int sample_step(lab_cvode *c, solver *s, double t)
{
  lab_sampler *sampler = c->run->sampler;
  pneu_state at = *c->state;
  N_Vector y = N_VClone(s->y);
  if (!y)
    return -1;
  while (lab_sampler_due(sampler) <= t) {
    CVodeGetDky(s->memory, lab_sampler_due(sampler), 0, y);
    pneu_unpack(c->model, N_VGetArrayPointer(y), &at);
    lab_sampler_take(sampler, &at);
  }
  N_VDestroy(y);
  return 0;
}

int lab_cvode_run(lab_cvode *c, const pneu_model *model, const lab_cvode_stretch *run, pneu_state *state,
                  lab_error *error)
{
  double t = 0;
  c->model = model;
  c->run = run;
  c->state = state;
  pneu_settle(model, run->input, state);
  while (t < run->duration) {
    solver *s = solver_start(c, t, run->duration);
    int flag = CV_SUCCESS;
    if (!s)
      return lab_fail_memory(error, "CVODE");
    while (flag == CV_SUCCESS) {
      flag = CVode(s->memory, run->duration, s->y, &t, CV_ONE_STEP);
      if (flag < 0)
        return give_up(c, flag, t, error);
      if (run->sampler && sample_step(c, s, t))
        return lab_fail_memory(error, "CVODE");
    }
    pneu_unpack(model, N_VGetArrayPointer(s->y), state);
    count(s, run->stats);
    if (flag == CV_ROOT_RETURN) {
      pneu_switch(model, run->input, fired(s), state);
      if (run->stats)
        run->stats->events++;
    }
  }
  return LAB_OK;
}

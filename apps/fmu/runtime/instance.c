/* Life of an instance: what may be called when, and from parameters to a state at rest. */
#include "instance.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "private.h"

enum { BEFORE = FMU_INSTANTIATED | FMU_INITIALIZING, RUNNING = FMU_EVENT | FMU_CONTINUOUS | FMU_STEPPING };

static const struct {
  const char *what;
  int phases;
} calls[] = {
    [FMU_CALL_SETUP] = {"setting up the experiment", FMU_INSTANTIATED},
    [FMU_CALL_ENTER_INITIALIZATION] = {"entering initialization", FMU_INSTANTIATED},
    [FMU_CALL_EXIT_INITIALIZATION] = {"leaving initialization", FMU_INITIALIZING},
    [FMU_CALL_TERMINATE] = {"terminating", RUNNING},
    [FMU_CALL_GET] = {"getting values", BEFORE | RUNNING | FMU_TERMINATED},
    [FMU_CALL_DIFFERENTIATE] = {"asking for derivatives", FMU_INITIALIZING | RUNNING | FMU_TERMINATED},
    [FMU_CALL_SET_PARAMETER] = {"setting parameters and start values", BEFORE},
    [FMU_CALL_SET_INPUT] = {"setting inputs", BEFORE | RUNNING},
    [FMU_CALL_ENTER_EVENT] = {"entering event mode", FMU_CONTINUOUS},
    [FMU_CALL_ENTER_CONTINUOUS] = {"entering continuous-time mode", FMU_EVENT},
    [FMU_CALL_UPDATE] = {"updating discrete states", FMU_EVENT},
    [FMU_CALL_COMPLETED_STEP] = {"completing an integrator's step", FMU_CONTINUOUS},
    [FMU_CALL_SET_TIME] = {"setting time", FMU_EVENT | FMU_CONTINUOUS},
    [FMU_CALL_SET_STATES] = {"setting continuous states", FMU_CONTINUOUS},
    [FMU_CALL_GET_STATES] = {"getting states, derivatives and indicators", FMU_INITIALIZING | RUNNING | FMU_TERMINATED},
    [FMU_CALL_STEP] = {"doing a step", FMU_STEPPING},
    [FMU_CALL_ANY] = {"anything", ~0},
};

int fmu_say(const fmu_instance *instance, int status, const char *format, ...)
{
  char text[256];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  if (instance->say)
    instance->say(instance, status, text);
  return status;
}

const char *fmu_category(int status)
{
  return status == FMU_WARNING ? "logStatusWarning" : "logStatusError";
}

int fmu_may(fmu_instance *instance, int call)
{
  if (!instance)
    return FMU_ERROR;
  if (instance->m.phase & calls[call].phases)
    return FMU_OK;
  return fmu_say(instance, FMU_ERROR, "%s is not allowed now", calls[call].what);
}

int fmu_absent(fmu_instance *instance, const char *what)
{
  return instance ? fmu_say(instance, FMU_ERROR, "%s is not supported", what) : FMU_ERROR;
}

/* ---- Begin and end ---- */

/* As it is exported. */
static void begin(fmu_instance *i, int kind)
{
  const pneu_params *p = &fmu_model_data.params;
  fmu_memory *m = &i->m;
  memset(m, 0, sizeof *m);
  strcpy(m->token, fmu_model_data.token);
  m->kind = kind;
  m->phase = FMU_INSTANTIATED;
  m->stale = 1;
  m->stop_time = HUGE_VAL;
  m->tol = 1e-7;
  m->params = *p;
  m->input[FMU_INPUT_SUPPLY] = (double)p->supply_pressure;
  m->start[FMU_START_TEMPERATURE] = (double)p->ambient_temperature;
}

static char *copy_of(const char *text)
{
  char *copy = malloc(strlen(text) + 1);
  return copy ? strcpy(copy, text) : NULL;
}

fmu_instance *fmu_new(int kind, const char *name, const char *token, void *environment, void (*logger)(void),
                      void (*say)(const fmu_instance *, int, const char *))
{
  fmu_instance *i = calloc(1, sizeof *i);
  if (!i || !(i->name = copy_of(name ? name : ""))) {
    free(i);
    return NULL;
  }
  i->environment = environment;
  i->logger = logger;
  i->say = say;
  begin(i, kind);
  if (!token || strcmp(token, fmu_model_data.token) != 0) {
    fmu_say(i, FMU_ERROR, "the token is not that of this FMU: binary and modelDescription.xml do not match");
    fmu_free(i);
    return NULL;
  }
  if (fmu_model(&fmu_model_data, &i->m.params, &i->model, NULL) != PNEU_OK) {
    fmu_free(i);
    return NULL;
  }
  fmu_shape_of(&i->model, &i->shape);
  return i;
}

void fmu_free(fmu_instance *instance)
{
  if (instance)
    free(instance->name);
  free(instance);
}

int fmu_reset(fmu_instance *instance)
{
  if (fmu_may(instance, FMU_CALL_ANY))
    return FMU_ERROR;
  begin(instance, instance->m.kind);
  return FMU_OK;
}

int fmu_terminate(fmu_instance *instance)
{
  if (fmu_may(instance, FMU_CALL_TERMINATE))
    return FMU_ERROR;
  instance->m.phase = FMU_TERMINATED;
  return FMU_OK;
}

/* ---- Initialisation ---- */

int fmu_setup(fmu_instance *instance, double tol, double start_time, double stop_time)
{
  int k;
  if (fmu_may(instance, FMU_CALL_SETUP))
    return FMU_ERROR;
  if (!(start_time * 0 == 0) || !(stop_time >= start_time) || !(tol >= 0))
    return fmu_say(instance, FMU_ERROR, "start time, stop time or tolerance is not a number, or out of order");
  instance->m.time = start_time;
  for (k = 0; k < FMU_INPUT_COUNT; k++)
    instance->m.set_at[k] = start_time;
  instance->m.stop_time = stop_time;
  if (tol > 0)
    instance->m.tol = fmin(fmax(tol, 1e-10), 1e-2);
  instance->m.stale = 1;
  return FMU_OK;
}

int fmu_enter_initialization(fmu_instance *instance)
{
  if (fmu_may(instance, FMU_CALL_ENTER_INITIALIZATION))
    return FMU_ERROR;
  instance->m.phase = FMU_INITIALIZING;
  return FMU_OK;
}

int fmu_exit_initialization(fmu_instance *instance)
{
  if (fmu_may(instance, FMU_CALL_EXIT_INITIALIZATION) || fmu_refresh(instance))
    return FMU_ERROR;
  instance->m.phase = instance->m.kind == FMU_CO_SIMULATION ? FMU_STEPPING : FMU_EVENT;
  return FMU_OK;
}

static int make_model(fmu_instance *i)
{
  int bad = -1, status = fmu_model(&fmu_model_data, &i->m.params, &i->model, &bad);
  pneu_param_info info;
  if (bad >= 0) {
    pneu_param_describe(bad, &info);
    return fmu_say(i, FMU_ERROR, "%s must be within %g..%g %s", info.name, (double)info.lower, (double)info.upper,
                   info.unit);
  }
  if (status != PNEU_OK)
    return fmu_say(i, FMU_ERROR, "%s", pneu_status_text(status));
  if (fmu_command_kind(&i->m.params) != fmu_command_kind(&fmu_model_data.params))
    return fmu_say(i, FMU_ERROR,
                   "proportional_band and gain must stay above 0: without them the command means something else");
  if (!fmu_fits(&i->shape, &i->model))
    return fmu_say(i, FMU_ERROR,
                   "these parameters switch on an effect with a state that this FMU does not have: switch "
                   "it on in the model file and export that");
  return FMU_OK;
}

int fmu_refresh(fmu_instance *i)
{
  fmu_memory *m = &i->m;
  const pneu_laws *law = &fmu_model_data.law;
  pneu_input input;
  double p, x;
  int status;
  if (!m->stale || !(m->phase & BEFORE))
    return FMU_OK;
  if (make_model(i))
    return FMU_ERROR;
  fmu_delay_begin(&m->delay, fmu_command_kind(&m->params) == FMU_COMMAND_POSITION ? 0 : (double)i->model.command_delay,
                  m->time, m->input[FMU_INPUT_U]);
  fmu_drive(i, &input);
  p = law->pressure_input ? fmu_driven_pressure(i) : m->start[FMU_START_PRESSURE];
  x = law->position_input ? fmu_driven_position(i) : m->start[FMU_START_POSITION];
  status = input.supply_pressure > -m->params.ambient_pressure
               ? pneu_state_rest(&i->model, p, m->start[FMU_START_TEMPERATURE], x, &input, &m->state)
               : PNEU_E_NONFINITE;
  if (status != PNEU_OK)
    return fmu_say(i, FMU_ERROR, "no state at rest: start_position must be within 0..stroke, pressures above vacuum");
  fmu_impose(i);
  m->x_seen = m->state.x;
  fmu_pass_to(i, m->time);
  fmu_arm(i);
  m->stale = 0;
  return FMU_OK;
}

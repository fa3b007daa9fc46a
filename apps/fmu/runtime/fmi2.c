/* FMI 2.0: each function of the standard in terms of instance.h. */
#include "fmi2.h"

#include <math.h>

#include "instance.h"

static void say(const fmu_instance *instance, int status, const char *text)
{
  const fmi2CallbackLogger logger = (fmi2CallbackLogger)instance->logger;
  if (logger)
    logger(instance->environment, instance->name, (fmi2Status)status, fmu_category(status), "%s", text);
}

/* ---- Life ---- */

FMI2_EXPORT(const char *, fmi2GetTypesPlatform, (void))
{
  return "default";
}

FMI2_EXPORT(const char *, fmi2GetVersion, (void))
{
  return "2.0";
}

FMI2_EXPORT(fmi2Status, fmi2SetDebugLogging, (fmi2Component c, fmi2Boolean on, size_t n, const fmi2String categories[]))
{
  (void)on, (void)n, (void)categories; /* only warnings and errors are told, and always */
  return c ? fmi2OK : fmi2Error;
}

FMI2_EXPORT(fmi2Component, fmi2Instantiate,
            (fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
             const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging))
{
  (void)resources, (void)visible, (void)logging;
  return fmu_new(type == fmi2CoSimulation ? FMU_CO_SIMULATION : FMU_MODEL_EXCHANGE, name, guid,
                 functions ? functions->componentEnvironment : NULL,
                 functions ? (void (*)(void))functions->logger : NULL, say);
}

FMI2_EXPORT(void, fmi2FreeInstance, (fmi2Component c))
{
  fmu_free(c);
}

FMI2_EXPORT(fmi2Status, fmi2SetupExperiment,
            (fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start, fmi2Boolean has_stop,
             fmi2Real stop))
{
  return (fmi2Status)fmu_setup(c, has_tolerance ? tolerance : 0, start, has_stop ? stop : HUGE_VAL);
}

/* ---- Functions that hand on what they are given ---- */

#define FORWARD(name, call, parameters, arguments)                                                                     \
  FMI2_EXPORT(fmi2Status, name, parameters)                                                                            \
  {                                                                                                                    \
    return (fmi2Status)call arguments;                                                                                 \
  }

/* ---- Functions of the instance alone ---- */

#define OF_INSTANCE(name, call) FORWARD(name, call, (fmi2Component c), (c))
OF_INSTANCE(fmi2EnterInitializationMode, fmu_enter_initialization)
OF_INSTANCE(fmi2ExitInitializationMode, fmu_exit_initialization)
OF_INSTANCE(fmi2Terminate, fmu_terminate)
OF_INSTANCE(fmi2Reset, fmu_reset)
OF_INSTANCE(fmi2EnterEventMode, fmu_enter_event)
OF_INSTANCE(fmi2EnterContinuousTimeMode, fmu_enter_continuous)

/* ---- Functions of the states ---- */

#define OF_VECTOR(name, type, call) FORWARD(name, call, (fmi2Component c, type value[], size_t n), (c, value, n))
OF_VECTOR(fmi2SetContinuousStates, const fmi2Real, fmu_set_states)
OF_VECTOR(fmi2GetDerivatives, fmi2Real, fmu_get_rates)
OF_VECTOR(fmi2GetEventIndicators, fmi2Real, fmu_get_indicators)
OF_VECTOR(fmi2GetContinuousStates, fmi2Real, fmu_get_states)
OF_VECTOR(fmi2GetNominalsOfContinuousStates, fmi2Real, fmu_get_nominals)

/* ---- Values ---- */

FORWARD(fmi2GetReal, fmu_get_real, (fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Real value[]),
        (c, r, n, value))
FORWARD(fmi2GetInteger, fmu_get_integer, (fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Integer value[]),
        (c, r, n, value))
FORWARD(fmi2SetReal, fmu_set_real, (fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Real value[]),
        (c, r, n, value))

/* Types of which there is no variable: only an empty list is right. */
#define NO_VARIABLE(name, type)                                                                                        \
  FMI2_EXPORT(fmi2Status, name, (fmi2Component c, const fmi2ValueReference r[], size_t n, type value[]))               \
  {                                                                                                                    \
    (void)r, (void)value;                                                                                              \
    return c && n == 0 ? fmi2OK : (fmi2Status)fmu_absent(c, #name);                                                    \
  }
NO_VARIABLE(fmi2GetBoolean, fmi2Boolean)
NO_VARIABLE(fmi2GetString, fmi2String)
NO_VARIABLE(fmi2SetInteger, const fmi2Integer)
NO_VARIABLE(fmi2SetBoolean, const fmi2Boolean)
NO_VARIABLE(fmi2SetString, const fmi2String)

/* ---- FMU state ---- */

FORWARD(fmi2GetFMUstate, fmu_get_memory, (fmi2Component c, fmi2FMUstate *state), (c, state))
FORWARD(fmi2SetFMUstate, fmu_set_memory, (fmi2Component c, fmi2FMUstate state), (c, state))
FORWARD(fmi2FreeFMUstate, fmu_free_memory, (fmi2Component c, fmi2FMUstate *state), (c, state))
FORWARD(fmi2SerializedFMUstateSize, fmu_memory_size, (fmi2Component c, fmi2FMUstate state, size_t *size),
        (c, state, size))
FORWARD(fmi2SerializeFMUstate, fmu_write_memory, (fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size),
        (c, state, bytes, size))
FORWARD(fmi2DeSerializeFMUstate, fmu_read_memory,
        (fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state), (c, bytes, size, state))
FORWARD(fmi2GetDirectionalDerivative, fmu_derivative,
        (fmi2Component c, const fmi2ValueReference unknown[], size_t n_unknown, const fmi2ValueReference known[],
         size_t n_known, const fmi2Real seed[], fmi2Real sensitivity[]),
        (c, unknown, n_unknown, known, n_known, seed, sensitivity))

/* ---- Model exchange ---- */

FMI2_EXPORT(fmi2Status, fmi2NewDiscreteStates, (fmi2Component c, fmi2EventInfo *info))
{
  fmu_event event;
  const int status = fmu_update(c, &event);
  if (status != FMU_OK)
    return (fmi2Status)status;
  info->newDiscreteStatesNeeded = info->terminateSimulation = info->nominalsOfContinuousStatesChanged = 0;
  info->valuesOfContinuousStatesChanged = event.states_changed;
  info->nextEventTimeDefined = event.next_time < HUGE_VAL;
  info->nextEventTime = event.next_time < HUGE_VAL ? event.next_time : 0;
  return fmi2OK;
}

FMI2_EXPORT(fmi2Status, fmi2CompletedIntegratorStep,
            (fmi2Component c, fmi2Boolean no_set_before, fmi2Boolean *enter_event, fmi2Boolean *terminate))
{
  (void)no_set_before;
  *terminate = 0;
  return (fmi2Status)fmu_completed_step(c, enter_event);
}

FORWARD(fmi2SetTime, fmu_set_time, (fmi2Component c, fmi2Real time), (c, time))

/* ---- Co-simulation ---- */

FMI2_EXPORT(fmi2Status, fmi2DoStep, (fmi2Component c, fmi2Real from, fmi2Real length, fmi2Boolean no_set_before))
{
  (void)no_set_before;
  return (fmi2Status)fmu_step(c, from, length);
}

FORWARD(fmi2SetRealInputDerivatives, fmu_set_slopes,
        (fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Integer order[], const fmi2Real value[]),
        (c, r, n, order, value))

FMI2_EXPORT(fmi2Status, fmi2GetRealOutputDerivatives,
            (fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Integer order[], fmi2Real value[]))
{
  (void)r, (void)n, (void)order, (void)value;
  return (fmi2Status)fmu_absent(c, "fmi2GetRealOutputDerivatives");
}

FORWARD(fmi2CancelStep, fmu_absent, (fmi2Component c), (c, "fmi2CancelStep"))

/* A step that is discarded leaves the instance where it was before it. */
FMI2_EXPORT(fmi2Status, fmi2GetRealStatus, (fmi2Component c, const fmi2StatusKind kind, fmi2Real *value))
{
  if (!c || kind != fmi2LastSuccessfulTime)
    return (fmi2Status)fmu_absent(c, "this status");
  *value = ((fmu_instance *)c)->m.time;
  return fmi2OK;
}

FMI2_EXPORT(fmi2Status, fmi2GetBooleanStatus, (fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value))
{
  if (!c || kind != fmi2Terminated)
    return (fmi2Status)fmu_absent(c, "this status");
  *value = 0;
  return fmi2OK;
}

#define NO_STATUS(name, type)                                                                                          \
  FMI2_EXPORT(fmi2Status, name, (fmi2Component c, const fmi2StatusKind kind, type *value))                             \
  {                                                                                                                    \
    (void)kind, (void)value;                                                                                           \
    return (fmi2Status)fmu_absent(c, "this status");                                                                   \
  }
NO_STATUS(fmi2GetStatus, fmi2Status)
NO_STATUS(fmi2GetIntegerStatus, fmi2Integer)
NO_STATUS(fmi2GetStringStatus, fmi2String)

/* FMI 3.0: each function of the standard in terms of instance.h; what this FMU does not have is in fmi3_absent.c. */
#include "fmi3.h"

#include <math.h>

#include "instance.h"

static void say(const fmu_instance *instance, int status, const char *text)
{
  const fmi3LogMessageCallback logger = (fmi3LogMessageCallback)instance->logger;
  if (logger)
    logger(instance->environment, (fmi3Status)status, fmu_category(status), text);
}

/* ---- Life ---- */

FMI3_EXPORT_AS(const char *, fmi3GetVersion, (void))
{
  return "3.0";
}

FMI3_EXPORT(fmi3SetDebugLogging, (fmi3Instance c, fmi3Boolean on, size_t n, const fmi3String categories[]))
{
  (void)on, (void)n, (void)categories; /* only warnings and errors are told, and always */
  return c ? fmi3OK : fmi3Error;
}

FMI3_EXPORT_AS(fmi3Instance, fmi3InstantiateModelExchange,
               (fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
                fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger))
{
  (void)resources, (void)visible, (void)logging;
  return fmu_new(FMU_MODEL_EXCHANGE, name, token, environment, (void (*)(void))logger, say);
}

FMI3_EXPORT_AS(fmi3Instance, fmi3InstantiateCoSimulation,
               (fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
                fmi3Boolean event_mode, fmi3Boolean early_return, const fmi3ValueReference intermediate[],
                size_t n_intermediate, fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger,
                fmi3IntermediateUpdateCallback update))
{
  (void)resources, (void)visible, (void)logging, (void)early_return, (void)intermediate, (void)n_intermediate;
  (void)update;
  return event_mode ? NULL /* hasEventMode is false */
                    : fmu_new(FMU_CO_SIMULATION, name, token, environment, (void (*)(void))logger, say);
}

FMI3_EXPORT_AS(void, fmi3FreeInstance, (fmi3Instance c))
{
  fmu_free(c);
}

FMI3_EXPORT(fmi3EnterInitializationMode, (fmi3Instance c, fmi3Boolean has_tolerance, fmi3Float64 tolerance,
                                          fmi3Float64 start, fmi3Boolean has_stop, fmi3Float64 stop))
{
  const int status = fmu_setup(c, has_tolerance ? tolerance : 0, start, has_stop ? stop : HUGE_VAL);
  return (fmi3Status)(status == FMU_OK ? fmu_enter_initialization(c) : status);
}

/* ---- Functions that hand on what they are given ---- */

#define FORWARD(name, call, parameters, arguments)                                                                     \
  FMI3_EXPORT(name, parameters)                                                                                        \
  {                                                                                                                    \
    return (fmi3Status)call arguments;                                                                                 \
  }

/* ---- Functions of the instance alone ---- */

#define OF_INSTANCE(name, call) FORWARD(name, call, (fmi3Instance c), (c))
OF_INSTANCE(fmi3ExitInitializationMode, fmu_exit_initialization)
OF_INSTANCE(fmi3Terminate, fmu_terminate)
OF_INSTANCE(fmi3Reset, fmu_reset)
OF_INSTANCE(fmi3EnterEventMode, fmu_enter_event)
OF_INSTANCE(fmi3EnterContinuousTimeMode, fmu_enter_continuous)

/* ---- Functions of the states ---- */

#define OF_VECTOR(name, type, call) FORWARD(name, call, (fmi3Instance c, type value[], size_t n), (c, value, n))
OF_VECTOR(fmi3SetContinuousStates, const fmi3Float64, fmu_set_states)
OF_VECTOR(fmi3GetContinuousStateDerivatives, fmi3Float64, fmu_get_rates)
OF_VECTOR(fmi3GetEventIndicators, fmi3Float64, fmu_get_indicators)
OF_VECTOR(fmi3GetContinuousStates, fmi3Float64, fmu_get_states)
OF_VECTOR(fmi3GetNominalsOfContinuousStates, fmi3Float64, fmu_get_nominals)

/* ---- Values: all are scalars ---- */

FMI3_EXPORT(fmi3GetFloat64,
            (fmi3Instance c, const fmi3ValueReference r[], size_t n, fmi3Float64 value[], size_t n_values))
{
  return (fmi3Status)(n == n_values ? fmu_get_real(c, r, n, value) : fmu_absent(c, "an array"));
}

FMI3_EXPORT(fmi3GetInt32, (fmi3Instance c, const fmi3ValueReference r[], size_t n, fmi3Int32 value[], size_t n_values))
{
  return (fmi3Status)(n == n_values ? fmu_get_integer(c, r, n, value) : fmu_absent(c, "an array"));
}

FMI3_EXPORT(fmi3SetFloat64,
            (fmi3Instance c, const fmi3ValueReference r[], size_t n, const fmi3Float64 value[], size_t n_values))
{
  return (fmi3Status)(n == n_values ? fmu_set_real(c, r, n, value) : fmu_absent(c, "an array"));
}

FMI3_EXPORT(fmi3GetDirectionalDerivative,
            (fmi3Instance c, const fmi3ValueReference unknown[], size_t n_unknown, const fmi3ValueReference known[],
             size_t n_known, const fmi3Float64 seed[], size_t n_seed, fmi3Float64 sensitivity[], size_t n_sensitivity))
{
  if (n_seed != n_known || n_sensitivity != n_unknown)
    return (fmi3Status)fmu_absent(c, "an array");
  return (fmi3Status)fmu_derivative(c, unknown, n_unknown, known, n_known, seed, sensitivity);
}

/* ---- FMU state ---- */

FORWARD(fmi3GetFMUState, fmu_get_memory, (fmi3Instance c, fmi3FMUState *state), (c, state))
FORWARD(fmi3SetFMUState, fmu_set_memory, (fmi3Instance c, fmi3FMUState state), (c, state))
FORWARD(fmi3FreeFMUState, fmu_free_memory, (fmi3Instance c, fmi3FMUState *state), (c, state))
FORWARD(fmi3SerializedFMUStateSize, fmu_memory_size, (fmi3Instance c, fmi3FMUState state, size_t *size),
        (c, state, size))
FORWARD(fmi3SerializeFMUState, fmu_write_memory, (fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size),
        (c, state, bytes, size))
FORWARD(fmi3DeserializeFMUState, fmu_read_memory,
        (fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState *state), (c, bytes, size, state))

/* ---- Model exchange ---- */

FMI3_EXPORT(fmi3UpdateDiscreteStates,
            (fmi3Instance c, fmi3Boolean *update_again, fmi3Boolean *terminate, fmi3Boolean *nominals_changed,
             fmi3Boolean *states_changed, fmi3Boolean *has_next_time, fmi3Float64 *next_time))
{
  fmu_event event;
  const int status = fmu_update(c, &event);
  if (status != FMU_OK)
    return (fmi3Status)status;
  *update_again = *terminate = *nominals_changed = false;
  *states_changed = event.states_changed != 0;
  *has_next_time = event.next_time < HUGE_VAL;
  *next_time = event.next_time < HUGE_VAL ? event.next_time : 0;
  return fmi3OK;
}

FMI3_EXPORT(fmi3CompletedIntegratorStep,
            (fmi3Instance c, fmi3Boolean no_set_before, fmi3Boolean *enter_event, fmi3Boolean *terminate))
{
  int enter = 0;
  const int status = fmu_completed_step(c, &enter);
  (void)no_set_before;
  *enter_event = enter != 0;
  *terminate = false;
  return (fmi3Status)status;
}

FORWARD(fmi3SetTime, fmu_set_time, (fmi3Instance c, fmi3Float64 time), (c, time))
FORWARD(fmi3GetNumberOfEventIndicators, fmu_count, (fmi3Instance c, size_t *n), (c, NULL, n))
FORWARD(fmi3GetNumberOfContinuousStates, fmu_count, (fmi3Instance c, size_t *n), (c, n, NULL))

/* ---- Co-simulation ---- */

/* A step that is discarded leaves the instance where it was before it. */
FMI3_EXPORT(fmi3DoStep, (fmi3Instance c, fmi3Float64 from, fmi3Float64 length, fmi3Boolean no_set_before,
                         fmi3Boolean *event, fmi3Boolean *terminate, fmi3Boolean *early_return, fmi3Float64 *last_time))
{
  const int status = fmu_step(c, from, length);
  (void)no_set_before;
  *event = *terminate = *early_return = false;
  if (c)
    *last_time = ((fmu_instance *)c)->m.time;
  return (fmi3Status)status;
}

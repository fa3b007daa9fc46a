/* FMI 3.0: functions for what this FMU does not have. modelDescription.xml says so, and they return an error, but for
 * lists of no variables, which are right of any type. */
#include "fmi3.h"
#include "instance.h"

/* In: unused  parameters but c and n, as an expression */
#define NO_LIST(name, parameters, unused)                                                                              \
  FMI3_EXPORT(name, parameters)                                                                                        \
  {                                                                                                                    \
    unused;                                                                                                            \
    return c && n == 0 ? fmi3OK : (fmi3Status)fmu_absent(c, #name);                                                    \
  }
#define ABSENT(name, parameters, unused)                                                                               \
  FMI3_EXPORT(name, parameters)                                                                                        \
  {                                                                                                                    \
    unused;                                                                                                            \
    return (fmi3Status)fmu_absent(c, #name);                                                                           \
  }

#define NO_VARIABLE(name, type)                                                                                        \
  NO_LIST(name, (fmi3Instance c, const fmi3ValueReference r[], size_t n, type value[], size_t n_values),               \
          ((void)r, (void)value, (void)n_values))
NO_VARIABLE(fmi3GetFloat32, fmi3Float32)
NO_VARIABLE(fmi3GetInt8, fmi3Int8)
NO_VARIABLE(fmi3GetUInt8, fmi3UInt8)
NO_VARIABLE(fmi3GetInt16, fmi3Int16)
NO_VARIABLE(fmi3GetUInt16, fmi3UInt16)
NO_VARIABLE(fmi3GetUInt32, fmi3UInt32)
NO_VARIABLE(fmi3GetInt64, fmi3Int64)
NO_VARIABLE(fmi3GetUInt64, fmi3UInt64)
NO_VARIABLE(fmi3GetBoolean, fmi3Boolean)
NO_VARIABLE(fmi3GetString, fmi3String)
NO_VARIABLE(fmi3SetFloat32, const fmi3Float32)
NO_VARIABLE(fmi3SetInt8, const fmi3Int8)
NO_VARIABLE(fmi3SetUInt8, const fmi3UInt8)
NO_VARIABLE(fmi3SetInt16, const fmi3Int16)
NO_VARIABLE(fmi3SetUInt16, const fmi3UInt16)
NO_VARIABLE(fmi3SetInt32, const fmi3Int32)
NO_VARIABLE(fmi3SetUInt32, const fmi3UInt32)
NO_VARIABLE(fmi3SetInt64, const fmi3Int64)
NO_VARIABLE(fmi3SetUInt64, const fmi3UInt64)
NO_VARIABLE(fmi3SetBoolean, const fmi3Boolean)
NO_VARIABLE(fmi3SetString, const fmi3String)

#define NO_BINARY(name, size_type, type)                                                                               \
  NO_LIST(name,                                                                                                        \
          (fmi3Instance c, const fmi3ValueReference r[], size_t n, size_type size[], type value[], size_t n_values),   \
          ((void)r, (void)size, (void)value, (void)n_values))
NO_BINARY(fmi3GetBinary, size_t, fmi3Binary)
NO_BINARY(fmi3SetBinary, const size_t, const fmi3Binary)

/* Clocks: functions of references and one or two lists. */
#define NO_CLOCK(name, type)                                                                                           \
  NO_LIST(name, (fmi3Instance c, const fmi3ValueReference r[], size_t n, type value[]), ((void)r, (void)value))
NO_CLOCK(fmi3GetClock, fmi3Clock)
NO_CLOCK(fmi3SetClock, const fmi3Clock)
NO_CLOCK(fmi3GetShiftDecimal, fmi3Float64)
NO_CLOCK(fmi3SetIntervalDecimal, const fmi3Float64)
NO_CLOCK(fmi3SetShiftDecimal, const fmi3Float64)

#define NO_CLOCK_PAIR(name, type, other_type)                                                                          \
  NO_LIST(name, (fmi3Instance c, const fmi3ValueReference r[], size_t n, type value[], other_type other[]),            \
          ((void)r, (void)value, (void)other))
NO_CLOCK_PAIR(fmi3GetIntervalDecimal, fmi3Float64, fmi3IntervalQualifier)
NO_CLOCK_PAIR(fmi3GetShiftFraction, fmi3UInt64, fmi3UInt64)
NO_CLOCK_PAIR(fmi3SetIntervalFraction, const fmi3UInt64, const fmi3UInt64)
NO_CLOCK_PAIR(fmi3SetShiftFraction, const fmi3UInt64, const fmi3UInt64)
NO_LIST(fmi3GetIntervalFraction,
        (fmi3Instance c, const fmi3ValueReference r[], size_t n, fmi3UInt64 counter[], fmi3UInt64 resolution[],
         fmi3IntervalQualifier qualifier[]),
        ((void)r, (void)counter, (void)resolution, (void)qualifier))

/* Functions of the instance alone. */
#define NO_MODE(name) ABSENT(name, (fmi3Instance c), (void)0)
NO_MODE(fmi3EnterConfigurationMode)
NO_MODE(fmi3ExitConfigurationMode)
NO_MODE(fmi3EvaluateDiscreteStates)
NO_MODE(fmi3EnterStepMode)

ABSENT(fmi3GetAdjointDerivative,
       (fmi3Instance c, const fmi3ValueReference unknown[], size_t n_unknown, const fmi3ValueReference known[],
        size_t n_known, const fmi3Float64 seed[], size_t n_seed, fmi3Float64 sensitivity[], size_t n_sensitivity),
       ((void)unknown, (void)n_unknown, (void)known, (void)n_known, (void)seed, (void)n_seed, (void)sensitivity,
        (void)n_sensitivity))
ABSENT(fmi3GetNumberOfVariableDependencies, (fmi3Instance c, fmi3ValueReference r, size_t *n), ((void)r, (void)n))
ABSENT(fmi3GetVariableDependencies,
       (fmi3Instance c, fmi3ValueReference dependent, size_t element[], fmi3ValueReference independent[],
        size_t independent_element[], fmi3DependencyKind kind[], size_t n),
       ((void)dependent, (void)element, (void)independent, (void)independent_element, (void)kind, (void)n))
ABSENT(fmi3GetOutputDerivatives,
       (fmi3Instance c, const fmi3ValueReference r[], size_t n, const fmi3Int32 order[], fmi3Float64 value[],
        size_t n_values),
       ((void)r, (void)n, (void)order, (void)value, (void)n_values))
ABSENT(fmi3ActivateModelPartition, (fmi3Instance c, fmi3ValueReference clock, fmi3Float64 time),
       ((void)clock, (void)time))

FMI3_EXPORT_AS(fmi3Instance, fmi3InstantiateScheduledExecution,
               (fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
                fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger,
                fmi3ClockUpdateCallback clock_update, fmi3LockPreemptionCallback lock,
                fmi3UnlockPreemptionCallback unlock))
{
  (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)environment, (void)logger;
  (void)clock_update, (void)lock, (void)unlock;
  return NULL;
}

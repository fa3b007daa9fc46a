/* The part of the FMI 2.0 interface that this FMU needs, declared from the standard's text (fmi-standard.org,
 * FMI 2.0.4, sections 2.1, 3.2 and 4.2). SPDX-License-Identifier: MIT */
#ifndef FMU_FMI2_H
#define FMU_FMI2_H

#include <stddef.h>

#include "export.h"

typedef void *fmi2Component;
typedef void *fmi2ComponentEnvironment;
typedef void *fmi2FMUstate;
typedef unsigned fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer;
typedef int fmi2Boolean;
typedef const char *fmi2String;
typedef char fmi2Byte;

typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated } fmi2StatusKind;

typedef void (*fmi2CallbackLogger)(fmi2ComponentEnvironment, fmi2String instance, fmi2Status, fmi2String category,
                                   fmi2String message, ...);

typedef struct {
  fmi2CallbackLogger logger;
  void *(*allocateMemory)(size_t, size_t);
  void (*freeMemory)(void *);
  void (*stepFinished)(fmi2ComponentEnvironment, fmi2Status);
  fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

typedef struct {
  fmi2Boolean newDiscreteStatesNeeded;
  fmi2Boolean terminateSimulation;
  fmi2Boolean nominalsOfContinuousStatesChanged;
  fmi2Boolean valuesOfContinuousStatesChanged;
  fmi2Boolean nextEventTimeDefined;
  fmi2Real nextEventTime;
} fmi2EventInfo;

#ifdef FMI2_FUNCTION_PREFIX /* for static linking, as the standard has it */
#define FMI2_NAME(name) FMU_PASTE(FMI2_FUNCTION_PREFIX, name)
#else
#define FMI2_NAME(name) name
#endif

/* A function that the importer calls: declared, then defined. */
#define FMI2_EXPORT(type, name, arguments)                                                                             \
  FMU_EXPORT type FMI2_NAME(name) arguments;                                                                           \
  type FMI2_NAME(name) arguments

#endif

/* One instance of the FMU, for both versions of the standard: fmi2.c and fmi3.c only translate. Every function here
 * sees to it that it may be called now; none keeps anything outside the instance.
 * SPDX-License-Identifier: MIT */
#ifndef FMU_INSTANCE_H
#define FMU_INSTANCE_H

#include <stddef.h>

#include "delay.h"
#include "shape.h"

/* The numbers of both standards. */
enum fmu_status { FMU_OK, FMU_WARNING, FMU_DISCARD, FMU_ERROR, FMU_FATAL };

enum fmu_kind { FMU_MODEL_EXCHANGE, FMU_CO_SIMULATION, FMU_KIND_COUNT };

/* Phases, one bit each. */
enum fmu_phase {
  FMU_INSTANTIATED = 1,
  FMU_INITIALIZING = 2,
  FMU_EVENT = 4,
  FMU_CONTINUOUS = 8,
  FMU_STEPPING = 16, /* co-simulation, between steps */
  FMU_TERMINATED = 32
};

/* All that is remembered from call to call, and all that get and set FMU state keep: numbers, and where the
 * delay's slots lie, which is not kept. */
typedef struct fmu_memory {
  char token[FMU_TOKEN_TEXT];
  int kind, phase;
  int stale; /* parameters, start values or inputs have been set since the state at rest was made */
  double time, stop_time, tol;
  double input[FMU_INPUT_COUNT];
  double set_at[FMU_INPUT_COUNT]; /* [s] when; from then on pressure and position run with their slopes */
  double start[FMU_START_COUNT];
  pneu_params params;
  pneu_state state;
  double threshold[PNEU_EVENT_MAX]; /* above which an event function has fired */
  int choked;
  double x_seen; /* at the end of the last step of model exchange */
  int warned;
  fmu_delay delay;
} fmu_memory;

typedef struct fmu_instance {
  fmu_memory m;
  fmu_shape shape;
  pneu_model model; /* follows from m.params */
  pneu_workspace work;
  char *name;
  void *environment;    /* of the importer */
  void (*logger)(void); /* its function, for say */
  void (*say)(const struct fmu_instance *instance, int status, const char *text);
} fmu_instance;

typedef struct fmu_event {
  int states_changed;
  double next_time; /* HUGE_VAL: none */
} fmu_event;

/* ---- Life ---- */

/* Returns: NULL without memory, or if the token is not this FMU's, which `say` is told. */
fmu_instance *fmu_new(int kind, const char *name, const char *token, void *environment, void (*logger)(void),
                      void (*say)(const fmu_instance *, int, const char *));
void fmu_free(fmu_instance *instance);

/* The category of a message, as modelDescription.xml lists them. */
const char *fmu_category(int status);

/* What is not supported.  Returns: FMU_ERROR */
int fmu_absent(fmu_instance *instance, const char *what);

/* Times and tolerance of the experiment.  In: tol  0: as the FMU likes; stop_time  HUGE_VAL: none */
int fmu_setup(fmu_instance *instance, double tol, double start_time, double stop_time);
int fmu_enter_initialization(fmu_instance *instance);
int fmu_exit_initialization(fmu_instance *instance);
int fmu_terminate(fmu_instance *instance);
int fmu_reset(fmu_instance *instance);

/* ---- Values ---- */

int fmu_get_real(fmu_instance *instance, const unsigned *reference, size_t n, double *value);
int fmu_get_integer(fmu_instance *instance, const unsigned *reference, size_t n, int *value);
int fmu_set_real(fmu_instance *instance, const unsigned *reference, size_t n, const double *value);

/* Slopes of inputs for the next steps of co-simulation: of pressure and position that drive the model, the same as
 * setting their rates; of others, which hold, FMU_WARNING. */
int fmu_set_slopes(fmu_instance *instance, const unsigned *reference, size_t n, const int *order, const double *slope);

/* Derivatives of unknowns along a direction: sums over the knowns of d unknown/d known times seed. Knowns are states
 * and inputs; before initialisation has ended inputs, start values and parameters.  Returns: FMU_OK, FMU_DISCARD,
 * FMU_ERROR. */
int fmu_derivative(fmu_instance *instance, const unsigned *unknown, size_t n_unknown, const unsigned *known,
                   size_t n_known, const double *seed, double *sensitivity);

/* ---- Model exchange ---- */

int fmu_enter_event(fmu_instance *instance);
int fmu_enter_continuous(fmu_instance *instance);
int fmu_update(fmu_instance *instance, fmu_event *event);
int fmu_completed_step(fmu_instance *instance, int *enter_event);
int fmu_set_time(fmu_instance *instance, double time);
int fmu_set_states(fmu_instance *instance, const double *x, size_t n);
int fmu_get_states(fmu_instance *instance, double *x, size_t n);
int fmu_get_nominals(fmu_instance *instance, double *x, size_t n);
int fmu_get_rates(fmu_instance *instance, double *dx, size_t n);
int fmu_get_indicators(fmu_instance *instance, double *z, size_t n);
int fmu_count(fmu_instance *instance, size_t *states, size_t *indicators);

/* ---- Co-simulation ---- */

/* One step. Where it fails with FMU_DISCARD the instance is as before it. */
int fmu_step(fmu_instance *instance, double from, double length);

/* ---- FMU state ---- */

int fmu_get_memory(fmu_instance *instance, void **memory);
int fmu_set_memory(fmu_instance *instance, const void *memory);
int fmu_free_memory(fmu_instance *instance, void **memory);
int fmu_memory_size(fmu_instance *instance, const void *memory, size_t *size);
int fmu_write_memory(fmu_instance *instance, const void *memory, void *bytes, size_t size);
int fmu_read_memory(fmu_instance *instance, const void *bytes, size_t size, void **memory);

#endif

/* What the files of the runtime share.
 * SPDX-License-Identifier: MIT */
#ifndef FMU_PRIVATE_H
#define FMU_PRIVATE_H

#include "instance.h"

/* Calls that depend on the phase. */
enum fmu_call {
  FMU_CALL_SETUP,
  FMU_CALL_ENTER_INITIALIZATION,
  FMU_CALL_EXIT_INITIALIZATION,
  FMU_CALL_TERMINATE,
  FMU_CALL_GET,
  FMU_CALL_DIFFERENTIATE,
  FMU_CALL_SET_PARAMETER,
  FMU_CALL_SET_INPUT,
  FMU_CALL_ENTER_EVENT,
  FMU_CALL_ENTER_CONTINUOUS,
  FMU_CALL_UPDATE,
  FMU_CALL_COMPLETED_STEP,
  FMU_CALL_SET_TIME,
  FMU_CALL_SET_STATES,
  FMU_CALL_GET_STATES,
  FMU_CALL_STEP,
  FMU_CALL_ANY
};

/* Whether a call is allowed now; if not, the importer is told.  Returns: FMU_OK or FMU_ERROR, also for no instance. */
int fmu_may(fmu_instance *instance, int call);

/* Tell the importer.  Returns: status */
int fmu_say(const fmu_instance *instance, int status, const char *format, ...);

/* Before initialisation has ended: make the model and its state at rest anew if anything was set. */
int fmu_refresh(fmu_instance *instance);

/* A command as the library takes it: an opening beyond -1..1 counts as -1 or 1. Inputs likewise. */
double fmu_command(const fmu_instance *instance, double u);
void fmu_drive(const fmu_instance *instance, pneu_input *input);

/* Pressure and position that drive the model, now: on the lines that begin where and when they were set. A position
 * beyond a stop, as noise at rest is, counts as on the stop. */
double fmu_driven_pressure(const fmu_instance *instance);
double fmu_driven_position(const fmu_instance *instance);

/* Put pressure and position into the state where they are inputs. Between steps of co-simulation a position that is not
 * where the last slope has led to is a jump, which compresses the gas without loss: its mass stays. In model exchange
 * position is continuous, and velocity is its slope. */
void fmu_impose(fmu_instance *instance);

/* The state, brought back to where the model has a meaning. Solvers try states beyond a stop, where at some point there
 * is no volume left; what they find there they throw away, because the stop is an event. */
void fmu_within(const fmu_instance *instance, pneu_state *state);

/* Time, and the model's clock with it. */
void fmu_pass_to(fmu_instance *instance, double time);

/* Put each event function's threshold above where it stands, and note whether flow is choked. */
void fmu_arm(fmu_instance *instance);

/* Rates of the FMU's states; the indicators. */
int fmu_rates(const fmu_instance *instance, double *rate);
void fmu_indicators(const fmu_instance *instance, double *z);

/* The value of a real variable. */
int fmu_value(fmu_instance *instance, unsigned reference, double *value);

/* Index of the event that has fired, -1 if none. */
int fmu_fired(const fmu_instance *instance);

#endif

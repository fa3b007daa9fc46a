/* What the FMU shows of a model: its variables by reference, and its continuous states.
 *
 * libpneu's packed vector has no entries for a stem at rest. An FMU has the same states always: those of the packed
 * vector of a moving stem, less the clock, which is the importer's; at rest x and v have the derivative 0. Effects
 * without states can be switched on and off by their parameters; one with a state of its own can be switched off, and
 * its state then stands still, but not on where the exported model has no place for the state. Pressure and position
 * are no states where they are inputs.
 * SPDX-License-Identifier: MIT */
#ifndef FMU_SHAPE_H
#define FMU_SHAPE_H

#include "data.h"

/* Kinds of states; an effect's are FMU_STATE_EFFECT + its place in the catalogue's states. */
enum fmu_state_kind { FMU_STATE_P, FMU_STATE_T, FMU_STATE_X, FMU_STATE_V, FMU_STATE_EFFECT };

enum fmu_input {
  FMU_INPUT_U,
  FMU_INPUT_SUPPLY,
  FMU_INPUT_FORCE,
  FMU_INPUT_PRESSURE, /* what drives the model, and its slope */
  FMU_INPUT_PRESSURE_RATE,
  FMU_INPUT_POSITION,
  FMU_INPUT_VELOCITY,
  FMU_INPUT_COUNT
};
enum fmu_start { FMU_START_PRESSURE, FMU_START_TEMPERATURE, FMU_START_POSITION, FMU_START_COUNT };

/* Outputs; the first are those that may be states, in the order of fmu_state_kind. */
enum fmu_output {
  FMU_OUTPUT_PRESSURE,
  FMU_OUTPUT_TEMPERATURE,
  FMU_OUTPUT_POSITION,
  FMU_OUTPUT_VELOCITY,
  FMU_OUTPUT_MASS_FLOW,
  FMU_OUTPUT_SHOWN_PRESSURE,
  FMU_OUTPUT_SHOWN_TEMPERATURE,
  FMU_OUTPUT_SHOWN_POSITION,
  FMU_OUTPUT_HOLDING_FORCE,
  FMU_OUTPUT_COUNT
};

/* Event indicators: those of pneu_events, and, before the edge of a dead band, whether the flow is choked. */
enum { FMU_INDICATOR_COUNT = PNEU_EVENT_MAX + 1 };

/* Value references; the same in every FMU of ours. */
enum fmu_reference {
  FMU_REF_TIME,
  FMU_REF_INPUT,            /* + enum fmu_input */
  FMU_REF_START = 11,       /* + enum fmu_start */
  FMU_REF_OUTPUT = 21,      /* + enum fmu_output */
  FMU_REF_MODE = 41,        /* integer: enum pneu_mode */
  FMU_REF_CHOKED = 42,      /* integer: 0 or 1 */
  FMU_REF_STATE = 100,      /* + kind, of effects */
  FMU_REF_RATE = 200,       /* + kind */
  FMU_REF_INDICATOR = 300,  /* + number */
  FMU_REF_PARAMETER = 1000, /* + index of pneu_param_describe */
  FMU_REF_END = FMU_REF_PARAMETER + PNEU_PARAM_COUNT
};

typedef struct fmu_shape {
  int n; /* states */
  int kind[PNEU_STATE_MAX];
} fmu_shape;

/* What the command is: an opening; by proportional_band a set pressure, by a positioner's gain a set position. */
enum fmu_command_kind { FMU_COMMAND_OPENING, FMU_COMMAND_PRESSURE, FMU_COMMAND_POSITION };
int fmu_command_kind(const pneu_params *params);

/* The library's model of parameters and what is baked in: laws, free terms. It uses the data's terms where they lie.
 * Returns: as pneu_model_init. Out: model, bad */
int fmu_model(const fmu_data *data, const pneu_params *params, pneu_model *model, int *bad);

/* The states of a model. */
void fmu_shape_of(const pneu_model *model, fmu_shape *shape);

/* Whether every state of the model has its place in the shape. */
int fmu_fits(const fmu_shape *shape, const pneu_model *model);

/* Whether an FMU of these laws has an input, start value or output: what drives the model is no output, and without a
 * balance of mass or of forces there is no use for what enters it. */
int fmu_has_variable(const pneu_laws *law, unsigned reference);

/* Whether parameter i can be set in an FMU of this model: not the supply's, which is an input; not the recorder's
 * skew; not those that change what the command means; not those that switch on an effect with a state of which the
 * model has none. */
int fmu_has_parameter(const fmu_data *data, int i);

/* Where a state lies.  Returns: NULL where the model at hand has none. */
pneu_real *fmu_state_at(const pneu_model *model, pneu_state *state, int kind);

/* Its place in the packed vector.  Returns: -1 where it is frozen. */
int fmu_packed_at(const pneu_model *model, int mode, int kind);

/* The reference of a state's value. */
unsigned fmu_state_reference(int kind);

/* The effect to which a state belongs. */
int fmu_state_effect(int kind);

/* Which of the states of its effect a state is, from 1 on; 0: the only one. */
int fmu_state_number(int kind);

#endif

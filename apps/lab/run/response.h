/* Response of a model to a schedule of inputs, sampled at given times.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_RESPONSE_H
#define LAB_RESPONSE_H

#include <stddef.h>

#include "../../../lib/pneu.h"
#include "../base/message.h"

/* Inputs over time: row i acts from t[i] to t[i+1], its command with its slope; the last one to the end. */
typedef struct lab_schedule {
  size_t n;
  const double *t; /* [s], strictly increasing */
  const pneu_input *input;
} lab_schedule;

/* Sampled response; every array has n entries, owned by this struct; NULL what was not asked for. */
typedef struct lab_response {
  size_t n;
  double *t;        /* [s] */
  double *u;        /* [1] command as given, before any delay */
  double *opening;  /* [1] of the transducer */
  double *p;        /* [Pa] gauge, as its sensor shows it; x and T likewise */
  double *x;        /* [m] */
  double *v;        /* [m/s] */
  double *T;        /* [K] */
  double *m;        /* [kg] */
  double *mass_in;  /* [kg/s] */
  double *mass_out; /* [kg/s] */
  double *heat;     /* [W] */
  double *force;    /* [N] that holds the stem, see pneu_output.holding_force */
  double *ps;       /* [Pa] gauge, supply at the transducer */
  int *mode;        /* enum pneu_mode */
} lab_response;

/* Which integrator answers. */
enum lab_integrator { LAB_STEPPER, LAB_CVODE };

/* How a response is computed; 0 is the default of every field. */
typedef struct lab_response_options {
  int integrator; /* enum lab_integrator */
  double tol; /* relative to full scale: 1e-4 .. 1e-10; 0: 1e-7, that of `simulate` and of errors on held-out logs */
  int shown_only; /* not 0: only p, x, T and force of the trace are filled, in a third of the time */
  int max_steps;  /* of the stepper after a change of input, and in every ten seconds from there on; 0: as
                     pneu_options_default */
} lab_response_options;

/* What is run. */
typedef struct lab_simulation {
  const pneu_state *start;       /* at schedule->t[0] */
  const lab_schedule *schedule;  /* at least one row */
  const pneu_model *const *rows; /* model of each row, all of the same laws; NULL: one model throughout */
  const double *t;               /* [s] n times to sample at, increasing, within the run */
  size_t n;
  double t_end; /* [s]; 0: the last sample */
  lab_response_options options;
  pneu_stats *stats; /* written if not NULL */
  /* Runs of nearly the same model, of which start, schedule and rows count, and what p, x, T and force of each have
   * beyond this one, to first order (variation.h): all NULL where one cannot be had so. For the stepper, shown_only. */
  const struct lab_simulation *nearby;
  int n_nearby;
  lab_response *change;
} lab_simulation;

/* Run a model. Commands act model->command_delay after they are given, but for the first, which has been acting;
 * positions are those of model->position_skew before. The model's clock, where it has one, begins at schedule->t[0].
 * Out:     trace  allocated; free with lab_response_free; NULL: only statistics are wanted
 * Returns: LAB_OK, LAB_NUMERIC (named, with time and state), LAB_WORLD. */
int lab_response_run(const pneu_model *model, const lab_simulation *simulation, lab_response *response,
                     lab_error *error);

/* Room for n samples, all 0.  In: shown_only  as in the options  Returns: LAB_OK, LAB_WORLD */
int lab_response_allocate(lab_response *response, size_t n, int shown_only, lab_error *error);
void lab_response_free(lab_response *response);

#endif

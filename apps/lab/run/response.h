/* Response of a model to a schedule of inputs, sampled at given times.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_RESPONSE_H
#define LAB_RESPONSE_H

#include <stddef.h>

#include "../../../lib/pneu.h"
#include "../base/message.h"

/* Inputs over time: row i holds from t[i] to t[i+1]; the last one to the end. */
typedef struct lab_schedule {
  size_t n;
  const double *t; /* [s], strictly increasing */
  const pneu_input *input;
} lab_schedule;

/* Sampled response; every array has n entries, owned by this struct; NULL what was not asked for. */
typedef struct lab_trace {
  size_t n;
  double *t;        /* [s] */
  double *u;        /* [1] command as given, before any delay */
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
} lab_trace;

/* Which integrator answers. */
enum lab_integrator { LAB_STEPPER, LAB_CVODE };

/* Integrals over the run, for the audit of mass and energy (energies [J], mass [kg]). */
typedef struct lab_response_options {
  int integrator; /* enum lab_integrator */
  double tol;     /* relative to full scale: 1e-4 .. 1e-10 */
  double t_end;   /* [s] */
  int count_only; /* not 0: no samples, statistics only (trace may be NULL) */
  int shown_only; /* not 0: only p, x, T and force of the trace are filled, in a third of the time */
  int max_steps;  /* of the stepper from one change of input to the next; 0: as pneu_options_default */
} lab_response_options;

/* Run `model` from `start` at schedule->t[0] and sample at `t` (increasing, within the run). Commands act
 * model->command_delay after they are given, but for the first, which has been acting; positions are those of
 * model->position_skew before. The model's clock, where it has one, begins at schedule->t[0].
 * Out:     trace  allocated; free with lab_trace_free
 *          stats  may be NULL
 * Returns: LAB_OK, LAB_NUMERIC (named, with time and state), LAB_WORLD. */
int lab_respond(const pneu_model *model, const pneu_state *start, const lab_schedule *schedule, const double *t,
                size_t n, const lab_response_options *options, lab_trace *trace, pneu_stats *stats, lab_error *error);

void lab_trace_free(lab_trace *trace);

#endif

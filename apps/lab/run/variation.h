/* What runs of nearly the same model differ by, to first order: the variational equations along the steps of one run.
 * A difference d follows d' = J d + g, with J the Jacobian of the run's right-hand side and g what the other model, or
 * its inputs, add to the rates where the run is; by Lobatto IIIC with three stages (Chipman 1971; order 4, L-stable,
 * Hairer and Wanner 1996, IV.5), at the start, the middle and the end of each step, or of parts of one in which the
 * difference changes sooner than the run. Where the run meets an event, the edge of a positioner's dead band, or a
 * change of its inputs, the other one does dt later, and the difference jumps by what the rates change there over dt
 * (Galan, Feehery and Barton 1999, Appl. Numer. Math. 31:17).
 *
 * Left out: what is of second order in the difference, such as a stem that breaks away in one of the two alone.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_VARIATION_H
#define LAB_VARIATION_H

#include "response.h"

struct lab_variations;

/* Open what lab_response_run is to follow, and close it, with or without what it found.
 * In:      run     that is made
 *          nearby  n of them, their start, schedule and rows; used as long as the result is
 * Out:     change  n of them, what p, x, T and force of each have beyond the run, to be freed; all NULL where one
 *                  cannot be had so: with another skew, other states, or other rows of its schedule
 * Returns: LAB_OK, LAB_WORLD. */
int lab_variations_open(const lab_simulation *run, const lab_simulation *nearby, int n, lab_response *change,
                        struct lab_variations **variations, lab_error *error);
void lab_variations_close(struct lab_variations *variations, int without_result);

/* ---- For lab_response_run ---- */

/* The run begins, with these rows and samples. */
void lab_variations_begin(struct lab_variations *v, const lab_schedule *acts, const pneu_model *const *rows);

/* Row i of the run begins.  In: before, after  its state, at first its start, and as it goes on */
void lab_variations_row(struct lab_variations *v, size_t i, const pneu_state *before, const pneu_state *after);

/* A step is made, and is followed from a share of it on, as far as to the one that is returned: what differs may change
 * sooner than the run does. So many samples are due in that part; it is looked at, at a share theta of the step; it is
 * done. */
double lab_variations_step(struct lab_variations *v, const pneu_step_view *view, double from);
void lab_variations_expect(struct lab_variations *v, int samples);
void lab_variations_look(struct lab_variations *v, double theta);
void lab_variations_pass(struct lab_variations *v);

/* It has ended on an event.  In: after  the run's state behind it */
void lab_variations_event(struct lab_variations *v, const pneu_state *after);

/* Sample i is taken; `of_position` and `of_rest` say of what.  In: state, input, shown  of the run, at that time */
void lab_variations_take(struct lab_variations *v, size_t i, const pneu_state *state, const pneu_input *input,
                         const pneu_shown *shown, int of_position, int of_rest);

#endif

/* Slopes of the residuals in the instants at which the command changed, many from one simulation: what one instant
 * changes has died out some changes of command later, so that instants far apart are moved together (Curtis, Powell and
 * Reid 1974, J. Inst. Maths Applics 13:117). Where it has not died out the column is left to a simulation of its own.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_INSTANTS_H
#define LAB_INSTANTS_H

#include "../base/message.h"

/* The columns of instants that can be had so; as lab_fit_problem.together.
 * In:      context  const lab_unknowns *, seen row by row and without nuisance, or there are none
 * Out:     J        m * n, column by column: those that are done
 *          done     n: not 0 for these
 * Returns: LAB_OK, LAB_WORLD. */
int lab_instants_slopes(void *context, const double *theta, double *J, char *done, lab_error *error);

#endif

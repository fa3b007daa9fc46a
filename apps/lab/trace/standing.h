/* The leak that shows while the pressure in a valve falls though its positioner would not vent.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_STANDING_H
#define LAB_STANDING_H

#include "../fit/unknowns.h"

/* Median over the stretches of rows in which the pressure falls though the positioner would not vent, by what each
 * tells: a leak that lets out of the declared chamber what makes the pressure fall as it does.
 *
 * In:      u        of one run that a set position drives
 *          leak     its size, a parameter
 *          since    [s] rows before do not count; infinite: all count
 *
 * Out:     scatter  [1] median of how far the stretches are from that, as a share of it; infinite where it is 0
 *
 * Returns: in the unit of the parameter; 0: no pressure, no dead band, no such rows, or the pressure does not fall. */
double lab_standing_leak(const lab_unknowns *u, int leak, double since, double *scatter);

#endif

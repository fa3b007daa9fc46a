/* A clock that only goes forward.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_CLOCK_H
#define LAB_CLOCK_H

/* Returns: seconds since some moment in the past, the same one throughout a run of the machine. */
double lab_clock(void);

#endif

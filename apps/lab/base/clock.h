/* A clock that only goes forward, and CPU time.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_CLOCK_H
#define LAB_CLOCK_H

/* Returns: seconds since some moment in the past, the same one throughout a run of the machine. */
double lab_clock(void);

/* Returns: seconds of CPU that all threads of this process have used. */
double lab_cpu_time(void);

/* Whether this process has used as much, or was told to stop.  In: until  [s] of CPU time; 0: never */
int lab_cpu_is_spent(double until);

/* When a share of what is left is spent [s]; 0: never.  In: until  as above */
double lab_cpu_share(double until, double share);

/* From any thread: all CPU time is spent (1), or only what was used (0). */
void lab_cpu_stop(int stop);
int lab_cpu_is_stopped(void);

#endif

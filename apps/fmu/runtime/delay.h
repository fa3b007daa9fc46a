/* Dead time of the command for an importer, who owns the clock: the library's delay, and when he has to stop for it. A
 * jump acts once it is released, at an event.
 * SPDX-License-Identifier: MIT */
#ifndef FMU_DELAY_H
#define FMU_DELAY_H

#include "../../../lib/pneu.h"

enum { FMU_DELAY_ROOM = 1024 };

typedef struct fmu_delay {
  double length; /* [s]; 0: commands act at once */
  double now;    /* time of the line: what was given up to then is in it */
  double wake;   /* when the importer was asked to stop next, for a command that runs */
  int runs;      /* not 0: at the last look the command had changed without a jump */
  pneu_delay line;
  pneu_late slot[FMU_DELAY_ROOM];
} fmu_delay;

/* Begin with a command that has been acting. */
void fmu_delay_begin(fmu_delay *d, double length, double time, double u);

/* The command is now u: it has run there from where it was, or it has jumped; then jumps that are due act.
 * Returns: PNEU_OK or PNEU_E_DELAY. */
int fmu_delay_follow(fmu_delay *d, double time, double u);
int fmu_delay_jump(fmu_delay *d, double time, double u);

/* Whether the importer has to be asked to stop: where the command runs, no step may be longer than what is known of it.
 */
int fmu_delay_asks(const fmu_delay *d, double time);

/* When the next jump acts, or the importer shall stop for a command that runs, twice in a dead time. In event mode. */
double fmu_delay_stop(fmu_delay *d, double time);

/* The command that acts. */
double fmu_delay_value(const fmu_delay *d, double time);

/* Whether it is one that these functions can have left. */
int fmu_delay_is_sound(const fmu_delay *d);

#endif

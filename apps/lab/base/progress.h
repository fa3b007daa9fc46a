/* A progress line on a terminal: what, how far, time gone and time to come.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_PROGRESS_H
#define LAB_PROGRESS_H

#include <stdio.h>

typedef struct lab_progress {
  FILE *stream; /* NULL: silent */
  const char *what;
  double start, shown; /* [s] on the clock: begin, last time the line was written */
  int written;         /* the line is on the terminal */
} lab_progress;

/* Begin; nothing will be shown if `quiet` or if stderr is not a terminal.  In: what  kept */
void lab_progress_begin(lab_progress *progress, const char *what, int quiet);

/* Show how many of `total` are done, how fast, and how long it will take; `before` of them were done at the beginning.
 * At most ten times a second; not reentrant: call it from one thread at a time (an OpenMP critical section). */
void lab_progress_count(lab_progress *progress, int done, int total, int before);

/* Say what is being done, where nobody can tell how much of it is left.  In: what  not kept */
void lab_progress_say(lab_progress *progress, const char *what);

/* Clear the line. */
void lab_progress_end(lab_progress *progress);

#endif

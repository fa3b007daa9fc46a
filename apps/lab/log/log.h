/* Logs: measured channels over time, in SI.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LOG_H
#define LAB_LOG_H

#include <stddef.h>

#include "../base/limitations.h"
#include "logformat.h"

enum { LAB_READ_AS_TEXT = 800 };

/* A swing that does not come from the rig. */
typedef struct lab_hum {
  double frequency, amplitude; /* [Hz], SI; 0: none */
} lab_hum;

/* Where what drives the model turns between a row and the next. */
typedef struct lab_bend {
  double t, value; /* [s], SI; NaN: nowhere */
} lab_bend;

typedef struct lab_log {
  char *path;                       /* for messages */
  size_t n;                         /* rows */
  double *value[LAB_CHANNEL_COUNT]; /* SI, n each; NaN is a gap (never in t or what commands); NULL where the channel is
                                       absent */
  int *line;                        /* line of each row in the file */
  size_t n_runs;
  size_t *run;                    /* first row of each run, then n: n_runs + 1 entries; t grows strictly within a run */
  size_t dropped;                 /* damaged rows left out, as the format asks */
  size_t outside;                 /* rows left out by the window */
  size_t repeated;                /* rows of one time with the row before, which were spread */
  double clock_step;              /* [s] to which the time was rounded before it was mended; 0: it was not */
  double stamp_step;              /* [s] to which it still is, coarsely beside the distance of rows; 0: it is not */
  lab_hum hum[LAB_CHANNEL_COUNT]; /* that was taken off the values */
  double smoothed[LAB_CHANNEL_COUNT]; /* noise that was taken off a channel that drives the model, SI; 0: none */
  lab_bend *bend[LAB_CHANNEL_COUNT];  /* n: after each row, of a channel that was smoothed; NULL: of none */
  char read_as[LAB_READ_AS_TEXT];     /* what was guessed of how the file is written, in words; "": nothing */
} lab_log;

/* Read a log.
 * In:      format   see logformat.h
 *          ambient  [Pa] absolute, for the channels p_abs, ps_abs, p2_abs
 * Out:     log      to be freed with lab_log_free; empty after an error
 * Returns: LAB_OK; LAB_DATA with file, line, column, what was expected and what was found; LAB_WORLD. */
int lab_log_read(const char *path, const lab_log_format *format, double ambient, lab_log *log, lab_error *error);

/* Where the stamps of a run lie on a grid that is coarse beside its rows, and rows at even distances would have been
 * rounded to just these stamps, they are taken to have been recorded at even distances. Rows that are missing do not
 * count; a run of other stamps stays as it is.
 * In/out:  log  its times; clock_step becomes the grid [s] on which its stamps lie unevenly, 0 if none */
void lab_log_even_stamps(lab_log *log, lab_limitations *limitations);

void lab_log_free(lab_log *log);

/* Put a row in the place of another. */
void lab_log_copy_row(lab_log *log, size_t from, size_t to);

/* The channel that commands: u, or else the set position sp of a positioner; -1 where there is neither. */
int lab_log_command(const lab_log *log);

/* Whether the command changes between two rows.
 * In:      first, last  rows of one run, first <= last
 * Returns: 0 also for a log without commands. */
int lab_log_command_changes(const lab_log *log, size_t first, size_t last);

#endif

/* One run of a log as the checks of plausible.h see it: beside what the declared model makes of its commands, and as
 * means over cells of equal time, in which noise hardly counts.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LOGVIEW_H
#define LAB_LOGVIEW_H

#include "../log/log.h"
#include "../base/limitations.h"
#include "../run/response.h"
#include "../rig/rig.h"
#include "../base/format.h"

enum {
  LAB_VIEW_CELLS = 512,
  LAB_VIEW_FEWEST = 8,
  LAB_VIEW_SIGNIFICANT = 8, /* in noise: a change over a stretch that counts */
  LAB_VIEW_DEAD_TIME = 1    /* [s] the longest: sound travels 340 m */
};

typedef struct lab_view_cells {
  double mean[LAB_VIEW_CELLS];
  double low, high; /* of the means */
} lab_view_cells;

typedef struct lab_log_view {
  const lab_rig *rig;
  pneu_model model;
  const lab_log *log;
  size_t run, first, n;
  const double *t, *u, *y[LAB_CHANNEL_COUNT]; /* n rows each; NULL where absent */
  double u_low, u_high;                       /* of the commands */
  double sigma[LAB_CHANNEL_COUNT];            /* noise, declared or else estimated; NaN where unknown */
  double seen[LAB_CHANNEL_COUNT];             /* noise from row to row; NaN where absent or unknown */
  int n_cells;
  double cell;                   /* [s] */
  lab_view_cells *cells;         /* [LAB_CHANNEL_COUNT], of p and x; NaN where absent */
  int main;                      /* p or x: what answers the command; -1: neither is predicted */
  int has_expected;              /* the declared model could be run */
  lab_response expected;         /* its answer at the rows */
  lab_view_cells expected_cells; /* of channel main */
} lab_log_view;

/* Out: view  to be closed, also after an error  Returns: LAB_OK; LAB_DATA if an input is missing; LAB_WORLD. */
int lab_log_view_open(const lab_rig *rig, const lab_log *log, size_t run, lab_log_view *view, lab_error *error);
void lab_log_view_close(lab_log_view *view);

/* Does the model predict this channel, and does the log have it? */
int lab_log_view_predicts(const lab_log_view *view, int channel);

/* Does something other than the command move stem or chamber? */
int lab_log_view_is_driven(const lab_log_view *view);

/* Expected values of a channel, n rows; NULL without. */
const double *lab_log_view_expected(const lab_log_view *view, int channel);

/* Range of the cell means of p or x. */
double lab_log_view_span(const lab_log_view *view, int channel);

/* ---- Stretches of one kind of command ---- */

typedef struct lab_stretch {
  size_t first, end; /* rows, of the run */
  int sign;          /* of the command: 1 fills, -1 vents, 0 shut */
  double change;     /* of the main channel from its first rows to its last ones */
} lab_stretch;

/* The next stretch.  In/out: s, from {0}  Returns: 0 at the end, or without a command that is an opening. */
int lab_log_view_next(const lab_log_view *view, lab_stretch *s);

/* Mean of up to three values that are there, from row i on (way 1) or back (way -1); NaN without any. */
double lab_log_view_value(const double *y, size_t first, size_t end, int from_end);

/* What a check has found. */
typedef struct lab_check_result {
  char text[LAB_LIMITATION_TEXT];
  size_t row;                     /* of the run, where it shows, or LAB_NO_ROW */
  char shown[4][LAB_FORMAT_TEXT]; /* values in the text */
  int n_shown;
} lab_check_result;

/* A value of a channel for the text of a check, as in lab_format_brief; of up to four. */
const char *lab_check_show(lab_check_result *finding, int channel, double value);

#define LAB_NO_ROW ((size_t)-1)

/* Returns: 1 */
int lab_check_fail(lab_check_result *finding, size_t row, const char *format, ...) LAB_PRINTF(3, 4);

/* "; mixed up bar and kPa?" for a ratio that a slip of units makes, else "".
 * In: ratio of what is expected to what is found */
const char *lab_unit_slip(int channel, double ratio);

/* What a check needs, or it is not asked. */
enum lab_check_need {
  LAB_NEEDS_P = 1,        /* p was measured */
  LAB_NEEDS_X = 2,        /* x was measured */
  LAB_NEEDS_U = 4,        /* u was recorded */
  LAB_NEEDS_FREE = 8,     /* p or x answers to nothing but the command */
  LAB_NEEDS_EXPECTED = 16 /* the declared model could be run */
};

/* Checks, each with 1 and a finding, or 0. */
#define LAB_CHECK(name, severity, needs) int lab_check_##name(const lab_log_view *, lab_check_result *);
#include "checks.def"
#undef LAB_CHECK

/* Nothing that the model predicts moves. */
int lab_log_view_is_still(const lab_log_view *view);

#endif

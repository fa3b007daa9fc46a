/* One run of a log as the checks of plausible.h see it: beside what the declared model makes of its commands, and as
 * means over cells of equal time, in which noise hardly counts.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LOGSCENE_H
#define LAB_LOGSCENE_H

#include "../log/log.h"
#include "../base/remarks.h"
#include "../run/response.h"
#include "../rig/rig.h"
#include "show.h"

enum {
  LAB_SCENE_CELLS = 512,
  LAB_SCENE_FEWEST = 8,
  LAB_SCENE_SIGNIFICANT = 8, /* in noise: a change over a stretch that counts */
  LAB_SCENE_DEAD_TIME = 1    /* [s] the longest: sound travels 340 m */
};

typedef struct lab_cells {
  double mean[LAB_SCENE_CELLS];
  double low, high; /* of the means */
} lab_cells;

typedef struct lab_scene {
  const lab_rig *rig;
  const lab_log *log;
  size_t run, first, n;
  const double *t, *u, *y[LAB_CHANNEL_COUNT]; /* n rows each; NULL where absent */
  double sigma[LAB_CHANNEL_COUNT];            /* noise, declared or else estimated; NaN where unknown */
  double seen[LAB_CHANNEL_COUNT];             /* noise from row to row; NaN where absent or unknown */
  int n_cells;
  double cell;              /* [s] */
  lab_cells *cells;         /* [LAB_CHANNEL_COUNT], of p and x; NaN where absent */
  int main;                 /* p or x: what answers the command; -1: neither is predicted */
  int has_expected;         /* the declared model could be run */
  lab_trace expected;       /* its answer at the rows */
  lab_cells expected_cells; /* of channel main */
} lab_scene;

/* Out: scene  to be closed, also after an error  Returns: LAB_OK; LAB_DATA if an input is missing; LAB_WORLD. */
int lab_scene_open(const lab_rig *rig, const lab_log *log, size_t run, lab_scene *scene, lab_error *error);
void lab_scene_close(lab_scene *scene);

/* Does the model predict this channel, and does the log have it? */
int lab_scene_predicts(const lab_scene *scene, int channel);

/* Does something other than the command move stem or chamber? */
int lab_scene_is_driven(const lab_scene *scene);

/* Expected values of a channel, n rows; NULL without. */
const double *lab_scene_expected(const lab_scene *scene, int channel);

/* Range of the cell means of p or x. */
double lab_scene_span(const lab_scene *scene, int channel);

/* ---- Stretches of one kind of command ---- */

typedef struct lab_stretch {
  size_t first, end; /* rows, of the run */
  int sign;          /* of the command: 1 fills, -1 vents, 0 shut */
  double change;     /* of the main channel from its first rows to its last ones */
} lab_stretch;

/* The next stretch.  In/out: s, from {0}  Returns: 0 at the end, or without a command that is an opening. */
int lab_scene_next(const lab_scene *scene, lab_stretch *s);

/* Mean of up to three values that are there, from row i on (way 1) or back (way -1); NaN without any. */
double lab_scene_value(const double *y, size_t first, size_t end, int from_end);

/* Sort value[n] in with the n before it, which are sorted. */
void lab_sort_in(double *value, int n);

/* What a check has found. */
typedef struct lab_finding {
  char text[LAB_REMARK_TEXT];
  size_t row; /* of the run, where it shows */
  int has_row;
} lab_finding;

int lab_find(lab_finding *finding, const char *format, ...) LAB_PRINTF(2, 3);
int lab_find_at(lab_finding *finding, size_t row, const char *format, ...) LAB_PRINTF(3, 4);

/* "; mixed up bar and kPa?" for a ratio that a slip of units makes, else "".
 * In: ratio of what is expected to what is found */
const char *lab_unit_slip(int channel, double ratio);

/* Checks, each with 1 and a finding, or 0. */
int lab_check_pressure_range(const lab_scene *, lab_finding *);
int lab_check_vacuum(const lab_scene *, lab_finding *);
int lab_check_position_range(const lab_scene *, lab_finding *);
int lab_check_temperature(const lab_scene *, lab_finding *);
int lab_check_dead(const lab_scene *, lab_finding *);
int lab_check_balance(const lab_scene *, lab_finding *);
int lab_check_reach(const lab_scene *, lab_finding *);
int lab_check_settled(const lab_scene *, lab_finding *);
int lab_check_opposite(const lab_scene *, lab_finding *);
int lab_check_command(const lab_scene *, lab_finding *);
int lab_check_pace(const lab_scene *, lab_finding *);
int lab_check_early(const lab_scene *, lab_finding *);
int lab_check_starts(const lab_scene *, lab_finding *);
int lab_check_alike(const lab_scene *, lab_finding *);
int lab_check_late(const lab_scene *, lab_finding *);
int lab_check_one_sided(const lab_scene *, lab_finding *);
int lab_check_steps(const lab_scene *, lab_finding *);
int lab_check_noise(const lab_scene *, lab_finding *);
int lab_check_jump(const lab_scene *, lab_finding *);
int lab_check_part(const lab_scene *, lab_finding *);
int lab_check_unused(const lab_scene *, lab_finding *);
int lab_check_absolute(const lab_scene *, lab_finding *);

/* Nothing that the model predicts moves. */
int lab_scene_is_still(const lab_scene *scene);

#endif

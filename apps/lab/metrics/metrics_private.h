/* What the parts of the figures of merit share.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_METRICS_PRIVATE_H
#define LAB_METRICS_PRIVATE_H

#include "metrics.h"

/* A stretch in which the command holds. */
typedef struct lab_hold {
  int run;
  size_t begin, end; /* rows */
  double level;
  double t;       /* [s] at which the signal left the level before */
  double bracket; /* [s] by which that may be late */
  double rise;    /* [s] that the signal took to get here */
  int dropped;    /* a piece of a ramp, not a level */
} lab_hold;

/* A point of the static characteristic. */
typedef struct lab_point {
  int run;
  double t, s, x; /* time, signal, position */
} lab_point;

/* Points between two turns of the signal. */
typedef struct lab_leg {
  size_t begin, end; /* points; the last one is end - 1 */
  int up;
  int slow;
} lab_leg;

typedef struct lab_path {
  lab_point *point;
  size_t n;
  lab_leg *leg;
  size_t n_legs;
  int held;             /* points are where signal and stem stood still, not rows */
  double noise_s;       /* of a point */
  double least;         /* [m] movement that can be seen */
  const char *rejected; /* why there are no points; NULL if there are some */
} lab_path;

typedef struct lab_metrics_work {
  const lab_record *record;
  lab_metrics *metrics;
  double noise_p, noise_x;
  double least; /* [m] movement that can be seen in a row */
  lab_hold *hold;
  size_t n_holds;
  lab_step_response *step;
  size_t n_steps;
  lab_path path; /* of static points */
  lab_path rows; /* every row as a point of pressure and position */
} lab_metrics_work;

enum { LAB_SEEN = 4 }; /* standard deviations from which on a movement is seen */

/* Set a figure. */
void lab_metric_set(lab_metrics_work *m, int metric, double value, double uncertainty, const char *format, ...)
    LAB_PRINTF(5, 6);
/* Say why there is none. */
#define lab_metric_absent(m, metric, ...) lab_metric_set(m, metric, (double)NAN, (double)NAN, __VA_ARGS__)
/* The same of several, from the first to the last in their order. */
void lab_metrics_deny(lab_metrics_work *m, int first, int last, const char *reason);

/* Of the rated travel, from which on a stroke is a full one. */
#define LAB_FULL_STROKE 0.9

/* How far apart the ends of a leg are [m]. */
double lab_leg_travel(const lab_path *path, const lab_leg *leg);

/* How a channel stands at the end of some rows. */
typedef struct lab_rest {
  double level; /* mean of the last part; NaN where there are too few values */
  double drift; /* of the last part from the one before, beyond what noise makes */
  double error; /* of the level, by noise: two standard deviations */
} lab_rest;

lab_rest lab_rest_of(const lab_record *r, const double *value, size_t begin, size_t end, double noise);

int lab_holds_find(lab_metrics_work *m, lab_error *error);    /* levels of the command */
int lab_steps_measure(lab_metrics_work *m, lab_error *error); /* responses to steps, and full strokes */
int lab_path_find(lab_metrics_work *m, lab_error *error);     /* static points, and rows */
void lab_static_measure(lab_metrics_work *m);                 /* dead band, resolution, hysteresis, linearity */

void lab_path_free(lab_path *path);

/* What the static figures set position against, and its span [Pa]. */
double lab_span(const lab_record *r);

/* Whether a command (enum lab_command) is a set value, against which the static figures are taken. */
int lab_command_is_set(int command);

#endif

/* Static loop of pressure and position of a measured servomotor: the force balance alone, as the library has it with
 * pressure as an input, and what may be added to it.
 *
 * The loop does not tell the diaphragm's area, so all is worked in pressure: with spring rate k, preload x0, dry
 * friction F, area A and nominal stroke s, sliding up (+) or down (-),
 *   p = bench_low + span x/s +- friction,  bench_low = k x0/A,  span = k s/A,  friction = F/A.
 * On a slow loop pressure and position run together, so that friction by travel and friction by pressure fit alike to
 * the last digit: the loop cannot tell which it is.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_SERVOMOTOR_H
#define STUDY_SERVOMOTOR_H

#include <stddef.h>

#include "../../lib/pneu.h"
#include "../lab/fit/fit.h"
#include "../lab/base/message.h"
#include "../lab/rig/rig.h"

/* What may be added, with xi = x/s; the force goes through pneu_input.force.
 *    name                 key                  unit   scale  start lower upper  adds to p */
#define SERVO_TERM_LIST(X)                                                                                             \
  X(FRICTION_POSITION, "friction_position", "kPa", 1e-3, 0, -10, 10, "+- c xi: friction grows with travel")            \
  X(FRICTION_PRESSURE, "friction_pressure", "1", 1, 0, -0.5, 0.5, "+- c p: friction grows with pressure")              \
  X(SPRING_HARDENING, "spring_hardening", "kPa", 1e-3, 0, -50, 50, "c xi^3: the spring hardens")                       \
  X(AREA_VARIATION, "area_variation", "1", 1, 0, -0.5, 0.5, "p (1 + c xi): the area grows")

enum servo_term {
#define X(name, key, unit, scale, start, lower, upper, what) SERVO_##name,
  SERVO_TERM_LIST(X)
#undef X
      SERVO_TERM_COUNT
};

enum {
  SERVO_BENCH_LOW,
  SERVO_SPAN,
  SERVO_FRICTION,
  SERVO_BASE_COUNT, /* of theta, [Pa] */
  SERVO_FIT_MAX = SERVO_BASE_COUNT + SERVO_TERM_COUNT,
  SERVO_POINTS = 128
};

/* The base balance with some terms: a law to be tried. */
typedef struct servo_law {
  const char *name;
  int n;                      /* terms */
  int term[SERVO_TERM_COUNT]; /* enum servo_term */
} servo_law;

extern const servo_law servo_laws[];
extern const int servo_law_count;

/* Measured loop and rig; plain data. */
typedef struct servomotor {
  lab_rig rig;
  double nominal; /* [m] stroke that positions are given in */
  size_t n;
  int direction[SERVO_POINTS];         /* 1: pressure rising, -1: falling */
  double p[SERVO_POINTS];              /* [Pa] gauge */
  double x[SERVO_POINTS];              /* [m] */
  unsigned char sliding[SERVO_POINTS]; /* between the stops, by more than twice the resolution of the drawing */
} servomotor;

/* Read rig and loop (columns branch, p_kPa, x_percent; branch lower: rising).
 * Returns: LAB_OK; LAB_DATA with file and line; LAB_WORLD. */
int servo_read(const char *rig_path, const char *loop_path, servomotor *s, lab_error *error);

/* Name, unit and scale (value = scale * theta) of parameter j of a law. */
const char *servo_key(const servo_law *law, int j);
const char *servo_unit(const servo_law *law, int j);
double servo_scale(const servo_law *law, int j);

/* Pressure at which the stem slides through x, from the library's balance of forces.
 * In:      theta      SERVO_BASE_COUNT + law->n values
 *          x          [m];  direction  1 or -1
 * Out:     p          [Pa] gauge
 * Returns: LAB_OK, LAB_NUMERIC. */
int servo_pressure(const servomotor *s, const servo_law *law, const double *theta, double x, int direction, double *p,
                   lab_error *error);

/* Fit a law to the pressures of the sliding points that are in use.
 * In:      use  not 0 for each point that counts; NULL: all
 * Returns: LAB_OK, LAB_NUMERIC, LAB_WORLD. */
int servo_fit(const servomotor *s, const servo_law *law, const unsigned char *use, lab_fit_result *fit,
              lab_error *error);

/* Position along a slow ramp of pressure up and down again, by the library's stepper: stops, break-away and all.
 * In:      top   [Pa] highest pressure;  n  points each way, >= 2
 * Out:     p, x  2 n entries: rising, then falling
 * Returns: LAB_OK, LAB_NUMERIC. */
int servo_ramp(const servomotor *s, const servo_law *law, const double *theta, double top, size_t n, double *p,
               double *x, lab_error *error);

#endif

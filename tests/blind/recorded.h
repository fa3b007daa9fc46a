/* Trials "as recorded": the rigs and effects of the clean trials, with what benches and plants do to a log.
 *
 * Declared values are off by what their tolerance allows, one of them in some rigs by far more; a positioner may hold
 * the stem; sensors have filters, noise with memory, hum and drift; loggers round, jitter and lose rows; and what is
 * wrong may begin within the log. The truth of all that is drawn here, and spoil.h makes the log of it.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_RECORDED_H
#define BLIND_RECORDED_H

#include "draw.h"

/* What may be said of a log, each with its share of the trials that can have it, in the order of blind_imperfections.
 * From BLIND_TURBULENT on they are drawn apart, so that trials without them are as they were. */
enum blind_imperfection {
  BLIND_POSITIONER, /* holds the stem at a set position */
  BLIND_RAMPS,      /* commands ramp, they do not step */
  BLIND_TOLERANCE,  /* the rig file has a group `tolerance` */
  BLIND_BEYOND,     /* one declared value is off by 3 to 6 times its tolerance */
  BLIND_ONSET,      /* the effect, or else a deviation, begins within the log */
  BLIND_FILTER,     /* first order, on both sensors */
  BLIND_BITS,       /* 10 to 12 of them, not 14 */
  BLIND_ROUNDING,   /* of time */
  BLIND_JITTER,     /* of the clock */
  BLIND_HUM,
  BLIND_COLOUR, /* noise with memory */
  BLIND_DRIFT,
  BLIND_DROPOUTS,    /* empty fields, missing rows */
  BLIND_NOISE_WRONG, /* the declared noise is off */
  BLIND_NOISE_UNTOLD,
  BLIND_TURBULENT,  /* a tube or a supply line that is missing resists as an orifice does, the supply's holds air */
  BLIND_INTEGRAL,   /* the loop has worked before: the integral of its positioner is not 0 at the first row */
  BLIND_LONG_RAMPS, /* the set position goes slowly up or down over a third of the log or more */
  BLIND_IMPERFECTIONS
};

typedef struct blind_share {
  const char *name;
  double share;
} blind_share;
extern const blind_share blind_imperfections[BLIND_IMPERFECTIONS];

/* Declared values with their tolerance. */
enum { BLIND_VALUES = 10 };
typedef struct blind_value {
  const char *name, *unit; /* as in report.json */
  double tolerance;        /* standard deviation: a share, or of what is absolute a quantity */
  int absolute;
  size_t field[2]; /* of second_rig, which it scales or shifts; 0: none */
} blind_value;
extern const blind_value blind_values[BLIND_VALUES];

/* Standard deviation of the ratio of both orifices, of which one factor is fitted: a quarter of their tolerance. */
#define BLIND_VENT_KNOWN 0.05

/* A loop that has worked before leaves an integral which by itself opens the valve by up to this, evenly drawn. At the
 * end of the logs of the first hundred trials of seed 1, without long ramps, it does so by up to 0.1. */
#define BLIND_INTEGRAL_OPENS 0.3

/* -1: there is none of that name. */
int blind_value_named(const char *name);

/* What stands in the rig file of a value. */
double blind_value_of(const second_rig *rig, int value);

/* Let a value be off.  In: off  factor, or of what is absolute the difference */
void blind_value_shift(second_rig *rig, int value, double off);

/* How a positioner's log is driven: which channels it has. */
enum blind_loop { BLIND_OPEN, BLIND_LOOP_U, BLIND_LOOP_P, BLIND_LOOP_X, BLIND_LOOPS };
const char *blind_loop_text(int loop);

enum { BLIND_SENSORS = 2 }; /* pressure, position */
enum { BLIND_PIECES = 16 };

/* A move of the command or the set position: to `to` from t on, over `ramp`. */
typedef struct blind_move {
  double t, to, ramp; /* s, 1, s */
} blind_move;

typedef struct blind_recorded {
  blind_trial t;                /* base: the true rig, without what begins later */
  unsigned has;                 /* bits of enum blind_imperfection */
  int loop;                     /* enum blind_loop */
  double off[BLIND_VALUES];     /* true less or over declared, at the end of the log */
  double vent;                  /* true vent over fill area, less or over declared; known to BLIND_VENT_KNOWN */
  int beyond;                   /* which value is far off, -1: none */
  double told[BLIND_VALUES];    /* tolerances in the rig file; 0: the default */
  double onset;                 /* s; NaN: all is from the start */
  int onset_value;              /* which deviation begins there, -1: the effect */
  second_positioner positioner; /* declared as it is */
  int n_moves;
  blind_move move[BLIND_PIECES];
  double end, spacing;                  /* s */
  double filter[BLIND_SENSORS];         /* s */
  int bits;                             /* of both converters */
  double rounding, jitter;              /* s */
  double hum[BLIND_SENSORS], mains;     /* amplitude over span, Hz */
  double colour[BLIND_SENSORS], memory; /* standard deviation over that of the noise, s */
  double drift[BLIND_SENSORS];          /* over the log, over span */
  double lost, gap_at, gap;             /* share of fields and of rows, s, s */
  double noise_told;                    /* over the true one; 0: not told */
  uint64_t seed;                        /* of what the sensors and the logger add */
} blind_recorded;

/* Standard deviation with which a value is known, in its own measure. */
double blind_known_to(const blind_recorded *r, int value);

/* A trial depends on nothing but the seed, its number and what is left out.
 * In:  without  bits of the imperfections that it must not have */
void blind_draw_recorded(uint64_t seed, int number, unsigned without, blind_recorded *r);

/* The true rig before and after the onset; without one both are the same.
 * In:  which  effects, as bits */
second_rig blind_recorded_first(const blind_recorded *r, unsigned which);
second_rig blind_recorded_later(const blind_recorded *r, unsigned which);

/* Names of its imperfections, "+" between them.  In: size  of text */
void blind_imperfection_text(const blind_recorded *r, char *text, size_t size);

/* Bits of names with commas between them.  Returns: 0 if one is unknown. */
int blind_imperfections_read(const char *names, unsigned *bits);

#endif

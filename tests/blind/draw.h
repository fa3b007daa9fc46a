/* What a trial is: a rig, what is declared of it, what is missing from that, and two schedules of commands.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_DRAW_H
#define BLIND_DRAW_H

#include "chance.h"
#include "effects.h"

enum blind_kind { BLIND_NOTHING, BLIND_SINGLE, BLIND_PAIR, BLIND_UNLISTED, BLIND_KINDS };

/* What the rig file gives to be fitted; each scales one or two fields of the rig. */
enum { BLIND_FITTED = 5 };
typedef struct blind_fitted {
  const char *name; /* in the rig file's list */
  double off;       /* the declared value is off by up to this share */
  size_t field[2];  /* 0: none */
} blind_fitted;
extern const blind_fitted blind_fitted_of[BLIND_FITTED];

/* Multiply what is fitted under a name. */
void blind_scale_fitted(second_rig *rig, int which, double factor);

/* u[i] holds from t[i] on. */
enum { BLIND_COMMANDS = 16 };
typedef struct blind_schedule {
  size_t n;
  double t[BLIND_COMMANDS], u[BLIND_COMMANDS], end; /* [s], 1, [s] */
} blind_schedule;

typedef struct blind_missing {
  const blind_effect *effect;
  double size, shape[BLIND_SHAPES];
} blind_missing;

enum { BLIND_AT_ONCE = 2 };
typedef struct blind_trial {
  int number;
  int kind; /* enum blind_kind */
  const char *actuator;
  second_rig declared; /* what the rig file says, noise and converters included */
  second_rig base;     /* the same with the true values of what is fitted */
  int n_missing;
  blind_missing missing[BLIND_AT_ONCE];
  int tells_noise; /* whether the rig file has the noise of the sensors, or closeloop has to find it */
  int channels;    /* BLIND_P | BLIND_X | BLIND_T */
  double spacing;  /* [s] of the rows */
  double step;     /* [s] of the generator */
  blind_schedule fit, holdout;
} blind_trial;

/* A trial depends on nothing but the seed and its number. */
void blind_draw(uint64_t seed, int number, blind_trial *trial);

/* Size and shape of an effect, of which the generator's step may have to be shorter. */
void blind_draw_missing(blind_chance *chance, blind_trial *trial, int which);

/* The true rig, with the effects whose bit is set in `which`. */
second_rig blind_truth(const blind_trial *trial, unsigned which);

enum { BLIND_ALL = ~0 };

/* enum blind_kind of a trial. */
int blind_kind_of(int number);

const char *blind_kind_text(int kind);

/* Words of a rig file for the laws of the virtual rig. */
const char *blind_gas_text(int gas);
const char *blind_flow_text(int flow);

/* A letter for each channel: "px". */
const char *blind_channels_text(int channels);

#endif

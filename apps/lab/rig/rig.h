/* A rig: what its file declares, ready for the library. The same file is a model that closeloop has completed
 * (model.cfg). pneu-rig(5) describes its groups and keys; missing ones take the defaults of pneu.h, every effect
 * neutral. A parameter of an effect that is not given keeps its neutral value; friction = "stribeck" or "lugre" first
 * sets that effect to its usual size. The words of a data sheet are those of sheet.h. SPDX-License-Identifier: MIT */
#ifndef LAB_RIG_H
#define LAB_RIG_H

#include <stdio.h>

#include "../../../lib/pneu.h"
#include "../log/channel.h"
#include "../log/logformat.h"
#include "../base/message.h"

enum {
  LAB_PARAM_ORIFICE_AREA = PNEU_PARAM_COUNT, /* in lab_rig.fit: scales fill_area and vent_area together */
  LAB_PARAM_COUNT = PNEU_PARAM_COUNT + 1,    /* things that can be fitted */
  LAB_PRESSURE_DRIFT = LAB_PARAM_COUNT,      /* in lab_rig.tolerance alone: of a sensor, over a run */
  LAB_POSITION_DRIFT,
  LAB_PRESSURE_RESOLUTION, /* there too: the step of its values */
  LAB_POSITION_RESOLUTION,
  LAB_TOLERANCE_COUNT,
  LAB_TERM_MAX = 4,
  LAB_ONSETS_MAX = 3,
  LAB_NAME_TEXT = 64,
  LAB_PARAM_NAME_TEXT = 96, /* bytes of a name from lab_fit_name */
  LAB_PATH_TEXT = 1024
};

enum lab_action { LAB_ACTION_NORMAL, LAB_ACTION_REVERSE };
enum lab_friction { LAB_FRICTION_COULOMB, LAB_FRICTION_STRIBECK, LAB_FRICTION_LUGRE, LAB_FRICTION_COUNT };

/* A parameter that has another value from some time of a log on. */
typedef struct lab_rig_onset {
  int param;    /* as in pneu_param_describe, or LAB_PARAM_ORIFICE_AREA */
  double from;  /* [s] */
  double value; /* from then on; of LAB_PARAM_ORIFICE_AREA a factor on both areas */
} lab_rig_onset;

/* Plain data: copy it freely. */
typedef struct lab_rig {
  char file[LAB_PATH_TEXT]; /* where it was read */
  char name[LAB_NAME_TEXT]; /* of the actuator; by default that of the file without its ending */
  int action;               /* enum lab_action; for readers: x follows the air in both, see pneu_stem_extension */
  int friction;             /* enum lab_friction */
  pneu_params params;
  pneu_laws laws;
  pneu_term term[LAB_TERM_MAX]; /* free terms: what acts without a name */
  int n_terms;
  int n_onsets;
  lab_rig_onset onset[LAB_ONSETS_MAX]; /* in the order of time */
  int n_fit;
  int fit[LAB_PARAM_COUNT];                   /* parameters (as in pneu_param_describe) or LAB_PARAM_ORIFICE_AREA */
  unsigned char fit_per_log[LAB_PARAM_COUNT]; /* 1: every log has its own value */
  double tolerance[LAB_TOLERANCE_COUNT];      /* with which a value is known, SI; NaN: see tolerance.h */
  unsigned char assumed[LAB_PARAM_COUNT];     /* 1: a file was read that does not say it */
  double band_edge;                           /* as in pneu_model, at least; 0: the library's */
  int others_are_exact;                       /* the file says so of tolerances that it does not give */
  double noise[LAB_CHANNEL_COUNT];            /* standard deviation, SI; NaN: estimate it from the log */
  unsigned char input[LAB_CHANNEL_COUNT];     /* 1: drives the model; u always does */
  lab_log_format log;
} lab_rig;

/* What a file without any key declares.  Out: rig */
void lab_rig_default(lab_rig *rig);

/* Read a rig file.
 * Out:     rig
 * Returns: LAB_OK; LAB_DATA with file, line, key, what was expected and what was found; LAB_WORLD. */
int lab_rig_read(const char *path, lab_rig *rig, lab_error *error);

/* Read the text of a rig file.  In: path  what messages call it  Out, Returns: as lab_rig_read. */
int lab_rig_parse(const char *text, const char *path, lab_rig *rig, lab_error *error);

/* Write a file from which lab_rig_read makes the same rig, bit for bit; check ferror afterwards.
 * In:      remark  lines for the head of the file, or NULL */
void lab_rig_write(FILE *file, const lab_rig *rig, const char *remark);

/* Write parameters, laws and free terms as C: macros MODEL_PARAMS, MODEL_LAWS, MODEL_N_TERMS and, unless there are
 * none, MODEL_TERMS, for initialisers. In C99 parameters of effects go by name, and any catalogue will do that has what
 * is named; in C90 and C++ they go by place, and any catalogue but the whole one is an error at compile time. To be
 * included after pneu.h. In:      whole  not 0: the names of neutral effects too */
void lab_rig_write_c(FILE *file, const lab_rig *rig, int whole);

/* Write the catalogue that a rig needs, in the form of lib/effects.def: its effects that are not neutral. */
void lab_rig_write_catalogue(FILE *file, const lab_rig *rig);

/* The library's model of a rig, before any onset. It uses the rig's free terms where they lie: the rig must outlive it,
 * unmoved. Out:     model Returns: LAB_OK, LAB_DATA naming the parameter at fault. */
int lab_rig_model(const lab_rig *rig, pneu_model *model, lab_error *error);

/* All that leaves the chamber [kg/s] at gauge pressure p [Pa] and position x [m], without a command.
 * Returns: NaN where the library has no such model. */
double lab_rig_outflow(const lab_rig *rig, double p, double x);

/* What a leak lets out of a chamber at supply pressure while both orifices are shut [kg/s]: nothing below ambient
 * pressure.
 * In:      param  its size, 0 for none
 * Returns: NaN where the library has no such model. */
double lab_rig_leak(const lab_rig *rig, int param);

/* A rig as it is at some time of a log, whose model the library has.
 * In:      t    [s]; infinite: when all that begins has begun
 * Out:     now  without onsets */
void lab_rig_at(const lab_rig *rig, double t, lab_rig *now);

/* Set to neutral what does not act: a fit may end at a lag that is shorter than any that the model has, and a file with
 * it would be refused. */
void lab_rig_drop_idle(lab_rig *rig);

/* Whether the rig file declares a positioner. */
int lab_rig_has_positioner(const lab_rig *rig);

/* Take where the integral of a positioner begins for unknown, in each log: it has worked before. As far as the rig file
 * does not say that, or how well it is known. */
void lab_rig_free_integral(lab_rig *rig);

/* Whether a parameter, or LAB_PARAM_ORIFICE_AREA, is in the list `fit`. */
int lab_rig_fits(const lab_rig *rig, int param);

/* What the library says of a parameter, or as much of LAB_PARAM_ORIFICE_AREA, a factor on both areas. */
pneu_param_info lab_param_info(int param);

/* The value of a parameter; 1 of LAB_PARAM_ORIFICE_AREA. */
double lab_param_value(const lab_rig *rig, int param);

/* Name of something fitted: "dry_friction", "orifice_area", "chamber_leak.leak_area".
 * In:      index  0 <= index < LAB_PARAM_COUNT
 * Out:     name   Returns: name */
const char *lab_fit_name(int index, char name[LAB_PARAM_NAME_TEXT]);

/* The index of such a name; -1 if this build has none. */
int lab_param_index(const char *name);

#endif

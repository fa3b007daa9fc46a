/* The effects that a trial may have, as data.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_EFFECTS_H
#define BLIND_EFFECTS_H

#include <stddef.h>

#include "../second/rig.h"

/* What a size is measured by, so that one range serves small actuators and large ones; NULL: 1 in SI units. */
typedef double blind_scale(const second_rig *rig);

/* A second parameter, drawn evenly in the logarithm from lo to hi of its scale. */
typedef struct blind_shape {
  const char *name;
  size_t field; /* of second_rig */
  double lo, hi;
  blind_scale *scale;
} blind_shape;

/* Channels, as bits. */
enum { BLIND_P = 1, BLIND_X = 2, BLIND_T = 4 };

/* What has to be declared for the effect to make sense: another flow law, or what is known of heat. */
enum blind_setting { BLIND_ANY, BLIND_PAPER_FLOW, BLIND_ISOTHERMAL, BLIND_ADIABATIC, BLIND_FILM };

enum { BLIND_SHAPES = 2 };

typedef struct blind_effect {
  const char *name;     /* as in report.json; "unlisted:..." where the catalogue has no name for it */
  const char *equation; /* mass, energy, force, command, sensor */
  const char *family;   /* effects of one family leave nearly the same trace: the right class, if not the right name */
  const char *unit;     /* of the size */
  double lo, hi;        /* range of the size over its scale, drawn evenly in the logarithm */
  blind_scale *scale;
  int either_sign;
  size_t field;                                /* of second_rig, which takes the size, or */
  void (*apply)(second_rig *rig, double size); /* what has to be done to the rig */
  blind_shape shape[BLIND_SHAPES];
  int channels; /* that the log must have to show it; 0: any */
  int setting;  /* enum blind_setting */
  double step;  /* [s] of the generator, where the usual one is too long */
} blind_effect;

/* Listed effects first, then those that the catalogue does not know. */
extern const blind_effect blind_effects[];
extern const int blind_effect_count;
int blind_listed_count(void);
int blind_is_listed(const blind_effect *effect);

/* First row of that name; NULL if there is none. */
const blind_effect *blind_effect_named(const char *name);

/* The effect of that name whose line resists as an orifice does, for logs as recorded; NULL if it has none. */
const blind_effect *blind_turbulent_of(const blind_effect *effect);

double blind_scale_of(blind_scale *scale, const second_rig *rig);

/* A field of a rig by its offset. */
double *blind_field(second_rig *rig, size_t offset);

/* Switch an effect on.  In: size, not 0; shape, as many as the effect has */
void blind_effect_apply(const blind_effect *effect, double size, const double *shape, second_rig *rig);

/* Mass flow through the fully open supply orifice into a chamber at far lower pressure [kg/s]. */
double blind_full_flow(const second_rig *rig);

/* Time in which that would fill the chamber at full stroke [s]. */
double blind_filling_time(const second_rig *rig);

#endif

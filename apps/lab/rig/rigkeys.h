/* The keys of a rig file, for its reader and its writer.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_RIGKEYS_H
#define LAB_RIGKEYS_H

#include "rig.h"

/* What a key holds: a parameter, the name of the actuator, or a word of a few. */
enum lab_key_kind { LAB_KEY_PARAM, LAB_KEY_NAME, LAB_KEY_WORD };

typedef struct lab_key {
  const char *key; /* first member, for lab_name_index */
  const char *group;
  int kind;                 /* enum lab_key_kind */
  int param;                /* LAB_KEY_PARAM: enum pneu_param */
  const char *const *words; /* LAB_KEY_WORD: n of them, */
  int n;
  size_t member; /* and the int of lab_rig that says which it is */
} lab_key;

/* In the order in which they are written, group by group. */
extern const lab_key lab_keys[];
extern const int lab_key_count;

/* The effect that a friction law switches on, or NULL. */
extern const char *const lab_friction_effects[LAB_FRICTION_COUNT];

#endif

/* The keys of a rig file, for its reader and its writer.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_RIGKEYS_H
#define LAB_RIGKEYS_H

#include "rig.h"

/* What a key holds. */
enum lab_key_kind { LAB_KEY_PARAM, LAB_KEY_NAME, LAB_KEY_ACTION, LAB_KEY_GAS, LAB_KEY_FLOW, LAB_KEY_FRICTION };

typedef struct lab_key {
  const char *key; /* first member, for lab_name_index */
  const char *group;
  int kind;  /* enum lab_key_kind */
  int param; /* LAB_KEY_PARAM: enum pneu_param */
} lab_key;

/* In the order in which they are written, group by group. */
extern const lab_key lab_keys[];
extern const int lab_key_count;

typedef struct lab_word {
  const char *word;   /* first member, for lab_name_index */
  const char *effect; /* friction law: the effect it switches on, or NULL */
} lab_word;

extern const lab_word lab_action_words[2];
extern const lab_word lab_friction_words[LAB_FRICTION_COUNT];

#endif

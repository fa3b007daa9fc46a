/* Actuators by name, with what their makers' public sheets say.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_ACTUATORS_H
#define LAB_ACTUATORS_H

#include "../base/message.h"

enum { LAB_ACTUATOR_WORDS = 4 };

typedef struct lab_actuator {
  const char *name;                     /* maker, type, size */
  const char *word[LAB_ACTUATOR_WORDS]; /* of the sheet, as lab_sheet_word_read takes them; NULL: fewer */
  const char *source;
} lab_actuator;

/* Returns: the actuator of that name; NULL with `error` (LAB_USAGE, the nearest name) if there is none */
const lab_actuator *lab_actuator_find(const char *name, lab_error *error);

#endif

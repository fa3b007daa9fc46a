/* Which test to record next, for what closeloop found.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_ADVISE_H
#define LAB_ADVISE_H

#include "loopfiles.h"

/* Fill in story->separate and story->next. A story without advice says why in their texts.
 * Returns: LAB_OK, LAB_WORLD. */
int lab_advise(lab_story *story, lab_error *error);

#endif

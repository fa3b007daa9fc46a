/* What a trial "as recorded" needs before closeloop is asked.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_PREPARE_H
#define BLIND_PREPARE_H

#include "recorded_limit.h"

/* Write its log and rig file into a folder, and find what the log can show at best; both are taken as they are where an
 * earlier run left those of the same trial there.
 * Out:     rows, visible
 * Returns: LAB_OK; LAB_NUMERIC, LAB_WORLD */
int blind_prepare(const blind_recorded *trial, const char *folder, size_t *rows, blind_visible *visible,
                  lab_error *error);

#endif

/* Reading libconfig files with errors that say file, line, key, what was expected and what was found.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_CONFIG_H
#define LAB_CONFIG_H

#include <stddef.h>

#include <libconfig.h>

#include "message.h"

/* Read a file.
 * In:      path    kept by the settings for their messages: must outlive them
 * Out:     config  to be freed with config_destroy, also after an error
 * Returns: LAB_OK, LAB_DATA, LAB_WORLD. */
int lab_config_read(config_t *config, const char *path, lab_error *error);

/* Read a text.
 * In:      path  what messages call it; kept
 * Out:     config, Returns: as lab_config_read. */
int lab_config_parse(config_t *config, const char *text, const char *path, lab_error *error);

/* Fail at a setting: "file:line: group.key: ..."; the long form leaves the words to `format`.
 * Returns: LAB_DATA. */
int lab_config_fail(const config_setting_t *setting, lab_error *error, const char *format, ...) LAB_PRINTF(3, 4);

/* Put the place of a setting in front of the recorded text.  Returns: its status. */
int lab_config_fail_in(const config_setting_t *setting, lab_error *error);

/* Fail at a setting of the wrong kind: expected `expected`, found what is there.  Returns: LAB_DATA. */
int lab_config_expected(const config_setting_t *setting, const char *expected, lab_error *error);

/* Check that a setting is a group, and every member of it a row of a table (see names.h).
 * Returns: LAB_OK, or LAB_DATA naming the nearest known key. */
int lab_config_known(const config_setting_t *group, const void *table, size_t n, size_t stride, lab_error *error);

/* Fail at a setting whose key is in no table; names the nearest one.  Returns: LAB_DATA. */
int lab_config_unknown(const config_setting_t *setting, const void *table, size_t n, size_t stride, lab_error *error);

/* Check that a setting is a group.  Returns: LAB_OK, LAB_DATA. */
int lab_config_is_group(const config_setting_t *setting, lab_error *error);

/* A member of a group; NULL where there is none, or no group. */
const config_setting_t *lab_config_member(const config_setting_t *group, const char *key);

/* The members of a group in the order of `keys`, NULL for one that is not there; the first `needed` of them must be.
 * Returns: LAB_OK; LAB_DATA where one is missing, or has another key. */
int lab_config_members(const config_setting_t *group, const char *const *keys, int n, int needed,
                       const config_setting_t **member, lab_error *error);

/* Read a string with a unit, or a plain number in `unit`.
 * In:      lower, upper  bounds in `unit`, inclusive; may be infinite
 * Returns: LAB_OK, LAB_DATA. */
int lab_config_quantity(const config_setting_t *setting, const char *unit, double lower, double upper, double *value,
                        lab_error *error);

/* The same for a difference or a spread (see lab_quantity_difference), of any finite size. */
int lab_config_difference(const config_setting_t *setting, const char *unit, double *value, lab_error *error);

/* Read a whole number in lower..upper.  Returns: LAB_OK, LAB_DATA. */
int lab_config_count(const config_setting_t *setting, int lower, int upper, int *value, lab_error *error);

/* Read a word of a table.  Out: choice  its row.  Returns: LAB_OK, or LAB_DATA naming the nearest word. */
int lab_config_choice(const config_setting_t *setting, const void *table, size_t n, size_t stride, int *choice,
                      lab_error *error);

/* Copy a string of less than `size` bytes.  Returns: LAB_OK, LAB_DATA. */
int lab_config_text(const config_setting_t *setting, char *text, size_t size, lab_error *error);

/* Check that a setting is a list or an array of n_min..n_max entries.  Returns: LAB_OK, LAB_DATA. */
int lab_config_list(const config_setting_t *setting, int n_min, int n_max, lab_error *error);

#endif

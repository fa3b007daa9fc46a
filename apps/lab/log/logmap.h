/* Which column of a logger's file is which channel, by log.map, by name or by words.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LOGMAP_H
#define LAB_LOGMAP_H

#include "logheader.h"

enum { LAB_HEADING_TEXT = 96, LAB_MAP_TEXT = 320 };

/* A column as its file has it, in UTF-8; longer names are cut. */
typedef struct lab_heading {
  char text[LAB_HEADING_TEXT];
  char below[LAB_HEADING_TEXT]; /* its unit in the next line; "" */
  lab_stamp stamp;              /* of its first row; all 0 where that is no date or time */
} lab_heading;

/* Make columns of headings. Where one of them is named as interface.md says, and the rig file maps none, all must be;
 * else those that mean no channel are left out.
 * In:      heading  n of them, n <= LAB_COLUMN_MAX
 *          guessed  how the file is written was guessed: a heading may be empty
 * In/out:  format   date becomes the order of the dates found
 * Out:     header   n columns
 *          said     LAB_MAP_TEXT bytes: what was guessed, "" for nothing
 * Returns: LAB_OK; LAB_DATA with the key to write. */
int lab_map_columns(const lab_heading *heading, int n, int guessed, lab_log_format *format, double ambient,
                    lab_header *header, char said[LAB_MAP_TEXT], lab_error *error);

/* Whether one of n headings is named as interface.md says. */
int lab_map_is_named(const lab_heading *heading, int n);

#endif

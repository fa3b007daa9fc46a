/* Words and their neighbours: finding a name in a table, and the one a typing error was meant to be.
 * A table is any array of structs whose first member is `const char *`, or an array of strings.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_NAMES_H
#define LAB_NAMES_H

#include <stddef.h>

/* Where `name` stands in a table.
 * In:      table   first row;  n  rows;  stride  bytes from row to row
 * Returns: the row, or -1. */
int lab_name_index(const char *name, const void *table, size_t n, size_t stride);

/* The name in a table that takes the fewest changed, added, dropped or swapped letters to reach; the
 * first of equals. Case is ignored.
 * Returns: the name, or "" for an empty table. */
const char *lab_name_nearest(const char *name, const void *table, size_t n, size_t stride);

/* Letters to change, add, drop or swap with their neighbour to turn a into b, ignoring case; only the
 * first 63 letters are looked at. */
int lab_name_distance(const char *a, const char *b);

#endif

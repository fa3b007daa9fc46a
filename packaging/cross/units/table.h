/* The units and prefixes of UDUNITS-2, as table_make.c writes them from its tables.
 * SPDX-License-Identifier: MIT */
#ifndef UNITS_TABLE_H
#define UNITS_TABLE_H

/* A value v of the unit is scale v + offset in the base units of `dimension`, such as "kg.m-1.s-2". */
typedef struct units_row {
  const char *name;
  int is_symbol; /* of a symbol the case of letters counts, of a name it does not */
  double scale, offset;
  const char *dimension;
} units_row;

typedef struct units_prefix {
  const char *name;
  int is_symbol;
  double value;
} units_prefix;

extern const units_row units_rows[];
extern const int units_row_count;
extern const units_prefix units_prefixes[];
extern const int units_prefix_count;

#endif

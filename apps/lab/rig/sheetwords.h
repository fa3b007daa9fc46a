/* key=value as a user takes it from a data sheet, and the text of a rig file that says the same.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SHEETWORDS_H
#define LAB_SHEETWORDS_H

#include "../base/message.h"

enum { LAB_SHEET_WORDS = 64, LAB_SHEET_VALUE = 128 };

/* A value and where it belongs: "actuator", "area"; "transducer.fill", "Kv"; "tube", "bore". */
typedef struct lab_sheet_word {
  const char *group, *key;
  char value[LAB_SHEET_VALUE]; /* as libconfig has it, in quotes or brackets */
} lab_sheet_word;

/* Read "area=400 cm2", "supply.pressure=4 bar" (or "supply=4 bar"), "bench_set=0.2..1.0 bar", "fill.Kv=0.1", "Kv=0.1"
 * (both orifices), "tube.length=2 m", "flow=choked". Out:     word  up to two n     how many Returns: LAB_OK; LAB_USAGE
 * with the nearest known key. */
int lab_sheet_word_read(const char *text, lab_sheet_word word[2], int *n, lab_error *error);

#endif

/* The words of a data sheet as a user has them: key=value, and the text of a rig file that says the same; actuators and
 * positioners by name, with what their makers' public sheets say; questions, one after the other.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SHEETWORDS_H
#define LAB_SHEETWORDS_H

#include <stdio.h>

#include "../base/message.h"

enum { LAB_SHEET_WORDS = 64, LAB_SHEET_VALUE = 128, LAB_PRODUCT_WORDS = 4, LAB_QUESTIONS = 10 };

/* A value and where it belongs: "actuator", "area"; "transducer.fill", "Kv"; "tube", "bore". */
typedef struct lab_sheet_word {
  const char *group, *key;
  char value[LAB_SHEET_VALUE]; /* as libconfig has it, in quotes or brackets */
} lab_sheet_word;

/* Read "area=400 cm2", "supply.pressure=4 bar" (or "supply=4 bar"), "bench_set=0.2..1.0 bar", "fill.Kv=0.1", "Kv=0.1"
 * (both orifices), "tube.length=2 m", "positioner.gain=20", "flow=choked".
 * Out:     word  up to two
 *          n     how many
 * Returns: LAB_OK; LAB_USAGE with the nearest known key. */
int lab_sheet_word_read(const char *text, lab_sheet_word word[2], int *n, lab_error *error);

/* An actuator or a positioner, as its maker sells it. */
typedef struct lab_product {
  const char *name;                    /* maker, type, size */
  const char *word[LAB_PRODUCT_WORDS]; /* of the sheet, as lab_sheet_word_read takes them; NULL: fewer */
  const char *source;
} lab_product;

enum lab_product_kind { LAB_ACTUATOR, LAB_POSITIONER, LAB_PRODUCT_KINDS };

/* The product that "actuator=fisher-657-40" or "positioner=siemens-sipart-ps2" names.
 * Out:     kind     enum lab_product_kind; LAB_PRODUCT_KINDS: the text names none, but is a word
 *          product  NULL: as before
 * Returns: LAB_OK; LAB_USAGE with the nearest name of that kind. */
int lab_product_read(const char *text, int *kind, const lab_product **product, lab_error *error);

typedef struct lab_sheet_answers {
  char text[LAB_QUESTIONS][LAB_SHEET_VALUE]; /* "key=value" */
  int n;
} lab_sheet_answers;

/* Ask; an empty line leaves a question open, a wrong answer is asked for again, the end of `in` ends it.
 * In:      in, out  where answers come from, and where questions go
 * Out:     answers  as lab_draft_write takes them */
void lab_sheet_ask(FILE *in, FILE *out, lab_sheet_answers *answers);

#endif

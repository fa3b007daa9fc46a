/* Free terms of a rig: the group `unlisted` of its file, and the same as C initialisers.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_RIGTERM_H
#define LAB_RIGTERM_H

#include <stdio.h>

#include <libconfig.h>

#include "../../../lib/pneu.h"
#include "../base/message.h"

typedef struct lab_term_word {
  const char *key; /* in rig files; first member, for lab_name_index */
  const char *unit;
  const char *constant; /* its name in pneu.h */
} lab_term_word;

/* Indexed by enum pneu_term_equation and enum pneu_term_argument. */
extern const lab_term_word lab_term_equations[PNEU_TERM_EQUATION_COUNT];
extern const lab_term_word lab_term_arguments[PNEU_TERM_ARGUMENT_COUNT];

/* Read a list of at most `max` terms.
 * Out:     term, n
 * Returns: LAB_OK; LAB_DATA with file, line, key, what was expected and what was found. */
int lab_terms_read(const config_setting_t *list, int max, pneu_term *term, int *n, lab_error *error);

/* Write the list, from which lab_terms_read makes the same terms, bit for bit; nothing where there are none. */
void lab_terms_write(FILE *file, const pneu_term *term, int n);

/* Write MODEL_N_TERMS and, unless there are none, MODEL_TERMS, for
 *   static const pneu_term term[] = MODEL_TERMS; */
void lab_terms_print_c(FILE *file, const pneu_term *term, int n);

#endif

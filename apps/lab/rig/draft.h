/* A rig file drafted from a log and the words of a data sheet, with a comment on every line: what comes from the sheet,
 * what was derived from the log, what the log can determine, and what nobody knows yet.
 *
 * Derived are starting values for a fit:
 *
 * - spring: the straight lines of p over x, one upwards and one downwards, of one slope, without the tenth of the
 * travel next to the stops and without rows at rest: k = A dp/dx, x_0 = A p(0)/k;
 * - dry friction: A times half the distance of the two lines, which has viscous friction in it;
 * - orifices: the largest (V dp/dt + p A dx/dt)/(R T), over a two-hundredth of the log, were the orifice choked;
 * - stroke: between the means of what lies within a hundredth of the highest and the lowest x;
 * - supply: the highest ps, or else 5 % above the highest p; dead volume: a tenth of the swept volume.
 *
 * SPDX-License-Identifier: MIT */
#ifndef LAB_DRAFT_H
#define LAB_DRAFT_H

#include <stdio.h>

#include "../base/message.h"

/* Write a rig file, which lab_rig_read reads, for a log.
 * In:      log    NULL: there is none yet, and all is from the sheet
 *          sheet  n texts as lab_sheet_word_read takes them
 * Returns: LAB_OK; LAB_USAGE for a word that is none; LAB_DATA where the log cannot be read or the sheet contradicts
 *          itself; LAB_WORLD. */
int lab_draft_write(FILE *file, const char *log, const char *const *sheet, int n, lab_error *error);

#endif

/* What closeloop found but has no name for, in words: the equation, the argument and the place of a free term.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_UNLISTED_H
#define LAB_UNLISTED_H

#include "../rig/rig.h"

enum { LAB_WHERE_TEXT = 160 };

/* "mass", "energy", "force" or "sensor", as in report.json. */
const char *lab_unlisted_equation(const pneu_term *term);

/* "dry friction", "a flow into or out of the chamber" */
const char *lab_unlisted_what(const pneu_term *term);

/* "x = 11.2 .. 13.1 mm, both directions", or "nearly everywhere, ...", with the largest value; for a cycle "again and
 * again, every 1.87 s (0.535 Hz)" with its largest amplitude. */
const char *lab_unlisted_where(const pneu_term *term, char text[LAB_WHERE_TEXT]);

/* Where a free term acts: the stretch of its argument outside which it stays near one level. Knots at one end that are
 * exactly 0, up to half of them, do not count: no log has reached them, and nothing is known there.
 * A cycle acts at all times: its whole period, with its largest amplitude as the peak.
 * Out:     level  where it does not act, in its unit; peak  its largest departure from there, signed
 * Returns: 1 if the stretch is a short one, 0 if it acts nearly everywhere. */
int lab_unlisted_stretch(const pneu_term *term, double *from, double *to, double *level, double *peak);

#endif

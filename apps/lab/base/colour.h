/* Noise of which a part has memory: white noise, and beside it a part that wanders and comes back.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_COLOUR_H
#define LAB_COLOUR_H

#include <stddef.h>

#include "message.h"
#include "whiteness.h"

typedef struct lab_colour {
  double memory; /* -1 < memory < 1: correlation from row to row of the part that has memory; 0: all is white */
  double share;  /* 0 .. 1 of the variance: that part */
} lab_colour;

/* Take the memory out: what the rows before do not predict of each value, over its standard deviation.
 * Method:  the innovations of a first-order process seen through white noise (Kalman 1960, J. Basic Eng. 82:35)
 * In:      c  of noise of variance 1
 * In/out:  r  n values, one a row; 0 is a gap and stays so
 * Returns: sum of the logarithms of the variances of the innovations */
double lab_colour_whiten(const lab_colour *c, double *r, size_t n);

/* Variance of second differences of such noise, over that of white noise. */
double lab_colour_second_difference(const lab_colour *c);

/* Colour and size of the noise in stretches at rest. Each stretch has a level, a trend and two decays of its own, which
 * do not count (restricted likelihood: Patterson and Thompson 1971, Biometrika 58:545). Stretches that scatter twice as
 * much as usual do not count, nor do others as long as some stretch has much less noise than the rest. What moves is no
 * noise: most stretches speak against a colour, or their second halves do, or what it leaves is not white, or its
 * memory is an eighth of the longest stretch or more, and that has 160 rows.
 * In/out:  rest   those that count, first
 * Out:     c      memory 0 where the noise is white (memory makes it at most 1,000 times as likely), where there is no
 *                 such noise, or there are fewer than 100 values
 *          scale  standard deviation; unchanged where memory is 0
 * Returns: LAB_OK, LAB_WORLD. */
int lab_colour_estimate(lab_stretch *rest, int n, lab_colour *c, double *scale, lab_error *error);

#endif

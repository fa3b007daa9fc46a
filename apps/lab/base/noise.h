/* How noisy a channel is, from the log alone.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_NOISE_H
#define LAB_NOISE_H

#include <stddef.h>

#include "message.h"

/* Standard deviation of the noise on a channel that otherwise changes smoothly from row to row: from the median size of
 * second differences, which a jump or a stroke in a part of the log does not disturb, interpolated where the values
 * come in steps; no less than a quarter of the smallest of these (quantisation).
 *
 * In:      value  n values; NaN is a gap
 * Out:     noise  in the unit of the channel; NaN with fewer than eight differences
 * Returns: LAB_OK, LAB_WORLD. */
int lab_noise_estimate(const double *value, size_t n, double *noise, lab_error *error);

/* Smallest difference between neighbouring values that is not zero: the step of the converter or of the digits
 * written.  Returns: 0 if all are equal. */
double lab_smallest_step(const double *value, size_t n);

/* The same where neighbouring values differ by whole multiples of it: the resolution of the channel.  Returns: 0 if
 * they do not. */
double lab_resolution(const double *value, size_t n);

#endif

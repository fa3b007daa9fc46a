/* A response seen coarsely: its course and its roughness, window by window.
 *
 * Where the stem sticks and slips, the instants of the slips depend on everything that came before, and no model keeps
 * in step for long: row by row a right model may be further from the log than one without stick-slip at all. Its mean
 * over a window and its scatter about a straight line there do not depend on the phase, and a fit to these finds its
 * way.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_WINDOWED_H
#define LAB_WINDOWED_H

#include <stddef.h>

/* Windows of w rows that overlap by half, in n rows; each gives two values. */
size_t lab_windowed_count(size_t n, size_t w);

/* Residuals of a prediction: differences of mean and of scatter over what they are known to. A window is known to its
 * share of the noise, and to a share of the roughness of the whole: it need not hold whole cycles, and a stem at rest
 * may have stopped anywhere within a slip.
 * In:      measured, predicted  n values; NaN is a gap
 *          sigma                noise
 * Out:     r                    2 lab_windowed_count(n, w) values; 0 where a window has fewer than eight */
void lab_windowed_residuals(const double *measured, const double *predicted, size_t n, size_t w, double sigma,
                            double *r);

/* Share of the windows in which a channel moves rougher than predicted: its scatter about a straight line is beyond
 * one and a half times that of the prediction by more than three times the noise. */
double lab_windowed_roughness(const double *measured, const double *predicted, size_t n, size_t w, double sigma);

#endif

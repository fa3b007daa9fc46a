/* Quantiles of the distributions that intervals are made of.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_QUANTILE_H
#define LAB_QUANTILE_H

/* Probability that Student's t is at most x.
 * In:      degrees  of freedom, > 0; infinite: the normal distribution
 * Error:   below 1e-13. */
double lab_student_probability(double x, double degrees);

/* The x at which that probability is p, 0 < p < 1.  Error: below 1e-12 relative for p within 1e-6 .. 1 - 1e-6. */
double lab_student_quantile(double p, double degrees);

/* Probability that chi-square exceeds x >= 0.
 * In:      degrees  of freedom, >= 1
 * Error:   below 2e-13 relative; 0 below 1e-308. */
double lab_chi2_tail(double x, int degrees);

/* The statistic at which chi-square with one degree of freedom has this tail, 0 < p < 1. */
double lab_chi2_threshold(double p);

#endif

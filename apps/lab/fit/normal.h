/* Least squares by normal equations, for a few unknowns and judgements good to a few digits.
 *
 * G = [J d]'[J d] with k columns of slopes J and one column d; row by row, k + 1 rows. Sums of such matrices are the
 * matrices of the records together.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_NORMAL_H
#define LAB_NORMAL_H

enum { LAB_NORMAL_MAX = 32 }; /* unknowns */

typedef struct lab_normal {
  int k;
  double g[LAB_NORMAL_MAX + 1][LAB_NORMAL_MAX + 1];
} lab_normal;

/* No rows yet.  Out: normal, of k unknowns */
void lab_normal_clear(lab_normal *normal, int k);

/* Add m rows; only the upper triangle is used anywhere.
 * In:      column  k + 1 columns of m entries each, d last */
void lab_normal_add_rows(lab_normal *normal, const double *const *column, int m);

/* Add `weight` times another matrix of as many unknowns. */
void lab_normal_add(lab_normal *normal, double weight, const lab_normal *other);

/* Leave out unknowns.
 * In:      keep  n that stay, in their new order */
void lab_normal_select(const lab_normal *normal, int n, const int *keep, lab_normal *part);

/* The same rows once the unknowns have changed: d less J change. */
void lab_normal_shift(lab_normal *normal, const double *change);

/* Length of d with the span of J taken out. A column that the others span to 1e-4 of its length adds nothing to it. */
double lab_normal_rest(const lab_normal *normal);

/* The combination of columns nearest to d, each taken to be 0 beforehand, give or take prior[j].
 * Out:     step  k entries */
void lab_normal_step(const lab_normal *normal, const double *prior, double *step);

/* Standard deviations of the unknowns, each known beforehand to prior[j].
 * Out:     deviation  k entries */
void lab_normal_deviations(const lab_normal *normal, const double *prior, double *deviation);

#endif

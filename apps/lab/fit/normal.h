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

/* Length of d with the span of J taken out. A column that the others span to 1e-4 of its length adds nothing to it. */
double lab_normal_rest(const lab_normal *normal);

/* Standard deviations of the unknowns, each known beforehand to prior[j].
 * Out:     deviation  k entries */
void lab_normal_deviations(const lab_normal *normal, const double *prior, double *deviation);

/* As many rows as columns that have these normal equations: an upper triangle U with U'U = G. A column of J that the
 * others span has none.
 * Out:     row  k + 1 of them */
void lab_normal_rows(const lab_normal *normal, double row[][LAB_NORMAL_MAX + 1]);

/* Solve a x = b for a symmetric, positive matrix of rows `stride` apart; a becomes its Cholesky factor.
 * In/out:  b  becomes x
 * Returns: 0, or -1 if the matrix is not positive. */
int lab_solve_positive(int n, int stride, double *a, double *b);

#endif

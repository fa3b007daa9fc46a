#include "scan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"

static const double invisible = 1e-6; /* share of a slope below which it counts as absorbed */

void lab_scan_normalise(double *v, double length, size_t m)
{
  size_t i;
  for (i = 0; i < m; i++)
    v[i] /= length;
}

double lab_scan_project_out(const double *basis, int n, size_t m, double *v)
{
  double before = sqrt(lab_dot(v, v, m)), left = before;
  int j, pass;
  size_t i;
  for (pass = 0; pass < 2; pass++) {
    for (j = 0; j < n; j++) {
      const double *b = basis + (size_t)j * m;
      const double c = lab_dot(b, v, m);
      for (i = 0; i < m; i++)
        v[i] -= c * b[i];
    }
    left = sqrt(lab_dot(v, v, m));
    if (left > 0.1 * before)
      break;
  }
  return left;
}

double lab_scan_visible(const lab_scan *s, double *v)
{
  const double whole = sqrt(lab_dot(v, v, s->m));
  const double left = whole > 0 ? lab_scan_project_out(s->basis, s->n_basis, s->m, v) : 0;
  return left > invisible * whole ? left : 0;
}

int lab_scan_open(lab_unknowns *u, lab_scan *s, lab_error *error)
{
  double theta[LAB_FIT_MAX];
  int j, status = LAB_OK;
  memset(s, 0, sizeof *s);
  s->u = u;
  s->m = u->m = u->n_data + (size_t)u->n;
  s->r = malloc(s->m * sizeof *s->r);
  s->basis = malloc((size_t)(u->n + 1) * s->m * sizeof *s->basis);
  if (!s->r || !s->basis)
    return lab_fail_memory(error, "a scan");
  for (j = 0; j < u->n; j++)
    theta[j] = u->unknown[j].value;
  if (lab_unknowns_residuals(u, theta, s->r, error))
    return error->status;
#pragma omp parallel for schedule(dynamic)
  for (j = 0; j < u->n; j++) {
    lab_error mine;
    double *column = s->basis + (size_t)j * s->m;
    const int at = lab_unknowns_slope(u, theta, s->r, j, column, &mine);
    if (at == LAB_NUMERIC)
      memset(column, 0, s->m * sizeof *column);
    else if (at != LAB_OK) {
#pragma omp critical(scan_error)
      *error = mine, status = at;
    }
  }
  for (j = 0; j < u->n && status == LAB_OK; j++) {
    double *column = s->basis + (size_t)j * s->m;
    const double whole = sqrt(lab_dot(column, column, s->m)),
                 left = lab_scan_project_out(s->basis, s->n_basis, s->m, column);
    if (!(left > invisible * whole))
      continue;
    lab_scan_normalise(column, left, s->m);
    if (s->n_basis != j)
      memcpy(s->basis + (size_t)s->n_basis * s->m, column, s->m * sizeof *column);
    s->n_basis++;
  }
  s->chi2 = lab_dot(s->r, s->r, u->n_data);
  s->excess = s->chi2 - (double)u->n_values;
  return status;
}

void lab_scan_close(lab_scan *s)
{
  free(s->r);
  free(s->basis);
  memset(s, 0, sizeof *s);
}

int lab_scan_difference(const lab_scan *s, const lab_rig *model, double *slope, lab_error *error)
{
  size_t i;
  if (lab_unknowns_residuals_with(s->u, model, slope, error))
    return error->status;
  for (i = 0; i < s->m; i++)
    slope[i] -= s->r[i];
  return LAB_OK;
}

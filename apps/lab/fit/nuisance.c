#include "nuisance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "drift.h"

/* The column of one value: its slope over its reach, and -1 in its own row, without the columns before it. */
static void add_column(lab_nuisance *h, const lab_unknown *x, double reach, const double *slope)
{
  const size_t stride = h->n_data + LAB_FIT_MAX, rows = h->n_data + (size_t)h->n + 1;
  double *column = h->basis + (size_t)h->n * stride, length;
  size_t i;
  memcpy(h->slopes + (size_t)h->n * h->n_data, slope, h->n_data * sizeof *slope);
  for (i = 0; i < h->n_data; i++)
    column[i] = slope[i] * reach;
  memset(column + h->n_data, 0, LAB_FIT_MAX * sizeof *column);
  column[rows - 1] = -1;
  length = lab_project_out(h->basis, h->n, stride, rows, column);
  for (i = 0; i < rows; i++)
    column[i] /= length;
  h->of[h->n] = *x;
  h->off[h->n++] = (x->prior - x->value) / reach;
}

/* Slopes of all that has a prior; 0 where one cannot be simulated. */
static int find_slopes(lab_unknowns *u, double *r, double *slopes, lab_error *error)
{
  char done[LAB_FIT_MAX];
  int j, status = lab_unknowns_residuals(u, NULL, r, error);
  for (j = 0; j < u->n; j++)
    done[j] = !lab_unknown_is_known(&u->unknown[j]);
  if (status == LAB_OK)
    status = lab_unknowns_slopes(u, r, done, slopes, error);
  return status;
}

static void take_out(lab_unknowns *u, const double *slopes, lab_nuisance *h)
{
  const size_t m = u->m;
  int j, k;
  for (j = k = 0; j < u->n; j++)
    if (lab_unknown_is_known(&u->unknown[j]))
      add_column(h, &u->unknown[j], lab_unknown_reach(u, &u->unknown[j]), slopes + (size_t)j * m);
    else
      u->unknown[k++] = u->unknown[j];
  u->n = k;
  u->nuisance = h;
  lab_unknowns_count(u);
}

int lab_nuisance_open(lab_unknowns *u, lab_nuisance *h, lab_error *error)
{
  const size_t n = (size_t)u->n;
  double *r = malloc((n + 1) * u->m * sizeof *r);
  int status;
  memset(h, 0, sizeof *h);
  h->n_data = u->n_data;
  h->misfit = u->misfit;
  h->basis = malloc((n * (h->n_data + LAB_FIT_MAX) + 1) * sizeof *h->basis);
  h->slopes = malloc((n * h->n_data + 1) * sizeof *h->slopes);
  status = r && h->basis && h->slopes ? find_slopes(u, r, r + u->m, error) : lab_fail_memory(error, "slopes");
  if (status == LAB_OK)
    take_out(u, r + u->m, h);
  free(r);
  return status;
}

void lab_nuisance_close(lab_nuisance *h)
{
  free(h->basis);
  free(h->slopes);
  memset(h, 0, sizeof *h);
}

void lab_nuisance_project(const lab_nuisance *h, double *change)
{
  memset(change + h->n_data, 0, (size_t)h->n * sizeof *change);
  lab_project_out(h->basis, h->n, h->n_data + LAB_FIT_MAX, h->n_data + (size_t)h->n, change);
}

void lab_nuisance_apply(const lab_nuisance *h, double *r)
{
  memcpy(r + h->n_data, h->off, (size_t)h->n * sizeof *r);
  lab_project_out(h->basis, h->n, h->n_data + LAB_FIT_MAX, h->n_data + (size_t)h->n, r);
}

int lab_nuisance_holds(const lab_nuisance *h, int param)
{
  int k, any = 0;
  for (k = 0; k < h->n; k++)
    any |= h->of[k].kind == LAB_UNKNOWN_PARAM && h->of[k].index == param;
  return any;
}

int lab_nuisance_strain(const lab_unknowns *u, double *strain, lab_error *error)
{
  const lab_nuisance *h = u->nuisance;
  double *r = malloc((u->m + 1) * sizeof *r);
  int j, status = r ? lab_unknowns_residuals((void *)u, NULL, r, error) : lab_fail_memory(error, "residuals");
  *strain = u->window == 0 && status == LAB_OK ? lab_drift_strain(u, r) : 0;
  for (j = 0; j < u->n; j++)
    if (lab_unknown_is_held(&u->unknown[j]) || lab_unknown_is_let_go(&u->unknown[j]))
      *strain = fmax(*strain, fabs(u->unknown[j].value - u->unknown[j].prior) / u->unknown[j].tolerance);
  for (j = 0; h && status == LAB_OK && j < h->n; j++)
    if (lab_unknown_is_held(&h->of[j]) && lab_unknowns_find(u, h->of[j].index) < 0)
      *strain = fmax(*strain, fabs(r[h->n_data + (size_t)j]) / h->misfit);
  free(r);
  return status;
}

int lab_nuisance_return(lab_unknowns *u, lab_error *error)
{
  const lab_nuisance *h = u->nuisance;
  double *r = malloc((u->m + 1) * sizeof *r);
  int k, status = r ? lab_unknowns_residuals(u, NULL, r, error) : lab_fail_memory(error, "residuals");
  for (k = 0; status == LAB_OK && k < h->n && u->n < LAB_FIT_MAX; k++) {
    lab_unknown x = h->of[k];
    const double value = x.value + (h->off[k] - r[h->n_data + (size_t)k]) * lab_unknown_reach(u, &x);
    if (x.kind == LAB_UNKNOWN_PARAM && lab_unknowns_find(u, x.index) >= 0)
      continue;
    x.value = fmin(fmax(value, x.lower), x.upper);
    u->unknown[u->n++] = x;
  }
  free(r);
  u->nuisance = NULL;
  lab_unknowns_count(u);
  lab_unknowns_take(u);
  return status;
}

void lab_nuisance_begin_with(const lab_nuisance *h, lab_unknowns *u)
{
  int j, k;
  for (k = 0; u->slopes && k < h->n; k++)
    for (j = 0; j < u->n; j++)
      if (strcmp(u->unknown[j].name, h->of[k].name) == 0) {
        double *column = u->slopes + (size_t)j * u->m;
        memset(column, 0, u->m * sizeof *column);
        memcpy(column, h->slopes + (size_t)k * h->n_data, h->n_data * sizeof *column);
        lab_unknowns_slope_of_prior(u, j, column);
        u->has_slope[j] = 1;
      }
}

int lab_nuisance_is_instants(const lab_nuisance *nuisance)
{
  int k, all = nuisance->n > 0;
  for (k = 0; k < nuisance->n; k++)
    all &= nuisance->of[k].kind == LAB_UNKNOWN_INSTANT;
  return all;
}

/* Fit a model to what another one predicts, for as long as that brings it nearer. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "separate_private.h"

typedef struct pursuit {
  const lab_inquiry *inquiry;
  const lab_outlook *outlook;
  const side *model;
  const lab_normal *known;
  size_t m;           /* values of a prediction */
  pneu_params params; /* of the model, so far */
  double *goal;       /* what it is fitted to */
  double *own;        /* what it predicts */
  double *trial;      /* the same one step further */
  double *slope;      /* model->n columns */
  double *difference; /* the column after them: goal - own */
  lab_normal normal;
  double apart; /* [sigma] length of the difference */
  double rest;  /* [sigma] what fitting should leave of it */
} pursuit;

/* What other records say once the model has changed. */
static void known_now(const pursuit *p, const pneu_params *params, lab_normal *known)
{
  double change[LAB_NORMAL_MAX];
  int j;
  for (j = 0; j < p->model->n; j++)
    change[j] = lab_foresee_change(&p->model->params, params, p->model->param[j], p->model->scale[j]);
  *known = *p->known;
  lab_normal_shift(known, change);
}

static void look(pursuit *p)
{
  const int k = p->model->n;
  lab_normal known;
  bundle b;
  size_t i;
  for (i = 0; i < p->m; i++)
    p->difference[i] = p->goal[i] - p->own[i];
  bundle_fill(&b, p->outlook, k, p->slope);
  bundle_weigh(&b, p->inquiry, p->outlook, &p->normal);
  known_now(p, &p->params, &known);
  lab_normal_add(&p->normal, 1, &known);
  p->apart = sqrt(fmax(p->normal.g[k][k], 0));
  p->rest = lab_normal_rest(&p->normal);
}

/* Whether nearly all that is left is what fitting cannot absorb. */
static int is_over(const pursuit *p)
{
  return p->apart <= 1.05 * p->rest + 0.3;
}

/* [sigma] from the goal, if the model had these parameters and predicted y. */
static double distance(const pursuit *p, const pneu_params *params, const double *y)
{
  const int n = p->outlook->n;
  double sum;
  lab_normal known;
  int c, i;
  known_now(p, params, &known);
  sum = fmax(known.g[known.k][known.k], 0);
  for (c = 0; c < LAB_FORESEEN; c++) {
    const double weight = scene_weight(p->inquiry, p->outlook, c);
    for (i = c * n; weight > 0 && i < (c + 1) * n; i++)
      sum += weight * (p->goal[i] - y[i]) * (p->goal[i] - y[i]);
  }
  return sqrt(sum);
}

/* Move the parameters towards where the model is nearest, less far where that makes it worse.
 * Out:     moved  whether they did */
static int approach(pursuit *p, int *moved, lab_error *error)
{
  double prior[LAB_NORMAL_MAX], step[LAB_NORMAL_MAX], factor;
  int j;
  for (j = 0; j < p->model->n; j++)
    prior[j] = 1; /* no parameter moves by more than its own size for nothing */
  lab_normal_step(&p->normal, prior, step);
  for (*moved = 0, factor = 1; !*moved && factor > 0.05; factor /= 2) {
    pneu_params params = p->params;
    int status;
    for (j = 0; j < p->model->n; j++)
      lab_foresee_shift(&params, p->model->param[j], factor * step[j], p->model->scale[j]);
    status = lab_foresee(p->outlook, &params, p->trial, NULL, error);
    if (status != LAB_OK && status != LAB_NUMERIC)
      return status;
    if (status != LAB_OK || !(distance(p, &params, p->trial) < p->apart))
      continue;
    memcpy(p->own, p->trial, p->m * sizeof *p->own);
    p->params = params;
    *moved = 1;
  }
  return LAB_OK;
}

/* Gauss-Newton, with slopes renewed only where a step has not arrived. */
static int run(pursuit *p, lab_error *error)
{
  enum { ROUNDS = 6 };
  int round, moved = 1;
  for (round = 0; round < ROUNDS && moved; round++) {
    if (lab_foresee_slopes(p->outlook, &p->params, p->model->n, p->model->param, p->model->scale, p->own, p->slope,
                           error))
      return error->status;
    look(p);
    if (is_over(p))
      return LAB_OK;
    if (approach(p, &moved, error))
      return error->status;
    look(p);
    if (is_over(p))
      return LAB_OK;
  }
  return LAB_OK;
}

int pursue(const lab_inquiry *q, const lab_outlook *o, const pneu_params *goal, const side *model,
           const lab_normal *known, double *apart, lab_error *error)
{
  const size_t m = LAB_FORESEEN * (size_t)o->n;
  double *space = malloc(((size_t)model->n + 4) * m * sizeof *space);
  pursuit p;
  int status;
  if (!space)
    return lab_fail_memory(error, "a response");
  memset(&p, 0, sizeof p);
  p.inquiry = q;
  p.outlook = o;
  p.model = model;
  p.known = known;
  p.m = m;
  p.params = model->params;
  p.slope = space;
  p.difference = space + (size_t)model->n * m;
  p.goal = p.difference + m;
  p.own = p.goal + m;
  p.trial = p.own + m;
  if ((status = lab_foresee(o, goal, p.goal, NULL, error)) == LAB_OK &&
      (status = lab_foresee(o, &p.params, p.own, NULL, error)) == LAB_OK)
    status = run(&p, error);
  *apart = p.rest;
  free(space);
  return status;
}

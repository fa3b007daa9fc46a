#include "staging.h"

#include <stdlib.h>
#include <string.h>

void lab_staging_close(lab_staging *s)
{
  free(s->t);
  free(s->input);
  free(s->of);
  free(s->rig);
  free(s->model);
  free(s->from);
  memset(s, 0, sizeof *s);
}

static int allocate(size_t rows, size_t models, lab_staging *s, lab_error *error)
{
  memset(s, 0, sizeof *s);
  s->t = malloc((rows + models) * sizeof *s->t);
  s->input = malloc((rows + models) * sizeof *s->input);
  s->of = malloc((rows + models) * sizeof *s->of);
  s->rig = malloc(models * sizeof *s->rig);
  s->model = malloc(models * sizeof *s->model);
  s->from = malloc(models * sizeof *s->from);
  if (s->t && s->input && s->of && s->rig && s->model && s->from)
    return LAB_OK;
  return lab_fail_memory(error, "a schedule");
}

/* The rig as it is from a time on, and its model, in the scales of the first one: states of effects go on from model to
 * model. */
static int add_model(const lab_rig *rig, double from, lab_staging *s, lab_error *error)
{
  const int k = s->n++;
  int status;
  s->from[k] = from;
  lab_rig_at(rig, from, &s->rig[k]);
  status = lab_rig_model(&s->rig[k], &s->model[k], error);
  if (k > 0 && status == LAB_OK)
    memcpy(s->model[k].scale, s->model[0].scale, sizeof s->model[k].scale);
  return status;
}

/* Models of all episodes, and of what begins in each after it has begun and before the next one does. */
static int add_models(const lab_episode *episode, int n, double begin, lab_staging *s, lab_error *error)
{
  int i, k, status = LAB_OK;
  for (k = 0; k < n && status == LAB_OK; k++) {
    const lab_rig *rig = episode[k].rig;
    const double from = k > 0 ? episode[k].from : begin;
    status = add_model(rig, from, s, error);
    for (i = 0; i < rig->n_onsets && status == LAB_OK; i++)
      if (rig->onset[i].from > from && (k + 1 == n || rig->onset[i].from < episode[k + 1].from))
        status = add_model(rig, rig->onset[i].from, s, error);
  }
  return status;
}

static void add_row(const lab_log *log, double t, const pneu_input *input, int which, lab_staging *s)
{
  const size_t i = s->schedule.n++;
  s->t[i] = t;
  s->input[i] = *input;
  s->of[i] = &s->model[which];
  if (!(s->rig[which].input[LAB_CHANNEL_PS] && log->value[LAB_CHANNEL_PS]))
    s->input[i].supply_pressure = s->rig[which].params.supply_pressure; /* of the rig where it is not measured */
}

/* Another model acts from t on; the inputs go on. */
static void cut(const lab_log *log, double t, int which, lab_staging *s)
{
  const size_t last = s->schedule.n - 1;
  const pneu_input now = lab_input_after(&s->input[last], t - s->t[last]);
  add_row(log, t, &now, which, s);
}

static void add_rows(const lab_log *log, const lab_schedule *logged, const double *early, size_t n_early,
                     lab_staging *s)
{
  size_t i;
  int k = 0;
  while (k + 1 < s->n && s->from[k + 1] <= logged->t[0])
    k++;
  for (i = 0; i < logged->n; i++) {
    const double t = logged->t[i] - (early && i > 0 && i <= n_early ? early[i - 1] : 0);
    for (; k + 1 < s->n && s->from[k + 1] < t; k++)
      cut(log, s->from[k + 1], k + 1, s);
    add_row(log, t, &logged->input[i], k, s);
  }
  for (; k + 1 < s->n; k++)
    cut(log, s->from[k + 1], k + 1, s);
  s->schedule.t = s->t;
  s->schedule.input = s->input;
}

int lab_staging_open(const lab_log *log, const lab_schedule *logged, const double *early, size_t n_early,
                     const lab_episode *episode, int n, lab_staging *s, lab_error *error)
{
  int k, models = n;
  for (k = 0; k < n; k++)
    models += episode[k].rig->n_onsets;
  if (allocate(logged->n, (size_t)models, s, error) || add_models(episode, n, logged->t[0], s, error))
    return error->status;
  add_rows(log, logged, early, n_early, s);
  return LAB_OK;
}

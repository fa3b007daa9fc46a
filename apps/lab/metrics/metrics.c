#include "metrics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "metrics_private.h"
#include "../base/noise.h"

static const double seen_share = 0.0005; /* a movement is seen from this share of the stroke on, and above noise */

/* Noise of a channel: declared, or estimated; 0 where there is too little to tell. */
static int noise_of(const double *value, size_t n, double declared, double *noise, lab_error *error)
{
  *noise = declared;
  if (isnan(declared) && value && lab_noise_estimate(value, n, noise, error))
    return error->status;
  if (!(*noise >= 0))
    *noise = 0;
  return LAB_OK;
}

static int measure(lab_metrics_work *m, lab_error *error)
{
  const lab_record *r = m->record;
  if (noise_of(r->p, r->n, r->noise_p, &m->noise_p, error) || noise_of(r->x, r->n, r->noise_x, &m->noise_x, error))
    return error->status;
  m->least = fmax(LAB_SEEN * m->noise_x, seen_share * r->stroke);
  if (lab_holds_find(m, error) || lab_steps_measure(m, error) || lab_steps_report(m, error) || lab_path_find(m, error))
    return error->status;
  lab_staircase_measure(m);
  lab_loop_measure(m);
  lab_energy_measure(m);
  return lab_strokes_measure(m, error);
}

int lab_metrics_measure(const lab_record *record, lab_metrics *metrics, lab_error *error)
{
  lab_metrics_work m = {0};
  int status = LAB_OK;
  memset(metrics, 0, sizeof *metrics);
  metrics->command = record->command;
  m.record = record;
  m.metrics = metrics;
  if (record->unfit)
    lab_metrics_absent(&m, 0, LAB_METRIC_COUNT - 1, record->unfit);
  else if (!(record->stroke > 0))
    lab_metrics_absent(&m, 0, LAB_METRIC_COUNT - 1, "there is no stem: the stroke is 0");
  else if (!record->x)
    lab_metrics_absent(&m, 0, LAB_METRIC_COUNT - 1, "the record has no position");
  else if (record->n == 0)
    lab_metrics_absent(&m, 0, LAB_METRIC_COUNT - 1, "the record has no rows");
  else
    status = measure(&m, error);
  free(m.hold);
  free(m.step);
  lab_path_free(&m.path);
  lab_path_free(&m.rows);
  return status;
}

/* Full strokes: how long each way, and how differently. */
#include <math.h>
#include <stdlib.h>

#include "asymmetry.h"
#include "metrics_private.h"

/* The first full stroke up or down, NULL where there is none; with the largest change of any step that way. */
static const lab_step_response *full_stroke(const lab_metrics_work *m, int up, double *largest)
{
  const lab_step_response *found = NULL;
  size_t i;
  *largest = 0;
  for (i = 0; i < m->n_steps; i++) {
    const lab_step_response *step = &m->step[i];
    const double change = up ? step->x_to - step->x_from : step->x_from - step->x_to;
    if (step->fate != LAB_STEP_GOOD)
      continue;
    *largest = fmax(*largest, change);
    if (!found && change >= LAB_FULL_STROKE * m->record->stroke)
      found = step;
  }
  return found;
}

static const lab_hold *hold_of(const lab_metrics_work *m, const lab_step_response *step)
{
  size_t k;
  for (k = 0; k + 1 < m->n_holds && m->hold[k].t < step->t; k++)
    ;
  return &m->hold[k];
}

static void deny(lab_metrics_work *m, int metric, int up, double largest)
{
  if (largest > 0)
    lab_metric_absent(m, metric, "no full stroke %s: the largest step covers %.3g %% of the travel", up ? "up" : "down",
                      100 * largest / m->record->stroke);
  else
    lab_steps_deny(m, metric, up);
}

static void report_time(lab_metrics_work *m, int metric, int up, const lab_step_response *step, double largest)
{
  if (!step)
    deny(m, metric, up, largest);
  else
    lab_metric_set(m, metric, step->stroke_time, step->stroke_error, "full stroke %s at t = %.6g s", up ? "up" : "down",
                   step->t);
}

/* The samples of a stroke, its rest before and after as one sample each.
 * Out:     t, x  room for the rows of the hold and two more
 * Returns: how many */
static size_t samples(const lab_record *r, const lab_step_response *step, const lab_hold *hold, double *t, double *x)
{
  size_t i, n = 0;
  t[n] = step->t;
  x[n++] = step->x_from;
  for (i = hold->begin; i < hold->end; i++)
    if (!isnan(r->x[i]) && r->t[i] > t[n - 1]) {
      t[n] = r->t[i];
      x[n++] = r->x[i];
    }
  x[n - 1] = step->x_to;
  return n;
}

static int report_shape(lab_metrics_work *m, const lab_edge *up, const lab_edge *down, const lab_step_response *rise,
                        lab_error *error)
{
  const double noise = m->noise_x / fabs(rise->x_to - rise->x_from);
  lab_asymmetry a;
  double spacing;
  if (lab_asymmetry_measure(up, down, &a, error))
    return error->status;
  spacing = (up->t[up->n - 1] - up->t[0]) / (double)(up->n - 1);
  lab_metric_set(m, LAB_METRIC_DURATION_RATIO, a.duration_ratio,
                 a.duration_ratio * (spacing / a.rise_time + spacing / a.fall_time + 4 * noise),
                 "rise %.4g s, fall %.4g s from 5 %% to 95 %% of travel", a.rise_time, a.fall_time);
  /* |noise| of the difference of two curves: sqrt(2) sqrt(2/pi) */
  lab_metric_set(m, LAB_METRIC_ASYMMETRY, a.asymmetry,
                 1.13 * noise / 0.9 + spacing / a.rise_time + spacing / a.fall_time,
                 "first full stroke up and first full stroke down");
  return LAB_OK;
}

static int compare(lab_metrics_work *m, const lab_step_response *rise, const lab_step_response *fall, lab_error *error)
{
  const lab_hold *up = hold_of(m, rise), *down = hold_of(m, fall);
  const size_t n_up = up->end - up->begin + 2, n_down = down->end - down->begin + 2;
  double *memory = malloc(2 * (n_up + n_down) * sizeof *memory);
  lab_edge rising, falling;
  int status;
  if (!memory)
    return lab_fail_memory(error, "figures of merit");
  rising = (lab_edge){samples(m->record, rise, up, memory, memory + n_up), memory, memory + n_up};
  falling = (lab_edge){samples(m->record, fall, down, memory + 2 * n_up, memory + 2 * n_up + n_down), memory + 2 * n_up,
                       memory + 2 * n_up + n_down};
  status = report_shape(m, &rising, &falling, rise, error);
  free(memory);
  return status;
}

int lab_strokes_measure(lab_metrics_work *m, lab_error *error)
{
  double most_up, most_down;
  const lab_step_response *rise = full_stroke(m, 1, &most_up), *fall = full_stroke(m, 0, &most_down);
  report_time(m, LAB_METRIC_STROKE_TIME_UP, 1, rise, most_up);
  report_time(m, LAB_METRIC_STROKE_TIME_DOWN, 0, fall, most_down);
  if (rise && fall)
    return compare(m, rise, fall, error);
  deny(m, LAB_METRIC_DURATION_RATIO, !rise, rise ? most_down : most_up);
  deny(m, LAB_METRIC_ASYMMETRY, !rise, rise ? most_down : most_up);
  return LAB_OK;
}

#include "logview.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "../base/noise.h"
#include "../run/schedule.h"
#include "../run/start.h"

static const double shut = 0.02; /* commands below this leave both orifices all but shut */

/* ---- Cells ---- */

static void fill_gaps(double *mean, int n)
{
  int i, last = -1;
  for (i = 0; i < n; i++) {
    int k;
    if (isnan(mean[i]))
      continue;
    for (k = last + 1; k < i; k++)
      mean[k] = last < 0 ? mean[i] : mean[last] + (mean[i] - mean[last]) * (k - last) / (i - last);
    last = i;
  }
  for (i = last + 1; last >= 0 && i < n; i++)
    mean[i] = mean[last];
}

static void make_cells(const lab_log_view *s, const double *y, lab_view_cells *cells)
{
  int count[LAB_VIEW_CELLS] = {0}, k;
  size_t i;
  memset(cells, 0, sizeof *cells);
  for (i = 0; i < s->n; i++) {
    k = (int)((s->t[i] - s->t[0]) / s->cell);
    k = k < s->n_cells ? k : s->n_cells - 1;
    if (!isnan(y[i])) {
      cells->mean[k] += y[i];
      count[k]++;
    }
  }
  for (k = 0; k < s->n_cells; k++)
    cells->mean[k] = count[k] > 0 ? cells->mean[k] / count[k] : (double)NAN;
  fill_gaps(cells->mean, s->n_cells);
  if (!lab_range(cells->mean, (size_t)s->n_cells, &cells->low, &cells->high))
    cells->low = cells->high = (double)NAN;
}

/* ---- The view ---- */

int lab_log_view_predicts(const lab_log_view *s, int channel)
{
  const int can =
      channel == LAB_CHANNEL_P || channel == LAB_CHANNEL_T || (channel == LAB_CHANNEL_X && s->rig->params.stroke > 0);
  return can && s->y[channel] && !s->rig->input[channel];
}

int lab_log_view_is_driven(const lab_log_view *s)
{
  return s->rig->input[LAB_CHANNEL_X] || s->rig->input[LAB_CHANNEL_P] || s->y[LAB_CHANNEL_FORCE];
}

const double *lab_log_view_expected(const lab_log_view *s, int channel)
{
  if (!s->has_expected)
    return NULL;
  return channel == LAB_CHANNEL_P ? s->expected.p : channel == LAB_CHANNEL_X ? s->expected.x : s->expected.T;
}

double lab_log_view_span(const lab_log_view *s, int channel)
{
  return s->cells[channel].high - s->cells[channel].low;
}

/* Run the declared model. A rig that cannot be run leaves the view without; the fit will say why. */
static int expect(lab_log_view *s, lab_error *error)
{
  pneu_state start;
  lab_inputs inputs;
  const lab_simulation task = {
      .start = &start, .schedule = &inputs.schedule, .t = s->t, .n = s->n, .options = {.tol = 1e-5}};
  int status;
  if (lab_inputs_from_log(&s->model, s->rig, s->log, s->run, &inputs, error))
    return error->status;
  status = lab_run_initial_state(&s->model, inputs.input, s->log, s->run, &start, error);
  if (status == LAB_OK)
    status = lab_response_run(&s->model, &task, &s->expected, error);
  s->has_expected = status == LAB_OK;
  lab_inputs_free(&inputs);
  if (status == LAB_WORLD)
    return status;
  if (s->has_expected && s->main >= 0)
    make_cells(s, lab_log_view_expected(s, s->main), &s->expected_cells);
  return LAB_OK;
}

static int look_at(lab_log_view *s, int c, lab_error *error)
{
  s->y[c] = s->log->value[c] ? s->log->value[c] + s->first : NULL;
  s->seen[c] = (double)NAN;
  if (s->y[c] && lab_noise_estimate(s->y[c], s->n, &s->seen[c], error))
    return error->status;
  s->sigma[c] = isnan(s->rig->noise[c]) ? s->seen[c] : s->rig->noise[c];
  if (c != LAB_CHANNEL_P && c != LAB_CHANNEL_X)
    return LAB_OK;
  if (s->y[c])
    make_cells(s, s->y[c], &s->cells[c]);
  else
    s->cells[c].low = s->cells[c].high = (double)NAN;
  return LAB_OK;
}

int lab_log_view_open(const lab_rig *rig, const lab_log *log, size_t run, lab_log_view *s, lab_error *error)
{
  int c;
  memset(s, 0, sizeof *s);
  s->rig = rig;
  s->log = log;
  s->run = run;
  s->first = log->run[run];
  s->n = log->run[run + 1] - s->first;
  s->t = log->value[LAB_CHANNEL_TIME] + s->first;
  s->u = log->value[LAB_CHANNEL_U] ? log->value[LAB_CHANNEL_U] + s->first : NULL;
  if (s->u)
    lab_range(s->u, s->n, &s->u_low, &s->u_high);
  s->main = -1;
  s->cells = calloc(LAB_CHANNEL_COUNT, sizeof *s->cells);
  if (!s->cells)
    return lab_fail_memory(error, "the checks of a log");
  if (lab_rig_model(rig, &s->model, error))
    return error->status;
  if (s->n < LAB_VIEW_FEWEST)
    return LAB_OK;
  s->n_cells = s->n / 4 < LAB_VIEW_CELLS ? (int)(s->n / 4) : LAB_VIEW_CELLS;
  s->n_cells = s->n_cells < LAB_VIEW_FEWEST ? LAB_VIEW_FEWEST : s->n_cells;
  s->cell = (s->t[s->n - 1] - s->t[0]) / s->n_cells;
  for (c = LAB_CHANNEL_P; c < LAB_CHANNEL_COUNT; c++)
    if (look_at(s, c, error))
      return error->status;
  for (c = LAB_CHANNEL_X; c >= LAB_CHANNEL_P; c--)
    if (lab_log_view_predicts(s, c))
      s->main = c;
  return expect(s, error);
}

void lab_log_view_close(lab_log_view *s)
{
  if (s->has_expected)
    lab_response_free(&s->expected);
  free(s->cells);
  memset(s, 0, sizeof *s);
}

/* ---- Stretches ---- */

double lab_log_view_value(const double *y, size_t first, size_t end, int from_end)
{
  double sum = 0;
  int n = 0;
  size_t k;
  for (k = 0; k < end - first && n < 3; k++) {
    const double v = y[from_end ? end - 1 - k : first + k];
    if (!isnan(v)) {
      sum += v;
      n++;
    }
  }
  return n > 0 ? sum / n : (double)NAN;
}

static int sign_of(double u)
{
  return u > shut ? 1 : u < -shut ? -1 : 0;
}

int lab_log_view_next(const lab_log_view *s, lab_stretch *stretch)
{
  size_t i = stretch->end;
  if (!s->u || s->main < 0 || s->rig->log.command_is_pressure || i >= s->n)
    return 0;
  stretch->first = i;
  stretch->sign = sign_of(s->u[i]);
  while (i < s->n && sign_of(s->u[i]) == stretch->sign)
    i++;
  stretch->end = i;
  stretch->change =
      lab_log_view_value(s->y[s->main], stretch->first, i, 1) - lab_log_view_value(s->y[s->main], stretch->first, i, 0);
  return 1;
}

/* ---- Findings ---- */

const char *lab_check_show(lab_check_result *finding, int channel, double value)
{
  return lab_format_brief(value, lab_channels[channel].unit, finding->shown[finding->n_shown++]);
}

int lab_check_fail(lab_check_result *finding, size_t row, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  vsnprintf(finding->text, sizeof finding->text, format, args);
  va_end(args);
  finding->row = row;
  return 1;
}

const char *lab_unit_slip(int channel, double ratio)
{
  static const struct slip {
    int channel;
    double factor;
    const char *text;
  } slips[] = {
      {LAB_CHANNEL_P, 6.895, "; psi and kPa mixed up?"},   {LAB_CHANNEL_P, 14.5, "; bar and psi mixed up?"},
      {LAB_CHANNEL_P, 100, "; bar and kPa mixed up?"},     {LAB_CHANNEL_P, 1000, "; Pa, kPa and MPa mixed up?"},
      {LAB_CHANNEL_X, 10, "; mm and cm mixed up?"},        {LAB_CHANNEL_X, 25.4, "; mm and inch mixed up?"},
      {LAB_CHANNEL_X, 1000, "; m, mm and um mixed up?"},   {LAB_CHANNEL_TIME, 60, "; s and min mixed up?"},
      {LAB_CHANNEL_TIME, 1000, "; ms, s and us mixed up?"}};
  const double factor = ratio > 1 ? ratio : 1 / ratio;
  unsigned i;
  for (i = 0; i < sizeof slips / sizeof slips[0]; i++)
    if (slips[i].channel == channel && factor > 0.7 * slips[i].factor && factor < 1.4 * slips[i].factor)
      return slips[i].text;
  return "";
}

/* The figures over time: what was measured and what both models predict, and the residual. */
#include <math.h>
#include <stdlib.h>

#include "figures_private.h"

enum { COMMAND_HEIGHT = 55, CHANNEL_HEIGHT = 180, RESIDUAL_HEIGHT = 105 };

/* ---- Rows ---- */

static void keep_rows_of(const drawing *d, const double *value, lab_point *point)
{
  const lab_residual_table *v = d->table;
  const lab_line line = {v->n, v->t, value, v->n_runs, v->first};
  size_t n = lab_envelope(&line, FIGURE_COLUMNS, point);
  while (n-- > 0)
    d->kept[point[n].row] = 1;
}

/* Decimals of time by which rows can be told apart. */
static int decimals_of_time(const lab_residual_table *v)
{
  double least = HUGE_VAL;
  size_t i;
  for (i = 1; i < v->n; i++)
    if (v->t[i] > v->t[i - 1])
      least = fmin(least, v->t[i] - v->t[i - 1]);
  return isfinite(least) ? (int)fmin(fmax(-floor(log10(least)), 0), 9) : 0;
}

/* Where each run begins, and the axis of time. A shift has no more decimals than time, so that a time of the log is
 * told as it is. */
static void lay_out_runs(const drawing *d, int decimals, double *axis)
{
  const lab_residual_table *v = d->table;
  const lab_unknowns *u = d->report->completed;
  const double unit = pow(10, -decimals);
  size_t i, entry = 0;
  int e;
  for (e = 0; e < v->n_runs; e++) {
    const double shift = v->t[v->first[e]] - u->run[e].log->value[LAB_CHANNEL_TIME][u->run[e].first];
    d->all->first[e] = entry;
    d->all->shift[e] = unit * round(shift / unit);
    for (i = v->first[e]; i < v->first[e + 1]; i++) {
      axis[i] = v->t[i] - shift + d->all->shift[e];
      entry += d->kept[i];
    }
  }
  d->all->t = lab_figures_add_column(d->all, axis, d->kept, v->n, 1, decimals);
}

static void keep_rows(const drawing *d, lab_point *point)
{
  const lab_residual_table *v = d->table;
  int c, stage;
  keep_rows_of(d, v->argument[LAB_ARGUMENT_U], point);
  keep_rows_of(d, v->set_position, point);
  for (c = 0; c < v->n_channels; c++) {
    keep_rows_of(d, v->channel[c].measured, point);
    for (stage = 0; stage < lab_figure_stages(d); stage++) {
      keep_rows_of(d, v->channel[c].predicted[stage], point);
      keep_rows_of(d, v->channel[c].residual[stage], point);
    }
  }
}

void lab_figure_lay_out_time(const drawing *d)
{
  const lab_residual_table *v = d->table;
  lab_point *point = malloc(((size_t)3 * FIGURE_COLUMNS + (size_t)v->n_runs) * sizeof *point);
  double *axis = malloc((v->n + 1) * sizeof *axis);
  d->all->n_runs = v->n_runs;
  d->all->first = calloc((size_t)v->n_runs + 1, sizeof *d->all->first);
  d->all->shift = calloc((size_t)v->n_runs + 1, sizeof *d->all->shift);
  if (point && axis && d->all->first && d->all->shift) {
    keep_rows(d, point);
    lay_out_runs(d, decimals_of_time(v), axis);
  } else {
    d->all->failed = 1;
  }
  free(point);
  free(axis);
}

static int column_of(const drawing *d, const double *value, double scale)
{
  return lab_figures_add_column(d->all, value, d->kept, d->table->n, scale, -1);
}

/* ---- Response ---- */

static void tell_channel(const drawing *d, const lab_residual_channel *mine, const char *name)
{
  const lab_channel_info *info = &lab_channels[mine->channel];
  const lab_search_result *result = d->report->result;
  double low, high;
  char from[LAB_FORMAT_TEXT], to[LAB_FORMAT_TEXT], rmse[LAB_FORMAT_TEXT];
  if (lab_range(mine->measured, d->table->n, &low, &high))
    lab_figure_tell(d, " %s runs from %s to %s; rms error of the declared model %s", name,
                    lab_format_number(lab_format_as(info->unit).scale * low, 3, from),
                    lab_format_quantity(high, info->unit, 3, to),
                    lab_format_quantity(result->before.rmse[mine->channel], info->unit, 3, rmse));
  if (lab_figure_has_completed(d))
    lab_figure_tell(d, ", of the completed one %s",
                    lab_format_quantity(result->after.rmse[mine->channel], info->unit, 3, to));
  lab_figure_tell(d, ".");
}

static void put_channel(const drawing *d, const lab_residual_channel *mine)
{
  static const int form[LAB_STAGE_COUNT] = {LAB_FORM_DASHED, LAB_FORM_LINE};
  const lab_format shown = lab_format_as(lab_channels[mine->channel].unit);
  char name[LAB_FORMAT_TEXT];
  lab_panel *panel = lab_figure_panel(d, lab_figure_channel_name(mine->channel, name), shown.unit, CHANNEL_HEIGHT);
  int stage;
  lab_panel_curve(panel, LAB_KEY_MEASURED, LAB_FORM_LINE, column_of(d, mine->measured, shown.scale));
  for (stage = 0; stage < lab_figure_stages(d); stage++)
    lab_panel_curve(panel, lab_figure_key(stage), form[stage], column_of(d, mine->predicted[stage], shown.scale));
  tell_channel(d, mine, name);
}

static int is_commanded(const drawing *d)
{
  return lab_log_command(d->report->completed->run[0].log) != LAB_CHANNEL_SP;
}

/* What the stem was told to do, where a log has it. */
static void put_set_position(const drawing *d)
{
  double low, high;
  if (lab_range(d->table->set_position, d->table->n, &low, &high))
    lab_panel_curve(lab_figure_panel(d, "Set position sp", "%", COMMAND_HEIGHT), LAB_KEY_COMMAND, LAB_FORM_STEPS,
                    column_of(d, d->table->set_position, 100));
}

/* The opening that is predicted, where a command was not logged; none where it cannot be. */
static void put_command(const drawing *d)
{
  const lab_format shown = lab_format_as(lab_argument_unit(d->report, LAB_ARGUMENT_U));
  const double *u = d->table->argument[LAB_ARGUMENT_U];
  double low, high;
  if (lab_range(u, d->table->n, &low, &high))
    lab_panel_curve(
        lab_figure_panel(d, is_commanded(d) ? "Command u" : "Opening u, predicted", shown.unit, COMMAND_HEIGHT),
        LAB_KEY_COMMAND, LAB_FORM_STEPS, column_of(d, u, shown.scale));
}

int lab_figure_response(const drawing *d)
{
  const lab_residual_table *v = d->table;
  int c;
  lab_figure_entitle(d,
                     lab_figure_has_completed(d) ? "Measured, and what both models predict for the same command"
                                                 : "Measured, and what the model predicts for the same command",
                     v->n_runs > 1 ? "The runs follow one after the other; no peak is lost"
                                   : "Each line spans all values that fall on its pixels, so that no peak is lost");
  lab_figure_tell(d, "Command, measured and predicted channels over %.4g s.", v->t[v->n - 1] - v->t[0]);
  put_command(d);
  put_set_position(d);
  for (c = 0; c < v->n_channels; c++)
    put_channel(d, &v->channel[c]);
  return 1;
}

/* ---- Residual ---- */

static void put_residual(const drawing *d, const lab_residual_channel *mine, int stage, int band)
{
  double low, high;
  char name[2 * LAB_FORMAT_TEXT];
  lab_panel *panel = lab_figure_panel(d, lab_figure_stage_name(mine->channel, stage, name), "× noise", RESIDUAL_HEIGHT);
  lab_panel_curve(panel, LAB_KEY_BAND, LAB_FORM_BAND, band);
  lab_panel_curve(panel, lab_figure_key(stage), LAB_FORM_LINE, column_of(d, mine->residual[stage], 1));
  if (lab_range(mine->residual[stage], d->table->n, &low, &high))
    lab_figure_tell(d, " %s: largest %.3g.", name, fmax(high, -low));
}

int lab_figure_residual(const drawing *d)
{
  const lab_residual_table *v = d->table;
  const int band = lab_figures_add_column(d->all, &lab_figure_two_sided_99, NULL, 1, 1, 2);
  int c, stage;
  lab_figure_entitle(d,
                     lab_figure_has_completed(d) ? "What the models do not explain" : "What the model does not explain",
                     "Measured less predicted, in units of the noise; 99 % of white noise lies in the band");
  lab_figure_tell(d, "Residual over time in units of the noise.");
  d->figure->across = lab_figure_stages(d);
  for (c = 0; c < v->n_channels; c++)
    for (stage = 0; stage < lab_figure_stages(d); stage++)
      put_residual(d, &v->channel[c], stage, band);
  return 1;
}

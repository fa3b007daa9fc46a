/* Series over time, as drawn and as read off. */
#include <math.h>

#include "figures_private.h"

static const double left_edge = 0.085; /* of a panel over time, of the width */

static void put_points(FILE *file, const char *block, int number, const lab_point *point, size_t n, double scale)
{
  size_t i;
  fprintf(file, "$%s_%d << EOD\nat,value\n", block, number);
  for (i = 0; i < n; i++)
    if (isnan(point[i].value))
      fputc('\n', file);
    else
      fprintf(file, "%.6g,%.5g\n", point[i].at, scale * point[i].value);
  fputs("EOD\n", file);
}

/* The envelope of a series over time, in d->point.  Returns: its points */
static size_t reduce(const drawing *d, const double *value)
{
  const lab_evidence *v = d->evidence;
  return lab_envelope(v->t, value, v->n, v->first, v->n_runs, v->t[0], v->t[v->n - 1], FIGURE_COLUMNS, d->point);
}

void figure_put_series(const drawing *d, const char *block, int number, const double *value, double scale)
{
  put_points(d->file, block, number, d->point, reduce(d, value), scale);
}

static void keep_rows_of(const drawing *d, const double *value)
{
  const size_t n = reduce(d, value);
  size_t i;
  for (i = 0; i < n; i++)
    d->kept[d->point[i].row] = 1;
}

/* Decimals of time by which rows can be told apart. */
static int decimals_of_time(const lab_evidence *v)
{
  double least = HUGE_VAL;
  size_t i;
  for (i = 1; i < v->n; i++)
    if (v->t[i] > v->t[i - 1])
      least = fmin(least, v->t[i] - v->t[i - 1]);
  return isfinite(least) ? (int)fmin(fmax(-floor(log10(least)), 0), 9) : 0;
}

/* The time of each row by the clock of its log, and, of several runs, the entry with which each begins and by how much
 * the axis has it later. */
static void read_time(drawing *d)
{
  const lab_evidence *v = d->evidence;
  const lab_unknowns *u = d->story->completed;
  cJSON *runs = cJSON_AddArrayToObject(d->readings, "runs");
  size_t i, entry = 0;
  int e;
  for (e = 0; e < v->n_runs; e++) {
    const double shift = v->t[v->first[e]] - u->experiment[e].log->value[LAB_CHANNEL_TIME][u->experiment[e].first];
    cJSON *item = cJSON_CreateObject();
    cJSON_AddItemToArray(runs, item);
    cJSON_AddNumberToObject(item, "entry", (double)entry);
    cJSON_AddNumberToObject(item, "shift", shift);
    for (i = v->first[e]; i < v->first[e + 1]; i++) {
      d->clock[i] = v->t[i] - shift;
      entry += d->kept[i];
    }
  }
  d->t = lab_readings_column(d->readings, d->clock, d->kept, v->n, 1, decimals_of_time(v));
  cJSON_AddNumberToObject(d->readings, "t", d->t);
}

void figure_keep_rows(drawing *d)
{
  const lab_evidence *v = d->evidence;
  int c, stage;
  keep_rows_of(d, v->argument[LAB_ARGUMENT_U]);
  for (c = 0; c < v->n_channels; c++) {
    keep_rows_of(d, v->channel[c].measured);
    for (stage = 0; stage < figure_stages(d); stage++) {
      keep_rows_of(d, v->channel[c].predicted[stage]);
      keep_rows_of(d, v->channel[c].residual[stage]);
    }
  }
  read_time(d);
}

lab_panel figure_time_panel(const drawing *d)
{
  const lab_evidence *v = d->evidence;
  lab_panel panel = {0};
  panel.group = panel.x_name = "t";
  panel.x_unit = "s";
  panel.left = FIGURE_WIDTH * left_edge;
  panel.right = FIGURE_WIDTH * figure_right_edge;
  panel.x[0] = v->t[0];
  panel.x[1] = v->t[v->n - 1];
  return panel;
}

void figure_read_series(const drawing *d, cJSON *panel, const char *key, const double *value, double scale,
                        int decimals)
{
  lab_readings_curve(panel, key, lab_readings_column(d->readings, value, d->kept, d->evidence->n, scale, decimals));
}

void figure_put_time_axis(const drawing *d)
{
  const lab_evidence *v = d->evidence;
  fprintf(d->file, "LEFT = %g\nRIGHT = %g\nT_FROM = %.6g\nT_TO = %.6g\nT_LABEL = \"Time t [s]%s\"\n", left_edge,
          figure_right_edge, v->t[0], v->t[v->n - 1], v->n_runs > 1 ? ", runs one after the other" : "");
}

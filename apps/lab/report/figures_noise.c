/* The figures of what the residual depends on: pressure, position, velocity and command, and its own past. */
#include <math.h>

#include "figures_private.h"

enum { BINS = 30, BIN_LEAST = 10, ARGUMENT_HEIGHT = 105, CORRELATION_HEIGHT = 165 };

/* ---- Arguments ---- */

/* An argument that varies, the range of its axis in SI, and the column of its bins. */
typedef struct axis {
  int argument, x;
  double from, to;
  lab_format shown;
} axis;

/* Returns: the number of arguments that vary. */
static int choose_axes(const drawing *d, axis *over)
{
  const lab_residual_table *v = d->table;
  double low, high, at[BINS];
  int i, b, n = 0;
  for (i = 0; i < LAB_ARGUMENT_COUNT; i++) {
    axis *mine = &over[n];
    if (!lab_range(v->argument[i], v->n, &low, &high) || !(high > low))
      continue;
    *mine = (axis){i, 0, low - 0.05 * (high - low), high + 0.05 * (high - low),
                   lab_format_as(lab_argument_unit(d->report, i))};
    for (b = 0; b < BINS; b++)
      at[b] = mine->from + (mine->to - mine->from) * (b + 0.5) / BINS;
    mine->x = lab_figures_add_column(d->all, at, NULL, BINS, mine->shown.scale, -1);
    n++;
  }
  return n;
}

/* Means in bins that are full enough, and where those of white noise would be.  Returns: the largest of both */
static double put_bins(const drawing *d, const axis *over, const lab_residual_channel *mine, int stage)
{
  const lab_residual_table *v = d->table;
  char name[2 * LAB_FORMAT_TEXT];
  lab_panel *panel = lab_figure_panel(d, lab_figure_stage_name(mine->channel, stage, name), "× noise", ARGUMENT_HEIGHT);
  double mean[BINS], band[BINS], largest = 0;
  lab_bin bin[BINS];
  int b;
  lab_bin_means(v->argument[over->argument], mine->residual[stage], v->n, over->from, over->to, BINS, bin);
  for (b = 0; b < BINS; b++) {
    const int full = bin[b].n >= BIN_LEAST;
    mean[b] = full ? bin[b].mean : (double)NAN;
    band[b] = full ? lab_figure_two_sided_99 / sqrt((double)bin[b].n) : (double)NAN;
    largest = full ? fmax(largest, fmax(fabs(mean[b]), band[b])) : largest;
  }
  panel->x_name = lab_argument_key(over->argument);
  panel->x_unit = over->shown.unit;
  panel->x = over->x;
  lab_panel_curve(panel, LAB_KEY_BAND, LAB_FORM_BAND, lab_figures_add_column(d->all, band, NULL, BINS, 1, -1));
  lab_panel_curve(panel, lab_figure_key(stage), LAB_FORM_POINTS,
                  lab_figures_add_column(d->all, mean, NULL, BINS, 1, -1));
  return largest;
}

/* Panels of one channel and model, with one scale. */
static void put_row(const drawing *d, const axis *over, const lab_residual_channel *mine, int stage)
{
  lab_panel *row = &d->figure->panel[d->figure->n];
  double largest = 0;
  int i;
  for (i = 0; i < d->figure->across; i++)
    largest = fmax(largest, put_bins(d, &over[i], mine, stage));
  for (i = 0; i < d->figure->across; i++)
    row[i].reach = 1.1 * largest;
  lab_figure_tell(d, " %s: means up to %.3g.", row->name, largest);
}

int lab_figure_arguments(const drawing *d)
{
  const lab_residual_table *v = d->table;
  axis over[LAB_ARGUMENT_COUNT];
  int c, stage;
  if (v->n < BINS * BIN_LEAST / 2 || (d->figure->across = choose_axes(d, over)) == 0) /* hardly a bin would be full */
    return 0;
  lab_figure_entitle(
      d, "Where the residual sits",
      "Its mean in bins, in units of the noise; the band is where 99 % of such means of white noise lie");
  lab_figure_tell(d, "Mean of the residual in bins, in units of the noise.");
  for (c = 0; c < v->n_channels; c++)
    for (stage = 0; stage < lab_figure_stages(d); stage++)
      put_row(d, over, &v->channel[c], stage);
  return 1;
}

/* ---- Autocorrelation ---- */

static const lab_whiteness *whiteness(const drawing *d, int stage, const lab_residual_channel *mine)
{
  return &d->report->result->left[stage][mine->channel].whiteness;
}

static int column_of(const drawing *d, const double *correlation, const lab_whiteness *white, double scale)
{
  return lab_figures_add_column(d->all, correlation + 1, NULL, (size_t)white->lags, scale, 4);
}

static void put_correlation(const drawing *d, const lab_residual_channel *mine)
{
  const lab_whiteness *before = whiteness(d, LAB_STAGE_BEFORE, mine), *after = whiteness(d, LAB_STAGE_AFTER, mine);
  char name[LAB_FORMAT_TEXT], p[LAB_FORMAT_TEXT], title[2 * LAB_FORMAT_TEXT];
  double lag[LAB_WHITENESS_LAGS + 1];
  lab_panel *panel;
  int k;
  lab_figure_channel_name(mine->channel, name);
  snprintf(title, sizeof title, "%s: p-value %s", name, lab_format_p(after->p_value, p));
  panel = lab_figure_panel(d, title, "", CORRELATION_HEIGHT);
  for (k = 0; k <= after->lags; k++)
    lag[k] = k;
  panel->x_name = "lag";
  panel->x_unit = "rows";
  panel->x = lab_figures_add_column(d->all, lag + 1, NULL, (size_t)after->lags, 1, 0);
  lab_panel_curve(panel, LAB_KEY_BAND, LAB_FORM_BAND, column_of(d, after->deviation, after, lab_figure_two_sided_99));
  if (lab_figure_has_completed(d))
    lab_panel_curve(panel, LAB_KEY_AFTER, LAB_FORM_BARS, column_of(d, after->correlation, after, 1));
  lab_panel_curve(panel, LAB_KEY_BEFORE, LAB_FORM_POINTS, column_of(d, before->correlation, after, 1));
  lab_figure_tell(d, " %s: lag 1 %.3f", name, before->correlation[1]);
  if (lab_figure_has_completed(d))
    lab_figure_tell(d, ", completed model %.3f", after->correlation[1]);
  lab_figure_tell(d, "; p-value of whiteness %s.", p);
}

int lab_figure_autocorrelation(const drawing *d)
{
  const lab_residual_table *v = d->table;
  int c;
  lab_figure_entitle(d, "Does the residual remember?",
                     "Autocorrelation of the residual; white noise stays within the band, and its p-value above 0.01");
  lab_figure_tell(d, "Autocorrelation of the residual over lags in rows.");
  for (c = 0; c < v->n_channels; c++)
    if (whiteness(d, LAB_STAGE_BEFORE, &v->channel[c])->lags > 0 &&
        whiteness(d, LAB_STAGE_AFTER, &v->channel[c])->lags > 0)
      put_correlation(d, &v->channel[c]);
  d->figure->across = d->figure->n;
  return d->figure->n;
}

/* The figure of the residual's autocorrelation. */
#include <math.h>

#include "figures_private.h"

static const char *const script[] = {
#include "apps/lab/report/page/autocorrelation.gp.inc"
    NULL};

/* Widen low..high to hold a value. */
static void hold(double value, double *low, double *high)
{
  *low = fmin(*low, value);
  *high = fmax(*high, value);
}

static void put_correlation(const drawing *d, const lab_evidence_channel *mine, int number, double *low, double *high)
{
  const lab_whiteness *before = &mine->whiteness[LAB_STAGE_BEFORE], *after = &mine->whiteness[LAB_STAGE_AFTER];
  int k;
  char name[LAB_SHOWN_TEXT], p[LAB_SHOWN_TEXT];
  fprintf(d->file, "LABEL[%d] = \"%s: p-value %s\"\nLAGS[%d] = %d\n", number, figure_quantity_name(mine->channel, name),
          lab_shown_p(after->p_value, p), number, after->lags);
  fprintf(d->file, "$correlation_%d << EOD\nlag,before,after,band\n", number);
  for (k = 1; k <= after->lags; k++) {
    const double band = figure_two_sided_99 * after->deviation[k];
    fprintf(d->file, "%d,%.4g,%.4g,%.4g\n", k, before->correlation[k], after->correlation[k], band);
    hold(2 * band, low, high);
    hold(-2 * band, low, high);
    hold(1.05 * before->correlation[k], low, high);
    hold(1.05 * after->correlation[k], low, high);
  }
  fputs("EOD\n", d->file);
  figure_tell(d, " %s: lag 1 %.3f", name, before->correlation[1]);
  if (figure_has_completed(d))
    figure_tell(d, ", completed model %.3f", after->correlation[1]);
  figure_tell(d, "; p-value of whiteness %s.", p);
}

/* Correlations as columns. */
static void read_correlation(const drawing *d, const lab_evidence_channel *mine, int number, int n, const double y[2])
{
  const lab_whiteness *before = &mine->whiteness[LAB_STAGE_BEFORE], *after = &mine->whiteness[LAB_STAGE_AFTER];
  const size_t lags = (size_t)after->lags;
  double lag[LAB_WHITENESS_LAGS + 1], band[LAB_WHITENESS_LAGS + 1];
  char name[LAB_SHOWN_TEXT];
  lab_panel panel = {"lag", "lag", "rows", NULL, "", 0, 0, 0, 0, {0, (double)after->lags + 1}, {y[0], y[1]}};
  cJSON *reading;
  size_t k;
  panel.name = figure_quantity_name(mine->channel, name);
  figure_put_box(d, number, &panel, 165, 165);
  figure_put_sides(d, number, &panel, figure_side(number - 1, n),
                   figure_side(number - 1, n) + 0.94 * (figure_side(1, n) - figure_side(0, n)));
  for (k = 1; k <= lags; k++) {
    lag[k] = (double)k;
    band[k] = figure_two_sided_99 * after->deviation[k];
  }
  reading = lab_readings_panel(d->readings, d->figure->name, &panel,
                               lab_readings_column(d->readings, lag + 1, NULL, lags, 1, 0));
  lab_readings_curve(reading, "before", lab_readings_column(d->readings, before->correlation + 1, NULL, lags, 1, 4));
  if (figure_has_completed(d))
    lab_readings_curve(reading, "after", lab_readings_column(d->readings, after->correlation + 1, NULL, lags, 1, 4));
  lab_readings_curve(reading, "band", lab_readings_column(d->readings, band + 1, NULL, lags, 1, 4));
}

static int has_lags(const lab_evidence_channel *mine)
{
  return mine->whiteness[LAB_STAGE_BEFORE].lags > 0 && mine->whiteness[LAB_STAGE_AFTER].lags > 0;
}

int figure_draw_autocorrelation(const drawing *d)
{
  const lab_evidence *v = d->evidence;
  double y[2] = {0, 0};
  int c, n = 0, number = 0;
  for (c = 0; c < v->n_channels; c++)
    n += has_lags(&v->channel[c]);
  if (n == 0)
    return 0;
  figure_entitle(d, "Does the residual remember?");
  figure_put_head(d, 405, 130,
                  "Autocorrelation of the residual; white noise stays within the band, and its p-value above 0.01");
  fprintf(d->file,
          "N = %d\narray LABEL[N]\narray LAGS[N]\narray TOP[N]\narray BOTTOM[N]\narray LEFT[N]\narray RIGHT[N]\n", n);
  figure_tell(d, "Autocorrelation of the residual over lags in rows.");
  for (c = 0; c < v->n_channels; c++)
    if (has_lags(&v->channel[c]))
      put_correlation(d, &v->channel[c], ++number, &y[0], &y[1]);
  for (c = number = 0; c < v->n_channels; c++)
    if (has_lags(&v->channel[c]))
      read_correlation(d, &v->channel[c], ++number, n, y);
  fprintf(d->file, "LOWEST = %.4g\nHIGHEST = %.4g\n", y[0], y[1]);
  figure_put_lines(d->file, script);
  return 1;
}

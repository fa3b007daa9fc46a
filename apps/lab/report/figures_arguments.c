/* The figure of the residual over pressure, position, velocity and command. */
#include <math.h>

#include "figures_private.h"

static const char *const script[] = {
#include "apps/lab/report/page/arguments.gp.inc"
    NULL};

enum { BINS = 30, BIN_LEAST = 10 };

/* An argument that varies, and the range of its axis in SI. */
typedef struct axis {
  int argument;
  double from, to;
  lab_shown shown;
} axis;

/* Returns: the number of arguments that vary. */
static int choose_axes(const drawing *d, axis *over)
{
  int i, n = 0;
  for (i = 0; i < LAB_ARGUMENT_COUNT; i++) {
    double low, high;
    if (!lab_range(d->evidence->argument[i], d->evidence->n, &low, &high) || !(high > low))
      continue;
    over[n++] =
        (axis){i, low - 0.05 * (high - low), high + 0.05 * (high - low), lab_shown_as(lab_argument_unit(d->story, i))};
  }
  return n;
}

static double band_of(const lab_bin *bin)
{
  return figure_two_sided_99 / sqrt((double)bin->n);
}

/* Bins of a panel as a block.  Returns: the largest size that is to be seen in it */
static double put_bins(const drawing *d, int row, int column, const lab_bin *bin, double scale)
{
  double largest = 0;
  int b;
  fprintf(d->file, "$bins_%d_%d << EOD\nat,mean,band\n", row, column);
  for (b = 0; b < BINS; b++) {
    if (bin[b].n < BIN_LEAST) {
      fputc('\n', d->file);
      continue;
    }
    fprintf(d->file, "%.5g,%.4g,%.4g\n", scale * bin[b].at, bin[b].mean, band_of(&bin[b]));
    largest = fmax(largest, fmax(fabs(bin[b].mean), band_of(&bin[b])));
  }
  fputs("EOD\n", d->file);
  return largest;
}

/* Bins that are full enough to be drawn, as columns. */
static void read_bins(const drawing *d, const lab_panel *panel, const lab_bin *bin, double scale, const char *key)
{
  double at[BINS], mean[BINS], band[BINS];
  size_t n = 0;
  int b;
  cJSON *reading;
  for (b = 0; b < BINS; b++)
    if (bin[b].n >= BIN_LEAST) {
      at[n] = bin[b].at;
      mean[n] = bin[b].mean;
      band[n++] = band_of(&bin[b]);
    }
  b = lab_readings_decimals(panel->y[0], panel->y[1]);
  reading = lab_readings_panel(
      d->readings, d->figure->name, panel,
      lab_readings_column(d->readings, at, NULL, n, scale, lab_readings_decimals(panel->x[0], panel->x[1])));
  lab_readings_curve(reading, key, lab_readings_column(d->readings, mean, NULL, n, 1, b));
  lab_readings_curve(reading, "band", lab_readings_column(d->readings, band, NULL, n, 1, b));
}

/* Panels of one channel and model. */
static void put_row(const drawing *d, const axis *over, int n, const lab_evidence_channel *mine, int stage, int row)
{
  double largest = 0;
  char name[LAB_SHOWN_TEXT], title[2 * LAB_SHOWN_TEXT];
  lab_bin bin[LAB_ARGUMENT_COUNT][BINS];
  lab_panel panel = {0};
  int i;
  snprintf(title, sizeof title, "%s, %s model", figure_channel_name(mine->channel, name), figure_stage_name(stage));
  for (i = 0; i < n; i++) {
    lab_bin_means(d->evidence->argument[over[i].argument], mine->residual[stage], d->evidence->n, over[i].from,
                  over[i].to, BINS, bin[i]);
    largest = fmax(largest, put_bins(d, row, i + 1, bin[i], over[i].shown.scale));
  }
  panel.name = title;
  panel.unit = "× noise";
  panel.y[1] = 1.1 * largest;
  panel.y[0] = -panel.y[1];
  fprintf(d->file, "ROW_LABEL[%d] = \"%s\"\nLIMIT[%d] = %.4g\nIS_AFTER[%d] = %d\n", row, title, row, panel.y[1], row,
          stage);
  figure_put_box(d, row, &panel, FIGURE_PANEL_TOP + FIGURE_PANEL_PITCH * (row - 1), FIGURE_PANEL_HEIGHT);
  for (i = 0; i < n; i++) {
    panel.group = panel.x_name = lab_argument_key(over[i].argument);
    panel.x_unit = over[i].shown.unit;
    panel.x[0] = over[i].shown.scale * over[i].from;
    panel.x[1] = over[i].shown.scale * over[i].to;
    figure_put_sides(d, i + 1, &panel, figure_side(i, n),
                     figure_side(i, n) + 0.88 * (figure_side(1, n) - figure_side(0, n)));
    read_bins(d, &panel, bin[i], over[i].shown.scale, stage ? "after" : "before");
  }
  figure_tell(d, " %s: means up to %.3g.", title, largest);
}

int figure_draw_arguments(const drawing *d)
{
  const lab_evidence *v = d->evidence;
  const int rows = v->n_channels * figure_stages(d);
  axis over[LAB_ARGUMENT_COUNT];
  const int n = choose_axes(d, over);
  int i;
  if (n == 0 || v->n < BINS * BIN_LEAST / 2) /* hardly a bin would be full */
    return 0;
  figure_entitle(d, "Where the residual sits");
  figure_tell(d, "Mean of the residual in bins, in units of the noise.");
  figure_put_head(d, 135 + FIGURE_PANEL_PITCH * rows, 70,
                  "Its mean in bins, in units of the noise; the band is where 99 % of such means of white noise lie");
  fprintf(d->file, "ROWS = %d\nCOLUMNS = %d\narray ROW_LABEL[ROWS]\narray LIMIT[ROWS]\narray IS_AFTER[ROWS]\n", rows,
          n);
  fputs("array TOP[ROWS]\narray BOTTOM[ROWS]\narray LEFT[COLUMNS]\narray RIGHT[COLUMNS]\n", d->file);
  fputs("array COLUMN_LABEL[COLUMNS]\narray FROM[COLUMNS]\narray TO[COLUMNS]\n", d->file);
  for (i = 0; i < n; i++)
    fprintf(d->file, "COLUMN_LABEL[%d] = \"%s [%s]\"\nFROM[%d] = %.5g\nTO[%d] = %.5g\n", i + 1,
            lab_argument_key(over[i].argument), figure_unit_or_1(over[i].shown.unit), i + 1,
            over[i].shown.scale * over[i].from, i + 1, over[i].shown.scale * over[i].to);
  for (i = 0; i < rows; i++)
    put_row(d, over, n, &v->channel[i / figure_stages(d)], i % figure_stages(d), i + 1);
  figure_put_lines(d->file, script);
  return 1;
}

#include "figures.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "../base/gnuplot.h"
#include "../base/outfile.h"
#include "../base/quantile.h"
#include "readings.h"
#include "reduce.h"
#include "../rig/rigterm.h"
#include "../base/shown.h"
#include "../trace/unlisted.h"

enum { WIDTH = 820, COLUMNS = 360, BINS = 30, BIN_LEAST = 10, CANDIDATES = 14 };
static const double left_edge = 0.085, right_edge = 0.975; /* of a panel over time, of the width */
static const double two_sided_99 = 2.5758293035489004;     /* standard deviations */

/* The scripts, a line a string; made by make from apps/lab/report/ and study/figures/style.gp. */
static const char *const style_gp[] = {
#include "study/figures/style.gp.inc"
    NULL};
static const char *const panels_gp[] = {
#include "apps/lab/report/page/panels.gp.inc"
    NULL};
static const char *const response_gp[] = {
#include "apps/lab/report/page/response.gp.inc"
    NULL};
static const char *const residual_gp[] = {
#include "apps/lab/report/page/residual.gp.inc"
    NULL};
static const char *const arguments_gp[] = {
#include "apps/lab/report/page/arguments.gp.inc"
    NULL};
static const char *const autocorrelation_gp[] = {
#include "apps/lab/report/page/autocorrelation.gp.inc"
    NULL};
static const char *const candidates_gp[] = {
#include "apps/lab/report/page/candidates.gp.inc"
    NULL};
static const char *const unlisted_gp[] = {
#include "apps/lab/report/page/unlisted.gp.inc"
    NULL};
static const char *const parameters_gp[] = {
#include "apps/lab/report/page/parameters.gp.inc"
    NULL};

/* What a figure is made from and where it goes. */
typedef struct drawing {
  const lab_story *story;
  const lab_evidence *evidence;
  FILE *file; /* the script */
  lab_figure *figure;
  lab_point *point;    /* room for the envelope of a series */
  cJSON *readings;     /* what can be read off by pointing */
  unsigned char *kept; /* for each row, whether its values can */
  double *clock;       /* time of each row in its log */
  int t;               /* column of the readings: time */
} drawing;

/* ---- Text ---- */

/* Only what gnuplot's enhanced text takes as it stands: "chamber_leak" is "chamber leak". */
static const char *plain(const char *name, char text[LAB_SHOWN_TEXT])
{
  size_t i;
  for (i = 0; name[i] && i + 1 < LAB_SHOWN_TEXT; i++)
    text[i] = (char)(isalnum((unsigned char)name[i]) ? name[i] : ' ');
  text[i] = '\0';
  return text;
}

/* "Pressure" */
static const char *quantity_name(int channel, char text[LAB_SHOWN_TEXT])
{
  plain(lab_channels[channel].quantity, text);
  text[0] = (char)toupper((unsigned char)text[0]);
  return text;
}

/* "Pressure p" */
static const char *channel_name(int channel, char text[LAB_SHOWN_TEXT])
{
  quantity_name(channel, text);
  strncat(text, " ", LAB_SHOWN_TEXT - strlen(text) - 1);
  strncat(text, lab_channels[channel].key, LAB_SHOWN_TEXT - strlen(text) - 1);
  return text;
}

static const char *unit_or_1(const char *unit)
{
  return *unit ? unit : "1";
}

static int has_completed(const drawing *d)
{
  return d->story->result->n_found > 0;
}

/* Append to the words for those who cannot see the figure. */
static void tell(const drawing *d, const char *format, ...) LAB_PRINTF(2, 3);
static void tell(const drawing *d, const char *format, ...)
{
  const size_t used = strlen(d->figure->alt);
  va_list list;
  va_start(list, format);
  vsnprintf(d->figure->alt + used, LAB_FIGURE_ALT - used, format, list);
  va_end(list);
}

static void entitle(const drawing *d, const char *title)
{
  snprintf(d->figure->title, LAB_FIGURE_TEXT, "%s", title);
}

/* Both models, or the declared one alone where nothing was added. */
static int stages_of(const drawing *d)
{
  return has_completed(d) ? LAB_STAGE_COUNT : 1;
}

static const char *stage_name(int stage)
{
  return stage == LAB_STAGE_BEFORE ? "declared" : "completed";
}

/* ---- Pieces of a script ---- */

static void put_lines(FILE *file, const char *const *line)
{
  for (; *line; line++)
    fputs(*line, file);
}

/* What style.gp wants, then the style.
 * In:      head  height of title, subtitle and key, which a page has in words of its own */
static void put_head(const drawing *d, int height, int head, const char *subtitle)
{
  snprintf(d->figure->subtitle, LAB_FIGURE_TEXT, "%s", subtitle);
  d->figure->head = head;
  fprintf(d->file, "reset\nNAME = \"%s\"\nHEIGHT = %d\nTITLE = \"%s\"\nSUBTITLE = \"%s\"\n", d->figure->name, height,
          d->figure->title, subtitle);
  put_lines(d->file, style_gp);
  put_lines(d->file, panels_gp);
  fprintf(d->file, "FOUND = %d\n", has_completed(d));
}

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
  return lab_envelope(v->t, value, v->n, v->first, v->n_runs, v->t[0], v->t[v->n - 1], COLUMNS, d->point);
}

/* A series over time as a block of its envelope. */
static void put_series(const drawing *d, const char *block, int number, const double *value, double scale)
{
  put_points(d->file, block, number, d->point, reduce(d, value), scale);
}

/* The place of a panel, in units of the drawing; also for the script. */
static void put_box(const drawing *d, int number, lab_panel *panel, double top, double height)
{
  panel->top = top;
  panel->bottom = top + height;
  fprintf(d->file, "TOP[%d] = %g\nBOTTOM[%d] = %g\n", number, panel->top, number, panel->bottom);
}

/* The place across, as shares of the width. */
static void put_sides(const drawing *d, int number, lab_panel *panel, double left, double right)
{
  panel->left = WIDTH * left;
  panel->right = WIDTH * right;
  fprintf(d->file, "LEFT[%d] = %g\nRIGHT[%d] = %g\n", number, left, number, right);
}

/* ---- What can be read off ---- */

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

/* Rows that a curve over time goes through: so the peaks are among them. */
static void keep_rows(drawing *d)
{
  const lab_evidence *v = d->evidence;
  int c, stage;
  keep_rows_of(d, v->argument[LAB_ARGUMENT_U]);
  for (c = 0; c < v->n_channels; c++) {
    keep_rows_of(d, v->channel[c].measured);
    for (stage = 0; stage < stages_of(d); stage++) {
      keep_rows_of(d, v->channel[c].predicted[stage]);
      keep_rows_of(d, v->channel[c].residual[stage]);
    }
  }
  read_time(d);
}

/* A panel over time, but for its place and what it shows. */
static lab_panel time_panel(const drawing *d)
{
  const lab_evidence *v = d->evidence;
  lab_panel panel = {"t", "t", "s", NULL, NULL, WIDTH * left_edge, 0, WIDTH * right_edge, 0, {0, 0}, {0, 0}};
  panel.x[0] = v->t[0];
  panel.x[1] = v->t[v->n - 1];
  return panel;
}

static void read_series(const drawing *d, cJSON *panel, const char *key, const double *value, double scale,
                        int decimals)
{
  lab_readings_curve(panel, key, lab_readings_column(d->readings, value, d->kept, d->evidence->n, scale, decimals));
}

static void put_time_axis(const drawing *d)
{
  const lab_evidence *v = d->evidence;
  fprintf(d->file, "LEFT = %g\nRIGHT = %g\nT_FROM = %.6g\nT_TO = %.6g\nT_LABEL = \"Time t [s]%s\"\n", left_edge,
          right_edge, v->t[0], v->t[v->n - 1], v->n_runs > 1 ? ", runs one after the other" : "");
}

/* ---- Measured and predicted over time ---- */

enum { COMMAND_TOP = 160, COMMAND_HEIGHT = 55, CHANNEL_TOP = 255, CHANNEL_PITCH = 225, CHANNEL_HEIGHT = 180 };

/* Name, ends of the y axis and place of a panel. */
static void put_panel(const drawing *d, int number, lab_panel *panel, double top, double height)
{
  fprintf(d->file, "LABEL[%d] = \"%s [%s]\"\nLOW[%d] = %.5g\nHIGH[%d] = %.5g\n", number, panel->name,
          unit_or_1(panel->unit), number, panel->y[0], number, panel->y[1]);
  put_box(d, number, panel, top, height);
}

static void put_command(const drawing *d)
{
  const double *u = d->evidence->argument[LAB_ARGUMENT_U];
  const lab_shown shown = lab_shown_as(lab_argument_unit(d->story, LAB_ARGUMENT_U));
  lab_panel panel = time_panel(d);
  double low = 0, high = 0, space;
  lab_range(u, d->evidence->n, &low, &high);
  space = high > low ? 0.15 * (high - low) : 1;
  panel.name = "Command u";
  panel.unit = shown.unit;
  panel.y[0] = shown.scale * (low - space);
  panel.y[1] = shown.scale * (high + space);
  put_panel(d, 1, &panel, COMMAND_TOP, COMMAND_HEIGHT);
  put_series(d, "command", 0, u, shown.scale);
  read_series(d, lab_readings_panel(d->readings, d->figure->name, &panel, d->t), "command", u, shown.scale,
              lab_readings_decimals(panel.y[0], panel.y[1]));
}

/* Range of what is measured and predicted. */
static void range_of(const drawing *d, const lab_evidence_channel *mine, double *low, double *high)
{
  int stage;
  if (!lab_range(mine->measured, d->evidence->n, low, high))
    *low = *high = 0;
  for (stage = 0; stage < stages_of(d); stage++) {
    double from, to;
    if (lab_range(mine->predicted[stage], d->evidence->n, &from, &to)) {
      *low = fmin(*low, from);
      *high = fmax(*high, to);
    }
  }
}

static void tell_channel(const drawing *d, const lab_evidence_channel *mine, const char *name)
{
  const lab_channel_info *info = &lab_channels[mine->channel];
  const lab_loop_result *result = d->story->result;
  double low, high;
  char from[LAB_SHOWN_TEXT], to[LAB_SHOWN_TEXT];
  if (lab_range(mine->measured, d->evidence->n, &low, &high))
    tell(d, " %s runs from %s to %s; rms error of the declared model %s", name,
         lab_shown_number(lab_shown_as(info->unit).scale * low, 3, from), lab_shown_quantity(high, info->unit, 3, to),
         lab_shown_quantity(result->before.rmse[mine->channel], info->unit, 3, from));
  if (has_completed(d))
    tell(d, ", of the completed one %s", lab_shown_quantity(result->after.rmse[mine->channel], info->unit, 3, to));
  tell(d, ".");
}

static void put_channel(const drawing *d, int number, const lab_evidence_channel *mine)
{
  static const char *const key[LAB_STAGE_COUNT] = {"before", "after"};
  const lab_shown shown = lab_shown_as(lab_channels[mine->channel].unit);
  lab_panel panel = time_panel(d);
  double low, high, space;
  char name[LAB_SHOWN_TEXT];
  cJSON *reading;
  int stage, decimals;
  range_of(d, mine, &low, &high);
  space = high > low ? 0.04 * (high - low) : fmax(0.1 * fabs(high), 1e-9);
  panel.name = channel_name(mine->channel, name);
  panel.unit = shown.unit;
  panel.y[0] = shown.scale * (low - space);
  panel.y[1] = shown.scale * (high + space);
  put_panel(d, number + 1, &panel, CHANNEL_TOP + CHANNEL_PITCH * (number - 1), CHANNEL_HEIGHT);
  tell_channel(d, mine, name);
  decimals = lab_readings_decimals(panel.y[0], panel.y[1]);
  reading = lab_readings_panel(d->readings, d->figure->name, &panel, d->t);
  put_series(d, "measured", number, mine->measured, shown.scale);
  read_series(d, reading, "measured", mine->measured, shown.scale, decimals);
  for (stage = 0; stage < stages_of(d); stage++) {
    put_series(d, key[stage], number, mine->predicted[stage], shown.scale);
    read_series(d, reading, key[stage], mine->predicted[stage], shown.scale, decimals);
  }
}

static int draw_response(const drawing *d)
{
  const lab_evidence *v = d->evidence;
  const int n = v->n_channels;
  int c;
  entitle(d, has_completed(d) ? "Measured, and what both models predict for the same command"
                              : "Measured, and what the model predicts for the same command");
  tell(d, "Command, measured and predicted channels over %.4g s.", v->t[v->n - 1] - v->t[0]);
  put_head(d, 280 + CHANNEL_PITCH * n, 126,
           "Each line spans all values that fall on its pixels, so that no peak is lost");
  put_time_axis(d);
  fprintf(d->file, "N = %d\narray LABEL[N+1]\narray TOP[N+1]\narray BOTTOM[N+1]\narray LOW[N+1]\narray HIGH[N+1]\n", n);
  put_command(d);
  for (c = 0; c < n; c++)
    put_channel(d, c + 1, &v->channel[c]);
  put_lines(d->file, response_gp);
  return 1;
}

/* ---- Residual over time ---- */

static double largest_of(const double *value, size_t n)
{
  double low, high;
  return lab_range(value, n, &low, &high) ? fmax(high, -low) : 0;
}

enum { PANEL_TOP = 105, PANEL_PITCH = 150, PANEL_HEIGHT = 105 };

static void put_residual(const drawing *d, const lab_evidence_channel *mine, int stage, int number)
{
  const double largest = largest_of(mine->residual[stage], d->evidence->n);
  lab_panel panel = time_panel(d);
  char name[LAB_SHOWN_TEXT], noise[LAB_SHOWN_TEXT], title[2 * LAB_SHOWN_TEXT];
  snprintf(title, sizeof title, "%s, %s model", channel_name(mine->channel, name), stage_name(stage));
  panel.name = title;
  panel.unit = "× noise";
  panel.y[1] = fmax(4, 1.05 * largest);
  panel.y[0] = -panel.y[1];
  fprintf(d->file, "LABEL[%d] = \"%s (1 is %s)\"\nLIMIT[%d] = %.4g\nIS_AFTER[%d] = %d\n", number, title,
          lab_shown_quantity(mine->sigma, lab_channels[mine->channel].unit, 3, noise), number, panel.y[1], number,
          stage);
  put_box(d, number, &panel, PANEL_TOP + PANEL_PITCH * (number - 1), PANEL_HEIGHT);
  put_series(d, "residual", number, mine->residual[stage], 1);
  read_series(d, lab_readings_panel(d->readings, d->figure->name, &panel, d->t), stage ? "after" : "before",
              mine->residual[stage], 1, 2);
  tell(d, " %s: largest %.3g.", title, largest);
}

static int draw_residual(const drawing *d)
{
  const lab_evidence *v = d->evidence;
  const int panels = v->n_channels * stages_of(d);
  int i;
  entitle(d, has_completed(d) ? "What the models do not explain" : "What the model does not explain");
  tell(d, "Residual over time in units of the noise.");
  put_head(d, 135 + PANEL_PITCH * panels, 70,
           "Measured less predicted, in units of the noise; 99 % of white noise lies in the band");
  put_time_axis(d);
  fprintf(d->file, "N = %d\narray LABEL[N]\narray LIMIT[N]\narray IS_AFTER[N]\narray TOP[N]\narray BOTTOM[N]\n",
          panels);
  for (i = 0; i < panels; i++)
    put_residual(d, &v->channel[i / stages_of(d)], i % stages_of(d), i + 1);
  put_lines(d->file, residual_gp);
  return 1;
}

/* ---- Residual over p, x, v, u ---- */

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

/* Left side of the i-th of n panels side by side. */
static double side_of(int i, int n)
{
  static const double left = 0.075, right = 0.985;
  return left + (right - left) / n * i;
}

static double band_of(const lab_bin *bin)
{
  return two_sided_99 / sqrt((double)bin->n);
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
  snprintf(title, sizeof title, "%s, %s model", channel_name(mine->channel, name), stage_name(stage));
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
  put_box(d, row, &panel, PANEL_TOP + PANEL_PITCH * (row - 1), PANEL_HEIGHT);
  for (i = 0; i < n; i++) {
    panel.group = panel.x_name = lab_argument_key(over[i].argument);
    panel.x_unit = over[i].shown.unit;
    panel.x[0] = over[i].shown.scale * over[i].from;
    panel.x[1] = over[i].shown.scale * over[i].to;
    put_sides(d, i + 1, &panel, side_of(i, n), side_of(i, n) + 0.88 * (side_of(1, n) - side_of(0, n)));
    read_bins(d, &panel, bin[i], over[i].shown.scale, stage ? "after" : "before");
  }
  tell(d, " %s: means up to %.3g.", title, largest);
}

static int draw_arguments(const drawing *d)
{
  const lab_evidence *v = d->evidence;
  const int rows = v->n_channels * stages_of(d);
  axis over[LAB_ARGUMENT_COUNT];
  const int n = choose_axes(d, over);
  int i;
  if (n == 0 || v->n < BINS * BIN_LEAST / 2) /* hardly a bin would be full */
    return 0;
  entitle(d, "Where the residual sits");
  tell(d, "Mean of the residual in bins, in units of the noise.");
  put_head(d, 135 + PANEL_PITCH * rows, 70,
           "Its mean in bins, in units of the noise; the band is where 99 % of such means of white noise lie");
  fprintf(d->file, "ROWS = %d\nCOLUMNS = %d\narray ROW_LABEL[ROWS]\narray LIMIT[ROWS]\narray IS_AFTER[ROWS]\n", rows,
          n);
  fputs("array TOP[ROWS]\narray BOTTOM[ROWS]\narray LEFT[COLUMNS]\narray RIGHT[COLUMNS]\n", d->file);
  fputs("array COLUMN_LABEL[COLUMNS]\narray FROM[COLUMNS]\narray TO[COLUMNS]\n", d->file);
  for (i = 0; i < n; i++)
    fprintf(d->file, "COLUMN_LABEL[%d] = \"%s [%s]\"\nFROM[%d] = %.5g\nTO[%d] = %.5g\n", i + 1,
            lab_argument_key(over[i].argument), unit_or_1(over[i].shown.unit), i + 1,
            over[i].shown.scale * over[i].from, i + 1, over[i].shown.scale * over[i].to);
  for (i = 0; i < rows; i++)
    put_row(d, over, n, &v->channel[i / stages_of(d)], i % stages_of(d), i + 1);
  put_lines(d->file, arguments_gp);
  return 1;
}

/* ---- Autocorrelation ---- */

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
  fprintf(d->file, "LABEL[%d] = \"%s: p-value %s\"\nLAGS[%d] = %d\n", number, quantity_name(mine->channel, name),
          lab_shown_p(after->p_value, p), number, after->lags);
  fprintf(d->file, "$correlation_%d << EOD\nlag,before,after,band\n", number);
  for (k = 1; k <= after->lags; k++) {
    const double band = two_sided_99 * after->deviation[k];
    fprintf(d->file, "%d,%.4g,%.4g,%.4g\n", k, before->correlation[k], after->correlation[k], band);
    hold(2 * band, low, high);
    hold(-2 * band, low, high);
    hold(1.05 * before->correlation[k], low, high);
    hold(1.05 * after->correlation[k], low, high);
  }
  fputs("EOD\n", d->file);
  tell(d, " %s: lag 1 %.3f", name, before->correlation[1]);
  if (has_completed(d))
    tell(d, ", completed model %.3f", after->correlation[1]);
  tell(d, "; p-value of whiteness %s.", p);
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
  panel.name = quantity_name(mine->channel, name);
  put_box(d, number, &panel, 165, 165);
  put_sides(d, number, &panel, side_of(number - 1, n), side_of(number - 1, n) + 0.94 * (side_of(1, n) - side_of(0, n)));
  for (k = 1; k <= lags; k++) {
    lag[k] = (double)k;
    band[k] = two_sided_99 * after->deviation[k];
  }
  reading = lab_readings_panel(d->readings, d->figure->name, &panel,
                               lab_readings_column(d->readings, lag + 1, NULL, lags, 1, 0));
  lab_readings_curve(reading, "before", lab_readings_column(d->readings, before->correlation + 1, NULL, lags, 1, 4));
  if (has_completed(d))
    lab_readings_curve(reading, "after", lab_readings_column(d->readings, after->correlation + 1, NULL, lags, 1, 4));
  lab_readings_curve(reading, "band", lab_readings_column(d->readings, band + 1, NULL, lags, 1, 4));
}

static int has_lags(const lab_evidence_channel *mine)
{
  return mine->whiteness[LAB_STAGE_BEFORE].lags > 0 && mine->whiteness[LAB_STAGE_AFTER].lags > 0;
}

static int draw_autocorrelation(const drawing *d)
{
  const lab_evidence *v = d->evidence;
  double y[2] = {0, 0};
  int c, n = 0, number = 0;
  for (c = 0; c < v->n_channels; c++)
    n += has_lags(&v->channel[c]);
  if (n == 0)
    return 0;
  entitle(d, "Does the residual remember?");
  put_head(d, 405, 130,
           "Autocorrelation of the residual; white noise stays within the band, and its p-value above 0.01");
  fprintf(d->file,
          "N = %d\narray LABEL[N]\narray LAGS[N]\narray TOP[N]\narray BOTTOM[N]\narray LEFT[N]\narray RIGHT[N]\n", n);
  tell(d, "Autocorrelation of the residual over lags in rows.");
  for (c = 0; c < v->n_channels; c++)
    if (has_lags(&v->channel[c]))
      put_correlation(d, &v->channel[c], ++number, &y[0], &y[1]);
  for (c = number = 0; c < v->n_channels; c++)
    if (has_lags(&v->channel[c]))
      read_correlation(d, &v->channel[c], ++number, n, y);
  fprintf(d->file, "LOWEST = %.4g\nHIGHEST = %.4g\n", y[0], y[1]);
  put_lines(d->file, autocorrelation_gp);
  return 1;
}

/* ---- Candidates ---- */

static int is_found(const lab_loop_result *result, int effect)
{
  int i;
  for (i = 0; i < result->n_found; i++)
    if (result->found[i].effect == effect)
      return 1;
  return 0;
}

static int draw_candidates(const drawing *d)
{
  const lab_loop_result *result = d->story->result;
  const double least = 0.5;
  unsigned char seen[PNEU_EFFECT_COUNT + 1] = {0};
  double threshold;
  int i, n = 0;
  char name[LAB_SHOWN_TEXT];
  if (result->trace.n == 0 || !(result->level > 0))
    return 0;
  threshold = lab_chi2_threshold(result->level);
  tell(d, "Statistic of each effect; the threshold is %.3g.", threshold);
  fputs("$candidates << EOD\nrow,statistic,kind,name\n", d->file);
  for (i = 0; i < result->trace.n && n < CANDIDATES; i++) {
    const lab_candidate *c = &result->trace.candidate[i];
    if (seen[c->effect] || !(c->statistic > least))
      continue;
    seen[c->effect] = 1;
    fprintf(d->file, "%d,%.5g,%d,\"%s%s\"\n", ++n, c->statistic,
            is_found(result, c->effect) ? 2 : c->statistic > threshold, is_found(result, c->effect) ? "added: " : "",
            plain(pneu_effect_at(c->effect)->name, name));
    if (n <= 5)
      tell(d, " %s: %.3g.", name, c->statistic);
  }
  fputs("EOD\n", d->file);
  if (n == 0)
    return 0;
  entitle(d, "Which effect the residual of the declared model asks for");
  put_head(d, 185 + 26 * n, 72,
           "Blue: added. Orange: passes the threshold, but the refits preferred another. Grey: does not pass");
  fprintf(d->file, "N = %d\nT_MIN = %g\nT_MAX = %.4g\nTHRESHOLD = %.5g\n", n, least,
          2 * fmax(threshold, result->trace.candidate[0].statistic), threshold);
  put_lines(d->file, candidates_gp);
  return 1;
}

/* ---- What has no name ---- */

enum { CYCLE_POINTS = 73, TERM_POINTS = CYCLE_POINTS + PNEU_TERM_KNOTS };

/* A cycle at a time: its Fourier series. */
static double cycle_at(const pneu_term *term, double t)
{
  const double angle = 6.283185307179586 * t / (double)(term->to - term->from);
  double sum = 0;
  int k;
  for (k = 1; 2 * k <= term->n; k++)
    sum += (double)term->value[2 * k - 2] * cos(k * angle) + (double)term->value[2 * k - 1] * sin(k * angle);
  return sum;
}

/* The curve of a term, as it is shown: its knots, or one cycle of it.  Returns: points */
static int curve_of(const pneu_term *term, double at[TERM_POINTS], double value[TERM_POINTS])
{
  const int is_cycle = term->argument == PNEU_TERM_OVER_CYCLE, n = is_cycle ? CYCLE_POINTS : term->n;
  const double argument_scale = lab_shown_as(lab_term_arguments[term->argument].unit).scale;
  const double value_scale = lab_shown_as(lab_term_equations[term->equation].unit).scale;
  int i;
  for (i = 0; i < n; i++) {
    const double x = (double)term->from + i * (double)(term->to - term->from) / (n - 1);
    at[i] = argument_scale * x;
    value[i] = value_scale * (is_cycle ? cycle_at(term, x) : (double)term->value[i]);
  }
  return n;
}

static void put_term(const drawing *d, const double *at, const double *value, int n)
{
  int i;
  fputs("$term << EOD\nat,value\n", d->file);
  for (i = 0; i < n; i++)
    fprintf(d->file, "%.5g,%.5g\n", at[i], value[i]);
  fputs("EOD\n", d->file);
}

static void read_term(const drawing *d, const lab_panel *panel, const double *at, const double *value, int n)
{
  cJSON *reading = lab_readings_panel(
      d->readings, d->figure->name, panel,
      lab_readings_column(d->readings, at, NULL, (size_t)n, 1, lab_readings_decimals(panel->x[0], panel->x[1])));
  lab_readings_curve(
      reading, "term",
      lab_readings_column(d->readings, value, NULL, (size_t)n, 1, lab_readings_decimals(panel->y[0], panel->y[1])));
}

static int draw_unlisted(const drawing *d)
{
  const lab_rig *rig = &d->story->completed->rig;
  const pneu_term *term = rig->term;
  double at[TERM_POINTS], value[TERM_POINTS], low, high;
  char where[LAB_WHERE_TEXT], name[LAB_SHOWN_TEXT];
  lab_panel panel = {0};
  int n;
  if (rig->n_terms == 0)
    return 0;
  n = curve_of(term, at, value);
  lab_range(value, (size_t)n, &low, &high);
  panel.group = panel.x_name = lab_term_arguments[term->argument].key;
  panel.x_unit = lab_shown_as(lab_term_arguments[term->argument].unit).unit;
  panel.name = plain(lab_term_equations[term->equation].key, name);
  panel.unit = lab_shown_as(lab_term_equations[term->equation].unit).unit;
  panel.x[0] = at[0];
  panel.x[1] = at[n - 1];
  panel.y[0] = low - 0.05 * (high - low);
  panel.y[1] = high + 0.05 * (high - low);
  entitle(d, "What has no name");
  tell(d, "It acts like %s: %s.", lab_unlisted_what(term), lab_unlisted_where(term, where));
  put_head(d, 380, 88, "The free term that was added, fitted with everything else");
  put_term(d, at, value, n);
  fputs("array TOP[1]\narray BOTTOM[1]\narray LEFT[1]\narray RIGHT[1]\n", d->file);
  put_box(d, 1, &panel, 105, 205);
  put_sides(d, 1, &panel, 0.1, right_edge);
  read_term(d, &panel, at, value, n);
  fprintf(d->file, "IS_TABLE = %d\nLOW = %.5g\nHIGH = %.5g\nARGUMENT_LABEL = \"%s [%s]\"\nVALUE_LABEL = \"%s [%s]\"\n",
          term->argument != PNEU_TERM_OVER_CYCLE, panel.y[0], panel.y[1], panel.x_name, unit_or_1(panel.x_unit),
          panel.name, unit_or_1(panel.unit));
  put_lines(d->file, unlisted_gp);
  return 1;
}

/* ---- Parameters ---- */

/* What was declared for an unknown of the base model.  Returns: NaN for any other. */
static double declared_of(const drawing *d, const lab_unknown *x)
{
  pneu_params declared = d->story->rig->params;
  if (x->kind != LAB_UNKNOWN_PARAM)
    return (double)NAN;
  if (x->index == LAB_FIT_ORIFICE_AREA)
    return 1;
  return x->index < PNEU_PARAM_BASE_COUNT ? (double)*pneu_param_at(&declared, x->index) : (double)NAN;
}

/* The same unknown before anything was added; NaN if it was not fitted then. */
static double fitted_before(const drawing *d, const lab_unknown *x)
{
  const lab_unknowns *u = d->story->declared;
  int j;
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].kind == x->kind && u->unknown[j].index == x->index)
      return u->unknown[j].value;
  return (double)NAN;
}

static double per_cent(double value, double declared)
{
  return 100 * (value - declared) / fabs(declared);
}

static int draw_parameters(const drawing *d)
{
  const lab_unknowns *u = d->story->completed;
  const lab_fit_result *fit = &d->story->result->fit;
  int j, n = 0;
  char name[LAB_SHOWN_TEXT];
  tell(d, "Fitted less declared, in per cent of declared.");
  fputs("$parameters << EOD\nrow,before,after,low,high,name\n", d->file);
  for (j = 0; j < u->n; j++) {
    const lab_unknown *x = &u->unknown[j];
    const double declared = declared_of(d, x);
    const int is_free = fit->state[j] == LAB_FIT_FREE;
    if (isnan(declared) || declared == 0)
      continue;
    fprintf(d->file, "%d,%.5g,%.5g,%.5g,%.5g,\"%s\"\n", ++n, per_cent(fitted_before(d, x), declared),
            per_cent(x->value, declared), per_cent(is_free ? fit->low[j] : x->value, declared),
            per_cent(is_free ? fit->high[j] : x->value, declared), plain(x->name, name));
    tell(d, " %s %+.2f %%.", name, per_cent(x->value, declared));
  }
  fputs("EOD\n", d->file);
  if (n == 0)
    return 0;
  entitle(d, "What the fit made of what was declared");
  put_head(d, 200 + 36 * n, 110,
           "A parameter that bends to stand in for a missing effect springs back when the effect is there");
  fprintf(d->file, "N = %d\n", n);
  put_lines(d->file, parameters_gp);
  return 1;
}

/* ---- All of them ---- */

static const struct {
  const char *name, *keys, *reading;
  int (*draw)(const drawing *d); /* writes a script; returns 0 if there is nothing to show */
} figures_known[LAB_FIGURE_COUNT] = {
    {"response", "measured before after",
     "Where the lines part from the grey, the model is wrong; the figure of the residual magnifies it.", draw_response},
    {"residual", "before after",
     "A good model leaves a carpet of even height within the band. Humps and spikes say when the model errs; the "
     "panels have scales of their own.",
     draw_residual},
    {"arguments", "before after band",
     "Points outside the band say at which pressure, position, velocity or command the model errs. p, x and v are "
     "the model's own.",
     draw_arguments},
    {"autocorrelation", "before after band",
     "Bars beyond the band mean that the residual follows a pattern, so that the model, or the noise that was "
     "declared, is not the whole truth. The p-value is that of Ljung and Box for all lags of the last model at once; "
     "below 0.01 the residual is not white.",
     draw_autocorrelation},
    {"candidates", "",
     "Many effects pass where one is missing, because their footprints overlap. Those that pass best are taken "
     "up in turn, everything is fitted again, and the best fit decides. If nothing were missing, T would be chi-square "
     "with 1 degree of freedom.",
     draw_candidates},
    {"unlisted", "",
     "Knots where the model hardly ever is are loosely known. Over a cycle, time is that of the log: its zero is the "
     "zero of t.",
     draw_unlisted},
    {"parameters", "before after", "Bars are 95 % intervals, often narrower than the point.", draw_parameters}};

/* The script of all figures, and the list of those that it draws. */
static void put_all(drawing *d, lab_figures *figures)
{
  int i;
  for (i = 0; i < LAB_FIGURE_COUNT; i++) {
    d->figure = &figures->figure[figures->n];
    memset(d->figure, 0, sizeof *d->figure);
    d->figure->name = figures_known[i].name;
    d->figure->keys = figures_known[i].keys;
    d->figure->reading = figures_known[i].reading;
    figures->n += figures_known[i].draw(d) != 0;
  }
}

/* Cut what gnuplot drew into one text for each figure. */
static int share_out(const char *drawn, lab_figures *figures, lab_error *error)
{
  static const char begin[] = "<?xml", end[] = "</svg>";
  int i;
  for (i = 0; i < figures->n; i++) {
    const char *from = strstr(drawn, begin), *to = from ? strstr(from, end) : NULL;
    char *svg;
    if (!to)
      return lab_fail(error, LAB_WORLD, "gnuplot drew %d figures of the %d asked for", i, figures->n);
    if (!(svg = malloc((size_t)(to - from) + sizeof end + 1)))
      return lab_fail_memory(error, "the figures");
    sprintf(svg, "%.*s%s\n", (int)(to - from), from, end);
    figures->figure[i].svg = svg;
    drawn = to + sizeof end - 1;
  }
  if (strstr(drawn, begin))
    return lab_fail(error, LAB_WORLD, "gnuplot drew more than the %d figures asked for", figures->n);
  return LAB_OK;
}

int lab_figures_draw(const lab_story *story, const lab_evidence *evidence, lab_figures *figures, lab_error *error)
{
  drawing d = {story, evidence, NULL, NULL, NULL, NULL, NULL, NULL, -1};
  char *drawn = NULL;
  int status;
  memset(figures, 0, sizeof *figures);
  d.readings = figures->readings = lab_readings_new();
  d.point = malloc(((size_t)3 * COLUMNS + (size_t)evidence->n_runs) * sizeof *d.point);
  d.kept = calloc(evidence->n + 1, 1);
  d.clock = malloc((evidence->n + 1) * sizeof *d.clock);
  if (!d.point || !d.kept || !d.clock) {
    status = lab_fail_memory(error, "the figures");
  } else if ((d.file = tmpfile())) {
    keep_rows(&d);
    put_all(&d, figures);
    status = lab_gnuplot_run(d.file, &drawn, error);
    fclose(d.file);
  } else {
    status = lab_fail(error, LAB_WORLD, "no room for the script of the figures in the folder of temporary files");
  }
  if (status == LAB_OK)
    status = share_out(drawn, figures, error);
  free(drawn);
  free(d.point);
  free(d.kept);
  free(d.clock);
  return status;
}

void lab_figures_free(lab_figures *figures)
{
  int i;
  for (i = 0; i < figures->n; i++)
    free(figures->figure[i].svg);
  cJSON_Delete(figures->readings);
  memset(figures, 0, sizeof *figures);
}

/* What an earlier run has left of figures that this one does not draw, lest they be taken for its own. */
static void remove_others(const lab_figures *figures, const char *folder)
{
  static const char *const endings[] = {".svg", ".svg.part"};
  char path[LAB_PATH_TEXT + 32];
  int i, k;
  for (i = 0; i < LAB_FIGURE_COUNT; i++)
    for (k = 0; k < 2 && !lab_figures_find(figures, figures_known[i].name); k++) {
      snprintf(path, sizeof path, "%s/%s%s", folder, figures_known[i].name, endings[k]);
      remove(path);
    }
}

int lab_figures_write(const lab_figures *figures, const char *folder, lab_error *error)
{
  int i;
  remove_others(figures, folder);
  for (i = 0; i < figures->n; i++) {
    char path[LAB_PATH_TEXT + 32];
    lab_outfile out;
    snprintf(path, sizeof path, "%s/%s.svg", folder, figures->figure[i].name);
    if (lab_out_open(&out, path, error))
      return error->status;
    fputs(figures->figure[i].svg, out.file);
    if (lab_out_close(&out, error))
      return error->status;
  }
  return LAB_OK;
}

const lab_figure *lab_figures_find(const lab_figures *figures, const char *name)
{
  int i;
  for (i = 0; i < figures->n; i++)
    if (!strcmp(figures->figure[i].name, name))
      return &figures->figure[i];
  return NULL;
}

/* What each figure shows: a function fills in its panels, and a row of `known` says how it is read. */
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/text.h"
#include "../rig/rigterm.h"
#include "../trace/freeterms.h"
#include "figures.h"

enum {
  SIGNATURE_HEIGHT = 300, /* of a panel */
  COMMAND_HEIGHT = 55,
  CHANNEL_HEIGHT = 180,
  RESIDUAL_HEIGHT = 105,
  ARGUMENT_HEIGHT = 105,
  CORRELATION_HEIGHT = 165,
  TERM_HEIGHT = 205,
  BINS = 30,      /* of an argument */
  BIN_LEAST = 10, /* rows of a bin that counts */
  CYCLE_POINTS = 73,
  TERM_POINTS = CYCLE_POINTS + PNEU_TERM_KNOTS
};
static const double at_rest = 1e-4;                    /* of the stroke a second, below which a stem does not move */
static const double two_sided_99 = 2.5758293035489004; /* standard deviations */

/* What a figure is made from and where it goes. */
typedef struct drawing {
  const lab_report *report;
  const lab_residual_table *table;
  lab_figures *all;
  lab_figure *figure;
  unsigned char *kept; /* for each row, whether curves over time have it */
  int stages;          /* both models, or the declared one alone where nothing was added */
} drawing;

/* ---- What figures have in common ---- */

static void entitle(const drawing *d, const char *title, const char *subtitle)
{
  d->figure->title = title;
  d->figure->subtitle = subtitle;
}

/* Append to the words for those who cannot see the figure. */
#define describe_figure(d, ...) lab_append((d)->figure->alt, LAB_FIGURE_ALT, __VA_ARGS__)

/* A panel more, over time, without curves. */
static lab_panel *add_panel(const drawing *d, const char *name, const char *unit, int height)
{
  lab_panel *panel = &d->figure->panel[d->figure->n++];
  snprintf(panel->name, sizeof panel->name, "%s", name);
  panel->unit = unit;
  panel->height = height;
  panel->x_name = "t";
  panel->x_unit = "s";
  panel->x = d->all->t;
  return panel;
}

/* Take another abscissa than time. */
static void lay_over(lab_panel *panel, const char *name, const char *unit, int column)
{
  panel->x_name = name;
  panel->x_unit = unit;
  panel->x = column;
}

static int column_of(const drawing *d, const double *value, size_t n, double scale)
{
  return lab_figures_add_column(d->all, value, NULL, n, scale, -1);
}

static void put_curve(const drawing *d, lab_panel *panel, int key, int form, const double *value, double scale)
{
  lab_panel_curve(panel, key, form, lab_figures_add_column(d->all, value, d->kept, d->table->n, scale, -1));
}

/* "Pressure p" */
static const char *channel_name(int channel, char text[LAB_FORMAT_TEXT])
{
  char *at;
  snprintf(text, LAB_FORMAT_TEXT, "%s %s", lab_channels[channel].quantity, lab_channels[channel].key);
  *text = (char)toupper((unsigned char)*text);
  while ((at = strchr(text, '_')))
    *at = ' ';
  return text;
}

/* "Pressure p, declared model" */
static const char *stage_name(int channel, int stage, char text[2 * LAB_FORMAT_TEXT])
{
  char name[LAB_FORMAT_TEXT];
  snprintf(text, 2 * LAB_FORMAT_TEXT, "%s, %s model", channel_name(channel, name),
           stage == LAB_STAGE_BEFORE ? "declared" : "completed");
  return text;
}

/* ---- Valve signature: pressure over travel both ways, between the lines of spring and dry friction ---- */

int lab_signature_make(const lab_rig *rig, lab_signature *s, lab_error *error)
{
  enum { LAST = LAB_SIGNATURE_POINTS - 1 };
  lab_rig last;
  pneu_model model;
  pneu_input input;
  int i, line;
  lab_rig_at(rig, INFINITY, &last);
  if (lab_rig_model(&last, &model, error))
    return error->status;
  if (!(model.p.stroke > 0))
    return lab_fail(error, LAB_DATA, "a vessel has no travel");
  pneu_input_default(&model, &input);
  for (i = 0; i <= LAST; i++) {
    s->x[i] = (double)model.p.stroke * i / LAST;
    for (line = 0; line < LAB_SIGNATURE_LINES; line++)
      s->p[line][i] = (double)pneu_balance_pressure(&model, (pneu_real)s->x[i], &input, line - LAB_SIGNATURE_SPRING);
  }
  s->bench_lower = s->p[LAB_SIGNATURE_SPRING][0];
  s->bench_upper = s->p[LAB_SIGNATURE_SPRING][LAST];
  s->spring_rate = (s->bench_upper - s->bench_lower) * (double)model.p.area / (double)model.p.stroke;
  s->band = s->p[LAB_SIGNATURE_UP][LAST / 2] - s->p[LAB_SIGNATURE_DOWN][LAST / 2];
  return LAB_OK;
}

int lab_signature_models(const lab_report *report, lab_signature_model model[LAB_SIGNATURE_MODELS])
{
  const lab_signature_model all[LAB_SIGNATURE_MODELS] = {{.key = LAB_KEY_SHEET, .rig = report->rig},
                                                         {.key = LAB_KEY_FOUND, .rig = &report->completed->rig},
                                                         {.key = LAB_KEY_BASELINE, .rig = report->baseline}};
  lab_error error;
  int i, n = 0;
  for (i = 0; i < LAB_SIGNATURE_MODELS; i++) {
    model[n] = all[i];
    n += all[i].rig && lab_signature_make(all[i].rig, &model[n].signature, &error) == LAB_OK;
  }
  return n;
}

/* Means of pressure over travel while the stem moves one way.  In: one  room for all rows  Returns: their column */
static int put_branch(const drawing *d, const double *x, const double *p, int way, double *one)
{
  const lab_residual_table *v = d->table;
  const double stroke = (double)d->report->rig->params.stroke, half = 0.5 * stroke / (LAB_SIGNATURE_POINTS - 1);
  lab_bin bin[LAB_SIGNATURE_POINTS];
  double mean[LAB_SIGNATURE_POINTS];
  size_t i;
  for (i = 0; i < v->n; i++) {
    const int inside = x[i] >= -half && x[i] <= stroke + half;
    one[i] = inside && way * v->argument[LAB_ARGUMENT_V][i] > at_rest * stroke ? p[i] : (double)NAN;
  }
  lab_bin_means(x, one, v->n, -half, stroke + half, LAB_SIGNATURE_POINTS, bin);
  for (i = 0; i < LAB_SIGNATURE_POINTS; i++)
    mean[i] = bin[i].mean;
  return column_of(d, mean, LAB_SIGNATURE_POINTS, lab_format_as("Pa").scale);
}

static void put_branches(const drawing *d, int key, const double *x, const double *p, lab_panel *panel)
{
  double *one = malloc((d->table->n + 1) * sizeof *one);
  int way;
  d->all->failed |= !one;
  for (way = 1; one && way >= -1; way -= 2)
    lab_panel_curve(panel, key, LAB_FORM_LINE, put_branch(d, x, p, way, one));
  free(one);
}

/* What was measured, and what the model makes of it. */
static void put_response(const drawing *d, lab_panel *panel)
{
  const lab_residual_channel *x = lab_residual_table_channel(d->table, LAB_CHANNEL_X),
                             *p = lab_residual_table_channel(d->table, LAB_CHANNEL_P);
  const double *x_model = d->table->argument[LAB_ARGUMENT_X], *p_model = d->table->argument[LAB_ARGUMENT_P];
  const int stage = d->stages - 1;
  if (p || d->report->rig->input[LAB_CHANNEL_P])
    put_branches(d, LAB_KEY_MEASURED, x ? x->measured : x_model, p ? p->measured : p_model, panel);
  put_branches(d, LAB_KEY_BEFORE + stage, x ? x->predicted[stage] : x_model, p ? p->predicted[stage] : p_model, panel);
}

static void put_lines(const drawing *d, const lab_signature_model *of, lab_panel *panel)
{
  int line;
  for (line = LAB_SIGNATURE_LINES - 1; line >= 0; line--)
    lab_panel_curve(panel, of->key, of->key == LAB_KEY_FOUND ? LAB_FORM_LINE : LAB_FORM_DASHED,
                    column_of(d, of->signature.p[line], LAB_SIGNATURE_POINTS, lab_format_as("Pa").scale));
}

static void tell_lines(const drawing *d, const lab_signature_model *of)
{
  const lab_signature *s = &of->signature;
  describe_figure(d, " %s: bench set %s to %s, spring rate %s, friction band %s.", lab_curve_keys[of->key].brief,
                  LAB_QUANTITY(s->bench_lower, "Pa", 4), LAB_QUANTITY(s->bench_upper, "Pa", 4),
                  LAB_QUANTITY(s->spring_rate, "N/m", 4), LAB_QUANTITY(s->band, "Pa", 4));
}

static int fill_signature(const drawing *d)
{
  lab_signature_model model[LAB_SIGNATURE_MODELS];
  const int n = lab_signature_models(d->report, model);
  const lab_format shown = lab_format_as("m");
  const int measured = lab_residual_table_channel(d->table, LAB_CHANNEL_P) || d->report->rig->input[LAB_CHANNEL_P];
  lab_panel *panel;
  int i;
  if (n == 0)
    return 0;
  entitle(d, "Valve signature: pressure over travel, both ways",
          measured ? "Means of moving rows; lines: the spring's pressure, and what dry friction adds either way"
                   : "The model's pressure, for it was not measured; lines: the spring, and dry friction either way");
  describe_figure(d, "Pressure over travel.%s", measured ? "" : " The pressure was not measured and is the model's.");
  panel = add_panel(d, "Pressure p", lab_format_as("Pa").unit, SIGNATURE_HEIGHT);
  lay_over(panel, "travel x", shown.unit, column_of(d, model[0].signature.x, LAB_SIGNATURE_POINTS, shown.scale));
  put_response(d, panel);
  for (i = 0; i < n; i++)
    tell_lines(d, &model[i]);
  for (i = n - 1; i >= 0; i--) /* what is declared over what is found, which hides it where it is as declared */
    put_lines(d, &model[i], panel);
  return 1;
}

/* ---- Rows and axis of curves over time ---- */

/* Keep the rows that a curve goes through, so that no peak is lost. */
static void keep_rows_of(const drawing *d, const double *value, lab_point *point)
{
  const lab_residual_table *v = d->table;
  const lab_line line = {v->n, v->t, value, v->n_runs, v->first};
  size_t n = lab_envelope(&line, LAB_FIGURE_COLUMNS, point);
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
    for (stage = 0; stage < d->stages; stage++) {
      keep_rows_of(d, v->channel[c].predicted[stage], point);
      keep_rows_of(d, v->channel[c].residual[stage], point);
    }
  }
}

static void lay_out_time(const drawing *d)
{
  const lab_residual_table *v = d->table;
  lab_point *point = malloc(((size_t)3 * LAB_FIGURE_COLUMNS + (size_t)v->n_runs) * sizeof *point);
  double *axis = malloc((v->n + 1) * sizeof *axis);
  d->all->n_runs = v->n_runs;
  d->all->failed = !point || !axis;
  if (point && axis) {
    keep_rows(d, point);
    lay_out_runs(d, decimals_of_time(v), axis);
  }
  free(point);
  free(axis);
}

/* ---- Response ---- */

static void tell_channel(const drawing *d, const lab_residual_channel *mine, const char *name)
{
  const lab_channel_info *info = &lab_channels[mine->channel];
  const lab_search_result *result = d->report->result;
  double low, high;
  if (lab_range(mine->measured, d->table->n, &low, &high))
    describe_figure(d, " %s runs from %s to %s; rms error of the declared model %s", name,
                    LAB_NUMBER(lab_format_as(info->unit).scale * low, 3), LAB_QUANTITY(high, info->unit, 3),
                    LAB_QUANTITY(result->before.rmse[mine->channel], info->unit, 3));
  if (d->stages > 1)
    describe_figure(d, ", of the completed one %s", LAB_QUANTITY(result->after.rmse[mine->channel], info->unit, 3));
  describe_figure(d, ".");
}

static void put_channel(const drawing *d, const lab_residual_channel *mine)
{
  static const int form[LAB_STAGE_COUNT] = {LAB_FORM_DASHED, LAB_FORM_LINE};
  const lab_format shown = lab_format_as(lab_channels[mine->channel].unit);
  char name[LAB_FORMAT_TEXT];
  lab_panel *panel = add_panel(d, channel_name(mine->channel, name), shown.unit, CHANNEL_HEIGHT);
  int stage;
  put_curve(d, panel, LAB_KEY_MEASURED, LAB_FORM_LINE, mine->measured, shown.scale);
  for (stage = 0; stage < d->stages; stage++)
    put_curve(d, panel, LAB_KEY_BEFORE + stage, form[stage], mine->predicted[stage], shown.scale);
  tell_channel(d, mine, name);
}

/* What the stem was told to do, where a log has it, and the opening that is predicted where a command was not logged;
 * none where it cannot be. */
static void put_command(const drawing *d, const char *name, const double *value, lab_format shown)
{
  double low, high;
  if (lab_range(value, d->table->n, &low, &high))
    put_curve(d, add_panel(d, name, shown.unit, COMMAND_HEIGHT), LAB_KEY_COMMAND, LAB_FORM_STEPS, value, shown.scale);
}

static int fill_response(const drawing *d)
{
  const lab_residual_table *v = d->table;
  const int commanded = lab_log_command(d->report->completed->run[0].log) != LAB_CHANNEL_SP;
  int c;
  entitle(d,
          d->stages > 1 ? "Measured, and what both models predict for the same command"
                        : "Measured, and what the model predicts for the same command",
          v->n_runs > 1 ? "The runs follow one after the other; no peak is lost"
                        : "Each line spans all values that fall on its pixels, so that no peak is lost");
  describe_figure(d, "Command, measured and predicted channels over %.4g s.", v->t[v->n - 1] - v->t[0]);
  put_command(d, commanded ? "Command u" : "Opening u, predicted", v->argument[LAB_ARGUMENT_U],
              lab_format_as(lab_argument_unit(d->report, LAB_ARGUMENT_U)));
  put_command(d, "Set position sp", v->set_position, (lab_format){100, "%"});
  for (c = 0; c < v->n_channels; c++)
    put_channel(d, &v->channel[c]);
  return 1;
}

/* ---- Residual ---- */

static void put_residual(const drawing *d, const lab_residual_channel *mine, int stage, int band)
{
  double low, high;
  char name[2 * LAB_FORMAT_TEXT];
  lab_panel *panel = add_panel(d, stage_name(mine->channel, stage, name), "× noise", RESIDUAL_HEIGHT);
  lab_panel_curve(panel, LAB_KEY_BAND, LAB_FORM_BAND, band);
  put_curve(d, panel, LAB_KEY_BEFORE + stage, LAB_FORM_LINE, mine->residual[stage], 1);
  if (lab_range(mine->residual[stage], d->table->n, &low, &high))
    describe_figure(d, " %s: largest %.3g.", name, fmax(high, -low));
}

static int fill_residual(const drawing *d)
{
  const lab_residual_table *v = d->table;
  const int band = lab_figures_add_column(d->all, &two_sided_99, NULL, 1, 1, 2);
  int c, stage;
  entitle(d, d->stages > 1 ? "What the models do not explain" : "What the model does not explain",
          "Measured less predicted, in units of the noise; 99 % of white noise lies in the band");
  describe_figure(d, "Residual over time in units of the noise.");
  d->figure->across = d->stages;
  for (c = 0; c < v->n_channels; c++)
    for (stage = 0; stage < d->stages; stage++)
      put_residual(d, &v->channel[c], stage, band);
  return 1;
}

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
    mine->x = column_of(d, at, BINS, mine->shown.scale);
    n++;
  }
  return n;
}

/* Means in bins that are full enough, and where those of white noise would be.  Returns: the largest of both */
static double put_bins(const drawing *d, const axis *over, const lab_residual_channel *mine, int stage)
{
  const lab_residual_table *v = d->table;
  char name[2 * LAB_FORMAT_TEXT];
  lab_panel *panel = add_panel(d, stage_name(mine->channel, stage, name), "× noise", ARGUMENT_HEIGHT);
  double mean[BINS], band[BINS], largest = 0;
  lab_bin bin[BINS];
  int b;
  lab_bin_means(v->argument[over->argument], mine->residual[stage], v->n, over->from, over->to, BINS, bin);
  for (b = 0; b < BINS; b++) {
    const int full = bin[b].n >= BIN_LEAST;
    mean[b] = full ? bin[b].mean : (double)NAN;
    band[b] = full ? two_sided_99 / sqrt((double)bin[b].n) : (double)NAN;
    largest = full ? fmax(largest, fmax(fabs(mean[b]), band[b])) : largest;
  }
  lay_over(panel, lab_argument_key(over->argument), over->shown.unit, over->x);
  lab_panel_curve(panel, LAB_KEY_BAND, LAB_FORM_BAND, column_of(d, band, BINS, 1));
  lab_panel_curve(panel, LAB_KEY_BEFORE + stage, LAB_FORM_POINTS, column_of(d, mean, BINS, 1));
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
  describe_figure(d, " %s: means up to %.3g.", row->name, largest);
}

static int fill_arguments(const drawing *d)
{
  const lab_residual_table *v = d->table;
  axis over[LAB_ARGUMENT_COUNT];
  int c, stage;
  if (v->n < BINS * BIN_LEAST / 2 || (d->figure->across = choose_axes(d, over)) == 0) /* hardly a bin would be full */
    return 0;
  entitle(d, "Where the residual sits",
          "Its mean in bins, in units of the noise; the band is where 99 % of such means of white noise lie");
  describe_figure(d, "Mean of the residual in bins, in units of the noise.");
  for (c = 0; c < v->n_channels; c++)
    for (stage = 0; stage < d->stages; stage++)
      put_row(d, over, &v->channel[c], stage);
  return 1;
}

/* ---- Autocorrelation ---- */

static const lab_whiteness *whiteness(const drawing *d, int stage, const lab_residual_channel *mine)
{
  return &d->report->result->left[stage][mine->channel].whiteness;
}

static int lags_of(const drawing *d, const double *correlation, const lab_whiteness *white, double scale)
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
  channel_name(mine->channel, name);
  snprintf(title, sizeof title, "%s: p-value %s", name, lab_format_p(after->p_value, p));
  panel = add_panel(d, title, "", CORRELATION_HEIGHT);
  for (k = 0; k <= after->lags; k++)
    lag[k] = k;
  lay_over(panel, "lag", "rows", lab_figures_add_column(d->all, lag + 1, NULL, (size_t)after->lags, 1, 0));
  lab_panel_curve(panel, LAB_KEY_BAND, LAB_FORM_BAND, lags_of(d, after->deviation, after, two_sided_99));
  if (d->stages > 1)
    lab_panel_curve(panel, LAB_KEY_AFTER, LAB_FORM_BARS, lags_of(d, after->correlation, after, 1));
  lab_panel_curve(panel, LAB_KEY_BEFORE, LAB_FORM_POINTS, lags_of(d, before->correlation, after, 1));
  describe_figure(d, " %s: lag 1 %.3f", name, before->correlation[1]);
  if (d->stages > 1)
    describe_figure(d, ", completed model %.3f", after->correlation[1]);
  describe_figure(d, "; p-value of whiteness %s.", p);
}

static int fill_autocorrelation(const drawing *d)
{
  const lab_residual_table *v = d->table;
  int c;
  entitle(d, "Does the residual remember?",
          "Autocorrelation of the residual; white noise stays within the band, and its p-value above 0.01");
  describe_figure(d, "Autocorrelation of the residual over lags in rows.");
  for (c = 0; c < v->n_channels; c++)
    if (whiteness(d, LAB_STAGE_BEFORE, &v->channel[c])->lags > 0 &&
        whiteness(d, LAB_STAGE_AFTER, &v->channel[c])->lags > 0)
      put_correlation(d, &v->channel[c]);
  d->figure->across = d->figure->n;
  return d->figure->n;
}

/* ---- What has no name: the free term that was added ---- */

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
static size_t curve_of(const pneu_term *term, double at[TERM_POINTS], double value[TERM_POINTS])
{
  const int is_cycle = term->argument == PNEU_TERM_OVER_CYCLE, n = is_cycle ? CYCLE_POINTS : term->n;
  int i;
  for (i = 0; i < n; i++) {
    at[i] = (double)term->from + i * (double)(term->to - term->from) / (n - 1);
    value[i] = is_cycle ? cycle_at(term, at[i]) : (double)term->value[i];
  }
  return (size_t)n;
}

static int fill_unlisted(const drawing *d)
{
  const lab_rig *rig = &d->report->completed->rig;
  const pneu_term *term = rig->term;
  double at[TERM_POINTS], value[TERM_POINTS];
  char where[LAB_WHERE_TEXT];
  lab_format shown, x_shown;
  lab_panel *panel;
  size_t n;
  if (rig->n_terms == 0)
    return 0;
  shown = lab_format_as(lab_term_equations[term->equation].unit);
  x_shown = lab_format_as(lab_term_arguments[term->argument].unit);
  n = curve_of(term, at, value);
  entitle(d, "What is not in the catalogue", "The free term that was added, fitted with everything else");
  describe_figure(d, "It acts like %s: %s.", lab_free_term_what(term), lab_free_term_where(term, where));
  panel = add_panel(d, lab_term_equations[term->equation].key, shown.unit, TERM_HEIGHT);
  lay_over(panel, lab_term_arguments[term->argument].key, x_shown.unit, column_of(d, at, n, x_shown.scale));
  lab_panel_curve(panel, LAB_KEY_TERM, term->argument == PNEU_TERM_OVER_CYCLE ? LAB_FORM_LINE : LAB_FORM_POINTS,
                  column_of(d, value, n, shown.scale));
  return 1;
}

/* ---- All of them ---- */

const char *const lab_figure_names[LAB_FIGURE_COUNT] = {"signature", "response",        "residual",
                                                        "arguments", "autocorrelation", "unlisted"};

/* In that order; what fills one in returns 0 if there is nothing to show. */
static const struct {
  const char *reading;
  int (*fill)(const drawing *d);
} known[LAB_FIGURE_COUNT] = {
    {"A loop wider than its lines has more friction than dry friction, or was run fast. Green lines apart from the "
     "orange ones: a value is not as declared.",
     fill_signature},
    {"Where the lines leave the grey, the model is wrong; the figure of the residual magnifies this.", fill_response},
    {"A good model leaves an even residual within the band. Humps and spikes show when the model errs. Each panel has "
     "its own scale.",
     fill_residual},
    {"Points outside the band say at which pressure, position, velocity or command the model errs. p, x and v are "
     "the model's own.",
     fill_arguments},
    {"Bars beyond the band mean that the residual has a pattern, so that the model is incomplete or the declared noise "
     "is wrong. The p-value is that of the Ljung-Box test on all lags of the last model; below 0.01 the residual is "
     "not white.",
     fill_autocorrelation},
    {"Knots that the model hardly reaches are uncertain. Over a cycle, time is the t of the log.", fill_unlisted}};

static void fill_all(drawing *d)
{
  lab_figures *all = d->all;
  int i;
  for (i = 0; i < LAB_FIGURE_COUNT; i++) {
    d->figure = &all->figure[all->n];
    d->figure->name = lab_figure_names[i];
    d->figure->reading = known[i].reading;
    d->figure->across = 1;
    all->n += known[i].fill(d) != 0;
  }
}

int lab_figures_make(const lab_report *report, lab_figures **figures, lab_error *error)
{
  lab_figures *all = *figures = calloc(1, sizeof *all);
  drawing d = {report, &all->table, all, NULL, NULL, lab_report_is_completed(report) ? LAB_STAGE_COUNT : 1};
  int status = all ? lab_residual_table_collect(report, &all->table, error) : lab_fail_memory(error, "the figures");
  if (status == LAB_OK && (d.kept = calloc(all->table.n + 1, 1))) {
    lay_out_time(&d);
    fill_all(&d);
  }
  if (status == LAB_OK && (!d.kept || all->failed))
    status = lab_fail_memory(error, "the figures");
  free(d.kept);
  if (status != LAB_OK) {
    lab_figures_free(all);
    *figures = NULL;
  }
  return status;
}

#include "figures.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "gnuplot.h"
#include "outfile.h"
#include "quantile.h"
#include "reduce.h"
#include "rigterm.h"
#include "shown.h"
#include "unlisted.h"

enum { COLUMNS = 360, BINS = 30, BIN_LEAST = 10, CANDIDATES = 14 };
static const double two_sided_99 = 2.5758293035489004; /* standard deviations */

/* The scripts, a line a string; made by make from apps/lab/report/ and study/figures/style.gp. */
static const char *const style_gp[] = {
#include "study/figures/style.gp.inc"
    NULL};
static const char *const panels_gp[] = {
#include "apps/lab/report/panels.gp.inc"
    NULL};
static const char *const response_gp[] = {
#include "apps/lab/report/response.gp.inc"
    NULL};
static const char *const residual_gp[] = {
#include "apps/lab/report/residual.gp.inc"
    NULL};
static const char *const arguments_gp[] = {
#include "apps/lab/report/arguments.gp.inc"
    NULL};
static const char *const autocorrelation_gp[] = {
#include "apps/lab/report/autocorrelation.gp.inc"
    NULL};
static const char *const candidates_gp[] = {
#include "apps/lab/report/candidates.gp.inc"
    NULL};
static const char *const unlisted_gp[] = {
#include "apps/lab/report/unlisted.gp.inc"
    NULL};
static const char *const parameters_gp[] = {
#include "apps/lab/report/parameters.gp.inc"
    NULL};

/* What a figure is made from and where it goes. */
typedef struct drawing {
  const lab_story *story;
  const lab_evidence *evidence;
  FILE *file; /* the script */
  lab_figure *figure;
  lab_point *point; /* room for the envelope of a series */
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
  vsnprintf(d->figure->alt + used, LAB_FIGURE_TEXT - used, format, list);
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

/* What style.gp wants, then the style. */
static void put_head(const drawing *d, int height, const char *subtitle)
{
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

/* A series over time as a block of its envelope. */
static void put_series(const drawing *d, const char *block, int number, const double *value, double scale)
{
  const lab_evidence *v = d->evidence;
  const size_t n = lab_envelope(v->t, value, v->n, v->first, v->n_runs, v->t[0], v->t[v->n - 1], COLUMNS, d->point);
  put_points(d->file, block, number, d->point, n, scale);
}

static void put_time_axis(const drawing *d)
{
  const lab_evidence *v = d->evidence;
  fprintf(d->file, "T_FROM = %.6g\nT_TO = %.6g\nT_LABEL = \"Time t [s]%s\"\n", v->t[0], v->t[v->n - 1],
          v->n_runs > 1 ? ", runs one after the other" : "");
}

/* ---- Measured and predicted over time ---- */

static int draw_response(const drawing *d)
{
  const lab_evidence *v = d->evidence;
  const lab_shown u = lab_shown_as(lab_argument_unit(d->story, LAB_ARGUMENT_U));
  double low = 0, high = 0, space;
  int c;
  char name[LAB_SHOWN_TEXT], from[LAB_SHOWN_TEXT], to[LAB_SHOWN_TEXT];
  entitle(d, has_completed(d) ? "Measured, and what both models predict for the same command"
                              : "Measured, and what the model predicts for the same command");
  tell(d, "Command, measured and predicted channels over %.4g s.", v->t[v->n - 1] - v->t[0]);
  put_head(d, 270 + 205 * v->n_channels, "Each line spans all values that fall on its pixels, so that no peak is lost");
  put_time_axis(d);
  lab_range(v->argument[LAB_ARGUMENT_U], v->n, &low, &high);
  space = high > low ? 0.15 * (high - low) : 0.5;
  fprintf(d->file, "N = %d\nU_LABEL = \"Command u [%s]\"\narray LABEL[%d]\n", v->n_channels, unit_or_1(u.unit),
          v->n_channels);
  fprintf(d->file, "U_FROM = %.5g\nU_TO = %.5g\n", u.scale * (low - space), u.scale * (high + space));
  put_series(d, "command", 0, v->argument[LAB_ARGUMENT_U], u.scale);
  for (c = 0; c < v->n_channels; c++) {
    const lab_evidence_channel *mine = &v->channel[c];
    const lab_shown shown = lab_shown_as(lab_channels[mine->channel].unit);
    fprintf(d->file, "LABEL[%d] = \"%s [%s]\"\n", c + 1, channel_name(mine->channel, name), unit_or_1(shown.unit));
    if (lab_range(mine->measured, v->n, &low, &high))
      tell(d, " %s runs from %s to %s.", name, lab_shown_number(shown.scale * low, 3, from),
           lab_shown_quantity(high, lab_channels[mine->channel].unit, 3, to));
    put_series(d, "measured", c + 1, mine->measured, shown.scale);
    put_series(d, "before", c + 1, mine->predicted[LAB_STAGE_BEFORE], shown.scale);
    put_series(d, "after", c + 1, mine->predicted[LAB_STAGE_AFTER], shown.scale);
  }
  put_lines(d->file, response_gp);
  return 1;
}

/* ---- Residual over time ---- */

static double largest_of(const double *value, size_t n)
{
  double low, high;
  return lab_range(value, n, &low, &high) ? fmax(high, -low) : 0;
}

static void put_residual(const drawing *d, const lab_evidence_channel *mine, int stage, int panel)
{
  const double largest = largest_of(mine->residual[stage], d->evidence->n);
  char name[LAB_SHOWN_TEXT], noise[LAB_SHOWN_TEXT];
  fprintf(d->file, "LABEL[%d] = \"%s, %s model (1 is %s)\"\nLIMIT[%d] = %.4g\nIS_AFTER[%d] = %d\n", panel,
          channel_name(mine->channel, name), stage_name(stage),
          lab_shown_quantity(mine->sigma, lab_channels[mine->channel].unit, 3, noise), panel, fmax(4, 1.05 * largest),
          panel, stage);
  put_series(d, "residual", panel, mine->residual[stage], 1);
  tell(d, " %s, %s model: largest %.3g.", name, stage_name(stage), largest);
}

static int draw_residual(const drawing *d)
{
  const lab_evidence *v = d->evidence;
  const int panels = v->n_channels * stages_of(d);
  int i;
  entitle(d, has_completed(d) ? "What the models do not explain" : "What the model does not explain");
  tell(d, "Residual over time in units of the noise.");
  put_head(d, 135 + 150 * panels,
           "Measured less predicted, in units of the noise; 99 % of white noise lies in the band");
  put_time_axis(d);
  fprintf(d->file, "N = %d\narray LABEL[N]\narray LIMIT[N]\narray IS_AFTER[N]\n", panels);
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

/* Panels of one channel and model. */
static void put_row(const drawing *d, const axis *over, int n, const lab_evidence_channel *mine, int stage, int row)
{
  double largest = 0;
  char name[LAB_SHOWN_TEXT];
  int i;
  for (i = 0; i < n; i++) {
    lab_bin bin[BINS];
    lab_bin_means(d->evidence->argument[over[i].argument], mine->residual[stage], d->evidence->n, over[i].from,
                  over[i].to, BINS, bin);
    largest = fmax(largest, put_bins(d, row, i + 1, bin, over[i].shown.scale));
  }
  fprintf(d->file, "ROW_LABEL[%d] = \"%s, %s model\"\nLIMIT[%d] = %.4g\nIS_AFTER[%d] = %d\n", row,
          channel_name(mine->channel, name), stage_name(stage), row, 1.1 * largest, row, stage);
  tell(d, " %s, %s model: means up to %.3g.", name, stage_name(stage), largest);
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
  put_head(d, 135 + 150 * rows,
           "Its mean in bins, in units of the noise; the band is where 99 % of such means of white noise lie");
  fprintf(d->file, "ROWS = %d\nCOLUMNS = %d\narray ROW_LABEL[ROWS]\narray LIMIT[ROWS]\narray IS_AFTER[ROWS]\n", rows,
          n);
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
  fprintf(d->file, "LABEL[%d] = \"%s, %s model: p-value %s\"\nLAGS[%d] = %d\n", number,
          quantity_name(mine->channel, name), stage_name(has_completed(d)), lab_shown_p(after->p_value, p), number,
          after->lags);
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

static int draw_autocorrelation(const drawing *d)
{
  const lab_evidence *v = d->evidence;
  double low = 0, high = 0;
  int c, n = 0;
  fprintf(d->file, "array LABEL[%d]\narray LAGS[%d]\n", v->n_channels, v->n_channels);
  tell(d, "Autocorrelation of the residual over lags in rows.");
  for (c = 0; c < v->n_channels; c++)
    if (v->channel[c].whiteness[LAB_STAGE_BEFORE].lags > 0 && v->channel[c].whiteness[LAB_STAGE_AFTER].lags > 0)
      put_correlation(d, &v->channel[c], ++n, &low, &high);
  if (n == 0)
    return 0;
  entitle(d, "Does the residual remember?");
  put_head(d, 395, "Autocorrelation of the residual; white noise stays within the band, and its p-value above 0.01");
  fprintf(d->file, "N = %d\nLOWEST = %.3g\nHIGHEST = %.3g\n", n, low, high);
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
    fprintf(d->file, "%d,%.5g,%d,\"%s\"\n", ++n, c->statistic,
            is_found(result, c->effect) ? 2 : c->statistic > threshold, plain(pneu_effect_at(c->effect)->name, name));
    if (n <= 5)
      tell(d, " %s: %.3g.", name, c->statistic);
  }
  fputs("EOD\n", d->file);
  if (n == 0)
    return 0;
  entitle(d, "Which effect the residual of the declared model asks for");
  put_head(d, 185 + 26 * n,
           "Blue: added. Orange: passes the threshold, but the refits preferred another. Grey: does not pass");
  fprintf(d->file, "N = %d\nT_MIN = %g\nT_MAX = %.4g\nTHRESHOLD = %.5g\n", n, least,
          2 * fmax(threshold, result->trace.candidate[0].statistic), threshold);
  put_lines(d->file, candidates_gp);
  return 1;
}

/* ---- What has no name ---- */

enum { CYCLE_POINTS = 73 };

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

/* The curve of a term: its knots, or one cycle of it. */
static void put_term(const drawing *d, const pneu_term *term, double argument_scale, double value_scale)
{
  const int is_cycle = term->argument == PNEU_TERM_OVER_CYCLE, n = is_cycle ? CYCLE_POINTS : term->n;
  int i;
  fputs("$term << EOD\nat,value\n", d->file);
  for (i = 0; i < n; i++) {
    const double at = (double)term->from + i * (double)(term->to - term->from) / (n - 1);
    fprintf(d->file, "%.5g,%.5g\n", argument_scale * at,
            value_scale * (is_cycle ? cycle_at(term, at) : (double)term->value[i]));
  }
  fputs("EOD\n", d->file);
}

static int draw_unlisted(const drawing *d)
{
  const lab_rig *rig = &d->story->completed->rig;
  const pneu_term *term = rig->term;
  char where[LAB_WHERE_TEXT], name[LAB_SHOWN_TEXT];
  lab_shown argument, value;
  if (rig->n_terms == 0)
    return 0;
  argument = lab_shown_as(lab_term_arguments[term->argument].unit);
  value = lab_shown_as(lab_term_equations[term->equation].unit);
  entitle(d, "What has no name");
  tell(d, "It acts like %s: %s.", lab_unlisted_what(term), lab_unlisted_where(term, where));
  put_head(d, 380, "The free term that was added, fitted with everything else");
  put_term(d, term, argument.scale, value.scale);
  fprintf(d->file, "IS_TABLE = %d\nARGUMENT_LABEL = \"%s [%s]\"\nVALUE_LABEL = \"%s [%s]\"\n",
          term->argument != PNEU_TERM_OVER_CYCLE, lab_term_arguments[term->argument].key, unit_or_1(argument.unit),
          plain(lab_term_equations[term->equation].key, name), unit_or_1(value.unit));
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
  put_head(d, 200 + 36 * n,
           "A parameter that bends to stand in for a missing effect springs back when the effect is there");
  fprintf(d->file, "N = %d\n", n);
  put_lines(d->file, parameters_gp);
  return 1;
}

/* ---- All of them ---- */

static const struct {
  const char *name, *reading;
  int (*draw)(const drawing *d); /* writes a script; returns 0 if there is nothing to show */
} figures_known[LAB_FIGURE_COUNT] = {
    {"response", "Where the lines part from the grey, the model is wrong; the figure of the residual magnifies it.",
     draw_response},
    {"residual",
     "A good model leaves a carpet of even height within the band. Humps and spikes say when the model errs; the "
     "panels have scales of their own.",
     draw_residual},
    {"arguments",
     "Points outside the band say at which pressure, position, velocity or command the model errs. p, x and v are "
     "the model's own.",
     draw_arguments},
    {"autocorrelation",
     "Bars beyond the band mean that the residual follows a pattern, so that the model, or the noise "
     "that was declared, is not the whole truth. The p-value is that of Ljung and Box for all lags at once; below 0.01 "
     "the residual is not white.",
     draw_autocorrelation},
    {"candidates",
     "Many effects pass where one is missing, because their footprints overlap. Those that pass best are taken "
     "up in turn, everything is fitted again, and the best fit decides.",
     draw_candidates},
    {"unlisted",
     "Knots where the model hardly ever is are loosely known. Over a cycle, time is that of the log: its zero is the "
     "zero of t.",
     draw_unlisted},
    {"parameters", "Bars are 95 % intervals, often narrower than the point.", draw_parameters}};

/* The script of all figures, and the list of those that it draws. */
static void put_all(drawing *d, lab_figures *figures)
{
  int i;
  for (i = 0; i < LAB_FIGURE_COUNT; i++) {
    d->figure = &figures->figure[figures->n];
    memset(d->figure, 0, sizeof *d->figure);
    d->figure->name = figures_known[i].name;
    snprintf(d->figure->reading, LAB_FIGURE_TEXT, "%s", figures_known[i].reading);
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
  drawing d = {story, evidence, NULL, NULL, NULL};
  char *drawn = NULL;
  int status;
  memset(figures, 0, sizeof *figures);
  if (!(d.point = malloc(((size_t)3 * COLUMNS + (size_t)evidence->n_runs) * sizeof *d.point)))
    return lab_fail_memory(error, "the figures");
  if ((d.file = tmpfile())) {
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
  return status;
}

void lab_figures_free(lab_figures *figures)
{
  int i;
  for (i = 0; i < figures->n; i++)
    free(figures->figure[i].svg);
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

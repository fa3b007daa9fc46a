/* The figure of what has no name: the free term that was added. */
#include <math.h>

#include "../rig/rigterm.h"
#include "../trace/unlisted.h"
#include "figures_private.h"

static const char *const script[] = {
#include "apps/lab/report/page/unlisted.gp.inc"
    NULL};

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

int figure_draw_unlisted(const drawing *d)
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
  panel.name = figure_plain(lab_term_equations[term->equation].key, name);
  panel.unit = lab_shown_as(lab_term_equations[term->equation].unit).unit;
  panel.x[0] = at[0];
  panel.x[1] = at[n - 1];
  panel.y[0] = low - 0.05 * (high - low);
  panel.y[1] = high + 0.05 * (high - low);
  figure_entitle(d, "What has no name");
  figure_tell(d, "It acts like %s: %s.", lab_unlisted_what(term), lab_unlisted_where(term, where));
  figure_put_head(d, 380, 88, "The free term that was added, fitted with everything else");
  put_term(d, at, value, n);
  fputs("array TOP[1]\narray BOTTOM[1]\narray LEFT[1]\narray RIGHT[1]\n", d->file);
  figure_put_box(d, 1, &panel, 105, 205);
  figure_put_sides(d, 1, &panel, 0.1, figure_right_edge);
  read_term(d, &panel, at, value, n);
  fprintf(d->file, "IS_TABLE = %d\nLOW = %.5g\nHIGH = %.5g\nARGUMENT_LABEL = \"%s [%s]\"\nVALUE_LABEL = \"%s [%s]\"\n",
          term->argument != PNEU_TERM_OVER_CYCLE, panel.y[0], panel.y[1], panel.x_name, figure_unit_or_1(panel.x_unit),
          panel.name, figure_unit_or_1(panel.unit));
  figure_put_lines(d->file, script);
  return 1;
}

/* The figure of what has no name: the free term that was added. */
#include <math.h>

#include "../rig/rigterm.h"
#include "../trace/freeterms.h"
#include "figures_private.h"

enum { CYCLE_POINTS = 73, TERM_POINTS = CYCLE_POINTS + PNEU_TERM_KNOTS, TERM_HEIGHT = 205 };

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

int lab_figure_unlisted(const drawing *d)
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
  lab_figure_entitle(d, "What is not in the catalogue", "The free term that was added, fitted with everything else");
  lab_figure_tell(d, "It acts like %s: %s.", lab_free_term_what(term), lab_free_term_where(term, where));
  panel = lab_figure_panel(d, lab_term_equations[term->equation].key, shown.unit, TERM_HEIGHT);
  panel->x_name = lab_term_arguments[term->argument].key;
  panel->x_unit = x_shown.unit;
  panel->x = lab_figures_add_column(d->all, at, NULL, n, x_shown.scale, -1);
  lab_panel_curve(panel, LAB_KEY_TERM, term->argument == PNEU_TERM_OVER_CYCLE ? LAB_FORM_LINE : LAB_FORM_POINTS,
                  lab_figures_add_column(d->all, value, NULL, n, shown.scale, -1));
  return 1;
}

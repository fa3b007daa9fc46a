/* The figure of the valve signature: pressure over travel both ways, between the lines of spring and dry friction. */
#include <math.h>
#include <stdlib.h>

#include "figures_private.h"
#include "signature.h"

enum { HEIGHT = 300 };
static const double rests = 1e-4; /* of the stroke a second, below which a stem does not move */

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
    one[i] = inside && way * v->argument[LAB_ARGUMENT_V][i] > rests * stroke ? p[i] : (double)NAN;
  }
  lab_bin_means(x, one, v->n, -half, stroke + half, LAB_SIGNATURE_POINTS, bin);
  for (i = 0; i < LAB_SIGNATURE_POINTS; i++)
    mean[i] = bin[i].mean;
  return lab_figures_add_column(d->all, mean, NULL, LAB_SIGNATURE_POINTS, lab_format_as("Pa").scale, -1);
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
  const int stage = lab_figure_stages(d) - 1;
  if (p || d->report->rig->input[LAB_CHANNEL_P])
    put_branches(d, LAB_KEY_MEASURED, x ? x->measured : x_model, p ? p->measured : p_model, panel);
  put_branches(d, lab_figure_key(stage), x ? x->predicted[stage] : x_model, p ? p->predicted[stage] : p_model, panel);
}

static void put_lines(const drawing *d, const lab_signature_model *of, lab_panel *panel)
{
  int line;
  for (line = LAB_SIGNATURE_LINES - 1; line >= 0; line--)
    lab_panel_curve(panel, of->key, of->key == LAB_KEY_FOUND ? LAB_FORM_LINE : LAB_FORM_DASHED,
                    lab_figures_add_column(d->all, of->signature.p[line], NULL, LAB_SIGNATURE_POINTS,
                                           lab_format_as("Pa").scale, -1));
}

static void tell_lines(const drawing *d, const lab_signature_model *of)
{
  const lab_signature *s = &of->signature;
  char lower[LAB_FORMAT_TEXT], upper[LAB_FORMAT_TEXT], rate[LAB_FORMAT_TEXT], band[LAB_FORMAT_TEXT];
  lab_figure_tell(d, " %s: bench set %s to %s, spring rate %s, friction band %s.", lab_curve_keys[of->key].brief,
                  lab_format_quantity(s->bench_lower, "Pa", 4, lower),
                  lab_format_quantity(s->bench_upper, "Pa", 4, upper),
                  lab_format_quantity(s->spring_rate, "N/m", 4, rate), lab_format_quantity(s->band, "Pa", 4, band));
}

int lab_figure_signature(const drawing *d)
{
  lab_signature_model model[LAB_SIGNATURE_MODELS];
  const int n = lab_signature_models(d->report, model);
  const lab_format shown = lab_format_as("m");
  const int measured = lab_residual_table_channel(d->table, LAB_CHANNEL_P) || d->report->rig->input[LAB_CHANNEL_P];
  lab_panel *panel;
  int i;
  if (n == 0)
    return 0;
  lab_figure_entitle(
      d, "Valve signature: pressure over travel, both ways",
      measured ? "Means of moving rows; lines: the spring's pressure, and what dry friction adds either way"
               : "The model's pressure, for it was not measured; lines: the spring, and dry friction either way");
  lab_figure_tell(d, "Pressure over travel.%s", measured ? "" : " The pressure was not measured and is the model's.");
  panel = lab_figure_panel(d, "Pressure p", lab_format_as("Pa").unit, HEIGHT);
  panel->x_name = "travel x";
  panel->x_unit = shown.unit;
  panel->x = lab_figures_add_column(d->all, model[0].signature.x, NULL, LAB_SIGNATURE_POINTS, shown.scale, -1);
  put_response(d, panel);
  for (i = 0; i < n; i++)
    tell_lines(d, &model[i]);
  for (i = n - 1; i >= 0; i--) /* what is declared over what is found, which hides it where it is as declared */
    put_lines(d, &model[i], panel);
  return 1;
}

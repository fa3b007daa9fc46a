/* The figure of the residual over time. */
#include <math.h>

#include "figures_private.h"

static const char *const script[] = {
#include "apps/lab/report/page/residual.gp.inc"
    NULL};

static double largest_of(const double *value, size_t n)
{
  double low, high;
  return lab_range(value, n, &low, &high) ? fmax(high, -low) : 0;
}

static void put_residual(const drawing *d, const lab_evidence_channel *mine, int stage, int number)
{
  const double largest = largest_of(mine->residual[stage], d->evidence->n);
  lab_panel panel = figure_time_panel(d);
  char name[LAB_SHOWN_TEXT], noise[LAB_SHOWN_TEXT], title[2 * LAB_SHOWN_TEXT];
  snprintf(title, sizeof title, "%s, %s model", figure_channel_name(mine->channel, name), figure_stage_name(stage));
  panel.name = title;
  panel.unit = "× noise";
  panel.y[1] = fmax(4, 1.05 * largest);
  panel.y[0] = -panel.y[1];
  fprintf(d->file, "LABEL[%d] = \"%s (1 is %s)\"\nLIMIT[%d] = %.4g\nIS_AFTER[%d] = %d\n", number, title,
          lab_shown_quantity(mine->sigma, lab_channels[mine->channel].unit, 3, noise), number, panel.y[1], number,
          stage);
  figure_put_box(d, number, &panel, FIGURE_PANEL_TOP + FIGURE_PANEL_PITCH * (number - 1), FIGURE_PANEL_HEIGHT);
  figure_put_series(d, "residual", number, mine->residual[stage], 1);
  figure_read_series(d, lab_readings_panel(d->readings, d->figure->name, &panel, d->t), stage ? "after" : "before",
                     mine->residual[stage], 1, 2);
  figure_tell(d, " %s: largest %.3g.", title, largest);
}

int figure_draw_residual(const drawing *d)
{
  const lab_evidence *v = d->evidence;
  const int panels = v->n_channels * figure_stages(d);
  int i;
  figure_entitle(d, figure_has_completed(d) ? "What the models do not explain" : "What the model does not explain");
  figure_tell(d, "Residual over time in units of the noise.");
  figure_put_head(d, 135 + FIGURE_PANEL_PITCH * panels, 70,
                  "Measured less predicted, in units of the noise; 99 % of white noise lies in the band");
  figure_put_time_axis(d);
  fprintf(d->file, "N = %d\narray LABEL[N]\narray LIMIT[N]\narray IS_AFTER[N]\narray TOP[N]\narray BOTTOM[N]\n",
          panels);
  for (i = 0; i < panels; i++)
    put_residual(d, &v->channel[i / figure_stages(d)], i % figure_stages(d), i + 1);
  figure_put_lines(d->file, script);
  return 1;
}

/* The figure of what was measured and what both models predict, over time. */
#include <math.h>

#include "figures_private.h"

static const char *const script[] = {
#include "apps/lab/report/page/response.gp.inc"
    NULL};

enum { COMMAND_TOP = 160, COMMAND_HEIGHT = 55, CHANNEL_TOP = 255, CHANNEL_PITCH = 225, CHANNEL_HEIGHT = 180 };

/* Name, ends of the y axis and place of a panel. */
static void put_panel(const drawing *d, int number, lab_panel *panel, double top, double height)
{
  fprintf(d->file, "LABEL[%d] = \"%s [%s]\"\nLOW[%d] = %.5g\nHIGH[%d] = %.5g\n", number, panel->name,
          figure_unit_or_1(panel->unit), number, panel->y[0], number, panel->y[1]);
  figure_put_box(d, number, panel, top, height);
}

static void put_command(const drawing *d)
{
  const double *u = d->evidence->argument[LAB_ARGUMENT_U];
  const lab_shown shown = lab_shown_as(lab_argument_unit(d->story, LAB_ARGUMENT_U));
  lab_panel panel = figure_time_panel(d);
  double low = 0, high = 0, space;
  lab_range(u, d->evidence->n, &low, &high);
  space = high > low ? 0.15 * (high - low) : 1;
  panel.name = "Command u";
  panel.unit = shown.unit;
  panel.y[0] = shown.scale * (low - space);
  panel.y[1] = shown.scale * (high + space);
  put_panel(d, 1, &panel, COMMAND_TOP, COMMAND_HEIGHT);
  figure_put_series(d, "command", 0, u, shown.scale);
  figure_read_series(d, lab_readings_panel(d->readings, d->figure->name, &panel, d->t), "command", u, shown.scale,
                     lab_readings_decimals(panel.y[0], panel.y[1]));
}

/* Range of what is measured and predicted. */
static void range_of(const drawing *d, const lab_evidence_channel *mine, double *low, double *high)
{
  int stage;
  if (!lab_range(mine->measured, d->evidence->n, low, high))
    *low = *high = 0;
  for (stage = 0; stage < figure_stages(d); stage++) {
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
    figure_tell(d, " %s runs from %s to %s; rms error of the declared model %s", name,
                lab_shown_number(lab_shown_as(info->unit).scale * low, 3, from),
                lab_shown_quantity(high, info->unit, 3, to),
                lab_shown_quantity(result->before.rmse[mine->channel], info->unit, 3, from));
  if (figure_has_completed(d))
    figure_tell(d, ", of the completed one %s",
                lab_shown_quantity(result->after.rmse[mine->channel], info->unit, 3, to));
  figure_tell(d, ".");
}

static void put_channel(const drawing *d, int number, const lab_evidence_channel *mine)
{
  static const char *const key[LAB_STAGE_COUNT] = {"before", "after"};
  const lab_shown shown = lab_shown_as(lab_channels[mine->channel].unit);
  lab_panel panel = figure_time_panel(d);
  double low, high, space;
  char name[LAB_SHOWN_TEXT];
  cJSON *reading;
  int stage, decimals;
  range_of(d, mine, &low, &high);
  space = high > low ? 0.04 * (high - low) : fmax(0.1 * fabs(high), 1e-9);
  panel.name = figure_channel_name(mine->channel, name);
  panel.unit = shown.unit;
  panel.y[0] = shown.scale * (low - space);
  panel.y[1] = shown.scale * (high + space);
  put_panel(d, number + 1, &panel, CHANNEL_TOP + CHANNEL_PITCH * (number - 1), CHANNEL_HEIGHT);
  tell_channel(d, mine, name);
  decimals = lab_readings_decimals(panel.y[0], panel.y[1]);
  reading = lab_readings_panel(d->readings, d->figure->name, &panel, d->t);
  figure_put_series(d, "measured", number, mine->measured, shown.scale);
  figure_read_series(d, reading, "measured", mine->measured, shown.scale, decimals);
  for (stage = 0; stage < figure_stages(d); stage++) {
    figure_put_series(d, key[stage], number, mine->predicted[stage], shown.scale);
    figure_read_series(d, reading, key[stage], mine->predicted[stage], shown.scale, decimals);
  }
}

int figure_draw_response(const drawing *d)
{
  const lab_evidence *v = d->evidence;
  const int n = v->n_channels;
  int c;
  figure_entitle(d, figure_has_completed(d) ? "Measured, and what both models predict for the same command"
                                            : "Measured, and what the model predicts for the same command");
  figure_tell(d, "Command, measured and predicted channels over %.4g s.", v->t[v->n - 1] - v->t[0]);
  figure_put_head(d, 280 + CHANNEL_PITCH * n, 126,
                  "Each line spans all values that fall on its pixels, so that no peak is lost");
  figure_put_time_axis(d);
  fprintf(d->file, "N = %d\narray LABEL[N+1]\narray TOP[N+1]\narray BOTTOM[N+1]\narray LOW[N+1]\narray HIGH[N+1]\n", n);
  put_command(d);
  for (c = 0; c < n; c++)
    put_channel(d, c + 1, &v->channel[c]);
  figure_put_lines(d->file, script);
  return 1;
}

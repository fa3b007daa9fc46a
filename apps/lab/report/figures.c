#include "figures.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "figures_private.h"

const double lab_figure_two_sided_99 = 2.5758293035489004;

const char *const lab_figure_names[LAB_FIGURE_COUNT] = {"signature", "response",        "residual",
                                                        "arguments", "autocorrelation", "unlisted"};

/* In that order. */
static const struct {
  const char *reading;
  int (*fill)(const drawing *d);
} known[LAB_FIGURE_COUNT] = {
    {"A loop wider than its lines has more friction than dry friction, or was run fast. Green lines apart from the "
     "orange "
     "ones: a value is not as declared.",
     lab_figure_signature},
    {"Where the lines leave the grey, the model is wrong; the figure of the residual magnifies this.",
     lab_figure_response},
    {"A good model leaves an even residual within the band. Humps and spikes show when the model errs. Each panel has "
     "its own scale.",
     lab_figure_residual},
    {"Points outside the band say at which pressure, position, velocity or command the model errs. p, x and v are "
     "the model's own.",
     lab_figure_arguments},
    {"Bars beyond the band mean that the residual has a pattern, so that the model is incomplete or the declared noise "
     "is wrong. The p-value is that of the Ljung-Box test on all lags of the last model; below 0.01 the residual is "
     "not white.",
     lab_figure_autocorrelation},
    {"Knots that the model hardly reaches are uncertain. Over a cycle, time is the t of the log.",
     lab_figure_unlisted}};

/* ---- What figures have in common ---- */

void lab_figure_entitle(const drawing *d, const char *title, const char *subtitle)
{
  d->figure->title = title;
  d->figure->subtitle = subtitle;
}

void lab_figure_tell(const drawing *d, const char *format, ...)
{
  const size_t used = strlen(d->figure->alt);
  va_list list;
  va_start(list, format);
  vsnprintf(d->figure->alt + used, LAB_FIGURE_ALT - used, format, list);
  va_end(list);
}

lab_panel *lab_figure_panel(const drawing *d, const char *name, const char *unit, int height)
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

const char *lab_figure_channel_name(int channel, char text[LAB_FORMAT_TEXT])
{
  char *at;
  snprintf(text, LAB_FORMAT_TEXT, "%s %s", lab_channels[channel].quantity, lab_channels[channel].key);
  *text = (char)toupper((unsigned char)*text);
  while ((at = strchr(text, '_')))
    *at = ' ';
  return text;
}

const char *lab_figure_stage_name(int channel, int stage, char text[2 * LAB_FORMAT_TEXT])
{
  char name[LAB_FORMAT_TEXT];
  snprintf(text, 2 * LAB_FORMAT_TEXT, "%s, %s model", lab_figure_channel_name(channel, name),
           stage == LAB_STAGE_BEFORE ? "declared" : "completed");
  return text;
}

int lab_figure_has_completed(const drawing *d)
{
  return d->report->result->n_found > 0;
}

int lab_figure_stages(const drawing *d)
{
  return lab_figure_has_completed(d) ? LAB_STAGE_COUNT : 1;
}

int lab_figure_key(int stage)
{
  return stage == LAB_STAGE_BEFORE ? LAB_KEY_BEFORE : LAB_KEY_AFTER;
}

/* ---- All of them ---- */

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

int lab_figures_make(const lab_report *report, const lab_residual_table *table, lab_figures **figures, lab_error *error)
{
  drawing d = {report, table, calloc(1, sizeof **figures), NULL, calloc(table->n + 1, 1)};
  if (d.all && d.kept) {
    lab_figure_lay_out_time(&d);
    fill_all(&d);
  }
  if (d.all && (!d.kept || d.all->failed)) {
    lab_figures_free(d.all);
    d.all = NULL;
  }
  free(d.kept);
  *figures = d.all;
  return d.all ? LAB_OK : lab_fail_memory(error, "the figures");
}

void lab_figures_free(lab_figures *figures)
{
  int i;
  if (!figures)
    return;
  for (i = 0; i < figures->n_columns; i++)
    free(figures->column[i].value);
  free(figures->column);
  free(figures->first);
  free(figures->shift);
  free(figures);
}

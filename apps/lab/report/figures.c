#include "figures.h"

#include <stdlib.h>
#include <string.h>

#include "../base/gnuplot.h"
#include "../base/outfile.h"
#include "figures_private.h"

static const struct {
  const char *name, *keys, *reading;
  int (*draw)(const drawing *d); /* writes a script; returns 0 if there is nothing to show */
} figures_known[LAB_FIGURE_COUNT] = {
    {"response", "measured before after",
     "Where the lines part from the grey, the model is wrong; the figure of the residual magnifies it.",
     figure_draw_response},
    {"residual", "before after",
     "A good model leaves a carpet of even height within the band. Humps and spikes say when the model errs; the "
     "panels have scales of their own.",
     figure_draw_residual},
    {"arguments", "before after band",
     "Points outside the band say at which pressure, position, velocity or command the model errs. p, x and v are "
     "the model's own.",
     figure_draw_arguments},
    {"autocorrelation", "before after band",
     "Bars beyond the band mean that the residual follows a pattern, so that the model, or the noise that was "
     "declared, is not the whole truth. The p-value is that of Ljung and Box for all lags of the last model at once; "
     "below 0.01 the residual is not white.",
     figure_draw_autocorrelation},
    {"candidates", "",
     "Many effects pass where one is missing, because their footprints overlap. Those that pass best are taken "
     "up in turn, everything is fitted again, and the best fit decides. If nothing were missing, T would be chi-square "
     "with 1 degree of freedom.",
     figure_draw_candidates},
    {"unlisted", "",
     "Knots where the model hardly ever is are loosely known. Over a cycle, time is that of the log: its zero is the "
     "zero of t.",
     figure_draw_unlisted},
    {"parameters", "before after", "Bars are 95 % intervals, often narrower than the point.", figure_draw_parameters}};

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
  d.point = malloc(((size_t)3 * FIGURE_COLUMNS + (size_t)evidence->n_runs) * sizeof *d.point);
  d.kept = calloc(evidence->n + 1, 1);
  d.clock = malloc((evidence->n + 1) * sizeof *d.clock);
  if (!d.point || !d.kept || !d.clock) {
    status = lab_fail_memory(error, "the figures");
  } else if ((d.file = tmpfile())) {
    figure_keep_rows(&d);
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

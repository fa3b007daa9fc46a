#include "figures.h"

#include <math.h>
#include <stdlib.h>

const lab_curve_key lab_curve_keys[LAB_KEYS] = {
    {"band", "99 % of white noise", "99 % of noise", "sand", "#DDD5B0", 0},
    {"command", "", "", "grey", "#767676", 1.5},
    {"measured", "measured", "measured", "wide", "#C4C4C4", 6},
    {"before", "declared model, fitted", "declared", "vermillion", "#D55E00", 1.5},
    {"after", "completed model", "completed", "blue", "#0072B2", 1.5},
    {"term", "", "", "blue", "#0072B2", 1.5},
    {"sheet", "as declared", "declared", "orange", "#E69F00", 1.5},
    {"found", "as found", "found", "green", "#009E73", 1.5},
    {"baseline", "as it was", "baseline", "purple", "#CC79A7", 1.5}};

const lab_curve_form lab_curve_forms[LAB_FORMS] = {{"line", "lines"},    {"dashed", "lines dt (7,3)"},
                                                   {"steps", "steps"},   {"points", "linespoints pt 7 ps 0.4"},
                                                   {"bars", "impulses"}, {"band", "filledcurves"}};

static const double steps = 5000; /* at least, that a range is divided into */

static int decimals_of(const lab_figure_column *c)
{
  double low, high, range;
  if (!lab_range(c->value, c->n, &low, &high))
    return 0;
  range = high > low ? high - low : fabs(high);
  return range > 0 ? (int)fmin(fmax(ceil(log10(steps / range)), 0), 12) : 0;
}

int lab_figures_add_column(lab_figures *figures, const double *value, const unsigned char *keep, size_t n, double scale,
                           int decimals)
{
  lab_figure_column *all = realloc(figures->column, (size_t)(figures->n_columns + 1) * sizeof *all);
  lab_figure_column c = {0, decimals, malloc((n + 1) * sizeof(double))};
  size_t i;
  figures->column = all ? all : figures->column;
  if (!all || !c.value) {
    free(c.value);
    figures->failed = 1;
    return 0;
  }
  for (i = 0; i < n; i++)
    if (!keep || keep[i])
      c.value[c.n++] = scale * value[i];
  if (decimals < 0)
    c.decimals = decimals_of(&c);
  all[figures->n_columns] = c;
  return figures->n_columns++;
}

void lab_figures_free(lab_figures *figures)
{
  int i;
  if (!figures)
    return;
  for (i = 0; i < figures->n_columns; i++)
    free(figures->column[i].value);
  free(figures->column);
  lab_residual_table_free(&figures->table);
  free(figures);
}

void lab_panel_curve(lab_panel *panel, int key, int form, int y)
{
  panel->curve[panel->n_curves++] = (lab_curve){key, form, y};
}

const lab_curve *lab_figure_curve(const lab_figure *figure, int key)
{
  int i, c;
  for (i = 0; i < figure->n; i++)
    for (c = 0; c < figure->panel[i].n_curves; c++)
      if (figure->panel[i].curve[c].key == key)
        return &figure->panel[i].curve[c];
  return NULL;
}

/* ---- JSON: all its texts are words of this program ---- */

/* "10000,3,,-2" */
static void put_differences(FILE *file, const lab_figure_column *column)
{
  const double scale = pow(10, column->decimals);
  long long last = 0;
  size_t i;
  for (i = 0; i < column->n; i++) {
    const long long now = isfinite(column->value[i]) ? llround(scale * column->value[i]) : last;
    fprintf(file, isfinite(column->value[i]) ? "%s%lld" : "%s", i > 0 ? "," : "", now - last);
    last = now;
  }
}

static void put_panel(FILE *file, const lab_panel *panel)
{
  int c;
  fprintf(file, "{\"name\":\"%s\",\"unit\":\"%s\",\"x_name\":\"%s\",\"x_unit\":\"%s\",\"height\":%d,", panel->name,
          panel->unit, panel->x_name, panel->x_unit, panel->height);
  fprintf(file, "\"reach\":%.4g,\"x\":%d,\"curves\":[", panel->reach, panel->x);
  for (c = 0; c < panel->n_curves; c++)
    fprintf(file, "%s{\"key\":\"%s\",\"form\":\"%s\",\"y\":%d}", c > 0 ? "," : "",
            lab_curve_keys[panel->curve[c].key].name, lab_curve_forms[panel->curve[c].form].name, panel->curve[c].y);
  fputs("]}", file);
}

void lab_figures_json(const lab_figures *figures, FILE *file)
{
  const lab_figure *figure = figures->figure;
  int i, k;
  for (i = 0; i < figures->n_columns; i++) {
    fprintf(file, "%s{\"k\":%d,\"d\":\"", i > 0 ? "," : "{\"columns\":[", figures->column[i].decimals);
    put_differences(file, &figures->column[i]);
    fputs("\"}", file);
  }
  fprintf(file, "],\"t\":%d,\"runs\":[", figures->t);
  for (i = 0; i < figures->n_runs; i++)
    fprintf(file, "%s{\"entry\":%zu,\"shift\":%.15g}", i > 0 ? "," : "", figures->first[i], figures->shift[i]);
  for (k = 0; k < LAB_KEYS; k++)
    fprintf(file, "%s\"%s\":{\"brief\":\"%s\",\"colour\":\"%s\",\"width\":%g}", k > 0 ? "," : "],\"keys\":{",
            lab_curve_keys[k].name, lab_curve_keys[k].brief, lab_curve_keys[k].colour, lab_curve_keys[k].width);
  fputs("},\"panels\":{", file);
  for (i = 0; i < figures->n; i++, figure++) {
    fprintf(file, "%s\"%s\":[", i > 0 ? "," : "", figure->name);
    for (k = 0; k < figure->n; k++) {
      fputs(k > 0 ? "," : "", file);
      put_panel(file, &figure->panel[k]);
    }
    fputc(']', file);
  }
  fputs("}}", file);
}

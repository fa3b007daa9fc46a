/* Figures as SVG, by one gnuplot: a script of panels, with their data, in the style of the study. */
#include "figures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/gnuplot.h"

#include "study/figures/style.gp.inc" /* style_gp; made by make */

/* Places in the drawing: of the first panel, above each, of the axis below; sides as shares of the width. */
enum { TOP = 95, KEY = 25, ABOVE = 45, AXIS = 40 };
static const double left_edge = 0.085, right_edge = 0.985, share_of_side = 0.86;

typedef struct script {
  FILE *file;
  const lab_figures *all;
  const lab_figure *figure;
  lab_point *point; /* room for an envelope */
  int height;
} script;

/* ---- A script ---- */

/* Whether no panel below has the same abscissa. */
static int has_axis(const lab_figure *figure, int i)
{
  return i + figure->across >= figure->n ||
         strcmp(figure->panel[i].x_name, figure->panel[i + figure->across].x_name) != 0;
}

static int head_of(const lab_figure *figure)
{
  int key, lines = 0;
  for (key = 0; key < LAB_KEYS; key++)
    lines += *lab_curve_keys[key].label && lab_figure_curve(figure, key);
  return TOP + KEY * ((lines + 1) / 2);
}

static int height_of(const lab_figure *figure)
{
  int i, height = head_of(figure);
  for (i = 0; i < figure->n; i += figure->across)
    height += figure->panel[i].height + ABOVE + (has_axis(figure, i) ? AXIS : 0);
  return height;
}

static void put_look(const script *s, const lab_curve *curve)
{
  const lab_curve_key *key = &lab_curve_keys[curve->key];
  if (curve->form == LAB_FORM_BAND)
    fprintf(s->file, "with filledcurves fc rgb \"%s\"", key->rgb);
  else
    fprintf(s->file, "with %s lw %g lc rgb \"%s\"", lab_curve_forms[curve->form].with,
            curve->form == LAB_FORM_BARS ? 4 : key->width, key->rgb);
}

/* Heading and key, over all panels. */
static void put_head(const script *s)
{
  const char *const *line;
  int key;
  fprintf(s->file, "reset\nNAME = \"%s\"\nHEIGHT = %d\nTITLE = \"%s\"\nSUBTITLE = \"%s\"\n", s->figure->name, s->height,
          s->figure->title, s->figure->subtitle);
  for (line = style_gp; *line; line++)
    fputs(*line, s->file);
  fputs("NICE(x, p) = p * (x < 1.5 * p ? 1 : x < 3.5 * p ? 2 : x < 7.5 * p ? 5 : 10)\n"
        "set termoption noenhanced\nset multiplot\n@BLANK\n@KEY width 1\nplot [0:1][0:1] NaN notitle",
        s->file);
  for (key = 0; key < LAB_KEYS; key++) {
    const lab_curve *curve = lab_figure_curve(s->figure, key);
    if (!curve || !*lab_curve_keys[key].label)
      continue;
    fputs(", NaN ", s->file);
    put_look(s, curve);
    fprintf(s->file, " title \"%s\"", lab_curve_keys[key].label);
  }
  fputs("\n@FRAME\n", s->file);
}

/* A curve as a block of data: its envelope. */
static void put_data(const script *s, const lab_panel *panel, int number)
{
  const lab_figure_column *x = &s->all->column[panel->x], *y = &s->all->column[panel->curve[number].y];
  const double ends[] = {x->value[0], x->value[x->n - 1]}, level[] = {*y->value, *y->value};
  const lab_line flat = {2, ends, level, 0, NULL},
                 curve = {x->n, x->value, y->value, panel->x == s->all->t ? s->all->n_runs : 0, s->all->first};
  const size_t n = lab_envelope(y->n == 1 ? &flat : &curve, LAB_FIGURE_COLUMNS, s->point);
  size_t i;
  fprintf(s->file, "$curve_%d << EOD\nx,y\n", number);
  for (i = 0; i < n; i++)
    if (isnan(s->point[i].value))
      fputc('\n', s->file);
    else
      fprintf(s->file, "%.6g,%.5g\n", s->point[i].at, s->point[i].value);
  fputs("EOD\n", s->file);
}

static void put_place(const script *s, int i, double top)
{
  const lab_figure *figure = s->figure;
  const double side = (right_edge - left_edge) / figure->across, left = left_edge + side * (i % figure->across);
  fprintf(s->file, "set lmargin at screen %.5f\nset rmargin at screen %.5f\n", left,
          left + side * (figure->across > 1 ? share_of_side : 1));
  fprintf(s->file, "set tmargin at screen %.5f\nset bmargin at screen %.5f\n", 1 - top / s->height,
          1 - (top + figure->panel[i].height) / s->height);
}

/* "Pressure p [kPa]" */
static const char *in_brackets(const char *name, const char *unit, char text[3 * LAB_FORMAT_TEXT])
{
  snprintf(text, 3 * LAB_FORMAT_TEXT, *unit ? "%s [%s]" : "%s", name, unit);
  return text;
}

/* Ends of the axis of what is drawn, so that nothing touches them. */
static void range_of(const script *s, const lab_panel *panel, double *from, double *to)
{
  double low = HUGE_VAL, high = -HUGE_VAL, least, most;
  int c;
  for (c = 0; c < panel->n_curves; c++) {
    const lab_figure_column *y = &s->all->column[panel->curve[c].y];
    if (!lab_range(y->value, y->n, &least, &most))
      continue;
    low = fmin(low, panel->curve[c].form == LAB_FORM_BAND ? -most : least);
    high = fmax(high, most);
  }
  *from = panel->reach > 0 ? -panel->reach : low < high ? low - 0.05 * (high - low) : low - 1;
  *to = panel->reach > 0 ? panel->reach : low < high ? high + 0.05 * (high - low) : low + 1;
}

/* Range of an axis, with about so many tics. */
static void put_axis(FILE *file, char which, double from, double to, double tics)
{
  const double step = (to - from) / tics;
  fprintf(file, "set %crange [%.6g:%.6g]\nset %ctics NICE(%g, %g)\n", which, from, to, which, step,
          pow(10, floor(log10(step))));
}

static void put_axes(const script *s, int i)
{
  const lab_panel *panel = &s->figure->panel[i];
  const lab_figure_column *x = &s->all->column[panel->x];
  const int same = i % s->figure->across > 0 && !strcmp(panel->name, panel[-1].name);
  double from, to;
  char text[3 * LAB_FORMAT_TEXT];
  if (!same)
    fprintf(s->file, "set label 1 \"%s\" @ABOVE\n", in_brackets(panel->name, panel->unit, text));
  put_axis(s->file, 'x', x->value[0], fmax(x->value[x->n - 1], x->value[0] + 1e-9), s->figure->across > 2 ? 3 : 6);
  range_of(s, panel, &from, &to);
  put_axis(s->file, 'y', from, to, panel->height / 35.0);
  fprintf(s->file, "set format y \"%s\"\n", panel->reach > 0 && same ? "" : "%g");
  if (has_axis(s->figure, i))
    fprintf(s->file, "set format x \"%%g\"\nset xlabel \"%s\"\n", in_brackets(panel->x_name, panel->x_unit, text));
  else
    fputs("set format x \"\"\nunset xlabel\n", s->file);
}

static void put_panel(const script *s, int i, double top)
{
  const lab_panel *panel = &s->figure->panel[i];
  double low, high;
  int c, drawn = 0;
  fputs("@NEXT\n", s->file);
  for (c = 0; c < panel->n_curves; c++)
    put_data(s, panel, c);
  put_place(s, i, top);
  put_axes(s, i);
  for (c = 0; c < panel->n_curves; c++) {
    const lab_figure_column *y = &s->all->column[panel->curve[c].y];
    if (!lab_range(y->value, y->n, &low, &high)) /* what a model that cannot be followed would have shown */
      continue;
    fprintf(s->file, "%s $curve_%d using \"x\":%s\"y\" ", drawn++ ? "," : "plot", c,
            panel->curve[c].form == LAB_FORM_BAND ? "(-column(\"y\")):" : "");
    put_look(s, &panel->curve[c]);
    fputs(" notitle", s->file);
  }
  fputc('\n', s->file);
}

static void put_figure(const script *s)
{
  const lab_figure *figure = s->figure;
  double top = head_of(figure);
  int i;
  put_head(s);
  for (i = 0; i < figure->n; i++) {
    put_panel(s, i, top);
    if ((i + 1) % figure->across == 0)
      top += figure->panel[i].height + ABOVE + (has_axis(figure, i) ? AXIS : 0);
  }
  fputs("unset multiplot\n", s->file);
}

/* ---- Files ---- */

/* Draw one.
 * Out:     done  0 if there is no gnuplot */
static int draw(const lab_figures *all, const lab_figure *figure, const char *path, int *done, lab_error *error)
{
  script s = {tmpfile(), all, figure,
              malloc(((size_t)3 * LAB_FIGURE_COLUMNS + (size_t)all->n_runs) * sizeof(lab_point)), height_of(figure)};
  int status = s.point ? LAB_OK : lab_fail_memory(error, "the figures");
  if (!s.file)
    status = lab_fail(error, LAB_WORLD, "no room for the script of the figures in the folder of temporary files");
  if (status == LAB_OK) {
    put_figure(&s);
    status = lab_gnuplot_run(s.file, path, done, error);
  }
  if (s.file)
    fclose(s.file);
  free(s.point);
  return status;
}

int lab_figures_draw(const lab_figures *figures, const char *folder, int demanded, lab_error *error)
{
  char path[LAB_PATH_TEXT + 32];
  int i, next = 0, status = LAB_OK;
  for (i = 0; i < LAB_FIGURE_COUNT && status == LAB_OK; i++) {
    const lab_figure *figure = figures && next < figures->n ? &figures->figure[next] : NULL;
    int done = 0;
    snprintf(path, sizeof path, "%s/%s.svg", folder, lab_figure_names[i]);
    if (figure && !strcmp(figure->name, lab_figure_names[i])) {
      status = draw(figures, figure, path, &done, error);
      next++;
      if (status == LAB_OK && !done && demanded)
        status = lab_fail(error, LAB_WORLD,
                          "gnuplot is not installed; install it (Debian: gnuplot-nox), or leave out --figures");
    }
    if (status == LAB_OK && !done) { /* an earlier run may have left it */
      remove(path);
      remove(strcat(path, ".part"));
    }
  }
  return status;
}

/* The figures of a run of closeloop as data: panels of curves, from which the page and gnuplot draw; the same bytes for
 * the same numbers.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_FIGURES_H
#define LAB_FIGURES_H

#include <stdio.h>

#include "../base/array.h"
#include "../base/format.h"
#include "reduce.h"
#include "residual_table.h"

/* What a curve is of: row of lab_curve_keys. */
enum lab_curve_key_id {
  LAB_KEY_BAND,
  LAB_KEY_COMMAND,
  LAB_KEY_MEASURED,
  LAB_KEY_BEFORE, /* this and the next one in the order of enum lab_stage */
  LAB_KEY_AFTER,
  LAB_KEY_TERM,
  LAB_KEY_SHEET,
  LAB_KEY_FOUND,
  LAB_KEY_BASELINE,
  LAB_KEYS
};

typedef struct lab_curve_key {
  const char *name;   /* "before" */
  const char *label;  /* what its switch is called; "": it has none */
  const char *brief;  /* beside a value */
  const char *colour; /* of the page's style: --f-blue is "blue" */
  const char *rgb;    /* the same on paper */
  double width;       /* of a line */
} lab_curve_key;
extern const lab_curve_key lab_curve_keys[LAB_KEYS];

/* How a curve is drawn: row of lab_curve_forms. */
enum lab_curve_form_id {
  LAB_FORM_LINE,
  LAB_FORM_DASHED,
  LAB_FORM_STEPS,
  LAB_FORM_POINTS, /* and a line through them */
  LAB_FORM_BARS,   /* from 0 */
  LAB_FORM_BAND,   /* from -y to y */
  LAB_FORMS
};
typedef struct lab_curve_form {
  const char *name; /* for the page's script */
  const char *with; /* for gnuplot */
} lab_curve_form;
extern const lab_curve_form lab_curve_forms[LAB_FORMS];

/* Values of a curve, or of its abscissa, in the units that are shown; NaN: none. A single one holds everywhere. */
typedef struct lab_figure_column {
  size_t n;
  int decimals; /* that are told */
  double *value;
} lab_figure_column;

typedef struct lab_curve {
  int key, form, y; /* y: its column */
} lab_curve;

enum { LAB_FIGURE_COLUMNS = 360 /* of the envelope of a curve over time */ };
enum { LAB_PANEL_CURVES = 13, LAB_FIGURE_PANELS = 2 * LAB_CHANNEL_COUNT * LAB_ARGUMENT_COUNT };

typedef struct lab_panel {
  char name[2 * LAB_FORMAT_TEXT];
  const char *unit;
  const char *x_name, *x_unit; /* panels of one x_name, also of other figures, are read at the same x */
  int height;                  /* where the figure is 820 wide */
  double reach;                /* the axis is from -reach to reach; 0: as its curves want it */
  int x, n_curves;             /* x: column of the abscissa, growing */
  lab_curve curve[LAB_PANEL_CURVES];
} lab_panel;

enum { LAB_FIGURE_COUNT = 6, LAB_FIGURE_ALT = 1024 };
extern const char *const lab_figure_names[LAB_FIGURE_COUNT];

typedef struct lab_figure {
  const char *name;             /* of its file, without the ending */
  const char *title, *subtitle; /* what it says; what is drawn */
  const char *reading;          /* how to read it */
  char alt[LAB_FIGURE_ALT];     /* its numbers in words, for who cannot see it */
  int across;                   /* panels side by side, row by row */
  int n;
  lab_panel panel[LAB_FIGURE_PANELS];
} lab_figure;

/* The rows of a report, and its figures; those for which there is nothing to show are left out. */
typedef struct lab_figures {
  lab_residual_table table;
  int n;
  lab_figure figure[LAB_FIGURE_COUNT];
  int n_columns;
  lab_figure_column *column;
  int t; /* column of time, on whose axis runs follow each other */
  int n_runs;
  size_t first[LAB_RUNS_MAX]; /* of each run: the entry of time with which it begins */
  double shift[LAB_RUNS_MAX]; /* [s] and by how much the axis has it later than its log */
  int failed;                 /* without memory */
} lab_figures;

/* Add a column: scale * value of the rows that are kept.
 * In:      keep      n; NULL: all rows
 *          decimals  that are told; -1: as many as give the range some thousand steps
 * Returns: its number. */
int lab_figures_add_column(lab_figures *figures, const double *value, const unsigned char *keep, size_t n, double scale,
                           int decimals);

void lab_panel_curve(lab_panel *panel, int key, int form, int y);

/* The curve that a panel's key has in a figure, NULL if it has none. */
const lab_curve *lab_figure_curve(const lab_figure *figure, int key);

/* Write them for the page's script:
 *
 *   {"columns": [{"k": 2, "d": "10000,3,,-2"}], "t": 0, "runs": [{"entry": 0, "shift": 0}],
 *    "keys": {"before": {"brief": "declared", "colour": "vermillion", "width": 1.5}},
 *    "panels": {"response": [{"name": "Pressure p", "unit": "kPa", "x_name": "t", "x_unit": "s", "height": 180,
 *      "reach": 0, "x": 0, "curves": [{"key": "measured", "form": "line", "y": 1}]}]}}
 *
 * A column is a list of whole numbers, each the difference from the one before, in units of 10^-k; empty for none. */
void lab_figures_json(const lab_figures *figures, FILE *file);

/* What there is to show row by row and to draw.
 * Out:     figures  to be freed with lab_figures_free; NULL after an error
 * Returns: LAB_OK, LAB_NUMERIC, LAB_WORLD. */
int lab_figures_make(const lab_report *report, lab_figures **figures, lab_error *error);
void lab_figures_free(lab_figures *figures);

/* Draw each into a folder as <name>.svg, whole or not at all, by gnuplot; those that an earlier run has left there go.
 * In:      figures   NULL: none
 *          demanded  whether it is an error if there is no gnuplot; else none is drawn
 * Returns: LAB_OK; LAB_WORLD if gnuplot fails or a file cannot be written. */
int lab_figures_draw(const lab_figures *figures, const char *folder, int demanded, lab_error *error);

/* ---- Valve signature: the pressures that balance the stem over its travel, in either direction ---- */

enum { LAB_SIGNATURE_POINTS = 51 };

/* Lines of a signature: the stem is about to move down, has no dry friction, is about to move up. */
enum lab_signature_line { LAB_SIGNATURE_DOWN, LAB_SIGNATURE_SPRING, LAB_SIGNATURE_UP, LAB_SIGNATURE_LINES };

typedef struct lab_signature {
  double x[LAB_SIGNATURE_POINTS];                      /* [m] from stop to stop */
  double p[LAB_SIGNATURE_LINES][LAB_SIGNATURE_POINTS]; /* [Pa] gauge */
  double bench_lower, bench_upper;                     /* [Pa] bench set: of the spring alone at either stop */
  double spring_rate;                                  /* [N/m] mean over the stroke, as the pressure shows it */
  double band;                                         /* [Pa] between up and down at mid travel */
} lab_signature;

/* The signature of a rig, with what its effects and free terms do to forces at rest; a force that builds up over
 * travel, such as spring_hysteresis, is left out. Returns: LAB_OK; LAB_DATA for a parameter out of bounds or a vessel,
 * which has none. */
int lab_signature_make(const lab_rig *rig, lab_signature *signature, lab_error *error);

/* The rigs of a report that have a signature: as declared, as found, and as the baseline has it, if there is one.
 * Out:     model
 * Returns: their number. */
enum { LAB_SIGNATURE_MODELS = 3 };
typedef struct lab_signature_model {
  int key; /* enum lab_curve_key_id */
  const lab_rig *rig;
  lab_signature signature;
} lab_signature_model;
int lab_signature_models(const lab_report *report, lab_signature_model model[LAB_SIGNATURE_MODELS]);

#endif

/* What the files of the figures share. Each figure has a file and, of the same name in page/, the end of its script for
 * gnuplot; what that wants to know is put before it.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_FIGURES_PRIVATE_H
#define LAB_FIGURES_PRIVATE_H

#include <stdio.h>

#include "../base/shown.h"
#include "figures.h"
#include "readings.h"
#include "reduce.h"

enum {
  FIGURE_WIDTH = 820,
  FIGURE_COLUMNS = 360, /* of an envelope */
  /* of panels one below the other, in units of the drawing: of the first, from one to the next, of each */
  FIGURE_PANEL_TOP = 105,
  FIGURE_PANEL_PITCH = 150,
  FIGURE_PANEL_HEIGHT = 105
};
extern const double figure_right_edge;   /* of a panel, of the width */
extern const double figure_two_sided_99; /* standard deviations */

/* What a figure is made from and where it goes. */
/* What a figure is made from and where it goes. */
typedef struct drawing {
  const lab_story *story;
  const lab_evidence *evidence;
  FILE *file; /* the script */
  lab_figure *figure;
  lab_point *point;    /* room for the envelope of a series */
  cJSON *readings;     /* what can be read off by pointing */
  unsigned char *kept; /* for each row, whether its values can */
  double *clock;       /* time of each row in its log */
  int t;               /* column of the readings: time */
} drawing;

/* ---- Text ---- */

/* Only what gnuplot's enhanced text takes as it stands: "chamber_leak" is "chamber leak". */
const char *figure_plain(const char *name, char text[LAB_SHOWN_TEXT]);

/* "Pressure" */
const char *figure_quantity_name(int channel, char text[LAB_SHOWN_TEXT]);

/* "Pressure p" */
const char *figure_channel_name(int channel, char text[LAB_SHOWN_TEXT]);

const char *figure_unit_or_1(const char *unit);

void figure_entitle(const drawing *d, const char *title);

/* Append to the words for those who cannot see the figure. */
void figure_tell(const drawing *d, const char *format, ...) LAB_PRINTF(2, 3);

/* ---- Models ---- */

int figure_has_completed(const drawing *d);

/* Both models, or the declared one alone where nothing was added. */
int figure_stages(const drawing *d);
const char *figure_stage_name(int stage);

/* ---- Pieces of a script ---- */

/* Lines up to NULL. */
void figure_put_lines(FILE *file, const char *const *line);

/* What style.gp wants, then the style.
 * In:      head  height of title, subtitle and key, which a page has in words of its own */
void figure_put_head(const drawing *d, int height, int head, const char *subtitle);

/* The place of a panel, in units of the drawing; also for the script. */
void figure_put_box(const drawing *d, int number, lab_panel *panel, double top, double height);

/* The place across, as shares of the width. */
void figure_put_sides(const drawing *d, int number, lab_panel *panel, double left, double right);

/* Left side of the i-th of n panels side by side. */
double figure_side(int i, int n);

/* ---- Series over time ---- */

/* Rows that a curve over time goes through: so the peaks are among them. They are what can be read off. */
void figure_keep_rows(drawing *d);

/* A panel over time, but for its place and what it shows. */
lab_panel figure_time_panel(const drawing *d);

void figure_put_time_axis(const drawing *d);

/* A series over time as a block of its envelope. */
void figure_put_series(const drawing *d, const char *block, int number, const double *value, double scale);

/* The same as a curve of a panel of the readings. */
void figure_read_series(const drawing *d, cJSON *panel, const char *key, const double *value, double scale,
                        int decimals);

/* ---- Figures ---- */

/* Each writes a script.  Returns: 0 if there is nothing to show */
int figure_draw_response(const drawing *d);
int figure_draw_residual(const drawing *d);
int figure_draw_arguments(const drawing *d);
int figure_draw_autocorrelation(const drawing *d);
int figure_draw_candidates(const drawing *d);
int figure_draw_unlisted(const drawing *d);
int figure_draw_parameters(const drawing *d);

#endif

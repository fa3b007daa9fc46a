/* What the files of the figures share: each function of a figure fills in its panels.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_FIGURES_PRIVATE_H
#define LAB_FIGURES_PRIVATE_H

#include "figures.h"
#include "reduce.h"

enum { FIGURE_COLUMNS = 360 /* of an envelope */ };
extern const double lab_figure_two_sided_99; /* standard deviations */

/* What a figure is made from and where it goes. */
typedef struct drawing {
  const lab_report *report;
  const lab_residual_table *table;
  lab_figures *all;
  lab_figure *figure;
  unsigned char *kept; /* for each row, whether curves over time have it */
} drawing;

void lab_figure_entitle(const drawing *d, const char *title, const char *subtitle);

/* Append to the words for those who cannot see the figure. */
void lab_figure_tell(const drawing *d, const char *format, ...) LAB_PRINTF(2, 3);

/* A panel more, over time, without curves. */
lab_panel *lab_figure_panel(const drawing *d, const char *name, const char *unit, int height);

/* "Pressure p" */
const char *lab_figure_channel_name(int channel, char text[LAB_FORMAT_TEXT]);

/* "Pressure p, declared model" */
const char *lab_figure_stage_name(int channel, int stage, char text[2 * LAB_FORMAT_TEXT]);

int lab_figure_has_completed(const drawing *d);

/* Both models, or the declared one alone where nothing was added. */
int lab_figure_stages(const drawing *d);

/* The key of what is of a model. */
int lab_figure_key(int stage);

/* Choose the rows that curves over time go through, so that no peak is lost, and lay out time. */
void lab_figure_lay_out_time(const drawing *d);

/* Each returns 0 if there is nothing to show. */
int lab_figure_signature(const drawing *d);
int lab_figure_response(const drawing *d);
int lab_figure_residual(const drawing *d);
int lab_figure_arguments(const drawing *d);
int lab_figure_autocorrelation(const drawing *d);
int lab_figure_unlisted(const drawing *d);

#endif

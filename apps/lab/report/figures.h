/* Figures of a run of closeloop: SVG, all drawn by one gnuplot, the same bytes for the same numbers.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_FIGURES_H
#define LAB_FIGURES_H

#include <cjson/cJSON.h>

#include "evidence.h"

enum { LAB_FIGURE_COUNT = 7, LAB_FIGURE_TEXT = 512, LAB_FIGURE_ALT = 1024 };

typedef struct lab_figure {
  const char *name;               /* of its file, without the ending; also of what is inside the SVG */
  char title[LAB_FIGURE_TEXT];    /* what it says */
  char subtitle[LAB_FIGURE_TEXT]; /* what is drawn */
  const char *keys;               /* of its curves, which have them as titles in the SVG: "measured before after" */
  const char *reading;            /* how to read it */
  char alt[LAB_FIGURE_ALT];       /* its numbers in words, for who cannot see it */
  int head;                       /* height that title, subtitle and key take at the top of the drawing */
  char *svg;                      /* a whole file */
} lab_figure;

/* Figures for which there is nothing to show are left out. */
typedef struct lab_figures {
  int n;
  lab_figure figure[LAB_FIGURE_COUNT];
  cJSON *readings; /* readings.h */
} lab_figures;

/* Draw.
 * Out:     figures  to be freed with lab_figures_free, also after an error
 * Returns: LAB_OK; LAB_WORLD if gnuplot is not there or fails. */
int lab_figures_draw(const lab_story *story, const lab_evidence *evidence, lab_figures *figures, lab_error *error);
void lab_figures_free(lab_figures *figures);

/* Write each into a folder, whole or not at all.  Returns: LAB_OK, LAB_WORLD. */
int lab_figures_write(const lab_figures *figures, const char *folder, lab_error *error);

/* The figure of a name.  Returns: NULL if there is none. */
const lab_figure *lab_figures_find(const lab_figures *figures, const char *name);

#endif

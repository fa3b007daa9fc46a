/* What closeloop writes: report.json, report.html, model.cfg, model.h, effects.def, residual.csv.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_REPORT_H
#define LAB_REPORT_H

#include <stdio.h>

#include <cjson/cJSON.h>

#include "../fit/deviations.h"
#include "../trace/search.h"
#include "../change/change.h"
#include "../metrics/metrics.h"
#include "../base/outfile.h"
#include "../base/limitations.h"
#include "../discriminate/discriminate.h"

enum { LAB_REPORT_HOLDOUTS = 32 };

/* A log that was held out. */
typedef struct lab_holdout_log {
  const char *name;
  lab_errors before, after; /* of the declared and of the completed model */
} lab_holdout_log;

/* Everything that there is to say about a run. */
typedef struct lab_report {
  const lab_rig *rig;            /* as declared */
  const lab_unknowns *declared;  /* fitted, without added effects */
  const lab_unknowns *completed; /* fitted, with them */
  const lab_search_result *result;
  const lab_changes *changes; /* since the baseline; NULL: there is none */
  int has_holdout;
  lab_errors holdout_before, holdout_after;
  lab_errors holdout_path[LAB_SEARCH_PATH];  /* of result->path */
  int n_held;                                /* logs held out */
  lab_holdout_log held[LAB_REPORT_HOLDOUTS]; /* each by itself */
  lab_advice separate[LAB_EFFECTS_MAX];      /* of each found effect from the first that looks like it */
  lab_metrics *measured, *predicted;         /* figures of merit of the runs fitted; NULL: not made */
  lab_advice next;                           /* the test that would tell most, where no effects are alike */
  double fit_s, trace_s, total_s;            /* [s] on the clock; trace_s: the scan of all effects */
  const lab_limitations *limitations;        /* what limits the conclusions; NULL: nothing */
  lab_deviations deviations;                 /* of the declared values */
  const lab_rig *baseline;                   /* as the rig was; NULL: unknown */
} lab_report;

/* What the files of an answer are written from. */
typedef struct lab_sources {
  const lab_report *report;
  const struct lab_figures *figures; /* and rows; NULL where only report.json and the model are written */
} lab_sources;

/* Write a file that has been opened; errors of the stream are left to lab_out_close.
 * Returns: LAB_OK, LAB_WORLD without memory. */
typedef int lab_report_writer(FILE *file, const lab_sources *from, lab_error *error);

lab_report_writer lab_report_json, lab_report_model, lab_report_header, lab_report_catalogue;
lab_report_writer lab_report_residual; /* residual.csv: every row fitted, beside what both models make of it */
lab_report_writer lab_report_html;     /* a page that needs nothing else, figures inside */

/* Write one of them into a folder, whole or not at all.  Returns: LAB_OK; LAB_DATA for a path too long; LAB_WORLD. */
int lab_report_file(const char *folder, const char *name, lab_report_writer *write, const lab_sources *from,
                    lab_error *error);

/* The path of a file in a folder, in a text that is there until the block ends. */
#define LAB_IN_FOLDER(folder, name) lab_in_folder(folder, name, (char[LAB_FILE_TEXT]){0})
enum { LAB_FILE_TEXT = LAB_PATH_TEXT + 160 };
const char *lab_in_folder(const char *folder, const char *name, char path[LAB_FILE_TEXT]);

/* The template of a page, and to its values the styles and scripts that the program carries inside for it.
 * In:      page    "report", or "index" of a batch
 * Returns: to be freed; NULL without memory */
char *lab_page_text(const char *page, cJSON *values);

/* The free term that was found. */
const pneu_term *lab_report_term(const lab_report *report, const lab_found *found);

/* The unknown that is the size of something found: from its onset on, where it has one.
 * In:      param  as in pneu_param_describe
 * Returns: its place among those of the completed model, -1 if it was not fitted */
int lab_report_size(const lab_report *report, int param);

/* When a parameter of the completed model takes another value.  Returns: NULL if it has one throughout, or may have */
const lab_onset *lab_report_onset(const lab_report *report, int param);

/* " since 12.3 s (12.29 to 12.31 s)", "" without an onset.  Out: text  Returns: text */
enum { LAB_SINCE_TEXT = 128 };
const char *lab_report_since(const lab_onset *onset, char text[LAB_SINCE_TEXT]);

/* What the fit could not determine, in words; "" where all is well.  Out: text */
void lab_report_undetermined(const lab_report *report, char text[LAB_FIT_UNDETERMINED_TEXT]);

/* Add to a list of texts what the answer has to be read with: remarks on the logs, and what the fit could not
 * determine. */
void lab_report_limits(const lab_report *report, cJSON *list);

/* The limitation for which no effect may be named; NULL: there is none. */
const char *lab_report_doubt(const lab_report *report);

/* The root mean square of all errors over the noise. */
double lab_report_in_noise(const lab_errors *errors);

/* Whether the completed model errs otherwise than the declared one: something was added, or values were moved. */
int lab_report_is_completed(const lab_report *report);

/* The chance of a score as large as that of something found, if nothing is missing. */
double lab_report_chance(const lab_report *report, const lab_found *found);

/* Share of the excess over the noise that an effect explains by itself, as its refit beside the declared model found
 * it, 0 to 1; NaN where there was none, or none row by row. */
double lab_report_refit_explains(const lab_search_result *result, const lab_score *score);

/* Whether a deviation is told in the headline: it is beyond its tolerance, or began within the log; and how many are.
 */
int lab_report_is_told(const lab_report *report, const lab_deviation *d);
int lab_report_count_told(const lab_report *report);

/* "the spring is 35 % soft since 22.8 s".  Out: text */
void lab_report_deviation(const lab_report *report, const lab_deviation *d, char text[LAB_SENTENCE_TEXT]);

/* Whether what is left may be noise, and only the time was spent before everything was tried. */
int lab_report_is_unfinished(const lab_search_result *r);

/* Whether what the candidates leave may be noise, and others may leave no more: nothing is named for that. */
int lab_report_is_ambiguous(const lab_search_result *r);

/* Whether more is left than the declared noise, by what the search takes for a sensor's: as much at rest as in motion.
 */
int lab_report_wanders(const lab_search_result *r);

void lab_report_headline(const lab_report *report, char text[LAB_SENTENCE_TEXT]);
void lab_report_evidence(const lab_report *report, char text[LAB_SENTENCE_TEXT]);
void lab_report_sentence(const lab_report *report, char text[LAB_SENTENCE_TEXT]);

enum { LAB_EFFECT_SENTENCE = 256 };

/* An effect in the words of a person, from pneu_effect_sentence: "The chamber leaks: 0.0137 mm², 1.5 % of the fill
 * orifice, 36 Nl/h at 4 bar supply." A part between commas whose size is not finite is left out.
 * In:      rig    with the effect
 *          param  the parameter of the effect that has its size, as in pneu_param_describe
 * Out:     text   Returns: text */
const char *lab_effect_sentence(const lab_rig *rig, int effect, int param, char text[LAB_EFFECT_SENTENCE]);

/* What one thing that was found does, as in the first line but without its name.  Out: text  Returns: text */
enum { LAB_FOUND_SENTENCE = 512 };
const char *lab_report_found_sentence(const lab_report *report, const lab_found *found, char text[LAB_FOUND_SENTENCE]);

#endif

/* What closeloop writes: report.json, model.cfg, model.h, residual.csv.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LOOPFILES_H
#define LAB_LOOPFILES_H

#include <cjson/cJSON.h>

#include "../trace/loop.h"
#include "../metrics/metrics.h"
#include "../base/outfile.h"
#include "../base/remarks.h"
#include "../separate/separate.h"

enum { LAB_STORY_HELD = 32 };

/* A log that was held out. */
typedef struct lab_held {
  const char *name;
  lab_errors before, after; /* of the declared and of the completed model */
} lab_held;

/* Everything that there is to say about a run. */
typedef struct lab_story {
  const lab_rig *rig;            /* as declared */
  const lab_unknowns *declared;  /* fitted, without added effects */
  const lab_unknowns *completed; /* fitted, with them */
  const lab_loop_result *result;
  int has_holdout;
  lab_errors holdout_before, holdout_after;
  lab_errors fitted_path[LAB_LOOP_PATH], holdout_path[LAB_LOOP_PATH]; /* of result->path */
  int n_held;                                                         /* logs held out */
  lab_held held[LAB_STORY_HELD];                                      /* each by itself */
  lab_advice separate[LAB_LOOP_EFFECTS]; /* of each found effect from the first that looks like it */
  lab_metrics *measured, *predicted;     /* figures of merit of the runs fitted; NULL: not made */
  lab_advice next;                       /* the test that would tell most, where no effects are alike */
  double fit_s, trace_s, total_s;        /* [s] on the clock; trace_s: the scan of all effects */
  const lab_remarks *remarks;            /* what limits the conclusions; NULL: nothing */
} lab_story;

/* Open one file in a folder.  Returns: as lab_out_open */
int lab_report_open(const char *folder, const char *name, lab_outfile *out, lab_error *error);

/* Each writes one file into a folder, whole or not at all.  Returns: LAB_OK, LAB_WORLD, LAB_NUMERIC. */
int lab_story_json(const lab_story *story, const char *folder, lab_error *error);
int lab_story_model(const lab_story *story, const char *folder, lab_error *error);
int lab_story_header(const lab_story *story, const char *folder, lab_error *error);
int lab_story_residual(const lab_story *story, const char *folder, lab_error *error);

/* What the fit could not determine, in words; "" where all is well.  Out: text */
void lab_story_undetermined(const lab_story *story, char text[LAB_FIT_REMARK]);

/* Add to a list of texts what the answer has to be read with: remarks on the logs, and what the fit could not
 * determine. */
void lab_story_limits(const lab_story *story, cJSON *list);

/* One sentence: what was found, and what it did to the error. */
void lab_story_sentence(const lab_story *story, char *text, size_t size);

#endif

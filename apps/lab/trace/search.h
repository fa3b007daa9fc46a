/* Close the loop: fit, score the effects by what is left, refit the best, add one, again, until nothing passes
 * (rounds.h). Which candidate is kept, and when the search ends, is decided by the rules of decide.h.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SEARCH_H
#define LAB_SEARCH_H

#include "../check/logs.h"
#include "../fit/errors.h"
#include "refit.h"

enum { LAB_SEARCH_STEPS = 160, LAB_SEARCH_PATH = 8, LAB_OWN_MAX = 2 };

typedef struct lab_search_options {
  double alpha;    /* chance of naming anything when nothing is missing */
  double min_gain; /* share by which an addition must lower the error of some channel */
  int max_effects;
  int may_begin;                                        /* not 0: something may begin within the only run */
  void (*on_progress)(void *context, const char *what); /* told what is being done; may be NULL */
  void *context;
} lab_search_options;

/* A model: the declared one, and the one that is completed. Equal where nothing was added. */
enum lab_stage { LAB_STAGE_BEFORE, LAB_STAGE_AFTER, LAB_STAGE_COUNT };

/* A model that was tried: the declared one first. */
typedef struct lab_tried_model {
  char name[LAB_PARAM_NAME_TEXT]; /* of what it has beyond the declared model, joined by " + " */
  double chi2, bic;               /* of the residuals; Schwarz 1978 */
} lab_tried_model;

/* A model that the search went on from, fitted. */
typedef struct lab_path_model {
  char name[LAB_PARAM_NAME_TEXT];
  double chi2, bic;
  lab_rig rig;
  lab_errors errors; /* on the logs that it was fitted to; NaN where it cannot follow them */
} lab_path_model;

typedef struct lab_search_result {
  int verdict;   /* enum lab_verdict */
  int cut_short; /* not 0: the CPU time that was given (lab_unknowns.until) was spent before the search had come to its
                    end */
  int n_found;
  lab_found found[LAB_EFFECTS_MAX];
  lab_errors before, after;
  lab_residual_stats left[LAB_STAGE_COUNT]
                         [LAB_CHANNEL_COUNT]; /* row by row, by which the verdict and every text speak */
  lab_onset begin[LAB_ONSETS_MAX];            /* of the onsets of the final model */
  lab_fit_result fit;                         /* of the final model */
  lab_scores scores;                          /* of effects, on the declared model: what was tried */
  double score_s;                             /* [s] that these took */
  double preview;                             /* [s] of the run by which they are; 0: by all of it (preview.h) */
  int n_own, own[LAB_OWN_MAX];                /* parameters of which each log was given a value (apart.h) */
  int n_listed;                               /* effects that are significant but gain less than min_gain */
  int listed[LAB_SCORES_MAX];
  int has_small;   /* not 0: a free term is significant but gains less than min_gain */
  pneu_term small; /* that term */
  int n_steps;
  lab_tried_model step[LAB_SEARCH_STEPS];
  int n_path; /* models from the declared one to the final one */
  lab_path_model path[LAB_SEARCH_PATH];
  size_t window; /* rows of a window if the log is rough and was seen coarsely (windowed.h); else 0 */
  double level;  /* p-value that a single score has to pass */
  double sound_until; /* [s] by the log: up to there the declared model leaves only noise, where the verdict is
                         undecided for what comes then, of which more than noise is left; 0: not known */
  int jerks;     /* not 0: the verdict is undecided, and the stem moves by jerks where the model's does not */
  int is_far;    /* not 0: the verdict is undecided only for the values that the model needs (lab_candidate_is_far) */
} lab_search_result;

/* As the table of constants says. */
void lab_search_options_default(lab_search_options *options);

/* Run the search. When the CPU time u->until is spent, the best model so far is the answer.
 * In/out:  u       declared model, fitted; then the completed one
 * Out:     result
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int lab_search_run(lab_unknowns *u, const lab_search_options *options, lab_search_result *result, lab_error *error);

/* Run a search once more without the values that stand alone (outliers.h), if there are any. If that leaves less to
 * explain or to doubt, or nothing, the new answer takes the place of the old one, and the bench's remarks say what was
 * left out; else nothing changes. Nor does it where the log was seen coarsely, where something begins and nothing else
 * is in doubt, or where one effect, with no value far off its sheet, explains the log, and without the values that
 * stand alone tolerances still do not.
 * In/out:  bench      its logs
 *          declared   fitted
 *          completed  model, and
 *          result     of the search on it
 * Returns: as lab_search_run; a failure to fit or to follow without the values is no error. */
int lab_search_without_outliers(const lab_search_options *options, lab_logs *bench, lab_unknowns *declared,
                                lab_unknowns *completed, lab_search_result *result, lab_error *error);

/* Take up the errors of a model and what it leaves.
 * In:      u      seen row by row
 *          stage  which one it is
 * Returns: LAB_OK, LAB_NUMERIC, LAB_WORLD. */
int lab_search_measure(const lab_unknowns *u, enum lab_stage stage, lab_search_result *result, lab_error *error);

/* List an effect as significant but too small, once. */
void lab_search_list_small(lab_search_result *result, int effect);

/* Whether a search explains the logs: by declared values alone, or by effects that have a name. */
int lab_search_explains(const lab_search_result *result);

/* Whether another search says more than the first: it explains the logs, has a lower BIC, or leaves about as much as a
 * free term of the first, which can bend to nearly anything. */
int lab_search_is_better(const lab_search_result *other, const lab_search_result *first);

#endif

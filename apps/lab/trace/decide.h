/* What the search decides by: one table of constants (constants.def) and one table of rules (decide.c), which DESIGN.md
 * prints.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_DECIDE_H
#define LAB_DECIDE_H

/* ---- Constants ---- */

/* Those that are sizes of arrays as well. */
enum { LAB_EFFECTS_MAX = 3, LAB_LEADERS_MAX = 7, LAB_BEAM_WIDTH = 2, LAB_RIVALS_MAX = 4 };

enum lab_constant {
#define X(name, value, meaning, source) LAB_##name,
#include "constants.def"
#undef X
  LAB_CONSTANT_COUNT
};

typedef struct lab_constant_row {
  const char *name;
  double value;
  const char *meaning;
  const char *source; /* how it was calibrated, as far as that is known */
} lab_constant_row;

extern const lab_constant_row lab_constants[LAB_CONSTANT_COUNT]; /* by enum lab_constant */

/* The value of a constant; as an int for one that counts. */
double lab_constant(enum lab_constant which);
int lab_count(enum lab_constant which);

/* ---- How good a model is ---- */

typedef struct lab_quality {
  int fitted;
  double chi2;    /* of the residuals, with priors */
  double values;  /* measured values that are fitted */
  double bic;     /* Schwarz 1978, over the measured values; a free term costs more than an effect */
  int white;      /* not 0: more is left than the declared noise, but it is noise */
  int of_sensors; /* not 0: as much is left in motion as at rest, and less than NOISE_DOUBTFUL */
  int whole;      /* not 0: it was fitted with all its values, none of which was held to straight lines */
  double strain;  /* largest deviation of a declared value, over its tolerance */
} lab_quality;

/* Whether a fitted model leaves only noise: chi-square as expected of the declared noise, or white. */
int lab_is_noise(const lab_quality *q);

/* Whether a model could not be fitted, or leaves more than could be noise. */
int lab_is_plainly_off(const lab_quality *q);

/* Whether a model fits only with a declared value far beyond its tolerance. */
int lab_is_strained(const lab_quality *q);

/* Whether a fitted model leaves nothing to explain, and strains nothing. */
int lab_is_clean(const lab_quality *q);

/* Whether a model could not be fitted, or explains little of what the declared one leaves. */
int lab_is_poor(const lab_quality *declared, const lab_quality *q);

/* Whether a model in which something begins is to be preferred to one without. */
int lab_onset_convinces(const lab_quality *with, const lab_quality *without);

/* ---- Rules ---- */

/* What was concluded. */
enum lab_verdict { LAB_VERDICT_NONE, LAB_VERDICT_EFFECT, LAB_VERDICT_UNLISTED, LAB_VERDICT_UNDECIDED };

/* "none", "effect", "unlisted", "undecided" */
const char *lab_verdict_text(int verdict);

/* When a rule is asked. */
enum lab_phase {
  LAB_PHASE_SCORED,
  LAB_PHASE_LED,
  LAB_PHASE_REFITTED,
  LAB_PHASE_ROUND,
  LAB_PHASE_END,
  LAB_PHASE_VERDICT
};

/* What the search does by a rule. */
enum lab_rule_action {
  LAB_DO_SCORE_ONSETS,
  LAB_DO_FIT_CLEAR_ONSET,
  LAB_DO_FIT_ONSET,
  LAB_DO_TAKE_ONSET,
  LAB_DO_SCORE_TERMS,
  LAB_DO_FIT_SCORED_TERM,
  LAB_DO_UNFOLD_TERM,
  LAB_DO_ADD_EFFECT,
  LAB_DO_END,
  LAB_DO_REMOVE_NEEDLESS,
  LAB_DO_EXCHANGE,
  LAB_DO_FIT_TERM,
  LAB_DO_TAKE_TERM,
  LAB_DO_FIT_TERM_BESIDE,
  LAB_DO_ADD_TERM
};

/* What the rules ask about. */
typedef struct lab_facts {
  int round;             /* 0: the first */
  int coarse;            /* the log is seen coarsely (windowed.h) */
  int added;             /* this round has added an effect */
  lab_quality within;    /* the declared model within its tolerances, where the search is from values as declared */
  lab_quality declared;  /* the declared model */
  lab_quality best;      /* the best model so far */
  int n_found, n_terms;  /* what was added to it; free terms in it, declared ones among them */
  int held;              /* declared values vary within their tolerances */
  int has_begun;         /* something that begins within the run was taken up in this round */
  int found_term;        /* a free term was added to it */
  int n_causes;          /* effects that were added to it, errors of sensors apart */
  int in_one_loop;       /* there is a single run, behind a positioner */
  int begins_within;     /* something in it begins within the run */
  int can_begin;         /* the logs are one run, of which nothing is known to begin within it */
  lab_quality onset;     /* the declared model with what begins within its run; not fitted: not tried yet, or nothing */
  lab_quality free_term; /* the declared model with the best free term; not fitted: not tried yet, or none */
  lab_quality extended;  /* the best extension of the best model; not fitted: none */
  double excess;         /* of the best model's chi-square over the data, and */
  double effect, term;   /* the largest scores there, of an effect and of a free term */
  double begins, throughout; /* the same of what begins within the run, and of all that acts throughout */
} lab_facts;

typedef struct lab_rule {
  enum lab_phase phase;
  const char *when; /* in words */
  int (*holds)(const lab_facts *f);
  const char *then; /* in words */
  int action;       /* enum lab_rule_action; of the last phase enum lab_verdict */
} lab_rule;

/* In order. Of each phase all are followed that hold when it is their turn; of the last one the first that holds. */
extern const lab_rule lab_rules[];
extern const int lab_rule_count;

/* The verdict on the best model.  Returns: enum lab_verdict */
int lab_decide_verdict(const lab_facts *f);

/* Whether a verdict holds only once everything was tried: that nothing is missing, or nothing that has a name. */
int lab_needs_the_whole_search(int verdict);

/* Whether deviations stand in for what is not known: an undecided model leaves NOISE_DOUBTFUL or more. Where it leaves
 * less, they are nearly what they would be beside what is missing.
 * In:      verdict       enum lab_verdict
 *          reduced_chi2  of the fit; NaN: not known */
int lab_values_stand_in(int verdict, double reduced_chi2);

#endif

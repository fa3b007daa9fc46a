/* The 18 conclusions of the paper, tried on simulated strokes of every actuator under every law of the study.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_CONCLUSIONS_H
#define STUDY_CONCLUSIONS_H

#include "benchscan.h"
#include "products.h"
#include "stroke.h"
#include "../lab/base/text.h"

enum { CONCLUSIONS = 18, CONCLUSION_WORDS = 5, CONCLUSION_SUPPLIES = 9 };

/* ---- What they are tried on ---- */

/* An actuator and what is changed of it. */
enum conclusion_variant {
  TRIAL_NOMINAL,         /* as its rig file says */
  TRIAL_IDEAL,           /* without dry friction */
  TRIAL_CENTRED,         /* on a bench set about the middle of the supply; the first three also do work on a load */
  TRIAL_IDEAL_CENTRED,   /* both */
  TRIAL_FAR_SUPPLY,      /* ten times the supply, a tenth of the orifice */
  TRIAL_NO_STOP,         /* the upper stop is beyond the reach of the supply */
  TRIAL_WEAK_PRELOAD,    /* preload below friction */
  TRIAL_WHOLE_DISCHARGE, /* both: all that a discharge can be, from p_s to ambient */
  TRIAL_PROLONGED,       /* without friction, travel prolonged to 97 % of the supply */
  TRIAL_HALF_TOP,        /* half the highest typical supply */
  TRIAL_TOP,             /* the highest */
  TRIAL_SIX_SPRINGS,     /* on 6 springs of Table 1, without friction, as those down to TWELVE */
  TRIAL_HALF_ORIFICE,
  TRIAL_TWICE_SUPPLY,
  TRIAL_TWICE_AREA,
  TRIAL_TWELVE_SPRINGS, /* on 12 springs */
  TRIAL_VACUUM,         /* hardly any ambient pressure */
  TRIAL_NARROW_VACUUM,  /* and a bench set so narrow that the pressure hardly changes */
  TRIAL_SUPPLIES,       /* typical supplies, rising */
  TRIAL_VARIANTS = TRIAL_SUPPLIES + CONCLUSION_SUPPLIES,
  TRIAL_LOADED = TRIAL_CENTRED + 1
};

/* Its strokes under one pair of laws. */
typedef struct conclusion_trial {
  pneu_laws laws;
  bench_scan scan;
  pneu_params p[TRIAL_VARIANTS];
  speed_pair pair[TRIAL_VARIANTS];
  load_cycle cycle[TRIAL_LOADED];
  double limit; /* what a value of the conclusion that is tried may be at most */
} conclusion_trial;

/* Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int conclusion_trial_run(const lab_rig *rig, const pneu_laws *laws, conclusion_trial *t, lab_error *error);

/* ---- What was measured to test a statement, and the verdict that follows ---- */

enum { FINDING_CASES = 32, FINDING_TEXT = 480, FINDING_LABEL = 64 };

enum finding_verdict { FINDING_HOLDS, FINDING_HOLDS_WHEN, FINDING_CONTRADICTED };

/* One measured value. */
typedef struct finding_case {
  char label[FINDING_LABEL]; /* of what: "r1-400, up" */
  double value;
} finding_case;

/* A statement is tried on every case, those that were looked for to break it included. If one fails and there are
 * values measured under a condition, the statement is saved where all of these pass. */
typedef struct finding {
  int n, n_conditioned;
  finding_case at[FINDING_CASES], conditioned[FINDING_CASES];
  char condition[FINDING_TEXT]; /* completes "holds when" */
  char where[FINDING_TEXT];     /* what of the condition belongs to this actuator alone: "above 40 kPa" */
  char note[FINDING_TEXT];      /* more figures, to follow the values */
} finding;

/* Add a value with a label; what is beyond FINDING_CASES is left out. */
void finding_add(finding *f, double value, const char *label, ...) LAB_PRINTF(3, 4);
void finding_add_conditioned(finding *f, double value);

/* Add the cases of another actuator to those of `all`, its name in front; conditions become one sentence. */
void finding_join(finding *all, const finding *one, const char *name);

/* Verdict where a value passes if it is within low .. high; NaN never passes.
 * Returns: enum finding_verdict; without any case: contradicted. */
int finding_judge(const finding *f, double low, double high);

/* The value that comes nearest to failing, or fails by most, to four digits after the point: the largest where there
 * is an upper limit only, the least where there is a lower one only, the first where there are both. */
double finding_worst(const finding *f, double low, double high);

/* One of "holds", "holds when", "contradicted". */
const char *finding_word(int verdict);

/* Words of the verdict: "holds", "holds when <condition> <where>", "contradicted".  Out: text, `size` bytes */
void finding_verdict_text(const finding *f, int verdict, char *text, size_t size);

/* One sentence: what was measured, the values with their labels, what is claimed of them, further figures.
 * In:      what   "slope of ln v over ln P"
 *          low, high  as finding_judge; -HUGE_VAL or HUGE_VAL leaves a side open */
void finding_evidence(const finding *f, const char *what, double low, double high, char *text, size_t size);

/* ---- The conclusions ---- */

/* A conclusion as a statement that can be tested; study/PAPER.md, section 9, says why so. */
typedef struct conclusion {
  int number;               /* of the paper */
  const char *what;         /* is measured */
  double low, high;         /* between which it lies if the conclusion is right exactly, */
  double low_per, high_per; /* and what each moves per unit of the number given to its word */
  double word;              /* that number: 0.1 for "approximately"; 0 if no limit depends on a word */
  /* Add the values that have to pass, those of cases looked for to break the statement among them; where there is a
   * condition that may save it, also the values under that condition, and its words. The limit of the trial decides
   * the words of a condition that is searched, not the values. */
  void (*measure)(const conclusion_trial *t, finding *f);
  const char *says, *remark; /* the statement in short; what to know of its verdict */
} conclusion;

extern const conclusion conclusions[CONCLUSIONS];

/* Numbers that a word may be given: 5, 10, 20, 30 %, and sqrt(2) - 1, the paper's own bound in conclusion 10. */
extern const double conclusion_words[CONCLUSION_WORDS];

/* Limits when the word is given a number. */
void conclusion_limits(const conclusion *c, double word, double *low, double *high);

/* Try them all.
 * Out:     found  by actuator, law, conclusion, each in the order of the study; to be freed
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int conclusions_try(const study *s, finding **found, lab_error *error);

enum conclusion_table {
  CONCLUSION_OVERALL,    /* by conclusion and law, over the actuators of Table A1 as printed */
  CONCLUSION_ACTUATORS,  /* what was measured, between which limits it should be, the verdict */
  CONCLUSION_THRESHOLDS, /* the verdict for each number that its words may be given, and on what it depends:
                            "threshold" (5 to 30 %), "set" */
  CONCLUSION_TABLES
};

/* One of them, opened here and to be closed by the caller. */
void conclusions_table(const study *s, const finding *found, int which, table *t);

#endif

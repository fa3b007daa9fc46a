/* What was measured to test a statement, and the verdict that follows.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_FINDING_H
#define STUDY_FINDING_H

#include "../lab/base/text.h"

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

#endif

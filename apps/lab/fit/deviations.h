/* How far the values that logs ask for are from the declared ones, and what that says of the condition of a rig.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_DEVIATIONS_H
#define LAB_DEVIATIONS_H

#include "unknowns.h"

enum { LAB_DEVIATIONS_MAX = 64 };

/* CANNOT_TELL also stands where no value was compared. */
enum lab_condition { LAB_CONDITION_CANNOT_TELL, LAB_CONDITION_AS_DECLARED, LAB_CONDITION_DEVIATES };

/* "cannot tell", "as declared", "deviates" */
const char *lab_condition_text(int condition);

/* A declared value, of the model or of an instrument, beside the one that the logs ask for. */
typedef struct lab_deviation {
  char name[LAB_PARAM_NAME_TEXT]; /* "spring_rate", "pressure_gain": as in a rig file */
  char unit[32];                  /* as in pneu_param_describe */
  int param;                      /* as there, or LAB_PARAM_ORIFICE_AREA */
  double declared, found;         /* [unit] */
  double lower, upper;            /* [unit] 95 % interval of `found` */
  double ratio;                   /* found over declared; NaN where declared is 0 */
  double tolerance; /* standard deviation with which `declared` is known: a share of it, or, where it is 0, [unit];
                       NaN: it was declared as a start only */
  int beyond; /* not 0: further off than the tolerance allows; if it is known to no better than half of that, in all
                 of its interval */
  int held;   /* not 0: it was not in `fit` */
} lab_deviation;

/* A fitted value beside what was declared.  Out: d  Returns: 0 if unknown j is no declared value */
int lab_deviation_of(const lab_rig *rig, const lab_unknowns *u, const lab_fit_result *fit, int j, lab_deviation *d);

/* What begins within the logs first, then values of the rig, then instruments; the largest of each first. */
typedef struct lab_deviations {
  int condition; /* enum lab_condition */
  int n;
  lab_deviation of[LAB_DEVIATIONS_MAX];
} lab_deviations;

/* What a fit says of the declared values: those whose interval leaves out what was declared, of which one in twenty is
 * as declared all the same (Benjamini and Hochberg 1995), and whether one of them is beyond its tolerance. Of a value
 * that is another from some time on, the later one counts.
 * In:      rig      as declared
 *          u        fitted, with what is held
 *          fit      its intervals
 *          trusted  tolerances up to which a value is told unless it is at its bound; INFINITY: all are
 * Out:     all
 * Returns: LAB_OK, LAB_WORLD. */
int lab_deviations_find(const lab_rig *rig, const lab_unknowns *u, const lab_fit_result *fit, double trusted,
                        lab_deviations *all, lab_error *error);

/* Intervals are those of a parabola about the fit. Where chi-square rises less than that on the way to the declared
 * value, the interval of a value that would be told is made wider until the parabola rises no more.
 * In:      u    fitted, with what is held
 * In/out:  fit  its intervals
 * Returns: LAB_OK, LAB_WORLD. */
int lab_deviations_widen(const lab_unknowns *u, lab_fit_result *fit, lab_error *error);

/* What is held and not told apart from its declared value goes back to it, if all of these together may and no other
 * value has to give for it; the rest is fitted again about them, and the intervals move along.
 * In/out:  u     fitted, with what is held
 *          chi2  of it
 *          fit   its intervals
 * Returns: LAB_OK, LAB_WORLD; where no fit is found nothing changes. */
int lab_deviations_forget(lab_unknowns *u, double *chi2, lab_fit_result *fit, lab_error *error);

/* What the value of an unknown is over, which begins within a log: the areas before, if these were fitted; else 1. */
double lab_earlier_factor(const lab_unknowns *u, const lab_unknown *x);

#endif

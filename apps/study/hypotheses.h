/* The six hypotheses: the cause that each names, how it is taken away, how the paper varies it, and the verdict.
 *
 * A cause is necessary if less than a share of the asymmetry is left when it is taken away. The rate of the spring and
 * the air process are each tried alone too, with the other taken away: a cause may be necessary and yet make nothing by
 * itself. Where a cause takes nothing away from an actuator, nothing was tested. No cause is exempt.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_HYPOTHESES_H
#define STUDY_HYPOTHESES_H

#include "stroke.h"
#include "study.h"

enum { H1_RATE, H2_PRELOAD, H3_LIMITER, H4_BENCH_OFFSET, H5_UNEQUAL_ORIFICES, H6_AIR_PROCESS, HYPOTHESES };

typedef struct hypothesis {
  const char *name, *words; /* "H1", what it names */
  const char *paper;        /* its own verdict, section 7 */
  double scale;             /* of the first five: brings what is varied from SI to the unit of the figure */
} hypothesis;

extern const hypothesis hypotheses[HYPOTHESES];

/* Take a cause away; of HYPOTHESES nothing. */
void hypothesis_without(int cause, pneu_params *p, pneu_laws *laws);

/* ---- Verdicts ---- */

/* What is left of the asymmetry, over the base [1]. */
typedef struct verdict_shares {
  double left, left_signed;   /* without the cause; signed: below 0 where the strokes then bend the other way */
  double alone, alone_signed; /* by the cause alone; NaN where that was not tried */
} verdict_shares;

typedef enum verdict {
  VERDICT_NOT_TESTED,    /* taking the cause away changes less than a millionth */
  VERDICT_NOT_CONFIRMED, /* the share or more is left */
  VERDICT_REVERSED,      /* the share or more is left, the other way round */
  VERDICT_NECESSARY,     /* less is left; alone the cause makes less than the share */
  VERDICT_OPPOSITE,      /* less is left; alone the cause bends the strokes the other way */
  VERDICT_CONFIRMED      /* less is left */
} verdict;

/* In: below  share of the asymmetry, as study.confirmed_below [1] */
verdict verdict_judge(const verdict_shares *shares, double below);

/* A verdict in a word or two, for the report. */
const char *verdict_brief(verdict v);

/* The strokes of an actuator in one law: with everything there, without each cause, and by each cause alone, which is
 * tried of the two that can make asymmetry, the rate of the spring and the air process; all NaN of the others. */
typedef struct verdict_strokes {
  lab_asymmetry base, without[HYPOTHESES], alone[HYPOTHESES];
} verdict_strokes;

/* Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int verdict_measure(const lab_rig *rig, const pneu_laws *laws, verdict_strokes *out, lab_error *error);

verdict_shares verdict_shares_of(const verdict_strokes *strokes, int cause);

#endif

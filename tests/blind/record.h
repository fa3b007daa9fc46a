/* One trial as a line of results/blind.csv: what was asked, what was answered, what that is worth.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_RECORD_H
#define BLIND_RECORD_H

#include <stdio.h>
#include <string.h>

#include "ask.h"
#include "draw.h"

static inline int blind_is(const char *text, const char *word)
{
  return strcmp(text, word) == 0;
}

/* No text holds a comma; lists are joined with "+". */
typedef struct blind_record {
  int trial;
  char kind[16], channels[16], actuator[16], gas[16], flow[16];
  double pressure_noise, position_noise; /* Pa, m */
  char effect[BLIND_AT_ONCE][48], unit[BLIND_AT_ONCE][16];
  double size[BLIND_AT_ONCE], limit[BLIND_AT_ONCE]; /* information limit, in the same unit */
  double ratio;                                     /* size over limit, the least of a pair; NaN with nothing missing */
  char verdict[48], found[BLIND_TEXT], alike[BLIND_TEXT], equation[64], small[BLIND_TEXT];
  double before, after, holdout_before, holdout_after; /* error over noise */
  double own_statistic; /* of the first missing effect at the first scan; NaN if it was no candidate */
  int own_rank;         /* of it among the effects, 1 is the best; 0: no candidate */
  int detected;         /* says that something is missing */
  int name;             /* the right answer: the names and no other; nothing; unlisted, in the right equation */
  int stated;           /* the same, but a name may stand in the list of what the log cannot tell from the one given,
                           or in that of what is significant but below --min-gain */
  int family;           /* the same, but a name may be another one of the family */
  char why[BLIND_TEXT]; /* where the name is not right */

  /* of trials "as recorded" only: recorded_score.h */
  char class[16], log[16], imperfections[BLIND_TEXT], beyond[24], begins[48];
  double rate, rows;                   /* rows a second, rows */
  double second_ratio, onset;          /* size over limit of the second effect; s, NaN: from the start */
  char due[BLIND_TEXT];                /* values that are off by twice what the log can tell, with their ratios */
  char deviations[BLIND_TEXT];         /* said */
  char condition[24], since[48];       /* said; of what begins within the log */
  int n_due, n_found, n_said, n_wrong; /* of deviations */
  int far_due, far_found;              /* the one that is far beyond its tolerance: due, found */
  int onset_due, onset_said, onset_within;
  int instrument; /* named what its sensors' filters are */
  double cpu;     /* s */
} blind_record;

/* A table has the columns of the clean series, or with `recorded` all. */
void blind_record_header(FILE *file, int recorded);
void blind_record_write(FILE *file, const blind_record *record, int recorded);

/* Read a line.  Returns: 0 unless it is a whole record. */
int blind_record_read(const char *line, int recorded, blind_record *record);

#endif

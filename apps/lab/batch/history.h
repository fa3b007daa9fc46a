/* What the dated lines of a list say of each rig: its parameters at some days, from the reports in their folders.
 * Lines with the same rig file are logs of one rig.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_HISTORY_H
#define LAB_HISTORY_H

#include "batchlist.h"

/* A value of a parameter on one day, in SI. */
typedef struct lab_sample {
  char *rig; /* path of its file, as in the list */
  char parameter[LAB_PARAM_NAME_TEXT], unit[32];
  char date[LAB_FLEET_DATE_TEXT]; /* as in the list */
  int place;                      /* in the order in which samples came */
  double at;                      /* [d] */
  double value, deviation;        /* its standard deviation */
  double declared, tolerance;     /* as in lab_deviation; NaN: none */
} lab_sample;

/* Begins as {0}. */
typedef struct lab_history {
  int n, room;
  lab_sample *of;
} lab_history;

/* Take up what the report in a line's folder says: every fitted parameter that has an interval, and every held one that
 * is off. A line without a date has none, and an undecided one neither: its values stand in for what is not known.
 * Returns: LAB_OK; LAB_DATA for a folder without a whole report; LAB_WORLD. */
int lab_history_add(lab_history *history, const lab_fleet_entry *line, const char *folder, lab_error *error);

/* Sort by rig, parameter, time and line. */
void lab_history_sort(lab_history *history);

void lab_history_free(lab_history *history);

#endif

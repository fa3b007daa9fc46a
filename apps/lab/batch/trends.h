/* How the parameters of a rig go on from log to log, and when they leave their tolerances: what the dated lines of a
 * list say of each rig, trends.csv, and what the page of a batch shows of it. Lines with the same rig file are logs of
 * one rig. SPDX-License-Identifier: MIT */
#ifndef LAB_TRENDS_H
#define LAB_TRENDS_H

#include <cjson/cJSON.h>

#include "../base/line.h"
#include "batchlist.h"

enum { LAB_TREND_SENTENCE = 400 };

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
  int n;
  lab_sample *of;
} lab_history;

/* Take up what the report in a line's folder says: every fitted parameter that has an interval, and every held one that
 * is off. A line without a date has none, and an undecided one neither: its values stand in for what is not known.
 * Returns: LAB_OK; LAB_DATA for a folder without a whole report; LAB_WORLD. */
int lab_history_add(lab_history *history, const lab_fleet_entry *line, const char *folder, lab_error *error);

/* Sort by rig, parameter, time and line. */
void lab_history_sort(lab_history *history);

void lab_history_free(lab_history *history);

/* A parameter of a rig with values at two times at least. */
typedef struct lab_trend {
  const lab_sample *first, *last; /* of the history */
  int n_of_rig;                   /* trends of the rig, in its first one; 0 in the others */
  lab_line line;                  /* over days */
  double slope, half;             /* [1/d] and of its 95 % interval */
  int drifts;     /* not 0: the slope is not 0, all slopes of a rig being wrong together once in twenty (Bonferroni) */
  double days[3]; /* from the last sample until the line leaves the tolerance, with its 95 % interval, no earlier than
                     0; 0 where it has already; NaN where nothing drifts or there is no tolerance */
} lab_trend;

/* Begins as {0}. */
typedef struct lab_trends {
  int n;
  lab_trend *of;
} lab_trends;

/* In:      history  sorted, and kept as long as the trends are
 * Out:     trends   to be freed
 * Returns: LAB_OK, LAB_WORLD. */
int lab_trends_find(const lab_history *history, lab_trends *trends, lab_error *error);
void lab_trends_free(lab_trends *trends);

/* "spring_rate leaves its tolerance of 10 % in 140 days (95 to 260)"; empty where nothing drifts. */
const char *lab_trend_sentence(const lab_trend *trend, char sentence[LAB_TREND_SENTENCE]);

/* Write trends.csv; without any trend there is none.  Returns: LAB_OK, LAB_WORLD. */
int lab_trends_write(const lab_trends *trends, const char *path, lab_error *error);

/* To the values of the page's template, for each parameter of a rig a sparkline, and the sentences. */
void lab_trends_page(const lab_trends *trends, cJSON *page);

#endif

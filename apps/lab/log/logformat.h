/* How a log is written down: with a header "name [unit]" as in pneu-rig(5), or as the group `log` of a rig file says
 * about a raw logger file; its keys are there, too.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LOGFORMAT_H
#define LAB_LOGFORMAT_H

#include <stdio.h>

#include <libconfig.h>

#include "logcolumn.h"
#include "stamp.h"
#include "../base/csv.h"

enum {
  LAB_COLUMN_MAX = LAB_CSV_CELLS, /* columns in a file */
  LAB_QUANTITY_MAX = 32,          /* quantities in a long file */
  LAB_LEAD_MAX = 4                /* rows put before each run */
};

enum lab_new_run { LAB_RUN_NEVER, LAB_RUN_T_DROPS };
enum lab_runs { LAB_RUNS_EACH, LAB_RUNS_MEAN };
enum lab_damaged { LAB_DAMAGED_ERROR, LAB_DAMAGED_DROP };

/* A word in the column "quantity" of a long file, and the channel it stands for. */
typedef struct lab_long_quantity {
  char word[64];
  char column[LAB_COLUMN_TEXT];
} lab_long_quantity;

typedef struct lab_log_format {
  char delimiter, decimal;                      /* 0: guess */
  char thousands;                               /* 0: none */
  char comment;                                 /* 0: none */
  int skip_lines;                               /* -1: guess */
  int date;                                     /* enum lab_date_order */
  char map[LAB_CHANNEL_COUNT][LAB_COLUMN_TEXT]; /* column of the header; "": guess */
  int new_run;                                  /* enum lab_new_run */
  int damaged;                                  /* enum lab_damaged */
  int n_columns;                                /* 0: the file has a header */
  char column[LAB_COLUMN_MAX][LAB_COLUMN_TEXT];
  int every;                                     /* rows of which one is kept; at least 1 */
  int first;                                     /* the first row that is kept */
  int holdout_first;                             /* the same where a log is held out; -1: no other */
  double holdout_from, holdout_to;               /* [s] window of a log held out; NaN: no other */
  char name[LAB_CHANNEL_COUNT][LAB_COLUMN_TEXT]; /* "mark [unit]" of a number in the file's name; "": none */
  int weighted;                                  /* not 0: weights are given, and a channel may have several columns */
  double weight[LAB_COLUMN_MAX];
  int way_back; /* channel whose first fall starts the way back; -1: none */
  int runs;     /* enum lab_runs */
  int n_lead;
  double lead[LAB_LEAD_MAX][LAB_CHANNEL_COUNT];    /* SI; NaN: a gap, or what the run begins with for u */
  int lead_first[LAB_LEAD_MAX][LAB_CHANNEL_COUNT]; /* channel + 1 whose first value in the run it is; 0: none */
  int lead_last[LAB_LEAD_MAX][LAB_CHANNEL_COUNT];  /* likewise the last */
  int n_quantities;                                /* 0: one column a channel */
  lab_long_quantity quantity[LAB_QUANTITY_MAX];
  double time_step; /* [s]; 0: the file has a column t */
  double from, to;  /* [s] window, infinite where there is none */
  double scale[LAB_CHANNEL_COUNT];
  lab_signal signal[LAB_CHANNEL_COUNT];
  double offset[LAB_CHANNEL_COUNT];   /* SI */
  double constant[LAB_CHANNEL_COUNT]; /* SI; NaN: none */
  int command_is_pressure;            /* u is a set pressure [Pa], not an opening */
  double stroke;                      /* [m] of which x may be a share; 0: unknown */
  double ambient;                     /* [Pa] absolute; set by lab_log_read */
} lab_log_format;

/* The format of a log with such a header.  Out: format */
void lab_log_format_default(lab_log_format *format);

/* Read the `log` group of a rig file over the defaults.
 * In:      group   the group
 * In/out:  format  set to its defaults
 * Returns: LAB_OK, or LAB_DATA with file, line and key. */
int lab_log_format_read(const config_setting_t *group, lab_log_format *format, lab_error *error);

/* The format for a log that is held out.  In/out: format */
void lab_log_format_hold_out(lab_log_format *format);

/* Read a channel as what is left of it to a whole [SI]: columns, names, constants and rows put before.
 * In/out:  format */
void lab_log_format_turn(lab_log_format *format, int channel, double whole);

/* Write the group so that lab_log_format_read gives the same. */
void lab_log_format_write(FILE *file, const lab_log_format *format);

#endif

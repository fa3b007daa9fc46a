/* How a log is written down: the format of interface.md, or what the `log` group of a rig file says
 * about a raw logger file.
 *
 *   log = {
 *     delimiter  = ";";            // one character, "tab", "comma", "semicolon", "blanks"; guessed
 *     decimal    = ",";            // "." or ","; guessed by default
 *     thousands  = ".";            // mark to leave out; equal to decimal: all but the last; default none
 *     comment    = "#";            // lines that begin with it are not data
 *     skip_lines = 1;              // lines before the header (guessed by default), or before the data where there is
 * no
 *                                  // header
 *     map        = { p = "Pressure_1 (bar)"; }; // which column of the header is which channel; "name [unit]" gives or
 *                                  // replaces its unit; those that are not given are guessed
 *     date       = "dmy";          // order of a date's numbers: "dmy", "mdy", "ymd"; guessed by default
 *     columns    = ( "t [ms]", "-", "p [bar]" );  // the file has no header; "-" is a column to ignore
 *     time_step  = "10 ms";        // rows are this far apart; for a file without a column t
 *     window     = ( "0 s", "3 s" ); // only rows with t inside it, in every run
 *     new_run    = "t drops";      // where a run begins: "never" (default), or where t is less than before
 *     damaged    = "drop";         // rows that cannot be read: "error" (default), or left out and counted
 *     scale      = { x = -1.0; };  // value = scale * value + offset, after the conversion to SI
 *     scale      = { p = "4..20 mA"; x = "0..27648"; }; // a signal, or counts, that stand for a range
 *     range      = { p = ["0 bar", "6 bar"]; x = ["0 mm", "20 mm"]; }; // what its ends are
 *     offset     = { x = "70 mm"; };
 *     constants  = { u = 1; };     // channels that the file does not have
 *     every      = 10;             // one of every so many rows of a run; default 1
 *     first      = 3;              // and the first one of them, counted from 0; default 0
 *     name       = { x = "_l [m]"; };  // a channel that the file's name tells: here the number behind "_l"
 *     holdout    = { window = ( "50 s", "150 s" ); first = 1; }; // what differs where a log is held out
 *     weights    = ( 1, 0.5, -0.5 ); // a channel is the sum of its columns, each times its weight; one for each column
 *     way_back   = "p";            // a loop written twice upwards: rows after the first fall of p go in reverse order
 *     runs       = "mean";         // "each" (default), or one run: the mean over the runs' rows of the same time
 *     lead       = ( { t = "-1 ms"; u = 0; }, { t = "0 s"; u = 1; } ); // rows put before each run; the rest are gaps;
 *                                  // "first p" and "last p" stand for what the run's p begins and ends with
 *     quantities = { p_abs_bar = "p_abs [bar]"; T_wall = "-"; }; // long format: columns "quantity" and "value"
 *   };
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
} lab_log_format;

/* The format of interface.md.  Out: format */
void lab_log_format_default(lab_log_format *format);

/* Read the `log` group of a rig file over the defaults.
 * In:      group   the group
 * In/out:  format  set to its defaults
 * Returns: LAB_OK, or LAB_DATA with file, line and key. */
int lab_log_format_read(const config_setting_t *group, lab_log_format *format, lab_error *error);

/* The format for a log that is held out.  In/out: format */
void lab_log_format_hold_out(lab_log_format *format);

/* Write the group so that lab_log_format_read gives the same. */
void lab_log_format_write(FILE *file, const lab_log_format *format);

#endif

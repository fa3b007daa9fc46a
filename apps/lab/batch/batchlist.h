/* The list of a fleet run: one line a rig and its logs, as a spreadsheet saves it.
 *
 *   # presses of hall 2
 *   name,rig,log,holdout,date
 *   press-1,rigs/press-1.cfg,may/p1-a.csv;may/p1-b.csv,june/p1.csv,2026-05-04
 *   press-2,rigs/press-2.cfg,may/p2.csv,,2026-05-04T13:30+02:00
 *
 * - The header names the columns, in any order; rig and log must be there, the others need not.
 * - Between cells stands the mark that the header has: comma, semicolon or tab. A cell may be in quotes, "" is a quote
 *   in it. Several logs in one cell are separated by semicolons (in quotes if the cells are, too).
 * - Without a name, a line is called as its first log: may/p2.csv is may-p2.
 * - A date is a day or a moment by ISO 8601; lines with the same rig file and dates make a history (trends.h).
 * - A line with a date of another form is an error, and the others are done.
 * - Empty lines, and lines that begin with #, are left out.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_BATCHLIST_H
#define LAB_BATCHLIST_H

#include "../base/csv.h"
#include "../rig/rig.h"

enum { LAB_FLEET_ENTRY_NAME = 128, LAB_FLEET_ENTRY_TEXT = 4096, LAB_FLEET_DATE_TEXT = 40, LAB_FLEET_WRONG_TEXT = 160 };

/* A line; plain bytes, to be sent from process to process. */
typedef struct lab_fleet_entry {
  int line;                        /* in the file */
  char name[LAB_FLEET_ENTRY_NAME]; /* also of its folder */
  char rig[LAB_PATH_TEXT];
  char log[LAB_FLEET_ENTRY_TEXT], holdout[LAB_FLEET_ENTRY_TEXT]; /* paths, separated by semicolons */
  char date[LAB_FLEET_DATE_TEXT];                                /* as it stands there */
  double day;                                                    /* [d] since 1 January 1970, of the date */
  char wrong[LAB_FLEET_WRONG_TEXT];                              /* why this line cannot be done; "": it can */
} lab_fleet_entry;

typedef struct lab_fleet_list {
  lab_csv csv;
  int column[LAB_CSV_CELLS]; /* what each cell is */
  int n_columns;
} lab_fleet_list;

/* Open a list and read its header.
 * In:      path  kept
 * Out:     list  to be closed, also after an error
 * Returns: LAB_OK; LAB_DATA with file and line; LAB_WORLD. */
int lab_fleet_list_open(lab_fleet_list *list, const char *path, lab_error *error);
void lab_fleet_list_close(lab_fleet_list *list);

/* Go back to the first line. */
void lab_fleet_list_restart(lab_fleet_list *list);

/* Read the next line.
 * Out:     more  0: there is none
 * Returns: as lab_fleet_list_open. */
int lab_fleet_list_next(lab_fleet_list *list, lab_fleet_entry *entry, int *more, lab_error *error);

/* Read to the end and go back, so that whatever is wrong is known before the work begins: also a name that stands there
 * twice, and a list without lines. Afterwards lab_fleet_list_next does not fail: the list is in memory.
 * Out:     n  lines that there is something to do for */
int lab_fleet_list_check(lab_fleet_list *list, int *n, lab_error *error);

#endif

/* Dates and times of day in a field of text.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_STAMP_H
#define LAB_STAMP_H

/* The order of a date's three numbers; one that begins with a year of four digits is year, month, day in any of them.
 */
enum lab_date_order { LAB_DATE_GUESS, LAB_DATE_DMY, LAB_DATE_MDY, LAB_DATE_YMD, LAB_DATE_ORDERS };

/* The keys of log.date, by enum lab_date_order: "guess", "dmy", "mdy", "ymd". */
extern const char *const lab_date_orders[LAB_DATE_ORDERS];

typedef struct lab_stamp {
  int has_day, has_time;
  int order;     /* in which the date was read */
  long day;      /* since 1 January 1970 */
  double second; /* [s] of the day, a time zone taken off */
} lab_stamp;

/* Read a date, a time of day or both: ISO 8601 (2024-03-01T12:34:56.789+01:00), or local (01.03.2024 12:34:56,789;
 * 3/1/2024 12:34 PM; 01-Mar-2024; 12:34:56:789). Two numbers with a fraction are minutes and seconds, as Excel writes.
 * In:      order  of a date; LAB_DATE_GUESS: month first after slashes unless that is above 12, else day first
 * In/out:  stamp  what the field has is added to what is there
 * Returns: 1; 0 for anything else. */
int lab_stamp_read(const char *begin, const char *end, int order, lab_stamp *stamp);

#endif

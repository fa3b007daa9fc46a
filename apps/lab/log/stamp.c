#include "stamp.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

const char *const lab_date_orders[LAB_DATE_ORDERS] = {"guess", "dmy", "mdy", "ymd"};

/* Which of a date's three numbers are year, month and day. */
static const int place[LAB_DATE_ORDERS][3] = {
    [LAB_DATE_DMY] = {2, 1, 0}, [LAB_DATE_MDY] = {2, 0, 1}, [LAB_DATE_YMD] = {0, 1, 2}};

struct text {
  const char *at, *end;
};

static int peek(const struct text *t)
{
  return t->at < t->end ? (unsigned char)*t->at : '\0';
}

static int take(struct text *t, const char *marks)
{
  const int c = peek(t);
  if (!c || !strchr(marks, c))
    return 0;
  t->at++;
  return c;
}

/* A whole number of at most `most` digits.  Returns: its digits */
static int whole(struct text *t, int most, long *value)
{
  int n = 0;
  for (*value = 0; n < most && isdigit(peek(t)); n++)
    *value = 10 * *value + (*t->at++ - '0');
  return isdigit(peek(t)) ? 0 : n;
}

/* Digits behind a decimal mark; those beyond the ninth do not count. */
static double fraction(struct text *t)
{
  double value = 0, digit = 0.1;
  for (; isdigit(peek(t)); t->at++, digit /= 10)
    if (digit > 1e-10)
      value += digit * (*t->at - '0');
  return value;
}

/* "Mar", any case.  Returns: the number of its letters */
static int month_name(struct text *t, long *month)
{
  static const char names[] = "janfebmaraprmayjunjulaugsepoctnovdec";
  for (*month = 1; *month <= 12; ++*month)
    if (t->end - t->at >= 3 && strncasecmp(t->at, names + 3 * (*month - 1), 3) == 0) {
      t->at += 3;
      return 3;
    }
  return 0;
}

/* Days since 1 January 1970 of a day in the Gregorian calendar (E. G. Richards, Explanatory Supplement to the
 * Astronomical Almanac, 3rd ed., 15.11.3: Julian day number, less that of 1970). */
static long day_number(long year, long month, long day)
{
  const long early = (month - 14) / 12;
  return (1461 * (year + 4800 + early)) / 4 + (367 * (month - 2 - 12 * early)) / 12 -
         (3 * ((year + 4900 + early) / 100)) / 4 + day - 32075 - 2440588;
}

static int order_of(const long part[3], int digits, int mark)
{
  if (digits == 4)
    return LAB_DATE_YMD;
  return mark == '/' && part[0] <= 12 ? LAB_DATE_MDY : LAB_DATE_DMY;
}

static int read_date(struct text *t, int order, lab_stamp *stamp)
{
  long part[3], year;
  const int first = whole(t, 4, &part[0]), mark = take(t, "-./");
  int named, i;
  if (!first || !mark)
    return 0;
  named = month_name(t, &part[1]);
  if ((!named && !whole(t, 2, &part[1])) || take(t, "-./") != mark || !whole(t, 4, &part[2]))
    return 0;
  i = order == LAB_DATE_GUESS || first == 4 || named ? order_of(part, first, named ? 0 : mark) : order;
  year = part[place[i][0]] + (part[place[i][0]] < 100 ? 2000 : 0);
  if (part[place[i][1]] < 1 || part[place[i][1]] > 12 || part[place[i][2]] < 1 || part[place[i][2]] > 31)
    return 0;
  stamp->day = day_number(year, part[place[i][1]], part[place[i][2]]);
  stamp->order = i;
  return stamp->has_day = 1;
}

/* "AM" and "PM" behind an hour of 1 to 12. */
static void read_half(struct text *t, long *hour)
{
  while (take(t, " "))
    ;
  if (t->end - t->at < 2 || !strchr("aApP", *t->at) || !strchr("mM", t->at[1]))
    return;
  *hour = *hour % 12 + (tolower(peek(t)) == 'p' ? 12 : 0);
  t->at += 2;
}

/* "Z", "+01:00", "+0100" or "+01".  Returns: [s] */
static double read_zone(struct text *t)
{
  long hour = 0, minute = 0;
  int sign;
  take(t, "Zz");
  sign = take(t, "+-");
  if (!sign || !isdigit(peek(t)))
    return 0;
  while (isdigit(peek(t)) && hour < 1000)
    hour = 10 * hour + (*t->at++ - '0');
  if (hour >= 100) {
    minute = hour % 100;
    hour /= 100;
  } else if (take(t, ":"))
    whole(t, 2, &minute);
  return (sign == '-' ? -60.0 : 60.0) * (double)(60 * hour + minute);
}

static int read_time(struct text *t, lab_stamp *stamp)
{
  long hour, minute, second = 0;
  double part = 0;
  int three;
  if (!whole(t, 2, &hour) || !take(t, ":") || !whole(t, 2, &minute))
    return 0;
  three = take(t, ":");
  if (three && !whole(t, 2, &second))
    return 0;
  if (take(t, three ? ".,:" : ".,")) {
    part = fraction(t);
    if (!three) {
      second = minute;
      minute = hour;
      hour = 0;
    }
  }
  read_half(t, &hour);
  if (hour > 24 || minute > 59 || second > 60)
    return 0;
  stamp->second = (double)(3600 * hour + 60 * minute + second) + part - read_zone(t);
  return stamp->has_time = 1;
}

int lab_stamp_read(const char *begin, const char *end, int order, lab_stamp *stamp)
{
  struct text t = {begin, end}, from;
  int dated;
  while (take(&t, " \t"))
    ;
  from = t;
  dated = read_date(&t, order, stamp);
  if (!dated)
    t = from;
  else
    while (take(&t, "T ,"))
      ;
  if (!dated || t.at < t.end)
    if (!read_time(&t, stamp))
      return 0;
  while (take(&t, " \t"))
    ;
  return t.at == t.end;
}

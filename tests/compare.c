/* Compare two CSV files number by number: equal shape, equal words, numbers within tolerances.
 *
 * Usage: compare RTOL ATOL EXPECTED GOT   exits 0 if they agree, 1 with the first differences on stderr.
 * Tolerances, not bytes: pow and exp differ in the last digit between C libraries.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_TEXT = 65536, SHOWN = 5 };

typedef struct tolerance {
  double relative, absolute;
} tolerance;

/* Whether the whole field is a number. */
static int number(const char *field, double *value)
{
  char *end;
  *value = strtod(field, &end);
  return end != field && *end == 0;
}

static int fields_agree(const char *a, const char *b, const tolerance *tol)
{
  double x, y;
  if (!strcmp(a, b))
    return 1;
  if (!number(a, &x) || !number(b, &y))
    return 0;
  return fabs(x - y) <= tol->absolute + tol->relative * fabs(x);
}

/* Next field, in place.  Returns: NULL after the last. Quoted fields are compared with their quotes. */
static char *next_field(char **at)
{
  char *begin = *at, *p;
  int quoted = 0;
  if (!begin)
    return NULL;
  for (p = begin; *p && (quoted || *p != ','); p++)
    quoted ^= *p == '"';
  *at = *p ? p + 1 : NULL;
  *p = 0;
  return begin;
}

static int lines_agree(char *a, char *b, const tolerance *tol)
{
  char *at_a = a, *at_b = b;
  for (;;) {
    char *x = next_field(&at_a), *y = next_field(&at_b);
    if (!x || !y)
      return !x && !y;
    if (!fields_agree(x, y, tol))
      return 0;
  }
}

static char *read_line(FILE *file, char *line)
{
  if (!fgets(line, LINE_TEXT, file))
    return NULL;
  line[strcspn(line, "\r\n")] = 0;
  return line;
}

static int compare(FILE *expected, FILE *got, const tolerance *tol, const char *name)
{
  static char a[LINE_TEXT], b[LINE_TEXT], keep_a[LINE_TEXT], keep_b[LINE_TEXT];
  int n = 0, wrong = 0;
  for (;;) {
    char *x = read_line(expected, a), *y = read_line(got, b);
    n++;
    if (!x && !y)
      return wrong;
    if (x && y) {
      strcpy(keep_a, a);
      strcpy(keep_b, b);
      if (lines_agree(a, b, tol))
        continue;
    }
    if (++wrong <= SHOWN)
      fprintf(stderr, "%s:%d\n  expected %s\n  got      %s\n", name, n, x ? keep_a : "(end)", y ? keep_b : "(end)");
    if (!x || !y)
      return wrong;
  }
}

int main(int argc, char **argv)
{
  tolerance tol;
  FILE *expected, *got;
  int wrong;
  if (argc != 5)
    return fprintf(stderr, "usage: compare RTOL ATOL EXPECTED GOT\n"), 2;
  tol.relative = atof(argv[1]);
  tol.absolute = atof(argv[2]);
  expected = fopen(argv[3], "r");
  got = fopen(argv[4], "r");
  if (!expected || !got)
    return fprintf(stderr, "compare: %s cannot be read\n", expected ? argv[4] : argv[3]), 1;
  wrong = compare(expected, got, &tol, argv[4]);
  fclose(expected);
  fclose(got);
  return wrong != 0;
}

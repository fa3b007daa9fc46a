#include "names.h"

#include <ctype.h>
#include <string.h>

enum { LETTERS = 64 };

static const char *name_at(const void *table, size_t i, size_t stride)
{
  return *(const char *const *)((const char *)table + i * stride);
}

int lab_name_index(const char *name, const void *table, size_t n, size_t stride)
{
  size_t i;
  for (i = 0; i < n; i++)
    if (strcmp(name, name_at(table, i, stride)) == 0)
      return (int)i;
  return -1;
}

static int smaller(int a, int b)
{
  return a < b ? a : b;
}

static int letter(const char *s, size_t i)
{
  return tolower((unsigned char)s[i]);
}

int lab_name_distance(const char *a, const char *b)
{
  /* d[i][j]: distance between the first i letters of a and the first j of b */
  int d[LETTERS][LETTERS];
  size_t na = strlen(a), nb = strlen(b), i, j;
  na = na < LETTERS ? na : LETTERS - 1;
  nb = nb < LETTERS ? nb : LETTERS - 1;
  for (i = 0; i <= na; i++)
    d[i][0] = (int)i;
  for (j = 0; j <= nb; j++)
    d[0][j] = (int)j;
  for (i = 1; i <= na; i++)
    for (j = 1; j <= nb; j++) {
      int same = letter(a, i - 1) == letter(b, j - 1);
      d[i][j] = smaller(smaller(d[i - 1][j], d[i][j - 1]) + 1, d[i - 1][j - 1] + !same);
      if (i > 1 && j > 1 && letter(a, i - 1) == letter(b, j - 2) && letter(a, i - 2) == letter(b, j - 1))
        d[i][j] = smaller(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[na][nb];
}

const char *lab_name_nearest(const char *name, const void *table, size_t n, size_t stride)
{
  const char *best = "";
  int best_distance = 2 * LETTERS;
  size_t i;
  for (i = 0; i < n; i++) {
    int distance = lab_name_distance(name, name_at(table, i, stride));
    if (distance < best_distance) {
      best_distance = distance;
      best = name_at(table, i, stride);
    }
  }
  return best;
}

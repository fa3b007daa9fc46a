#include "cells.h"

#include <string.h>

/* Move one cell's text to its beginning, without quotes.
 * Out:     closed  0 for a quote without its end
 * Returns: the mark or the end behind it */
static char *unquote(char *at, char mark, int *closed)
{
  char *to = at, *from = at + strspn(at, " ");
  const int quoted = *from == '"';
  int inside = quoted;
  for (at = quoted ? from + 1 : at; *at && (inside || *at != mark); at++)
    if (quoted && *at == '"' && !(inside && at[1] == '"'))
      inside = 0;
    else {
      *to++ = *at;
      at += quoted && *at == '"'; /* two for one */
    }
  *closed = !inside;
  if (to < at)
    *to = '\0';
  return at;
}

int lab_cells_cut(char *at, char mark, char *cell[], int most)
{
  int n = 0, more = 1;
  while (more && n < most) {
    int closed;
    cell[n++] = at;
    at = unquote(at, mark, &closed);
    if (!closed)
      return -1;
    more = *at != '\0';
    *at++ = '\0';
  }
  return n;
}

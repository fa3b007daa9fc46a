#include "split.h"

#include <string.h>

static const char blanks[] = " \t\r\n";

char *lab_trim(char *text)
{
  char *end;
  text += strspn(text, blanks);
  end = text + strlen(text);
  while (end > text && strchr(blanks, end[-1]))
    *--end = '\0';
  return text;
}

int lab_split(char *text, char mark, const char **part, int room)
{
  int n = 0;
  while (text) {
    char *next = strchr(text, mark);
    if (next)
      *next++ = '\0';
    text = lab_trim(text);
    if (*text && n == room)
      return -1;
    if (*text)
      part[n++] = text;
    text = next;
  }
  return n;
}

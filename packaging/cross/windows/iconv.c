#include "iconv.h"

#include <errno.h>
#include <string.h>
#include <windows.h>

struct windows_encoding {
  const char *name;
  size_t unit; /* bytes */
  int swapped;
};

static const struct windows_encoding encodings[] = {{"UTF-16LE", 2, 0}, {"UTF-16BE", 2, 1}, {"WINDOWS-1252", 1, 0}};
enum { ENCODINGS = sizeof encodings / sizeof encodings[0] };

iconv_t iconv_open(const char *to, const char *from)
{
  int i;
  for (i = 0; i < ENCODINGS && strcmp(to, "UTF-8") == 0; i++)
    if (strcmp(encodings[i].name, from) == 0)
      return &encodings[i];
  return (iconv_t)-1;
}

int iconv_close(iconv_t converter)
{
  (void)converter;
  return 0;
}

static wchar_t unit_at(iconv_t c, const char *text)
{
  const unsigned char *byte = (const unsigned char *)text;
  wchar_t wide = 0;
  if (c->unit == 2)
    return (wchar_t)(byte[c->swapped] | byte[!c->swapped] << 8);
  return MultiByteToWideChar(1252, 0, text, 1, &wide, 1) == 1 ? wide : 0xFFFF;
}

/* The character at the begin of a text.  Out: wide  one unit or two  Returns: their number; 0 with errno */
static int character(iconv_t c, const char *text, size_t size, wchar_t wide[2])
{
  int n = 1;
  errno = EINVAL;
  if (size < c->unit)
    return 0;
  wide[0] = unit_at(c, text);
  if (IS_HIGH_SURROGATE(wide[0])) {
    if (size < 2 * c->unit)
      return 0;
    wide[1] = unit_at(c, text + c->unit);
    n = 2;
  }
  errno = EILSEQ;
  return IS_LOW_SURROGATE(wide[0]) || (n == 2 && !IS_LOW_SURROGATE(wide[1])) ? 0 : n;
}

size_t iconv(iconv_t c, char **in, size_t *size, char **out, size_t *room)
{
  while (*size > 0) {
    wchar_t wide[2];
    char text[4];
    const int n = character(c, *in, *size, wide);
    const int length = n ? WideCharToMultiByte(CP_UTF8, 0, wide, n, text, sizeof text, NULL, NULL) : 0;
    if (!n)
      return (size_t)-1;
    if ((size_t)length > *room) {
      errno = E2BIG;
      return (size_t)-1;
    }
    memcpy(*out, text, (size_t)length);
    *out += length;
    *room -= (size_t)length;
    *in += (size_t)n * c->unit;
    *size -= (size_t)n * c->unit;
  }
  return 0;
}

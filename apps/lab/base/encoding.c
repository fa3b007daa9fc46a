#include "encoding.h"

#include <errno.h>
#include <iconv.h>
#include <string.h>

#include "escape.h"

static const struct mark {
  const char *begin; /* of the text, with which of its bytes are 0 */
  int zero[4];
  size_t size;
  const char *name;
} marks[] = {
    {"\xFF\xFE", {0}, 2, "UTF-16LE"},
    {"\xFE\xFF", {0}, 2, "UTF-16BE"},
    {NULL, {0, 1, 0, 1}, 4, "UTF-16LE"},
    {NULL, {1, 0, 1, 0}, 4, "UTF-16BE"},
};
enum { MARKS = sizeof marks / sizeof marks[0] };

static int has_zeros(const char *text, const int zero[4])
{
  int i;
  for (i = 0; i < 4; i++)
    if ((text[i] == '\0') != zero[i])
      return 0;
  return 1;
}

const char *lab_encoding_of(const char *text, size_t size)
{
  int i;
  for (i = 0; i < MARKS; i++)
    if (size >= marks[i].size &&
        (marks[i].begin ? memcmp(text, marks[i].begin, 2) == 0 : has_zeros(text, marks[i].zero)))
      return marks[i].name;
  return NULL;
}

size_t lab_encode(const char *from, const char *text, size_t size, char *out, size_t room)
{
  iconv_t converter = iconv_open("UTF-8", from);
  const size_t unit = strncmp(from, "UTF-16", 6) == 0 ? 2 : 1;
  char *in = (char *)text, *to = out;
  size_t left = room - 1;
  if (converter == (iconv_t)-1)
    return (size_t)-1;
  while (size > 0 && iconv(converter, &in, &size, &to, &left) == (size_t)-1 && errno != E2BIG && size > unit) {
    in += unit; /* no character */
    size -= unit;
  }
  iconv_close(converter);
  *to = '\0';
  return room - 1 - left;
}

/* Cut a text to `room` bytes, no character of it in two. */
static void cut(const char *text, char *out, size_t room)
{
  size_t n = strlen(text);
  if (n >= room)
    for (n = room - 1; n > 0 && ((unsigned char)text[n] & 0xC0) == 0x80; n--)
      ;
  memcpy(out, text, n);
  out[n] = '\0';
}

void lab_encode_cell(const char *text, char *out, size_t room)
{
  if (lab_is_plain(text) || lab_encode("WINDOWS-1252", text, strlen(text), out, room) == (size_t)-1)
    cut(text, out, room);
}

#include "escape.h"

#include <ctype.h>
#include <string.h>

static const char replacement[] = "\xEF\xBF\xBD"; /* U+FFFD */

/* ---- What is plain ---- */

/* Bytes of the UTF-8 character at `text`, 0 if there is none.  Out: code */
static size_t decode(const char *text, unsigned long *code)
{
  static const struct {
    unsigned char mask, lead;
    unsigned long least;
  } shape[] = {{0x80, 0x00, 0}, {0xE0, 0xC0, 0x80}, {0xF0, 0xE0, 0x800}, {0xF8, 0xF0, 0x10000}};
  const unsigned char *byte = (const unsigned char *)text;
  size_t n = 0, i;
  while (n < sizeof shape / sizeof *shape && (*byte & shape[n].mask) != shape[n].lead)
    n++;
  if (n == sizeof shape / sizeof *shape)
    return 0;
  *code = *byte & ~(unsigned)shape[n].mask & 0xFF;
  for (i = 1; i <= n; i++) {
    if ((byte[i] & 0xC0) != 0x80)
      return 0;
    *code = *code << 6 | (byte[i] & 0x3F);
  }
  return *code >= shape[n].least ? n + 1 : 0;
}

/* Bytes of the plain character at `text`, 0 if it is not. */
static size_t plain_length(const char *text)
{
  static const struct {
    unsigned long first, last;
  } hidden[] = {{0, 0x1F},        {0x7F, 0x9F},     {0x2028, 0x202E},    {0x2066, 0x2069},
                {0xD800, 0xDFFF}, {0xFFFE, 0xFFFF}, {0x110000, 0x1FFFFF}};
  unsigned long code;
  const size_t n = decode(text, &code);
  size_t i;
  for (i = 0; n && i < sizeof hidden / sizeof *hidden; i++)
    if (code >= hidden[i].first && code <= hidden[i].last)
      return 0;
  return n;
}

int lab_is_plain(const char *text)
{
  size_t n = 1;
  for (; *text && n; text += n)
    n = plain_length(text);
  return !*text;
}

void lab_make_plain(char *text)
{
  while (*text) {
    const size_t n = plain_length(text);
    if (!n)
      *text = '?';
    text += n ? n : 1;
  }
}

void lab_make_file_name(char *name)
{
  if (*name == '.')
    *name = '-';
  for (; *name; name++)
    if (*name == '/' || *name == '\\')
      *name = '-';
}

/* ---- Kinds of files ---- */

/* A character, or what stands for one that is not plain.  Returns: bytes taken */
static size_t put_plain(FILE *file, const char *text)
{
  const size_t n = plain_length(text);
  if (n)
    fwrite(text, 1, n, file);
  else
    fputs(replacement, file);
  return n ? n : 1;
}

void lab_put_html(FILE *file, const char *text)
{
  static const struct {
    char plain;
    const char *escaped;
  } table[] = {{'&', "&amp;"},  {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"},
               {'\'', "&#39;"}, {'\n', "\n"},  {'\t', "\t"}};
  while (*text) {
    size_t i = 0;
    while (i < sizeof table / sizeof *table && table[i].plain != *text)
      i++;
    if (i == sizeof table / sizeof *table) {
      text += put_plain(file, text);
      continue;
    }
    fputs(table[i].escaped, file);
    text++;
  }
}

void lab_put_address(FILE *file, const char *path)
{
  for (; *path; path++)
    if (isalnum((unsigned char)*path) || strchr("-._~/", *path))
      fputc(*path, file);
    else
      fprintf(file, "%%%02X", (unsigned char)*path);
}

/* In quotes or not, behind an apostrophe or not. */
static void put_cell(FILE *file, const char *text, const char *before)
{
  const int quoted = text[strcspn(text, ",\"\r\n")] != '\0';
  fprintf(file, "%s%s", quoted ? "\"" : "", before);
  while (*text)
    if (strchr("\r\n\t", *text)) {
      fputc(' ', file);
      text++;
    } else {
      if (*text == '"') /* doubled */
        fputc('"', file);
      text += put_plain(file, text);
    }
  fputs(quoted ? "\"" : "", file);
}

void lab_put_cell(FILE *file, const char *text)
{
  put_cell(file, text, "");
}

void lab_put_users_cell(FILE *file, const char *text)
{
  /* https://owasp.org/www-community/attacks/CSV_Injection; the last four are the wide forms of the first */
  static const char *const marks[] = {"=", "+", "-", "@", "\t", "\r", "\n", "\uFF1D", "\uFF0B", "\uFF0D", "\uFF20"};
  size_t i = 0;
  while (i < sizeof marks / sizeof *marks && strncmp(text, marks[i], strlen(marks[i])) != 0)
    i++;
  put_cell(file, text, i < sizeof marks / sizeof *marks ? "'" : "");
}

void lab_put_config(FILE *file, const char *text)
{
  fputc('"', file);
  for (; *text; text++)
    if (*text == '"' || *text == '\\')
      fprintf(file, "\\%c", *text);
    else if (iscntrl((unsigned char)*text))
      fprintf(file, "\\x%02x", (unsigned char)*text);
    else
      fputc(*text, file);
  fputc('"', file);
}

void lab_put_gnuplot(FILE *file, const char *text)
{
  fputc('\'', file);
  for (; *text; text++)
    fputs(*text == '\'' ? "''" : (char[]){*text, '\0'}, file);
  fputc('\'', file);
}

void lab_put_comment(FILE *file, const char *text)
{
  char before = '\0';
  while (*text) {
    if ((before == '*' && *text == '/') || (before == '/' && *text == '*'))
      fputc(' ', file);
    before = *text;
    text += put_plain(file, text);
  }
}

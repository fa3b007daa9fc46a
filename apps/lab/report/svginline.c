#include "svginline.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/template.h"

/* Where a name goes in. */
static const struct {
  const char *found, *written;
} marks[] = {{" id='", " id='"}, {" id=\"", " id=\""}, {"xlink:href='#", "href='#"}, {"url(#", "url(#"}};

/* What is written in another way. */
static const struct {
  const char *found, *written;
} words[] = {{"fill=\"#ffffff\"", "fill=\"none\""},
             {" color=\"black\"", ""},
             {"fill=\"black\"", "fill=\"currentColor\""},
             {" font-family=\"sans-serif\" ", " "},
             {" font-family=\"sans-serif\"", ""}};

/* Colours, and the style's variables for them. */
static const struct {
  int red, green, blue;
  const char *name;
} colours[] = {{0, 114, 178, "blue"},   {213, 94, 0, "vermillion"}, {230, 159, 0, "orange"}, {34, 34, 34, "ink"},
               {118, 118, 118, "grey"}, {226, 226, 226, "rule"},    {241, 238, 221, "band"}, {221, 213, 176, "sand"},
               {196, 196, 196, "wide"}, {176, 176, 176, "pale"}};

enum { COLOURS = sizeof colours / sizeof *colours, MARKS = sizeof marks / sizeof *marks };
enum { WORDS = sizeof words / sizeof *words };

static int begins(const char *text, const char *with)
{
  return strncmp(text, with, strlen(with)) == 0;
}

/* Each of the following writes what stands at `text`, if it is of its kind.  Returns: characters taken; 0 if it is not
 */

static size_t put_colour(FILE *file, const char *text)
{
  int c, red, green, blue, length = 0;
  if (!begins(text, "rgb(") || sscanf(text, "rgb(%d,%d,%d)%n", &red, &green, &blue, &length) != 3 || !length)
    return 0;
  for (c = 0; c < COLOURS; c++)
    if (colours[c].red == red && colours[c].green == green && colours[c].blue == blue) {
      fprintf(file, "var(--f-%s)", colours[c].name);
      return (size_t)length;
    }
  return 0;
}

static size_t put_title(FILE *file, const char *text)
{
  static const char open[] = "<title>", close[] = "</title>";
  const char *end = begins(text, open) ? strstr(text, close) : NULL;
  (void)file;
  return end ? (size_t)(end - text) + sizeof close - 1 : 0;
}

/* <g id="figure_plot_2a" ><title>before</title> */
static size_t put_curve(FILE *file, const char *text)
{
  static const char open[] = "<g id=\"", middle[] = "\" ><title>", close[] = "</title>";
  static const char letters[] = "abcdefghijklmnopqrstuvwxyz";
  const char *title = text + strlen(open), *end;
  int length;
  if (!begins(text, open) || !begins(title += strcspn(title, "\""), middle))
    return 0;
  title += strlen(middle);
  end = strstr(title, close);
  length = (int)strspn(title, letters);
  if (!end)
    return 0;
  if (length > 0 && title + length == end)
    fprintf(file, "<g class=\"c-%.*s\">", length, title);
  else
    fputs("<g>", file);
  return (size_t)(end - text) + strlen(close);
}

static size_t put_empty_group(FILE *file, const char *text)
{
  static const char close[] = "</g>\n";
  const char *end = begins(text, "<g fill") ? strchr(text, '>') : NULL;
  (void)file;
  if (!end)
    return 0;
  end += 1 + strspn(end + 1, " \t\n");
  return begins(end, close) ? (size_t)(end - text) + strlen(close) : 0;
}

/* ... with the drawing's name in it */
static size_t put_id(FILE *file, const char *text, const char *name)
{
  size_t i = 0;
  while (i < MARKS && !begins(text, marks[i].found))
    i++;
  if (i == MARKS)
    return 0;
  fprintf(file, "%s%s_", marks[i].written, name);
  return strlen(marks[i].found);
}

static size_t put_word(FILE *file, const char *text)
{
  size_t i = 0;
  while (i < WORDS && !begins(text, words[i].found))
    i++;
  if (i == WORDS)
    return 0;
  fputs(words[i].written, file);
  return strlen(words[i].found);
}

static void rewrite(FILE *file, const char *text, const char *name)
{
  static size_t (*const kinds[])(FILE *, const char *) = {put_curve, put_title, put_empty_group, put_colour, put_word};
  while (*text) {
    size_t taken = 0, k;
    for (k = 0; k < sizeof kinds / sizeof *kinds && !taken; k++)
      taken = kinds[k](file, text);
    if (!taken)
      taken = put_id(file, text, name);
    if (!taken)
      fputc(*text, file);
    text += taken ? taken : 1;
  }
}

char *lab_svg_inline(const char *svg, const char *name, const char *alt, int head)
{
  const char *box = strstr(svg, "viewBox=\"0 0 "), *body = box ? strstr(box, "<g ") : NULL;
  char *text = NULL;
  size_t size;
  int width, height;
  FILE *file = body && sscanf(box, "viewBox=\"0 0 %d %d", &width, &height) == 2 ? open_memstream(&text, &size) : NULL;
  if (!file)
    return NULL;
  fprintf(file, "<svg viewBox=\"0 %d %d %d\" role=\"img\" aria-label=\"", head, width, height - head);
  lab_html_escape(file, alt);
  fputs("\">\n", file);
  rewrite(file, body, name);
  if (ferror(file) | fclose(file)) {
    free(text);
    return NULL;
  }
  return text;
}

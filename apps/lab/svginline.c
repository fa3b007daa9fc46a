#include "svginline.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "template.h"

/* Where a name goes in. */
static const struct {
  const char *found, *written;
} marks[] = {{" id='", " id='"}, {" id=\"", " id=\""}, {"xlink:href='#", "href='#"}, {"url(#", "url(#"}};

/* Copy, with `name` after every mark and without <title>..</title>. */
static void rename_ids(FILE *file, const char *text, const char *name)
{
  static const char open[] = "<title>", close[] = "</title>";
  while (*text) {
    size_t i = 0;
    if (!strncmp(text, open, sizeof open - 1) && strstr(text, close)) {
      text = strstr(text, close) + sizeof close - 1;
      continue;
    }
    while (i < sizeof marks / sizeof *marks && strncmp(text, marks[i].found, strlen(marks[i].found)) != 0)
      i++;
    if (i < sizeof marks / sizeof *marks) {
      fprintf(file, "%s%s_", marks[i].written, name);
      text += strlen(marks[i].found);
    } else {
      fputc(*text++, file);
    }
  }
}

char *lab_svg_inline(const char *svg, const char *name, const char *alt)
{
  const char *box = strstr(svg, "viewBox=\""), *body = box ? strstr(box, "<g ") : NULL;
  char *text = NULL;
  size_t size;
  FILE *file = body ? open_memstream(&text, &size) : NULL;
  if (!file)
    return NULL;
  box += strlen("viewBox=\"");
  fprintf(file, "<svg viewBox=\"%.*s\" role=\"img\" aria-label=\"", (int)strcspn(box, "\""), box);
  lab_html_escape(file, alt);
  fputs("\">\n", file);
  rename_ids(file, body, name);
  if (ferror(file) | fclose(file)) {
    free(text);
    return NULL;
  }
  return text;
}

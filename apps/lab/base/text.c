#include "text.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int cannot_read(const char *path, lab_error *error)
{
  if (errno == ENOENT || errno == ENOTDIR || errno == ENAMETOOLONG)
    return lab_fail(error, LAB_DATA, "%s: there is no such file; check the name and the folder", path);
  if (errno == EISDIR)
    return lab_fail(error, LAB_DATA, "%s: this is a folder, not a file", path);
  return lab_fail(error, LAB_WORLD, "%s: cannot be read: %s", path, strerror(errno));
}

/* Double the room.  Returns: 0 without memory. */
static int grow(lab_text *text, size_t *room)
{
  char *more = realloc(text->data, 2 * *room + 1);
  if (!more)
    return 0;
  text->data = more;
  *room *= 2;
  return 1;
}

static int read_stream(FILE *file, const char *path, lab_text *text, lab_error *error)
{
  size_t room = 1 << 15, got;
  do {
    if (!grow(text, &room))
      return lab_fail_memory(error, path);
    errno = 0;
    got = fread(text->data + text->size, 1, room - text->size, file);
    text->size += got;
  } while (text->size == room);
  text->data[text->size] = '\0';
  return ferror(file) ? cannot_read(path, error) : LAB_OK;
}

static int check_text(const char *path, lab_text *text, lab_error *error)
{
  const char *zero = memchr(text->data, '\0', text->size), *at;
  int line = 1;
  if (text->size == 0)
    return lab_fail(error, LAB_DATA, "%s: the file is empty", path);
  if (!zero)
    return LAB_OK;
  for (at = text->data; at < zero; at++)
    line += *at == '\n';
  return lab_fail(error, LAB_DATA, "%s:%d: expected text, found a 0 byte (a binary file, or UTF-16?)", path, line);
}

static void drop_mark(lab_text *text)
{
  const char mark[] = "\xEF\xBB\xBF";
  if (text->size < 3 || memcmp(text->data, mark, 3) != 0)
    return;
  text->size -= 3;
  memmove(text->data, text->data + 3, text->size + 1);
}

int lab_text_read(const char *path, lab_text *text, lab_error *error)
{
  FILE *file = fopen(path, "rb");
  int status;
  text->data = NULL;
  text->size = 0;
  if (!file)
    return cannot_read(path, error);
  status = read_stream(file, path, text, error);
  fclose(file);
  if (status == LAB_OK) {
    drop_mark(text);
    status = check_text(path, text, error);
  }
  if (status != LAB_OK)
    lab_text_free(text);
  return status;
}

void lab_text_free(lab_text *text)
{
  free(text->data);
  text->data = NULL;
  text->size = 0;
}

void lab_lines_start(lab_lines *lines, const lab_text *text)
{
  lines->at = text->data;
  lines->end = text->data + text->size;
  lines->number = 0;
}

int lab_lines_next(lab_lines *lines, const char **begin, const char **end)
{
  const char *stop;
  if (lines->at >= lines->end)
    return 0;
  stop = memchr(lines->at, '\n', (size_t)(lines->end - lines->at));
  *begin = lines->at;
  *end = stop ? stop : lines->end;
  lines->at = *end + 1;
  lines->number++;
  if (*end > *begin && (*end)[-1] == '\r')
    --*end;
  return 1;
}

size_t lab_lines_count(const lab_text *text)
{
  const char *at = text->data, *end = text->data + text->size;
  size_t n = 0;
  while (at < end) {
    const char *stop = memchr(at, '\n', (size_t)(end - at));
    at = stop ? stop + 1 : end;
    n++;
  }
  return n;
}

const char *lab_file_name(const char *path)
{
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

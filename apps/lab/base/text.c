#include "text.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int cannot_read(const char *path, lab_error *error)
{
  if (errno == ENOENT || errno == ENOTDIR || errno == ENAMETOOLONG)
    return lab_fail(error, LAB_DATA, "%s: there is no such file; check the name and the folder", path);
  if (errno == EISDIR)
    return lab_fail(error, LAB_DATA, "%s: this is a folder, not a file", path);
  return lab_fail(error, LAB_WORLD, "%s: cannot be read: %s", path, strerror(errno));
}

/* Whether an open file is one that ends, and soon enough. */
static int check_kind(int file, const char *path, lab_error *error)
{
  struct stat info;
  if (fstat(file, &info))
    return cannot_read(path, error);
  if (S_ISDIR(info.st_mode)) {
    errno = EISDIR;
    return cannot_read(path, error);
  }
  if (!S_ISREG(info.st_mode))
    return lab_fail(error, LAB_DATA, "%s: this is a pipe or a device; expected a file on a disk", path);
  if (info.st_size > LAB_TEXT_MAX)
    return lab_fail(error, LAB_DATA, "%s: expected at most %d MB, found %lld", path, LAB_TEXT_MAX >> 20,
                    (long long)info.st_size >> 20);
  return LAB_OK;
}

FILE *lab_text_open(const char *path, lab_error *error)
{
  const int file = open(path, O_RDONLY | O_NONBLOCK); /* does not wait for who writes into a pipe */
  FILE *stream = NULL;
  if (file < 0) {
    cannot_read(path, error);
    return NULL;
  }
  if (check_kind(file, path, error) == LAB_OK && !(stream = fdopen(file, "rb")))
    lab_fail_memory(error, path);
  if (!stream)
    close(file);
  return stream;
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
  } while (text->size == room && !memchr(text->data + text->size - got, '\0', got));
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
  FILE *file = lab_text_open(path, error);
  int status;
  text->data = NULL;
  text->size = 0;
  if (!file)
    return error->status;
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

const char *lab_file_name(const char *path)
{
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

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

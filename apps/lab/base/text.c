#include "text.h"

#include <errno.h>
#include <fcntl.h>
#include <iconv.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "escape.h"
#include "names.h"

/* Files that hold a log and are no text, by the bytes they begin with, and what makes a CSV of them. */
static const struct binary {
  const char *begin;
  size_t size;
  const char *kind, *command;
} binaries[] = {
#define KIND(begin, kind, command)                                                                                     \
  {                                                                                                                    \
    begin, sizeof begin - 1, kind, command                                                                             \
  }
    KIND("\x1F\x8B", "compressed by gzip", "gunzip -k FILE"),
    KIND("PK\x03\x04", "an Excel workbook (.xlsx) or another ZIP archive", "soffice --headless --convert-to csv FILE"),
    KIND("\xD0\xCF\x11\xE0", "an Excel workbook (.xls)", "soffice --headless --convert-to csv FILE"),
    KIND("MATLAB 5.0 MAT-file", "a MATLAB file", "in MATLAB: writetable(struct2table(load('FILE')), 'log.csv')"),
    KIND("\x89HDF", "HDF5, as MATLAB writes with -v7.3",
         "in MATLAB: writetable(struct2table(load('FILE')), 'log.csv')"),
    KIND("PAR1", "Parquet", "python3 -c \"import pandas; pandas.read_parquet('FILE').to_csv('log.csv')\""),
    KIND("TDSm", "TDMS, as LabVIEW writes",
         "python3 -c \"import nptdms; nptdms.TdmsFile('FILE').as_dataframe().to_csv('log.csv')\""),
    KIND("MDF     ", "MDF, as measuring software of cars writes",
         "python3 -c \"import asammdf; asammdf.MDF('FILE').export('csv', 'log.csv')\""),
#undef KIND
};
enum { BINARIES = sizeof binaries / sizeof binaries[0] };

/* ---- Encodings ---- */

/* The encoding of a text that is UTF-16, by its byte order mark or by every other byte of its first two characters;
 * NULL of any other. */
static const char *encoding_of(const char *text, size_t size)
{
  if (size >= 2 && memcmp(text, "\xFF\xFE", 2) == 0)
    return "UTF-16LE";
  if (size >= 2 && memcmp(text, "\xFE\xFF", 2) == 0)
    return "UTF-16BE";
  if (size >= 4 && !text[0] == !text[2] && !text[1] == !text[3] && !text[0] != !text[1])
    return text[0] ? "UTF-16LE" : "UTF-16BE";
  return NULL;
}

/* A text in UTF-8.
 * In:      from  name of its encoding, as iconv has it
 * Out:     out   `room` bytes, with a 0 byte behind the text; what is no character is left out
 * Returns: bytes written without the 0; (size_t)-1 where this system does not know the encoding. */
static size_t encode(const char *from, const char *text, size_t size, char *out, size_t room)
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
  if (lab_is_plain(text) || encode("WINDOWS-1252", text, strlen(text), out, room) == (size_t)-1)
    cut(text, out, room);
}

/* ---- Files ---- */

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

int lab_text_stream(FILE *file, const char *path, lab_text *text, lab_error *error)
{
  size_t room = 1 << 15, got;
  do {
    if (!grow(text, &room))
      return lab_fail_memory(error, path);
    errno = 0;
    got = fread(text->data + text->size, 1, room - text->size, file);
    text->size += got;
  } while (text->size == room &&
           (encoding_of(text->data, text->size) || !memchr(text->data + text->size - got, '\0', got)));
  text->data[text->size] = '\0';
  return ferror(file) ? cannot_read(path, error) : LAB_OK;
}

/* UTF-16 becomes UTF-8, which is at most half as long again. */
static int recode(const char *path, lab_text *text, lab_error *error)
{
  const char *from = encoding_of(text->data, text->size);
  const size_t room = text->size + text->size / 2 + 4;
  char *out = from ? malloc(room) : NULL;
  size_t size;
  if (!from)
    return LAB_OK;
  if (!out)
    return lab_fail_memory(error, path);
  size = encode(from, text->data, text->size, out, room);
  free(text->data);
  text->data = out;
  text->size = size;
  if (size == (size_t)-1)
    return lab_fail(error, LAB_DATA, "%s: this is UTF-16, which this system cannot read; save it as UTF-8", path);
  return LAB_OK;
}

static int check_kind_of_text(const char *path, const lab_text *text, lab_error *error)
{
  int i;
  for (i = 0; i < BINARIES; i++)
    if (text->size >= binaries[i].size && memcmp(text->data, binaries[i].begin, binaries[i].size) == 0)
      return lab_fail(error, LAB_DATA, "%s: this is %s, not text; make a text file of it: %s", path, binaries[i].kind,
                      binaries[i].command);
  return LAB_OK;
}

static int check_text(const char *path, const lab_text *text, lab_error *error)
{
  const char *zero = memchr(text->data, '\0', text->size), *at;
  int line = 1;
  if (text->size == 0)
    return lab_fail(error, LAB_DATA, "%s: the file is empty", path);
  if (check_kind_of_text(path, text, error))
    return error->status;
  if (!zero)
    return LAB_OK;
  for (at = text->data; at < zero; at++)
    line += *at == '\n';
  return lab_fail(error, LAB_DATA, "%s:%d: expected text, found a 0 byte: this is no text file; export it as CSV", path,
                  line);
}

static void drop_mark(lab_text *text)
{
  const char mark[] = "\xEF\xBB\xBF";
  if (text->size < 3 || memcmp(text->data, mark, 3) != 0)
    return;
  text->size -= 3;
  memmove(text->data, text->data + 3, text->size + 1);
}

/* Lines that end in CR alone, as on an old Mac, end in LF. */
static void mend_ends(lab_text *text)
{
  size_t i;
  if (memchr(text->data, '\n', text->size))
    return;
  for (i = 0; i < text->size; i++)
    if (text->data[i] == '\r')
      text->data[i] = '\n';
}

static struct {
  const lab_text_given *text; /* NULL: files are read */
  int n;
} given;

void lab_text_give(const lab_text_given *text, int n)
{
  given.text = text;
  given.n = n;
}

static int read_given(const char *name, lab_text *text, lab_error *error)
{
  const int i = lab_name_index(name, given.text, (size_t)given.n, sizeof *given.text);
  if (i < 0)
    return lab_fail(error, LAB_DATA, "%s: no text of that name was given", name);
  text->size = given.text[i].size;
  text->data = malloc(text->size + 1);
  if (!text->data)
    return lab_fail_memory(error, name);
  memcpy(text->data, given.text[i].data, text->size);
  text->data[text->size] = '\0';
  return LAB_OK;
}

static int read_file(const char *path, lab_text *text, lab_error *error)
{
  FILE *file = lab_text_open(path, error);
  int status;
  if (!file)
    return error->status;
  status = lab_text_stream(file, path, text, error);
  fclose(file);
  return status;
}

int lab_text_read(const char *path, lab_text *text, lab_error *error)
{
  int status;
  text->data = NULL;
  text->size = 0;
  status = given.text ? read_given(path, text, error) : read_file(path, text, error);
  if (status == LAB_OK)
    status = recode(path, text, error);
  if (status == LAB_OK) {
    drop_mark(text);
    mend_ends(text);
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

FILE *lab_writing_begin(lab_writing *w)
{
  w->text = NULL;
  return w->file = open_memstream(&w->text, &w->size);
}

char *lab_writing_end(lab_writing *w)
{
  int failed = !w->file || ferror(w->file);
  failed |= w->file && fclose(w->file) != 0;
  if (!failed)
    return w->text;
  free(w->text);
  return NULL;
}

void lab_append(char *text, size_t size, const char *format, ...)
{
  const size_t used = strlen(text);
  va_list args;
  va_start(args, format);
  vsnprintf(text + used, size - used, format, args);
  va_end(args);
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

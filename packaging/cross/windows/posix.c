#include "posix.h"

#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>

#undef fclose

int windows_rename(const char *from, const char *to)
{
  if (MoveFileExA(from, to, MOVEFILE_REPLACE_EXISTING))
    return 0;
  errno = GetLastError() == ERROR_DISK_FULL ? ENOSPC : EACCES;
  return -1;
}

/* ---- Files without a name, and streams in memory ---- */

/* A stream in memory is a file that Windows keeps in memory where it can, and removes when it is closed. */
typedef struct stream {
  FILE *file;
  char **text;
  size_t *size;
  struct stream *next;
} stream;

static stream *streams;

FILE *windows_tmpfile(void)
{
  char folder[MAX_PATH], path[MAX_PATH];
  if (!GetTempPathA(sizeof folder, folder) || !GetTempFileNameA(folder, "pneu", 0, path))
    return NULL;
  return fopen(path, "w+bTD");
}

FILE *open_memstream(char **text, size_t *size)
{
  stream *s = malloc(sizeof *s);
  *text = NULL;
  *size = 0;
  if (!s || !(s->file = windows_tmpfile())) {
    free(s);
    return NULL;
  }
  s->text = text;
  s->size = size;
#pragma omp critical(windows_streams)
  {
    s->next = streams;
    streams = s;
  }
  return s->file;
}

/* Take a stream out of the list.  Returns: NULL if it is none in memory */
static stream *take(const FILE *file)
{
  stream **at, *s;
#pragma omp critical(windows_streams)
  {
    for (at = &streams; *at && (*at)->file != file; at = &(*at)->next)
      ;
    s = *at;
    if (s)
      *at = s->next;
  }
  return s;
}

/* Returns: 0 if the whole of a stream has become its text */
static int read_back(const stream *s)
{
  const long n = fseek(s->file, 0, SEEK_END) ? -1 : ftell(s->file);
  char *text = n < 0 || ferror(s->file) ? NULL : malloc((size_t)n + 1);
  if (!text)
    return EOF;
  rewind(s->file);
  *s->text = text;
  *s->size = fread(text, 1, (size_t)n, s->file);
  text[*s->size] = '\0';
  return *s->size == (size_t)n ? 0 : EOF;
}

int windows_fclose(FILE *file)
{
  stream *s = take(file);
  const int failed = s ? read_back(s) : 0;
  free(s);
  return fclose(file) || failed ? EOF : 0;
}

/* ---- The program ---- */

int __real_main(int argc, char **argv);
int __wrap_main(int argc, char **argv);

/* Files are as they are elsewhere, without carriage returns; text is UTF-8; paths may have backslashes. */
int __wrap_main(int argc, char **argv)
{
  int i;
  _fmode = _O_BINARY;
  _setmode(1, _O_BINARY);
  _setmode(2, _O_BINARY);
  SetConsoleOutputCP(CP_UTF8);
  for (i = 1; i < argc; i++) {
    char *at;
    for (at = argv[i]; (at = strchr(at, '\\')) != NULL;)
      *at = '/';
  }
  return __real_main(argc, argv);
}

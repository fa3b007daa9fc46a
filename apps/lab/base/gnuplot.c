#include "gnuplot.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include "escape.h"
#include "interrupt.h"
#include "outfile.h"

static const int no_program = 127; /* as the shell says it */

/* Figures are in UTF-8 whatever the user's locale; in that of a bare container, C, gnuplot warns of each that it cannot
 * write a degree sign. */
static const char locale[] = "C.UTF-8";

/* A Ctrl-C on a terminal reaches all that run there: let a figure that was begun be finished. */
static void put_off_signals(void)
{
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGHUP);
  sigprocmask(SIG_BLOCK, &set, NULL);
}

/* Run gnuplot; `in` and `out` take the place of standard input and output, unless -1.
 * Returns: its exit status, or -1. */
static int run(const char *const arguments[], int in, int out)
{
  int status = 0;
  const pid_t child = fork();
  if (child == 0) {
    put_off_signals();
    setenv("LC_ALL", locale, 1);
    if ((in < 0 || dup2(in, STDIN_FILENO) >= 0) && (out < 0 || dup2(out, STDOUT_FILENO) >= 0))
      execvp("gnuplot", (char *const *)arguments);
    _exit(no_program);
  }
  if (child < 0 || waitpid(child, &status, 0) < 0 || !WIFEXITED(status))
    return -1;
  return WEXITSTATUS(status);
}

static int cannot(int status, const char *script, const char *out, lab_error *error)
{
  if (status == no_program)
    return lab_fail(error, LAB_WORLD,
                    "gnuplot is not installed; install it (Debian: gnuplot-nox), or use --no-figures");
  if (status == 0)
    return lab_fail(error, LAB_WORLD, "%s: what gnuplot drew is not whole; is the folder of temporary files full?",
                    out);
  return lab_fail(error, LAB_WORLD, "gnuplot failed on %s for %s", script, out);
}

/* The whole of an open file as text, NULL if it cannot be read. */
static char *text_of(FILE *file)
{
  long size;
  char *text;
  if (fseek(file, 0, SEEK_END) || (size = ftell(file)) < 0)
    return NULL;
  rewind(file);
  text = malloc((size_t)size + 1);
  if (text && fread(text, 1, (size_t)size, file) != (size_t)size) {
    free(text);
    text = NULL;
  }
  if (text)
    text[size] = '\0';
  return text;
}

/* gnuplot does not say whether all that it drew has arrived: on a full disk it does not end so. */
static int is_whole(const char *drawing)
{
  static const char end[] = "</svg>";
  size_t length = strlen(drawing);
  while (length > 0 && strchr(" \r\n", drawing[length - 1]))
    length--;
  return length >= sizeof end - 1 && !strncmp(drawing + length - (sizeof end - 1), end, sizeof end - 1);
}

/* What gnuplot draws to standard output, by way of a file without a name. */
static char *drawing_of(const char *const arguments[], int in, int *status)
{
  FILE *out = tmpfile();
  char *text = NULL;
  *status = -1;
  if (!out)
    return NULL;
  lab_interrupt_hold();
  *status = run(arguments, in, fileno(out));
  lab_interrupt_release();
  if (*status == 0)
    text = text_of(out);
  fclose(out);
  if (text && !is_whole(text)) {
    free(text);
    text = NULL;
  }
  return text;
}

/* "IN='./folder'": a path that begins with < or | would be a command.  Returns: 0 if that has no room or is no line */
static int define_folder(const char *folder, char *text, size_t size)
{
  const int fits = !strpbrk(folder, "\r\n") && 2 * strlen(folder) + 16 <= size; /* each a quote, doubled */
  FILE *file = fits ? fmemopen(text, size, "w") : NULL;
  if (!file)
    return 0;
  fprintf(file, "IN=%s", *folder == '/' ? "" : "'./'.");
  lab_put_gnuplot(file, folder);
  return fclose(file) == 0;
}

/* Put a drawing, which is freed, into the file `out`. */
static int keep(char *drawing, const char *out, lab_error *error)
{
  lab_outfile file;
  int status = lab_out_open(&file, out, error);
  if (status == LAB_OK) {
    fputs(drawing, file.file);
    status = lab_out_close(&file, error);
  }
  free(drawing);
  return status;
}

int lab_gnuplot_draw(const char *script, const char *in, const char *out, lab_error *error)
{
  char definitions[2400] = "", *drawing;
  const char *const arguments[] = {"gnuplot", "-e", definitions, script, NULL};
  int status;
  if (access(script, R_OK))
    return lab_fail(error, LAB_DATA, "%s: the script of a figure is missing", script);
  if (!define_folder(in, definitions, sizeof definitions))
    return lab_fail(error, LAB_DATA, "%s: gnuplot cannot take this path", in);
  drawing = drawing_of(arguments, -1, &status);
  return drawing ? keep(drawing, out, error) : cannot(status, script, out, error);
}

int lab_gnuplot_run(FILE *script, const char *out, int *drawn, lab_error *error)
{
  static const char *const arguments[] = {"gnuplot", NULL};
  char *drawing = NULL;
  int status = -1;
  if (fflush(script) == 0 && !ferror(script) && lseek(fileno(script), 0, SEEK_SET) == 0)
    drawing = drawing_of(arguments, fileno(script), &status);
  *drawn = drawing != NULL;
  if (drawing)
    return keep(drawing, out, error);
  return status == no_program ? LAB_OK : cannot(status, "its script", out, error);
}

#include "gnuplot.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

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

int lab_gnuplot_draw(const char *script, const char *in, const char *out, lab_error *error)
{
  char definitions[2400], *drawing;
  const char *const arguments[] = {"gnuplot", "-e", definitions, script, NULL};
  lab_outfile file;
  int status;
  if (access(script, R_OK))
    return lab_fail(error, LAB_DATA, "%s: the script of a figure is missing", script);
  if (strchr(in, '\'') || snprintf(definitions, sizeof definitions, "IN='%s'", in) >= (int)sizeof definitions)
    return lab_fail(error, LAB_DATA, "%s: gnuplot cannot take this path", in);
  drawing = drawing_of(arguments, -1, &status);
  if (!drawing)
    return cannot(status, script, out, error);
  status = lab_out_open(&file, out, error);
  if (status == LAB_OK) {
    fputs(drawing, file.file);
    status = lab_out_close(&file, error);
  }
  free(drawing);
  return status;
}

int lab_gnuplot_run(FILE *script, char **drawing, lab_error *error)
{
  static const char *const arguments[] = {"gnuplot", NULL};
  int status = -1;
  *drawing = NULL;
  if (fflush(script) == 0 && !ferror(script) && lseek(fileno(script), 0, SEEK_SET) == 0)
    *drawing = drawing_of(arguments, fileno(script), &status);
  if (status == 0 && !*drawing)
    return lab_fail(error, LAB_WORLD,
                    "what gnuplot drew cannot be read back: out of memory, or of room for temporary files");
  return status == 0 ? LAB_OK : cannot(status, "its script", "the report", error);
}

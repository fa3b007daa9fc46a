#include "gnuplot.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include "interrupt.h"

static const int no_program = 127; /* as the shell says it */

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
    return lab_fail(error, LAB_WORLD, "gnuplot is not installed; install it, or use --no-figures");
  return lab_fail(error, LAB_WORLD, "gnuplot failed on %s for %s", script, out);
}

int lab_gnuplot_draw(const char *script, const char *in, const char *out, lab_error *error)
{
  char part[1200], definitions[3600];
  const char *const arguments[] = {"gnuplot", "-e", definitions, script, NULL};
  int status, placed;
  if (access(script, R_OK))
    return lab_fail(error, LAB_DATA, "%s: the script of a figure is missing", script);
  if (snprintf(part, sizeof part, "%s.part", out) >= (int)sizeof part || strchr(in, '\'') || strchr(out, '\''))
    return lab_fail(error, LAB_DATA, "%s: gnuplot cannot take this path", out);
  snprintf(definitions, sizeof definitions, "IN='%s'; OUT='%s'", in, part);
  lab_interrupt_hold();
  status = run(arguments, -1, -1);
  placed = status == 0 && rename(part, out) == 0;
  if (!placed)
    remove(part);
  lab_interrupt_release();
  return placed ? LAB_OK : cannot(status, script, out, error);
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

int lab_gnuplot_run(FILE *script, char **drawing, lab_error *error)
{
  static const char *const arguments[] = {"gnuplot", NULL};
  FILE *out = tmpfile();
  int status = -1;
  *drawing = NULL;
  if (out && fflush(script) == 0 && !ferror(script) && lseek(fileno(script), 0, SEEK_SET) == 0) {
    lab_interrupt_hold();
    status = run(arguments, fileno(script), fileno(out));
    lab_interrupt_release();
  }
  if (status == 0)
    *drawing = text_of(out);
  if (out)
    fclose(out);
  if (status == 0 && !*drawing)
    return lab_fail(error, LAB_WORLD,
                    "what gnuplot drew cannot be read back: out of memory, or of room for temporary files");
  return status == 0 ? LAB_OK : cannot(status, "its script", "the report", error);
}

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
#include "text.h"

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

/* gnuplot does not say whether all that it drew has arrived: on a full disk it does not end so. */
static int is_whole(const lab_text *drawing)
{
  static const char end[] = "</svg>";
  size_t length = drawing->size;
  while (length > 0 && strchr(" \r\n", drawing->data[length - 1]))
    length--;
  return length >= sizeof end - 1 && !strncmp(drawing->data + length - (sizeof end - 1), end, sizeof end - 1);
}

/* What gnuplot draws to standard output, by way of a file without a name.
 * Out:     drawing  to be freed
 *          status   of gnuplot; -1: it did not run
 * Returns: whether it is whole */
static int draw(const char *const arguments[], int in, lab_text *drawing, int *status)
{
  FILE *out = tmpfile();
  lab_error ignored;
  int is_read = 0;
  *drawing = (lab_text){NULL, 0};
  *status = -1;
  if (!out)
    return 0;
  lab_interrupt_hold();
  *status = run(arguments, in, fileno(out));
  lab_interrupt_release();
  rewind(out);
  if (*status == 0)
    is_read = lab_text_stream(out, "a figure", drawing, &ignored) == LAB_OK;
  fclose(out);
  return is_read && is_whole(drawing);
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

static int keep(const lab_text *drawing, const char *out, lab_error *error)
{
  lab_outfile file;
  if (lab_out_open(&file, out, error))
    return error->status;
  fputs(drawing->data, file.file);
  return lab_out_close(&file, error);
}

int lab_gnuplot_draw(const char *script, const char *in, const char *out, lab_error *error)
{
  char definitions[2400] = "";
  const char *const arguments[] = {"gnuplot", "-e", definitions, script, NULL};
  lab_text drawing;
  int status;
  if (access(script, R_OK))
    return lab_fail(error, LAB_DATA, "%s: the script of a figure is missing", script);
  if (!define_folder(in, definitions, sizeof definitions))
    return lab_fail(error, LAB_DATA, "%s: gnuplot cannot take this path", in);
  status = draw(arguments, -1, &drawing, &status) ? keep(&drawing, out, error) : cannot(status, script, out, error);
  lab_text_free(&drawing);
  return status;
}

int lab_gnuplot_run(FILE *script, const char *out, int *drawn, lab_error *error)
{
  static const char *const arguments[] = {"gnuplot", NULL};
  lab_text drawing = {NULL, 0};
  int status = -1;
  *drawn = fflush(script) == 0 && !ferror(script) && lseek(fileno(script), 0, SEEK_SET) == 0 &&
           draw(arguments, fileno(script), &drawing, &status);
  if (*drawn)
    status = keep(&drawing, out, error);
  else
    status = status == no_program ? LAB_OK : cannot(status, "its script", out, error);
  lab_text_free(&drawing);
  return status;
}

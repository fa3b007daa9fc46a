#include "gnuplot.h"

#include <stdio.h>
#include <string.h>

#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

static const int no_program = 127; /* as the shell says it */

static int run(const char *script, const char *definitions)
{
  int status = 0;
  const pid_t child = fork();
  if (child == 0) {
    execlp("gnuplot", "gnuplot", "-e", definitions, script, (char *)NULL);
    _exit(no_program);
  }
  if (child < 0 || waitpid(child, &status, 0) < 0 || !WIFEXITED(status))
    return -1;
  return WEXITSTATUS(status);
}

int gnuplot_draw(const char *script, const char *in, const char *out, lab_error *error)
{
  char part[1200], definitions[3600];
  int status;
  if (access(script, R_OK))
    return lab_fail(error, LAB_DATA, "%s: the script of a figure is missing", script);
  if (snprintf(part, sizeof part, "%s.part", out) >= (int)sizeof part || strchr(in, '\'') || strchr(out, '\''))
    return lab_fail(error, LAB_DATA, "%s: gnuplot cannot take this path", out);
  snprintf(definitions, sizeof definitions, "IN='%s'; OUT='%s'", in, part);
  status = run(script, definitions);
  if (status == 0 && rename(part, out) == 0)
    return LAB_OK;
  remove(part);
  if (status == no_program)
    return lab_fail(error, LAB_WORLD, "gnuplot is not installed; install it, or use --no-figures");
  return lab_fail(error, LAB_WORLD, "gnuplot failed on %s for %s", script, out);
}

#include "message.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "escape.h"

#undef lab_fail

int lab_fail(lab_error *error, int status, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  vsnprintf(error->text, sizeof error->text, format, args);
  va_end(args);
  lab_make_plain(error->text); /* one line, and no control sequence of a terminal, whatever a file holds */
  error->status = status;
  return status;
}

int lab_fail_in(lab_error *error, const char *format, ...)
{
  char old[sizeof error->text];
  va_list args;
  size_t used;
  memcpy(old, error->text, sizeof old);
  va_start(args, format);
  vsnprintf(error->text, sizeof error->text, format, args);
  va_end(args);
  used = strlen(error->text);
  snprintf(error->text + used, sizeof error->text - used, ": %s", old);
  lab_make_plain(error->text);
  return error->status;
}

void lab_fail_together(lab_error *all, const lab_error *one)
{
  if (one->status != LAB_WORLD)
    return;
#pragma omp critical(lab_fail_together)
  *all = *one;
}

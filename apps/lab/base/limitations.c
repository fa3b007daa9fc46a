#include "limitations.h"

#include <stdarg.h>
#include <stdio.h>

static void add(lab_limitations *limitations, const char *format, va_list args) LAB_PRINTF(2, 0);

static void add(lab_limitations *limitations, const char *format, va_list args)
{
  if (limitations->n < LAB_LIMITATION_MAX)
    vsnprintf(limitations->text[limitations->n++], LAB_LIMITATION_TEXT, format, args);
  else
    snprintf(limitations->text[LAB_LIMITATION_MAX - 1], LAB_LIMITATION_TEXT,
             "There are more limitations than the %d listed.", (int)LAB_LIMITATION_MAX - 1);
}

void lab_limitation(lab_limitations *limitations, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  add(limitations, format, args);
  va_end(args);
}

void lab_limitation_no_verdict(lab_limitations *limitations, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  add(limitations, format, args);
  va_end(args);
  if (!limitations->doubt)
    limitations->doubt = limitations->n;
}

void lab_limitations_join(lab_limitations *limitations, const lab_limitations *held_out)
{
  int i;
  for (i = 0; i < held_out->n; i++)
    lab_limitation(limitations, "%s", held_out->text[i]);
}

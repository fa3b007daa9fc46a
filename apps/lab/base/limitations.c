#include "limitations.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static int add(lab_limitations *limitations, const char *format, va_list args) LAB_PRINTF(2, 0);

/* The number of the text, from 1. What is said already is not said again. */
static int add(lab_limitations *limitations, const char *format, va_list args)
{
  char text[LAB_LIMITATION_TEXT];
  int i;
  vsnprintf(text, sizeof text, format, args);
  for (i = 0; i < limitations->n; i++)
    if (!strcmp(limitations->text[i], text))
      return i + 1;
  if (limitations->n < LAB_LIMITATION_MAX)
    memcpy(limitations->text[limitations->n++], text, sizeof text);
  else
    snprintf(limitations->text[LAB_LIMITATION_MAX - 1], LAB_LIMITATION_TEXT,
             "There are more limitations than the %d listed.", (int)LAB_LIMITATION_MAX - 1);
  return limitations->n;
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
  int number;
  va_start(args, format);
  number = add(limitations, format, args);
  va_end(args);
  if (!limitations->doubt)
    limitations->doubt = number;
}

void lab_limitations_join(lab_limitations *limitations, const lab_limitations *held_out)
{
  int i;
  for (i = 0; i < held_out->n; i++)
    lab_limitation(limitations, "%s", held_out->text[i]);
}

#include "remarks.h"

#include <stdarg.h>
#include <stdio.h>

static void add(lab_remarks *remarks, const char *format, va_list args) LAB_PRINTF(2, 0);

static void add(lab_remarks *remarks, const char *format, va_list args)
{
  if (remarks->n < LAB_REMARK_MAX)
    vsnprintf(remarks->text[remarks->n++], LAB_REMARK_TEXT, format, args);
  else
    snprintf(remarks->text[LAB_REMARK_MAX - 1], LAB_REMARK_TEXT, "There are more limitations than the %d listed.",
             (int)LAB_REMARK_MAX - 1);
}

void lab_remark(lab_remarks *remarks, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  add(remarks, format, args);
  va_end(args);
}

void lab_remark_doubt(lab_remarks *remarks, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  add(remarks, format, args);
  va_end(args);
  if (!remarks->doubt)
    remarks->doubt = remarks->n;
}

void lab_remarks_join(lab_remarks *remarks, const lab_remarks *held_out)
{
  int i;
  for (i = 0; i < held_out->n; i++)
    lab_remark(remarks, "%s", held_out->text[i]);
}

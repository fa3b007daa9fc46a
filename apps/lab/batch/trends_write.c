/* trends.csv, and the sentences. */
#include <math.h>
#include <stdio.h>

#include "../base/escape.h"
#include "../base/format.h"
#include "../base/outfile.h"
#include "trends.h"

/* ---- Sentences ---- */

/* "10 %", or "5.00 kPa" */
static const char *tolerance_text(const lab_sample *s, char text[LAB_FORMAT_TEXT])
{
  if (s->declared == 0)
    return lab_format_quantity(s->tolerance, s->unit, 3, text);
  snprintf(text, LAB_FORMAT_TEXT, "%.3g %%", 100 * s->tolerance);
  return text;
}

/* "rises by 12.3 N/mm a day (10.1 to 14.5)" */
static void put_slope(FILE *file, const lab_trend *t)
{
  const double size = fabs(t->slope), scale = lab_format_as(t->last->unit).scale;
  char by[LAB_FORMAT_TEXT], low[LAB_FORMAT_TEXT], high[LAB_FORMAT_TEXT];
  fprintf(file, "%s by %s a day (%s to %s)", t->slope > 0 ? "rises" : "falls",
          lab_format_quantity(size, t->last->unit, 3, by), lab_format_number(scale * (size - t->half), 3, low),
          lab_format_number(scale * (size + t->half), 3, high));
}

const char *lab_trend_sentence(const lab_trend *t, char sentence[LAB_TREND_SENTENCE])
{
  char tolerance[LAB_FORMAT_TEXT];
  FILE *file = t->drifts ? fmemopen(sentence, LAB_TREND_SENTENCE, "w") : NULL;
  *sentence = '\0';
  if (!file)
    return sentence;
  fprintf(file, "%s ", t->last->parameter);
  tolerance_text(t->last, tolerance);
  if (t->days[0] > 0)
    fprintf(file, "leaves its tolerance of %s in %.0f days (%.0f to %.0f)", tolerance, t->days[0], t->days[1],
            t->days[2]);
  if (t->days[0] == 0)
    fprintf(file, "is outside its tolerance of %s and ", tolerance);
  if (!(t->days[0] > 0))
    put_slope(file, t);
  fclose(file);
  sentence[LAB_TREND_SENTENCE - 1] = '\0';
  return sentence;
}

/* ---- trends.csv ---- */

static void put_row(FILE *file, const lab_trend *t)
{
  const double number[] = {t->slope,
                           t->slope - t->half,
                           t->slope + t->half,
                           t->days[0],
                           t->days[1],
                           t->days[2],
                           lab_line_value(&t->line, t->last->at),
                           t->last->declared,
                           t->last->tolerance,
                           lab_line_scatter(&t->line)};
  size_t i;
  lab_put_users_cell(file, t->last->rig);
  fprintf(file, ",%s,%s,%d,", t->last->parameter, t->last->unit, t->line.n);
  lab_put_cell(file, t->first->date);
  fputc(',', file);
  lab_put_cell(file, t->last->date);
  for (i = 0; i < sizeof number / sizeof *number; i++)
    fprintf(file, isfinite(number[i]) ? ",%.6g" : ",", number[i]);
  fputc('\n', file);
}

int lab_trends_write(const lab_trends *trends, const char *path, lab_error *error)
{
  lab_outfile out;
  int i;
  if (trends->n == 0) {
    remove(path); /* it would be that of a list that had dates */
    return LAB_OK;
  }
  if (lab_out_open(&out, path, error))
    return error->status;
  fputs("rig,parameter,unit,n,first_date,last_date,slope_per_day,slope_low,slope_high,days_left,days_left_low,"
        "days_left_high,last_value,declared,tolerance,scatter\n",
        out.file);
  for (i = 0; i < trends->n; i++)
    put_row(out.file, &trends->of[i]);
  return lab_out_close(&out, error);
}

#include "series.h"

#include <math.h>

void lab_series_header(FILE *file, const lab_series_column *column, int n_columns)
{
  int i;
  for (i = 0; i < n_columns; i++)
    fprintf(file, "%s%s", i ? "," : "", column[i].title);
  fputc('\n', file);
}

static void write_number(FILE *file, double value)
{
  if (!isnan(value))
    fprintf(file, "%.10g", value + 0.0); /* no "-0" */
}

void lab_series_rows(FILE *file, const lab_series_column *column, int n_columns, size_t n_rows)
{
  size_t row;
  int i;
  for (row = 0; row < n_rows; row++)
    for (i = 0; i < n_columns; i++) {
      write_number(file, column[i].scale * column[i].value[row] + column[i].offset);
      fputc(i + 1 < n_columns ? ',' : '\n', file);
    }
}

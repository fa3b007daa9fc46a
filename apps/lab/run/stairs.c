#include "stairs.h"

#include <math.h>

enum { LEVEL, BEFORE, PRESSURE, SENT, SENT_BEFORE, MOVED, SENT_NOW, TRAVEL, COLUMNS };
enum { FEWEST_ROWS = 40 };
static const double plain = 5, interval = 2; /* deviations of a slope */
/* Of the slope on the row before. By simulation of lags of one and two orders, 0.3 to 3 rows long, lines that come up
 * to 1.25 rows late exceed one of these, but for a lag of 0.3 rows that is 0.75 rows late. */
static const double on_its_row = 0.1, on_two_before = 0.25;
static const double independent = 1e-6; /* of a column's square, that is left by those before it */

/* What the travel at row i may follow, and the travel.  Returns: 0 where a value is missing */
static int columns_at(const lab_log *log, size_t i, double *v)
{
  const double *x = log->value[LAB_CHANNEL_X], *sp = log->value[LAB_CHANNEL_SP], *p = log->value[LAB_CHANNEL_P];
  int k, all = 1;
  v[LEVEL] = 1;
  v[BEFORE] = x[i - 1];
  v[MOVED] = x[i - 1] - x[i - 2];
  v[PRESSURE] = p ? p[i - 1] : 0;
  v[SENT_BEFORE] = sp[i - 2];
  v[SENT] = sp[i - 1];
  v[SENT_NOW] = sp[i];
  v[TRAVEL] = x[i] - x[i - 1];
  for (k = 0; k < COLUMNS; k++)
    all &= !isnan(v[k]);
  return all;
}

/* Take out of the sums of products what goes with column k. A column that those before it make up is left out. */
static void take_out(double sum[COLUMNS][COLUMNS], int k, double whole)
{
  const double pivot = sum[k][k];
  int i, j;
  if (!(pivot > independent * whole))
    return;
  for (i = k + 1; i < COLUMNS; i++)
    for (j = k + 1; j < COLUMNS; j++)
      sum[i][j] -= sum[i][k] * sum[k][j] / pivot;
}

static size_t add_up(const lab_log *log, double sum[COLUMNS][COLUMNS])
{
  size_t run, i, n = 0;
  int k, j;
  for (run = 0; run < log->n_runs; run++)
    for (i = log->run[run] + 2; i < log->run[run + 1]; i++) {
      double v[COLUMNS];
      if (!columns_at(log, i, v))
        continue;
      n++;
      for (k = 0; k < COLUMNS; k++)
        for (j = 0; j < COLUMNS; j++)
          sum[k][j] += v[k] * v[j];
    }
  return n;
}

/* The slope of the travel on column k, beside those that were taken out, and its deviation.  Returns: whether there is
 * anything of that column beside them */
static int slope_on(double sum[COLUMNS][COLUMNS], int k, size_t n, double whole, double *slope, double *deviation)
{
  if (!(sum[k][k] > independent * whole))
    return 0;
  *slope = sum[k][TRAVEL] / sum[k][k];
  *deviation = sqrt(fmax(sum[TRAVEL][TRAVEL] - *slope * sum[k][TRAVEL], 0) / ((double)(n - COLUMNS) * sum[k][k]));
  return 1;
}

int lab_holds_between_rows(const lab_log *log)
{
  double sum[COLUMNS][COLUMNS] = {{0}}, whole[COLUMNS], slope[COLUMNS], deviation[COLUMNS];
  size_t n;
  int k;
  if (!log->value[LAB_CHANNEL_X] || !log->value[LAB_CHANNEL_SP] || (n = add_up(log, sum)) < FEWEST_ROWS)
    return 0;
  for (k = 0; k < COLUMNS; k++)
    whole[k] = sum[k][k];
  for (k = LEVEL; k < SENT; k++)
    take_out(sum, k, whole[k]);
  for (k = SENT; k <= SENT_NOW; k++) {
    if (!slope_on(sum, k, n, whole[k], &slope[k], &deviation[k]) && k != MOVED)
      return 0;
    take_out(sum, k, whole[k]);
  }
  return slope[SENT] > plain * deviation[SENT] &&
         slope[SENT_BEFORE] + interval * deviation[SENT_BEFORE] < on_two_before * slope[SENT] &&
         fabs(slope[SENT_NOW]) + interval * deviation[SENT_NOW] < on_its_row * slope[SENT];
}

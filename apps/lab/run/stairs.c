#include "stairs.h"

#include <math.h>

enum { LEVEL, BEFORE, MOVED, PRESSURE, SENT_BEFORE, SENT, SENT_NOW, TRAVEL, COLUMNS };
enum { FEWEST_ROWS = 40 };
static const double plain = 5, interval = 2; /* deviations of a slope */
static const double on_its_row = 0.1;   /* of the slope on the row before; 0.25 where a second order follows lines */
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

static size_t add_up(const lab_log *log, size_t first, size_t end, double sum[COLUMNS][COLUMNS])
{
  size_t i, n = 0;
  int k, j;
  for (i = first + 2; i < end; i++) {
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

int lab_holds_between_rows(const lab_log *log, size_t first, size_t end)
{
  double sum[COLUMNS][COLUMNS] = {{0}}, whole[COLUMNS], before, now, noise;
  size_t n;
  int k;
  if (!log->value[LAB_CHANNEL_X] || !log->value[LAB_CHANNEL_SP] || (n = add_up(log, first, end, sum)) < FEWEST_ROWS)
    return 0;
  for (k = 0; k < COLUMNS; k++)
    whole[k] = sum[k][k];
  for (k = LEVEL; k < SENT; k++)
    take_out(sum, k, whole[k]);
  if (!(sum[SENT][SENT] > independent * whole[SENT]))
    return 0;
  before = sum[SENT][TRAVEL] / sum[SENT][SENT];
  take_out(sum, SENT, whole[SENT]);
  if (!(sum[SENT_NOW][SENT_NOW] > independent * whole[SENT_NOW]))
    return 0;
  now = sum[SENT_NOW][TRAVEL] / sum[SENT_NOW][SENT_NOW];
  noise = sqrt(fmax(sum[TRAVEL][TRAVEL] - now * sum[SENT_NOW][TRAVEL], 0) / (double)(n - COLUMNS));
  return before > plain * noise / sqrt(sum[SENT][SENT]) &&
         fabs(now) + interval * noise / sqrt(sum[SENT_NOW][SENT_NOW]) < on_its_row * before;
}

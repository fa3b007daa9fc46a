#include "outliers.h"

#include <math.h>
#include <stdlib.h>

#include "../base/array.h"
#include "../base/noise.h"
#include "../base/text.h"

static const double alone = 7;    /* in noise, from its neighbours */
static const double agree = 4;    /* in noise, range of three neighbours */
static const double steps = 3;    /* of the converter; less is a value that flickers */
static const double share = 0.02; /* of a channel */

enum { SOON = 5 }; /* rows after a change of command */

/* One channel of one run. */
struct record {
  size_t first, n; /* rows of the log */
  double *y;       /* measured */
  double *error;   /* measured less predicted; NaN in a gap */
  double noise;
};

/* The three that lie closest together of the four beside a value; in a gap there is none.
 * Out:     range  of the three; infinite if there are fewer
 * Returns: the middle one */
static double beside(const double *value, double *range)
{
  static const int place[] = {-2, -1, 1, 2};
  double near[4];
  size_t i, n = 0;
  for (i = 0; i < sizeof place / sizeof *place; i++)
    if (!isnan(value[place[i]]))
      near[n++] = value[place[i]];
  *range = HUGE_VAL;
  if (n < 3)
    return (double)NAN;
  lab_sort(near, n);
  i = n == 4 && near[3] - near[1] < near[2] - near[0];
  *range = near[i + 2] - near[i];
  return near[i + 1];
}

/* How far a value is from a line through those beside it that are no gaps. */
static double peak(const double *value, const double *error)
{
  double n = 0, k1 = 0, k2 = 0, sum = 0, moment = 0;
  int k;
  for (k = -2; k <= 2; k++)
    if (k != 0 && !isnan(error[k])) {
      n += 1;
      k1 += k;
      k2 += k * k;
      sum += value[k];
      moment += k * value[k];
    }
  return value[0] - (k2 * sum - k1 * moment) / (n * k2 - k1 * k1);
}

/* Its error is far from those beside it, and it is the log that has the larger peak there, not the model.
 * In:      i     two rows from either end at least
 *          size  least distance */
static int stands_alone(const struct record *c, size_t i, double size)
{
  const double *e = c->error + i, *y = c->y + i;
  double range;
  const double off = fabs(e[0] - beside(e, &range)), measured = peak(y, e);
  return off > size && range < agree * c->noise && fabs(measured) > fabs(measured - peak(e, e));
}

/* Make gaps in the errors of what stands alone.  Returns: how many */
static size_t mark(struct record *c)
{
  const double size = fmax(alone * c->noise, steps * lab_smallest_step(c->y, c->n));
  size_t i, n = 0;
  for (i = 2; i + 2 < c->n; i++)
    if (stands_alone(c, i, size)) {
      c->error[i] = (double)NAN;
      n++;
    }
  return n;
}

/* Make gaps where the errors have new ones, found of them.  Out: first  row of the first */
static int take(struct record *c, const lab_log *log, size_t found, lab_outliers *out, size_t *first, lab_error *error)
{
  lab_outlier *taken = realloc(out->taken, (out->n + found) * sizeof *taken);
  size_t i = c->n;
  if (!taken)
    return lab_fail_memory(error, "the isolated values");
  out->taken = taken;
  while (i-- > 0)
    if (isnan(c->error[i]) && !isnan(c->y[i])) {
      out->taken[out->n++] = (lab_outlier){&c->y[i], c->y[i]};
      out->n_soon += lab_log_command_changes(log, c->first + (i > SOON ? i - SOON : 0), c->first + i) != 0;
      c->y[i] = (double)NAN;
      *first = i;
    }
  return LAB_OK;
}

static void limitation(const lab_run *x, int channel, size_t first, size_t n, lab_limitations *limitations)
{
  lab_limitation(limitations,
                 "%s: %zu value%s of channel %s %s isolated, %g times the noise or more from neighbours and model, the "
                 "first at line %d (t = %.6g s): left out.",
                 lab_file_name(x->log->path), n, n > 1 ? "s" : "", lab_channels[channel].key, n > 1 ? "are" : "is",
                 alone, x->log->line[x->first + first], x->log->value[LAB_CHANNEL_TIME][x->first + first]);
}

/* In/out:  e    errors over noise, of this channel; then in its unit
 *          log  the one of the experiment */
static int take_channel(const lab_run *x, int k, double *e, lab_log *log, lab_outliers *out, lab_error *error)
{
  struct record c = {x->first, x->n, log->value[x->channel[k]] + x->first, e, 0};
  size_t i, found, first = 0;
  for (i = 0; i < x->n; i++)
    e[i] = isnan(c.y[i]) ? (double)NAN : e[i] * x->sigma[k];
  if (lab_noise_estimate(e, x->n, &c.noise, error))
    return error->status;
  c.noise = fmax(c.noise, x->sigma[k]);
  found = mark(&c);
  if (found == 0 || !((double)found < share * (double)x->n))
    return LAB_OK;
  if (take(&c, log, found, out, &first, error))
    return error->status;
  limitation(x, x->channel[k], first, found, &out->limitations);
  return LAB_OK;
}

int lab_outliers_take(const lab_unknowns *u, lab_log *log, lab_outliers *out, lab_error *error)
{
  double *r = malloc((u->n_rows + 1) * sizeof *r), *at = r;
  int i, k, status = r ? lab_unknowns_errors(u, r, error) : lab_fail_memory(error, "residuals");
  for (i = 0; i < u->n_runs; i++) {
    const lab_run *x = &u->run[i];
    for (k = 0; k < x->n_channels && status == LAB_OK; k++, at += x->n)
      status = take_channel(x, k, at, &log[x->log - log], out, error);
  }
  free(r);
  return status;
}

void lab_outliers_put_back(lab_outliers *out)
{
  while (out->n > 0) {
    out->n--;
    *out->taken[out->n].place = out->taken[out->n].value;
  }
}

void lab_outliers_free(lab_outliers *out)
{
  free(out->taken);
  out->taken = NULL;
  out->n = 0;
}

#include "mend.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "../base/noise.h"
#include "../base/format.h"
#include "../base/text.h"

static const double spike_size = 25;    /* in noise, from neighbours, two on either side, that agree */
static const double spike_even = 0.1;   /* of its size: likewise, on a slope */
static const double spike_agree = 5;    /* in noise; neighbours further apart than this may be a stroke */
static const double spike_share = 0.05; /* of what the channel covers */
static const double clip_share = 0.3;   /* of the rows within two deviations of the limit, exactly on it */
static const double abrupt_rate = 0.2;  /* of the fastest change of the run, just before it stops */
enum { CLIP_ROWS = 20, CLIP_AROUND = 5, FEWEST_LEFT = 20 };

/* One channel of one run. */
struct stretch {
  const lab_rig *rig;
  const lab_log *log;
  int channel;
  size_t first, n;
  double *y;       /* n values */
  const double *t; /* their times */
  const double *u; /* their commands, NULL without */
};

static double limit_of(const struct stretch *s, int upper)
{
  double low, high;
  lab_range(s->y, s->n, &low, &high);
  return upper ? high : low;
}

static size_t count_within(const struct stretch *s, double limit, double width)
{
  size_t i, n = 0;
  for (i = 0; i < s->n; i++)
    n += fabs(s->y[i] - limit) <= width;
  return n;
}

/* Noise of the rows that are not on the limit; NaN if it cannot be told. */
static int noise_elsewhere(const struct stretch *s, double limit, double *noise, lab_error *error)
{
  double *rest = malloc(s->n * sizeof *rest);
  size_t i;
  int status;
  if (!rest)
    return lab_fail_memory(error, s->log->path);
  for (i = 0; i < s->n; i++)
    rest[i] = s->y[i] == limit ? (double)NAN : s->y[i];
  status = lab_noise_estimate(rest, s->n, noise, error);
  free(rest);
  return status;
}

/* Noisy elsewhere, without noise at the limit. */
static int lacks_noise(const struct stretch *s, double limit, double noise)
{
  const size_t on = count_within(s, limit, 0);
  return on >= CLIP_ROWS && noise >= lab_smallest_step(s->y, s->n) &&
         (double)on > clip_share * (double)count_within(s, limit, 2 * noise);
}

/* Fastest change over three rows. */
static double fastest(const struct stretch *s)
{
  double most = 0;
  size_t i;
  for (i = 3; i < s->n; i++) {
    const double rate = fabs(s->y[i] - s->y[i - 3]) / (s->t[i] - s->t[i - 3]);
    if (rate > most)
      most = rate;
  }
  return most;
}

/* The command is open and does not change from row a to row b. */
static int is_open_throughout(const struct stretch *s, size_t a, size_t b)
{
  size_t i;
  if (!s->u || s->u[a] == 0)
    return 0;
  for (i = a; i <= b; i++)
    if (s->u[i] != s->u[a])
      return 0;
  return 1;
}

/* A pressure that reaches the limit at speed and stays exactly there. */
static int stops_dead(const struct stretch *s, double limit)
{
  const double least = abrupt_rate * fastest(s);
  size_t i, k;
  if (s->channel != LAB_CHANNEL_P)
    return 0;
  for (i = 4; i + CLIP_ROWS < s->n; i++) {
    if (s->y[i] != limit || s->y[i - 1] == limit || !is_open_throughout(s, i - 4, i + CLIP_ROWS))
      continue;
    for (k = 0; k < CLIP_ROWS && s->y[i + k] == limit; k++)
      ;
    if (k == CLIP_ROWS && fabs(s->y[i - 1] - s->y[i - 4]) / (s->t[i - 1] - s->t[i - 4]) > least)
      return 1;
  }
  return 0;
}

/* Rows on the limit, and those so near in time that noise may have taken them off it, become gaps. */
static size_t clear_limit(struct stretch *s, double limit)
{
  size_t i, k, n = 0, last = (size_t)-1;
  for (i = 0; i < s->n; i++) {
    if (s->y[i] != limit)
      continue;
    k = last == (size_t)-1 || i > last + CLIP_AROUND ? (i > CLIP_AROUND ? i - CLIP_AROUND : 0) : last + 1;
    for (; k <= i; k++, n++)
      s->y[k] = (double)NAN;
    last = i;
  }
  for (k = last + 1; last != (size_t)-1 && k < s->n && k <= last + CLIP_AROUND; k++, n++)
    s->y[k] = (double)NAN;
  return n;
}

static int clear_saturated(struct stretch *s, int upper, lab_limitations *limitations, lab_error *error)
{
  const double limit = limit_of(s, upper);
  const char *key = lab_channels[s->channel].key, *which = upper ? "largest" : "smallest";
  char value[LAB_FORMAT_TEXT];
  double noise;
  size_t n;
  if (noise_elsewhere(s, limit, &noise, error))
    return error->status;
  if (!lacks_noise(s, limit, noise) && !stops_dead(s, limit))
    return LAB_OK;
  lab_format_brief(limit, lab_channels[s->channel].unit, value);
  if (s->rig->input[s->channel])
    return lab_fail(
        error, LAB_DATA,
        "%s: channel %s stands at exactly %s, its %s value, in %zu rows, as a saturated sensor does, and it "
        "drives the model: leave these rows out by log.window, or measure again",
        s->log->path, key, value, which, count_within(s, limit, 0));
  n = clear_limit(s, limit);
  lab_limitation(limitations,
                 "%s: channel %s stands at exactly %s, its %s value, as a saturated sensor does: %zu values there and "
                 "beside are left out.",
                 lab_file_name(s->log->path), key, value, which, n);
  if (count_within(s, 0, HUGE_VAL) < FEWEST_LEFT)
    return lab_fail(error, LAB_DATA, "%s: channel %s is saturated at %s: it has hardly any other value", s->log->path,
                    key, value);
  return LAB_OK;
}

/* In:      size  least distance from the neighbours */
static int is_spike(const struct stretch *s, size_t i, double noise, double size)
{
  const double a = s->y[i - 1], b = s->y[i + 1], off = fabs(s->y[i] - (a + b) / 2);
  const double even = fmax(spike_agree * noise, spike_even * off);
  return off > size && fabs(a - b) < even && fabs(s->y[i - 2] - a) < even && fabs(s->y[i + 2] - b) < even &&
         !lab_log_command_changes(s->log, s->first + i - 2, s->first + i + 2);
}

/* A last row that was cut in the middle of its last number reads as a smaller one: far from the two before it, which go
 * on evenly, and further than anything else moves in a row. */
static void clear_last(struct stretch *s, double noise, lab_limitations *limitations)
{
  double most = spike_size * noise;
  const size_t end = s->n - 1;
  size_t i;
  if (s->n < 4)
    return;
  for (i = 1; i < end; i++)
    most = fmax(most, 2 * fabs(s->y[i] - s->y[i - 1]));
  if (!(fabs(s->y[end] - s->y[end - 1]) > most))
    return;
  s->y[end] = (double)NAN;
  lab_limitation(
      limitations,
      "%s:%d: the last value of channel %s is far from those before it, as in a file that was cut; it is left out.",
      lab_file_name(s->log->path), s->log->line[s->first + end], lab_channels[s->channel].key);
}

/* One pass.  Out: where, the first row found.  Returns: how many. */
static size_t clear_spikes_once(struct stretch *s, double noise, size_t *where)
{
  const double size = fmax(spike_size * noise, spike_share * (limit_of(s, 1) - limit_of(s, 0)));
  size_t i, n = 0;
  for (i = 2; i + 2 < s->n; i++)
    if (is_spike(s, i, noise, size)) {
      *where = n++ ? *where : i;
      s->y[i] = (double)NAN;
    }
  return n;
}

/* A tall spike hides low ones, so that the passes go on until one finds nothing. */
static int clear_spikes(struct stretch *s, lab_limitations *limitations, lab_error *error)
{
  size_t n = 0, more, where = 0, at;
  double noise;
  if (lab_noise_estimate(s->y, s->n, &noise, error))
    return error->status;
  if (s->rig->noise[s->channel] > noise)
    noise = s->rig->noise[s->channel];
  if (!(noise > 0))
    return LAB_OK;
  while ((more = clear_spikes_once(s, noise, &at)) > 0) {
    where = n == 0 || at < where ? at : where;
    n += more;
  }
  if (n > 0)
    lab_limitation(
        limitations,
        "%s: %zu values of channel %s are far from both neighbours, the first at line %d (t = %.6g s); they are "
        "left out.",
        lab_file_name(s->log->path), n, lab_channels[s->channel].key, s->log->line[s->first + where], s->t[where]);
  clear_last(s, noise, limitations);
  return LAB_OK;
}

static int mend_channel(struct stretch *s, lab_limitations *limitations, lab_error *error)
{
  if (clear_spikes(s, limitations, error) || clear_saturated(s, 1, limitations, error) ||
      clear_saturated(s, 0, limitations, error))
    return error->status;
  return LAB_OK;
}

int lab_log_clean(const lab_rig *rig, lab_log *log, lab_limitations *limitations, lab_error *error)
{
  static const int channels[] = {LAB_CHANNEL_P, LAB_CHANNEL_X, LAB_CHANNEL_T};
  size_t run, c;
  for (run = 0; run < log->n_runs; run++)
    for (c = 0; c < sizeof channels / sizeof channels[0]; c++) {
      const size_t first = log->run[run];
      struct stretch s = {rig, log, channels[c], first, log->run[run + 1] - first, NULL, NULL, NULL};
      if (!log->value[s.channel])
        continue;
      s.y = log->value[s.channel] + first;
      s.t = log->value[LAB_CHANNEL_TIME] + first;
      s.u = log->value[LAB_CHANNEL_U] ? log->value[LAB_CHANNEL_U] + first : NULL;
      if (mend_channel(&s, limitations, error))
        return error->status;
    }
  return LAB_OK;
}

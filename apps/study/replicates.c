#include "replicates.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../lab/base/array.h"
#include "../lab/base/config.h"
#include "../lab/base/names.h"
#include "../lab/log/log.h"
#include "../lab/rig/rig.h"
#include "sets.h"

enum { PATH_BYTES = 1024, LOGS_MAX = 32, RUNS_MAX = 256, INPUTS_MAX = 4 };

/* Rows of a log that are a run, and the time from which it counts. */
typedef struct span {
  const lab_log *log;
  size_t first, end;
  double start;
  int falls; /* the channel of steps or strokes goes down: not to be paired with one in which it goes up */
} span;

/* The replicates of a group. */
typedef struct pile {
  lab_log log[LOGS_MAX];
  span run[RUNS_MAX];
  int n_logs, n_runs;
} pile;

/* What is compared: the judged channel, then the measured inputs. */
typedef struct compared {
  int channel[1 + INPUTS_MAX];
  int n;
} compared;

static compared compared_of(const lab_rig *rig, int judged)
{
  compared what = {{judged}, 1};
  int c;
  for (c = 0; c < LAB_CHANNEL_COUNT && what.n <= INPUTS_MAX; c++)
    if (rig->input[c] && c != LAB_CHANNEL_U)
      what.channel[what.n++] = c;
  return what;
}

/* ---- Runs ---- */

static void add_run(pile *p, span run)
{
  if (p->n_runs < RUNS_MAX && run.end > run.first + 1)
    p->run[p->n_runs++] = run;
}

/* When a channel is at a level between row i - 1 and row i. */
static double time_at(const lab_log *log, int channel, size_t i, double level)
{
  const double *t = log->value[LAB_CHANNEL_TIME], *v = log->value[channel];
  return t[i - 1] + (level - v[i - 1]) / (v[i] - v[i - 1]) * (t[i] - t[i - 1]);
}

/* A step is over where the channel crosses the middle again; noise does not, for it must have been a quarter away. */
static void add_steps(pile *p, const lab_log *log, int channel, double low, double high)
{
  const double *v = log->value[channel], middle = 0.5 * (low + high), away = 0.25 * (high - low);
  span run = {log, 0, 0, 0, 0};
  int side = 0; /* on which the channel last was away from the middle */
  size_t i;
  for (i = 1; i < log->n; i++) {
    if (fabs(v[i - 1] - middle) > away)
      side = v[i - 1] > middle ? 1 : -1;
    if (!side || !(side * (v[i] - middle) <= 0))
      continue;
    run.end = i;
    if (run.first)
      add_run(p, run);
    run = (span){log, i, log->n, time_at(log, channel, i, middle), side > 0};
    side = 0;
  }
  if (run.first)
    add_run(p, run);
}

/* A stroke is rows one after the other within the reach, from one side of the middle to the other. */
static void add_strokes(pile *p, const lab_log *log, int channel, double low, double high)
{
  const double *v = log->value[channel], middle = 0.5 * (low + high), reach = 0.4 * (high - low);
  size_t i, first = 0, half = 0;
  for (i = 1; i <= log->n; i++) {
    const int is_within = i < log->n && fabs(v[i] - middle) < reach;
    if (is_within && !first)
      first = i;
    else if (is_within && !half && (v[i] > middle) != (v[first] > middle))
      half = i;
    if (is_within)
      continue;
    if (half && (v[i - 1] > middle) != (v[first] > middle))
      add_run(p, (span){log, first, i, time_at(log, channel, half, middle), v[first] > middle});
    first = half = 0;
  }
}

static void add_log_runs(pile *p, const lab_log *log)
{
  size_t r;
  for (r = 0; r < log->n_runs; r++)
    add_run(p, (span){log, log->run[r], log->run[r + 1], 0, 0});
}

/* In: group  with steps or strokes, or NULL */
static int cut(const config_setting_t *group, const lab_log *log, pile *p, lab_error *error)
{
  const char *steps = group ? sets_text(group, "steps") : "", *strokes = group ? sets_text(group, "strokes") : "";
  const char *key = *steps ? steps : strokes;
  double low, high;
  int c;
  if (!*key) {
    add_log_runs(p, log);
    return LAB_OK;
  }
  c = lab_name_index(key, lab_channels, LAB_CHANNEL_COUNT, sizeof *lab_channels);
  if (c < 0 || !log->value[c] || !lab_range(log->value[c], log->n, &low, &high))
    return lab_config_fail(group, error, "replicates: %s has no channel %s", log->path, key);
  (*steps ? add_steps : add_strokes)(p, log, c, low, high);
  return LAB_OK;
}

/* ---- Pairs ---- */

/* A channel of a run at a time from its start; NaN beyond the run and in gaps.  In/out: at  row from which it is sought
 */
static double value_at(const span *run, int channel, double t, size_t *at)
{
  const double *time = run->log->value[LAB_CHANNEL_TIME], *v = run->log->value[channel];
  size_t i = *at;
  if (!v || t < time[run->first] - run->start)
    return (double)NAN;
  while (i + 1 < run->end && time[i + 1] - run->start < t)
    i++;
  *at = i;
  if (i + 1 >= run->end)
    return (double)NAN;
  return v[i] + (t - (time[i] - run->start)) / (time[i + 1] - time[i]) * (v[i + 1] - v[i]);
}

/* Differences of two runs behind those that are there, a column of `stride` a channel.  Returns: how many there are */
static size_t add_pair(const span *a, const span *b, const compared *what, double *d, size_t stride, size_t n)
{
  size_t i, at = b->first;
  int k;
  for (i = a->first; i < a->end; i++) {
    int whole = 1;
    for (k = 0; k < what->n; k++) {
      const double *own = a->log->value[what->channel[k]];
      const double other = value_at(b, what->channel[k], a->log->value[LAB_CHANNEL_TIME][i] - a->start, &at);
      /* An input that no file has is a constant. */
      d[(size_t)k * stride + n] = own ? own[i] - other : k ? 0 : (double)NAN;
      whole &= !isnan(d[(size_t)k * stride + n]);
    }
    n += (size_t)whole;
  }
  return n;
}

/* What differences of the inputs explain by straight lines is taken out of those of the judged channel. */
static void take_inputs_out(const compared *what, double *d, size_t stride, size_t n)
{
  double *basis = d + stride;
  int k, j, kept = 0;
  for (k = 1; k < what->n; k++) {
    double *column = basis + (size_t)kept * stride, length;
    memmove(column, d + (size_t)k * stride, n * sizeof *column);
    lab_project_out(basis, kept, stride, n, column);
    length = sqrt(lab_dot(column, column, n));
    for (j = 0; length > 0 && j < (int)n; j++)
      column[j] /= length;
    kept += length > 0;
  }
  lab_project_out(basis, kept, stride, n, d);
}

/* In: mean_of  runs that a row of the fit is the mean of */
static int add_group(const pile *p, const compared *what, int mean_of, double *squares, size_t *count, lab_error *error)
{
  size_t rows = 1, n = 0;
  double *d;
  int a, b;
  if (p->n_runs < 2)
    return LAB_OK;
  for (a = 0; a < p->n_runs; a++)
    rows += (size_t)p->n_runs * (p->run[a].end - p->run[a].first);
  d = malloc(rows * (size_t)what->n * sizeof *d);
  if (!d)
    return lab_fail_memory(error, "replicates");
  for (a = 0; a < p->n_runs; a++)
    for (b = a + 1; b < p->n_runs; b++)
      if (p->run[a].falls == p->run[b].falls)
        n = add_pair(&p->run[a], &p->run[b], what, d, rows, n);
  take_inputs_out(what, d, rows, n);
  *squares += 0.5 * lab_dot(d, d, n) / mean_of;
  *count += n;
  free(d);
  return LAB_OK;
}

/* ---- Groups ---- */

/* What all groups of a set share. */
typedef struct bench {
  const config_setting_t *set;
  const char *data_dir;
  lab_rig rig;
  compared what;
  double squares; /* over all groups */
  size_t n;
} bench;

static void clear(pile *p)
{
  while (p->n_logs > 0)
    lab_log_free(&p->log[--p->n_logs]);
  p->n_runs = 0;
}

static int read_log(const bench *b, const config_setting_t *group, const char *name, pile *p, lab_error *error)
{
  lab_log_format format = b->rig.log;
  lab_log *log = &p->log[p->n_logs];
  char path[PATH_BYTES];
  format.runs = LAB_RUNS_EACH;
  format.n_lead = 0;
  snprintf(path, sizeof path, "%s/%s/%s", b->data_dir, sets_text(b->set, "folder"), name);
  if (lab_log_read(path, &format, (double)b->rig.params.ambient_pressure, log, error))
    return error->status;
  p->n_logs++;
  return cut(group, log, p, error);
}

/* Logs from..to - 1 of a list as replicates.  In: group  of `replicates`; NULL: their own runs */
static int take_group(bench *b, const config_setting_t *group, const config_setting_t *logs, int from, int to,
                      lab_error *error)
{
  static pile p;
  int i, status = LAB_OK;
  for (i = from; i < to && p.n_logs < LOGS_MAX && status == LAB_OK; i++)
    status = read_log(b, group, config_setting_get_string_elem(logs, i), &p, error);
  if (status == LAB_OK)
    status = add_group(&p, &b->what, b->rig.log.runs == LAB_RUNS_MEAN ? p.n_runs : 1, &b->squares, &b->n, error);
  clear(&p);
  return status;
}

/* Every log of a list as a group, or every group of the list. */
static int take_each(bench *b, const char *list, lab_error *error)
{
  const config_setting_t *items = lab_config_member(b->set, list);
  int i, status = LAB_OK;
  for (i = 0; items && i < config_setting_length(items) && status == LAB_OK; i++) {
    const config_setting_t *group = config_setting_get_elem(items, (unsigned)i);
    const config_setting_t *logs = config_setting_is_group(group) ? lab_config_member(group, "logs") : NULL;
    if (config_setting_is_group(group) && !logs)
      return lab_config_fail(group, error, "replicates: expected the list logs");
    status = logs ? take_group(b, group, logs, 0, config_setting_length(logs), error)
                  : take_group(b, NULL, items, i, i + 1, error);
  }
  return status;
}

int replicates_repeat(const config_setting_t *set, const char *rig, const char *data_dir, double *repeat,
                      lab_error *error)
{
  static bench b;
  const int is_declared = lab_config_member(set, "replicates") != NULL;
  const int judged = sets_channel(sets_text(set, "judged"));
  int status;
  *repeat = (double)NAN;
  if (judged < 0)
    return lab_config_fail(set, error, "%s is no channel", sets_text(set, "judged"));
  b = (bench){.set = set, .data_dir = data_dir};
  if (lab_rig_read(rig, &b.rig, error))
    return error->status;
  b.what = compared_of(&b.rig, judged);
  status = take_each(&b, is_declared ? "replicates" : "fit", error);
  if (status == LAB_OK && !is_declared)
    status = take_each(&b, "holdout", error);
  if (b.n > 0)
    *repeat = sqrt(b.squares / (double)b.n);
  return status;
}

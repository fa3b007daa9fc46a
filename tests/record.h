/* Records made from closed forms, for the tests of figures of merit.
 * SPDX-License-Identifier: MIT */
#ifndef TESTS_RECORD_H
#define TESTS_RECORD_H

#include "fixture.h"
#include "words.h"

#include "../apps/lab/metrics/metrics.h"

enum { RECORD_ROWS = 60000 };

static double record_t[RECORD_ROWS], record_u[RECORD_ROWS], record_p[RECORD_ROWS], record_x[RECORD_ROWS];
static size_t record_first[8];
static lab_record record;
static lab_metrics metrics;
static uint64_t record_seed;

static const double record_stroke = 0.02, record_low = 1e5, record_span = 2e5;

/* An actuator of 0.04 m2 and 20 mm, bench set 100..300 kPa, supply 400 kPa; no rows yet. */
static inline void record_new(int command)
{
  const lab_record empty = {0};
  record = empty;
  record.first = record_first;
  record.n_runs = 1;
  record.t = record_t;
  record.u = command == LAB_COMMAND_PRESSURE ? NULL : record_u;
  record.p = record_p;
  record.x = record_x;
  record.command = command;
  record.stroke = record_stroke;
  record.signal_low = record_low;
  record.signal_high = record_low + record_span;
  record.area = 0.04;
  record.supply = 4e5;
  record.gas_constant = 287;
  record_seed = 1;
}

static inline void record_add(double t, double u, double p, double x)
{
  assert_true(record.n < RECORD_ROWS);
  record_t[record.n] = t;
  record_u[record.n] = u;
  record_p[record.n] = p;
  record_x[record.n++] = x;
  record_first[record.n_runs] = record.n;
}

/* Normal noise on all rows of pressure and position, as it is declared. */
static inline void record_noise(double sigma_p, double sigma_x)
{
  size_t i;
  record.noise_p = sigma_p;
  record.noise_x = sigma_x;
  for (i = 0; i < record.n && sigma_p > 0; i++)
    record_p[i] += sigma_p * fixture_normal(&record_seed);
  for (i = 0; i < record.n && sigma_x > 0; i++)
    record_x[i] += sigma_x * fixture_normal(&record_seed);
}

static inline void record_measure(void)
{
  succeed(lab_metrics_measure(&record, &metrics, &error));
}

static inline const lab_metric *metric_of(int index)
{
  check_note("%.40s: %.110s", lab_metric_infos[index].key, metrics.metric[index].text);
  return &metrics.metric[index];
}

#define assert_metric(index, want, atol, rtol) assert_close(metric_of(index)->value, want, atol, rtol)

/* The value is as far off as its uncertainty allows, and that is no more than `most`. */
#define assert_covers(index, want, most)                                                                               \
  do {                                                                                                                 \
    assert_close(metric_of(index)->value, want, metric_of(index)->uncertainty, 0);                                     \
    assert_between(metric_of(index)->uncertainty, 0, most);                                                            \
  } while (0)

/* There is no value, and the reason has these words. */
static inline void check_denied(int index, const char *words, const char *file, int line)
{
  const lab_metric *metric = metric_of(index);
  if (isnan(metric->value) && isnan(metric->uncertainty) && strstr(metric->text, words))
    return;
  print_error("%s = %g: \"%s\" has not \"%s\"\n", lab_metric_infos[index].key, metric->value, metric->text, words);
  _fail(file, line);
}
#define assert_denied(index, words) check_denied(index, words, __FILE__, __LINE__)

#endif

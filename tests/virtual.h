/* The R1-400 with 40 cm3 of dead volume: as the independent rig, as logs of it, and as a rig file declares it.
 * SPDX-License-Identifier: MIT */
#ifndef TESTS_VIRTUAL_H
#define TESTS_VIRTUAL_H

#include <stdio.h>
#include <stdlib.h>

#include "../apps/lab/log/log.h"
#include "../apps/lab/rig/rig.h"
#include "../apps/lab/run/run.h"
#include "second/rig.h"
#include "words.h"

/* Choked flow, noise of 320 Pa and 20 um. */
static inline second_rig virtual_rig(uint64_t seed)
{
  second_rig g = second_rig_default_r1_400();
  g.flow = SECOND_CHOKED;
  g.dead_volume = 4e-5;
  g.pressure_noise = 320;
  g.position_noise = 2e-5;
  g.step = 5e-5;
  g.seed = seed;
  return g;
}

/* A command that fills, holds and vents, wholly and in part, within 14 s. */
enum { VIRTUAL_COMMANDS = 8 };
static const double virtual_t_cmd[VIRTUAL_COMMANDS] = {0.402, 2.003, 3.201, 4.507, 6.204, 8.002, 9.503, 11.507};
static const double virtual_u_cmd[VIRTUAL_COMMANDS] = {1, 0, -1, 0, 0.8, -0.6, 1, -1};

/* Write the log of a course: u, p and x in SI, every `spacing` [s] up to `end` [s]. */
static inline void virtual_write(const second_rig *g, const second_course *course, double end, double spacing,
                                 const char *path)
{
  const size_t rows = second_samples(end, spacing);
  double *t = calloc(4 * rows, sizeof *t);
  const second_log log = {.t = t, .u = t + rows, .p = t + 2 * rows, .x = t + 3 * rows};
  FILE *file = fopen(path, "w");
  size_t i;
  assert_non_null(t);
  assert_non_null(file);
  assert_int_equal(second_follow(g, course, end, spacing, &log, NULL), 0);
  fprintf(file, "t [s],u [1],p [Pa],x [m]\n");
  for (i = 0; i < rows; i++)
    fprintf(file, "%.3f,%g,%.1f,%.7f\n", log.t[i], log.u[i], log.p[i], log.x[i]);
  fclose(file);
  free(t);
}

/* Write 14 s of these commands, with 100 rows a second, of a rig that is another from a time on [s]; NULL: of one. */
static inline void virtual_record(const second_rig *g, const second_rig *later, double change, const char *path)
{
  const second_course course = {
      .t_cmd = virtual_t_cmd, .u_cmd = virtual_u_cmd, .n = VIRTUAL_COMMANDS, .later = later, .change = change};
  virtual_write(g, &course, 14, 0.01, path);
}

/* The same of 8 s with 50 rows a second: filled, vented, and filled by half. */
static inline void virtual_record_brief(const second_rig *g, const char *path)
{
  static const double t_cmd[] = {0.402, 3.003, 5.507}, u_cmd[] = {1, -1, 0.5};
  const second_course course = {.t_cmd = t_cmd, .u_cmd = u_cmd, .n = 3};
  virtual_write(g, &course, 8, 0.02, path);
}

/* A log of n rows in one run: time, command, pressure and position, the last NULL where it is not measured. One at a
 * time. */
static inline lab_log virtual_log(size_t n, double *t, double *command, double *p, double *x)
{
  static char path[] = "bench/log.csv";
  static size_t first[2];
  lab_log log = {.path = path, .n = n, .n_runs = 1, .run = first};
  first[1] = n;
  log.value[LAB_CHANNEL_TIME] = t;
  log.value[LAB_CHANNEL_U] = command;
  log.value[LAB_CHANNEL_P] = p;
  log.value[LAB_CHANNEL_X] = x;
  return log;
}

/* The same rig as it is declared, with its noise; nothing is fitted. */
static inline void virtual_declare(lab_rig *rig)
{
  lab_rig_default(rig);
  rig->laws.flow = PNEU_FLOW_CHOKED;
  rig->params.dead_volume = (pneu_real)4e-5;
  rig->noise[LAB_CHANNEL_P] = 320;
  rig->noise[LAB_CHANNEL_X] = 2e-5;
}

/* Read a log of one run and open it.  In/out: log, run  static; what they held before is closed */
static inline void virtual_open(const lab_rig *rig, const char *path, lab_log *log, lab_run *run)
{
  lab_run_close(run);
  lab_log_free(log);
  succeed(lab_log_read(path, &rig->log, 101325, log, &error));
  succeed(lab_run_open(rig, log, 0, run, &error));
}

#endif

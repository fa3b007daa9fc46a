/* A sound log of the independent rig, the rig file that declares it, and both in memory to be spoiled.
 * SPDX-License-Identifier: MIT */
#ifndef TESTS_BADLOG_H
#define TESTS_BADLOG_H

#include "scratch.h"
#include "virtual.h"

enum { BAD_ROWS = 1001 };
static const double bad_spacing = 0.01; /* [s] */

/* As written: s, 1, kPa, mm. */
typedef struct bad_log {
  size_t n;
  double t[BAD_ROWS], u[BAD_ROWS], p[BAD_ROWS], x[BAD_ROWS];
} bad_log;

/* Run the rig of virtual.h with a leak of this area [m2], filled and vented for 10 s. */
static inline void bad_run(double leak, double spacing, const second_log *log)
{
  static const double t_cmd[] = {0.402, 2.503, 4.001, 5.507, 7.204}, u_cmd[] = {1, 0, -1, 0.5, -0.5};
  second_rig g = virtual_rig(7);
  g.step = 1e-4;
  g.leak_area = leak;
  assert_int_equal(second_run(&g, t_cmd, u_cmd, 5, 10, spacing, log, NULL), 0);
}

static inline bad_log bad_log_of(double leak)
{
  static bad_log b;
  const second_log log = {.t = b.t, .u = b.u, .p = b.p, .x = b.x};
  size_t i;
  b.n = second_samples(10, bad_spacing);
  assert_int_equal(b.n, BAD_ROWS);
  bad_run(leak, bad_spacing, &log);
  for (i = 0; i < b.n; i++) {
    b.p[i] *= 1e-3;
    b.x[i] *= 1e3;
  }
  return b;
}

/* What is declared of it; `more` is appended.  Returns: path */
static inline const char *bad_rig(const char *name, const char *more)
{
  char text[2048];
  snprintf(text, sizeof text,
           "actuator = { name = \"r\"; area = \"400 cm^2\"; dead_volume = \"40 cm^3\"; stroke = \"20 mm\";\n"
           "  spring_rate = \"390 kN/m\"; spring_preload = \"10 mm\"; moving_mass = \"2 kg\";\n"
           "  dry_friction = \"500 N\"; viscous_friction = \"500 N.s/m\"; damping = \"1000 N.s/m\"; };\n"
           "transducer = { fill_area = \"0.893 mm^2\"; vent_area = \"0.893 mm^2\"; };\n"
           "supply = { pressure = \"400 kPa\"; temperature = \"298.15 K\"; };\n"
           "ambient = { pressure = \"101.325 kPa\"; temperature = \"298.15 K\"; };\n"
           "laws = { gas = \"isothermal\"; flow = \"choked\"; friction = \"coulomb\"; };\n"
           "fit = ( \"orifice_area\", \"dry_friction\", \"spring_rate\", \"spring_preload\" );\n"
           "noise = { pressure = \"0.32 kPa\"; position = \"0.02 mm\"; };\n%s",
           more);
  return scratch_text(name, text);
}

/* Write a log, NaN as a gap.  Returns: path */
static inline const char *bad_write(const char *name, const char *header, const bad_log *b)
{
  const char *path = scratch_path(name);
  FILE *file = fopen(path, "w");
  size_t i;
  assert_non_null(file);
  fprintf(file, "%s\n", header);
  for (i = 0; i < b->n; i++)
    fprintf(file, "%.3f,%g,%.7g,%.7g\n", b->t[i], b->u[i], b->p[i], b->x[i]);
  assert_int_equal(fclose(file), 0);
  return path;
}

#endif

#include "rigs.h"

#include <stdio.h>
#include <string.h>

#include "../blind/logs.h"

static const blind_schedule fit_schedule = {8, {0, 0.5, 8, 14, 22, 30, 40, 45}, {0, 1, 0, -1, 0.6, -0.5, 1, -1}, 50};
static const blind_schedule holdout_schedule = {6, {0, 0.5, 10, 20, 32, 41}, {0, 0.8, -1, 0.5, 1, -0.7}, 50};

static second_rig declared_rig(void)
{
  second_rig g = second_rig_default_r1_400();
  g.dead_volume = 40e-6;
  g.pressure_noise = 320;
  g.position_noise = 2e-5;
  g.seed = 1;
  return g;
}

static void plan(double rows, int leaky, blind_trial *t)
{
  static const double off[BLIND_FITTED] = {1.08, 0.93, 1.04, 0.97, 1.05};
  int i;
  memset(t, 0, sizeof *t);
  t->declared = t->base = declared_rig();
  for (i = 0; i < BLIND_FITTED; i++)
    blind_scale_fitted(&t->base, i, off[i]);
  t->channels = BLIND_P | BLIND_X;
  t->fit = fit_schedule;
  t->holdout = holdout_schedule;
  t->spacing = fit_schedule.end / rows;
  t->step = t->declared.step;
  if (!leaky)
    return;
  t->n_missing = 1;
  t->missing[0].effect = blind_effect_named("chamber_leak");
  t->missing[0].size = 0.02 * t->base.fill_area;
}

int bench_rig_write(const bench *b, const char *name, double rows, int leaky, bench_rig *r, lab_error *error)
{
  static blind_trial trial;
  plan(rows, leaky, &trial);
  snprintf(r->folder, sizeof r->folder, "%s/%s", b->scratch, name);
  return blind_write_logs(&trial, r->folder, error);
}

int bench_rig_open(bench_rig *r, lab_error *error)
{
  char path[BENCH_PATH + 16];
  memset(&r->log, 0, sizeof r->log);
  memset(&r->run, 0, sizeof r->run);
  snprintf(path, sizeof path, "%s/rig.cfg", r->folder);
  if (lab_rig_read(path, &r->rig, error))
    return error->status;
  snprintf(path, sizeof path, "%s/fit.csv", r->folder);
  if (lab_log_read(path, &r->rig.log, (double)r->rig.params.ambient_pressure, &r->log, error))
    return error->status;
  return lab_run_open(&r->rig, &r->log, 0, &r->run, error);
}

void bench_rig_close(bench_rig *r)
{
  lab_run_close(&r->run);
  lab_log_free(&r->log);
}

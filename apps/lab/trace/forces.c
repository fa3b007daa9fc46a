#include "forces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/clock.h"
#include "../check/mend.h"
#include "../fit/beginning.h"

static const int of_forces[] = {PNEU_PARAM_spring_rate, PNEU_PARAM_spring_preload, PNEU_PARAM_dry_friction};
enum { VALUES = sizeof of_forces / sizeof *of_forces };

static int has_channel(const lab_run *x, int channel)
{
  int c, any = 0;
  for (c = 0; c < x->n_channels; c++)
    any |= x->channel[c] == channel;
  return any;
}

/* The rig with the measured pressure as an input, and what u may change of these values to fit. */
static lab_rig driven(const lab_unknowns *u)
{
  lab_rig by_pressure = u->rig;
  int i;
  by_pressure.input[LAB_CHANNEL_P] = by_pressure.laws.pressure_input = 1;
  by_pressure.n_fit = 0;
  for (i = 0; i < VALUES; i++)
    if (lab_unknowns_find(u, of_forces[i]) >= 0) {
      by_pressure.fit_per_log[by_pressure.n_fit] = 0;
      by_pressure.fit[by_pressure.n_fit++] = of_forces[i];
    }
  return by_pressure;
}

/* The log with a pressure that drives the stem without its noise.  Out: log  its pressure is its own, and to be freed
 */
static int smooth(const lab_rig *rig, const lab_log *from, lab_log *log, lab_error *error)
{
  lab_limitations none = {0};
  const size_t size = from->n * sizeof(double);
  *log = *from;
  log->value[LAB_CHANNEL_P] = malloc(size);
  if (!log->value[LAB_CHANNEL_P])
    return lab_fail_memory(error, "a balance of forces");
  memcpy(log->value[LAB_CHANNEL_P], from->value[LAB_CHANNEL_P], size);
  return lab_log_smooth_inputs(rig, log, &none, error);
}

/* The values by which the pressure of a log moves the stem as measured, in the rows that u has. */
static int fit(const lab_rig *rig, const lab_log *log, const lab_unknowns *u, lab_unknowns *forces, lab_error *error)
{
  static const double most = 0.5; /* of the time */
  lab_run run, part = {0};
  int status = lab_run_open(rig, log, u->run->run, &run, error);
  if (status == LAB_OK)
    status = lab_beginning_open(&run, u->run->n, &part, error);
  if (status == LAB_OK)
    status = lab_unknowns_open(rig, &part, 1, forces, error);
  if (status == LAB_OK) {
    forces->until = lab_cpu_share(u->until, most);
    status = lab_unknowns_fit(forces, LAB_ROUNDS_ALL, NULL, error);
  }
  lab_beginning_close(&part);
  lab_run_close(&run);
  return status;
}

static void take(const lab_unknowns *forces, lab_unknowns *u)
{
  int j;
  for (j = 0; j < forces->rig.n_fit; j++) { /* no command drives it, so that these come first and alone */
    lab_unknown *x = &u->unknown[lab_unknowns_find(u, forces->unknown[j].index)];
    x->value = fmin(fmax(forces->unknown[j].value, x->lower), x->upper);
  }
  lab_unknowns_take(u);
}

int lab_forces_begin(lab_unknowns *u, lab_error *error)
{
  lab_unknowns *forces;
  lab_rig rig;
  lab_log log;
  int status;
  if (u->n_runs != 1 || !has_channel(u->run, LAB_CHANNEL_P) || !has_channel(u->run, LAB_CHANNEL_X))
    return LAB_OK;
  rig = driven(u);
  if (rig.n_fit == 0)
    return LAB_OK;
  forces = malloc(sizeof *forces);
  if (!forces)
    return lab_fail_memory(error, "a balance of forces");
  status = smooth(&rig, u->run->log, &log, error);
  if (status == LAB_OK)
    status = fit(&rig, &log, u, forces, error);
  if (status == LAB_OK)
    take(forces, u);
  free(log.value[LAB_CHANNEL_P]);
  free(log.bend[LAB_CHANNEL_P]);
  free(forces);
  return status == LAB_WORLD ? status : LAB_OK;
}

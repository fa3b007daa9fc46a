#include "forces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../check/mend.h"

static const int of_forces[] = {PNEU_PARAM_spring_rate, PNEU_PARAM_spring_preload, PNEU_PARAM_dry_friction};
enum { VALUES = sizeof of_forces / sizeof *of_forces };

static int has_channel(const lab_run *x, int channel)
{
  int c, any = 0;
  for (c = 0; c < x->n_channels; c++)
    any |= x->channel[c] == channel;
  return any;
}

/* The rig with the measured pressure as an input, and with these values to fit. */
static lab_rig driven(const lab_rig *rig)
{
  lab_rig by_pressure = *rig;
  int i;
  by_pressure.input[LAB_CHANNEL_P] = by_pressure.laws.pressure_input = 1;
  for (i = 0; i < VALUES; i++) {
    by_pressure.fit[i] = of_forces[i];
    by_pressure.fit_per_log[i] = 0;
  }
  by_pressure.n_fit = VALUES;
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

/* The values by which the pressure of a log moves the stem as measured. */
static int fit(const lab_rig *rig, const lab_log *log, const lab_unknowns *u, lab_unknowns *forces, lab_error *error)
{
  lab_run run;
  int status = lab_run_open(rig, log, u->run->run, &run, error);
  if (status != LAB_OK)
    return status;
  status = lab_unknowns_open(rig, &run, 1, forces, error);
  forces->until = u->until;
  if (status == LAB_OK)
    status = lab_unknowns_fit(forces, LAB_ROUNDS_ALL, NULL, error);
  lab_run_close(&run);
  return status;
}

static void take(const lab_unknowns *forces, lab_unknowns *u)
{
  int i;
  for (i = 0; i < VALUES; i++) {
    const int from = lab_unknowns_find(forces, of_forces[i]), to = lab_unknowns_find(u, of_forces[i]);
    lab_unknown *x = &u->unknown[to < 0 ? 0 : to];
    if (from >= 0 && to >= 0)
      x->value = fmin(fmax(forces->unknown[from].value, x->lower), x->upper);
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
  rig = driven(&u->rig);
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

/* The standard experiment by the virtual rig: main ACTUATOR GAS FLOW [STEP_IN_US], CSV on stdout.
 * SPDX-License-Identifier: MIT */
#include "rig.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROWS = 3051 };
static double t[ROWS], u[ROWS], p[ROWS], x[ROWS];

int main(int argc, char **argv)
{
  static const double at[] = {0.5, 15.5}, to[] = {1.0, -1.0};
  second_log log = {.t = t, .u = u, .p = p, .x = x};
  second_audit audit;
  if (argc < 4) {
    fprintf(stderr, "usage: %s r1-400|37-13 isothermal|polytropic paper|choked [step in us]\n", argv[0]);
    return 2;
  }
  second_rig rig = strcmp(argv[1], "37-13") ? second_rig_default_r1_400() : second_rig_default_37_13();
  rig.gas = strcmp(argv[2], "isothermal") ? SECOND_ENERGY : SECOND_ISOTHERMAL;
  rig.flow = strcmp(argv[3], "paper") ? SECOND_CHOKED : SECOND_PAPER;
  if (argc > 4)
    rig.step = atof(argv[4]) * 1e-6;
  if (second_run(&rig, at, to, 2, 30.5, 0.01, &log, &audit))
    return 3;
  fprintf(stderr, "%ld steps, %ld events\n", audit.steps, audit.events);
  printf("t [s],u [1],p [kPa],x [mm]\n");
  for (int i = 0; i < ROWS; i++)
    printf("%.2f,%g,%.12g,%.12g\n", t[i], u[i], p[i] * 1e-3, x[i] * 1e3);
  return 0;
}

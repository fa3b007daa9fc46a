/* The standard experiment without an FMU: time, pressure, position, temperature, mode, to all digits.
 *   native MODEL.cfg TOL */
#include <stdio.h>
#include <stdlib.h>

#include "../../apps/lab/rig/rig.h"
#include "../../apps/lab/run/standard.h"

int main(int argc, char **argv)
{
  lab_response_options options = {LAB_STEPPER, 0, 0, 0, 0, 0};
  lab_error error;
  lab_rig rig;
  pneu_model model;
  lab_trace trace;
  size_t i;
  options.tol = argc == 3 ? atof(argv[2]) : 0;
  if (argc != 3 || lab_rig_read(argv[1], &rig, &error) || lab_rig_model(&rig, &model, &error) ||
      lab_standard_experiment(&model, &options, &trace, &error)) {
    fprintf(stderr, "native: %s\n", argc == 3 ? error.text : "expected MODEL.cfg TOL");
    return 1;
  }
  for (i = 0; i < trace.n; i++)
    printf("%.17g,%.17g,%.17g,%.17g,%d\n", trace.t[i], trace.p[i], trace.x[i], trace.T[i], trace.mode[i]);
  lab_trace_free(&trace);
  return 0;
}

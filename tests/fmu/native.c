/* Without an FMU: the standard experiment, or what a model does when the inputs of a log drive it. To all digits: time,
 * pressure, position, temperature, mode, holding force, and what drives the model from that time on: command, supply,
 * slopes of pressure and position.
 *   native MODEL.cfg TOL [LOG.csv | cvode]      cvode: the standard experiment by CVODE in the place of the stepper */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../apps/lab/log/log.h"
#include "../../apps/lab/rig/rig.h"
#include "../../apps/lab/run/follow.h"
#include "../../apps/lab/run/schedule.h"
#include "../../apps/lab/run/standard.h"

static void print(const lab_trace *trace, const lab_schedule *schedule)
{
  static const pneu_input none;
  size_t i, row = 0;
  for (i = 0; i < trace->n; i++) {
    const pneu_input *input = &none;
    if (schedule) {
      while (row + 1 < schedule->n && schedule->t[row + 1] <= trace->t[i])
        row++;
      input = &schedule->input[row];
    }
    printf("%.17g,%.17g,%.17g,%.17g,%d,%.17g,", trace->t[i], trace->p[i], trace->x[i], trace->T[i], trace->mode[i],
           trace->force[i]);
    printf("%.17g,%.17g,%.17g,%.17g\n", input->u, input->supply_pressure, input->pressure_rate, input->position_rate);
  }
}

/* The first run of a log. */
static int follow(const pneu_model *model, const lab_rig *rig, const char *path, const lab_response_options *options,
                  lab_error *error)
{
  lab_log log;
  lab_trace trace;
  lab_drive drive;
  if (lab_log_read(path, &rig->log, (double)rig->params.ambient_pressure, &log, error) ||
      lab_drive_from_log(model, rig, &log, 0, &drive, error) ||
      lab_follow(model, rig, &log, 0, log.value[LAB_CHANNEL_TIME], log.run[1], options, &trace, error))
    return error->status;
  print(&trace, &drive.schedule);
  lab_trace_free(&trace);
  lab_drive_free(&drive);
  lab_log_free(&log);
  return LAB_OK;
}

static int respond(const pneu_model *model, const lab_response_options *options, lab_error *error)
{
  lab_trace trace;
  if (lab_standard_experiment(model, options, &trace, error))
    return error->status;
  print(&trace, NULL);
  lab_trace_free(&trace);
  return LAB_OK;
}

int main(int argc, char **argv)
{
  const char *how = argc == 4 ? argv[3] : "";
  const int by_cvode = strcmp(how, "cvode") == 0;
  lab_response_options options = {by_cvode ? LAB_CVODE : LAB_STEPPER, 0, 0, 0, 0, 0};
  lab_error error;
  lab_rig rig;
  pneu_model model;
  if (argc != 3 && argc != 4) {
    fprintf(stderr, "native: expected MODEL.cfg TOL [LOG.csv | cvode]\n");
    return 1;
  }
  options.tol = atof(argv[2]);
  if (lab_rig_read(argv[1], &rig, &error) || lab_rig_model(&rig, &model, &error) ||
      (*how && !by_cvode ? follow(&model, &rig, how, &options, &error) : respond(&model, &options, &error))) {
    fprintf(stderr, "native: %s\n", error.text);
    return 1;
  }
  return 0;
}

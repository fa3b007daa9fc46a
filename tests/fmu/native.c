/* Without an FMU: the standard experiment, or what a model does when the inputs of a log drive it. To all digits: time,
 * pressure, position, temperature, mode, holding force, and what drives the model from that time on: command, supply,
 * slopes of pressure and position.
 *   native MODEL.cfg TOL [LOG.csv | cvode]      cvode: the standard experiment by CVODE in the place of the stepper */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../apps/lab/log/log.h"
#include "../../apps/lab/rig/rig.h"
#include "../../apps/lab/run/predict.h"
#include "../../apps/lab/run/schedule.h"
#include "../../apps/lab/run/standard.h"

static void print(const lab_response *response, const lab_schedule *schedule)
{
  static const pneu_input none;
  size_t i, row = 0;
  for (i = 0; i < response->n; i++) {
    const pneu_input *input = &none;
    if (schedule) {
      while (row + 1 < schedule->n && schedule->t[row + 1] <= response->t[i])
        row++;
      input = &schedule->input[row];
    }
    printf("%.17g,%.17g,%.17g,%.17g,%d,%.17g,", response->t[i], response->p[i], response->x[i], response->T[i],
           response->mode[i], response->force[i]);
    printf("%.17g,%.17g,%.17g,%.17g\n", input->u, input->supply_pressure, input->pressure_rate, input->position_rate);
  }
}

/* The first run of a log. */
static int follow(const pneu_model *model, const lab_rig *rig, const char *path, const lab_response_options *options,
                  lab_error *error)
{
  lab_log log;
  lab_response response;
  lab_inputs inputs;
  const lab_prediction following = {.rig = rig, .log = &log, .options = *options};
  if (lab_log_read(path, &rig->log, (double)rig->params.ambient_pressure, &log, error) ||
      lab_inputs_from_log(model, rig, &log, 0, &inputs, error) || lab_predict_log(model, &following, &response, error))
    return error->status;
  print(&response, &inputs.schedule);
  lab_response_free(&response);
  lab_inputs_free(&inputs);
  lab_log_free(&log);
  return LAB_OK;
}

static int respond(const pneu_model *model, const lab_response_options *options, lab_error *error)
{
  lab_response response;
  if (lab_standard_experiment(model, options, &response, error))
    return error->status;
  print(&response, NULL);
  lab_response_free(&response);
  return LAB_OK;
}

int main(int argc, char **argv)
{
  const char *how = argc == 4 ? argv[3] : "";
  const int by_cvode = strcmp(how, "cvode") == 0;
  lab_response_options options = {.integrator = by_cvode ? LAB_CVODE : LAB_STEPPER};
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

/* simulate: what a model predicts for the commands of a log, or for the standard experiment.
 * SPDX-License-Identifier: MIT */
#include "lab/base/array.h"
#include "lab/base/cli.h"
#include "lab/log/log.h"
#include "lab/base/outfile.h"
#include "lab/run/schedule.h"
#include "lab/run/simulation.h"
#include "lab/check/mend.h"
#include "lab/check/plausible.h"
#include "lab/check/standstill.h"
#include "lab/rig/rig.h"
#include "lab/run/standard.h"
#include "lab/metrics/recording.h"

static const char *out_path;
static int standard, figures, json;

static const lab_option options[] = {
    {"out", LAB_OPTION_TEXT, &out_path, "FILE", "write there instead of standard output", 0, 0},
    {"step", LAB_OPTION_FLAG, &standard, NULL,
     "fill for 15 s and vent for 15 s, past any positioner, instead of following a log", 0, 0},
    {"metrics", LAB_OPTION_FLAG, &figures, NULL,
     "print figures of merit of the response instead of its rows: dead time, T63, T86,\n"
     "dead band, hysteresis, stroke times, air and energy; study/schedules/ has\n"
     "logs of commands for it",
     0, 0},
    {"json", LAB_OPTION_FLAG, &json, NULL, "with --metrics: print JSON", 0, 0},
    {NULL, 0, NULL, NULL, NULL, 0, 0}};

static const lab_program program = {"simulate",
                                    "MODEL.cfg LOG.csv | MODEL.cfg --step",
                                    "Predict the measured channels of LOG.csv, at its times and from its input "
                                    "channels, by the model in MODEL.cfg.",
                                    options,
                                    1,
                                    2};

/* ---- Figures of merit ---- */

static int write_figures(const lab_recording *recording, FILE *file, lab_error *error)
{
  static lab_metrics metrics;
  if (lab_metrics_measure(&recording->record, &metrics, error))
    return error->status;
  if (json)
    return lab_metrics_json(file, &metrics, error);
  lab_metrics_print(file, &metrics);
  return LAB_OK;
}

static int figures_of_standard(const pneu_model *model, const lab_rig *rig, FILE *file, lab_error *error)
{
  lab_recording recording;
  lab_response response;
  int status;
  if (lab_standard_experiment(model, &(lab_response_options){0}, &response, error))
    return error->status;
  status = lab_recording_open(rig, response.n, 1, &recording, error);
  if (status == LAB_OK) {
    lab_recording_add_response(&recording, &response);
    status = write_figures(&recording, file, error);
  }
  lab_recording_close(&recording);
  lab_response_free(&response);
  return status;
}

static int figures_of_log(const pneu_model *model, const lab_rig *rig, const lab_log *log, FILE *file, lab_error *error)
{
  lab_recording recording;
  int status;
  if (lab_positioner_check(rig, log, error))
    return error->status;
  status = lab_recording_simulate(model, rig, log, &recording, error);
  if (status == LAB_OK)
    status = write_figures(&recording, file, error);
  lab_recording_close(&recording);
  return status;
}

/* ---- The program ---- */

/* A command that goes back to 0, but never below, may be meant to vent there. */
static void note_no_venting(const lab_rig *rig, const lab_log *log, const char *path)
{
  const double *u = log->value[LAB_CHANNEL_U];
  double low, high;
  if (!u || rig->params.proportional_band > 0 || rig->laws.pressure_input || !lab_range(u, log->n, &low, &high))
    return;
  if (low == 0 && u[log->n - 1] == 0 && high > 0)
    fprintf(stderr, "%s: note: %s: u never goes below 0, so that nothing vents: 1 fills, 0 shuts, -1 vents\n",
            program.name, path);
}

static int read_and_simulate(const pneu_model *model, const lab_rig *rig, const char *path, FILE *file,
                             lab_error *error)
{
  lab_limitations said = {0};
  lab_log log;
  int i, status = lab_log_read(path, &rig->log, (double)rig->params.ambient_pressure, &log, error);
  if (status != LAB_OK)
    return status;
  if (*log.read_as)
    fprintf(stderr, "%s: note: %s: %s\n", program.name, path, log.read_as);
  if (log.dropped)
    fprintf(stderr, "%s: note: %s: %zu damaged rows left out\n", program.name, path, log.dropped);
  note_no_venting(rig, &log, path);
  lab_say_idle_columns(rig, &log, &said);
  status = lab_log_smooth_inputs(rig, &log, &said, error);
  for (i = 0; i < said.n; i++)
    fprintf(stderr, "%s: note: %s\n", program.name, said.text[i]);
  if (status == LAB_OK)
    status =
        figures ? figures_of_log(model, rig, &log, file, error) : lab_simulation_write(model, rig, &log, file, error);
  lab_log_free(&log);
  return status;
}

static int answer(const lab_cli *cli, const pneu_model *model, const lab_rig *rig, FILE *file, lab_error *error)
{
  if (!standard)
    return read_and_simulate(model, rig, cli->operand[1], file, error);
  return figures ? figures_of_standard(model, rig, file, error) : lab_simulation_write_standard(model, file, error);
}

/* A stem that stands still may be meant: a word on standard error, and the answer. */
static void note_standstill(const lab_rig *rig)
{
  char text[LAB_LIMITATION_TEXT];
  if (lab_is_at_rest(rig, 1, text))
    fprintf(stderr, "%s: note: %s: %s\n", program.name, rig->file, text);
}

static int run(const lab_cli *cli, lab_error *error)
{
  lab_rig rig;
  pneu_model model;
  lab_outfile out;
  if (cli->n_operands + standard != 2)
    return lab_fail(error, LAB_USAGE, "expected either LOG.csv or --step; see --help");
  if (json && !figures)
    return lab_fail(error, LAB_USAGE, "--json: goes with --metrics; a response is CSV");
  if (lab_rig_read(cli->operand[0], &rig, error) || lab_rig_model(&rig, &model, error) ||
      lab_out_open(&out, out_path, error))
    return error->status;
  note_standstill(&rig);
  return lab_out_end(&out, answer(cli, &model, &rig, out.file, error), error);
}

int main(int argc, char **argv)
{
  return lab_cli_main(&program, argc, argv, run);
}

/* simulate: what a model predicts for the commands of a log, or for the standard experiment.
 * SPDX-License-Identifier: MIT */
#include "lab/cli.h"
#include "lab/interrupt.h"
#include "lab/log.h"
#include "lab/outfile.h"
#include "lab/response.h"
#include "lab/rig.h"
#include "lab/schedule.h"
#include "lab/standard.h"
#include "lab/start.h"
#include "lab/series.h"

static const char *out_path;
static int standard;

static const lab_option options[] = {
    {"out", LAB_OPTION_TEXT, &out_path, "FILE", "write there instead of standard output", 0, 0},
    {"step", LAB_OPTION_FLAG, &standard, NULL, "fill for 15 s and vent for 15 s instead of following a log", 0, 0},
    {NULL, 0, NULL, NULL, NULL, 0, 0}};

static const lab_program program = {"simulate",
                                    "MODEL.cfg LOG.csv | MODEL.cfg --step",
                                    "Predict the measured channels of LOG.csv, at its times and from its input "
                                    "channels, by the model in MODEL.cfg.",
                                    options,
                                    1,
                                    2};

static const lab_response_options accuracy = {LAB_STEPPER, 1e-7, 0, 0, 0, 0};

/* Time, command, and those channels that are asked for; `u` may be NULL.  Returns: the number of columns. */
static int columns(const pneu_model *model, const lab_trace *trace, const double *u, int p, int x, int T,
                   lab_series_column *column)
{
  int n = 0, opening = model->p.proportional_band == 0;
  column[n++] = (lab_series_column){"t [s]", 1, trace->t};
  if (u)
    column[n++] = opening ? (lab_series_column){"u [1]", 1, u} : (lab_series_column){"u [kPa]", 1e-3, u};
  if (p)
    column[n++] = (lab_series_column){"p [kPa]", 1e-3, trace->p};
  if (x)
    column[n++] = (lab_series_column){"x [mm]", 1e3, trace->x};
  if (T)
    column[n++] = (lab_series_column){"T [K]", 1, trace->T};
  return n;
}

static int simulate_standard(const pneu_model *model, FILE *file, lab_error *error)
{
  lab_series_column column[5];
  lab_trace trace;
  int n;
  if (lab_standard_experiment(model, &accuracy, &trace, error))
    return error->status;
  n = columns(model, &trace, trace.u, 1, 1, 0, column);
  lab_series_header(file, column, n);
  lab_series_rows(file, column, n, trace.n);
  lab_trace_free(&trace);
  return LAB_OK;
}

/* Respond to one run of a log. */
static int respond(const pneu_model *model, const lab_rig *rig, const lab_log *log, size_t run, lab_trace *trace,
                   lab_error *error)
{
  size_t first = log->run[run], end = log->run[run + 1];
  lab_response_options own = accuracy;
  lab_drive drive;
  pneu_state start;
  int status;
  if (lab_drive_from_log(model, rig, log, run, &drive, error))
    return error->status;
  own.t_end = log->value[LAB_CHANNEL_TIME][end - 1];
  status = lab_start_from_log(model, drive.input, log, run, &start, error);
  if (status == LAB_OK)
    status = lab_respond(model, &start, &drive.schedule, log->value[LAB_CHANNEL_TIME] + first, end - first, &own, trace,
                         NULL, error);
  lab_drive_free(&drive);
  return status;
}

/* Predict what the log measures; a log that measures nothing gets pressure and position. */
static int simulate_log(const pneu_model *model, const lab_rig *rig, const lab_log *log, FILE *file, lab_error *error)
{
  double *const *value = log->value;
  int nothing = !value[LAB_CHANNEL_P] && !value[LAB_CHANNEL_X] && !value[LAB_CHANNEL_T];
  size_t run;
  for (run = 0; run < log->n_runs; run++) {
    lab_series_column column[5];
    lab_trace trace;
    int n;
    if (respond(model, rig, log, run, &trace, error))
      return error->status;
    n = columns(model, &trace, value[LAB_CHANNEL_U] ? value[LAB_CHANNEL_U] + log->run[run] : NULL,
                nothing || value[LAB_CHANNEL_P], nothing || value[LAB_CHANNEL_X], value[LAB_CHANNEL_T] != NULL, column);
    if (run == 0)
      lab_series_header(file, column, n);
    lab_series_rows(file, column, n, trace.n);
    lab_trace_free(&trace);
  }
  return LAB_OK;
}

static int read_and_simulate(const pneu_model *model, const lab_rig *rig, const char *path, FILE *file,
                             lab_error *error)
{
  lab_log log;
  int status = lab_log_read(path, &rig->log, (double)rig->params.ambient_pressure, &log, error);
  if (status != LAB_OK)
    return status;
  if (log.dropped)
    fprintf(stderr, "%s: note: %s: %zu damaged rows left out\n", program.name, path, log.dropped);
  status = simulate_log(model, rig, &log, file, error);
  lab_log_free(&log);
  return status;
}

static int run(const lab_cli *cli, lab_error *error)
{
  lab_rig rig;
  pneu_model model;
  lab_outfile out;
  int status;
  if (cli->n_operands + standard != 2)
    return lab_fail(error, LAB_USAGE, "expected either LOG.csv or --step; see --help");
  if (lab_rig_read(cli->operand[0], &rig, error) || lab_rig_model(&rig, &model, error) ||
      lab_out_open(&out, out_path, error))
    return error->status;
  status = standard ? simulate_standard(&model, out.file, error)
                    : read_and_simulate(&model, &rig, cli->operand[1], out.file, error);
  if (status == LAB_OK)
    return lab_out_close(&out, error);
  lab_out_abandon(&out);
  return status;
}

int main(int argc, char **argv)
{
  lab_cli cli;
  lab_error error;
  lab_interrupt_catch();
  if (lab_cli_read(&program, argc, argv, &cli, &error))
    return lab_cli_report(&program, &error);
  if (!cli.done && run(&cli, &error))
    return lab_cli_report(&program, &error);
  return LAB_OK;
}

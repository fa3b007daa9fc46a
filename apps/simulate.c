/* simulate: what a model predicts for the commands of a log, or for the standard experiment.
 * SPDX-License-Identifier: MIT */
#include "lab/base/cli.h"
#include "lab/run/follow.h"
#include "lab/base/interrupt.h"
#include "lab/log/log.h"
#include "lab/base/outfile.h"
#include "lab/run/response.h"
#include "lab/rig/rig.h"
#include "lab/base/series.h"
#include "lab/run/standard.h"
#include "lab/metrics/tape.h"
#include "lab/metrics/metricstext.h"

static const char *out_path;
static int standard, figures, json;

static const lab_option options[] = {
    {"out", LAB_OPTION_TEXT, &out_path, "FILE", "write there instead of standard output", 0, 0},
    {"step", LAB_OPTION_FLAG, &standard, NULL, "fill for 15 s and vent for 15 s instead of following a log", 0, 0},
    {"metrics", LAB_OPTION_FLAG, &figures, NULL,
     "figures of merit of the response instead of its rows: dead time, T63, T86,\n"
     "dead band, hysteresis, stroke times, air and energy; study/schedules/ has\n"
     "logs of commands for it",
     0, 0},
    {"json", LAB_OPTION_FLAG, &json, NULL, "with --metrics: as JSON", 0, 0},
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
    if (lab_follow(model, rig, log, run, log->value[LAB_CHANNEL_TIME] + log->run[run],
                   log->run[run + 1] - log->run[run], &accuracy, &trace, error))
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

/* ---- Figures of merit ---- */

static int write_figures(const lab_tape *tape, FILE *file, lab_error *error)
{
  static lab_metrics metrics;
  if (lab_metrics_measure(&tape->record, &metrics, error))
    return error->status;
  if (json)
    return lab_metrics_json(file, &metrics, error);
  lab_metrics_print(file, &metrics);
  return LAB_OK;
}

static int figures_of_standard(const pneu_model *model, const lab_rig *rig, FILE *file, lab_error *error)
{
  lab_tape tape;
  lab_trace trace;
  int status;
  if (lab_standard_experiment(model, &accuracy, &trace, error))
    return error->status;
  status = lab_tape_open(rig, trace.n, 1, &tape, error);
  if (status == LAB_OK) {
    lab_tape_add_trace(&tape, &trace);
    status = write_figures(&tape, file, error);
  }
  lab_tape_close(&tape);
  lab_trace_free(&trace);
  return status;
}

static int figures_of_log(const pneu_model *model, const lab_rig *rig, const lab_log *log, FILE *file, lab_error *error)
{
  lab_tape tape;
  int status = lab_tape_simulate(model, rig, log, &accuracy, &tape, error);
  if (status == LAB_OK)
    status = write_figures(&tape, file, error);
  lab_tape_close(&tape);
  return status;
}

/* ---- The program ---- */

static int read_and_simulate(const pneu_model *model, const lab_rig *rig, const char *path, FILE *file,
                             lab_error *error)
{
  lab_log log;
  int status = lab_log_read(path, &rig->log, (double)rig->params.ambient_pressure, &log, error);
  if (status != LAB_OK)
    return status;
  if (log.dropped)
    fprintf(stderr, "%s: note: %s: %zu damaged rows left out\n", program.name, path, log.dropped);
  status = figures ? figures_of_log(model, rig, &log, file, error) : simulate_log(model, rig, &log, file, error);
  lab_log_free(&log);
  return status;
}

static int answer(const lab_cli *cli, const pneu_model *model, const lab_rig *rig, FILE *file, lab_error *error)
{
  if (!standard)
    return read_and_simulate(model, rig, cli->operand[1], file, error);
  return figures ? figures_of_standard(model, rig, file, error) : simulate_standard(model, file, error);
}

static int run(const lab_cli *cli, lab_error *error)
{
  lab_rig rig;
  pneu_model model;
  lab_outfile out;
  int status;
  if (cli->n_operands + standard != 2)
    return lab_fail(error, LAB_USAGE, "expected either LOG.csv or --step; see --help");
  if (json && !figures)
    return lab_fail(error, LAB_USAGE, "--json: goes with --metrics; a response is CSV");
  if (lab_rig_read(cli->operand[0], &rig, error) || lab_rig_model(&rig, &model, error) ||
      lab_out_open(&out, out_path, error))
    return error->status;
  status = answer(cli, &model, &rig, out.file, error);
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

#include "simulation.h"

#include <math.h>

#include "predict.h"
#include "response.h"
#include "schedule.h"
#include "standard.h"

enum { COLUMNS = 6 };

/* What is written is scale * value + offset. */
typedef struct series {
  const char *title; /* "p [kPa]" */
  double scale;
  const double *value; /* as many as there are rows */
  double offset;
} series;

static void write_header(FILE *file, const series *column, int n)
{
  int i;
  for (i = 0; i < n; i++)
    fprintf(file, "%s%s", i ? "," : "", column[i].title);
  fputc('\n', file);
}

/* NaN is an empty field. */
static void write_rows(FILE *file, const series *column, int n, size_t n_rows)
{
  size_t row;
  int i;
  for (row = 0; row < n_rows; row++)
    for (i = 0; i < n; i++) {
      const double value = column[i].scale * column[i].value[row] + column[i].offset;
      if (!isnan(value))
        fprintf(file, "%.10g", value + 0.0); /* no "-0" */
      fputc(i + 1 < n ? ',' : '\n', file);
    }
}

/* A column that the log counts the other way, as of a valve that air closes, is turned back; in SI, without the factor
 * of log.scale. */
static series turned(const lab_log_format *format, int channel, series c)
{
  if (format->scale[channel] < 0) {
    c.offset = c.scale * format->offset[channel];
    c.scale = -c.scale;
  }
  return c;
}

/* Time, commands, and those channels that are asked for; `u` and `sp` may be NULL.  Returns: the number of columns. */
static int columns(const pneu_model *model, const lab_log_format *format, const lab_response *response, const double *u,
                   const double *sp, int p, int x, int T, series *column)
{
  int n = 0, opening = model->p.proportional_band == 0;
  column[n++] = (series){"t [s]", 1, response->t, 0};
  if (u)
    column[n++] = opening ? (series){"u [1]", 1, u, 0} : (series){"u [kPa]", 1e-3, u, 0};
  if (sp)
    column[n++] = turned(format, LAB_CHANNEL_SP, (series){"sp [%]", 100, sp, 0});
  if (p)
    column[n++] = (series){"p [kPa]", 1e-3, response->p, 0};
  if (x)
    column[n++] = turned(format, LAB_CHANNEL_X, (series){"x [mm]", 1e3, response->x, 0});
  if (T)
    column[n++] = (series){"T [K]", 1, response->T, 0};
  return n;
}

int lab_simulation_write_standard(const pneu_model *model, FILE *file, lab_error *error)
{
  series column[COLUMNS];
  lab_log_format format;
  lab_response response;
  int n;
  lab_log_format_default(&format);
  if (lab_standard_experiment(model, &(lab_response_options){0}, &response, error))
    return error->status;
  n = columns(model, &format, &response, response.u, NULL, 1, 1, 0, column);
  write_header(file, column, n);
  write_rows(file, column, n, response.n);
  lab_response_free(&response);
  return LAB_OK;
}

/* A channel of one run; NULL where the log has none. */
static const double *rows_of(const lab_log *log, int channel, size_t run)
{
  return log->value[channel] ? log->value[channel] + log->run[run] : NULL;
}

int lab_simulation_write(const pneu_model *model, const lab_rig *rig, const lab_log *log, FILE *file, lab_error *error)
{
  double *const *value = log->value;
  int nothing = !value[LAB_CHANNEL_P] && !value[LAB_CHANNEL_X] && !value[LAB_CHANNEL_T];
  size_t run;
  if (lab_positioner_check(rig, log, error))
    return error->status;
  for (run = 0; run < log->n_runs; run++) {
    series column[COLUMNS];
    lab_response response;
    int n;
    if (lab_predict_log(model, &(lab_prediction){.rig = rig, .log = log, .run = run}, &response, error))
      return error->status;
    n = columns(model, &rig->log, &response, rows_of(log, LAB_CHANNEL_U, run), rows_of(log, LAB_CHANNEL_SP, run),
                nothing || value[LAB_CHANNEL_P], nothing || value[LAB_CHANNEL_X], value[LAB_CHANNEL_T] != NULL, column);
    if (run == 0)
      write_header(file, column, n);
    write_rows(file, column, n, response.n);
    lab_response_free(&response);
  }
  return LAB_OK;
}

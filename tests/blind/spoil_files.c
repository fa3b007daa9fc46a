/* Files of trials "as recorded". */
#include "spoil.h"

#include <math.h>
#include <string.h>

#include "../../apps/lab/base/outfile.h"

/* ---- The log ---- */

/* A column of a log, with the digits that a logger would give it. */
typedef struct column {
  const char *title;
  const double *value;
  double unit; /* of the title, in SI */
  int digits;
} column;

static int columns_of(const blind_recorded *r, const blind_log *l, column c[8])
{
  const int channels = r->t.channels;
  int n = 0;
  c[n++] = (column){"t [s]", l->t, 1, 5};
  if (r->loop <= BLIND_LOOP_U)
    c[n++] = (column){"u [1]", l->u, 1, 4};
  if (r->loop != BLIND_OPEN)
    c[n++] = (column){"sp [%]", l->sp, 1e-2, 2};
  if (channels & BLIND_P)
    c[n++] = (column){"p [kPa]", l->p, 1e3, 4};
  if (channels & BLIND_X)
    c[n++] = (column){"x [mm]", l->x, 1e-3, 5};
  if (channels & BLIND_T)
    c[n++] = (column){"T [K]", l->T, 1, 3};
  return n;
}

static void write_rows(FILE *file, const column *c, int n, size_t rows)
{
  size_t i;
  int k;
  for (k = 0; k < n; k++)
    fprintf(file, "%s%s", k ? "," : "", c[k].title);
  fputc('\n', file);
  for (i = 0; i < rows; i++) {
    for (k = 0; k < n; k++) {
      fputs(k ? "," : "", file);
      if (!isnan(c[k].value[i]))
        fprintf(file, "%.*f", c[k].digits, c[k].value[i] / c[k].unit);
    }
    fputc('\n', file);
  }
}

static int write_log(const blind_recorded *r, const char *folder, size_t *n_rows, lab_error *error)
{
  const second_rig first = blind_recorded_first(r, BLIND_ALL), later = blind_recorded_later(r, BLIND_ALL);
  lab_outfile out;
  blind_fine fine;
  blind_log log;
  column columns[8];
  int status;
  if (blind_run_recorded(r, &first, &later, r->t.step, &fine, error))
    return error->status;
  status = blind_spoil(r, &fine, &log, error);
  blind_fine_free(&fine);
  if (status == LAB_OK && (status = blind_open_in(folder, "fit.csv", &out, error)) == LAB_OK) {
    write_rows(out.file, columns, columns_of(r, &log, columns), log.n);
    status = lab_out_close(&out, error);
  }
  *n_rows = log.n;
  blind_log_free(&log);
  return status;
}

/* ---- The rig file ---- */

static void write_tolerances(FILE *file, const blind_recorded *r)
{
  int i;
  fputs("tolerance  = {", file);
  for (i = 0; i < BLIND_VALUES; i++)
    if (r->told[i] > 0 && blind_values[i].absolute)
      fprintf(file, " %s = \"%.3g %s\";", blind_values[i].name, r->told[i], blind_values[i].unit);
    else if (r->told[i] > 0)
      fprintf(file, " %s = \"%.3g %%\";", blind_values[i].name, 100 * r->told[i]);
  fputs(" };\n", file);
}

static void write_positioner(FILE *file, const second_positioner *k)
{
  fprintf(file, "positioner = { gain = %.10g; dead_band = \"%.10g %%\";", k->gain, 100 * k->dead_band);
  if (k->integral_time > 0)
    fprintf(file, " integral_time = \"%.10g s\";", k->integral_time);
  if (k->derivative_time > 0)
    fprintf(file, " derivative_time = \"%.10g s\";", k->derivative_time);
  fprintf(file, " cutoff_low = \"%.10g %%\"; cutoff_high = \"%.10g %%\"; };\n", 100 * k->cutoff_low,
          100 * k->cutoff_high);
}

static int write_rig(const blind_recorded *r, const char *folder, lab_error *error)
{
  lab_outfile out;
  second_rig declared = r->t.declared;
  declared.pressure_noise *= r->noise_told;
  declared.position_noise *= r->noise_told;
  if (lab_make_folder(folder, error) || blind_open_in(folder, "rig.cfg", &out, error))
    return error->status;
  blind_write_declared(out.file, &declared, r->t.channels, r->noise_told > 0);
  if (r->has & (1u << BLIND_TOLERANCE))
    write_tolerances(out.file, r);
  if (r->loop != BLIND_OPEN)
    write_positioner(out.file, &r->positioner);
  return lab_out_close(&out, error);
}

int blind_write_recorded(const blind_recorded *r, const char *folder, size_t *n_rows, lab_error *error)
{
  if (write_rig(r, folder, error))
    return error->status;
  return write_log(r, folder, n_rows, error);
}

/* ---- The truth ---- */

static void write_offs(FILE *file, const blind_recorded *r)
{
  int i;
  for (i = 0; i < BLIND_VALUES; i++)
    fprintf(file, blind_values[i].absolute ? "%s%s %+.4g" : "%s%s x%.4g", i ? "; " : "", blind_values[i].name,
            r->off[i]);
  fprintf(file, "; vent over fill x%.4g", r->vent);
}

static void write_two(FILE *file, const char *name, const double of[BLIND_SENSORS], double scale, const char *unit)
{
  if (of[0] != 0 || of[1] != 0)
    fprintf(file, "; %s p %.3g %s x %.3g %s", name, of[0] * scale, unit, of[1] * scale, unit);
}

static void write_details(FILE *file, const blind_recorded *r)
{
  fprintf(file, "noise told x%.3g; %d bits", r->noise_told, r->bits);
  write_two(file, "filter", r->filter, 1e3, "ms");
  write_two(file, "hum", r->hum, 100, "%");
  write_two(file, "colour", r->colour, 1, "sigma");
  write_two(file, "drift", r->drift, 100, "%");
  if (r->positioner.integral_start != 0)
    fprintf(file, "; integral from %.3g %%", 100 * r->positioner.integral_start);
  if (r->rounding > 0)
    fprintf(file, "; time to %g ms", r->rounding * 1e3);
  if (r->jitter > 0)
    fprintf(file, "; jitter %.2g ms", r->jitter * 1e3);
  if (r->lost > 0)
    fprintf(file, "; %.2g %% lost; gap of %.2g s at %.4g s", 100 * r->lost, r->gap, r->gap_at);
}

void blind_truth_header(FILE *file)
{
  fputs("trial,kind,log,channels,actuator,gas,flow,rows,spacing [s],effect,size,second_effect,second_size,onset [s],"
        "begins,beyond,imperfections,details,values (true over or less declared)\n",
        file);
}

void blind_truth_write(FILE *file, const blind_recorded *r, size_t n_rows)
{
  const blind_trial *t = &r->t;
  char text[256];
  int i;
  fprintf(file, "%d,%s,%s,%s,%s,%s,%s,%zu,%.4g", t->number, blind_kind_text(t->kind), blind_loop_text(r->loop),
          blind_channels_text(t->channels), t->actuator, blind_gas_text(t->declared.gas),
          blind_flow_text(t->declared.flow), n_rows, r->spacing);
  for (i = 0; i < BLIND_AT_ONCE; i++)
    if (i < t->n_missing)
      fprintf(file, ",%s,%.4g %s", t->missing[i].effect->name, t->missing[i].size, t->missing[i].effect->unit);
    else
      fputs(",,", file);
  if (isnan(r->onset))
    fputs(",,", file);
  else
    fprintf(file, ",%.4f,%s", r->onset,
            r->onset_value >= 0 ? blind_values[r->onset_value].name : t->missing[0].effect->name);
  fprintf(file, ",%s", r->beyond >= 0 ? blind_values[r->beyond].name : "");
  blind_imperfection_text(r, text, sizeof text);
  fprintf(file, ",%s,", text);
  write_details(file, r);
  fputc(',', file);
  write_offs(file, r);
  fputc('\n', file);
}

#include "logs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../apps/lab/base/outfile.h"

int blind_rows_open(double end, double spacing, blind_rows *rows, lab_error *error)
{
  rows->n = second_samples(end, spacing);
  rows->t = malloc(5 * rows->n * sizeof *rows->t);
  if (!rows->t)
    return lab_fail_memory(error, "a log");
  rows->u = rows->t + rows->n;
  rows->p = rows->u + rows->n;
  rows->x = rows->p + rows->n;
  rows->T = rows->x + rows->n;
  return LAB_OK;
}

second_log blind_rows_log(const blind_rows *rows)
{
  return (second_log){.t = rows->t, .u = rows->u, .p = rows->p, .x = rows->x, .T = rows->T};
}

second_rig blind_silent(const second_rig *rig, double step)
{
  second_rig g = *rig;
  g.pressure_noise = g.position_noise = g.temperature_noise = g.pressure_range = g.position_range = 0;
  g.step = step;
  return g;
}

int blind_simulate(const second_rig *rig, const blind_schedule *s, double spacing, blind_rows *rows, lab_error *error)
{
  const int halvings = 6;
  second_rig g = *rig;
  second_log log;
  second_audit audit;
  int i;
  if (blind_rows_open(s->end, spacing, rows, error))
    return error->status;
  log = blind_rows_log(rows);
  for (i = 0; i <= halvings; i++, g.step /= 2)
    if (!second_run(&g, s->t, s->u, s->n, s->end, spacing, &log, &audit) && audit.forced == 0)
      return LAB_OK;
  blind_rows_free(rows);
  return lab_fail(error, LAB_NUMERIC, "the virtual rig cannot follow its events, whatever the step");
}

void blind_rows_free(blind_rows *rows)
{
  free(rows->t);
  memset(rows, 0, sizeof *rows);
}

int blind_open_in(const char *folder, const char *name, lab_outfile *out, lab_error *error)
{
  char path[1024];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  return lab_out_open(out, path, error);
}

/* ---- Logs ---- */

static void write_rows(FILE *file, const blind_rows *r, int channels)
{
  size_t i;
  fputs("t [s],u [1]", file);
  fputs(channels & BLIND_P ? ",p [kPa]" : "", file);
  fputs(channels & BLIND_X ? ",x [mm]" : "", file);
  fputs(channels & BLIND_T ? ",T [K]\n" : "\n", file);
  for (i = 0; i < r->n; i++) {
    fprintf(file, "%.5f,%g", r->t[i], r->u[i]);
    if (channels & BLIND_P)
      fprintf(file, ",%.4f", r->p[i] * 1e-3);
    if (channels & BLIND_X)
      fprintf(file, ",%.5f", r->x[i] * 1e3);
    if (channels & BLIND_T)
      fprintf(file, ",%.3f", r->T[i]);
    fputc('\n', file);
  }
}

int blind_write_rows(const blind_rows *rows, int channels, const char *folder, const char *name, lab_error *error)
{
  lab_outfile out;
  if (blind_open_in(folder, name, &out, error))
    return error->status;
  write_rows(out.file, rows, channels);
  return lab_out_close(&out, error);
}

static int write_log(const blind_trial *t, const second_rig *rig, const blind_schedule *schedule, const char *folder,
                     const char *name, lab_error *error)
{
  blind_rows rows;
  int status;
  if (blind_simulate(rig, schedule, t->spacing, &rows, error))
    return error->status;
  status = blind_write_rows(&rows, t->channels, folder, name, error);
  blind_rows_free(&rows);
  return status;
}

/* ---- The rig file ---- */

void blind_write_declared(FILE *file, const second_rig *g, int channels, int tells_noise)
{
  int i;
  fprintf(file,
          "// What is declared of the rig that made the log. Pressures are gauge unless they say abs.\n"
          "actuator = {\n"
          "  name = \"trial\";\n"
          "  area = \"%.10g m^2\";  dead_volume = \"%.10g m^3\";  stroke = \"%.10g m\";\n"
          "  spring_rate = \"%.10g N/m\";  spring_preload = \"%.10g m\";\n"
          "  moving_mass = \"%.10g kg\";  dry_friction = \"%.10g N\";\n"
          "  viscous_friction = \"%.10g N.s/m\";  damping = \"%.10g N.s/m\";\n};\n",
          g->area, g->dead_volume, g->stroke, g->spring_rate, g->spring_preload, g->mass, g->dry_friction,
          g->viscous / 3, g->viscous * 2 / 3);
  fprintf(file, "transducer = {\n  fill_area = \"%.10g m^2\";  vent_area = \"%.10g m^2\";\n", g->fill_area,
          g->vent_area);
  if (g->flow == SECOND_ISO6358)
    fprintf(file, "  critical_ratio = %.10g;  subsonic_index = %.10g;\n", g->iso_b, g->iso_m);
  fprintf(file,
          "};\nsupply     = { pressure = \"%.10g Pa\";  temperature = \"%.10g K\"; };\n"
          "ambient    = { pressure = \"%.10g Pa\";  temperature = \"%.10g K\"; };\n"
          "laws       = { gas = \"%s\";  flow = \"%s\";  friction = \"coulomb\"; };\n",
          g->supply, g->supply_temperature, g->ambient, g->ambient_temperature, blind_gas_text(g->gas),
          blind_flow_text(g->flow));
  for (i = 0; i < BLIND_FITTED; i++)
    fprintf(file, "%s\"%s\"", i ? ", " : "fit        = ( ", blind_fitted_of[i].name);
  fputs(" );\n", file);
  if (tells_noise) {
    fprintf(file, "noise      = { pressure = \"%.6g Pa\";  position = \"%.6g m\"; ", g->pressure_noise,
            g->position_noise);
    if (channels & BLIND_T)
      fprintf(file, " temperature = \"%.6g K\"; ", g->temperature_noise);
    fputs("};\n", file);
  }
  if (g->gas == SECOND_ENERGY && g->heat > 0)
    fprintf(file, "effects    = { heat_transfer = { film_conductance = \"%.10g W/K\"; }; };\n", g->heat);
}

int blind_write_rig(const blind_trial *t, const char *folder, lab_error *error)
{
  lab_outfile out;
  if (lab_make_folder(folder, error) || blind_open_in(folder, "rig.cfg", &out, error))
    return error->status;
  blind_write_declared(out.file, &t->declared, t->channels, t->tells_noise);
  fputs("tolerance = { others = 0; }; // what is not fitted is exactly so\n", out.file);
  return lab_out_close(&out, error);
}

int blind_write_logs(const blind_trial *t, const char *folder, lab_error *error)
{
  const second_rig truth = blind_truth(t, BLIND_ALL);
  second_rig again = truth;
  again.seed++; /* other noise */
  if (blind_write_rig(t, folder, error) || write_log(t, &truth, &t->fit, folder, "fit.csv", error))
    return error->status;
  return write_log(t, &again, &t->holdout, folder, "holdout.csv", error);
}

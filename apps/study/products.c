#include "products.h"

#include <stdio.h>
#include <string.h>

#include "../lab/base/checksum.h"
#include "../lab/base/gnuplot.h"
#include "../lab/base/outfile.h"
#include "../lab/base/progress.h"
#include "agreement.h"
#include "attribution.h"
#include "conclusions.h"
#include "done.h"
#include "hypotheses.h"
#include "measured_products.h"
#include "numbers.h"
#include "report.h"
#include "responses.h"
#include "springair.h"
#include "verdicts.h"

/* Tables, in order of need: the report reads the others. */
static const struct {
  const char *name;
  int (*make)(const study *s, lab_error *error);
} tables[] = {
    {"standard", responses_standard},   {"steps", responses_steps},          {"static", responses_static},
    {"numbers", numbers_make},          {"sweeps", hypotheses_sweep},        {"hypotheses", verdicts_make},
    {"spring_and_air", springair_make}, {"attribution", attribution_make},   {"conclusions", conclusions_make},
    {"agreement", agreement_make},      {"vessel", measured_vessel_product}, {"servomotor", measured_damadics_product}};

/* Figures: study/figures/<name>.gp draws <name>.svg from the table <needs>. */
static const struct {
  const char *name, *needs;
} figures[] = {{"fig04", "fig04.csv"},
               {"fig05", "fig05.csv"},
               {"fig06", "fig06.csv"},
               {"fig07", "fig07.csv"},
               {"fig08", "fig08.csv"},
               {"fig11", "fig11.csv"},
               {"fig13", "fig13.csv"},
               {"fig14", "fig14.csv"},
               {"fig15", "fig15.csv"},
               {"fig16", "fig16.csv"},
               {"fig17", "fig17.csv"},
               {"fig18", "fig18.csv"},
               {"fig19", "fig19.csv"},
               {"hypotheses", "hypotheses.csv"},
               {"attribution", "attribution.csv"},
               {"work_precision", "work_precision.csv"},
               {"measured_vessel", "measured_vessel_curves.csv"},
               {"measured_damadics", "measured_damadics_static.csv"}};

enum { TABLES = sizeof tables / sizeof *tables, FIGURES = sizeof figures / sizeof *figures };

typedef struct maker {
  study *s;
  const study_run *run;
  done record;
  study_saved saved;
  uint64_t inputs; /* of every table: program and configuration */
  lab_progress progress;
  int count;
} maker;

static uint64_t hash_inputs(const study *s)
{
  uint64_t key = lab_checksum_text(LAB_CHECKSUM_SEED, lab_build());
  int i;
  key = lab_checksum_file(key, s->file);
  for (i = 0; i < s->n_actuators; i++)
    key = lab_checksum_file(key, s->actuator[i].file);
  return lab_checksum_text(key, s->measured);
}

static int is_fresh(const maker *m, const char *name, uint64_t key)
{
  return !m->run->force && done_is_fresh(&m->record, name, key);
}

static int step(maker *m)
{
  lab_progress_show(&m->progress, ++m->count, TABLES + FIGURES + 1);
  return LAB_OK;
}

static int make_table(maker *m, const char *name, int (*make)(const study *, lab_error *), uint64_t key,
                      lab_error *error)
{
  if (is_fresh(m, name, key))
    return step(m);
  m->saved.names[0] = 0;
  if (done_forget(&m->record, name, error))
    return error->status;
  if (make(m->s, error))
    return lab_fail_in(error, "%s", name);
  if (m->saved.names[0] && done_note(&m->record, name, key, m->saved.names, error))
    return error->status;
  return step(m);
}

static int exists(const char *path)
{
  FILE *file = fopen(path, "rb");
  if (file)
    fclose(file);
  return file != NULL;
}

/* What several figures load. */
static uint64_t hash_shared_scripts(const study *s, int folder)
{
  static const char *const shared[] = {"style.gp", "varied.gp"};
  char path[STUDY_PATH_TEXT];
  uint64_t key = LAB_CHECKSUM_SEED;
  int i;
  for (i = 0; i < 2; i++) {
    snprintf(path, sizeof path, "%.*sfigures/%s", folder, s->file, shared[i]);
    key = lab_checksum_file(key, path);
  }
  return key;
}

static int make_figure(maker *m, const char *name, const char *needs, lab_error *error)
{
  char script[STUDY_PATH_TEXT], table_path[STUDY_PATH_TEXT + 64], out[STUDY_PATH_TEXT + 64], product[64], file[64];
  const char *slash = strrchr(m->s->file, '/');
  const int folder = slash ? (int)(slash - m->s->file) + 1 : 0;
  uint64_t key;
  key = hash_shared_scripts(m->s, folder);
  snprintf(script, sizeof script, "%.*sfigures/%s.gp", folder, m->s->file, name);
  snprintf(table_path, sizeof table_path, "%s/%s", m->s->results, needs);
  snprintf(file, sizeof file, "%s.svg", name);
  snprintf(out, sizeof out, "%s/%s", m->s->results, file);
  snprintf(product, sizeof product, "figure-%s", name);
  key = lab_checksum_file(lab_checksum_file(key, script), table_path);
  if (!exists(table_path) || is_fresh(m, product, key))
    return step(m);
  if (done_forget(&m->record, product, error) || lab_gnuplot_draw(script, m->s->results, out, error) ||
      done_note(&m->record, product, key, file, error))
    return error->status;
  return step(m);
}

static int make_all(maker *m, lab_error *error)
{
  int i, status = LAB_OK;
  for (i = 0; i < TABLES && status == LAB_OK; i++)
    status = make_table(m, tables[i].name, tables[i].make, m->inputs, error);
  for (i = 0; m->run->figures && i < FIGURES && status == LAB_OK; i++)
    status = make_figure(m, figures[i].name, figures[i].needs, error);
  return status == LAB_OK ? make_table(m, "report", report_make, m->inputs, error) : status;
}

int products_make(study *s, const study_run *run, lab_error *error)
{
  static maker m;
  int status;
  memset(&m, 0, sizeof m);
  if (lab_make_folder(s->results, error))
    return error->status;
  m.s = s;
  m.run = run;
  m.inputs = hash_inputs(s);
  s->saved = &m.saved;
  done_read(&m.record, s->results);
  lab_progress_begin(&m.progress, "study", run->quiet);
  status = make_all(&m, error);
  lab_progress_end(&m.progress);
  return status;
}

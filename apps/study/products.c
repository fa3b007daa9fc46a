#include "products.h"

#include <stdio.h>
#include <string.h>

#include <unistd.h>

#include "../lab/base/checksum.h"
#include "../lab/base/gnuplot.h"
#include "../lab/base/outfile.h"
#include "../lab/base/progress.h"
#include "paper.h"

/* fig05.csv to fig08.csv and paper_numbers.csv: what follows from closed forms. */
static int numbers_make(const study *s, lab_error *error)
{
  static const char *const files[] = {"fig05.csv", "fig06.csv", "fig07.csv", "fig08.csv", "paper_numbers.csv"};
  int i, status = LAB_OK;
  for (i = 0; i <= PAPER_FIGURES && status == LAB_OK; i++) {
    table t;
    if (i < PAPER_FIGURES)
      paper_figure(i, &t);
    else
      paper_numbers_table(&t);
    status = study_save(s, files[i], &t, error);
    table_close(&t);
  }
  return status;
}

/* Tables, in order of need: the report reads the others. */
static const struct product {
  const char *name;
  const study_tables *tables; /* or */
  int (*make)(const study *s, lab_error *error);
} products[] = {{"steps", &step_responses, NULL},    {"static", &static_characteristic, NULL},
                {"numbers", NULL, numbers_make},     {"sweeps", &sweeps, NULL},
                {"hypotheses", &verdicts, NULL},     {"spring_and_air", &spring_and_air, NULL},
                {"directions", &directions, NULL},   {"edges", &edges, NULL},
                {"attribution", &attribution, NULL}, {"conclusions", NULL, conclusions_make},
                {"agreement", &agreement, NULL},     {"report", NULL, report_make}};

/* Figures: study/figures/<name>.gp draws <name>.svg where there is <name>.csv. */
static const char *const figures[] = {"fig04", "fig05",      "fig06",       "fig07",         "fig08", "fig11",
                                      "fig13", "fig14",      "fig15",       "fig16",         "fig17", "fig18",
                                      "fig19", "hypotheses", "attribution", "work_precision"};

enum { PRODUCTS = sizeof products / sizeof *products, FIGURES = sizeof figures / sizeof *figures };
enum { DONE_MAX = 128, PATH_TEXT = STUDY_PATH_TEXT + 2048 };

/* A line of the record: what has been made, from what. */
typedef struct done {
  char product[64];
  unsigned long long key;
  study_saved files; /* in the folder */
} done;

typedef struct maker {
  study *s;
  const study_run *run;
  int n_done, count;
  done done[DONE_MAX];
  study_saved saved;
  uint64_t inputs; /* of every product: program and configuration */
  lab_progress progress;
} maker;

static const char *path_in(const maker *m, const char *name, char path[PATH_TEXT])
{
  snprintf(path, PATH_TEXT, "%s/%s", m->s->results, name);
  return path;
}

/* ---- The record ---- */

static void read_record(maker *m)
{
  char text[PATH_TEXT];
  FILE *file;
  remove(path_in(m, ".done.part", text)); /* of a run that was killed while it wrote the record */
  file = fopen(path_in(m, ".done", text), "r");
  while (file && m->n_done < DONE_MAX && fgets(text, sizeof text, file)) {
    done *line = &m->done[m->n_done];
    m->n_done += sscanf(text, "%63s %llx %2047[^\n]", line->product, &line->key, line->files.names) == 3;
  }
  if (file)
    fclose(file);
}

static int write_record(const maker *m, lab_error *error)
{
  char path[PATH_TEXT];
  lab_outfile out;
  int i;
  if (lab_out_open(&out, path_in(m, ".done", path), error))
    return error->status;
  for (i = 0; i < m->n_done; i++)
    fprintf(out.file, "%s %llx %s\n", m->done[i].product, m->done[i].key, m->done[i].files.names);
  return lab_out_close(&out, error);
}

/* Its line; the end of the record where there is none. */
static int find(const maker *m, const char *product)
{
  int i;
  for (i = 0; i < m->n_done && strcmp(m->done[i].product, product) != 0; i++)
    ;
  return i;
}

/* Whether a product was made with this key and all its files are still there. */
static int is_fresh(const maker *m, const char *product, uint64_t key)
{
  const done *line = &m->done[find(m, product)];
  char names[sizeof line->files.names], path[PATH_TEXT], *name;
  if (m->run->force || line == m->done + m->n_done || line->key != key)
    return 0;
  strcpy(names, line->files.names);
  for (name = strtok(names, " "); name; name = strtok(NULL, " "))
    if (access(path_in(m, name, path), R_OK))
      return 0;
  return 1;
}

/* Forget a product that is about to be made again, lest an end in the midst of it leave a record that is not true. */
static int forget(maker *m, const char *product, lab_error *error)
{
  const int i = find(m, product);
  if (i == m->n_done)
    return LAB_OK;
  m->done[i] = m->done[--m->n_done];
  return write_record(m, error);
}

/* Note that a product has been made; one that has saved nothing is made again next time. */
static int note(maker *m, const char *product, uint64_t key, lab_error *error)
{
  done *line = &m->done[m->n_done];
  if (!m->saved.names[0] || m->n_done == DONE_MAX)
    return LAB_OK;
  snprintf(line->product, sizeof line->product, "%s", product);
  line->key = key;
  line->files = m->saved;
  m->n_done++;
  return write_record(m, error);
}

/* ---- Making ---- */

static uint64_t hash_inputs(const study *s)
{
  uint64_t key = lab_checksum_text(LAB_CHECKSUM_SEED, lab_build());
  int i;
  key = lab_checksum_file(key, s->file);
  for (i = 0; i < s->n_actuators; i++)
    key = lab_checksum_file(key, s->actuator[i].file);
  return key;
}

static int make_table(maker *m, const struct product *p, lab_error *error)
{
  lab_progress_count(&m->progress, ++m->count, PRODUCTS + FIGURES, 0);
  if (is_fresh(m, p->name, m->inputs))
    return LAB_OK;
  m->saved.names[0] = 0;
  if (forget(m, p->name, error))
    return error->status;
  if (p->tables ? study_make(m->s, p->tables, error) : p->make(m->s, error))
    return lab_fail_in(error, "%s", p->name);
  return note(m, p->name, m->inputs, error);
}

/* A figure comes from its script, what several of them load, and a table that comes from the inputs, or from elsewhere.
 */
static int make_figure(maker *m, const char *name, lab_error *error)
{
  const char *const scripts[] = {"style", "varied", name};
  char folder[STUDY_PATH_TEXT], script[PATH_TEXT], needed[PATH_TEXT], out[PATH_TEXT], product[64], file[64];
  uint64_t key = m->inputs;
  int i;
  lab_progress_count(&m->progress, ++m->count, PRODUCTS + FIGURES, 0);
  study_folder(m->s, folder);
  for (i = 0; i < 3; i++) {
    snprintf(script, sizeof script, "%s/figures/%s.gp", folder, scripts[i]);
    key = lab_checksum_file(key, script);
  }
  snprintf(file, sizeof file, "%s.csv", name);
  key = lab_checksum_file(key, path_in(m, file, needed));
  snprintf(product, sizeof product, "figure-%s", name);
  if (access(needed, R_OK) || is_fresh(m, product, key))
    return LAB_OK;
  snprintf(m->saved.names, sizeof m->saved.names, "%s.svg", name);
  if (forget(m, product, error) || lab_gnuplot_draw(script, m->s->results, path_in(m, m->saved.names, out), error))
    return error->status;
  return note(m, product, key, error);
}

static int make_all(maker *m, lab_error *error)
{
  int i, status = LAB_OK;
  for (i = 0; i < PRODUCTS - 1 && status == LAB_OK; i++)
    status = make_table(m, &products[i], error);
  for (i = 0; m->run->figures && i < FIGURES && status == LAB_OK; i++)
    status = make_figure(m, figures[i], error);
  return status == LAB_OK ? make_table(m, &products[PRODUCTS - 1], error) : status;
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
  read_record(&m);
  lab_progress_begin(&m.progress, "study", run->quiet);
  status = make_all(&m, error);
  lab_progress_end(&m.progress);
  return status;
}

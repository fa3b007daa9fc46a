#include "grid.h"

#include <stdlib.h>

/* The actuators of a grid.  Returns: how many */
static int actuators_of(const study *s, const study_grid *grid, int actuator[STUDY_ACTUATOR_MAX])
{
  const int twin = s->subject + s->n_printed; /* the same actuator, its spring from the bench set */
  int i, n = grid->actuators == STUDY_ALL ? s->n_actuators : s->n_printed;
  for (i = 0; i < n; i++)
    actuator[i] = i;
  if (grid->actuators < STUDY_SUBJECT)
    return n;
  actuator[0] = s->subject;
  actuator[1] = twin;
  return grid->actuators == STUDY_SUBJECT_AND_TWIN && twin < s->n_actuators ? 2 : 1;
}

static int laws_of(const study *s, const study_grid *grid)
{
  const int laws[] = {s->n_gas * s->n_flow, s->n_gas, 1};
  return laws[grid->laws];
}

static study_cell cell_at(const study *s, const study_grid *grid, int index)
{
  const int laws = laws_of(s, grid), flows = grid->laws == STUDY_EVERY_LAW ? s->n_flow : 1;
  int actuator[STUDY_ACTUATOR_MAX];
  study_cell c = {.s = s, .index = index, .law = index % laws};
  actuators_of(s, grid, actuator);
  c.actuator = actuator[index / laws];
  c.rig = &s->actuator[c.actuator];
  c.laws = study_laws(c.rig, s->gas[c.law / flows], s->flow[c.law % flows]);
  c.gas = pneu_gas_key(c.laws.gas);
  c.flow = pneu_flow_key(c.laws.flow);
  return c;
}

static int cells_of(const study *s, const study_grid *grid)
{
  int actuator[STUDY_ACTUATOR_MAX];
  return actuators_of(s, grid, actuator) * laws_of(s, grid);
}

int study_each(const study *s, const study_grid *grid,
               int (*visit)(const study_cell *cell, void *context, lab_error *error), void *context, lab_error *error)
{
  const int n = cells_of(s, grid);
  int i, worst = n, status = LAB_OK;
#pragma omp parallel for schedule(dynamic, 1)
  for (i = 0; i < n; i++) {
    const study_cell cell = cell_at(s, grid, i);
    lab_error mine;
    if (visit(&cell, context, &mine) == LAB_OK)
      continue;
#pragma omp critical(study_cell_error)
    if (i < worst) { /* the first in order, whichever thread was first */
      *error = mine;
      status = lab_fail_in(error, "%s, %s, %s", cell.rig->name, cell.gas, cell.flow);
      worst = i;
    }
  }
  return status;
}

/* ---- Tables ---- */

/* The tables of every cell, STUDY_OUTPUTS for each. */
typedef struct filling {
  const study_tables *tables;
  table *t;
} filling;

static int fill_cell(const study_cell *cell, void *context, lab_error *error)
{
  const filling *f = context;
  table *t = f->t + cell->index * STUDY_OUTPUTS;
  int k;
  for (k = 0; k < STUDY_OUTPUTS && f->tables->out[k].file; k++)
    table_open(&t[k], f->tables->out[k].header);
  return f->tables->rows(cell, t, error);
}

/* Put the rows of `n` cells together, by turns. */
static void collect(table *to, const table *from, int n)
{
  size_t row, most = 0;
  int i;
  for (i = 0; i < n; i++) {
    const size_t rows = table_rows(&from[i * STUDY_OUTPUTS]);
    most = rows > most ? rows : most;
    to->failed |= from[i * STUDY_OUTPUTS].failed;
  }
  for (row = 0; row < most; row++)
    for (i = 0; i < n; i++)
      table_copy_row(to, &from[i * STUDY_OUTPUTS], row);
}

static void name_file(const study_cell *first, const struct study_output *out, char name[STUDY_FILE_TEXT])
{
  if (out->scope == STUDY_WHOLE)
    snprintf(name, STUDY_FILE_TEXT, "%s", out->file);
  else if (out->scope == STUDY_CELL_FILE)
    snprintf(name, STUDY_FILE_TEXT, "%s_%s_%s_%s.csv", out->file, first->rig->name, first->gas, first->flow);
  else if (first->actuator == first->s->subject)
    snprintf(name, STUDY_FILE_TEXT, "%s.csv", out->file);
  else
    snprintf(name, STUDY_FILE_TEXT, "%s_%s.csv", out->file, first->rig->name);
}

/* Save output `k`, a file or several. */
static int save(const study *s, const filling *f, int k, lab_error *error)
{
  const study_tables *tables = f->tables;
  const struct study_output *out = &tables->out[k];
  const int n = cells_of(s, &tables->grid), laws = laws_of(s, &tables->grid);
  const int turn[] = {1, laws, n}, share[] = {n, laws, 1};
  const int in_turn = turn[out->order], in_file = share[out->scope];
  int first, i, status = LAB_OK;
  for (first = 0; first < n && status == LAB_OK; first += in_file) {
    const study_cell cell = cell_at(s, &tables->grid, first);
    char name[STUDY_FILE_TEXT];
    table t;
    table_open(&t, out->header);
    t.digits = out->digits;
    for (i = first; i < first + in_file; i += in_turn)
      collect(&t, f->t + i * STUDY_OUTPUTS + k, in_turn);
    name_file(&cell, out, name);
    status = study_save(s, name, &t, error);
    table_close(&t);
  }
  return status;
}

int study_make(const study *s, const study_tables *tables, lab_error *error)
{
  const int n = cells_of(s, &tables->grid) * STUDY_OUTPUTS;
  filling f = {tables, calloc((size_t)n, sizeof *f.t)};
  int k, status = f.t ? study_each(s, &tables->grid, fill_cell, &f, error) : lab_fail_memory(error, "tables");
  for (k = 0; status == LAB_OK && k < STUDY_OUTPUTS && tables->out[k].file; k++)
    status = save(s, &f, k, error);
  for (k = 0; f.t && k < n; k++)
    table_close(&f.t[k]);
  free(f.t);
  return status;
}

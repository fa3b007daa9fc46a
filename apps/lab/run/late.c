#include "late.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "schedule.h"

static const double at_once = 1e-9; /* [s] apart: of what a time is rounded to */

void lab_late_close(lab_late *late)
{
  free(late->rows);
  free(late->t);
  free(late->input);
  memset(late, 0, sizeof *late);
}

/* A command on its way: the row that has it, and when it acts. */
typedef struct command {
  size_t row;
  double from;
} command;

static const pneu_model *model_of(const lab_simulation *task, const pneu_model *model, size_t row)
{
  return task->rows ? task->rows[row] : model;
}

/* When the command of a row acts. */
static double acts_at(const lab_simulation *task, const pneu_model *model, size_t row, double before)
{
  const pneu_model *m = model_of(task, model, row);
  const int in_loop = m->band_edge > 0 && task->schedule->input[row].set_position;
  return fmax(task->schedule->t[row] + (in_loop ? 0 : (double)m->command_delay), before);
}

/* The inputs of a row, with the command that acts then; before the first one begins to run, it holds. */
static pneu_input input_at(const lab_schedule *s, size_t row, const command *acting, double t)
{
  const pneu_input now = lab_input_after(&s->input[acting->row], fmax(t - acting->from, 0));
  pneu_input input = s->input[row];
  input.u = now.u;
  input.u_rate = t < acting->from ? 0 : now.u_rate;
  return input;
}

/* Rows of a schedule and commands that act, in the order of time; what comes at once is one row. */
static void merge(const lab_simulation *task, const pneu_model *model, lab_late *late)
{
  const lab_schedule *s = task->schedule;
  command acting = {0, acts_at(task, model, 0, s->t[0])}, next = acting;
  size_t i = 0, *n = &late->schedule.n;
  double t = s->t[0];
  while (isfinite(t)) {
    while (i + 1 < s->n && s->t[i + 1] <= t + at_once)
      i++;
    while (next.from <= t + at_once) {
      acting = next;
      next.row++;
      next.from = next.row < s->n ? acts_at(task, model, next.row, acting.from) : HUGE_VAL;
    }
    late->t[*n] = t;
    late->rows[*n] = model_of(task, model, i);
    late->input[(*n)++] = input_at(s, i, &acting, t);
    t = fmin(i + 1 < s->n ? s->t[i + 1] : HUGE_VAL, next.from);
  }
}

int lab_late_open(const lab_simulation *task, const pneu_model *model, lab_late *late, lab_error *error)
{
  const size_t room = 2 * task->schedule->n + 1;
  memset(late, 0, sizeof *late);
  late->rows = malloc(room * sizeof *late->rows);
  late->t = malloc(room * sizeof *late->t);
  late->input = malloc(room * sizeof *late->input);
  if (!late->rows || !late->t || !late->input)
    return lab_fail_memory(error, "commands on their way");
  merge(task, model, late);
  late->schedule.t = late->t;
  late->schedule.input = late->input;
  return LAB_OK;
}

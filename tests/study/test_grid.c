/* apps/study/grid: rows of cells, put together in every order and split into files */
#include "../scratch.h"

#include "../../apps/study/grid.h"

/* Two actuators, of which the second is the subject, in two laws of the chamber and one of flow. */
static study *made_up(void)
{
  static study s;
  memset(&s, 0, sizeof s);
  snprintf(s.results, sizeof s.results, "%s", scratch_folder);
  s.n_actuators = s.n_printed = 2;
  s.subject = 1;
  strcpy(s.actuator[0].name, "a");
  strcpy(s.actuator[1].name, "b");
  s.n_gas = 2;
  s.gas[1] = PNEU_GAS_ENERGY;
  s.n_flow = 1;
  return &s;
}

/* Two rows a cell; in the last cell a third. */
static int rows(const study_cell *c, table *t, lab_error *unused)
{
  int k, i;
  (void)unused;
  for (k = 0; k < 3; k++)
    for (i = 0; i < (c->index == 3 ? 3 : 2); i++)
      table_row(&t[k], "ssg", c->rig->name, c->gas, (double)i);
  return LAB_OK;
}

static void assert_file(const char *name, const char *want)
{
  char *text = scratch_read(scratch_path(name));
  check_note("%s", name);
  assert_string_equal(text, want);
  free(text);
}

TEST(test_study_make__orders_and_scopes__files)
{
  const study_tables tables = {{STUDY_ALL, STUDY_EVERY_LAW},
                               rows,
                               {{"cell.csv", "n,g,i", STUDY_BY_CELL, STUDY_WHOLE, 0},
                                {"actuator", "n,g,i", STUDY_BY_ACTUATOR, STUDY_ACTUATOR_FILE, 0},
                                {"row.csv", "n,g,i", STUDY_BY_ROW, STUDY_WHOLE, 0}}};
  succeed(study_make(made_up(), &tables, &error));
  assert_file("cell.csv", "n,g,i\na,isothermal,0\na,isothermal,1\na,energy,0\na,energy,1\n"
                          "b,isothermal,0\nb,isothermal,1\nb,energy,0\nb,energy,1\nb,energy,2\n");
  assert_file("actuator_a.csv", "n,g,i\na,isothermal,0\na,energy,0\na,isothermal,1\na,energy,1\n");
  assert_file("actuator.csv", "n,g,i\nb,isothermal,0\nb,energy,0\nb,isothermal,1\nb,energy,1\nb,energy,2\n");
  assert_file("row.csv", "n,g,i\na,isothermal,0\na,energy,0\nb,isothermal,0\nb,energy,0\n"
                         "a,isothermal,1\na,energy,1\nb,isothermal,1\nb,energy,1\nb,energy,2\n");
}

static int one_row(const study_cell *c, table *t, lab_error *unused)
{
  (void)unused;
  table_row(t, "sg", c->rig->name, 1.0 / 3);
  return LAB_OK;
}

TEST(test_study_make__one_law_of_the_subject__one_cell)
{
  const study_tables tables = {
      {STUDY_SUBJECT, STUDY_ONE_LAW}, one_row, {{"c", "n,x", STUDY_BY_CELL, STUDY_CELL_FILE, 3}}};
  succeed(study_make(made_up(), &tables, &error));
  assert_file("c_b_isothermal_paper.csv", "n,x\nb,0.333\n");
}

/* All but the first cell fail; whichever is done first, the error of the second is told. */
static int fail_later(const study_cell *c, void *context, lab_error *mine)
{
  (void)context;
  return c->index ? lab_fail(mine, LAB_NUMERIC, "cell %d", c->index) : LAB_OK;
}

TEST(test_study_each__several_fail__first_in_order_is_told)
{
  const study_grid grid = {STUDY_ALL, STUDY_EVERY_LAW};
  int i;
  for (i = 0; i < 50; i++) {
    assert_fails(study_each(made_up(), &grid, fail_later, NULL, &error), LAB_NUMERIC, "a, energy, paper");
    assert_contains(error.text, "cell 1");
  }
}

static int count(const study_cell *c, void *context, lab_error *unused)
{
  int *n = context;
  (void)unused;
  n[c->index] = 10 * c->actuator + c->law + 1;
  return LAB_OK;
}

TEST(test_study_each__twin_and_gas_laws__cells)
{
  const study_grid twins = {STUDY_SUBJECT_AND_TWIN, STUDY_GAS_LAWS};
  study *s = made_up();
  int n[4] = {0};
  s->n_printed = 1; /* b is the twin of a */
  s->subject = 0;
  s->n_flow = 2;
  succeed(study_each(s, &twins, count, n, &error));
  assert_int_equal(n[0], 1);
  assert_int_equal(n[1], 2);
  assert_int_equal(n[2], 11);
  assert_int_equal(n[3], 12);
}

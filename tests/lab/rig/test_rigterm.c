/* apps/lab/rig/rigterm: free terms in rig files and as C initialisers, and what models do with them */
#include "../../rigfile.h"

#include "../../../apps/lab/run/run.h"
#include "../../../apps/lab/rig/rigterm.h"

static const char declared[] =
    "laws = { gas = \"energy\"; };\n"
    "unlisted = (\n"
    "  { equation = \"friction\"; argument = \"x\"; from = \"0 mm\"; to = \"20 mm\"; values = [ 0, 15, -40, 1500 ]; "
    "},\n"
    "  { equation = \"flow\"; argument = \"p\"; from = \"2 bar\"; to = \"400 kPa\"; unit = \"g/s\";\n"
    "    values = ( 0, -0.25, \"-1 g/s\" ); },\n"
    "  { equation = \"shown_position\"; argument = \"v\"; from = -0.1; to = \"50 mm/s\"; unit = \"mm\";\n"
    "    values = [ 0.5, 1.5 ]; },\n"
    "  { equation = \"heat\"; argument = \"u\"; from = -1; to = 1; values = [ 1e-3, 2e99 ]; }\n"
    ");\n";

/* ---- Reading ---- */

static void assert_term(const pneu_term *t, int equation, int argument, double from, double to, int n)
{
  assert_int_equal(t->equation, equation);
  assert_int_equal(t->argument, argument);
  assert_int_equal(t->n, n);
  assert_close(t->from, from, 0, 1e-14);
  assert_close(t->to, to, 0, 1e-14);
}

TEST(test_lab_rig_read__unlisted__becomes_terms_in_si)
{
  const lab_rig rig = read_rig(declared);
  assert_int_equal(rig.n_terms, 4);
  assert_term(&rig.term[0], PNEU_TERM_FRICTION, PNEU_TERM_OVER_POSITION, 0, 0.02, 4);
  assert_close(rig.term[0].value[2], -40, 0, 0);
  assert_close(rig.term[0].value[3], 1500, 0, 0);
  assert_term(&rig.term[1], PNEU_TERM_FLOW, PNEU_TERM_OVER_PRESSURE, 2e5, 4e5, 3);
  assert_close(rig.term[1].value[1], -0.25e-3, 0, 1e-14);
  assert_close(rig.term[1].value[2], -1e-3, 0, 1e-14);
  assert_term(&rig.term[2], PNEU_TERM_SHOWN_POSITION, PNEU_TERM_OVER_VELOCITY, -0.1, 0.05, 2);
  assert_close(rig.term[2].value[1], 1.5e-3, 0, 1e-14);
  assert_term(&rig.term[3], PNEU_TERM_HEAT, PNEU_TERM_OVER_OPENING, -1, 1, 2);
  assert_close(rig.term[3].value[1], 2e99, 0, 0);
}

TEST(test_lab_rig_read__no_terms__are_none)
{
  assert_int_equal(read_rig("// none\n").n_terms, 0);
  assert_int_equal(read_rig("unlisted = ( );\n").n_terms, 0);
}

TEST(test_lab_rig_read__every_word__is_known)
{
  int e, a;
  char text[300];
  for (e = 0; e < PNEU_TERM_EQUATION_COUNT; e++)
    for (a = 0; a < PNEU_TERM_ARGUMENT_COUNT; a++) {
      lab_rig rig;
      snprintf(text, sizeof text,
               "laws = { gas = \"energy\"; }; unlisted = ( { equation = \"%s\"; argument = \"%s\"; from = \"0 %s\"; "
               "to = \"1 %s\"; values = [ 1, 2 ]; unit = \"%s\"; } );\n",
               lab_term_equations[e].key, lab_term_arguments[a].key, lab_term_arguments[a].unit,
               lab_term_arguments[a].unit, lab_term_equations[e].unit);
      rig = read_rig(text);
      assert_term(&rig.term[0], e, a, 0, 1, 2);
      assert_close(rig.term[0].value[1], 2, 0, 0);
    }
}

TEST(test_lab_rig_read__cycle__becomes_a_term_over_time)
{
  const lab_rig rig = read_rig("unlisted = ( { equation = \"supply\"; argument = \"t\"; from = 0; to = \"250 ms\";\n"
                               "  unit = \"kPa\"; values = ( 0, -3.5, \"20 mbar\", 0.1 ); } );\n");
  pneu_model model;
  assert_int_equal(rig.n_terms, 1);
  assert_term(&rig.term[0], PNEU_TERM_SUPPLY, PNEU_TERM_OVER_CYCLE, 0, 0.25, 4);
  assert_close(rig.term[0].value[1], -3500, 0, 1e-14);
  assert_close(rig.term[0].value[2], 2000, 0, 1e-14);
  succeed(lab_rig_model(&rig, &model, &error));
  assert_int_equal(model.clock, 0);
}

/* ---- Bad terms ---- */

/* A term of which one part is replaced must be refused, with LAB_DATA, the key in its place, and some words. */
static void assert_refused(const char *part, const char *by, const char *place, const char *words)
{
  static const char good[] = "unlisted = (\n  { equation = \"force\"; argument = \"x\";\n    from = \"0 mm\";\n"
                             "    to = \"20 mm\";\n    unit = \"N\"; values = [ 1, 2 ]; } );\n";
  const char *at = strstr(good, part);
  char text[1000];
  assert_non_null(at);
  snprintf(text, sizeof text, "%.*s%s%s", (int)(at - good), good, by, at + strlen(part));
  assert_rig_refused(text, place, words);
}

TEST(test_lab_rig_read__bad_words__name_the_nearest)
{
  assert_refused("force", "farce", "rig.cfg:2: unlisted[0].equation:", "nearest known one is \"force\"");
  assert_refused("\"x\"", "\"y\"", "rig.cfg:2: unlisted[0].argument:", "unknown word \"y\"");
  assert_refused("to =", "too =", "rig.cfg:4: unlisted[0].too:", "nearest known one is \"to\"");
}

TEST(test_lab_rig_read__missing_keys__are_named)
{
  assert_refused("equation = \"force\";", "", "unlisted[0]:", "equation is missing");
  assert_refused("argument = \"x\";", "", "unlisted[0]:", "argument is missing");
  assert_refused("from = \"0 mm\";", "", "unlisted[0]:", "from is missing");
  assert_refused("to = \"20 mm\";", "", "unlisted[0]:", "to is missing");
  assert_refused("values = [ 1, 2 ];", "", "unlisted[0]:", "values is missing");
}

TEST(test_lab_rig_read__bad_ends__are_refused)
{
  assert_refused("20 mm", "20 kPa", "rig.cfg:4: unlisted[0].to:", "kPa");
  assert_refused("20 mm", "0 mm", "rig.cfg:4: unlisted[0].to:", "more than from");
  assert_refused("20 mm", "-1 mm", "rig.cfg:4: unlisted[0].to:", "found -0.001 m");
  assert_refused("\"0 mm\"", "1e999", "rig.cfg:3: unlisted[0].from:", "expected");
}

TEST(test_lab_rig_read__bad_values__are_refused)
{
  char many[20 + 3 * (PNEU_TERM_KNOTS + 1)] = "[ 1";
  int i;
  assert_refused("[ 1, 2 ]", "[ 1 ]", "rig.cfg:5: unlisted[0].values:", "2 to 33 entries");
  for (i = 0; i < PNEU_TERM_KNOTS; i++)
    strcat(many, ",2");
  strcat(many, "]");
  assert_refused("[ 1, 2 ]", many, "unlisted[0].values:", "entries");
  assert_refused("[ 1, 2 ]", "3", "unlisted[0].values:", "entries");
  assert_refused("[ 1, 2 ]", "[ 1.0, 1e999 ]", "unlisted[0].values[1]:", "finite");
  assert_refused("[ 1, 2 ]", "[ \"1 N\", \"2 kg\" ]", "unlisted[0].values[1]:", "kg");
  assert_refused("[ 1, 2 ]", "[ 0, 0.1, 0 ]", "rig.cfg:5: mismatched element type in array:", "0.0 beside 0.1");
  assert_refused("[ 1, 2 ]", "( 1, (2) )", "unlisted[0].values[1]:", "found a list");
}

/* A cosine goes with its sine. */
TEST(test_lab_rig_read__odd_number_over_a_cycle__is_refused)
{
  assert_rig_refused("unlisted = ( { equation = \"force\"; argument = \"t\"; from = 0;\n"
                     "  to = 2; values = [ 1, 2, 3 ]; } );\n",
                     "rig.cfg:2: unlisted[0].values: expected an even number of values", "a list of 3 entries");
}

TEST(test_lab_rig_read__bad_unit__is_refused)
{
  assert_refused("\"N\"", "\"kPa\"", "rig.cfg:5: unlisted[0].unit:", "kPa");
  assert_refused("\"N\"", "1", "unlisted[0].unit:", "a unit in quotes");
}

TEST(test_lab_rig_read__no_list_of_groups_or_too_many__is_refused)
{
  static const char one[] = "{ equation = \"force\"; argument = \"x\"; from = 0; to = 1; values = [ 1, 2 ]; }";
  char text[1000];
  assert_rig_refused("unlisted = { };\n", "rig.cfg:1: unlisted:", "expected a list");
  assert_rig_refused("unlisted = ( 3 );\n", "unlisted[0]", "expected a group");
  snprintf(text, sizeof text, "unlisted = ( %s, %s, %s, %s, %s );\n", one, one, one, one, one);
  assert_rig_refused(text, "unlisted", "0 to 4 entries");
}

TEST(test_lab_rig_read__heat_that_cannot_act__is_refused)
{
  static const char *const laws[] = {"laws = { gas = \"isothermal\"; };", "laws = { gas = \"polytropic\"; };",
                                     "laws = { gas = \"energy\"; }; inputs = [ \"p\" ];"};
  char text[300];
  int i;
  for (i = 0; i < 3; i++) {
    snprintf(text, sizeof text,
             "%s unlisted = ( { equation = \"heat\"; argument = \"p\"; from = 0; to = 1; values = [ 1, 2 ]; } );",
             laws[i]);
    assert_rig_refused(text, "unlisted[0]:", "heat does nothing");
  }
}

/* ---- Writing ---- */

/* Terms of every size, with numbers that no short text gives. */
static lab_rig odd_rig(void)
{
  static const int equation[LAB_TERM_MAX] = {PNEU_TERM_SUPPLY, PNEU_TERM_FRICTION, PNEU_TERM_HEAT,
                                             PNEU_TERM_SHOWN_POSITION},
                   argument[LAB_TERM_MAX] = {PNEU_TERM_OVER_CYCLE, PNEU_TERM_OVER_VELOCITY, PNEU_TERM_OVER_PRESSURE,
                                             PNEU_TERM_OVER_OPENING};
  lab_rig rig = read_rig("laws = { gas = \"energy\"; };");
  int i, k;
  rig.n_terms = LAB_TERM_MAX;
  for (i = 0; i < LAB_TERM_MAX; i++) {
    pneu_term *t = &rig.term[i];
    t->equation = equation[i];
    t->argument = argument[i];
    t->n = i ? 11 * i : 2;
    t->from = (pneu_real)(-1.0 / 3);
    t->to = (pneu_real)(1e5 / 7);
    for (k = 0; k < t->n; k++)
      t->value[k] = (pneu_real)(k % 3 ? 1e9 * sin(k) : k);
  }
  return rig;
}

TEST(test_lab_rig_write__terms__come_back_bit_for_bit)
{
  const lab_rig rig = odd_rig(), again = write_and_read(&rig, NULL);
  assert_int_equal(again.n_terms, LAB_TERM_MAX);
  assert_memory_equal(rig.term, again.term, sizeof rig.term);
}

/* ---- C initialisers ---- */

/* Every number of a term, for a program that prints them by the same list. */
#define SHOW                                                                                                           \
  "for (i = 0; i < n; i++) {\n"                                                                                        \
  "  printf(\"%d %d %d %.17g %.17g\", term[i].equation, term[i].argument, term[i].n, term[i].from, term[i].to);\n"     \
  "  for (k = 0; k < PNEU_TERM_KNOTS; k++) printf(\" %.17g\", term[i].value[k]);\n"                                    \
  "}\n"

static void show(const pneu_term *term, int n, char *text, size_t size)
{
  int i, k;
  *text = '\0';
  for (i = 0; i < n; i++) {
    lab_append(text, size, "%d %d %d %.17g %.17g", term[i].equation, term[i].argument, term[i].n, (double)term[i].from,
               (double)term[i].to);
    for (k = 0; k < PNEU_TERM_KNOTS; k++)
      lab_append(text, size, " %.17g", (double)term[i].value[k]);
  }
}

/* What a C90 program prints that includes the file. */
static char *printed_by_program(void)
{
  const char *cc = getenv("CC") && *getenv("CC") ? getenv("CC") : "cc";
  char line[4096];
  scratch_text("show.c", "#include <stdio.h>\n#include \"pneu.h\"\n#include \"terms.h\"\n"
                         "int main(void)\n{\n  static const pneu_term term[] = MODEL_TERMS;\n"
                         "  int i, k, n = MODEL_N_TERMS;\n" SHOW "  return 0;\n}\n");
  snprintf(line, sizeof line, "%s -std=c90 -pedantic-errors -Wall -Wextra -Werror -Ilib -I%s -o %s %s && %s > %s", cc,
           scratch_folder, scratch_path("show"), scratch_path("show.c"), scratch_path("show"), scratch_path("shown"));
  assert_int_equal(system(line), 0);
  return scratch_read(scratch_path("shown"));
}

TEST(test_lab_terms_print_c__compiled_and_run__has_the_same_numbers)
{
  static char want[16384];
  const lab_rig rig = odd_rig();
  FILE *file = fopen(scratch_path("terms.h"), "w");
  char *got;
  assert_non_null(file);
  lab_terms_print_c(file, rig.term, rig.n_terms);
  assert_int_equal(fclose(file), 0);
  show(rig.term, rig.n_terms, want, sizeof want);
  got = printed_by_program();
  assert_string_equal(got, want);
  free(got);
}

TEST(test_lab_terms_print_c__no_terms__only_counts_them)
{
  FILE *file = fopen(scratch_path("none.h"), "w");
  char *text;
  assert_non_null(file);
  lab_terms_print_c(file, NULL, 0);
  assert_int_equal(fclose(file), 0);
  text = scratch_read(scratch_path("none.h"));
  assert_string_equal(text, "#define MODEL_N_TERMS 0\n");
  free(text);
}

/* ---- Models ---- */

TEST(test_lab_rig_model__terms__are_those_of_the_rig)
{
  const lab_rig rig = read_rig(declared), copy = rig;
  pneu_model model;
  succeed(lab_rig_model(&rig, &model, &error));
  assert_int_equal(model.n_terms, 4);
  assert_ptr_equal(model.term, rig.term);
  succeed(lab_rig_model(&copy, &model, &error));
  assert_ptr_equal(model.term, copy.term);
}

TEST(test_lab_rig_model__bad_term__is_refused)
{
  lab_rig rig = read_rig(declared);
  pneu_model model;
  rig.term[1].value[1] = (pneu_real)NAN;
  assert_fails(lab_rig_model(&rig, &model, &error), LAB_DATA, "unlisted: parameter outside its bounds or not finite");
}

/* A prediction makes its model from a copy of the rig: a vessel that fills by a constant flow, p' = q R T/V. */
TEST(test_lab_run_predict__terms__are_in_the_prediction)
{
  const lab_rig rig =
      read_rig("actuator = { stroke = 0; dead_volume = \"1 l\"; }; noise = { p = \"100 Pa\"; };\n"
               "unlisted = ( { equation = \"flow\"; argument = \"p\"; from = 0; to = 1; values = [ 1e-5, 1e-5 ]; } );");
  const double slope = 1e-5 * (double)rig.params.gas_constant * (double)rig.params.ambient_temperature / 1e-3;
  lab_run run;
  lab_log log;
  double y[4];
  int i;
  scratch_text("log.csv", "t [s],u [1],p [Pa]\n0,0,0\n1,0,0\n2,0,0\n3,0,0\n");
  succeed(lab_log_read(scratch_path("log.csv"), &rig.log, 101325, &log, &error));
  succeed(lab_run_open(&rig, &log, 0, &run, &error));
  succeed(lab_run_predict(&run, &(lab_episode){0, &rig}, 1, NULL, 1e-8, y, &error));
  for (i = 1; i < 4; i++)
    assert_close(y[i] - y[0], slope * i, 1e-3, 1e-6);
  lab_run_close(&run);
  lab_log_free(&log);
}

/* apps/lab/log/log, and through it logformat, logguess, logheader, logmap, logname, logcolumn, logstamps, logshape, csv, text */
#include "../../scratch.h"

#include "../../../apps/lab/log/log.h"
#include "../../../apps/lab/log/logread.h"

static lab_log_format format;
static lab_log rows;                  /* of the log that was read last */
static const double ambient = 100000; /* [Pa] */

static int forget(void **state)
{
  lab_log_free(&rows);
  return 0;
}

static int fresh_format(void **state)
{
  lab_log_format_default(&format);
  memset(&error, 0, sizeof error);
  return 0;
}

#define CASE(name) TEST_WITH(name, fresh_format, forget)

/* Read a log that must be good. */
static void read_log(const char *text)
{
  lab_log_free(&rows);
  succeed(lab_log_read(scratch_text("log.csv", text), &format, ambient, &rows, &error));
}

/* Read a log that must be refused, with LAB_DATA, the file's name and some words. */
static void assert_refused(const char *text, const char *place, const char *words)
{
  lab_log log;
  assert_fails(lab_log_read(scratch_text("log.csv", text), &format, ambient, &log, &error), LAB_DATA, words);
  assert_contains(error.text, place);
  assert_null(log.line);
  assert_null(log.value[LAB_CHANNEL_TIME]);
}

static void set_columns(const char *a, const char *b, const char *c)
{
  const char *text[3] = {a, b, c};
  for (format.n_columns = 0; format.n_columns < 3 && text[format.n_columns]; format.n_columns++)
    strcpy(format.column[format.n_columns], text[format.n_columns]);
}

/* All rows of a channel; NAN is a gap. */
static void check_column(int channel, double tol, const double *want, size_t n)
{
  size_t i;
  assert_int_equal(rows.n, n);
  for (i = 0; i < n; i++) {
    const double got = rows.value[channel][i];
    check_note("%s of row %zu", lab_channels[channel].key, i);
    if (isnan(want[i]))
      assert_true(isnan(got));
    else
      assert_close(got, want[i], tol, 0);
  }
}
#define LIST(type, ...)               (const type[]){__VA_ARGS__}, sizeof((const type[]){__VA_ARGS__}) / sizeof(type)
#define assert_column(name, tol, ...) check_column(LAB_CHANNEL_##name, tol, LIST(double, __VA_ARGS__))

/* Where runs begin, and where the last one ends. */
static void check_runs(const size_t *want, size_t n)
{
  assert_int_equal(rows.n_runs + 1, n);
  assert_memory_equal(rows.run, want, n * sizeof *want);
}
#define assert_runs(...) check_runs(LIST(size_t, __VA_ARGS__))

static void check_lines(const int *want, size_t n)
{
  assert_int_equal(rows.n, n);
  assert_memory_equal(rows.line, want, n * sizeof *want);
}
#define assert_lines(...) check_lines(LIST(int, __VA_ARGS__))

/* ---- Good logs ---- */

CASE(test_lab_log_read__documented_format__gives_si)
{
  read_log("# a remark\nt [ms],u [%],p [bar],x [mm],T [degC],force [kN]\n"
           "0,0,0,0,25,0\n# another\n10,50,1.5,2.5,26,-0.25\n");
  assert_column(TIME, 1e-15, 0, 0.01);
  assert_column(U, 1e-15, 0, 0.5);
  assert_column(P, 1e-9, 0, 150000);
  assert_column(X, 1e-15, 0, 0.0025);
  assert_column(T, 1e-12, 298.15, 299.15);
  assert_column(FORCE, 1e-12, 0, -250);
  assert_null(rows.value[LAB_CHANNEL_PS]);
  assert_lines(3, 5);
  assert_runs(0, 2);
}

CASE(test_lab_log_read__absolute_pressures__become_gauge)
{
  read_log("t [s],p_abs [kPa],ps_abs [bar],p2_abs [Pa]\n0,120,5,100000\n");
  assert_column(P, 1e-9, 20000);
  assert_column(PS, 1e-9, 400000);
  assert_column(P2, 1e-9, 0);
}

CASE(test_lab_log_read__dos_lines_mark_quotes_and_blank_end__are_accepted)
{
  read_log("\xEF\xBB\xBF\"t [s]\", \"u [1]\"\r\n0, 1\r\n1, 0\r\n\r\n \r\n");
  assert_column(U, 0, 1, 0);
}

/* A mark in quotes is text, and a number in quotes is a number. */
CASE(test_lab_log_read__cells_in_quotes__are_cells)
{
  read_log("\"t [s]\",u [1],\"-\"\n\"0\",\"1\",\"hall 2, \"\"east\"\"\"\n1,0,west\n");
  assert_column(U, 0, 1, 0);
}

CASE(test_lab_log_command_changes__between_two_rows__counts)
{
  lab_log none;
  read_log("t [s],u [1]\n0,0\n1,0\n2,1\n3,1\n");
  none = rows;
  none.value[LAB_CHANNEL_U] = NULL;
  assert_true(lab_log_command_changes(&rows, 1, 2));
  assert_true(lab_log_command_changes(&rows, 0, 3));
  assert_false(lab_log_command_changes(&rows, 0, 1));
  assert_false(lab_log_command_changes(&rows, 2, 3));
  assert_false(lab_log_command_changes(&rows, 2, 2));
  assert_false(lab_log_command_changes(&none, 0, 3));
}

CASE(test_lab_log_read__last_line_without_end__counts)
{
  read_log("\xEF\xBB\xBFt [s],u [1]\n0,0\n1,0.5");
  assert_column(U, 0, 0, 0.5);
}

CASE(test_lab_log_read__empty_field_or_nan__is_a_gap)
{
  read_log("t [s],u [1],p [kPa],x [mm]\n0,0,,1\n1,0,nan,NaN\n2,0,3,\n");
  assert_column(P, 1e-9, NAN, NAN, 3000);
  assert_column(X, 1e-15, 1e-3, NAN, NAN);
}

CASE(test_lab_log_read__column_named_minus__is_ignored)
{
  read_log("t [s],-,p [kPa]\n0,what,1\n1,ever,2\n");
  assert_column(P, 1e-9, 1000, 2000);
}

CASE(test_lab_log_read__uneven_times__are_kept)
{
  read_log("t [s],u [1]\n-1,0\n0.001,0\n7.25,0\n");
  assert_column(TIME, 0, -1, 0.001, 7.25);
}

/* ---- Raw logger files ---- */

CASE(test_lab_log_read__semicolons_and_decimal_comma__are_read)
{
  format.delimiter = ';';
  format.decimal = ',';
  read_log("t [s];p [bar]\n0,5;1,25\n");
  assert_column(TIME, 0, 0.5);
  assert_column(P, 1e-9, 125000);
}

CASE(test_lab_log_read__thousands_dots_in_time__are_left_out)
{
  format.delimiter = ';';
  format.thousands = '.';
  set_columns("t [ms]", "-", "p [bar]");
  read_log("902.000;3.658;7.315\r\n1.003.000;3.658;7.316\r\n");
  assert_column(TIME, 1e-15, 0.902, 1.003);
  assert_column(P, 1e-9, 731500, 731600);
}

CASE(test_lab_log_read__dates_beside_a_documented_header__are_time)
{
  read_log("Timestamp,u [1]\n2026-11-03 09:12:44,0\n2026-11-03 09:12:46.5,0\n");
  assert_column(TIME, 1e-9, 0, 2.5);
}

CASE(test_lab_log_read__tabs_and_skipped_lines__are_read)
{
  format.delimiter = '\t';
  format.skip_lines = 2;
  set_columns("t [ms]", "x [mm]", "force [N]");
  read_log("Logger 7\nTime\tLaser\tForce\n0.000\t-0.018\t50.178\n11.000\t0.004\t50.193\n");
  assert_lines(3, 4);
  assert_column(X, 1e-18, -18e-6, 4e-6);
  assert_column(FORCE, 50.193e-15, 50.178, 50.193);
}

CASE(test_lab_log_read__units_above_vacuum__become_gauge)
{
  static const char *const units[] = {"bara", "bar(a)", "bar abs"};
  size_t i;
  read_log("t [s],p [kPaa]\n0,120\n");
  assert_column(P, 1e-9, 20000);
  for (i = 0; i < sizeof units / sizeof *units; i++) {
    char text[64];
    snprintf(text, sizeof text, "t [s],p [%s]\n0,1.2\n", units[i]);
    read_log(text);
    assert_column(P, 1e-9, 20000);
  }
}

CASE(test_lab_log_read__raw_counts__take_a_unit_of_their_own)
{
  format.delimiter = ';';
  set_columns("t [s]", "p_abs [hPa]", "u [1/4096]");
  read_log("0;1029.27;0\n0.01;1029.4;2048\n");
  assert_column(U, 0, 0, 0.5);
  assert_column(P, 1e-9, 2927, 2940);
}

CASE(test_lab_log_read__scale_and_offset__act_on_si)
{
  format.scale[LAB_CHANNEL_X] = -1;
  format.offset[LAB_CHANNEL_X] = 0.070;
  format.scale[LAB_CHANNEL_P] = 2;
  read_log("t [s],x [mm],p_abs [kPa]\n0,65,110\n");
  assert_column(X, 1e-15, 0.005);
  assert_column(P, 1e-9, 20000);
}

CASE(test_lab_log_read__constants__fill_a_channel)
{
  format.constant[LAB_CHANNEL_U] = -1;
  read_log("t [s],p [kPa]\n0,1\n1,2\n");
  assert_column(U, 0, -1, -1);
}

CASE(test_lab_log_read__time_step__makes_time)
{
  format.time_step = 0.5;
  read_log("p [kPa],x [mm]\n0,1\n1,2\n2,3\n");
  assert_column(TIME, 0, 0, 0.5, 1);
}

CASE(test_lab_log_read__time_step__goes_on_over_rows_that_are_not_taken)
{
  format.time_step = 0.5;
  format.damaged = LAB_DAMAGED_DROP;
  format.from = 0.5;
  read_log("p [kPa],x [mm]\n0,1\n1,2\nbad,2\n3,3\n");
  assert_column(TIME, 0, 0.5, 1.5);
}

CASE(test_lab_log_read__falling_time__starts_a_run)
{
  format.new_run = LAB_RUN_T_DROPS;
  read_log("t [ms],p [bar]\n13,0\n20,1\n1,0\n21,1\n30,2\n0,0\n");
  assert_runs(0, 2, 5, 6);
}

CASE(test_lab_log_read__many_runs__are_all_listed)
{
  char text[20000] = "t [s],p [bar]\n";
  size_t i;
  for (i = 0; i < 700; i++)
    strcat(text, "0,1\n1,2\n");
  format.new_run = LAB_RUN_T_DROPS;
  read_log(text);
  assert_int_equal(rows.n_runs, 700);
  for (i = 0; i <= 700; i++)
    assert_int_equal(rows.run[i], 2 * i);
}

CASE(test_lab_log_read__window__keeps_rows_inside_and_counts_the_others)
{
  format.from = 1;
  format.to = 2;
  read_log("t [s],p [bar]\n0,0\n1,1\n2,2\n3,3\n");
  assert_int_equal(rows.outside, 2);
  assert_column(TIME, 0, 1, 2);
}

CASE(test_lab_log_read__damaged_rows_to_drop__are_counted)
{
  format.damaged = LAB_DAMAGED_DROP;
  format.new_run = LAB_RUN_T_DROPS;
  read_log("t [ms],p [bar]\n0,1\n127136, 904, 306\n5,0.5\n7,x\n5,1\n9\n8,0.25\n0,1\n");
  assert_int_equal(rows.dropped, 4);
  assert_lines(2, 4, 8, 9);
  assert_runs(0, 3, 4);
}

static void set_long_format(void)
{
  set_columns("quantity", "t [s]", "value");
  format.skip_lines = 1;
  format.n_quantities = 3;
  strcpy(format.quantity[0].word, "p_bar_abs");
  strcpy(format.quantity[0].column, "p_abs [bar]");
  strcpy(format.quantity[1].word, "T_K");
  strcpy(format.quantity[1].column, "T [K]");
  strcpy(format.quantity[2].word, "wall");
  strcpy(format.quantity[2].column, "-");
}

CASE(test_lab_log_read__long_format__joins_rows_of_one_time)
{
  set_long_format();
  format.constant[LAB_CHANNEL_U] = -1;
  read_log("quantity,t_s,value\np_bar_abs,0,8\np_bar_abs,2,7\nT_K,1,290\nT_K,2,280\nwall,2,300\nT_K,0,298\n");
  assert_column(TIME, 0, 0, 1, 2);
  assert_column(P, 1e-9, 700000, NAN, 600000);
  assert_column(T, 0, 298, 290, 280);
  assert_column(U, 0, -1, -1, -1);
  assert_lines(2, 4, 3);
}

CASE(test_lab_log_read__long_format_with_command__holds_it)
{
  set_long_format();
  strcpy(format.quantity[1].word, "valve");
  strcpy(format.quantity[1].column, "u [1]");
  read_log("quantity,t_s,value\nvalve,0,1\nvalve,2,-1\np_bar_abs,1,2\np_bar_abs,3,2\n");
  assert_column(U, 0, 1, 1, -1, -1);
}

CASE(test_lab_log_read__position_in_percent__is_of_the_stroke)
{
  format.stroke = 0.02;
  read_log("t [s],x [%]\n0,50\n1,100\n");
  assert_column(X, 1e-17, 0.01, 0.02);
}

CASE(test_lab_log_read__set_position__is_a_share_of_the_stroke)
{
  static const char *const units[] = {"%", "mm", "1", "cm"};
  static const double half[] = {50, 10, 0.5, 1};
  int i;
  format.stroke = 0.02;
  for (i = 0; i < 4; i++) {
    char text[80];
    snprintf(text, sizeof text, "t [s],sp [%s],x [mm]\n0,0,0\n1,%g,1\n", units[i], half[i]);
    read_log(text);
    assert_column(SP, 1e-15, 0, 0.5);
    assert_int_equal(lab_log_command(&rows), LAB_CHANNEL_SP);
    assert_int_equal(lab_log_command_changes(&rows, 0, 1), 1);
  }
  assert_refused("t [s],sp [bar]\n0,1\n", "sp [bar]", "bar");
  assert_refused("t [s],sp [1],x [mm]\n0,0.1,1\n1,,1\n", ":3", "sp: expected a number, found a gap");
  assert_refused("t [s],sp [1],x [mm]\n0,50,1\n", ":2", "is its unit %");
  format.stroke = 0;
  assert_refused("t [s],sp [mm]\n0,1\n", "sp [mm]", "mm");
}

CASE(test_lab_log_read__set_position_as_a_current__is_4_to_20_mA)
{
  read_log("t [s],sp [mA],x [mm]\n0,4,0\n1,8,0\n2,20,1\n");
  assert_column(SP, 1e-12, 0, 0.25, 1);
}

CASE(test_lab_log_read__set_position_beside_a_command__is_only_shown)
{
  read_log("t [s],sp [%],u [1],x [mm]\n0,10,0,0\n1,,1,0\n2,20,1,0\n");
  assert_int_equal(lab_log_command(&rows), LAB_CHANNEL_U);
  assert_column(SP, 1e-15, 0.1, NAN, 0.2);
  assert_int_equal(lab_log_command_changes(&rows, 1, 2), 0);
  read_log("t [s],x [mm]\n0,1\n1,2\n");
  assert_int_equal(lab_log_command(&rows), -1);
}

CASE(test_lab_log_read__command_that_overshoots__is_fully_open)
{
  read_log("t [s],u [%],p [Pa]\n0,0,0\n1,101.6,1\n2,-104,2\n3,99,3\n");
  assert_column(U, 1e-15, 0, 1, -1, 0.99);
}

CASE(test_lab_log_read__command_as_pressure__is_not_bounded_by_one)
{
  format.command_is_pressure = 1;
  read_log("t [s],u [kPa]\n0,80\n");
  assert_column(U, 1e-9, 80000);
}

/* ---- Rows put into shape ---- */

CASE(test_lab_log_read__weights__add_columns_up)
{
  static const double weight[] = {1, 0.5, -0.5, 0.5, -0.5};
  static const char *const column[] = {"t [s]", "p [hPa]", "p [hPa]", "p [hPa]", "p [hPa]"};
  for (format.n_columns = 0; format.n_columns < 5; format.n_columns++)
    strcpy(format.column[format.n_columns], column[format.n_columns]);
  format.weighted = 5;
  memcpy(format.weight, weight, sizeof weight);
  format.offset[LAB_CHANNEL_P] = 7;
  read_log("0,1012,1010,1007,1006\n1,1050,1010,1026,1006\n2,1050,,1026,1006\n");
  assert_column(TIME, 1e-15, 0, 1, 2);
  assert_column(P, 1e-9, 150 + 7, 3000 + 7, NAN);
}

CASE(test_lab_log_read__way_back__is_reversed)
{
  set_columns("-", "p [kPa]", "x [mm]");
  format.time_step = 10;
  format.way_back = LAB_CHANNEL_P;
  read_log("up,0,0\nup,5,0\nup,10,1\ndown,0,0\ndown,4,2\ndown,10,3\n");
  assert_column(P, 1e-9, 0, 5000, 10000, 10000, 4000, 0);
  assert_column(X, 1e-12, 0, 0, 1e-3, 3e-3, 2e-3, 0);
  assert_column(TIME, 0, 0, 10, 20, 30, 40, 50);
  assert_lines(1, 2, 3, 6, 5, 4);
}

CASE(test_lab_log_read__way_back_that_is_missing__is_refused)
{
  set_columns("p [kPa]", NULL, NULL);
  format.time_step = 10;
  format.way_back = LAB_CHANNEL_P;
  assert_refused("0\n5\n10\n", "log.csv:1", "fall once");
  format.way_back = LAB_CHANNEL_X;
  assert_refused("0\n5\n3\n", "log.csv", "a column x");
}

CASE(test_lab_log_read__every__keeps_the_first_of_so_many_rows_of_each_run)
{
  set_columns("t [s]", "p [bar]", NULL);
  format.new_run = LAB_RUN_T_DROPS;
  format.every = 2;
  read_log("0,1\n1,2\n2,3\n0,4\n1,5\n2,6\n3,7\n");
  assert_runs(0, 2, 4);
  assert_column(TIME, 0, 0, 2, 0, 2);
  assert_column(P, 1e-6, 1e5, 3e5, 4e5, 6e5);
  assert_lines(1, 3, 4, 6);
}

CASE(test_lab_log_read__held_out__takes_other_rows_and_another_window)
{
  static const char text[] = "0,1\n1,2\n2,3\n3,4\n4,5\n5,6\n";
  set_columns("t [s]", "p [bar]", NULL);
  format.every = 2;
  format.to = 3;
  format.holdout_from = 2;
  format.holdout_to = 5;
  format.holdout_first = 1;
  read_log(text);
  assert_column(TIME, 0, 0, 2);
  lab_log_format_hold_out(&format);
  read_log(text);
  assert_column(TIME, 0, 3, 5);
  assert_column(P, 1e-6, 4e5, 6e5);
  format.first = 4;
  assert_refused(text, "log.csv:3", "before log.first");
}

CASE(test_lab_log_read__name_of_the_file__tells_a_channel)
{
  set_columns("t [s]", "p [bar]", NULL);
  strcpy(format.name[LAB_CHANNEL_X], "_l [dm]");
  strcpy(format.name[LAB_CHANNEL_PS], "_p [bar]");
  succeed(lab_log_read(scratch_text("tube_l3_p4.5_start.csv", "0,1\n1,2\n"), &format, ambient, &rows, &error));
  assert_column(X, 1e-15, 0.3, 0.3);
  assert_column(PS, 1e-9, 4.5e5, 4.5e5);
  assert_refused("0,1\n1,2\n", "log.csv", "\"_l\" and a number in the file's name");
}

CASE(test_lab_log_read__mean_of_runs__joins_equal_times)
{
  set_columns("t [ms]", "p [bar]", "p2 [bar]");
  format.new_run = LAB_RUN_T_DROPS;
  format.runs = LAB_RUNS_MEAN;
  read_log("5,1,0\n20,2,1\n5,3,nan\n18,7,5\n4,9,9\n");
  assert_runs(0, 4);
  assert_column(TIME, 1e-12, 4e-3, 5e-3, 18e-3, 20e-3);
  assert_column(P, 1e-6, 9e5, 2e5, 7e5, 2e5);
  assert_column(P2, 1e-6, 9e5, 0, 5e5, 1e5);
  assert_int_equal(rows.line[0], 5);
}

static void set_lead(void)
{
  int k, c;
  for (k = 0; k < 2; k++)
    for (c = 0; c < LAB_CHANNEL_COUNT; c++)
      format.lead[k][c] = NAN;
  format.n_lead = 2;
  format.lead[0][LAB_CHANNEL_TIME] = -1e-3;
  format.lead[0][LAB_CHANNEL_U] = 0;
  format.lead[0][LAB_CHANNEL_P] = 5;
  format.lead[1][LAB_CHANNEL_TIME] = 0;
  format.lead[1][LAB_CHANNEL_U] = 1;
}

CASE(test_lab_log_read__lead__comes_before_each_run)
{
  set_columns("t [ms]", "p [bar]", NULL);
  format.new_run = LAB_RUN_T_DROPS;
  set_lead();
  read_log("5,1\n20,2\n5,3\n");
  assert_runs(0, 4, 7);
  assert_column(TIME, 0, -1e-3, 0, 5e-3, 20e-3, -1e-3, 0, 5e-3);
  assert_column(P, 1e-6, 5, NAN, 1e5, 2e5, 5, NAN, 3e5);
  assert_column(U, 0, 0, 1, 1, 1, 0, 1, 1);
  assert_int_equal(rows.line[4], 3);
}

CASE(test_lab_log_read__lead_of_ends__takes_first_and_last_values)
{
  set_columns("t [ms]", "p [bar]", NULL);
  format.new_run = LAB_RUN_T_DROPS;
  set_lead();
  format.lead[0][LAB_CHANNEL_P] = NAN;
  format.lead_first[0][LAB_CHANNEL_P] = LAB_CHANNEL_P + 1;
  format.lead_last[0][LAB_CHANNEL_PS] = LAB_CHANNEL_P + 1;
  read_log("5,nan\n20,2\n21,4\n5,3\n6,5\n");
  assert_column(P, 1e-6, 2e5, NAN, NAN, 2e5, 4e5, 3e5, NAN, 3e5, 5e5);
  assert_column(PS, 1e-6, 4e5, NAN, NAN, NAN, NAN, 5e5, NAN, NAN, NAN);
}

/* A command that the lead does not give is that of the first row, which it is in effect before. */
CASE(test_lab_log_read__lead_without_command__has_that_of_the_first_row)
{
  set_columns("t [s]", "u [1]", "p [Pa]");
  set_lead();
  format.lead[0][LAB_CHANNEL_U] = NAN;
  read_log("1,0.25,5\n2,0.75,6\n");
  assert_column(U, 0, 0.25, 1, 0.25, 0.75);
}

/* A lead may name a channel that has only gaps in the run. */
CASE(test_lab_log_read__lead_of_gaps__is_a_gap)
{
  set_columns("t [s]", "p [Pa]", "x [m]");
  set_lead();
  format.lead[0][LAB_CHANNEL_P] = NAN;
  format.lead_first[0][LAB_CHANNEL_P] = LAB_CHANNEL_X + 1;
  read_log("1,5,\n2,6,\n");
  assert_column(P, 0, NAN, NAN, 5, 6);
}

CASE(test_lab_log_read__columns_of_the_rig_that_are_none__are_refused)
{
  set_columns("t [s]", "pressure [Pa]", NULL);
  assert_refused("0,1\n", "log.columns", "unknown channel \"pressure\"");
  set_columns("quantity", "t [s]", "value");
  format.n_quantities = 1;
  strcpy(format.quantity[0].word, "a");
  strcpy(format.quantity[0].column, "p");
  assert_refused("a,0,1\n", "log.quantities", "has no unit");
}

CASE(test_lab_log_read__long_log_with_rows_of_one_instant__keeps_its_lines)
{
  set_columns("quantity", "t [s]", "value");
  format.n_quantities = 2;
  strcpy(format.quantity[0].word, "a");
  strcpy(format.quantity[0].column, "p [Pa]");
  strcpy(format.quantity[1].word, "b");
  strcpy(format.quantity[1].column, "x [m]");
  read_log("a,0,1\nb,0,2\na,1,3\n");
  assert_lines(1, 3);
}

CASE(test_lab_log_read__lead_after_the_first_row__is_refused)
{
  set_columns("t [ms]", "p [bar]", NULL);
  set_lead();
  assert_refused("0,1\n20,2\n", "log.csv:1", "begins after its lead");
}

/* ---- Bad files ---- */

CASE(test_lab_log_read__missing_file__says_so)
{
  assert_fails(lab_log_read(scratch_path("none.csv"), &format, ambient, &rows, &error), LAB_DATA,
               "none.csv: there is no such file");
}

CASE(test_lab_log_read__folder__says_so)
{
  assert_fails(lab_log_read(scratch_folder, &format, ambient, &rows, &error), LAB_DATA, "this is a folder");
}

CASE(test_lab_log_read__file_that_fails_to_read__is_the_worlds_fault)
{
  if (access("/proc/self/mem", R_OK) != 0)
    skip();
  assert_fails(lab_log_read("/proc/self/mem", &format, ambient, &rows, &error), LAB_WORLD, "cannot be read");
}

CASE(test_lab_log_read__forbidden_file__is_the_worlds_fault)
{
  const char *path = scratch_text("secret.csv", "t [s]\n0\n");
  if (geteuid() == 0)
    skip();
  assert_int_equal(chmod(path, 0), 0);
  assert_int_equal(lab_log_read(path, &format, ambient, &rows, &error), LAB_WORLD);
}

CASE(test_lab_log_read__bad_file__says_what_is_wrong)
{
  static const struct {
    const char *text, *place, *words;
  } bad[] = {
      {"", "log.csv", "empty"},
      {"# a\n# b\n", "log.csv", "expected a header"},
      {"0,1,2\n1,1,2\n", "log.csv:1:", "log.columns"},
      {"t [s],forse [N]\n0,0\n", "log.csv:1: column 2",
       "unknown channel \"forse\"; the nearest known one is \"force\""},
      {"time,u [1]\n0,0\n", "log.csv:1: column 1", "map = { t = \"time [date]\"; }"},
      {"t [s],p\n0,0\n", "log.csv:1: column 2", "\"p\" has no unit: write \"p [Pa]\""},
      {"t [s],p [mm]\n0,0\n", "log.csv:1: column 2", "expected a unit like Pa"},
      {"t [s],u [kPa]\n0,0\n", "log.csv:1: column 2", "expected a unit like 1"},
      {"t [s],sp [V]\n0,0\n", "log.csv:1: column 2", "range = { sp = [\"0 %\", \"100 %\"]"},
      {"t [s],x [mA]\n0,0\n", "log.csv:1: column 2", "scale = { x = \"4..20 mA\"; }; range = { x = [\"0 mm\""},
      {"t [s],p [kPaq]\n0,0\n", "log.csv:1: column 2", "kPaq"},
      {"t [s,p [kPa]\n0,0\n", "log.csv:1: column 1", "name [unit]"},
      {"t [s] x,p [kPa]\n0,0\n", "log.csv:1: column 1", "name [unit]"},
      {"t [s],\n0,0\n", "log.csv:1: column 2", "name [unit]"},
      {"t [s],p [kPa],p_abs [bar]\n0,0,1\n", "log.csv:1:", "channel p once, found 2"},
      {"u [1],p [kPa]\n0,0\n", "log.csv:1:", "expected a column t"},
      {"t [s],value\n0,1\n", "log.csv:1:", "log.quantities"},
      {"t [s],u [1]\n", "log.csv", "found none"},
      {"t [s],u [1],p [kPa]\n0,0,1\n1,0\n", "log.csv:3:", "expected 3 fields, found 2"},
      {"t [s],u [1],p [kPa]\n0,0,1,9\n", "log.csv:2:", "expected 3 fields, found 4"},
      {"t [s],u [1],p [kPa]\n0,0,1,\n", "log.csv:2:", "expected 3 fields, found 4"},
      {"t [s],u [1]\n0,0\n\n1,0\n", "log.csv:3:", "found"},
      {"t [s],u [1],p [kPa]\n0,0,1\n1,0,high\n", "log.csv:3: column 3 \"p [kPa]\"",
       "expected a number, found \"high\""},
      {"t [s],p [kPa]\n0,inf\n", "log.csv:2: column 2", "found \"inf\""},
      {"t [s],u [1]\n0,0\n1,0\n0.5,0\n", "log.csv:4:", "log.new_run"},
      {"t [s],u [1]\n0,0\n,0\n", "log.csv:3:", "channel t: expected a number, found a gap"},
      {"t [s],u [1]\n0,0\n1,nan\n", "log.csv:3:", "channel u: expected a number, found a gap"},
      {"t [s],u [1]\n0,0\n1,100\n", "log.csv:3:", "expected -1..1, found 100"},
  };
  size_t i;
  for (i = 0; i < sizeof bad / sizeof *bad; i++)
    assert_refused(bad[i].text, bad[i].place, bad[i].words);
}

CASE(test_lab_log_read__zero_bytes__are_not_text)
{
  const char bytes[] = "t [s],u [1]\n0,0\n1\0,0\n";
  assert_fails(lab_log_read(scratch_bytes("log.csv", bytes, sizeof bytes - 1), &format, ambient, &rows, &error),
               LAB_DATA, "log.csv:3:");
  assert_contains(error.text, "0 byte");
}

CASE(test_lab_log_read__garbage_without_zeros__is_shown_printable)
{
  assert_refused("\x89PNG\r\x1a\x01\x02\n\x07\n", "log.csv:1: column 1", "?PNG");
  assert_null(strpbrk(error.text, "\x1a\x01\x02\x07\r\n"));
}

CASE(test_lab_log_read__endless_line__is_refused)
{
  char *text = malloc(LAB_CSV_LINE + 100);
  memset(text, '1', LAB_CSV_LINE + 99);
  memcpy(text, "t [s]\n", 6);
  text[LAB_CSV_LINE + 99] = '\0';
  assert_refused(text, "log.csv:2:", "at most 65536 bytes");
  free(text);
}

/* ---- Bad headers and rows ---- */

CASE(test_lab_log_read__time_and_time_step__is_refused)
{
  format.time_step = 1;
  assert_refused("t [s],p [kPa]\n0,0\n", "log.csv:1:", "found both");
}

CASE(test_lab_log_read__column_and_constant__is_refused)
{
  format.constant[LAB_CHANNEL_U] = 1;
  assert_refused("t [s],u [1]\n0,0\n", "log.csv:1:", "log.constants");
}

CASE(test_lab_log_read__too_many_columns__is_refused)
{
  char text[1000] = "t [s]";
  int i;
  for (i = 0; i < LAB_COLUMN_MAX; i++)
    strcat(text, ",-");
  strcat(text, "\n");
  assert_refused(text, "log.csv:1:", "at most 64 columns");
}

CASE(test_lab_log_read__too_few_lines_to_skip__is_refused)
{
  format.skip_lines = 5;
  assert_refused("t [s]\n0\n", "log.csv", "more than the 5 lines");
}

CASE(test_lab_log_read__nothing_in_the_window__is_refused)
{
  format.from = 10;
  assert_refused("t [s],u [1]\n0,0\n1,0\n", "log.csv", "2 outside log.window");
}

CASE(test_lab_log_read__repeated_time_with_runs__is_still_refused)
{
  format.new_run = LAB_RUN_T_DROPS;
  assert_refused("t [s],u [1]\n0,0\n0,0\n", "log.csv:3:", "channel t");
}

/* A clock of 0.1 s. */
CASE(test_lab_log_read__rows_of_one_time__are_spread_over_the_step)
{
  static const double even[] = {0, 0.1, 0.15, 0.2, 0.3, 0.35};
  read_log("t [s],u [1]\n0,0\n0.1,0\n0.1,0\n0.2,0\n0.3,0\n0.3,0\n");
  check_column(LAB_CHANNEL_TIME, 1e-12, even, 6);
  assert_int_equal(rows.repeated, 2);
}

/* Ten rows a second, times to the second. */
CASE(test_lab_log_read__times_to_the_second__are_even_again)
{
  char text[8000] = "t [s],u [1]\n";
  size_t i;
  for (i = 0; i < 1000; i++)
    sprintf(text + strlen(text), "%zu,0\n", i / 10);
  read_log(text);
  for (i = 1; i < 1000; i++)
    assert_close(rows.value[LAB_CHANNEL_TIME][i] - rows.value[LAB_CHANNEL_TIME][i - 1], 0.1, 1e-4, 0);
  assert_int_equal(rows.repeated, 0);
}

/* The rows before a pause are not spread over it, nor the last ones. */
CASE(test_lab_log_read__rows_of_one_time_before_a_pause__keep_the_step)
{
  static const double parted[] = {0, 1, 2, 3, 3.5, 60, 61, 61.5};
  read_log("t [s],u [1]\n0,0\n1,0\n2,0\n3,0\n3,0\n60,0\n61,0\n61,0\n");
  check_column(LAB_CHANNEL_TIME, 1e-12, parted, 8);
}

/* Rows every 7 ms, of a clock of 10 ms. */
CASE(test_lab_log_read__even_rows_of_a_coarse_clock__are_even_again)
{
  char text[2000] = "t [s],u [1]\n";
  size_t i;
  for (i = 0; i < 100; i++)
    sprintf(text + strlen(text), "%.2f,0\n", 0.01 * floor(0.7 * (double)i + 0.5));
  read_log(text);
  for (i = 1; i < 100; i++)
    assert_close(rows.value[LAB_CHANNEL_TIME][i] - rows.value[LAB_CHANNEL_TIME][i - 1], 0.007, 1e-5, 0);
  assert_int_equal(rows.repeated, 0);
  assert_close(rows.clock_step, 0.01, 1e-12, 0);
}

CASE(test_lab_log_read__clock_that_stands_for_longer_than_a_step__is_refused)
{
  assert_refused("t [s],u [1]\n0,0\n1,0\n1,0\n1,0\n1,0\n1,0\n2,0\n3,0\n4,0\n",
                 "log.csv:4:", "channel t: expected more than");
}

CASE(test_lab_log_read__repeated_time_where_damaged_rows_go__is_left_out)
{
  format.damaged = LAB_DAMAGED_DROP;
  read_log("t [s],u [1]\n0,0\n1,0\n1,0\n2,0\n");
  assert_int_equal(rows.n, 3);
  assert_int_equal(rows.dropped, 1);
  assert_int_equal(rows.repeated, 0);
}

CASE(test_lab_log_read__long_format_faults__are_refused)
{
  set_long_format();
  assert_refused("h\nT_C,0,8\n", "log.csv:2:", "unknown quantity \"T_C\"");
  assert_refused("h\nT_K,0,290\nT_K,0,291\n", "log.csv:3:", "expected one value of T at t = 0 s");
  strcpy(format.quantity[1].column, "u [1]");
  assert_refused("h\np_bar_abs,0,8\nT_K,1,1\n", "log.csv:2:", "command u at the first instant");
}

/* Files as loggers write them (tests/loggers/README.md): each is read at once, or its message says what to write into
 * the rig file, which is done here to the letter. All hold the same eight rows. */
#include "../../rigfile.h"

#include "../../../apps/lab/log/log.h"

enum { ROWS = 8, ROUNDS = 4 };

static const double truth_u[ROWS] = {0, 0, 1, 1, 1, 1, 0, 0};
static const double truth_p[ROWS] = {0.20e5, 0.21e5, 0.55e5, 0.95e5, 1.20e5, 1.21e5, 0.90e5, 0.50e5}; /* [Pa] */
static const double truth_x[ROWS] = {0, 0, 1.5e-3, 6e-3, 10e-3, 10e-3, 7.5e-3, 2.5e-3};               /* [m] */

static const struct logger {
  const char *file;
  int command;        /* LAB_CHANNEL_U, or LAB_CHANNEL_SP at half of u */
  int rounds;         /* messages that are followed; 0: it is read at once */
  const char *advice; /* what the first of them, or what was guessed, says among other things */
} loggers[] = {
    {"excel-de.csv", LAB_CHANNEL_SP, 0, "left out: \"Prüfer\""},
    {"excel-de-sep.csv", LAB_CHANNEL_SP, 0, "semicolons between cells, decimal commas, header in line 2"},
    {"excel-unicode.txt", LAB_CHANNEL_SP, 0, "x is \"Öffnung, Hub [mm]\""},
    {"excel-en.csv", LAB_CHANNEL_SP, 0, "t is \"Time\" (time of day)"},
    {"excel-fr.csv", LAB_CHANNEL_SP, 0, "x is \"Course (mm)\""},
    {"valvelink.csv", LAB_CHANNEL_SP, 0, "left out: \"Drive Signal (%)\""},
    {"trovis.csv", LAB_CHANNEL_SP, 0, "x is \"Ventilstellung x [%]\""},
    {"ignition.csv", LAB_CHANNEL_SP, 0, "t is \"t_stamp\" (ymd)"},
    {"grafana.csv", LAB_CHANNEL_SP, 0, "x is \"valve.position_mm\""},
    {"matlab-writetable.csv", LAB_CHANNEL_SP, 0, "sp is \"Setpoint_pct\""},
    {"matlab-timetable.csv", LAB_CHANNEL_SP, 1, "sp = \"Setpoint [%]\"; p = \"Pressure [bar]\"; x = \"Travel [mm]\";"},
    {"matlab-ascii.txt", LAB_CHANNEL_U, 1, "log = { columns = ( \"t [s]\", \"u [1]\", \"p [bar]\", \"x [mm]\" ); };"},
    {"numpy-savetxt.csv", LAB_CHANNEL_U, 0, "t is \"time (s)\""},
    {"pandas.csv", LAB_CHANNEL_SP, 0, "t is \"timestamp\" (ymd)"},
    {"keysight.csv", LAB_CHANNEL_U, 1, "u = \"1 [1]\"; p = \"2 [bar]\"; x = \"3 [mm]\";"},
    {"tektronix.csv", LAB_CHANNEL_U, 1, "t = \"TIME [s]\"; u = \"CH1 [1]\"; p = \"CH2 [bar]\"; x = \"CH3 [mm]\";"},
    {"picoscope.csv", LAB_CHANNEL_U, 1, "u = \"Channel A [1]\"; p = \"Channel B\"; x = \"Channel C\";"},
    {"labview.lvm", LAB_CHANNEL_U, 1, "t = \"X_Value [s]\"; u = \"Command [1]\"; p = \"Pressure [bar]\";"},
    {"catman.asc", LAB_CHANNEL_SP, 0, "header in line 3, units in line 4"},
    {"testo.csv", LAB_CHANNEL_SP, 0, "t is \"Datum\" (dmy), t is \"Uhrzeit\" (time of day)"},
    {"arduino.txt", LAB_CHANNEL_U, 1, "u = \"u [1]\";"},
    {"wincc.csv", LAB_CHANNEL_SP, 1, "quantities = ( (\"SP\", \"sp [%]\"), (\"P_bar\", \"p [bar]\"),"},
    {"ge-historian.csv", LAB_CHANNEL_SP, 1, "(\"FV1001.Travel_mm\", \"x [mm]\") ); };"},
    {"lecroy.csv", LAB_CHANNEL_U, 1, "t = \"Time [s]\"; u = \"Ampl [1]\"; p = \"Ampl1 [bar]\"; x = \"Ampl2 [mm]\";"},
    {"two-pressures.csv", LAB_CHANNEL_SP, 1, "may both be p (pressure): say which is"},
    {"footer.csv", LAB_CHANNEL_SP, 1, "log = { damaged = \"drop\"; };"},
    {"thousands-de.csv", LAB_CHANNEL_SP, 1, "log = { thousands = \".\"; };"},
};

/* Read a log as a rig file with this group log declares.  Out: log, where it is read  Returns: its status */
static int read_as(const char *group, const char *path, lab_log *log)
{
  char text[2048];
  lab_rig rig;
  snprintf(text, sizeof text, "actuator = { stroke = \"20 mm\"; };\npositioner = { gain = 20; };\n%s\n", group);
  rig = read_rig(text);
  return lab_log_read(path, &rig.log, (double)rig.params.ambient_pressure, log, &error);
}

/* The group that a message says to write. */
static void take_advice(const char *message, char group[1024])
{
  const char *begin = strstr(message, "log = {"), *end = begin ? strstr(begin, "}; };") : NULL;
  if (begin && !end)
    end = strstr(begin, "; };") - 1;
  if (!begin || !end)
    fail_msg("no advice in \"%s\"", message);
  snprintf(group, 1024, "%.*s", (int)(end + strlen("}; };") - begin), begin);
}

static void check_rows(const lab_log *log, int command)
{
  int i;
  assert_int_equal(log->n, ROWS);
  for (i = 0; i < ROWS; i++) {
    const double *t = log->value[LAB_CHANNEL_TIME];
    assert_close(t[i] - t[0], 0.1 * i, 1e-9, 0);
    assert_close(log->value[command][i], (command == LAB_CHANNEL_U ? 1 : 0.5) * truth_u[i], 1e-9, 0);
    assert_close(log->value[LAB_CHANNEL_P][i], truth_p[i], 5, 0);
    assert_close(log->value[LAB_CHANNEL_X][i], truth_x[i], 1e-9, 0);
  }
}

static void read_logger(const struct logger *l)
{
  char path[512], group[1024];
  lab_log log;
  int round, status;
  snprintf(path, sizeof path, "tests/loggers/%s", l->file);
  strcpy(group, "log = { };");
  status = read_as(group, path, &log);
  assert_contains(status == LAB_OK ? log.read_as : error.text, l->advice);
  for (round = 0; status != LAB_OK && round < ROUNDS; round++) {
    take_advice(error.text, group);
    status = read_as(group, path, &log);
  }
  succeed(status);
  assert_int_equal(round, l->rounds);
  check_rows(&log, l->command);
  lab_log_free(&log);
}

TEST(test_lab_log_read__as_loggers_write__is_read_or_answered)
{
  size_t i;
  for (i = 0; i < sizeof loggers / sizeof loggers[0]; i++) {
    check_note("%s", loggers[i].file);
    read_logger(&loggers[i]);
  }
}

/* ---- What the rig file says goes before what is guessed ---- */

static lab_log seen; /* the last that was read well */

static int close_all(void **state)
{
  lab_log_free(&seen);
  return scratch_close(state);
}

TESTS_WITH(scratch_open, close_all)

static void assert_refused(const char *group, const char *path, const char *words)
{
  lab_log none;
  assert_fails(read_as(group, path, &none), LAB_DATA, words);
}

/* A log that must be good, until the next one. */
static void read_well(const char *group, const char *path)
{
  lab_log_free(&seen);
  succeed(read_as(group, path, &seen));
}

TEST(test_lab_log_read__map__names_a_column_and_its_unit)
{
  const char *path =
      scratch_text("m.csv", "Time (s);AI 1;AI 2 (V);Setpoint (%);Pressure (bar)\n0,0;1;2;3;4\n0,1;1;2;3;4\n");
  read_well("log = { map = { x = \"AI 1 [mm]\"; p = \"AI 2 (V) [0.6 bar]\"; }; };", path);
  assert_close(seen.value[LAB_CHANNEL_X][1], 1e-3, 1e-15, 0);
  assert_close(seen.value[LAB_CHANNEL_P][1], 1.2e5, 1e-9, 0);
  assert_close(seen.value[LAB_CHANNEL_SP][1], 0.03, 1e-15, 0);
  assert_contains(seen.read_as, "left out: \"Pressure (bar)\"");
  read_well("log = { map = { p = \"Pressure (bar)\"; x = \"AI 1 [mm]\"; }; };", path);
  assert_close(seen.value[LAB_CHANNEL_P][1], 4e5, 1e-9, 0);
}

TEST(test_lab_log_read__map_of_no_column__names_the_nearest)
{
  const char *path = scratch_text("m.csv", "Time (s),Setpoint (%),Presure (bar)\n0,0,1\n1,0,1\n");
  assert_refused("log = { map = { p = \"Pressure (bar)\"; }; };", path, "the nearest is \"Presure (bar)\"");
}

TEST(test_lab_log_read__map__is_a_group_of_channels_and_not_beside_columns)
{
  assert_rig_refused("log = { map = { q = \"a\"; }; };", "log.map.q", "unknown key");
  assert_rig_refused("log = { columns = ( \"t [s]\" ); map = { p = \"a\"; }; };", "log", "give one");
}

/* Written and read again, a group is the same. */
static void assert_same_again(const char *group)
{
  const lab_rig rig = read_rig(group), again = write_and_read(&rig, NULL);
  assert_memory_equal(&rig.log, &again.log, sizeof rig.log);
}

/* What is guessed of hard files. */
TEST(test_lab_log_read__hard_files__are_guessed_or_told)
{
  read_well("", scratch_text("h.txt", "Time_s  Setpoint_%  Travel_mm\n0,0   0   1,5\n0,1  50  2,5\n"));
  assert_close(seen.value[LAB_CHANNEL_X][1], 2.5e-3, 1e-15, 0);
  assert_contains(seen.read_as, "blanks between cells, decimal commas");
  read_well("", scratch_text("h.csv", "Time (s),Travel (mm),Set Point (%)\n0,\"1,5\",2\n1,\"2,5\",3\n"));
  assert_close(seen.value[LAB_CHANNEL_X][1], 2.5e-3, 1e-15, 0);
  assert_refused("", scratch_text("h.csv", "a;b;c\n1;2;3\n4;5;6\n"), "t = \"a [s]\"; u = \"b [1]\"; p = \"c [bar]\";");
  assert_refused("", scratch_text("h.csv", "Time (s),YT (%),ZT (%),PT (psi)\n0,1,2,3\n1,2,3,4\n"),
                 "map = { u = \"YT (%)\"; p = \"PT (psi)\"; x = \"ZT (%)\"; };");
  assert_refused("", scratch_text("h.csv", "t [s],x [mm]\n\"0,0\",\"1,25\"\n"), "log = { decimal = \",\"; };");
  assert_refused("", scratch_text("h.csv", "Zeit (s);p (bar)\n"), "nor are there rows of numbers");
  assert_refused("", scratch_text("h.csv", "Time,Pressure\n2024-03-01 12:00:00,1 bar\n2024-03-01 12:00:01,2 bar\n"),
                 "p = \"Pressure [bar]\";");
}

/* A signal or counts stand for a range; a column without a unit is taken to be in the signal's. */
TEST(test_lab_log_read__signals_and_counts__become_what_they_stand_for)
{
  static const char *const group =
      "log = { map = { p = \"AI 1\"; }; scale = { p = \"4..20 mA\"; x = \"0..27648\"; sp = \"2..10 V\"; };\n"
      "range = { p = [\"0 bar\", \"6 bar\"]; x = [\"20 mm\", \"0 mm\"]; sp = [\"0 %\", \"100 %\"]; }; };";
  const char *path =
      scratch_text("s.csv", "Time (s),AI 1,Position,Setpoint (mV)\n0,4,0,2000\n1,12,6912,6000\n2,20,27648,10000\n");
  static const double p[] = {0, 3e5, 6e5}, x[] = {0.02, 0.015, 0}, sp[] = {0, 0.5, 1};
  int i;
  read_well(group, path);
  for (i = 0; i < 3; i++) {
    assert_close(seen.value[LAB_CHANNEL_P][i], p[i], 1e-6, 1e-12);
    assert_close(seen.value[LAB_CHANNEL_X][i], x[i], 1e-12, 1e-12);
    assert_close(seen.value[LAB_CHANNEL_SP][i], sp[i], 1e-12, 1e-12);
  }
  assert_same_again(group);
}

TEST(test_lab_rig_read__signals_that_are_none__are_refused)
{
  static const struct {
    const char *group, *words;
  } bad[] = {{"scale = { p = \"4..20 mA\"; };", "go together"},
             {"range = { p = [\"0 bar\", \"6 bar\"]; };", "go together"},
             {"scale = { p = \"..20 mA\"; };", "two numbers and a unit"},
             {"scale = { p = \"4..4 mA\"; };", "two numbers and a unit"},
             {"scale = { p = \"4..20 bar\"; };", "a signal in mA, V or counts"},
             {"scale = { p = \"4..20 mA\"; }; range = { p = [\"0 bar\", \"0 bar\"]; };", "differ"},
             {"range = { p = [\"0 bar\"]; };", "2 to 2 entries"}};
  size_t i;
  for (i = 0; i < sizeof bad / sizeof bad[0]; i++) {
    char text[256];
    snprintf(text, sizeof text, "log = { %s };", bad[i].group);
    assert_rig_refused(text, "log", bad[i].words);
  }
}

/* A map and the order of dates are written into model.cfg and read back. */
TEST(test_lab_rig_write__map_and_date__are_read_again)
{
  assert_same_again("log = { map = { p = \"a \\\"b\\\" (bar)\"; x = \"c\"; }; date = \"dmy\"; delimiter = \"blanks\"; "
                    "scale = { x = -2; }; };");
  assert_same_again("log = { columns = ( \"quantity\", \"t [date]\", \"value\" ); quantities = ( (\"A.1 \\\"b\\\"\", "
                    "\"p [bar]\"), (\"x\", \"-\") ); };");
}

/* A file in long form goes by columns and quantities; dates are the unit of its time. */
TEST(test_lab_log_read__long_form_of_wincc__is_read_by_keys)
{
  read_well("log = { skip_lines = 1; columns = ( \"quantity\", \"t [date]\", \"value\", \"-\", \"-\" );\n"
            "quantities = { SP = \"sp [%]\"; P_bar = \"p [bar]\"; Hub_mm = \"x [mm]\"; }; };",
            "tests/loggers/wincc.csv");
  check_rows(&seen, LAB_CHANNEL_SP);
}

TEST(test_lab_log_read__order_of_dates__is_that_of_the_rig_file)
{
  const char *path =
      scratch_text("d.csv", "Time,Setpoint (%),Travel (mm)\n03/04/2024 23:59:59,0,1\n04/04/2024 00:00:01,0,1\n");
  read_well("log = { date = \"dmy\"; };", path);
  assert_close(seen.value[LAB_CHANNEL_TIME][1], 2, 1e-9, 0);
  read_well("", path);
  assert_close(seen.value[LAB_CHANNEL_TIME][1], 30 * 86400 + 2, 1e-9, 0);
  assert_contains(seen.read_as, "(mdy)");
  assert_refused("", scratch_text("d.csv", "Time,Setpoint (%)\n03/04/2024 12:00,0\n13/04/2024 12:00,0\n"),
                 "log = { date = \"dmy\"; };");
}

/* Words of German plants. */
TEST(test_lab_log_read__names_of_plants__are_known)
{
  read_well("",
            scratch_text("d.csv", "Zeit (s);Stellsignal (%);Kammerdruck (bar);Hub (mm)\n0;50;1,5;10\n1;50;1,6;11\n"));
  assert_close(seen.value[LAB_CHANNEL_SP][0], 0.5, 1e-12, 0);
  assert_close(seen.value[LAB_CHANNEL_X][1], 11e-3, 1e-12, 0);
}

TEST(test_lab_log_read__time_of_day__goes_on_after_midnight)
{
  read_well("", scratch_text("d.csv",
                             "Time,Setpoint (%)\n23:59:59.5,0\n00:00:00.25,0\n12:00:00,0\n23:00:00,0\n00:00:01,0\n"));
  assert_close(seen.value[LAB_CHANNEL_TIME][1], 0.75, 1e-9, 0);
  assert_close(seen.value[LAB_CHANNEL_TIME][4], 86401.5, 1e-9, 0);
}

/* ---- What is no text ---- */

TEST(test_lab_text_read__binary_files__say_what_makes_text_of_them)
{
  static const struct {
    const char *begin, *words;
  } binary[] = {{"\x1F\x8B\x08", "gunzip -k FILE"},
                {"PK\x03\x04", "soffice --headless --convert-to csv FILE"},
                {"\xD0\xCF\x11\xE0", "Excel workbook (.xls)"},
                {"MATLAB 5.0 MAT-file, Platform", "writetable"},
                {"\x89HDF\r\n", "-v7.3"},
                {"PAR1", "read_parquet"},
                {"TDSm", "TdmsFile"},
                {"MDF     4.10", "asammdf"}};
  size_t i;
  for (i = 0; i < sizeof binary / sizeof binary[0]; i++)
    assert_refused("", scratch_text("b.csv", binary[i].begin), binary[i].words);
}

TEST(test_lab_text_read__utf16_of_either_order_and_without_mark__is_read)
{
  static const char text[] = "t [s],u [1]\n0,1\n1,0\n";
  char wide[2 * sizeof text + 2];
  int kind;
  size_t i;
  for (kind = 0; kind < 4; kind++) { /* bit 0: large byte first; bit 1: no mark */
    size_t n = 0;
    if (kind < 2) {
      wide[n++] = (char)(kind & 1 ? 0xFE : 0xFF);
      wide[n++] = (char)(kind & 1 ? 0xFF : 0xFE);
    }
    for (i = 0; i + 1 < sizeof text; i++) {
      wide[n++] = (char)(kind & 1 ? 0 : text[i]);
      wide[n++] = (char)(kind & 1 ? text[i] : 0);
    }
    read_well("", scratch_bytes("w.csv", wide, n));
    assert_int_equal(seen.n, 2);
    assert_string_equal(seen.read_as, "");
  }
}

/* apps/lab/batch/batchlist, batchrow, workers, batch */
#include "../../scratch.h"

#include <errno.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "../../../apps/lab/batch/batch.h"
#include "../../../apps/lab/batch/batchindex.h"
#include "../../../apps/lab/batch/batchlist.h"
#include "../../../apps/lab/batch/jobs.h"
#include "../../../apps/lab/base/interrupt.h"
#include "../../../apps/lab/base/text.h"

/* ---- List ---- */

enum { ENTRIES = 8 };
static lab_fleet_entry entry[ENTRIES];

/* Read a list whole.  Returns: lines; -1 with `error` */
static int read_list(const char *text)
{
  lab_fleet_list list;
  int n = 0, more = 1, status = lab_fleet_list_open(&list, scratch_text("list.csv", text), &error);
  memset(entry, 0, sizeof entry);
  while (status == LAB_OK && more && n < ENTRIES) {
    status = lab_fleet_list_next(&list, &entry[n], &more, &error);
    n += status == LAB_OK && more;
  }
  lab_fleet_list_close(&list);
  return status == LAB_OK ? n : -1;
}

static void assert_entry(int i, int line, const char *name, const char *rig, const char *log, const char *holdout)
{
  assert_int_equal(entry[i].line, line);
  assert_string_equal(entry[i].name, name);
  assert_string_equal(entry[i].rig, rig);
  assert_string_equal(entry[i].log, log);
  assert_string_equal(entry[i].holdout, holdout);
}

TEST(test_lab_fleet_list__as_documented__is_read)
{
  assert_int_equal(
      read_list("# presses of hall 2\nname,rig,log,holdout\npress-1,rigs/p.cfg,may/a.csv;may/b.csv,june.csv\n"
                "\n# one more\npress-2,rigs/p.cfg,may/p2.csv,\n"),
      2);
  assert_entry(0, 3, "press-1", "rigs/p.cfg", "may/a.csv;may/b.csv", "june.csv");
  assert_entry(1, 6, "press-2", "rigs/p.cfg", "may/p2.csv", "");
}

/* As spreadsheets of other countries save it: marks, quotes, byte order mark, ends of lines, cells that are empty. */
TEST(test_lab_fleet_list__from_spreadsheets__is_the_same)
{
  static const char *const same[] = {
      "name,rig,log,holdout\none,r.cfg,a.csv;b.csv,\ntwo,r.cfg,c.csv,d.csv\n",
      "\xEF\xBB\xBFName;Rig;Log;Holdout\r\none;r.cfg;\"a.csv;b.csv\";\r\ntwo;r.cfg;c.csv;d.csv\r\n",
      "name\trig\tlog\tholdout\none\tr.cfg\ta.csv;b.csv\ntwo\tr.cfg\tc.csv\td.csv",
      "\"name\",\"rig\",\"log\",\"holdout\",,\n\"one\", \"r.cfg\" , \"a.csv;b.csv\",,,\ntwo,r.cfg,c.csv,d.csv,,\n",
  };
  static const char *const empty[] = {"", ",,,,,\n", ";;;\n", "\"# a, comment\",,,\n"};
  size_t i, k;
  for (i = 0; i < sizeof same / sizeof *same; i++) {
    check_note("list %d", (int)i);
    assert_int_equal(read_list(same[i]), 2);
    assert_entry(0, 2, "one", "r.cfg", "a.csv;b.csv", "");
    assert_entry(1, 3, "two", "r.cfg", "c.csv", "d.csv");
  }
  for (k = 0; k < sizeof empty / sizeof *empty; k++) {
    char text[200];
    snprintf(text, sizeof text, "rig,log\n%sr.cfg,a.csv\n", empty[k]);
    assert_int_equal(read_list(text), 1);
  }
}

TEST(test_lab_fleet_list__quotes_and_commas_in_a_cell__are_kept)
{
  assert_int_equal(read_list("log,rig,name\n\"a,b.csv\",r 5\".cfg,\"say \"\"hi\"\"\"\n"), 1);
  assert_entry(0, 2, "say \"hi\"", "r 5\".cfg", "a,b.csv", "");
}

TEST(test_lab_fleet_list__no_name__is_called_as_its_log)
{
  static const struct {
    const char *log, *name;
  } row[] = {{"p2.csv", "p2"}, {"may/p2.csv", "may-p2"},    {"../../may/p2.log.csv", "may-p2.log"},
             {"./p2", "p2"},   {"/data/p2.csv", "data-p2"}, {"a.csv;b.csv", "a"}};
  size_t i;
  for (i = 0; i < sizeof row / sizeof *row; i++) {
    char text[100];
    snprintf(text, sizeof text, "rig,log\nr.cfg,%s\n", row[i].log);
    assert_int_equal(read_list(text), 1);
    assert_string_equal(entry[0].name, row[i].name);
  }
}

TEST(test_lab_fleet_list__date__is_a_day_or_a_moment)
{
  assert_int_equal(
      read_list("rig,log,date\nr.cfg,a.csv,1970-01-11\nr.cfg,b.csv,1970-01-11T13:30+01:30\nr.cfg,c.csv,\n"), 3);
  assert_close(entry[0].day, 10, 0, 0);
  assert_close(entry[1].day, 10.5, 0, 0);
  assert_string_equal(entry[1].date, "1970-01-11T13:30+01:30");
  assert_string_equal(entry[2].date, "");
}

/* Such a line is an error by itself, so that the others are done. */
TEST(test_lab_fleet_list__date_of_another_form__is_wrong_with_its_line)
{
  static const char *const dates[] = {"3/14/2026", "26-01-02", "2026-13-02", "12:30"};
  size_t i;
  for (i = 0; i < sizeof dates / sizeof *dates; i++) {
    char text[100];
    snprintf(text, sizeof text, "rig,log,date\nr.cfg,a.csv,%s\nr.cfg,b.csv,2026-05-04\n", dates[i]);
    assert_int_equal(read_list(text), 2);
    assert_contains(entry[0].wrong, "line 2 of the list, column date: expected a date like 2026-05-04");
    assert_contains(entry[0].wrong, dates[i]);
    assert_string_equal(entry[1].wrong, "");
  }
}

TEST(test_lab_fleet_list__bad__is_refused_with_its_line)
{
  static const struct {
    const char *text, *line, *words;
  } row[] = {
      {"# nothing\n", "list.csv", "empty"},
      {"press-1,r.cfg,a.csv\n", "list.csv:1", "header like name,rig,log,holdout"},
      {"name,rig,logg\n", "list.csv:1", "nearest known one is log"},
      {"#\nname,rig\n", "list.csv:2", "no column log"},
      {"rig,log,rig\n", "list.csv:1", "rig is there twice"},
      {"rig,log\nr.cfg,\n", "list.csv:2", "column log is empty"},
      {"rig,log\nr.cfg,a.csv\n,b.csv\n", "list.csv:3", "column rig is empty"},
      {"rig,log\nr.cfg,a.csv,b.csv\n", "list.csv:2", "cell 3, \"b.csv\", has no column"},
      {"rig,log\nr.cfg,\"a.csv\n", "list.csv:2", "quote"},
      {"name,rig,log\na/b,r.cfg,a.csv\n", "list.csv:2", "cannot be a name"},
      {"name,rig,log\n..,r.cfg,a.csv\n", "list.csv:2", "cannot be a name"},
      {"name,rig,log\nbatch.csv,r.cfg,a.csv\n", "list.csv:2", "cannot be a name"},
      {"name,rig,log\ntrends.csv,r.cfg,a.csv\n", "list.csv:2", "cannot be a name"},
      {"name,rig,log\nindex.html,r.cfg,a.csv\n", "list.csv:2", "is not index.html"},
  };
  size_t i;
  for (i = 0; i < sizeof row / sizeof *row; i++) {
    check_note("row %d", (int)i);
    assert_int_equal(read_list(row[i].text), -1);
    assert_int_equal(error.status, LAB_DATA);
    assert_contains(error.text, row[i].line);
    assert_contains(error.text, row[i].words);
  }
}

TEST(test_lab_fleet_list__long_cell__is_refused)
{
  char text[LAB_FLEET_ENTRY_TEXT + 100];
  snprintf(text, sizeof text, "rig,log\nr.cfg,%0*d\n", LAB_FLEET_ENTRY_TEXT, 0);
  assert_int_equal(read_list(text), -1);
  assert_contains(error.text, "list.csv:2");
  assert_contains(error.text, "at most");
  snprintf(text, sizeof text, "rig,log\nr.cfg,%0*d\n", LAB_FLEET_ENTRY_NAME, 0);
  assert_int_equal(read_list(text), -1);
  assert_contains(error.text, "give it a name");
}

TEST(test_lab_fleet_list__zero_byte__is_refused)
{
  static const char bytes[] = "rig,log\nr.cfg,\0.csv\n";
  lab_fleet_list list;
  assert_fails(lab_fleet_list_open(&list, scratch_bytes("list.csv", bytes, sizeof bytes - 1), &error), LAB_DATA,
               "list.csv:2");
  lab_fleet_list_close(&list);
}

static int check_list(const char *text, int *n)
{
  lab_fleet_list list;
  int status = lab_fleet_list_open(&list, scratch_text("list.csv", text), &error);
  if (status == LAB_OK)
    status = lab_fleet_list_check(&list, n, &error);
  if (status == LAB_OK) { /* back at the beginning */
    int more;
    succeed(lab_fleet_list_next(&list, &entry[0], &more, &error));
    assert_true(more);
  }
  lab_fleet_list_close(&list);
  return status;
}

TEST(test_lab_fleet_list_check__doubles_and_no_lines__are_refused)
{
  int n;
  assert_int_equal(check_list("rig,log\nr,a.csv\nr,b.csv\n", &n), LAB_OK);
  assert_int_equal(n, 2);
  assert_int_equal(check_list("rig,log\nr,a.csv\nr,b.csv\nother,a.csv\n", &n), LAB_DATA);
  assert_contains(error.text, "list.csv:4: line 2 has the same name");
  assert_int_equal(check_list("rig,log\n", &n), LAB_DATA);
  assert_contains(error.text, "no line after it");
}

TEST(test_lab_split__blanks_and_empty_parts__are_dropped)
{
  char text[] = " a.csv ;; b c.csv;", many[] = "a;b;c";
  const char *part[2];
  assert_int_equal(lab_split(text, ';', part, 2), 2);
  assert_string_equal(part[0], "a.csv");
  assert_string_equal(part[1], "b c.csv");
  assert_int_equal(lab_split(many, ';', part, 2), -1);
}

/* ---- Record ---- */

static lab_done sample(void)
{
  lab_done done;
  memset(&done, 0, sizeof done);
  done.key = UINT64_C(0x0123456789abcdef);
  done.extent = LAB_WRITE_PLAIN;
  done.outcome.status = LAB_NUMERIC;
  done.outcome.cost.seconds = 1.25;
  done.outcome.cost.cpu = 1.125;
  done.outcome.cost.memory = 42.5;
  strcpy(done.outcome.row, "error,,\"a, b\",,words");
  return done;
}

TEST(test_lab_done__written__reads_back)
{
  const lab_done want = sample();
  const char *folder = scratch_path("press-1");
  lab_done got;
  assert_false(lab_done_read(folder, &got));
  succeed(lab_done_write(folder, &want, &error));
  assert_true(lab_done_read(folder, &got));
  assert_true(got.key == want.key);
  assert_int_equal(got.extent, want.extent);
  assert_int_equal(got.outcome.status, want.outcome.status);
  assert_close(got.outcome.cost.seconds, 1.25, 0, 0);
  assert_close(got.outcome.cost.cpu, 1.125, 0, 0);
  assert_close(got.outcome.cost.memory, 42.5, 0, 0);
  assert_string_equal(got.outcome.row, want.outcome.row);
  lab_done_remove(folder);
  assert_false(lab_done_read(folder, &got));
}

/* However little of it has reached the disk. */
TEST(test_lab_done__torn__is_not_there)
{
  const lab_done want = sample();
  lab_done got;
  char *whole;
  size_t i, size;
  succeed(lab_done_write(scratch_path("torn"), &want, &error));
  whole = scratch_read(scratch_path("torn/.done"));
  size = strlen(whole);
  for (i = 0; i <= size; i++) {
    scratch_bytes("torn/.done", whole, i);
    check_note("%d of %d bytes", (int)i, (int)size);
    assert_int_equal(lab_done_read(scratch_path("torn"), &got), i == size);
  }
  free(whole);
}

TEST(test_lab_row__error__has_the_headers_cells)
{
  char header[1024] = "";
  FILE *file = fmemopen(header, sizeof header, "w");
  lab_outcome outcome;
  const char *c;
  int cells = 0;
  assert_non_null(file);
  lab_row_header(file);
  fclose(file);
  lab_fail(&error, LAB_DATA, "words");
  lab_row_error(&error, &outcome);
  for (c = header; *c; c++)
    cells += *c == ',';
  for (c = outcome.row; *c; c++)
    cells -= *c == ',';
  assert_int_equal(cells, 1); /* the name */
  assert_int_equal(outcome.status, LAB_DATA);
  assert_string_equal(outcome.row + strlen(outcome.row) - 8, ",words,,"); /* no condition */
}

/* ---- index.html ---- */

static void add_line(lab_index *index, const char *name, const char *row, int extent, int status)
{
  lab_done done = {0};
  strcpy(done.outcome.row, row);
  done.extent = extent;
  done.outcome.status = status;
  succeed(lab_index_add(index, name, &done, &error));
}

/* The worst first: by verdict, effects by how much of the error they explain, then in the order of the list. */
TEST(test_lab_index__all_verdicts__worst_first)
{
  static const char *const order[] = {">torn<",   ">odd<",  ">large<",  ">small & <b><", ">worn<",
                                      ">unsure<", ">fine<", ">fine 2<", ">quiet<"};
  lab_index index = {0};
  const char *last;
  char *page;
  size_t i;
  add_line(&index, "fine", "none,,,,1,1,,,,,,,,,,,,,,,0,fits", LAB_WRITE_JSON, LAB_OK);
  add_line(&index, "fine 2", "none,,,,3,3,,,,,,,,,,,,,,,0,fits", LAB_WRITE_JSON, LAB_OK);
  add_line(&index, "quiet", "none,,,,0.004,0.001,,,,,,,,,,,,,,,0,fits", LAB_WRITE_JSON, LAB_OK); /* below the noise */
  add_line(&index, "worn", "none,,,,3,3,,,,,,,,,,,,,,,0,worn,deviates,dry_friction x3.7", LAB_WRITE_JSON, LAB_OK);
  add_line(&index, "small & <b>", "effect,dead_time,0.02 s,,2,1,,,9,8,,,,,,,,,,,0,late", LAB_WRITE_FIGURES, LAB_OK);
  add_line(&index, "unsure", "undecided,,,,2,2,,,,,,,,,,,,,,,1,\"no, idea\"", LAB_WRITE_JSON, LAB_OK);
  add_line(&index, "large", "effect,chamber_leak + dead_time,1e-08 m2 + 0.5 s,,20,1,,,9,8,,,,,,,,,,,0,leaks",
           LAB_WRITE_JSON, LAB_OK);
  add_line(&index, "odd", "unlisted,unlisted force over x,x = 1 .. 2 mm,,2,1,,,,,,,,,,,,,,,0,odd", LAB_WRITE_JSON,
           LAB_OK);
  add_line(&index, "torn", "error,,,,,,,,,,,,,,,,,,,,,a.csv:3: torn", LAB_WRITE_JSON, LAB_DATA);
  succeed(lab_index_write(&index, "lists/hall 2.csv", &(lab_trends){0}, scratch_path("indexed"), &error));
  lab_index_free(&index);
  page = scratch_read(scratch_path("indexed/index.html"));
  for (i = 0, last = page; i < sizeof order / sizeof *order; i++) {
    char name[64];
    snprintf(name, sizeof name, "%s", i == 3 ? ">small &amp; &lt;b&gt;<" : order[i]);
    check_note("%s", name);
    last = strstr(last, name);
    assert_non_null(last);
  }
  assert_contains(page, "<h1>hall 2.csv</h1>");
  assert_contains(page, "<strong>9 lines:</strong>");
  assert_contains(page, "<a href=\"small%20%26%20%3Cb%3E/report.html\">");
  assert_contains(page, "<a href=\"fine%202/report.json\">");
  assert_contains(page, "<th scope=\"row\">torn</th>");
  assert_contains(page, "<td>0.01000 mm² + 500.0 ms</td>");
  assert_contains(page, "<td>x = 1 .. 2 mm</td>");
  assert_contains(page, "<td>no, idea</td>");
  assert_contains(page, "<span class=\"badge deviates\">deviates</span>");
  assert_contains(page, "<td>dry_friction x3.7</td>");
  free(page);
}

/* ---- Crew ---- */

enum { JOBS = 20, DIES = 7, EXITS = 11 };

typedef struct tally {
  int handed_out, times[JOBS], value[JOBS], lost[JOBS], n_done, stop_after;
} tally;

static int give(void *context, void *job)
{
  tally *t = context;
  *(int *)job = t->handed_out;
  return t->handed_out < JOBS ? t->handed_out++, 1 : 0;
}

static void square(void *context, const void *job, void *result)
{
  const int i = *(const int *)job;
  (void)context;
  if (i == DIES)
    raise(SIGKILL);
  if (i == EXITS)
    _exit(3);
  *(int *)result = i * i;
}

static void bury(void *context, const void *job, int wait, void *result)
{
  tally *t = context;
  t->lost[*(const int *)job] = WIFSIGNALED(wait) ? WTERMSIG(wait) : 100 + WEXITSTATUS(wait);
  *(int *)result = -1;
}

static int collect(void *context, const void *job, const void *result, lab_error *e)
{
  tally *t = context;
  const int i = *(const int *)job;
  t->times[i]++;
  t->value[i] = *(const int *)result;
  return ++t->n_done == t->stop_after ? lab_fail(e, LAB_WORLD, "enough") : LAB_OK;
}

static int run_jobs(tally *t, int at_once)
{
  const lab_jobs jobs = {at_once, sizeof(int), sizeof(int), NULL, give, square, bury, collect, t};
  int status;
  lab_interrupt_hold();
  assert_true(lab_jobs_join());
  status = lab_jobs_run(&jobs, &error);
  lab_jobs_leave(&jobs);
  lab_interrupt_release();
  return status;
}

TEST(test_lab_jobs__any_number_at_once__does_each_job_once)
{
  static const int at_once[] = {1, 3, 30};
  size_t k;
  for (k = 0; k < 3; k++) {
    tally t = {0};
    int i;
    assert_int_equal(run_jobs(&t, at_once[k]), LAB_OK);
    for (i = 0; i < JOBS; i++) {
      assert_int_equal(t.times[i], 1);
      assert_int_equal(t.value[i], i == DIES || i == EXITS ? -1 : i * i);
      assert_int_equal(t.lost[i], i == DIES ? SIGKILL : i == EXITS ? 103 : 0);
    }
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1); /* no child is left */
    assert_int_equal(errno, ECHILD);
  }
}

TEST(test_lab_jobs__result_that_cannot_be_kept__ends_the_run)
{
  tally t = {0};
  t.stop_after = 5;
  assert_int_equal(run_jobs(&t, 2), LAB_WORLD);
  assert_string_equal(error.text, "enough");
  assert_int_equal(t.n_done, 5);
  assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
}

/* ---- Batch ---- */

/* What run_list does not set. */
static lab_batch_options options;
static long rss; /* [kB] the most that the last run had */

/* Run a list into a folder, in a process of its own, silently.  Returns: its status */
static int run_list(const char *list, const char *folder)
{
  lab_batch_options how = options;
  int ends[2], wait, i;
  pid_t pid;
  how.list = list;
  how.out = scratch_path(folder);
  how.alpha = 0.01;
  how.min_gain = 0.02;
  how.at_once = 2;
  how.quiet = 1;
  how.budget = options.budget ? options.budget : 600;
  how.memory = options.memory ? options.memory : 4096;
  how.room = options.room ? options.room : 1 << 29;
  assert_int_equal(pipe(ends), 0);
  pid = fork();
  assert_true(pid >= 0);
  if (pid == 0) {
    struct rusage use;
    lab_error mine;
    if (!freopen(scratch_path("said.txt"), "w", stdout))
      _exit(99);
    i = lab_batch_run(&how, &mine);
    getrusage(RUSAGE_SELF, &use);
    fflush(stdout);
    _exit(write(ends[1], &use.ru_maxrss, sizeof use.ru_maxrss) == sizeof use.ru_maxrss ? i : 98);
  }
  close(ends[1]);
  assert_int_equal(read(ends[0], &rss, sizeof rss), sizeof rss);
  close(ends[0]);
  assert_int_equal(waitpid(pid, &wait, 0), pid);
  assert_true(WIFEXITED(wait));
  return WEXITSTATUS(wait);
}

static void assert_in_file(const char *name, const char *words)
{
  char *text = scratch_read(scratch_path(name));
  assert_contains(text, words);
  free(text);
}

/* A list of lines that fail at once. */
static const char *long_list(const char *name, int n)
{
  const char *path = scratch_path(name);
  FILE *file = fopen(path, "w");
  int i;
  assert_non_null(file);
  fputs("name,rig,log\n", file);
  for (i = 0; i < n; i++)
    fprintf(file, "n%d,nothing.cfg,nothing-%d.csv\n", i, i);
  fclose(file);
  return path;
}

TEST(test_lab_batch__lines_that_fail__are_lines)
{
  assert_int_equal(run_list(long_list("three.csv", 3), "failing"), LAB_DATA);
  assert_in_file("failing/batch.csv", "\nn0,error,");
  assert_in_file("failing/batch.csv",
                 ",nothing.cfg: there is no such file; check the name and the folder,,\nn1,error,");
  assert_in_file("failing/batch.csv", "\nn2,error,");
  assert_in_file("said.txt", "3 lines: 3 error.");
}

/* A list of one rig. */
static void run_one(const char *rig, const char *folder)
{
  scratch_text("rig.cfg", rig);
  scratch_text("log.csv", "t [s],u [1],p [kPa]\n0,0,0\n");
  scratch_text("other.cfg", "actuator = { stroke = \"3 N\"; };\n");
  assert_int_equal(run_list(scratch_text("one.csv", "name,rig,log\none,rig.cfg,log.csv\n"), folder), LAB_DATA);
}

/* The file of a stranger takes in no other, unless that is allowed. */
TEST(test_lab_batch__rig_with_include__is_refused_unless_allowed)
{
  static const char rig[] = "supply = { pressure = \"2 bar\"; };\n  @include \"other.cfg\"\n";
  run_one(rig, "refused");
  assert_in_file("refused/batch.csv", "rig.cfg: @include would read any file");
  assert_in_file("refused/batch.csv", "--allow-include");
  options.allow_include = 1;
  run_one(rig, "allowed");
  options.allow_include = 0;
  assert_in_file("allowed/batch.csv", "actuator.stroke: ");
}

TEST(test_lab_batch__more_logs_than_a_line_may_have__is_an_error_of_its_line)
{
  char text[600] = "name,rig,log\nmany,rig.cfg,log.csv";
  int i;
  for (i = 0; i < LAB_LOGS_MAX; i++)
    strcat(text, ";log.csv");
  scratch_text("rig.cfg", "supply = { pressure = \"2 bar\"; };\n");
  assert_int_equal(run_list(scratch_text("crowded.csv", strcat(text, "\n")), "crowded"), LAB_DATA);
  assert_in_file("crowded/batch.csv", "more than 32 logs on one line");
}

/* A log of 12 MB, which asks for 25 MB at once while it is read, beside a short one. */
TEST(test_lab_batch__log_beyond_the_memory_of_a_line__is_an_error_of_its_line)
{
  FILE *file = fopen(scratch_path("large.csv"), "w");
  int i;
#ifdef LAB_SANITIZED
  fclose(file);
  skip(); /* reserves more than there is */
#endif
  fputs("t [s],u [1],p [kPa]\n", file);
  for (i = 0; i < 1000000; i++)
    fprintf(file, "%d,1,%d\n", i, i % 7);
  fclose(file);
  scratch_text("rig.cfg", "supply = { pressure = \"2 bar\"; };\n");
  scratch_text("log.csv", "t [s],u [1],p [kPa]\n0,0,0\n");
  options.memory = 24;
  assert_int_equal(
      run_list(scratch_text("bounded.csv", "name,rig,log\nlarge,rig.cfg,large.csv\nshort,rig.cfg,log.csv\n"),
               "bounded"),
      LAB_WORLD);
  options.memory = 0;
  assert_in_file("bounded/batch.csv", "\nlarge,error,");
  assert_in_file("bounded/batch.csv", "memory");
  assert_in_file("bounded/batch.csv", "\nshort,error,");
}

/* The list of the guide on a leak, from wherever it is. */
static const char *leak_list(void)
{
  char here[500], text[2000];
  assert_non_null(getcwd(here, sizeof here));
  snprintf(text, sizeof text, "name,rig,log\nleak,%s/study/guides/leak/rig.cfg,%s/study/guides/leak/fit.csv\n", here,
           here);
  return scratch_text("leak.csv", text);
}

TEST(test_lab_batch__file_beyond_the_room_of_a_line__is_an_error_of_its_line)
{
  static const struct {
    long room;
    int status;
    const char *folder, *rows, *said;
  } with[] = {{1 << 20, LAB_OK, "roomy", "roomy/batch.csv", "leak,effect,"},
              {2000, LAB_WORLD, "tight", "tight/batch.csv", "File too large"}};
  size_t i;
  for (i = 0; i < sizeof with / sizeof with[0]; i++) {
    options.room = with[i].room;
    assert_int_equal(run_list(leak_list(), with[i].folder), with[i].status);
    assert_in_file(with[i].rows, with[i].said);
  }
  options.room = 0;
}

/* 2000 lines take no more than 100, but for the list itself and the 16 bytes a line of its check. */
TEST(test_lab_batch__long_list__takes_no_more_memory)
{
  long few;
#ifdef __SANITIZE_ADDRESS__
  skip(); /* keeps what has been freed */
#endif
  assert_int_equal(run_list(long_list("few.csv", 100), "few"), LAB_DATA);
  few = rss;
  assert_int_equal(run_list(long_list("many.csv", 2000), "many"), LAB_DATA);
  check_note("100 lines %ld kB, 2000 lines %ld kB", few, rss);
  assert_true(rss - few < 200);
}

/* closeloop, simulate and the draft as functions: the same texts as the programs' files, and no file touched. */
#include "../../scratch.h"

#include "../../../apps/lab/api/api.h"

static const char folder[] = "study/guides/leak/";

static lab_api_answer answer;
static lab_text_given rig, fit, holdout;

static lab_text_given given(const char *name)
{
  char path[128];
  lab_text_given text = {name, NULL, 0};
  snprintf(path, sizeof path, "%s%s", folder, name);
  text.data = scratch_read(path);
  text.size = strlen(text.data);
  return text;
}

static int read_inputs(void **state)
{
  rig = given("rig.cfg");
  fit = given("fit.csv");
  holdout = given("holdout.csv");
  return scratch_open(state);
}

static int free_inputs(void **state)
{
  free((void *)rig.data);
  free((void *)fit.data);
  free((void *)holdout.data);
  return scratch_close(state);
}

TESTS_WITH(read_inputs, free_inputs)

static lab_api_request usual(void)
{
  return (lab_api_request){.rig = rig, .log = &fit, .n_logs = 1, .holdout = &holdout, .n_holdout = 1};
}

static int refuse_answer(const lab_api_request *request)
{
  const int status = lab_api_closeloop(request, &answer, &error);
  assert_null(answer.json);
  assert_null(answer.sentence);
  assert_int_equal(error.status, status);
  return status;
}

/* What a program leaves in the scratch folder, to be freed. */
static char *program(const char *arguments, const char *file)
{
  char line[1024];
  snprintf(line, sizeof line, PROGRAMS "/%s", arguments);
  assert_int_equal(system(line), 0);
  return scratch_read(scratch_path(file));
}

/* The times that the answer took differ from run to run. */
static void drop_times(char *json)
{
  char *times = strstr(json, "\"timing\"");
  assert_non_null(times);
  *times = '\0';
}

/* With time enough: where it is spent depends on the machine. */
TEST(test_lab_api_closeloop__same_files__same_texts)
{
  lab_api_request request = usual();
  char arguments[512], *json, *model, *residual;
  request.budget = 600;
  snprintf(arguments, sizeof arguments,
           "closeloop --budget 600 %srig.cfg %sfit.csv --holdout %sholdout.csv --no-figures --quiet --out %s >%s",
           folder, folder, folder, scratch_folder, scratch_path("said"));
  json = program(arguments, "report.json");
  model = scratch_read(scratch_path("model.cfg"));
  residual = scratch_read(scratch_path("residual.csv"));
  succeed(lab_api_closeloop(&request, &answer, &error));
  drop_times(json);
  drop_times(answer.json);
  assert_string_equal(answer.json, json);
  assert_string_equal(answer.model, model);
  assert_string_equal(answer.residual, residual);
  assert_contains(answer.html, "</html>");
  assert_contains(answer.sentence, "The chamber leaks");
  lab_api_free_answer(&answer);
  assert_null(answer.json);
  free(json);
  free(model);
  free(residual);
}

static void stop(void *told, const char *what)
{
  (*(int *)told)++;
  assert_true(*what);
  lab_api_stop();
}

TEST(test_lab_api_stop__at_first_word__ends_without_answer)
{
  lab_api_request request = usual();
  int told = 0;
  request.on_progress = stop;
  request.context = &told;
  assert_int_equal(refuse_answer(&request), LAB_WORLD);
  assert_contains(error.text, "stopped");
  assert_true(told > 0);
  request.on_progress = NULL; /* the next call is not stopped */
  succeed(lab_api_closeloop(&request, &answer, &error));
  lab_api_free_answer(&answer);
}

TEST(test_lab_api_closeloop__requests_at_fault__are_refused)
{
  const lab_text_given twice[] = {fit, {"fit.csv", "t [s]\n", 6}};
  const lab_text_given includes = {"rig.cfg", "@include \"other.cfg\"\n", 21};
  lab_api_request request = usual();
  request.alpha = 0.6;
  assert_int_equal(refuse_answer(&request), LAB_USAGE);
  request = usual();
  request.n_logs = 0;
  assert_int_equal(refuse_answer(&request), LAB_USAGE);
  assert_contains(error.text, "expected 1 to");
  request = usual();
  request.log = twice;
  request.n_logs = 2;
  assert_int_equal(refuse_answer(&request), LAB_USAGE);
  assert_contains(error.text, "fit.csv");
  request = usual();
  request.rig = includes;
  assert_int_equal(refuse_answer(&request), LAB_DATA);
  assert_contains(error.text, "@include");
}

TEST(test_lab_api_closeloop__text_at_fault__says_its_name)
{
  const lab_text_given empty = {"empty.csv", "", 0};
  lab_api_request request = usual();
  request.log = &empty;
  assert_int_equal(refuse_answer(&request), LAB_DATA);
  assert_contains(error.text, "empty.csv");
}

TEST(test_lab_api_simulate__log_and_step__as_the_program)
{
  char arguments[512], *want, *csv;
  snprintf(arguments, sizeof arguments, "simulate %srig.cfg %sfit.csv --out %s", folder, folder, scratch_path("s.csv"));
  want = program(arguments, "s.csv");
  succeed(lab_api_simulate(&rig, &fit, &csv, &error));
  assert_string_equal(csv, want);
  lab_api_free(csv);
  free(want);
  snprintf(arguments, sizeof arguments, "simulate %srig.cfg --step --out %s", folder, scratch_path("s.csv"));
  want = program(arguments, "s.csv");
  succeed(lab_api_simulate(&rig, NULL, &csv, &error));
  assert_string_equal(csv, want);
  lab_api_free(csv);
  free(want);
}

TEST(test_lab_api_draft__log_and_sheet__as_the_program)
{
  const char *const sheet[] = {"area=400 cm2", "bench_set=0.2..1.0 bar"};
  const char *const wrong[] = {"aera=400 cm2"};
  char arguments[512], *want, *drafted;
  snprintf(arguments, sizeof arguments, "closeloop --init %sfit.csv --sheet '%s' '%s' --out %s", folder, sheet[0],
           sheet[1], scratch_path("d.cfg"));
  want = program(arguments, "d.cfg");
  succeed(lab_api_draft(&fit, sheet, 2, &drafted, &error));
  assert_contains(drafted, "bench_set");
  assert_string_equal(strchr(drafted, '\n'), strchr(want, '\n')); /* the first line names the log */
  lab_api_free(drafted);
  free(want);
  assert_int_equal(lab_api_draft(&fit, wrong, 1, &drafted, &error), LAB_USAGE);
  assert_null(drafted);
}

/* From a log of the independent rig to report.html and its figures. */
#include "../../fixture.h"
#include "../../scratch.h"
#include "../../virtual.h"

#include "../../../apps/lab/metrics/recording.h"
#include "../../../apps/lab/fit/weights.h"
#include "../../../apps/lab/report/figures.h"

enum { ROWS = 1001 };
static const double spacing = 0.01; /* [s] */

static lab_rig rig;
static lab_log logged;
static lab_run run[2];
static lab_unknowns declared, completed;
static lab_search_result result;
static lab_report report;
static lab_metrics measured, predicted;
static char *page, *other; /* of the report, and of another one */

/* ---- A report: the R1-400 with a leak that the rig file does not know of ---- */

static struct {
  double t[ROWS], u[ROWS], p[ROWS], x[ROWS];
} log_rows;
static const second_log samples = {.t = log_rows.t, .u = log_rows.u, .p = log_rows.p, .x = log_rows.x};

/* Write the samples, NaN as a gap.  Returns: path */
static const char *write_rows(const char *name)
{
  const char *path = scratch_path(name);
  FILE *file = fopen(path, "w");
  int i;
  assert_non_null(file);
  fprintf(file, "t [s],u [1],p [Pa],x [m]\n");
  for (i = 0; i < ROWS; i++)
    if (isnan(log_rows.p[i]))
      fprintf(file, "%.3f,%g,,%.7f\n", log_rows.t[i], log_rows.u[i], log_rows.x[i]);
    else
      fprintf(file, "%.3f,%g,%.1f,%.7f\n", log_rows.t[i], log_rows.u[i], log_rows.p[i], log_rows.x[i]);
  fclose(file);
  return path;
}

static const char *write_log(const char *name)
{
  static const double t_cmd[] = {0.402, 2.503, 4.001, 5.507, 7.204}, u_cmd[] = {1, 0, -1, 0.5, -0.5};
  second_rig g = virtual_rig(7);
  int i;
  g.leak_area = 1.5e-8;
  assert_int_equal(second_run(&g, t_cmd, u_cmd, 5, 10, spacing, &samples, NULL), 0);
  for (i = 300; i < 310; i++)
    log_rows.p[i] = NAN;
  return write_rows(name);
}

static void declare(void)
{
  virtual_declare(&rig);
  strcpy(rig.name, "R1 <script>alert(\"1\")</script> & co");
  rig.params.spring_rate = (pneu_real)3.9e5;
  rig.fit[rig.n_fit++] = LAB_PARAM_ORIFICE_AREA;
  rig.fit[rig.n_fit++] = PNEU_PARAM_spring_rate;
}

/* Once for all tests, in a folder for all of them. */
static int begin_report(void **state)
{
  lab_search_options options;
  if (scratch_open(state))
    return -1;
  declare();
  lab_search_options_default(&options);
  options.max_effects = 1;
  virtual_open(&rig, write_log("a&b.csv"), &logged, &run[0]);
  succeed(lab_unknowns_open(&rig, run, 1, &declared, &error));
  succeed(lab_unknowns_fit(&declared, LAB_ROUNDS_ALL, NULL, &error));
  completed = declared;
  succeed(lab_search_run(&completed, &options, &result, &error));
  report.rig = &rig;
  report.declared = &declared;
  report.completed = &completed;
  report.result = &result;
  report.measured = &measured;
  report.predicted = &predicted;
  succeed(lab_metrics_compare(&completed, &measured, &predicted, &error));
  return 0;
}

TESTS_WITH(begin_report, scratch_close)

static void write_report(const lab_report *told, const char *folder)
{
  lab_figures *figures;
  mkdir(folder, 0777);
  succeed(lab_figures_make(told, &figures, &error));
  succeed(lab_figures_draw(figures, folder, 1, &error));
  succeed(lab_report_file(folder, "report.html", lab_report_html, &(lab_sources){told, figures}, &error));
  lab_figures_free(figures);
}

/* A file of the report in a folder, until the next one. */
static const char *read_back(const char *folder, const char *name)
{
  char file[128];
  snprintf(file, sizeof file, "%s/%s", folder, name);
  free(other);
  other = scratch_read(scratch_path(file));
  return other;
}

/* The page of another report, and its JSON; until the next one. */
static const char *page_of(const lab_report *told, const char *folder)
{
  write_report(told, scratch_path(folder));
  return read_back(folder, "report.html");
}

static const char *json_of(const lab_report *told, const char *folder)
{
  mkdir(scratch_path(folder), 0777);
  succeed(lab_report_file(scratch_path(folder), "report.json", lab_report_json, &(lab_sources){told, NULL}, &error));
  return read_back(folder, "report.json");
}

/* The page of the report; kept. */
static const char *the_page(void)
{
  if (!page) {
    write_report(&report, scratch_path("report"));
    page = scratch_read(scratch_path("report/report.html"));
  }
  return page;
}

/* ---- Form ---- */

/* Where a tag begins, outside what a script has between <![CDATA[ and ]]>. */
static const char *next_tag(const char *at)
{
  static const char begin[] = "<![CDATA[", end[] = "]]>";
  while ((at = strchr(at, '<')) && !strncmp(at, begin, sizeof begin - 1)) {
    at = strstr(at, end);
    if (!at)
      return NULL;
  }
  return at;
}

/* Tags are opened and closed in order, as in XML; returns what is wrong. */
static const char *fault_of(const char *text)
{
  static char stack[64][24];
  static char fault[96];
  int depth = 0;
  const char *at = text;
  while ((at = next_tag(at))) {
    const char *end = strchr(at, '>');
    char name[24];
    const int closing = at[1] == '/';
    if (!end)
      return "a tag is not ended";
    snprintf(name, sizeof name, "%.*s", (int)strcspn(at + 1 + closing, " \n\t/>"), at + 1 + closing);
    snprintf(fault, sizeof fault, "<%s%.20s> within <%.20s>", closing ? "/" : "", name, depth ? stack[depth - 1] : "");
    at = end;
    if (*name == '!' || end[-1] == '/')
      continue;
    if (closing && (depth == 0 || strcmp(stack[--depth], name) != 0))
      return fault;
    if (!closing && depth == 64)
      return "tags are too deep";
    if (!closing)
      strcpy(stack[depth++], name);
  }
  return depth ? "a tag is left open" : "";
}

TEST(test_fault_of__bad_pages__are_seen)
{
  assert_string_equal(fault_of("<!DOCTYPE html><p>a<br/><b>c</b></p>"), "");
  assert_string_not_equal(fault_of("<p>a<b>c</p></b>"), "");
  assert_string_not_equal(fault_of("<p>a"), "");
  assert_string_not_equal(fault_of("a</p>"), "");
  assert_string_equal(fault_of("<script><![CDATA[ if (a<b) c(); ]]></script>"), "");
}

TEST(test_lab_report_html__leak__page_is_well_formed)
{
  assert_string_equal(fault_of(the_page()), "");
  assert_null(strstr(the_page(), "{{"));
}

static int count(const char *text, const char *part)
{
  int n = 0;
  for (; (text = strstr(text, part)); text++)
    n++;
  return n;
}

/* The one address is where the library of the curves is from, in its heading. */
TEST(test_lab_report_html__leak__needs_nothing_from_outside)
{
  static const char *const links[] = {"http:", "src=", "url(", "@import", "<link", "fetch(", "import(", "XMLHttp"};
  size_t i;
  for (i = 0; i < sizeof links / sizeof *links; i++) {
    check_note("%s", links[i]);
    assert_null(strstr(the_page(), links[i]));
  }
  assert_int_equal(count(the_page(), "https:"), 1);
  assert_contains(the_page(), "/*! https://github.com/leeoniya/uPlot (v1.6.32) */");
  assert_contains(the_page(), "Copyright (c) 2022 Leon Sorokin");
}

/* What is carried inside arrives as it is, long lines and all. */
TEST(test_lab_page_text__library__is_the_file)
{
  cJSON *values = cJSON_CreateObject();
  char *template = lab_page_text("report", values),
       *file = scratch_read("apps/lab/report/page/uplot/uPlot.iife.min.js");
  assert_non_null(template);
  assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItem(values, "plot")), file);
  cJSON_Delete(values);
  free(template);
  free(file);
}

TEST(test_lab_report_html__five_figures__ids_are_single_and_all_have_words)
{
  const char *at = the_page();
  assert_int_equal(count(at, "role=\"img\" aria-label=\""), 5);
  assert_int_equal(count(at, "aria-label=\"\""), 0);
  assert_int_equal(count(at, "<figure "), 5);
  assert_int_equal(count(at, "<noscript>"), 5);
  while ((at = strstr(at, " id="))) {
    char id[96];
    snprintf(id, sizeof id, " id=%.*s%c", (int)strcspn(at + 5, "'\"") + 1, at + 4, at[4]);
    check_note("%s", id);
    assert_int_equal(count(the_page(), id), 1);
    at++;
  }
}

/* What the script reads curves from; to be deleted. */
static cJSON *curves_of(const char *text)
{
  static const char begin[] = "<script type=\"application/json\" id=\"curves\">";
  const char *from = strstr(text, begin);
  cJSON *all;
  assert_non_null(from);
  all = cJSON_ParseWithOpts(from + strlen(begin), NULL, 0);
  assert_non_null(all);
  return all;
}

/* A column of it as numbers, NaN for a gap.  Returns: how many */
static int column_of(const cJSON *all, int number, double value[ROWS])
{
  const cJSON *column = cJSON_GetArrayItem(cJSON_GetObjectItem(all, "columns"), number);
  const char *at = cJSON_GetObjectItem(column, "d")->valuestring;
  const double unit = pow(10, -cJSON_GetObjectItem(column, "k")->valueint);
  long long sum = 0;
  int n = 0, more = 1;
  while (more) {
    char *end;
    const long long step = strtoll(at, &end, 10);
    assert_true(n < ROWS);
    value[n++] = end > at ? (double)(sum += step) * unit : (double)NAN;
    more = *end == ',';
    at = end + 1;
  }
  return n;
}

/* Every value that is drawn is that of its row, as far as its digits go. */
TEST(test_lab_report_html__curves__are_the_rows)
{
  static const char *const key[] = {"measured", "before", "after"};
  static double t[ROWS], value[ROWS];
  cJSON *all = curves_of(the_page()), *panel;
  lab_residual_table v;
  int c, k, i, n, gaps = 0;
  succeed(lab_residual_table_collect(&report, &v, &error));
  for (c = 0; c < 2; c++) {
    const double *const rows[] = {v.channel[c].measured, v.channel[c].predicted[LAB_STAGE_BEFORE],
                                  v.channel[c].predicted[LAB_STAGE_AFTER]};
    const double scale = c ? 1e3 : 1e-3;
    panel = cJSON_GetArrayItem(cJSON_GetObjectItem(cJSON_GetObjectItem(all, "panels"), "response"), 1 + c);
    assert_string_equal(cJSON_GetObjectItem(panel, "unit")->valuestring, c ? "mm" : "kPa");
    n = column_of(all, cJSON_GetObjectItem(panel, "x")->valueint, t);
    assert_true(n > 500);
    for (k = 0; k < 3; k++) {
      const cJSON *curve = cJSON_GetArrayItem(cJSON_GetObjectItem(panel, "curves"), k);
      assert_string_equal(cJSON_GetObjectItem(curve, "key")->valuestring, key[k]);
      assert_int_equal(column_of(all, cJSON_GetObjectItem(curve, "y")->valueint, value), n);
      for (i = 0; i < n; i++) {
        const int row = (int)lround(t[i] / spacing);
        check_note("%s in row %d", key[k], row);
        assert_close(t[i], v.t[row], 1e-9, 0);
        assert_int_equal(isnan(value[i]), isnan(rows[k][row]));
        gaps += isnan(value[i]);
        if (!isnan(value[i]))
          assert_close(value[i], scale * rows[k][row], c ? 0.5001e-2 : 0.5001e-1, 0);
      }
    }
  }
  assert_true(gaps > 0);
  lab_residual_table_free(&v);
  cJSON_Delete(all);
}

/* ---- Valve signature ---- */

static void set_effect(lab_rig *r, int param, double value)
{
  *pneu_param_at(&r->params, param) = (pneu_real)value;
}

/* Balance of forces by hand: p A(x) = k (x + x0) +- (F + f p). */
TEST(test_lab_signature_make__effects_of_forces__balance_by_hand)
{
  const double stroke = 0.02, k = 4e5, x0 = 0.01, F = 480, area = 0.04, f = 1e-3, a = 0.2;
  lab_rig r;
  lab_signature s;
  int i;
  lab_rig_default(&r);
  set_effect(&r, PNEU_PARAM_external_force, 100);
  succeed(lab_signature_make(&r, &s, &error));
  assert_close(s.bench_lower, (k * x0 + 100) / area, 0, 1e-9);
  assert_close(s.bench_upper, (k * (stroke + x0) + 100) / area, 0, 1e-9);
  assert_close(s.spring_rate, k, 0, 1e-9);
  assert_close(s.band, 2 * F / area, 0, 1e-9);
  set_effect(&r, PNEU_PARAM_BASE_COUNT + PNEU_AT_friction_pressure, f);
  set_effect(&r, PNEU_PARAM_BASE_COUNT + PNEU_AT_area_variation, a);
  succeed(lab_signature_make(&r, &s, &error));
  for (i = 0; i < LAB_SIGNATURE_POINTS; i += 10) {
    const double x = stroke * i / (LAB_SIGNATURE_POINTS - 1), acts = area * (1 - a * x / stroke);
    const double spring = k * (x + x0) + 100;
    assert_close(s.x[i], x, 1e-12, 0);
    assert_close(s.p[LAB_SIGNATURE_UP][i], (spring + F) / (acts - f), 0, 1e-9);
    assert_close(s.p[LAB_SIGNATURE_SPRING][i], spring / acts, 0, 1e-9);
    assert_close(s.p[LAB_SIGNATURE_DOWN][i], (spring - F) / (acts + f), 0, 1e-9);
  }
  set_effect(&r, PNEU_PARAM_stroke, 0);
  assert_int_equal(lab_signature_make(&r, &s, &error), LAB_DATA);
}

/* Every curve lies where the physics of the rig that made the log puts it; lines and table tell both models. */
TEST(test_lab_report_html__signature__measured_found_and_declared)
{
  static const char *const key[] = {"measured", "measured", "after", "after", "found",
                                    "found",    "found",    "sheet", "sheet", "sheet"};
  static const double sense[] = {1, -1, 1, -1, 1, 0, -1, 1, 0, -1},
                      rate[] = {400, 400, 400, 400, 400, 400, 400, 390, 390, 390};
  static double x[ROWS], p[ROWS];
  cJSON *all = curves_of(the_page()), *panel;
  lab_report told = report;
  int c, i, n;
  panel = cJSON_GetArrayItem(cJSON_GetObjectItem(cJSON_GetObjectItem(all, "panels"), "signature"), 0);
  assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(panel, "curves")), 10);
  n = column_of(all, cJSON_GetObjectItem(panel, "x")->valueint, x);
  for (c = 0; c < 10; c++) {
    const cJSON *curve = cJSON_GetArrayItem(cJSON_GetObjectItem(panel, "curves"), c);
    int there = 0;
    assert_string_equal(cJSON_GetObjectItem(curve, "key")->valuestring, key[c]);
    assert_int_equal(column_of(all, cJSON_GetObjectItem(curve, "y")->valueint, p), n);
    for (i = 0; i < n; i++) {
      const double line = (rate[c] * (x[i] + 10) + 480 * sense[c]) / 40;
      there += !isnan(p[i]);
      check_note("curve %d at %g mm", c, x[i]);
      if (!isnan(p[i]))
        assert_close(p[i], line, c < 4 ? 4 : 0.5, 0); /* measured: inertia and viscous friction beside */
    }
    assert_true(there > (c < 4 ? 5 : n - 1));
  }
  cJSON_Delete(all);
  assert_contains(the_page(), "<tr><th scope=\"row\">bench set, lower</th><td>97.50 kPa</td><td>");
  assert_contains(the_page(),
                  "declared: bench set 97.50 kPa to 292.5 kPa, spring rate 390.0 N/mm, friction band 24.00 kPa.");
  assert_null(strstr(the_page(), "as it was"));
  told.baseline = &rig;
  assert_contains(page_of(&told, "baseline"), "as it was");
  assert_contains(other, "\"key\":\"baseline\"");
}

/* ---- Content ---- */

TEST(test_lab_report_html__leak__says_what_was_found)
{
  assert_contains(the_page(), "<h1>The chamber leaks: 0.015");
  assert_contains(the_page(), " bar supply <code>chamber_leak</code>.</h1>\n<p>With it the error falls from ");
  assert_contains(the_page(), "chamber_leak");
  assert_contains(the_page(), pneu_effect_at(result.found[0].effect)->footprint);
  assert_contains(the_page(), " kPa");
  assert_contains(the_page(), " mm²");
  assert_contains(the_page(), "<td data-label=\"declared\">absent</td>");
  assert_contains(the_page(), "<th scope=\"col\">fitted without the effect</th>");
  assert_contains(the_page(), "<span class=\"bar passes\"");
  assert_contains(the_page(), "<span class=\"bar fails\"");
  assert_contains(the_page(), "<span class=\"large\">");
  assert_contains(the_page(), "chamber_leak is significant: p-value");
}

/* Of the models that were tried one comes within odds of the best, which the page must not deny. */
TEST(test_lab_report_html__rival_that_was_tried__is_not_denied)
{
  static lab_search_result rival;
  static const char claim[] = "No other effect of the catalogue explains the log as well.";
  lab_report told = report;
  int i;
  rival = result;
  rival.found[0].n_alike = 0;
  rival.n_steps = 2;
  strcpy(rival.step[0].name, rival.path[rival.n_path - 1].name);
  strcpy(rival.step[1].name, "another");
  told.result = &rival;
  for (i = 0; i < 2; i++) {
    rival.step[1].bic = rival.path[rival.n_path - 1].bic + (i == 0 ? 5 : 50);
    assert_int_equal(strstr(page_of(&told, "rival"), claim) != NULL, i == 1);
  }
}

/* The log has no full stroke, so that its figures are reasons. */
TEST(test_lab_report_html__figures_of_merit__or_why_not)
{
  lab_report without = report;
  assert_contains(the_page(), "<h2>Figures of merit</h2>");
  assert_contains(the_page(), "<code>air_mass</code>: the record has no mass flow");
  assert_contains(the_page(), "Steps are steps of the opening of the transducer");
  without.measured = NULL;
  assert_null(strstr(page_of(&without, "without"), "Figures of merit"));
}

TEST(test_lab_report_html__names_of_files_and_rigs__are_escaped)
{
  assert_contains(the_page(), "R1 &lt;script&gt;alert(&quot;1&quot;)&lt;/script&gt; &amp; co");
  assert_contains(the_page(), "a&amp;b.csv");
}

TEST(test_lab_report_html__twice__same_bytes)
{
  static const char *const names[] = {"report.html", "response.svg", "residual.svg", "arguments.svg",
                                      "autocorrelation.svg"};
  size_t i;
  (void)the_page();
  write_report(&report, scratch_path("again"));
  for (i = 0; i < sizeof names / sizeof *names; i++) {
    char one[64], two[64];
    char *a, *b;
    snprintf(one, sizeof one, "report/%s", names[i]);
    snprintf(two, sizeof two, "again/%s", names[i]);
    check_note("%s", names[i]);
    a = scratch_read(scratch_path(one));
    b = scratch_read(scratch_path(two));
    assert_true(strlen(a) > 1000);
    assert_string_equal(a, b);
    assert_true(i == 0 || !strstr(a, "alert")); /* no name of a user's reaches gnuplot */
    free(a);
    free(b);
  }
}

TEST(test_lab_report_html__nothing_found_two_runs__is_told_as_well)
{
  static lab_unknowns both;
  static lab_search_result nothing;
  lab_report told = report;
  run[1] = run[0];
  succeed(lab_unknowns_open(&rig, run, 2, &both, &error));
  succeed(lab_search_measure(&both, LAB_STAGE_BEFORE, &nothing, &error));
  succeed(lab_search_measure(&both, LAB_STAGE_AFTER, &nothing, &error));
  nothing.fit.n = both.n;
  nothing.verdict = LAB_VERDICT_UNDECIDED;
  told.declared = told.completed = &both;
  told.result = &nothing;
  assert_string_equal(fault_of(page_of(&told, "nothing")), "");
  assert_contains(other, "2002 rows in 2 runs");
  assert_contains(other, "The runs follow one after the other");
  assert_contains(other, "\"runs\":[{\"entry\":0,\"shift\":0},{\"entry\":");
  assert_contains(other, "Something is missing, but the log does not say what.");
  assert_null(strstr(other, "completed model"));
}

/* The log without its pressure: set point and travel are all that many plants record. */
TEST(test_lab_report_html__pressure_not_measured__is_said)
{
  static lab_unknowns one;
  static lab_search_result nothing;
  static lab_run travel;
  static lab_log log;
  const char *path = scratch_path("travel.csv");
  lab_report told = report;
  FILE *from = fopen(scratch_path("a&b.csv"), "r"), *to = fopen(path, "w");
  char line[128];
  while (fgets(line, sizeof line, from)) {
    const char *second = strchr(line, ','), *third = strchr(second + 1, ',');
    fprintf(to, "%.*s%s", (int)(third - line), line, strchr(third + 1, ','));
  }
  fclose(from);
  fclose(to);
  virtual_open(&rig, path, &log, &travel);
  lab_unknowns_none(&rig, &travel, 1, &one);
  succeed(lab_search_measure(&one, LAB_STAGE_BEFORE, &nothing, &error));
  succeed(lab_search_measure(&one, LAB_STAGE_AFTER, &nothing, &error));
  told.declared = told.completed = &one;
  told.result = &nothing;
  told.measured = NULL;
  assert_contains(page_of(&told, "travel"), "The model&#39;s pressure, for it was not measured");
  assert_contains(other, "\"signature\":[{\"name\":\"Pressure p\"");
}

/* ---- Noise with memory ---- */

/* Add noise of which each value remembers 0.6 of the one before. */
static void add_noise(double *value, double sigma, uint64_t *seed)
{
  double noise = 0;
  int i;
  for (i = 0; i < ROWS; i++) {
    const double a = fixture_random(seed, 1e-12, 1), b = fixture_random(seed, 0, 1);
    noise = (i ? 0.6 : 0) * noise + (i ? 0.8 : 1) * sqrt(-2 * log(a)) * cos(2 * 3.14159265358979323846 * b);
    value[i] += sigma * noise;
  }
}

/* The R1-400 as declared, at rest for 3.5 s. */
static const char *write_log_with_memory(const char *name)
{
  static const double t_cmd[] = {3.502, 5.501, 6.507}, u_cmd[] = {1, 0, -1};
  second_rig g = virtual_rig(1);
  uint64_t seed = 3;
  g.pressure_noise = g.position_noise = 0; /* what is added has a memory */
  assert_int_equal(second_run(&g, t_cmd, u_cmd, 3, 10, spacing, &samples, NULL), 0);
  add_noise(log_rows.p, 320, &seed);
  add_noise(log_rows.x, 2e-5, &seed);
  return write_rows(name);
}

TEST(test_lab_report_html__noise_with_memory__is_noise_as_the_verdict_has_it)
{
  static lab_unknowns fitted;
  static lab_search_result outcome;
  static lab_run own;
  static lab_log log;
  lab_search_options options;
  lab_report told = {0};
  lab_unknowns after;
  int any;
  lab_search_options_default(&options);
  virtual_open(&rig, write_log_with_memory("memory.csv"), &log, &own);
  succeed(lab_unknowns_open(&rig, &own, 1, &fitted, &error));
  succeed(lab_unknowns_fit(&fitted, LAB_ROUNDS_ALL, NULL, &error));
  succeed(lab_weigh_runs(&fitted, &own, &any, &error));
  assert_true(any);
  succeed(lab_unknowns_fit(&fitted, LAB_ROUNDS_ALL, NULL, &error));
  after = fitted;
  succeed(lab_search_run(&after, &options, &outcome, &error));
  assert_int_equal(outcome.verdict, LAB_VERDICT_NONE);
  told.rig = &rig;
  told.declared = &fitted;
  told.completed = &after;
  told.result = &outcome;
  assert_contains(page_of(&told, "memory"), ">white<");
  assert_null(strstr(other, ">not white<"));
  assert_contains(json_of(&told, "memory"), "\"whiteness\":");
  assert_null(strstr(other, "\"white\":\tfalse"));
}

/* One key, one meaning: what the refit of a candidate explains, found or not; before what is found is fitted to the
 * end, declared values follow straight lines, which costs some thousandths. */
TEST(test_lab_report_json__explained__is_that_of_the_refit)
{
  cJSON *root = cJSON_Parse(json_of(&report, "json")), *candidate;
  int refitted = 0, not_refitted = 0;
  double found;
  found =
      cJSON_GetNumberValue(cJSON_GetObjectItem(cJSON_GetArrayItem(cJSON_GetObjectItem(root, "found"), 0), "explained"));
  assert_true(found > 0.9);
  cJSON_ArrayForEach(candidate, cJSON_GetObjectItem(root, "candidates"))
  {
    const double share = cJSON_GetNumberValue(cJSON_GetObjectItem(candidate, "explained"));
    const int is_leak = !strcmp(cJSON_GetObjectItem(candidate, "effect")->valuestring, "chamber_leak");
    assert_true(cJSON_IsNumber(cJSON_GetObjectItem(candidate, "explained_by_slope")));
    refitted += !isnan(share);
    not_refitted += cJSON_IsNull(cJSON_GetObjectItem(candidate, "explained"));
    if (is_leak)
      assert_close(share, found, 5e-3, 0);
  }
  assert_true(refitted > 1 && not_refitted > 1);
  cJSON_Delete(root);
}

/* A refit that ends farther from the logs explains nothing, and none explains more than there is. */
TEST(test_lab_report_refit_explains__any_refit__is_a_share)
{
  static lab_search_result r = {.n_steps = 2, .before = {.n = 90}};
  static const double chi2[] = {5000, 50, 95}, share[] = {0, 1, 0.5};
  const lab_score score = {.effect = 0};
  int i;
  snprintf(r.step[1].name, sizeof r.step[1].name, "%s", pneu_effect_at(0)->name);
  for (i = 0; i < 3; i++) {
    r.step[0].chi2 = 100;
    r.step[1].chi2 = chi2[i];
    assert_close(lab_report_refit_explains(&r, &score), share[i], 0, 1e-12);
  }
}

/* ---- Evidence ---- */

TEST(test_lab_residual_table_collect__leak__white_only_when_completed)
{
  lab_residual_table v;
  int c;
  succeed(lab_residual_table_collect(&report, &v, &error));
  assert_int_equal(v.n, ROWS);
  assert_int_equal(v.n_channels, 2);
  for (c = 0; c < 2; c++) {
    assert_true(result.left[LAB_STAGE_BEFORE][v.channel[c].channel].whiteness.p_value < 1e-6);
    assert_true(result.left[LAB_STAGE_AFTER][v.channel[c].channel].whiteness.p_value > 0.001);
  }
  assert_true(isnan(v.channel[0].residual[LAB_STAGE_AFTER][305]));
  assert_false(isnan(v.channel[1].residual[LAB_STAGE_AFTER][305]));
  assert_close(v.channel[0].measured[500] - v.channel[0].predicted[LAB_STAGE_AFTER][500],
               320 * v.channel[0].residual[LAB_STAGE_AFTER][500], 1e-6, 0);
  assert_close(v.argument[LAB_ARGUMENT_P][500], v.channel[0].measured[500], 2e3, 0);
  assert_close(v.argument[LAB_ARGUMENT_U][600], 0.5, 0, 0);
  lab_residual_table_free(&v);
}

/* A remark is cut where it is full: its last clause is no sentence. */
TEST(test_lab_report_undetermined__clause_that_was_cut__is_left_out)
{
  static lab_search_result outcome;
  lab_report s = {0};
  char text[LAB_FIT_UNDETERMINED_TEXT], *remark = outcome.fit.undetermined;
  size_t n = 0;
  s.result = &outcome;
  while (n + 1 < sizeof outcome.fit.undetermined) {
    snprintf(remark + n, sizeof outcome.fit.undetermined - n, "%sthe interval of unlisted_1.1 is wider", n ? "; " : "");
    n = strlen(remark);
  }
  lab_report_undetermined(&s, text);
  assert_string_equal(text + strlen(text) - strlen("; the interval of unlisted_1.1 is wider"),
                      "; the interval of unlisted_1.1 is wider");
}

TEST(test_lab_report_undetermined__clauses_on_instants__are_left_out)
{
  static lab_search_result outcome;
  lab_report s = {0};
  char text[LAB_FIT_UNDETERMINED_TEXT];
  s.result = &outcome;
  strcpy(outcome.fit.undetermined,
         "switch_3 is at its upper bound; dead_volume is at its lower bound; switch_4 and damping are hard "
         "to tell apart; damping has no effect on the data");
  lab_report_undetermined(&s, text);
  assert_string_equal(text, "dead_volume is at its lower bound; damping has no effect on the data");
  strcpy(outcome.fit.undetermined, "switch_3 is at its upper bound");
  lab_report_undetermined(&s, text);
  assert_string_equal(text, "");
}

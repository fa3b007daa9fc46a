/* From a log of the independent rig to report.html and its figures. */
#include "scratch.h"
#include "second/rig.h"

#include "../apps/lab/metrics/appraise.h"
#include "../apps/lab/report/report_html.h"

enum { ROWS = 1001 };
static const double spacing = 0.01; /* [s] */

static lab_error error;
static lab_rig rig;
static lab_log logged;
static lab_experiment experiment[2];
static lab_unknowns declared, completed;
static lab_loop_result result;
static lab_story story;
static lab_metrics measured, predicted;
static char *page;

/* ---- A story: the R1-400 with a leak that the rig file does not know of ---- */

static const char *write_log(const char *name)
{
  static const double t_cmd[] = {0.402, 2.503, 4.001, 5.507, 7.204}, u_cmd[] = {1, 0, -1, 0.5, -0.5};
  static double t[ROWS], u[ROWS], p[ROWS], x[ROWS];
  const char *path = scratch_path(name);
  second_rig g = second_rig_default_r1_400();
  second_log samples = {0};
  FILE *file = fopen(path, "w");
  int i;
  g.flow = SECOND_CHOKED;
  g.dead_volume = 4e-5;
  g.leak_area = 1.5e-8;
  g.pressure_noise = 320;
  g.position_noise = 2e-5;
  g.step = 5e-5;
  g.seed = 7;
  samples.t = t;
  samples.u = u;
  samples.p = p;
  samples.x = x;
  assert_int_equal(second_run(&g, t_cmd, u_cmd, 5, 10, spacing, &samples, NULL), 0);
  assert_non_null(file);
  fprintf(file, "t [s],u [1],p [Pa],x [m]\n");
  for (i = 0; i < ROWS; i++)
    if (i >= 300 && i < 310) /* a gap */
      fprintf(file, "%.3f,%g,,%.7f\n", t[i], u[i], x[i]);
    else
      fprintf(file, "%.3f,%g,%.1f,%.7f\n", t[i], u[i], p[i], x[i]);
  fclose(file);
  return path;
}

static void declare(void)
{
  lab_rig_default(&rig);
  strcpy(rig.name, "R1 <script>alert(\"1\")</script> & co");
  rig.laws.flow = PNEU_FLOW_CHOKED;
  rig.params.dead_volume = (pneu_real)4e-5;
  rig.params.spring_rate = (pneu_real)3.9e5;
  rig.noise[LAB_CHANNEL_P] = 320;
  rig.noise[LAB_CHANNEL_X] = 2e-5;
  rig.fit[rig.n_fit++] = LAB_FIT_ORIFICE_AREA;
  rig.fit[rig.n_fit++] = PNEU_PARAM_spring_rate;
}

/* Once for all tests, in a folder for all of them. */
static int tell_story(void **state)
{
  lab_loop_options options;
  if (scratch_open(state))
    return -1;
  declare();
  lab_loop_options_default(&options);
  options.max_effects = 1;
  assert_int_equal(lab_log_read(write_log("a&b.csv"), &rig.log, 101325, &logged, &error), LAB_OK);
  assert_int_equal(lab_experiment_open(&rig, &logged, 0, &experiment[0], &error), LAB_OK);
  assert_int_equal(lab_unknowns_open(&rig, experiment, 1, &declared, &error), LAB_OK);
  assert_int_equal(lab_unknowns_fit(&declared, LAB_FIT_WHOLE, NULL, &error), LAB_OK);
  completed = declared;
  assert_int_equal(lab_loop_run(&completed, &options, &result, &error), LAB_OK);
  story.rig = &rig;
  story.declared = &declared;
  story.completed = &completed;
  story.result = &result;
  story.measured = &measured;
  story.predicted = &predicted;
  assert_int_equal(lab_appraise(&completed, &measured, &predicted, &error), LAB_OK);
  return 0;
}

static int forget_story(void **state)
{
  free(page);
  lab_experiment_close(&experiment[0]);
  lab_log_free(&logged);
  return scratch_close(state);
}

/* Write the report into a folder. */
static void write_report(const lab_story *told, const char *folder)
{
  lab_evidence evidence;
  lab_figures figures;
  mkdir(folder, 0777);
  assert_int_equal(lab_evidence_collect(told, &evidence, &error), LAB_OK);
  assert_int_equal(lab_figures_draw(told, &evidence, &figures, &error), LAB_OK);
  assert_int_equal(lab_figures_write(&figures, folder, &error), LAB_OK);
  assert_int_equal(lab_report_html(told, &evidence, &figures, folder, &error), LAB_OK);
  lab_figures_free(&figures);
  lab_evidence_free(&evidence);
}

/* The page of the story; kept. */
static const char *the_page(void)
{
  if (!page) {
    write_report(&story, scratch_path("report"));
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

static void test_fault_of__bad_pages__are_seen(void **state)
{
  (void)state;
  assert_string_equal(fault_of("<!DOCTYPE html><p>a<br/><b>c</b></p>"), "");
  assert_string_not_equal(fault_of("<p>a<b>c</p></b>"), "");
  assert_string_not_equal(fault_of("<p>a"), "");
  assert_string_not_equal(fault_of("a</p>"), "");
  assert_string_equal(fault_of("<script><![CDATA[ if (a<b) c(); ]]></script>"), "");
}

static void test_lab_report_html__leak__page_is_well_formed(void **state)
{
  (void)state;
  assert_string_equal(fault_of(the_page()), "");
  assert_null(strstr(the_page(), "{{"));
}

static void test_lab_report_html__leak__needs_nothing_from_outside(void **state)
{
  static const char *const links[] = {"http:", "https:", "src=", "url(", "@import", "<link", "fetch(", "import("};
  size_t i;
  (void)state;
  for (i = 0; i < sizeof links / sizeof *links; i++) {
    check_note("%s", links[i]);
    assert_null(strstr(the_page(), links[i]));
  }
}

static int count(const char *text, const char *part)
{
  int n = 0;
  for (; (text = strstr(text, part)); text++)
    n++;
  return n;
}

static void test_lab_report_html__six_figures__ids_are_single_and_all_have_words(void **state)
{
  const char *at = the_page();
  (void)state;
  assert_int_equal(count(at, "<svg "), 6);
  assert_int_equal(count(at, "role=\"img\" aria-label=\""), 6);
  assert_int_equal(count(at, "aria-label=\"\""), 0);
  assert_int_equal(count(at, "<figure "), 6);
  while ((at = strstr(at, " id="))) {
    char id[96];
    snprintf(id, sizeof id, " id=%.*s%c", (int)strcspn(at + 5, "'\"") + 1, at + 4, at[4]);
    check_note("%s", id);
    assert_int_equal(count(the_page(), id), 1);
    at++;
  }
}

/* What the script reads curves from; to be deleted. */
static cJSON *readings_of(const char *text)
{
  static const char begin[] = "<script type=\"application/json\" id=\"readings\">";
  const char *from = strstr(text, begin);
  cJSON *readings;
  assert_non_null(from);
  readings = cJSON_ParseWithOpts(from + strlen(begin), NULL, 0);
  assert_non_null(readings);
  return readings;
}

/* A column of it as numbers, NaN for a gap.  Returns: how many */
static int column_of(const cJSON *readings, int number, double value[ROWS])
{
  const cJSON *column = cJSON_GetArrayItem(cJSON_GetObjectItem(readings, "columns"), number);
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

/* Every value that can be read off is that of its row, as far as its digits go. */
static void test_lab_report_html__readings__are_the_rows(void **state)
{
  static const char *const key[] = {"measured", "before", "after"};
  static double t[ROWS], value[ROWS];
  cJSON *readings = readings_of(the_page()), *panel;
  lab_evidence v;
  int c, k, i, n, gaps = 0;
  (void)state;
  assert_int_equal(lab_evidence_collect(&story, &v, &error), LAB_OK);
  for (c = 0; c < 2; c++) {
    const double *const rows[] = {v.channel[c].measured, v.channel[c].predicted[LAB_STAGE_BEFORE],
                                  v.channel[c].predicted[LAB_STAGE_AFTER]};
    const double scale = c ? 1e3 : 1e-3;
    panel = cJSON_GetArrayItem(cJSON_GetObjectItem(cJSON_GetObjectItem(readings, "panels"), "response"), 1 + c);
    assert_string_equal(cJSON_GetObjectItem(panel, "unit")->valuestring, c ? "mm" : "kPa");
    n = column_of(readings, cJSON_GetObjectItem(panel, "at")->valueint, t);
    assert_true(n > 500);
    for (k = 0; k < 3; k++) {
      const cJSON *curve = cJSON_GetArrayItem(cJSON_GetObjectItem(panel, "curves"), k);
      assert_string_equal(cJSON_GetObjectItem(curve, "key")->valuestring, key[k]);
      assert_int_equal(column_of(readings, cJSON_GetObjectItem(curve, "of")->valueint, value), n);
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
  lab_evidence_free(&v);
  cJSON_Delete(readings);
}

/* ---- Content ---- */

static void test_lab_report_html__leak__says_what_was_found(void **state)
{
  char sentence[512], heading[600];
  (void)state;
  lab_story_sentence(&story, sentence, sizeof sentence);
  snprintf(heading, sizeof heading, "<h1>%s</h1>", sentence);
  assert_contains(the_page(), heading);
  assert_contains(the_page(), "chamber_leak");
  assert_contains(the_page(), pneu_effect_at(result.found[0].effect)->footprint);
  assert_contains(the_page(), " kPa");
  assert_contains(the_page(), " mm²");
  assert_contains(the_page(), "<td>absent</td>");
  assert_contains(the_page(), "<span class=\"large\">");
  assert_contains(the_page(), "chamber_leak is more than chance: p-value");
  assert_contains(the_page(), "See on the rig whether it is so: Air leaves the chamber through a hole.");
}

/* The log has no full stroke, so that its figures are reasons. */
static void test_lab_report_html__figures_of_merit__or_why_not(void **state)
{
  lab_story without = story;
  char *text;
  (void)state;
  assert_contains(the_page(), "<h2>Figures of merit</h2>");
  assert_contains(the_page(), "<code>air_mass</code>: the record has no mass flow");
  assert_contains(the_page(), "Steps are of the opening of the transducer");
  without.measured = NULL;
  write_report(&without, scratch_path("without"));
  text = scratch_read(scratch_path("without/report.html"));
  assert_null(strstr(text, "Figures of merit"));
  free(text);
}

static void test_lab_report_html__names_of_files_and_rigs__are_escaped(void **state)
{
  (void)state;
  assert_contains(the_page(), "R1 &lt;script&gt;alert(&quot;1&quot;)&lt;/script&gt; &amp; co");
  assert_contains(the_page(), "a&amp;b.csv");
}

static void test_lab_report_html__twice__same_bytes(void **state)
{
  static const char *const names[] = {"report.html",         "response.svg",   "residual.svg",  "arguments.svg",
                                      "autocorrelation.svg", "candidates.svg", "parameters.svg"};
  size_t i;
  (void)state;
  (void)the_page();
  write_report(&story, scratch_path("again"));
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
    free(a);
    free(b);
  }
}

static void test_lab_report_html__nothing_found_two_runs__is_told_as_well(void **state)
{
  static lab_unknowns both;
  static lab_loop_result nothing;
  lab_story told = story;
  char *text;
  (void)state;
  experiment[1] = experiment[0];
  assert_int_equal(lab_unknowns_open(&rig, experiment, 2, &both, &error), LAB_OK);
  assert_int_equal(lab_loop_errors(&both, &nothing.before, &error), LAB_OK);
  nothing.after = nothing.before;
  nothing.fit.n = both.n;
  nothing.verdict = LAB_VERDICT_UNDECIDED;
  told.declared = told.completed = &both;
  told.result = &nothing;
  write_report(&told, scratch_path("nothing"));
  text = scratch_read(scratch_path("nothing/report.html"));
  assert_string_equal(fault_of(text), "");
  assert_contains(text, "2002 rows in 2 runs");
  assert_contains(text, "runs one after the other");
  assert_contains(text, "\"runs\":[{\"entry\":0,\"shift\":0},{\"entry\":");
  assert_contains(text, "Undecided");
  assert_null(strstr(text, "completed model"));
  free(text);
}

/* ---- Evidence ---- */

static void test_lab_evidence_collect__leak__white_only_when_completed(void **state)
{
  lab_evidence v;
  int c;
  (void)state;
  assert_int_equal(lab_evidence_collect(&story, &v, &error), LAB_OK);
  assert_int_equal(v.n, ROWS);
  assert_int_equal(v.n_channels, 2);
  for (c = 0; c < 2; c++) {
    assert_true(v.channel[c].whiteness[LAB_STAGE_BEFORE].p_value < 1e-6);
    assert_true(v.channel[c].whiteness[LAB_STAGE_AFTER].p_value > 0.001);
  }
  assert_true(isnan(v.channel[0].residual[LAB_STAGE_AFTER][305]));
  assert_false(isnan(v.channel[1].residual[LAB_STAGE_AFTER][305]));
  assert_close(v.channel[0].measured[500] - v.channel[0].predicted[LAB_STAGE_AFTER][500],
               320 * v.channel[0].residual[LAB_STAGE_AFTER][500], 1e-6, 0);
  assert_close(v.argument[LAB_ARGUMENT_P][500], v.channel[0].measured[500], 2e3, 0);
  assert_close(v.argument[LAB_ARGUMENT_U][600], 0.5, 0, 0);
  lab_evidence_free(&v);
}

static void test_lab_story_undetermined__clauses_on_instants__are_left_out(void **state)
{
  static lab_loop_result outcome;
  lab_story s = {0};
  char text[LAB_FIT_REMARK];
  (void)state;
  s.result = &outcome;
  strcpy(outcome.fit.remark,
         "switch_3 is at its upper bound; dead_volume is at its lower bound; switch_4 and damping are hard "
         "to tell apart; damping has no effect on the data");
  lab_story_undetermined(&s, text);
  assert_string_equal(text, "dead_volume is at its lower bound; damping has no effect on the data");
  strcpy(outcome.fit.remark, "switch_3 is at its upper bound");
  lab_story_undetermined(&s, text);
  assert_string_equal(text, "");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_fault_of__bad_pages__are_seen),
      cmocka_unit_test(test_lab_report_html__leak__page_is_well_formed),
      cmocka_unit_test(test_lab_report_html__leak__needs_nothing_from_outside),
      cmocka_unit_test(test_lab_report_html__six_figures__ids_are_single_and_all_have_words),
      cmocka_unit_test(test_lab_report_html__readings__are_the_rows),
      cmocka_unit_test(test_lab_report_html__leak__says_what_was_found),
      cmocka_unit_test(test_lab_report_html__figures_of_merit__or_why_not),
      cmocka_unit_test(test_lab_report_html__names_of_files_and_rigs__are_escaped),
      cmocka_unit_test(test_lab_report_html__twice__same_bytes),
      cmocka_unit_test(test_lab_report_html__nothing_found_two_runs__is_told_as_well),
      cmocka_unit_test(test_lab_evidence_collect__leak__white_only_when_completed),
      cmocka_unit_test(test_lab_story_undetermined__clauses_on_instants__are_left_out),
  };
  return cmocka_run_group_tests(tests, tell_story, forget_story);
}

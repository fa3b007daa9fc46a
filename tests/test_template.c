/* apps/lab/base/template and svginline: from values and drawings to text. */
#include "check.h"

#include "../apps/lab/report/svginline.h"
#include "../apps/lab/base/template.h"

static lab_error error;

/* What a template makes of values in JSON; to be freed. */
static char *filled(const char *template, const char *values)
{
  cJSON *object = cJSON_Parse(values);
  char *text = NULL;
  size_t size;
  FILE *file = open_memstream(&text, &size);
  assert_non_null(object);
  assert_int_equal(lab_template_write(file, template, object, &error), LAB_OK);
  fclose(file);
  cJSON_Delete(object);
  return text;
}

static void assert_filled(const char *template, const char *values, const char *want)
{
  char *got = filled(template, values);
  assert_string_equal(got, want);
  free(got);
}

static void test_lab_template_write__text__is_escaped_unless_asked(void **state)
{
  const char values[] = "{\"a\": \"<b> & \\\"it's\\\"\"}";
  (void)state;
  assert_filled("[{{a}}]", values, "[&lt;b&gt; &amp; &quot;it&#39;s&quot;]");
  assert_filled("[{{{a}}}]", values, "[<b> & \"it's\"]");
  assert_filled("[{{b}}]", values, "[]");
  assert_filled("css { a { b } }", values, "css { a { b } }");
}

static void test_lab_template_write__sections__repeat_and_vanish(void **state)
{
  (void)state;
  assert_filled("{{#l}}<{{a}}{{b}}>{{/l}}.", "{\"b\": \"x\", \"l\": [{\"a\": \"1\"}, {\"a\": \"2\", \"b\": \"y\"}]}",
                "<1x><2y>.");
  assert_filled("{{#l}}{{.}},{{/l}}", "{\"l\": [\"p\", \"<\"]}", "p,&lt;,");
  assert_filled("{{#l}}no{{/l}}{{^l}}none{{/l}}", "{\"l\": []}", "none");
  assert_filled("{{#s}}{{s}}!{{/s}}{{^s}}none{{/s}}", "{\"s\": \"yes\"}", "yes!");
  assert_filled("{{#s}}{{s}}!{{/s}}{{^s}}none{{/s}}", "{\"s\": \"\"}", "none");
  assert_filled("{{#a}}{{#a}}{{x}}{{/a}}{{/a}}", "{\"a\": {\"x\": \"1\"}}", "1");
  assert_filled("{{#l}}\n{{.}}\n{{/l}}\nend\n", "{\"l\": [\"1\", \"2\"]}", "1\n2\nend\n");
}

static void test_lab_template_write__open_tags__are_errors(void **state)
{
  static const char *const bad[] = {"{{a", "{{#a}} x", "{{#a}}{{/b}}", "{{/a}}", "{{{a}}"};
  cJSON *object = cJSON_Parse("{\"a\": \"x\"}");
  FILE *file = tmpfile();
  size_t i;
  (void)state;
  for (i = 0; i < sizeof bad / sizeof *bad; i++) {
    check_note("%s", bad[i]);
    assert_int_equal(lab_template_write(file, bad[i], object, &error), LAB_DATA);
  }
  fclose(file);
  cJSON_Delete(object);
}

static const char drawing[] = "<?xml version=\"1.0\"?>\n<svg \n width=\"8\" height=\"4\"\n viewBox=\"0 0 8 4\"\n "
                              "xmlns=\"http://www.w3.org/2000/svg\">\n<title>f</title>\n<g id=\"canvas\"><circle "
                              "id='dot'/><title>tip</title><use xlink:href='#dot'/>text id=x</g>\n</svg>\n";

/* As gnuplot writes groups, colours and curves. */
static const char curves[] =
    "<svg viewBox=\"0 0 80 40\">\n<g id=\"canvas\"><rect fill=\"#ffffff\"/>\n<g fill=\"none\" color=\"black\" "
    "stroke=\"currentColor\">\n</g>\n<g id=\"f_plot_1a\" ><title>before</title>\n<path stroke='rgb(  0, 114, "
    "178)'/><path stroke='rgb(1,2,3)'/></g>\n<g id=\"f_plot_2a\" ><title>$a using 1</title>\n</g>\n</g>\n</svg>\n";

static void test_lab_svg_inline__drawing__own_ids_and_words(void **state)
{
  char *got = lab_svg_inline(drawing, "fig", "a < b", 0);
  (void)state;
  assert_string_equal(got,
                      "<svg viewBox=\"0 0 8 4\" role=\"img\" aria-label=\"a &lt; b\">\n<g id=\"fig_canvas\"><circle "
                      "id='fig_dot'/><use href='#fig_dot'/>text id=x</g>\n</svg>\n");
  free(got);
  assert_null(lab_svg_inline("no drawing", "fig", "", 0));
}

static void test_lab_svg_inline__curves__have_classes_and_the_pages_colours(void **state)
{
  char *got = lab_svg_inline(curves, "fig", "1", 10);
  (void)state;
  assert_string_equal(got, "<svg viewBox=\"0 10 80 30\" role=\"img\" aria-label=\"1\">\n<g "
                           "id=\"fig_canvas\"><rect fill=\"none\"/>\n<g class=\"c-before\">\n<path "
                           "stroke='var(--f-blue)'/><path stroke='rgb(1,2,3)'/></g>\n<g>\n</g>\n</g>\n</svg>\n");
  free(got);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_lab_template_write__text__is_escaped_unless_asked),
      cmocka_unit_test(test_lab_template_write__sections__repeat_and_vanish),
      cmocka_unit_test(test_lab_template_write__open_tags__are_errors),
      cmocka_unit_test(test_lab_svg_inline__drawing__own_ids_and_words),
      cmocka_unit_test(test_lab_svg_inline__curves__have_classes_and_the_pages_colours),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* apps/lab/base/template: from values to text. */
#include "../../words.h"

#include "../../../apps/lab/base/json.h"
#include "../../../apps/lab/base/template.h"

/* What a template makes of values in JSON; to be freed. */
static char *filled(const char *template, const char *values)
{
  cJSON *object = cJSON_Parse(values);
  char *text = NULL;
  size_t size;
  FILE *file = open_memstream(&text, &size);
  assert_non_null(object);
  succeed(lab_template_write(file, template, object, &error));
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

TEST(test_lab_template_write__text__is_escaped_unless_asked)
{
  const char values[] = "{\"a\": \"<b> & \\\"it's\\\"\"}";
  assert_filled("[{{a}}]", values, "[&lt;b&gt; &amp; &quot;it&#39;s&quot;]");
  assert_filled("[{{{a}}}]", values, "[<b> & \"it's\"]");
  assert_filled("[{{b}}]", values, "[]");
  assert_filled("css { a { b } }", values, "css { a { b } }");
}

TEST(test_lab_template_write__sections__repeat_and_vanish)
{
  assert_filled("{{#l}}<{{a}}{{b}}>{{/l}}.", "{\"b\": \"x\", \"l\": [{\"a\": \"1\"}, {\"a\": \"2\", \"b\": \"y\"}]}",
                "<1x><2y>.");
  assert_filled("{{#l}}{{.}},{{/l}}", "{\"l\": [\"p\", \"<\"]}", "p,&lt;,");
  assert_filled("{{#l}}no{{/l}}{{^l}}none{{/l}}", "{\"l\": []}", "none");
  assert_filled("{{#s}}{{s}}!{{/s}}{{^s}}none{{/s}}", "{\"s\": \"yes\"}", "yes!");
  assert_filled("{{#s}}{{s}}!{{/s}}{{^s}}none{{/s}}", "{\"s\": \"\"}", "none");
  assert_filled("{{#a}}{{#a}}{{x}}{{/a}}{{/a}}", "{\"a\": {\"x\": \"1\"}}", "1");
  assert_filled("{{#l}}\n{{.}}\n{{/l}}\nend\n", "{\"l\": [\"1\", \"2\"]}", "1\n2\nend\n");
}

TEST(test_lab_template_write__open_tags__are_errors)
{
  static const char *const bad[] = {"{{a", "{{#a}} x", "{{#a}}{{/b}}", "{{/a}}", "{{{a}}"};
  cJSON *object = cJSON_Parse("{\"a\": \"x\"}");
  FILE *file = tmpfile();
  size_t i;
  for (i = 0; i < sizeof bad / sizeof *bad; i++) {
    check_note("%s", bad[i]);
    assert_int_equal(lab_template_write(file, bad[i], object, &error), LAB_DATA);
  }
  fclose(file);
  cJSON_Delete(object);
}

TEST(test_lab_page_join__items_shown_one_behind_the_other__have_it_between)
{
  const char *const pieces[] = {"<{{#l}}", "{{{.}}}", "{{/l}}>", NULL};
  char *template = lab_template_text(pieces), *values;
  cJSON *object = cJSON_CreateObject(), *list = cJSON_AddArrayToObject(object, "l");
  lab_json_join(list, "; ", "%d", 1);
  lab_json_join(list, "; ", "%s", "two");
  values = cJSON_PrintUnformatted(object);
  assert_filled(template, values, "<1; two>");
  free(values);
  free(template);
  cJSON_Delete(object);
}

/* Under a list that is not there nothing is made, so that nothing is lost. */
TEST(test_lab_page_append__no_list__nothing)
{
  assert_null(lab_json_append(NULL));
  lab_json_put(NULL, "a", "%d", 1);
  lab_json_say(NULL, "%d", 1);
}

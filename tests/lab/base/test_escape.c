/* apps/lab/base/escape, and who uses it: names that try to be code, in every kind of file. */
#include "../../scratch.h"

#include <ctype.h>

#include <libconfig.h>

#include "../../../apps/lab/base/escape.h"
#include "../../../apps/lab/base/json.h"
#include "../../../apps/lab/base/gnuplot.h"
#include "../../../apps/lab/batch/batchrow.h"
#include "../../../apps/lab/base/csv.h"
#include "../../../apps/lab/rig/rig.h"

#define LONG_NAME                                                                                                      \
  "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef"   \
  "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef"   \
  "0123456789abcdef0123456789abcde"

/* Names of strangers; the first ones are names that must work. */
static const char *const names[] = {"press 2",
                                    "hall 2/press 1",
                                    "Dr\u00FCcker \xE2\x84\x96 7",
                                    "=1+1",
                                    "+1",
                                    "-1",
                                    "@SUM(A1)",
                                    "=cmd|' /C calc'!A0",
                                    "\t=1",
                                    "\uFF1D1+1",
                                    "it's \"quoted\"",
                                    "`touch hit`",
                                    "$(touch hit)",
                                    "%n%s%n",
                                    "<svg onload=alert(1)>",
                                    "</script><script>alert(1)</script>",
                                    "' onmouseover='alert(1)",
                                    "a\nb",
                                    "a\r\n=1+1",
                                    "\u202Egpj.exe",
                                    "\u2066turned",
                                    "../../etc/passwd",
                                    "/etc/passwd",
                                    "..",
                                    ".",
                                    "\\\\host\\share",
                                    "\xFF\xFE",
                                    "caf\xE9",
                                    "\xC0\xAF",
                                    "\xED\xA0\x80",
                                    "\xF4\x90\x80\x80",
                                    "\xE2\x82",
                                    "*/ int x; /*",
                                    "/*",
                                    "// */",
                                    "\x1B[2J",
                                    "\x7F",
                                    "\xC2\x85",
                                    "@include \"/etc/passwd\"",
                                    "a\\",
                                    "{{rig}}",
                                    "]]>",
                                    "&lt;",
                                    "';system('touch hit');'",
                                    LONG_NAME};
enum { NAMES = sizeof names / sizeof *names };

/* What a writer makes of a name; to be freed. */
static char *written(void (*put)(FILE *, const char *), const char *name)
{
  char *text = NULL;
  size_t size;
  FILE *file = open_memstream(&text, &size);
  assert_non_null(file);
  put(file, name);
  assert_int_equal(fclose(file), 0);
  return text;
}

static void assert_written(void (*put)(FILE *, const char *), const char *name, const char *want)
{
  char *got = written(put, name);
  assert_string_equal(got, want);
  free(got);
}

/* Each name in turn, with what is written of it. */
static void for_each_name(void (*put)(FILE *, const char *), void (*look)(const char *name, const char *text))
{
  int i;
  for (i = 0; i < NAMES; i++) {
    char *text = written(put, names[i]);
    check_note("name %d", i);
    look(names[i], text);
    free(text);
  }
}

/* ---- Plain text ---- */

TEST(test_lab_is_plain__utf8_without_control__is)
{
  static const char *const plain[] = {"",
                                      "press 2",
                                      "\xC3\xBC",
                                      "\xE2\x84\x96",
                                      "\xF0\x9F\x94\xA7",
                                      "\xEE\x80\x80",
                                      "\xE2\x80\x8F\xD7\x90" /* a mark that turns nothing but itself */};
  static const char *const not_plain[] = {
      "a\nb",         "\x1B[2J",      "\x7F",         "\xC2\x9B",         "\xFF",
      "caf\xE9",      "\xC0\xAF",     "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE2\x82",
      "\xE2\x80\xAE", "\xE2\x81\xA9", "\xE2\x80\xA8", "\xEF\xBF\xBF",     "\xF8\x88\x80\x80\x80"};
  size_t i;
  for (i = 0; i < sizeof plain / sizeof *plain; i++)
    assert_true(lab_is_plain(plain[i]));
  for (i = 0; i < sizeof not_plain / sizeof *not_plain; i++) {
    check_note("text %d", (int)i);
    assert_false(lab_is_plain(not_plain[i]));
  }
}

TEST(test_lab_make_plain__any_name__is_plain_and_as_long)
{
  int i;
  for (i = 0; i < NAMES; i++) {
    char text[300];
    strcpy(text, names[i]);
    lab_make_plain(text);
    assert_true(lab_is_plain(text));
    assert_int_equal(strlen(text), strlen(names[i]));
    assert_int_equal(!strcmp(text, names[i]), lab_is_plain(names[i]));
  }
}

TEST(test_lab_fail__any_name__makes_a_plain_message)
{
  int i;
  for (i = 0; i < NAMES; i++) {
    lab_fail(&error, LAB_DATA, "%s: words", names[i]);
    assert_true(lab_is_plain(error.text));
    lab_fail_in(&error, "%s", names[i]);
    assert_true(lab_is_plain(error.text));
  }
}

/* ---- Paths ---- */

TEST(test_lab_make_file_name__any_name__is_one_part_of_a_path)
{
  int i;
  for (i = 0; i < NAMES; i++) {
    char text[300];
    strcpy(text, names[i]);
    lab_make_file_name(text);
    assert_null(strpbrk(text, "/\\"));
    assert_true(*text && *text != '.');
  }
}

/* ---- HTML, SVG ---- */

static void look_at_html(const char *name, const char *text)
{
  const char *at;
  (void)name;
  assert_null(strpbrk(text, "<>\"'"));
  for (at = text; (at = strchr(at, '&')); at++)
    assert_true(!strncmp(at, "&amp;", 5) || !strncmp(at, "&lt;", 4) || !strncmp(at, "&gt;", 4) ||
                !strncmp(at, "&quot;", 6) || !strncmp(at, "&#39;", 5));
  for (at = text; *at; at++)
    assert_true((unsigned char)*at >= ' ' || *at == '\n' || *at == '\t');
}

TEST(test_lab_put_html__any_name__is_text)
{
  for_each_name(lab_put_html, look_at_html);
  assert_written(lab_put_html, "<b> & \"it's\"", "&lt;b&gt; &amp; &quot;it&#39;s&quot;");
  assert_written(lab_put_html, "Dr\u00FCcker", "Dr\u00FCcker");
  assert_written(lab_put_html, "caf\xE9 \xE2\x80\xAE", "caf\xEF\xBF\xBD \xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
}

static void look_at_address(const char *name, const char *text)
{
  (void)name;
  for (; *text; text++)
    assert_true(isalnum((unsigned char)*text) || strchr("-._~/%", *text));
}

TEST(test_lab_put_address__any_name__is_an_address)
{
  for_each_name(lab_put_address, look_at_address);
  assert_written(lab_put_address, "50 %/\xC3\xBC", "50%20%25/%C3%BC");
}

/* ---- CSV ---- */

static void look_at_cell(const char *name, const char *text)
{
  char line[800];
  lab_cell cell[3];
  snprintf(line, sizeof line, "%s,end", text);
  assert_null(strpbrk(line, "\r\n\t"));
  assert_int_equal(lab_csv_cells(line, line + strlen(line), ',', cell, 3), 2);
  assert_null(strchr("=+-@", *cell[0].begin));
  if (lab_is_plain(name))
    assert_string_equal(cell[0].begin + (*cell[0].begin == '\''), name + (*name == '\''));
}

TEST(test_lab_put_users_cell__any_name__is_no_formula)
{
  for_each_name(lab_put_users_cell, look_at_cell);
  assert_written(lab_put_users_cell, "press 2", "press 2");
  assert_written(lab_put_users_cell, "=1+1", "'=1+1");
  assert_written(lab_put_users_cell, "\t=1", "' =1");
  assert_written(lab_put_users_cell, "\uFF1D1", "'\uFF1D1");
  assert_written(lab_put_users_cell, "-5 bar, \"cold\"", "\"'-5 bar, \"\"cold\"\"\"");
}

TEST(test_lab_put_cell__own_words__are_quoted_where_they_must)
{
  assert_written(lab_put_cell, "-1.5 Pa", "-1.5 Pa");
  assert_written(lab_put_cell, "a,b", "\"a,b\"");
  assert_written(lab_put_cell, "a\"b", "\"a\"\"b\"");
  assert_written(lab_put_cell, "a\nb", "\"a b\"");
  assert_written(lab_put_cell, "", "");
}

/* The message of a line begins with the name of a file. */
TEST(test_lab_row_error__file_named_as_a_formula__is_no_formula)
{
  lab_outcome outcome;
  lab_fail(&error, LAB_DATA, "=1+1.csv: there is no such file");
  lab_row_error(&error, &outcome);
  assert_contains(outcome.row, ",'=1+1.csv: there is no such file");
}

/* ---- libconfig ---- */

static void look_at_config(const char *name, const char *text)
{
  char line[1400];
  const char *got, *c;
  config_t config;
  for (c = text; *c; c++)
    assert_false(iscntrl((unsigned char)*c));
  snprintf(line, sizeof line, "s = %s;\n", text);
  config_init(&config);
  assert_int_equal(config_read_string(&config, line), CONFIG_TRUE);
  assert_int_equal(config_lookup_string(&config, "s", &got), CONFIG_TRUE);
  assert_string_equal(got, name);
  config_destroy(&config);
}

TEST(test_lab_put_config__any_name__comes_back)
{
  for_each_name(lab_put_config, look_at_config);
}

/* ---- C ---- */

static void look_at_comment(const char *name, const char *text)
{
  (void)name;
  assert_null(strstr(text, "*/"));
  assert_null(strstr(text, "/*"));
  assert_null(strpbrk(text, "\r\n"));
}

TEST(test_lab_put_comment__any_name__stays_in_the_comment)
{
  for_each_name(lab_put_comment, look_at_comment);
}

/* ---- JSON ---- */

/* What is written; root is freed. */
static char *document(cJSON *root)
{
  char *text = NULL;
  size_t size;
  FILE *file = open_memstream(&text, &size);
  assert_non_null(file);
  succeed(lab_json_write(file, root, "a test", &error));
  fclose(file);
  return text;
}

TEST(test_lab_json_write__any_name__comes_back_plain)
{
  int i;
  for (i = 0; i < NAMES; i++) {
    cJSON *root = cJSON_CreateObject(), *list = cJSON_AddArrayToObject(root, "list"), *again;
    char want[300], *text;
    cJSON_AddItemToArray(list, cJSON_CreateString(names[i]));
    text = document(root);
    strcpy(want, names[i]);
    lab_make_plain(want);
    again = cJSON_Parse(text);
    assert_non_null(again);
    assert_string_equal(cJSON_GetArrayItem(cJSON_GetObjectItem(again, "list"), 0)->valuestring, want);
    cJSON_Delete(again);
    free(text);
  }
}

TEST(test_lab_json_write__numbers__have_nine_digits_or_are_null)
{
  const double number[] = {4.000000000000001e-05, 0.1 + 0.2, -123456789.123, 2.0 / 3.0, 1e-300, 5, NAN, -INFINITY};
  char *text = document(cJSON_CreateDoubleArray(number, sizeof number / sizeof *number));
  assert_string_equal(text, "[4e-05, 0.3, -123456789, 0.666666667, 1e-300, 5, null, null]\n");
  free(text);
}

/* ---- gnuplot ---- */

/* A folder of each name has a table that is found and drawn; nothing is run. */
TEST(test_lab_gnuplot_draw__folder_of_any_name__is_found)
{
  char here[1024];
  int i;
  assert_non_null(getcwd(here, sizeof here));
  scratch_text("draw.gp", "set terminal svg\nplot IN.'/t.csv' using 1:2\n");
  assert_int_equal(chdir(scratch_folder), 0);
  for (i = 0; i < NAMES; i++) {
    char folder[300], table[320];
    FILE *file;
    snprintf(folder, sizeof folder, "%s", i % 2 ? "< touch hit;" : "| touch hit;");
    strncat(folder, names[i], sizeof folder - strlen(folder) - 1);
    lab_make_file_name(folder);
    folder[120] = '\0';
    mkdir(folder, 0777);
    snprintf(table, sizeof table, "%s/t.csv", folder);
    file = fopen(table, "w");
    assert_non_null(file);
    fputs("1 2\n3 4\n", file);
    fclose(file);
    if (lab_gnuplot_draw("draw.gp", folder, "out.svg", &error) && !strpbrk(folder, "\r\n"))
      fail_msg("%s", error.text);
    assert_false(scratch_exists("hit"));
    remove(table);
    rmdir(folder);
  }
  assert_int_equal(chdir(here), 0);
}

/* ---- Rig files ---- */

TEST(test_lab_rig_read__any_name__is_read_or_refused)
{
  int i;
  for (i = 0; i < NAMES; i++) {
    char *quoted = written(lab_put_config, names[i]), text[1400];
    lab_rig rig;
    snprintf(text, sizeof text, "actuator = {\n  name = %s; };\n", quoted);
    free(quoted);
    check_note("name %d", i);
    if (lab_rig_read(scratch_text("rig.cfg", text), &rig, &error) == LAB_OK) {
      assert_true(lab_is_plain(names[i]));
      assert_string_equal(rig.name, names[i]);
    } else {
      assert_true(!lab_is_plain(names[i]) || strlen(names[i]) >= LAB_NAME_TEXT);
      assert_contains(error.text, "rig.cfg:2: actuator.name: expected a ");
    }
  }
}

/* A file's name may be anything; what a rig is called by it is not. */
TEST(test_lab_rig_read__file_of_any_name__has_a_plain_one)
{
  int i;
  for (i = 0; i < NAMES; i++) {
    char file[300];
    lab_rig rig;
    strcpy(file, names[i]);
    lab_make_file_name(file);
    file[200] = '\0';
    strcat(file, ".cfg");
    if (lab_rig_read(scratch_text(file, "actuator = { };\n"), &rig, &error))
      fail_msg("%s", error.text);
    assert_true(lab_is_plain(rig.name) && *rig.name);
  }
}

/* apps/lab/rig/rig and rigwrite, apps/lab/log/logformat: whatever rig file is accepted, what is written of
 * it is read as the same rig. Files are drawn by the keys that they may have, with values at the ends of what is
 * allowed. */
#include "../../rigfile.h"

#include "../../../apps/lab/base/escape.h"
#include "../../../apps/lab/base/number.h"
#include "../../../apps/lab/rig/rigkeys.h"
#include "../../../apps/lab/rig/rigterm.h"

enum { RIGS = 4000 };

static lab_rig rig, again;

/* ---- Draws ---- */

static uint64_t seed = 1;

/* 0 <= draw(n) < n, by Knuth's MMIX generator */
static int draw(int n)
{
  seed = seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
  return (int)((seed >> 33) % (uint64_t)n);
}

/* Numbers that are hard to write. */
static double odd_number(void)
{
  static const double odd[] = {0,
                               -0.0,
                               1,
                               -1,
                               0.1,
                               1.0 / 3,
                               5e-324,
                               2.2250738585072014e-308,
                               1.7976931348623157e308,
                               -1.7976931348623157e308,
                               2147483647,
                               2147483648.0,
                               -2147483649.0,
                               1e10,
                               9007199254740993.0,
                               1e16,
                               1e22,
                               -273.15,
                               4e14,
                               1e300,
                               123456789012345680.0};
  return odd[draw(sizeof odd / sizeof *odd)];
}

static double between(double lower, double upper)
{
  const double low = isfinite(lower) ? lower : -1e12, high = isfinite(upper) ? upper : 1e12;
  const double share[] = {0, 1, 1.0 / 3, 0.5, 1e-9, 1e-17};
  double value = odd_number();
  if (draw(4) == 0 && value >= lower && value <= upper)
    return value;
  value = low + share[draw(6)] * (high - low);
  return value < low ? low : value > high ? high : value;
}

static const char *odd_text(void)
{
  static const char *const odd[] = {"bench 3",
                                    "hall 2/press 1",
                                    "\"quoted\"",
                                    "back\\slash",
                                    "\\\"",
                                    "\\x41",
                                    "// no comment",
                                    "/* no comment */",
                                    "# no comment",
                                    "@include \"/etc/passwd\"",
                                    "a;b",
                                    "}; fit = (",
                                    "\xC3\xBC\xE2\x84\x96",
                                    "%s%n",
                                    "tab",
                                    "'",
                                    "\\",
                                    " blanks ",
                                    "-"};
  return odd[draw(sizeof odd / sizeof *odd)];
}

/* A character that may separate, as text. */
static const char *odd_mark(void)
{
  static char mark[2];
  mark[0] = (char)(1 + draw(255));
  return mark;
}

/* ---- Pieces of a file ---- */

/* `value unit` in quotes, or the bare number. */
static void put_value(FILE *file, double value, const char *unit)
{
  char number[LAB_NUMBER_TEXT];
  lab_number_write(value, number);
  if (draw(3) || strpbrk(number, ".e"))
    fprintf(file, "\"%s %s\"", number, unit);
  else
    fprintf(file, "%s.0", number);
}

static void put_text(FILE *file, const char *key, const char *text)
{
  fprintf(file, " %s = ", key);
  lab_put_config(file, text);
  fputc(';', file);
}

static void put_param(FILE *file, const char *key, int param)
{
  pneu_param_info info;
  pneu_param_describe(param, &info);
  fprintf(file, " %s = ", key);
  put_value(file, between((double)info.lower, (double)info.upper), info.unit);
  fputc(';', file);
}

/* A column that is not taken may have any word for its unit. */
static void put_column(FILE *file, const char *name)
{
  char text[LAB_COLUMN_TEXT];
  snprintf(text, sizeof text, "%s [%.40s]", name, odd_text());
  lab_put_config(file, text);
}

/* ---- Groups ---- */

static void put_keys(FILE *file)
{
  const char *group = "";
  int i;
  for (i = 0; i < lab_key_count; i++) {
    const lab_key *key = &lab_keys[i];
    if (strcmp(group, key->group) != 0)
      fprintf(file, "%s%s = {", *group ? " };\n" : "", key->group);
    group = key->group;
    if (key->kind == LAB_KEY_PARAM && draw(3) == 0)
      put_param(file, key->key, key->param);
    else if (key->kind == LAB_KEY_NAME && draw(2))
      put_text(file, key->key, odd_text());
    else if (key->kind == LAB_KEY_WORD && draw(8))
      put_text(file, key->key, key->words[draw(key->n)]);
  }
  fputs(" };\n", file);
}

static void put_effect(FILE *file)
{
  const int e = draw(PNEU_EFFECT_COUNT);
  int i, count, first = pneu_effect_params(e, &count);
  fprintf(file, "effects = { %s = {", pneu_effect_at(e)->name);
  for (i = first; i < first + count; i++) {
    pneu_param_info info;
    pneu_param_describe(i, &info);
    put_param(file, info.name, i);
  }
  fputs(" }; };\n", file);
}

static void put_term(FILE *file)
{
  const lab_term_word *equation = &lab_term_equations[draw(PNEU_TERM_EQUATION_COUNT)];
  const lab_term_word *argument = &lab_term_arguments[draw(PNEU_TERM_ARGUMENT_COUNT)];
  const int n = 2 + 2 * draw(2);
  int i;
  fprintf(file, "unlisted = ( { equation = \"%s\"; argument = \"%s\"; from = ", equation->key, argument->key);
  put_value(file, draw(2) ? 0 : -1.0 / 3, argument->unit);
  fputs("; to = ", file);
  put_value(file, between(1e-9, 1e6), argument->unit);
  fputs("; values = (", file);
  for (i = 0; i < n; i++) {
    fputs(i ? ", " : " ", file);
    put_value(file, odd_number(), equation->unit);
  }
  fputs(" ); } );\n", file);
}

static void put_channels(FILE *file, const char *key, int with_unit)
{
  const int c = LAB_CHANNEL_P + draw(LAB_CHANNEL_COUNT - LAB_CHANNEL_P);
  fprintf(file, " %s = { %s = ", key, lab_channels[c].key);
  put_value(file, odd_number(), with_unit ? lab_channels[c].unit : "1");
  fputs("; };", file);
}

static void put_window(FILE *file)
{
  fputs(" window = ( ", file);
  put_value(file, between(-1e9, 0), "s");
  fputs(", ", file);
  put_value(file, between(1, 1e300), "s");
  fputs(" );", file);
}

/* Columns, and weights for them. */
static void put_columns(FILE *file)
{
  const int n = 1 + draw(5);
  int i;
  fputs(" columns = (", file);
  for (i = 0; i < n; i++) {
    fputs(i ? ", " : " ", file);
    put_column(file, "-");
  }
  fputs(" );", file);
  if (draw(2))
    return;
  fputs(" weights = (", file);
  for (i = 0; i < n; i++) {
    fputs(i ? ", " : " ", file);
    put_value(file, odd_number(), "1");
  }
  fputs(" );", file);
}

static void put_mark_in_name(FILE *file)
{
  char text[LAB_COLUMN_TEXT];
  snprintf(text, sizeof text, "%.20s [m]", draw(2) ? "_l\"\\" : odd_mark());
  put_text(file, " name = { x", text);
  fputs(" };", file);
}

static void put_lead(FILE *file)
{
  fputs(" lead = ( { t = ", file);
  put_value(file, between(-1e6, -1), "s");
  fputs("; u = ", file);
  put_value(file, odd_number(), "1");
  fputs("; p = \"last p\"; }, { t = 0; x = \"first x\"; } );", file);
}

static void put_quantities(FILE *file)
{
  fputs(" quantities = { one = ", file);
  put_column(file, "-");
  fputs("; two* = \"p [kPa]\"; };", file);
}

static void put_log(FILE *file)
{
  static const char *const marks[] = {"delimiter", "thousands", "comment"};
  int i;
  fputs("log = {", file);
  for (i = 0; i < 3; i++)
    if (draw(3) == 0)
      put_text(file, marks[i], draw(4) ? odd_mark() : "tab");
  if (draw(4) == 0)
    put_text(file, "decimal", ",");
  if (draw(3) == 0)
    put_columns(file);
  if (draw(3) == 0)
    put_channels(file, "scale", 0);
  if (draw(3) == 0)
    put_channels(file, "offset", 1);
  if (draw(3) == 0)
    put_channels(file, "constants", 1);
  if (draw(3) == 0)
    put_window(file);
  if (draw(4) == 0)
    put_mark_in_name(file);
  if (draw(4) == 0)
    put_lead(file);
  if (draw(4) == 0)
    put_quantities(file);
  if (draw(4) == 0)
    fputs(" new_run = \"t drops\"; runs = \"mean\";", file);
  if (draw(4) == 0)
    fputs(" time_step = \"3.3333333333333335e-7 s\"; way_back = \"x\";", file);
  if (draw(4) == 0)
    fprintf(file, " skip_lines = %d; every = %d; first = %d; damaged = \"drop\";", draw(1000001), 1 + draw(1000000),
            draw(9));
  if (draw(4) == 0)
    fputs(" holdout = { first = 7; };", file);
  fputs(" };\n", file);
}

static void put_fit(FILE *file, const char *key)
{
  char name[LAB_PARAM_NAME_TEXT];
  fprintf(file, "%s = ( \"%s\" );\n", key, lab_fit_name(draw(LAB_PARAM_COUNT), name));
}

static void put_noise(FILE *file)
{
  fputs("noise = { pressure = ", file);
  put_value(file, fabs(odd_number()), "Pa");
  fputs("; };\n", file);
}

static void put_rig(FILE *file)
{
  put_keys(file);
  if (draw(3) == 0)
    put_effect(file);
  if (draw(3) == 0)
    put_term(file);
  if (draw(2))
    put_log(file);
  if (draw(3) == 0)
    put_fit(file, "fit");
  if (draw(3) == 0)
    put_fit(file, "fit_per_log");
  if (draw(3) == 0)
    put_noise(file);
  if (draw(4) == 0)
    fputs("inputs = [ \"x\", \"p\" ];\n", file);
}

/* ---- There and back ---- */

/* Write to a file of the scratch folder.  Returns: its path */
static const char *put_file(const char *name, void (*put)(FILE *))
{
  const char *path = scratch_path(name);
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  put(file);
  assert_int_equal(fclose(file), 0);
  return path;
}

static void put_model(FILE *file)
{
  lab_rig_write(file, &rig, NULL);
}

static void assert_again(int number, const char *source)
{
  const char *what;
  const char *model = put_file("model.cfg", put_model);
  check_note("rig %d", number);
  if (lab_rig_read(model, &again, &error))
    fail_msg("%s; from\n%s", error.text, scratch_read(source));
  what = rig_difference(&rig, &again);
  if (what)
    fail_msg("another %s; from\n%s\nand\n%s", what, scratch_read(source), scratch_read(model));
}

TEST(test_lab_rig_write__any_rig_that_is_read__is_read_again)
{
  int i, accepted = 0;
  for (i = 0; i < RIGS; i++) {
    const char *source = put_file("rig.cfg", put_rig);
    if (lab_rig_read(source, &rig, &error)) {
      assert_int_equal(error.status, LAB_DATA);
      continue;
    }
    accepted++;
    assert_again(i, source);
  }
  check_note("%d of %d accepted", accepted, (int)RIGS);
  assert_true(accepted > RIGS / 4);
}

/* A fit may end at a lag that is shorter than any that the model has: a file with it is refused. */
TEST(test_lab_rig_drop_idle__trace_of_what_cannot_act__is_gone_and_the_rest_stays)
{
  const int idle = pneu_param_find("position_lag.position_time"), acts = pneu_param_find("pressure_bias.pressure_bias");
  lab_rig_default(&rig);
  *pneu_param_at(&rig.params, idle) = 1e-10;
  *pneu_param_at(&rig.params, acts) = 30;
  assert_fails(lab_rig_read(put_file("trace.cfg", put_model), &again, &error), LAB_DATA, "position_time does nothing");
  lab_rig_drop_idle(&rig);
  succeed(lab_rig_read(put_file("no_trace.cfg", put_model), &again, &error));
  assert_close(*pneu_param_at(&again.params, idle), 0, 0, 0);
  assert_close(*pneu_param_at(&again.params, acts), 30, 0, 0);
}

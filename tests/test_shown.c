/* apps/lab/base/shown and reduce: numbers and series made fit to look at. */
#include "check.h"

#include "../apps/lab/log/channel.h"
#include "../apps/lab/report/reduce.h"
#include "../apps/lab/base/shown.h"
#include "../apps/lab/base/units.h"
#include "../lib/pneu.h"

static char text[LAB_SHOWN_TEXT];

/* ---- shown ---- */

static void test_lab_shown_number__sizes__few_digits_and_powers_only_where_needed(void **state)
{
  (void)state;
  assert_string_equal(lab_shown_number(0, 3, text), "0");
  assert_string_equal(lab_shown_number(0.0136809, 4, text), "0.01368");
  assert_string_equal(lab_shown_number(389.8377, 4, text), "389.8");
  assert_string_equal(lab_shown_number(-9.9996, 4, text), "-10.00");
  assert_string_equal(lab_shown_number(89695.4, 3, text), "89700");
  assert_string_equal(lab_shown_number(1.5e9, 3, text), "1.5e9");
  assert_string_equal(lab_shown_number(3.21e-12, 2, text), "3.2e-12");
  assert_string_equal(lab_shown_number((double)NAN, 3, text), "-");
  assert_string_equal(lab_shown_number(HUGE_VAL, 3, text), "-");
}

static void test_lab_shown_quantity__units__as_engineers_write_them(void **state)
{
  (void)state;
  assert_string_equal(lab_shown_quantity(5591.45, "Pa", 3, text), "5.59 kPa");
  assert_string_equal(lab_shown_quantity(1.98879e-5, "m", 3, text), "0.0199 mm");
  assert_string_equal(lab_shown_quantity(1.368e-8, "m2", 4, text), "0.01368 mm²");
  assert_string_equal(lab_shown_quantity(0.25, "1", 2, text), "0.25");
  assert_string_equal(lab_shown_quantity(298.15, "K", 4, text), "298.1 K");
}

/* What is shown must be what UDUNITS makes of it; the two are written differently where a unit has a dot or a square.
 */
static void assert_scale(const char *unit)
{
  const lab_shown shown = lab_shown_as(unit);
  char plain[64] = "";
  const char *c;
  double scale, offset;
  lab_error error;
  for (c = shown.unit; *c; c++) {
    const size_t used = strlen(plain);
    if (!strncmp(c, "²", 2) || !strncmp(c, "³", 2) || !strncmp(c, "·", 2)) {
      snprintf(plain + used, sizeof plain - used, "%s", !strncmp(c, "²", 2) ? "2" : !strncmp(c, "³", 2) ? "3" : ".");
      c++;
    } else {
      snprintf(plain + used, sizeof plain - used, "%c", *c);
    }
  }
  check_note("%s as %s", unit, plain);
  assert_int_equal(lab_unit_factor(unit, *plain ? plain : "1", &scale, &offset, &error), LAB_OK);
  assert_close(shown.scale, scale, 0, 1e-12);
}

static void test_lab_shown_as__every_unit_of_the_library__has_the_right_scale(void **state)
{
  int i;
  (void)state;
  for (i = 0; i < PNEU_PARAM_COUNT; i++) {
    pneu_param_info info;
    pneu_param_describe(i, &info);
    if (!strchr(info.unit, '^')) /* UDUNITS has no broken powers */
      assert_scale(info.unit);
  }
  for (i = 0; i < LAB_CHANNEL_COUNT; i++)
    assert_scale(lab_channels[i].unit);
}

static void test_lab_shown_p__small__is_said_to_be_small(void **state)
{
  (void)state;
  assert_string_equal(lab_shown_p(0, text), "below 1e-300");
  assert_string_equal(lab_shown_p(0.1449, text), "0.14");
  assert_string_equal(lab_shown_p(4.1e-188, text), "4.1e-188");
}

/* ---- reduce ---- */

static void test_lab_envelope__a_spike__is_kept(void **state)
{
  enum { N = 1000, COLUMNS = 10 };
  static double at[N], value[N];
  const size_t first[] = {0};
  lab_point point[3 * COLUMNS + 1];
  size_t i, n;
  double highest = -1;
  (void)state;
  for (i = 0; i < N; i++) {
    at[i] = (double)i;
    value[i] = 0.001 * (double)i;
  }
  value[347] = 50;
  n = lab_envelope(at, value, N, first, 1, 0, N - 1, COLUMNS, point);
  assert_int_equal(n, 2 * COLUMNS);
  for (i = 0; i < n; i++)
    highest = fmax(highest, point[i].value);
  assert_close(highest, 50, 0, 0);
  for (i = 1; i < n; i++)
    assert_true(point[i].at > point[i - 1].at);
  assert_close(point[0].value, 0, 0, 0);
  assert_close(point[n - 1].value, 0.999, 0, 1e-15);
}

/* A gap of many rows breaks the line, one of a row or two does not. */
static void test_lab_envelope__runs_and_gaps__break_the_line(void **state)
{
  enum { ROWS = 40 };
  double at[ROWS], value[ROWS];
  const size_t first[] = {0, 35};
  lab_point point[3 * ROWS + 2];
  size_t i, n, breaks = 0;
  (void)state;
  for (i = 0; i < ROWS; i++) {
    at[i] = (double)i;
    value[i] = i == 5 || (i >= 10 && i < 30) ? (double)NAN : 1;
  }
  n = lab_envelope(at, value, ROWS, first, 2, 0, ROWS, ROWS, point);
  for (i = 0; i < n; i++)
    breaks += isnan(point[i].value);
  assert_int_equal(n, 19 + 2);
  assert_int_equal(breaks, 2);
  assert_true(isnan(point[9].value) && isnan(point[15].value));
  assert_int_equal(point[8].row, 9);
  assert_int_equal(point[10].row, 30);
}

/* A channel that is measured now and then, as read off a figure, is a line. */
static void test_lab_envelope__few_values__are_joined(void **state)
{
  enum { ROWS = 40 };
  double at[ROWS], value[ROWS];
  const size_t first[] = {0};
  lab_point point[3 * ROWS + 1];
  size_t i, n;
  (void)state;
  for (i = 0; i < ROWS; i++) {
    at[i] = (double)i;
    value[i] = i % 5 ? (double)NAN : 1;
  }
  n = lab_envelope(at, value, ROWS, first, 1, 0, ROWS, ROWS, point);
  assert_int_equal(n, 8);
  for (i = 0; i < n; i++)
    assert_false(isnan(point[i].value));
}

static void test_lab_bin_means__values__mean_of_each_part(void **state)
{
  const double at[] = {0, 0.5, 1, 1.5, 2, (double)NAN}, value[] = {1, 3, 5, (double)NAN, 7, 9};
  lab_bin bin[2];
  (void)state;
  lab_bin_means(at, value, 6, 0, 2, 2, bin);
  assert_int_equal(bin[0].n, 2);
  assert_close(bin[0].at, 0.5, 1e-15, 0);
  assert_close(bin[0].mean, 2, 1e-15, 0);
  assert_int_equal(bin[1].n, 2);
  assert_close(bin[1].mean, 6, 1e-15, 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_lab_shown_number__sizes__few_digits_and_powers_only_where_needed),
      cmocka_unit_test(test_lab_shown_quantity__units__as_engineers_write_them),
      cmocka_unit_test(test_lab_shown_as__every_unit_of_the_library__has_the_right_scale),
      cmocka_unit_test(test_lab_shown_p__small__is_said_to_be_small),
      cmocka_unit_test(test_lab_envelope__a_spike__is_kept),
      cmocka_unit_test(test_lab_envelope__runs_and_gaps__break_the_line),
      cmocka_unit_test(test_lab_envelope__few_values__are_joined),
      cmocka_unit_test(test_lab_bin_means__values__mean_of_each_part),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

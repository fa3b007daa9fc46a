/* apps/lab/base/number */
#include "../../../apps/lab/base/number.h"
#include "../../fixture.h"

static int read(const char *text, char decimal, char thousands, double *value)
{
  return lab_number_read(text, text + strlen(text), decimal, thousands, value);
}

static void assert_reads(const char *text, char decimal, char thousands, double want)
{
  double got = NAN;
  assert_int_equal(read(text, decimal, thousands, &got), LAB_NUMBER_FINITE);
  assert_close(got, want, 0, 0);
}

TEST(test_lab_number_read__plain_numbers__are_exact)
{
  assert_reads("0", '.', 0, 0);
  assert_reads("-12.5", '.', 0, -12.5);
  assert_reads("+3", '.', 0, 3);
  assert_reads(" 7 ", '.', 0, 7);
  assert_reads(".5", '.', 0, 0.5);
  assert_reads("5.", '.', 0, 5);
  assert_reads("1e3", '.', 0, 1000);
  assert_reads("-2.5E-3", '.', 0, -0.0025);
  assert_reads("1.2732e-313", '.', 0, 1.2732e-313);
}

TEST(test_lab_number_read__random_numbers__equal_strtod)
{
  uint64_t seed = 88172645463325252u;
  int i;
  for (i = 0; i < 100000; i++) {
    char text[64];
    double scale, want;
    seed ^= seed << 13, seed ^= seed >> 7, seed ^= seed << 17;
    scale = (double)(1 << (seed % 20));
    snprintf(text, sizeof text, "%.*f", (int)(seed % 15), ((double)(seed >> 11) * 0x1p-53 - 0.5) * scale);
    want = strtod(text, NULL);
    assert_reads(text, '.', 0, want);
  }
}

TEST(test_lab_number_read__decimal_comma__is_a_point)
{
  assert_reads("1,25", ',', 0, 1.25);
  assert_reads("-1,25e2", ',', 0, -125);
}

TEST(test_lab_number_read__thousands_marks__are_left_out)
{
  assert_reads("1.234,5", ',', '.', 1234.5);
  assert_reads("1'234'567.5", '.', '\'', 1234567.5);
}

TEST(test_lab_number_read__thousands_equal_decimal__keeps_the_last)
{
  assert_reads("1.100.000", '.', '.', 1100);
  assert_reads("100.250", '.', '.', 100.25);
}

TEST(test_lab_number_read__nothing_or_nan__is_a_gap)
{
  const char *gaps[] = {"", "  ", "nan", "NaN", " NAN "};
  size_t i;
  for (i = 0; i < sizeof gaps / sizeof gaps[0]; i++) {
    double value = 0;
    assert_int_equal(read(gaps[i], '.', 0, &value), LAB_NUMBER_GAP);
    assert_true(isnan(value));
  }
}

TEST(test_lab_number_read__not_a_finite_decimal__is_bad)
{
  const char *bad[] = {"abc", "1.2.3", "1,5", "0x1A", "inf", "-inf",   "1e999",
                       "--1", "1 2",   "-",   ".",    "1e",  "nan(1)", "12kPa"};
  size_t i;
  for (i = 0; i < sizeof bad / sizeof bad[0]; i++) {
    double value;
    if (read(bad[i], '.', 0, &value) != LAB_NUMBER_BAD)
      fail_msg("\"%s\" was read", bad[i]);
  }
}

TEST(test_lab_number_read__very_long_field__is_bad)
{
  char text[1000];
  double value;
  memset(text, '1', sizeof text - 1);
  text[sizeof text - 1] = '\0';
  assert_int_equal(read(text, '.', 0, &value), LAB_NUMBER_BAD);
}

TEST(test_lab_number_write__any_number__is_short_and_the_same)
{
  static const struct {
    double value;
    const char *text;
  } row[] = {{0.04, "0.04"}, {1e-9, "1e-09"}, {-2, "-2"}, {0, "0"}, {0.1 + 0.2, "0.30000000000000004"}};
  char text[LAB_NUMBER_TEXT];
  uint64_t seed = 5;
  int i;
  for (i = 0; i < (int)(sizeof row / sizeof *row); i++)
    assert_string_equal(lab_number_write(row[i].value, text), row[i].text);
  for (i = 0; i < 10000; i++) {
    const double value = pow(10, fixture_random(&seed, -300, 300)) * (i % 2 ? -1 : 1);
    assert_true(strtod(lab_number_write(value, text), NULL) == value);
  }
}

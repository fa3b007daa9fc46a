/* apps/lab/base/units */
#include "../../words.h"

#include "../../../apps/lab/base/units.h"

static void assert_quantity(const char *text, const char *unit, double want)
{
  double got = NAN;
  succeed(lab_quantity(text, unit, &got, &error));
  assert_close(got, want, 0, 1e-14);
}

static void assert_bad(const char *text, const char *unit, const char *part)
{
  double got;
  assert_fails(lab_quantity(text, unit, &got, &error), LAB_DATA, part);
}

TEST(test_lab_quantity__units_of_rig_files__become_si)
{
  assert_quantity("400 cm^2", "m2", 0.04);
  assert_quantity("500 N.s/m", "N.s/m", 500);
  assert_quantity("4 kN/m", "N/m", 4000);
  assert_quantity("101.325 kPa", "Pa", 101325);
  assert_quantity("14.5 psi", "Pa", 14.5 * 6894.757293168361);
  assert_quantity("0.893 mm^2", "m2", 0.893e-6);
  assert_quantity("2 dm^3", "m3", 2e-3);
  assert_quantity("-3 mm", "m", -3e-3);
  assert_quantity("0 mm", "m", 0);
  assert_quantity("1e-3 m", "m", 1e-3);
  assert_quantity("+.5 mm", "m", 5e-4);
}

/* As sheets write them: all pressures of a rig file are above ambient. */
TEST(test_lab_quantity__words_of_sheets__are_read)
{
  assert_quantity("20 psig", "Pa", 20 * 6894.757293168361);
  assert_quantity("2.5 barg", "Pa", 250000);
  assert_quantity("2.5 bar(g)", "Pa", 250000);
  assert_quantity("1/4 in", "m", 0.00635);
  assert_quantity("-3/8", "1", -0.375);
  assert_bad("20 psia", "Pa", "psia");
  assert_bad("1/0 in", "m", "unknown unit");
  assert_bad("1/s", "m", "unknown unit");
}

/* What a person has written comes back as they would write it in SI; a number in SI, bit for bit. */
TEST(test_lab_quantity__change_of_unit__adds_no_digits)
{
  static const struct {
    const char *text, *unit;
    double value;
  } cases[] = {{"40 cm^3", "m3", 4e-5},        {"0.1 mm", "m", 1e-4},
               {"0.07 bar", "Pa", 7e3},        {"0.893 mm^2", "m2", 8.93e-7},
               {"25 degC", "K", 298.15},       {"0.3 kPa", "Pa", 300},
               {"400.7 kN/m", "N/m", 400.7e3}, {"4.000000000000001e-05", "m3", 4.000000000000001e-05}};
  size_t i;
  for (i = 0; i < sizeof cases / sizeof *cases; i++) {
    double value;
    check_note("%s", cases[i].text);
    succeed(lab_quantity(cases[i].text, cases[i].unit, &value, &error));
    assert_true(value == cases[i].value);
  }
}

TEST(test_lab_quantity__plain_number__is_si)
{
  assert_quantity("0.04", "m2", 0.04);
  assert_quantity(" 12 ", "Pa", 12);
}

TEST(test_lab_quantity__percent_and_one__work)
{
  assert_quantity("5 %", "1", 0.05);
  assert_quantity("5%", "1", 0.05);
  assert_quantity("0.3 1", "1", 0.3);
}

TEST(test_lab_quantity__temperature__has_its_offset)
{
  assert_quantity("25 degC", "K", 298.15);
  assert_quantity("298.15 K", "K", 298.15);
  assert_quantity("77 degF", "K", 298.15);
}

TEST(test_lab_quantity_difference__temperature__has_no_offset)
{
  double got = NAN;
  succeed(lab_quantity_difference("0.5 degC", "K", &got, &error));
  assert_close(got, 0.5, 1e-12, 0);
}

TEST(test_lab_quantity__unit_that_cannot_be_parsed__works_as_it_stands)
{
  assert_quantity("3.5 W/K^(4/3)", "W/K^(4/3)", 3.5);
  assert_quantity("3.5", "W/K^(4/3)", 3.5);
  assert_quantity("3.5 W/K^1.333", "W/K^1.333", 3.5);
  assert_bad("3.5 kW/K^1.333", "W/K^1.333", "expected the unit W/K^1.333");
}

TEST(test_lab_quantity__wrong_dimension__names_found_and_expected)
{
  assert_bad("5 kg", "m2", "expected a unit like m2 (m2), found \"kg\" (kg)");
  assert_bad("4 kN/m", "Pa", "kg.s-2");
}

TEST(test_lab_quantity__unknown_unit__is_named)
{
  assert_bad("5 furlongs_per_fortnight", "m2", "furlongs_per_fortnight");
  assert_bad("5 furlongs_per_fortnight", "m2", "expected a unit like m2, found the unknown unit");
  assert_bad("5 m^0.5", "m", "m^0.5");
  assert_bad("5 ,5 mm", "m", "unknown unit");
}

TEST(test_lab_quantity__no_finite_number__is_an_error)
{
  assert_bad("", "m", "expected a number");
  assert_bad("mm", "m", "expected a number");
  assert_bad("nan mm", "m", "expected a number");
  assert_bad("inf", "m", "expected a number");
  assert_bad("1e999 m", "m", "expected a number");
  assert_bad("0x10 m", "m", "expected a number");
  assert_bad("- 5 m", "m", "expected a number");
}

TEST(test_lab_quantity__logarithmic_unit__is_refused)
{
  assert_bad("3 lg(re 1 mW)", "W", "straight line");
}

TEST(test_lab_unit_factor__column_units__give_scale_and_offset)
{
  double scale, offset;
  succeed(lab_unit_factor("degC", "K", &scale, &offset, &error));
  assert_close(scale, 1, 1e-15, 0);
  assert_close(offset, 273.15, 1e-12, 0);
  succeed(lab_unit_factor("%", "1", &scale, &offset, &error));
  assert_close(scale, 0.01, 1e-17, 0);
  succeed(lab_unit_factor("1/4096", "1", &scale, &offset, &error));
  assert_close(scale, 1.0 / 4096, 0, 0);
  succeed(lab_unit_factor("ms", "s", &scale, &offset, &error));
  assert_close(scale, 1e-3, 0, 0);
}

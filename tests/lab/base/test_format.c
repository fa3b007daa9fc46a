/* apps/lab/base/format: numbers made fit to look at. */
#include "../../words.h"

#include "../../../apps/lab/log/channel.h"
#include "../../../apps/lab/base/format.h"
#include "../../../apps/lab/base/units.h"
#include "../../../lib/pneu.h"

static char text[LAB_FORMAT_TEXT];

TEST(test_lab_format_number__sizes__few_digits_and_powers_only_where_needed)
{
  assert_string_equal(lab_format_number(0, 3, text), "0");
  assert_string_equal(lab_format_number(0.0136809, 4, text), "0.01368");
  assert_string_equal(lab_format_number(389.8377, 4, text), "389.8");
  assert_string_equal(lab_format_number(-9.9996, 4, text), "-10.00");
  assert_string_equal(lab_format_number(89695.4, 3, text), "89700");
  assert_string_equal(lab_format_number(1.5e9, 3, text), "1.5e9");
  assert_string_equal(lab_format_number(3.21e-12, 2, text), "3.2e-12");
  assert_string_equal(lab_format_number((double)NAN, 3, text), "-");
  assert_string_equal(lab_format_number(HUGE_VAL, 3, text), "-");
}

TEST(test_lab_format_quantity__units__as_engineers_write_them)
{
  assert_string_equal(lab_format_quantity(5591.45, "Pa", 3, text), "5.59 kPa");
  assert_string_equal(lab_format_quantity(1.98879e-5, "m", 3, text), "0.0199 mm");
  assert_string_equal(lab_format_quantity(1.368e-8, "m2", 4, text), "0.01368 mm²");
  assert_string_equal(lab_format_quantity(0.25, "1", 2, text), "0.25");
  assert_string_equal(lab_format_quantity(298.15, "K", 4, text), "298.1 K");
}

TEST(test_lab_format_brief__sizes__no_zeros_at_the_end)
{
  assert_string_equal(lab_format_brief(398200, "Pa", text), "398.2 kPa");
  assert_string_equal(lab_format_brief(0.02, "m", text), "20 mm");
  assert_string_equal(lab_format_brief(12, "N", text), "12 N");
}

/* What is shown must be what UDUNITS makes of it; the two are written differently where a unit has a dot or a square.
 */
static void assert_scale(const char *unit)
{
  const lab_format shown = lab_format_as(unit);
  char plain[64] = "";
  const char *c;
  double scale, offset;
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
  succeed(lab_unit_factor(unit, *plain ? plain : "1", &scale, &offset, &error));
  assert_close(shown.scale, scale, 0, 1e-12);
}

TEST(test_lab_format_as__every_unit_of_the_library__has_the_right_scale)
{
  int i;
  for (i = 0; i < PNEU_PARAM_COUNT; i++) {
    pneu_param_info info;
    pneu_param_describe(i, &info);
    if (!strchr(info.unit, '^')) /* UDUNITS has no broken powers */
      assert_scale(info.unit);
  }
  for (i = 0; i < LAB_CHANNEL_COUNT; i++)
    assert_scale(lab_channels[i].unit);
}

TEST(test_lab_format_p__small__is_said_to_be_small)
{
  assert_string_equal(lab_format_p(0, text), "below 1e-300");
  assert_string_equal(lab_format_p(0.1449, text), "0.14");
  assert_string_equal(lab_format_p(4.1e-188, text), "4.1e-188");
}

/* apps/lab/rig/tolerance: how well declared values are known */
#include "../../rigfile.h"

#include "../../../apps/lab/rig/tolerance.h"

static lab_rig rig;

/* A rig file with this group, good until the next call. */
static const char *with(const char *group)
{
  static char text[512];
  snprintf(text, sizeof text,
           "actuator = { spring_rate = \"400 kN/m\"; stroke = \"20 mm\"; };\n"
           "supply = { pressure = \"4 bar\"; };\n"
           "transducer = { fill_area = \"1 mm^2\"; vent_area = \"2 mm^2\"; };\n%s",
           group);
  return text;
}

static int bias(void)
{
  int e;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++)
    if (!strcmp(pneu_effect_at(e)->name, "pressure_bias"))
      return pneu_effect_params(e, NULL);
  skip();
  return -1;
}

TEST(test_lab_tolerance__no_group__is_the_default_of_the_kind)
{
  rig = read_rig(with(""));
  assert_close(lab_tolerance(&rig, PNEU_PARAM_spring_rate), 0.1 * 4e5, 0, 1e-12);
  assert_close(lab_tolerance(&rig, PNEU_PARAM_ambient_pressure), 2000, 0, 0);
  assert_close(lab_tolerance(&rig, LAB_PARAM_ORIFICE_AREA), 0.2, 0, 0);
  assert_close(lab_tolerance(&rig, PNEU_PARAM_gas_constant), 0, 0, 0);
  assert_close(lab_tolerance(&rig, bias()), 0.0025 * 4e5, 0, 1e-12);
}

/* How well a parameter is known by a rig file with this group. */
static void assert_tolerance(const char *group, int param, double want)
{
  rig = read_rig(with(group));
  check_note("%s", group);
  assert_close(lab_tolerance(&rig, param), want, 0, 1e-12);
}

/* Where one factor of both areas is fitted, the vent is still off beside the fill orifice. */
TEST(test_lab_tolerance__orifice_area_is_fitted__their_ratio_is_known_to_a_quarter)
{
  const int vent = pneu_param_find("vent_restriction");
  if (vent < 0)
    skip();
  assert_tolerance("", vent, 0);
  assert_tolerance("fit = (\"orifice_area\");", vent, 0.05);
  assert_tolerance("fit = (\"orifice_area\"); tolerance = { vent_area = \"0.4 mm^2\"; };", vent, 0.05);
  assert_tolerance("fit = (\"orifice_area\"); tolerance = { vent_restriction = \"10 %\"; };", vent, 0.1);
  assert_tolerance("fit = (\"orifice_area\"); tolerance = { others = 0; };", vent, 0);
}

TEST(test_lab_tolerance_read__share_and_quantity__are_in_si)
{
  rig = read_rig(with("tolerance = { spring_rate = \"5 %\"; dead_volume = \"20 cm^3\"; pressure_bias = \"1 %\"; };"));
  assert_close(lab_tolerance(&rig, PNEU_PARAM_spring_rate), 2e4, 0, 1e-12);
  assert_close(lab_tolerance(&rig, PNEU_PARAM_dead_volume), 20e-6, 0, 1e-12);
  assert_close(lab_tolerance(&rig, bias()), 4e3, 0, 1e-12);
}

/* Wherever the group stands: a share of the supply is one of what the file declares. */
TEST(test_lab_tolerance_read__positioner__is_a_share_of_its_own_value)
{
  const int gain = pneu_param_find("gain");
  assert_string_equal(lab_tolerance_name(gain), "positioner.gain");
  assert_tolerance("positioner = { gain = 30; };", gain, 0.2 * 30);
  assert_tolerance("positioner = { gain = 30; }; tolerance = { positioner_gain = 3; };", gain, 3);
  assert_tolerance("positioner = { gain = 30; }; tolerance = { positioner_gain = \"10 %\"; };", gain, 3);
  assert_tolerance("", gain, 0);
}

TEST(test_lab_tolerance_read__others__are_exact)
{
  rig = read_rig(with("tolerance = { others = 0; spring_rate = \"5 %\"; };"));
  assert_close(lab_tolerance(&rig, PNEU_PARAM_spring_rate), 2e4, 0, 1e-12);
  assert_close(lab_tolerance(&rig, PNEU_PARAM_dry_friction), 0, 0, 0);
}

TEST(test_lab_tolerance_read__resolution__is_none_unless_given)
{
  rig = read_rig(with("tolerance = { pressure_resolution = \"1 kPa\"; };"));
  assert_close(lab_tolerance(&rig, LAB_PRESSURE_RESOLUTION), 1000, 0, 1e-12);
  assert_close(lab_tolerance(&rig, LAB_POSITION_RESOLUTION), 0, 0, 0);
}

TEST(test_lab_tolerance_read__mistakes__are_named)
{
  assert_rig_refused(with("tolerance = { sprig_rate = \"5 %\"; };"), "tolerance.sprig_rate:", "spring_rate");
  assert_rig_refused(with("tolerance = { spring_rate = \"-5 %\"; };"),
                     "tolerance.spring_rate:", "expected a standard deviation, 0 or more, found \"-5 %\"");
  assert_rig_refused(with("tolerance = { dead_volume = \"5 s\"; };"), "tolerance.dead_volume:", "unit");
}

TEST(test_lab_tolerance_write__given_ones__are_read_again)
{
  rig = read_rig(with("tolerance = { others = 0; clock = \"5 ms\"; spring_rate = \"5 %\"; };"));
  rig = write_and_read(&rig, NULL);
  assert_close(lab_tolerance(&rig, PNEU_PARAM_spring_rate), 2e4, 0, 1e-12);
  assert_close(lab_tolerance(&rig, PNEU_PARAM_dry_friction), 0, 0, 0);
}

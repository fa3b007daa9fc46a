/* apps/lab/rig/rig, and through it rigkeys, rigwrite, config, and the log group of logformat */
#include "../../fixture.h"
#include "../../rigfile.h"

#include "../../../apps/lab/base/text.h"

static const char declared[] =
    "// A rig as it may be declared.\n"
    "actuator = {\n"
    "  name = \"37-13\";  action = \"reverse\";\n"
    "  area = \"677 cm^2\";  dead_volume = \"120 cm^3\";  stroke = \"38.1 mm\";\n"
    "  spring_rate = \"120 kN/m\";  spring_preload = \"7.62 mm\";\n"
    "  moving_mass = \"2.5 kg\";  dry_friction = \"481 N\";\n"
    "  viscous_friction = \"501 N.s/m\";  damping = 1001;\n"
    "  external_force = \"-12 N\";  swept_ratio = 0.9;\n"
    "};\n"
    "transducer = { fill_area = \"2.177 mm^2\";  vent_area = \"2.2 mm^2\";\n"
    "  critical_ratio = 0.4; subsonic_index = 0.6; };\n"
    "supply = { pressure = \"140 kPa\";  temperature = \"20 degC\"; };\n"
    "ambient = { pressure = \"1 bar\";  temperature = \"297 K\"; };\n"
    "gas = { gas_constant = \"296.8 J/kg/K\"; heat_ratio = 1.39;\n"
    "  polytropic_index = 1.2; };\n"
    "laws = { gas = \"energy\";  flow = \"iso6358\";  friction = \"coulomb\"; };\n"
    "fit = ( \"orifice_area\", \"dry_friction\", \"damping\" );\n"
    "noise = { pressure = \"0.112 kPa\";  x = \"0.0381 mm\"; temperature = \"0.5 degC\"; t = \"2 ms\"; };\n";

static double param(const lab_rig *rig, const char *effect, const char *name)
{
  pneu_params p = rig->params;
  char full[LAB_PARAM_NAME_TEXT];
  snprintf(full, sizeof full, "%s.%s", effect, name);
  if (pneu_param_find(full) < 0)
    fail_msg("no parameter %s", full);
  return (double)*pneu_param_at(&p, pneu_param_find(full));
}

/* ---- Reading ---- */

static void assert_same(const lab_rig *a, const lab_rig *b)
{
  const char *what = rig_difference(a, b);
  if (what)
    fail_msg("another %s", what);
}

static void assert_comes_back(const lab_rig *rig)
{
  const lab_rig again = write_and_read(rig, "two lines\nof remark");
  assert_same(rig, &again);
}

TEST(test_lab_rig_read__every_parameter__lands_in_si)
{
  lab_rig rig = read_rig(declared);
  assert_close(rig.params.area, 0.0677, 0, 1e-14);
  assert_close(rig.params.dead_volume, 120e-6, 0, 1e-14);
  assert_close(rig.params.swept_ratio, 0.9, 0, 1e-14);
  assert_close(rig.params.stroke, 0.0381, 0, 1e-14);
  assert_close(rig.params.spring_rate, 120e3, 0, 1e-14);
  assert_close(rig.params.spring_preload, 7.62e-3, 0, 1e-14);
  assert_close(rig.params.moving_mass, 2.5, 0, 1e-14);
  assert_close(rig.params.dry_friction, 481, 0, 1e-14);
  assert_close(rig.params.viscous_friction, 501, 0, 1e-14);
  assert_close(rig.params.damping, 1001, 0, 1e-14);
  assert_close(rig.params.external_force, -12, 0, 1e-14);
  assert_close(rig.params.fill_area, 2.177e-6, 0, 1e-14);
  assert_close(rig.params.vent_area, 2.2e-6, 0, 1e-14);
  assert_close(rig.params.critical_ratio, 0.4, 0, 1e-14);
  assert_close(rig.params.subsonic_index, 0.6, 0, 1e-14);
  assert_close(rig.params.supply_pressure, 140e3, 0, 1e-14);
  assert_close(rig.params.supply_temperature, 293.15, 0, 1e-14);
  assert_close(rig.params.ambient_pressure, 1e5, 0, 1e-14);
  assert_close(rig.params.ambient_temperature, 297, 0, 1e-14);
  assert_close(rig.params.gas_constant, 296.8, 0, 1e-14);
  assert_close(rig.params.heat_ratio, 1.39, 0, 1e-14);
  assert_close(rig.params.polytropic_index, 1.2, 0, 1e-14);
}

TEST(test_lab_rig_read__what_is_not_said__is_assumed)
{
  lab_rig rig = read_rig("actuator = { bench_set = [\"0.2 bar\", \"1 bar\"]; damping = \"9 N.s/m\"; };\n");
  assert_int_equal(rig.assumed[PNEU_PARAM_damping], 0);
  assert_int_equal(rig.assumed[PNEU_PARAM_spring_rate], 0);
  assert_int_equal(rig.assumed[PNEU_PARAM_dry_friction], 1);
  assert_int_equal(rig.assumed[LAB_PARAM_ORIFICE_AREA], 0); /* a factor on what is said */
}

TEST(test_lab_rig_read__words__become_laws)
{
  lab_rig rig = read_rig(declared);
  assert_string_equal(rig.name, "37-13");
  assert_int_equal(rig.action, LAB_ACTION_REVERSE);
  assert_int_equal(rig.laws.gas, PNEU_GAS_ENERGY);
  assert_int_equal(rig.laws.flow, PNEU_FLOW_ISO6358);
  assert_int_equal(rig.friction, LAB_FRICTION_COULOMB);
  assert_int_equal(rig.laws.pressure_input, 0);
  assert_int_equal(rig.laws.position_input, 0);
}

TEST(test_lab_rig_read__fit_and_noise__are_listed)
{
  lab_rig rig = read_rig(declared);
  char name[LAB_PARAM_NAME_TEXT];
  assert_int_equal(rig.n_fit, 3);
  assert_int_equal(rig.fit[0], LAB_PARAM_ORIFICE_AREA);
  assert_int_equal(rig.fit[1], PNEU_PARAM_dry_friction);
  assert_string_equal(lab_fit_name(rig.fit[2], name), "damping");
  assert_close(rig.noise[LAB_CHANNEL_P], 112, 0, 1e-14);
  assert_close(rig.noise[LAB_CHANNEL_X], 38.1e-6, 0, 1e-14);
  assert_close(rig.noise[LAB_CHANNEL_T], 0.5, 0, 1e-12);
  assert_close(rig.noise[LAB_CHANNEL_TIME], 2e-3, 0, 1e-14);
  assert_true(isnan(rig.noise[LAB_CHANNEL_FORCE]));
}

/* Shared ones first, in whatever order the lists stand. */
TEST(test_lab_rig_read__fit_per_log__is_marked)
{
  const lab_rig rig = read_rig("fit_per_log = ( \"damping\", \"orifice_area\" );\n"
                               "fit = ( \"moving_mass\", \"dry_friction\" );\n");
  static const int want[] = {PNEU_PARAM_moving_mass, PNEU_PARAM_dry_friction, PNEU_PARAM_damping,
                             LAB_PARAM_ORIFICE_AREA};
  int i;
  assert_int_equal(rig.n_fit, 4);
  for (i = 0; i < 4; i++) {
    assert_int_equal(rig.fit[i], want[i]);
    assert_int_equal(rig.fit_per_log[i], i >= 2);
  }
}

TEST(test_lab_rig_read__nothing_declared__takes_the_defaults)
{
  lab_rig rig = read_rig("// all by default\n");
  pneu_params dflt;
  pneu_params_default(&dflt);
  assert_memory_equal(&rig.params, &dflt, sizeof dflt);
  assert_string_equal(rig.name, "rig");
  assert_int_equal(rig.laws.gas, PNEU_GAS_ISOTHERMAL);
  assert_int_equal(rig.laws.flow, PNEU_FLOW_PAPER);
  assert_int_equal(rig.n_fit, 0);
  assert_true(isnan(rig.noise[LAB_CHANNEL_P]));
  assert_int_equal(rig.input[LAB_CHANNEL_U], 1);
  assert_int_equal(rig.input[LAB_CHANNEL_P], 0);
  assert_int_equal(rig.log.delimiter, '\0'); /* to be guessed */
}

TEST(test_lab_rig_read__inputs__set_the_roles)
{
  lab_rig rig = read_rig("inputs = [ \"x\", \"p\" ];");
  assert_int_equal(rig.laws.pressure_input, 1);
  assert_int_equal(rig.laws.position_input, 1);
  assert_int_equal(rig.input[LAB_CHANNEL_FORCE], 0);
  rig = read_rig("inputs = ( \"u\", \"ps\", \"force\" );");
  assert_int_equal(rig.laws.pressure_input, 0);
  assert_int_equal(rig.input[LAB_CHANNEL_PS], 1);
  assert_int_equal(rig.input[LAB_CHANNEL_FORCE], 1);
}

TEST(test_lab_rig_read__zero_stroke__is_a_vessel)
{
  lab_rig rig = read_rig("actuator = { stroke = \"0 mm\"; };");
  assert_true(rig.params.stroke == 0);
}

TEST(test_lab_rig_read__fitted_effect__is_named_with_its_effect)
{
  lab_rig rig;
  char name[LAB_PARAM_NAME_TEXT];
  fixture_need("chamber_leak");
  rig = read_rig("fit = [ \"chamber_leak.leak_area\" ];");
  assert_int_equal(rig.fit[0], pneu_effect_params(pneu_effect_find("chamber_leak"), NULL));
  assert_string_equal(lab_fit_name(rig.fit[0], name), "chamber_leak.leak_area");
}

TEST(test_lab_rig_read__effects__are_set_by_name)
{
  lab_rig rig;
  fixture_need("chamber_leak");
  fixture_need("stribeck_friction");
  fixture_need("supply_droop");
  rig = read_rig("effects = { chamber_leak = { leak_area = \"0.02 mm^2\"; };\n"
                 "  stribeck_friction = { stribeck_excess = 0.25; }; };");
  assert_close(param(&rig, "chamber_leak", "leak_area"), 0.02e-6, 0, 1e-14);
  assert_close(param(&rig, "stribeck_friction", "stribeck_excess"), 0.25, 0, 0);
  assert_close(param(&rig, "supply_droop", "supply_resistance"), 0, 0, 0);
}

TEST(test_lab_rig_read__friction_laws__switch_their_effects_on)
{
  lab_rig rig;
  fixture_need("stribeck_friction");
  fixture_need("presliding");
  rig = read_rig("laws = { friction = \"stribeck\"; };");
  assert_int_equal(rig.friction, LAB_FRICTION_STRIBECK);
  assert_true(param(&rig, "stribeck_friction", "stribeck_excess") > 0);
  rig = read_rig("laws = { friction = \"lugre\"; };");
  assert_true(param(&rig, "presliding", "presliding_length") > 0);
}

TEST(test_lab_rig_read__effects_before_laws__have_the_last_word)
{
  lab_rig rig;
  fixture_need("stribeck_friction");
  rig = read_rig("effects = { stribeck_friction = { stribeck_excess = 0.125; }; };\n"
                 "laws = { friction = \"stribeck\"; };");
  assert_close(param(&rig, "stribeck_friction", "stribeck_excess"), 0.125, 0, 0);
}

TEST(test_lab_rig_read__log_group__becomes_the_format_and_comes_back)
{
  lab_rig rig = read_rig("inputs = [ \"p\", \"x\" ];\n"
                         "log = { delimiter = \"tab\"; decimal = \",\"; thousands = \"'\"; comment = \"\\\"\";\n"
                         "  skip_lines = 3; columns = ( \"t [ms]\", \"-\", \"p_abs [hPa]\" );\n"
                         "  window = ( \"100 ms\", \"2 s\" ); new_run = \"t drops\"; damaged = \"drop\";\n"
                         "  scale = { x = -0.1; }; offset = { T = \"0.1 degC\"; }; constants = { u = \"10 %\"; }; };");
  assert_int_equal(rig.log.delimiter, '\t');
  assert_int_equal(rig.log.decimal, ',');
  assert_int_equal(rig.log.thousands, '\'');
  assert_int_equal(rig.log.comment, '"');
  assert_int_equal(rig.log.skip_lines, 3);
  assert_int_equal(rig.log.n_columns, 3);
  assert_string_equal(rig.log.column[2], "p_abs [hPa]");
  assert_close(rig.log.from, 0.1, 1e-15, 0);
  assert_close(rig.log.to, 2, 0, 0);
  assert_int_equal(rig.log.new_run, LAB_RUN_T_DROPS);
  assert_int_equal(rig.log.damaged, LAB_DAMAGED_DROP);
  assert_close(rig.log.scale[LAB_CHANNEL_X], -0.1, 0, 0);
  assert_close(rig.log.scale[LAB_CHANNEL_P], 1, 0, 0);
  assert_close(rig.log.offset[LAB_CHANNEL_T], 0.1, 1e-12, 0);
  assert_close(rig.log.constant[LAB_CHANNEL_U], 0.1, 0, 0);
  assert_true(isnan(rig.log.constant[LAB_CHANNEL_P]));
  assert_comes_back(&rig);
}

TEST(test_lab_rig_read__shape_of_a_log__is_read_and_written)
{
  lab_rig rig = read_rig(
      "log = { columns = ( \"t [ms]\", \"p [bar]\", \"p [bar]\" ); weights = ( 1, 0.5, -0.25 ); every = 7; first = 2;\n"
      "  name = { x = \"_l [dm]\"; }; holdout = { window = ( \"5 s\", \"6 s\" ); first = 3; };\n"
      "  new_run = \"t drops\"; runs = \"mean\";\n"
      "  lead = ( { t = \"-1 ms\"; u = 0; p = \"2 bar\"; ps = \"last p\"; x = \"first x\"; }, { t = 0; u = 1; } ); };");
  rig = write_and_read(&rig, NULL);
  assert_int_equal(rig.log.weighted, 3);
  assert_close(rig.log.weight[2], -0.25, 0, 0);
  assert_int_equal(rig.log.every, 7);
  assert_int_equal(rig.log.first, 2);
  assert_string_equal(rig.log.name[LAB_CHANNEL_X], "_l [dm]");
  assert_int_equal(rig.log.holdout_first, 3);
  assert_close(rig.log.holdout_from, 5, 0, 0);
  assert_close(rig.log.holdout_to, 6, 0, 0);
  assert_int_equal(rig.log.runs, LAB_RUNS_MEAN);
  assert_int_equal(rig.log.way_back, -1);
  assert_int_equal(rig.log.n_lead, 2);
  assert_close(rig.log.lead[0][LAB_CHANNEL_TIME], -1e-3, 0, 0);
  assert_close(rig.log.lead[0][LAB_CHANNEL_P], 2e5, 1e-9, 0);
  assert_true(isnan(rig.log.lead[1][LAB_CHANNEL_P]));
  assert_int_equal(rig.log.lead_last[0][LAB_CHANNEL_PS], LAB_CHANNEL_P + 1);
  assert_int_equal(rig.log.lead_first[0][LAB_CHANNEL_X], LAB_CHANNEL_X + 1);
  assert_int_equal(rig.log.lead_first[1][LAB_CHANNEL_X], 0);
  assert_close(rig.log.lead[1][LAB_CHANNEL_U], 1, 0, 0);
  rig = read_rig("log = { columns = ( \"p [kPa]\", \"x [mm]\" ); time_step = 10; way_back = \"p\"; };");
  assert_int_equal(rig.log.way_back, LAB_CHANNEL_P);
  rig = write_and_read(&rig, NULL);
  assert_int_equal(rig.log.way_back, LAB_CHANNEL_P);
}

TEST(test_lab_rig_read__long_log__lists_quantities_and_comes_back)
{
  lab_rig rig = read_rig("log = { columns = ( \"quantity\", \"t [s]\", \"value\" );\n"
                         "  quantities = { p_bar = \"p [bar]\"; wall = \"-\"; }; };");
  assert_int_equal(rig.log.n_quantities, 2);
  assert_string_equal(rig.log.quantity[0].word, "p_bar");
  assert_string_equal(rig.log.quantity[0].column, "p [bar]");
  assert_comes_back(&rig);
  rig = read_rig("log = { time_step = \"1 ms\"; };");
  assert_comes_back(&rig);
}

TEST(test_lab_rig_read__proportional_band__makes_the_command_a_pressure)
{
  lab_rig rig = read_rig("log = { constants = { u = \"80 kPa\"; }; };\n"
                         "transducer = { proportional_band = \"5 kPa\"; };");
  assert_int_equal(rig.log.command_is_pressure, 1);
  assert_close(rig.log.constant[LAB_CHANNEL_U], 80000, 0, 1e-14);
}

TEST(test_lab_rig_read__no_fill_area__needs_no_supply)
{
  lab_rig rig = read_rig("supply = { pressure = 0; }; transducer = { fill_area = 0; };");
  assert_true(rig.params.supply_pressure == 0);
}

/* ---- Bad files ---- */

TEST(test_lab_rig_read__missing_file__says_so)
{
  lab_rig rig;
  assert_fails(lab_rig_read(scratch_path("none.cfg"), &rig, &error), LAB_DATA, "none.cfg: there is no such file");
}

TEST(test_lab_rig_read__binary_file__is_refused)
{
  const char bytes[] = "\x7f"
                       "ELF\0\0\0\1";
  lab_rig rig;
  assert_fails(lab_rig_read(scratch_bytes("rig.cfg", bytes, sizeof bytes), &rig, &error), LAB_DATA, "rig.cfg:1:");
}

TEST(test_lab_rig_read__bad_rig_file__says_what_is_wrong_and_where)
{
  static const struct {
    const char *text, *place, *words;
  } bad[] = {
      {"", "rig.cfg", "empty"},
      {"actuator = {\n  area = \"1 m2\";\n  stroke = ;\n};\n", "rig.cfg:3:", "syntax error"},
      {"actuator = {\n  area = 1;\n  area = 2;\n};\n", "rig.cfg:3:", "duplicate"},
      {"actuator = {\n  spring_rat = \"4 kN/m\";\n};\n",
       "rig.cfg:2: actuator.spring_rat:", "nearest known one is \"spring_rate\""},
      {"actuator = { fill_area = 0; };\n", "actuator.fill_area", "belongs to the group transducer"},
      {"\nactuater = { area = 1; };\n", "rig.cfg:2: actuater:", "nearest known one is \"actuator\""},
      {"actuator = 5;\n", "rig.cfg:1: actuator:", "expected a group { ... }, found 5"},
      {"actuator = {\n area = \"40 cm\";\n};\n",
       "rig.cfg:2: actuator.area:", "expected a unit like m2 (m2), found \"cm\""},
      {"supply = { pressure = \"4 barr\"; };\n", "supply.pressure", "unknown unit \"barr\""},
      {"actuator = { area = true; };\n", "actuator.area", "found true"},
      {"actuator = { area = [1, 2]; };\n", "actuator.area", "found a list of 2 entries"},
      {"actuator = { name = 5; };\n", "actuator.name", "expected a text in quotes, found 5"},
      {"laws = { gas = 1; };\n", "laws.gas", "expected a word in quotes, found 1"},
      {"actuator = { area = \"big\"; };\n", "actuator.area", "expected a number"},
      {"actuator = { area = \"nan m2\"; };\n", "actuator.area", "expected a number"},
      {"actuator = {\n area = \"-400 cm^2\";\n};\n",
       "rig.cfg:2: actuator.area:", "expected 1e-06 to 10 m2, found \"-400 cm^2\", which is -0.04 m2"},
      {"ambient = { pressure = \"0 Pa\"; };\n", "ambient.pressure", "expected 100 to 1e+07 Pa"},
      {"actuator = { dead_volume = -1; };\n", "actuator.dead_volume", "found -1"},
      {"actuator = { area = 1e999; };\n", "actuator.area", "expected"},
      {"supply = {\n pressure = \"0 kPa\";\n};\n", "rig.cfg:2: supply.pressure:", "supply above ambient"},
      {"laws = { gas = \"isotermal\"; };\n", "laws.gas", "nearest known one is \"isothermal\""},
      {"laws = { flow = \"ISO6358\"; };\n", "laws.flow", "nearest known one is \"iso6358\""},
      {"laws = { friction = \"lugree\"; };\n", "laws.friction", "nearest known one is \"lugre\""},
      {"actuator = { action = \"revers\"; };\n", "actuator.action", "\"reverse\""},
      {"fit = ( \"dry_frction\" );\n", "fit[0]", "nearest known one is \"dry_friction\""},
      {"fit = ( \"area\",\n \"area\" );\n", "rig.cfg:2: fit[1]:", "twice"},
      {"fit = ( \"orifice_area\", \"vent_area\" );\n", "fit[1]", "orifice_area scales"},
      {"fit = ( \"fill_area\", \"orifice_area\" );\n", "fit[1]", "orifice_area scales"},
      {"fit = ( 5 );\n", "fit[0]", "expected a word"},
      {"fit = \"area\";\n", "fit", "expected a list"},
      {"fit_per_log = ( \"dry_frction\" );\n", "fit_per_log[0]", "nearest known one is \"dry_friction\""},
      {"fit = ( \"area\" );\nfit_per_log = ( \"area\" );\n", "rig.cfg:2: fit_per_log[0]:", "twice"},
      {"fit = ( \"fill_area\" ); fit_per_log = ( \"orifice_area\" );\n", "fit_per_log[0]", "orifice_area scales"},
      /* control characters do not reach the message */
      {"laws = { gas = \"a\\n\\x1b[2Jb\"; };\n", "laws.gas", "unknown word \"a??[2Jb\""},
      {"log = { decimal = 5; };\n", "log.decimal", "expected one character"},
      {"log = { scale = { p = true; }; };\n", "log.scale.p", "expected"},
      {"log = { scale = { p = 0; }; };\n", "log.scale.p", "other than 0"},
      {"log = { quantities = {\n a12345678901234567890123456789012345678901234567890123456789012345 = \"-\"; }; };",
       "log.quantities.a1234", "a word of less than 64 bytes"},
      {"log = { holdout = { first = -1; }; };\n", "log.holdout.first", "0 to"},
      {"log = { holdout = { window = ( \"2 s\", \"1 s\" ); }; };\n", "log.holdout.window", "from 2 s to 1 s"},
      {"log = { lead = ( { t = \"0 s\"; p = \"2e15 Pa\"; } ); };\n", "log.lead[0].p", "-5e+14 to 5e+14"},
      {"noise = { presure = 1; };\n", "noise.presure", "\"pressure\""},
      {"noise = { tme = 1; };\n", "noise.tme", "\"time\""},
      {"noise = { pressure = 0; };\n", "noise.pressure", "above 0"},
      {"noise = { pressure = \"-1 kPa\"; };\n", "noise.pressure", "above 0"},
      {"noise = { pressure = \"1 mm\"; };\n", "noise.pressure", "expected a unit like Pa"},
      {"noise = { command = 1; };\n", "noise.command", "unknown key"},
      {"inputs = [ \"v\" ];\n", "inputs[0]", "unknown word \"v\""},
      {"inputs = [ \"T\" ];\n", "inputs[0]", "unknown word \"T\""},
      {"inputs = [ ];\n", "inputs", "expected a list"},
      {"log = { delimeter = \";\"; };\n", "log.delimeter", "\"delimiter\""},
      {"log = { delimiter = \"ab\"; };\n", "log.delimiter", "one character"},
      {"log = { delimiter = 5; };\n", "log.delimiter", "one character"},
      {"log = { decimal = \";\"; };\n", "log.decimal", "expected \".\" or \",\""},
      {"log = { delimiter = \",\"; decimal = \",\"; };\n", "log:", "delimiter and decimal"},
      {"log = { delimiter = \",\"; thousands = \",\"; };\n", "log:", "delimiter and thousands"},
      {"log = { skip_lines = -1; };\n", "log.skip_lines", "whole number"},
      {"log = { skip_lines = 1.5; };\n", "log.skip_lines", "whole number"},
      {"log = { columns = \"t [s]\"; };\n", "log.columns", "expected a list"},
      {"log = { columns = ( \"t [s]\", 5 ); };\n", "log.columns[1]", "expected a text"},
      {"log = { columns = ( \"t [s]\", \"q [s]\" ); };\n", "log.columns", "unknown channel \"q\""},
      {"log = { window = ( 1 ); };\n", "log.window", "2 to 2 entries"},
      {"log = { window = ( 2, 1 ); };\n", "log.window", "(from, to)"},
      {"log = { window = ( 0, \"2 m\" ); };\n", "log.window[1]", "expected a unit like s"},
      {"log = { new_run = \"t rises\"; };\n", "log.new_run", "\"t drops\""},
      {"log = { damaged = \"keep\"; };\n", "log.damaged", "unknown word"},
      {"log = { columns = ( \"t [s]\" ); weights = ( 1, 2 ); };\n", "log:", "a weight for each of the 1"},
      {"log = { every = 0; };\n", "log.every", "whole number"},
      {"log = { name = { x = \"_l\"; }; };\n", "log.name.x", "mark [unit]"},
      {"log = { name = { q = \"_l [m]\"; }; };\n", "log.name.q", "unknown key"},
      {"log = { holdout = { rows = 1; }; };\n", "log.holdout.rows", "unknown key"},
      {"log = { way_back = \"p\"; };\n", "log:", "way_back needs time_step"},
      {"log = { way_back = \"q\"; };\n", "log.way_back", "unknown word"},
      {"log = { runs = \"mean\"; };\n", "log:", "needs new_run"},
      {"log = { lead = ( { t = 0; p = \"last q\"; } ); };\n", "log.lead[0].p", "\"first p\""},
      {"log = { lead = ( { u = 1; } ); };\n", "log.lead[0]", "its time t"},
      {"log = { lead = ( { t = 1; }, { t = 1; } ); };\n", "log.lead[1]", "after that of the row before"},
      {"log = { time_step = 0; };\n", "log.time_step", "expected"},
      {"log = { scale = { q = 1; }; };\n", "log.scale.q", "unknown key"},
      {"log = { scale = { x = 0; }; };\n", "log.scale.x", "other than 0"},
      {"log = { constants = { t = 0; }; };\n", "log.constants", "time_step"},
      {"log = { quantities = { a = \"b [Pa]\"; }; };\n", "log.quantities", "unknown channel \"b\""},
      {"log = { quantities = { a = \"p [Pa]\"; }; new_run = \"t drops\"; };\n", "log:", "neither"},
      {"actuator = { name = \"\"; };\n", "actuator.name", "expected a name"},
  };
  size_t i;
  for (i = 0; i < sizeof bad / sizeof *bad; i++)
    assert_rig_refused(bad[i].text, bad[i].place, bad[i].words);
}

TEST(test_lab_rig_read__long_name__is_refused)
{
  char text[300] = "actuator = { name = \"";
  memset(text + strlen(text), 'n', 100);
  strcat(text, "\"; };\n");
  assert_rig_refused(text, "actuator.name", "at most 63 bytes, found 100");
}

TEST(test_lab_rig_read__effect_that_cannot_act__is_refused)
{
  fixture_need("heat_transfer");
  assert_rig_refused("laws = { gas = \"isothermal\"; };\neffects = { heat_transfer = { free_convection = 1.5; }; };\n",
                     "effects.heat_transfer.free_convection", "does nothing with the other laws");
}

TEST(test_lab_rig_read__positioner_that_cannot_act__is_refused)
{
  fixture_need("positioner");
  assert_rig_refused("fit = ( \"positioner.gain\" );\n", "positioner.gain is to be fitted",
                     "no positioner is declared");
  assert_rig_refused("positioner = { cutoff_low = \"99 %\"; cutoff_high = \"1 %\"; };\n", "rig.cfg:1: positioner",
                     "cutoff_low, 99 %, is not below cutoff_high, 1 %");
}

TEST(test_lab_rig_read__bad_effects__are_refused)
{
  fixture_need("chamber_leak");
  assert_rig_refused("effects = { chamber_leek = { leak_area = 0; }; };\n", "effects.chamber_leek", "\"chamber_leak\"");
  assert_rig_refused("effects = { chamber_leak = { leek_area = 0; }; };\n", "effects.chamber_leak.leek_area",
                     "\"leak_area\"");
  assert_rig_refused("effects = { chamber_leak = { leak_area = \"1 kPa\"; }; };\n", "effects.chamber_leak.leak_area",
                     "expected a unit like m2");
  assert_rig_refused("effects = { chamber_leak = { leak_area = -1; }; };\n", "effects.chamber_leak.leak_area",
                     "expected 0 to");
  assert_rig_refused("effects = { chamber_leak = 1; };\n", "effects.chamber_leak", "expected a group");
  assert_rig_refused("effects = 1;\n", "effects", "expected a group");
}

/* ---- Writing ---- */

TEST(test_lab_rig_write__declared_rig__comes_back_bit_for_bit)
{
  lab_rig rig = read_rig(declared);
  assert_comes_back(&rig);
}

TEST(test_lab_rig_read__positioner__is_read_and_comes_back)
{
  lab_rig rig;
  fixture_need("positioner");
  rig =
      read_rig("positioner = { gain = 30; integral_time = \"5 s\"; derivative_time = \"20 ms\"; dead_band = \"0.2 %\"; "
               "cutoff_low = \"1 %\"; cutoff_high = \"99 %\"; };\n"
               "effects = { positioner_zero = { zero_shift = \"1 mm\"; }; };\n"
               "fit = ( \"positioner.gain\", \"positioner.dead_band\" );\n");
  assert_close(param(&rig, "positioner", "gain"), 30, 0, 0);
  assert_close(param(&rig, "positioner", "integral_time"), 5, 0, 0);
  assert_close(param(&rig, "positioner", "derivative_time"), 0.02, 1e-15, 0);
  assert_close(param(&rig, "positioner", "dead_band"), 0.002, 1e-15, 0);
  assert_close(param(&rig, "positioner", "cutoff_low"), 0.01, 1e-15, 0);
  assert_close(param(&rig, "positioner", "cutoff_high"), 0.99, 1e-15, 0);
  assert_int_equal(rig.n_fit, 2);
  assert_int_equal(lab_rig_has_positioner(&rig), 1);
  assert_comes_back(&rig);
  rig = read_rig("positioner = { };\n");
  assert_close(param(&rig, "positioner", "gain"), 20, 0, 0);
  assert_comes_back(&rig);
  rig = read_rig("positioner = { gain = 0; dead_band = 0.01; };\n");
  assert_int_equal(lab_rig_has_positioner(&rig), 0);
  assert_comes_back(&rig);
}

/* The loop has worked before the record, unless the file says where its integral begins, or how well that is known. */
TEST(test_lab_rig_free_integral__positioner_that_integrates__begins_anywhere_in_each_log)
{
  static const char *const known[] = {"positioner = { };\n",
                                      "positioner = { integral_time = \"5 s\"; integral_start = \"0 %\"; };\n",
                                      "positioner = { integral_time = \"5 s\"; };\ntolerance = { others = 0; };\n"};
  size_t i;
  lab_rig rig;
  fixture_need("positioner");
  rig = read_rig("positioner = { integral_time = \"5 s\"; };\n");
  lab_rig_free_integral(&rig);
  lab_rig_free_integral(&rig);
  assert_int_equal(rig.n_fit, 1);
  assert_int_equal(rig.fit[0], pneu_param_find("positioner.integral_start"));
  assert_int_equal(rig.fit_per_log[0], 1);
  assert_close(rig.tolerance[rig.fit[0]], 0.02, 0, 0);
  assert_comes_back(&rig);
  for (i = 0; i < sizeof known / sizeof *known; i++) {
    rig = read_rig(known[i]);
    lab_rig_free_integral(&rig);
    assert_int_equal(rig.n_fit, 0);
  }
}

TEST(test_lab_rig_read__positioner_that_is_wrong__is_refused)
{
  fixture_need("positioner");
  assert_rig_refused("positioner = { gian = 20; };\n", "positioner.gian", "\"gain\"");
  assert_rig_refused("positioner = { gain = -1; };\n", "positioner.gain", "0");
  assert_rig_refused("effects = { positioner = { gain = 20; }; };\n", "effects.positioner", "unknown");
  assert_rig_refused("positioner = { gain = 20; };\ntransducer = { proportional_band = \"1 bar\"; };\n",
                     "positioner.gain", "does nothing");
  assert_rig_refused("positioner = { gain = 20; };\nactuator = { stroke = \"0 mm\"; };\n", "positioner.gain",
                     "does nothing");
}

TEST(test_lab_rig_write__remark__heads_the_file)
{
  lab_rig rig = read_rig(declared);
  char *text;
  write_and_read(&rig, "two lines\nof remark");
  text = scratch_read(scratch_path("again.cfg"));
  assert_int_equal(strncmp(text, "// two lines\n// of remark\nactuator = {\n", 39), 0);
  free(text);
}

TEST(test_lab_rig_read__too_many_quantities__are_refused)
{
  char text[2000] = "log = { quantities = {";
  int i;
  for (i = 0; i <= LAB_QUANTITY_MAX; i++)
    lab_append(text, sizeof text, " q%d = \"-\";", i);
  strcat(text, " }; };\n");
  assert_rig_refused(text, "log.quantities", "at most 32 quantities");
}

TEST(test_lab_rig_write__odd_numbers_everywhere__come_back_bit_for_bit)
{
  lab_rig rig;
  int i;
  lab_rig_default(&rig);
  for (i = 0; i < PNEU_PARAM_COUNT; i++) {
    pneu_param_info info;
    pneu_param_describe(i, &info);
    *pneu_param_at(&rig.params, i) = (pneu_real)((double)info.lower + ((double)info.upper - (double)info.lower) / 3);
  }
  rig.params.supply_pressure = (pneu_real)(1e6 / 7);
  rig.params.area = (pneu_real)(1e-3 / 7);     /* a long chamber */
  if (pneu_param_find("positioner.gain") >= 0) /* which needs a position for a command */
    *pneu_param_at(&rig.params, pneu_param_find("positioner.gain")) = 0;
  rig.log.command_is_pressure = 1;
  rig.log.stroke = (double)rig.params.stroke;
  assert_comes_back(&rig);
}

TEST(test_lab_rig_write__friction_law_fitted_to_nothing__stays_off)
{
  lab_rig rig, again;
  fixture_need("stribeck_friction");
  rig = read_rig("laws = { friction = \"stribeck\"; };\n"
                 "effects = { stribeck_friction = { stribeck_excess = 0; }; };");
  again = write_and_read(&rig, NULL);
  assert_close(param(&again, "stribeck_friction", "stribeck_excess"), 0, 0, 0);
  assert_same(&rig, &again);
}

TEST(test_lab_rig_write__all_can_be_fitted__comes_back)
{
  lab_rig rig;
  int i;
  rig = read_rig(pneu_param_find("positioner.gain") >= 0 ? "positioner = { };\n" : "");
  for (i = 0; i < LAB_PARAM_COUNT; i++)
    if (i != PNEU_PARAM_fill_area && i != PNEU_PARAM_vent_area)
      rig.fit[rig.n_fit++] = i;
  assert_comes_back(&rig);
}

TEST(test_lab_rig_write__each_its_own__comes_back)
{
  lab_rig rig = read_rig("fit_per_log = ( \"supply_pressure\", \"orifice_area\" ); fit = ( \"spring_rate\" );\n"
                         "unlisted = ( { equation = \"friction\"; argument = \"x\"; from = 0; to = \"20 mm\";\n"
                         "  values = [ 0.0, 0.1, 0.0 ]; } );\n"),
          again = write_and_read(&rig, NULL);
  assert_int_equal(again.fit_per_log[0], 0);
  assert_int_equal(again.fit_per_log[1], 1);
  assert_int_equal(again.n_terms, 1);
  assert_same(&rig, &again);
  rig = read_rig("fit_per_log = ( \"damping\" );\n"); /* and none is shared */
  again = write_and_read(&rig, NULL);
  assert_int_equal(again.n_fit, 1);
  assert_int_equal(again.fit_per_log[0], 1);
  assert_same(&rig, &again);
}

TEST(test_lab_rig_model__good_rig__is_accepted)
{
  lab_rig rig = read_rig(declared);
  pneu_model model;
  succeed(lab_rig_model(&rig, &model, &error));
  assert_true(model.p.area == rig.params.area);
}

TEST(test_lab_rig_model__bad_parameter__is_named)
{
  lab_rig rig = read_rig(declared);
  pneu_model model;
  rig.params.moving_mass = -1;
  assert_fails(lab_rig_model(&rig, &model, &error), LAB_DATA, "moving_mass");
}

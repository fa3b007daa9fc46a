/* apps/lab/rig/sheet: words of a data sheet against numbers that a Python script computed from the sources in sheet.h.
 */
#include "../../rigfile.h"

#include "../../../apps/lab/log/log.h"

static const char *const sheet =
    "actuator = { area = \"400 cm^2\"; stroke = \"20 mm\"; };\nsupply = { pressure = \"4 bar\"; };\n";

/* The words behind what they refer to, unless they declare an actuator.  Returns: text, good until the next call */
static const char *with_sheet(const char *more, const char *law)
{
  static char text[2048];
  snprintf(text, sizeof text, "%s%s\nlaws = { flow = \"%s\"; };\n", strstr(more, "actuator") ? "" : sheet, more, law);
  return text;
}

static lab_rig read_sheet(const char *more, const char *law)
{
  return read_rig(with_sheet(more, law));
}

static void assert_refused(const char *more, const char *place, const char *words)
{
  assert_rig_refused(with_sheet(more, "choked"), place, words);
}

/* In any order of the keys. */
TEST(test_lab_sheet_read__bench_set__is_rate_and_preload)
{
  lab_rig rig = read_sheet(
      "actuator = { bench_set = [\"0.2 bar\", \"1.0 bar\"]; area = \"400 cm^2\"; stroke = \"20 mm\"; };", "choked");
  assert_close((double)rig.params.spring_rate, 160000, 0, TOL(1e-12, 1e-6));
  assert_close((double)rig.params.spring_preload, 0.005, 0, TOL(1e-12, 1e-6));
}

/* pi/4 (226 mm)^2, which the bench set takes. */
TEST(test_lab_sheet_read__diameter__is_an_area)
{
  lab_rig rig = read_sheet(
      "actuator = { bench_set = [\"0.2 bar\", \"1.0 bar\"]; diameter = \"226 mm\"; stroke = \"20 mm\"; };", "choked");
  assert_close((double)rig.params.area, 0.0401149959, 0, 1e-6);
  assert_close((double)rig.params.spring_rate, 0.0401149959 * 0.8e5 / 0.02, 0, 1e-6);
}

/* Travel and set position of a log as a rig reads them, and as the rig file that it writes does. */
static void read_opening(const char *fail, double x[2], double sp[2])
{
  static lab_rig rig;
  char text[256];
  const char *log_path = scratch_text("open.csv", "t [s],sp [%],x [%]\n0,0,1\n1,75,50\n2,100,100\n");
  lab_log log;
  int again;
  snprintf(text, sizeof text, "actuator = { area = \"400 cm^2\"; stroke = \"20 mm\"; %s };", fail);
  rig = read_sheet(text, "choked");
  for (again = 0; again < 2; again++) {
    succeed(lab_log_read(log_path, &rig.log, 101325, &log, &error));
    x[again] = log.value[LAB_CHANNEL_X][0];
    sp[again] = log.value[LAB_CHANNEL_SP][1];
    assert_close(log.value[LAB_CHANNEL_X][1], 0.01, 0, 1e-12);
    lab_log_free(&log);
    rig = write_and_read(&rig, NULL);
  }
}

TEST(test_lab_sheet_read__fail__says_which_way_travel_counts)
{
  double x[2], sp[2];
  int again;
  read_opening("fail = \"close\";", x, sp);
  for (again = 0; again < 2; again++) {
    assert_close(x[again], 0.0002, 0, 1e-9);
    assert_close(sp[again], 0.75, 0, 1e-12);
  }
  read_opening("fail = \"open\";", x, sp);
  for (again = 0; again < 2; again++) {
    assert_close(x[again], 0.0198, 0, 1e-9);
    assert_close(sp[again], 0.25, 0, 1e-12);
  }
}

TEST(test_lab_sheet_read__orifices__pass_what_the_sheet_says)
{
  static const struct {
    const char *words, *law;
    double area; /* [m2] */
  } row[] = {
      {"{ Kv = 0.1; }", "choked", 2.293186050641583e-06},
      {"{ Kv = \"100 l/h\"; }", "iso6358", 2.293186050641583e-06},
      {"{ Kv = 0.1; }", "paper", 1.8332031509707252e-06},
      {"{ Cv = 0.1; }", "choked", 1.9836059338049695e-06},
      {"{ C = \"0.5 dm3/(s.bar)\"; }", "choked", 2.5172479727786547e-06},
      {"{ C = 5e-9; b = 0.3; }", "iso6358", 2.5172479727786547e-06},
      {"{ C = 5e-9; b = 0.3; }", "paper", 1.95241516482365e-06},
      {"{ Qn = \"110 l/min\"; }", "choked", 1.9946960589642835e-06},
      {"{ Qn = \"110 l/min\"; b = 0.3; }", "iso6358", 2.367243070902674e-06},
  };
  size_t i;
  for (i = 0; i < sizeof row / sizeof row[0]; i++) {
    char text[256];
    lab_rig rig;
    check_note("%s, %s", row[i].words, row[i].law);
    snprintf(text, sizeof text, "transducer = { fill = %s; };", row[i].words);
    rig = read_sheet(text, row[i].law);
    assert_close((double)rig.params.fill_area, row[i].area, 0, 1e-6);
    snprintf(text, sizeof text, "transducer = { vent = %s; };", row[i].words);
    rig = read_sheet(text, row[i].law);
    assert_close((double)rig.params.vent_area, row[i].area, 0, 1e-6);
  }
}

/* The library's own sonic conductance of the area is the sheet's. */
TEST(test_lab_sheet_read__C__comes_back_from_the_library)
{
  lab_rig rig = read_sheet("transducer = { fill = { C = 5e-9; b = 0.25; }; vent = { Kv = 0.1; }; };", "iso6358");
  pneu_model model;
  succeed(lab_rig_model(&rig, &model, &error));
  assert_close((double)pneu_sonic_conductance(&model, rig.params.fill_area), 5e-9, 0,
               2e-4); /* R of dry air or of [B] */
  assert_close((double)rig.params.critical_ratio, 0.25, 0, 1e-6);
}

/* Below Re = 2300 by Hagen and Poiseuille, above it by Blasius. */
TEST(test_lab_sheet_read__tube__is_a_volume_and_a_resistance)
{
  const int resistance = pneu_param_find("connecting_tube.tube_resistance");
  const int volume = pneu_param_find("connecting_tube.tube_volume");
  lab_rig rig;
  if (resistance < 0)
    skip();
  rig = read_sheet("transducer = { fill_area = \"0.02 mm^2\"; };\ntube = { length = \"2 m\"; bore = \"4 mm\"; };",
                   "choked");
  assert_close((double)*pneu_param_at(&rig.params, volume), 2.5132741228718347e-05, 0, 1e-6);
  assert_close((double)*pneu_param_at(&rig.params, resistance), 1645427.3619244916, 0, 1e-6);
  rig = read_sheet("transducer = { fill_area = \"0.893 mm^2\"; };\ntube = { length = \"2 m\"; bore = \"4 mm\"; };",
                   "choked");
  assert_close((double)*pneu_param_at(&rig.params, resistance), 12811831.903400254, 0, 1e-6);
}

TEST(test_lab_sheet_read__what_cannot_be__is_refused)
{
  assert_refused("actuator = { bench_set = [\"1 bar\", \"0.2 bar\"]; };", "actuator.bench_set", "lower pressure first");
  assert_refused("actuator = { bench_set = [\"1 bar\"]; };", "actuator.bench_set", "2 to 2 entries");
  assert_refused("actuator = { bench_set = [\"1 bar\", \"2 mm\"]; };", "actuator.bench_set", "expected a unit like Pa");
  assert_refused("actuator = { bench_set = [0.2, 1.0]; };", "actuator.bench_set[1]", "write number and unit in quotes");
  assert_refused("actuator = { stroke = 0; bench_set = [\"0 bar\", \"1 bar\"]; };", "actuator.bench_set", "stroke");
  assert_refused("actuator = { spring_rate = 1e5; bench_set = [\"0 bar\", \"1 bar\"]; };", "actuator.bench_set",
                 "spring_rate is there too");
  assert_refused("actuator = { spring_preload = 0.01; bench_set = [\"0 bar\", \"1 bar\"]; };", "actuator.bench_set",
                 "spring_preload is there too");
  assert_refused("actuator = { stroke = \"1 um\"; bench_set = [\"0 bar\", \"9 bar\"]; };", "actuator.bench_set",
                 "gives a spring_rate of");
  assert_refused("actuator = { area = 0.04; diameter = \"226 mm\"; };", "actuator.diameter", "area is there too");
  assert_refused("actuator = { fail = \"shut\"; };", "actuator.fail", "expected \"close\" or \"open\"");
  assert_refused("actuator = { stroke = 0; fail = \"open\"; };", "actuator.fail", "needs actuator.stroke");
  assert_refused("transducer = { fill = { Kv = 1; Cv = 1; }; };", "transducer.fill", "one of Kv, Cv, C and Qn");
  assert_refused("transducer = { fill = { b = 0.5; }; };", "transducer.fill", "one of Kv, Cv, C and Qn");
  assert_refused("transducer = { fill = { Kw = 1; }; };", "transducer.fill.Kw", "nearest");
  assert_refused("transducer = { fill = { Kv = 0; }; };", "transducer.fill.Kv", "more than 0");
  assert_refused("transducer = { fill = 3; };", "transducer.fill", "a group");
  assert_refused("transducer = { fill = { Qn = 1e-3; p1 = \"5 bar\"; }; };", "transducer.fill", "p1 above p2");
  assert_refused("transducer = { fill = { Qn = 110; }; };", "transducer.fill.Qn", "write number and unit in quotes");
  assert_refused("transducer = { fill = { C = 0.4; }; };", "transducer.fill.C", "write number and unit in quotes");
  assert_refused("transducer = { fill = { Qn = 1e-3; p1 = 6; p2 = 0; }; };", "transducer.fill.p1",
                 "write number and unit in quotes");
  assert_refused("transducer = { vent = { Kv = 1; }; vent_area = 1e-6; };", "transducer.vent",
                 "vent_area is there too");
  assert_refused("transducer = { fill = { C = 1e-9; b = 0.3; }; vent = { C = 1e-9; b = 0.4; }; };", "transducer.vent.b",
                 "expected 0.3");
  assert_refused("transducer = { fill = { Kv = 1e6; }; };", "transducer.fill", "gives a fill_area of");
  assert_refused("tube = { length = \"2 m\"; };", "tube", "expected length and bore");
  assert_refused("tube = { length = \"2 m\"; bore = \"4 mm\"; wall = 1; };", "tube.wall", "nearest");
  if (pneu_effect_find("connecting_tube") >= 0)
    assert_refused(
        "tube = { length = \"2 m\"; bore = \"4 mm\"; };\neffects = { connecting_tube = { tube_volume = 1e-5; }; };",
        "tube", "connecting_tube is there too");
}

/* model.cfg holds the numbers. */
TEST(test_lab_rig_write__of_words__gives_the_same_model)
{
  lab_rig rig, again;
  rig = read_sheet(
      "actuator = { stroke = \"20 mm\"; area = \"400 cm^2\"; bench_set = [\"0.2 bar\", \"1 bar\"]; };\n"
      "transducer = { fill = { Kv = 0.1; }; vent = { Cv = 0.2; }; };\ntube = { length = \"1 m\"; bore = \"4 mm\"; };",
      "choked");
  again = write_and_read(&rig, NULL);
  assert_memory_equal(&rig.params, &again.params, sizeof rig.params);
}

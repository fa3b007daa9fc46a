/* apps/study/hypotheses: when a verdict flips; what each cause does without the other */
#include "../words.h"

#include "../../apps/study/hypotheses.h"

static void read_study(study *s)
{
  succeed(study_read("study/hypotheses.cfg", s, &error));
}

static const double below = 0.1;

static int judge(double left, double left_signed, double alone, double alone_signed)
{
  const verdict_shares shares = {left, left_signed, alone, alone_signed};
  return (int)verdict_judge(&shares, below);
}

TEST(test_verdict_judge__crossing_a_threshold__flips)
{
  const double untried = (double)NAN;
  assert_int_equal(judge(0.0999, 0.0999, 0.1001, 0.1001), VERDICT_CONFIRMED);
  assert_int_equal(judge(0.0999, 0.0999, 0.1001, -0.1001), VERDICT_OPPOSITE);
  assert_int_equal(judge(0.0999, 0.0999, 0.0999, 0.0999), VERDICT_NECESSARY);
  assert_int_equal(judge(0.0999, -0.0999, untried, untried), VERDICT_CONFIRMED);
  assert_int_equal(judge(0.1001, 0.1001, untried, untried), VERDICT_NOT_CONFIRMED);
  assert_int_equal(judge(0.1001, -0.1001, untried, untried), VERDICT_REVERSED);
  assert_int_equal(judge(2, 2, untried, untried), VERDICT_NOT_CONFIRMED);
  assert_int_equal(judge(1 + 1e-9, 1, untried, untried), VERDICT_NOT_TESTED);
}

/* ---- What the report says in words, of every actuator in every law ---- */

static verdict judged(const verdict_strokes *strokes, int cause)
{
  const verdict_shares shares = verdict_shares_of(strokes, cause);
  return verdict_judge(&shares, below);
}

/* The bench set of Table A1 as printed lies in the middle of the supply; all others do not. */
static void check_law(const lab_rig *rig, int gas, int flow, int is_central)
{
  const pneu_laws laws = study_laws(rig, gas, flow);
  verdict_strokes strokes;
  check_note("%s, %s, %s", rig->name, pneu_gas_key(gas), pneu_flow_key(flow));
  succeed(verdict_measure(rig, &laws, &strokes, &error));
  assert_true(strokes.base.asymmetry_signed > 0.01);
  assert_int_equal(judged(&strokes, H1_RATE), is_central ? VERDICT_NECESSARY : VERDICT_OPPOSITE);
  assert_int_equal(judged(&strokes, H2_PRELOAD), VERDICT_NOT_CONFIRMED);
  assert_int_equal(judged(&strokes, H3_LIMITER), VERDICT_NOT_CONFIRMED);
  assert_int_equal(judged(&strokes, H4_BENCH_OFFSET), is_central ? VERDICT_NOT_TESTED : VERDICT_NOT_CONFIRMED);
  assert_int_equal(judged(&strokes, H5_UNEQUAL_ORIFICES), VERDICT_NOT_TESTED);
  assert_int_equal(judged(&strokes, H6_AIR_PROCESS), is_central ? VERDICT_NECESSARY : VERDICT_REVERSED);
  /* a constant force, which acts in one direction as well, makes no asymmetry */
  assert_true(strokes.alone[H6_AIR_PROCESS].asymmetry < 0.02 * strokes.base.asymmetry);
}

TEST(test_verdict_measure__every_law_and_actuator__as_the_report_says)
{
  static study s;
  int a, g, f;
  read_study(&s);
  for (a = 0; a < s.n_actuators; a++)
    for (g = 0; g < s.n_gas; g++)
      for (f = 0; f < s.n_flow; f++)
        check_law(&s.actuator[a], s.gas[g], s.flow[f], a == 0);
}

/* Linear air at constant volume: the pressure nears the supply, or ambient, by a straight law, and the stem follows.
 * With P the pressure at the start and the end of a stroke, both strokes are exponentials with the time constant of the
 * chamber, to different ends. */
static double exponential_area(double ratio)
{
  /* share over time of a stroke that slows down by `ratio`: y(s) = (1 - ratio^-s)/(1 - 1/ratio), integrated over s */
  return (1 - (1 - 1 / ratio) / log(ratio)) / (1 - 1 / ratio);
}

TEST(test_hypotheses__air_process_with_the_bench_set_in_place__closed_form)
{
  static study s;
  int a;
  read_study(&s);
  for (a = 0; a < s.n_actuators; a++) {
    pneu_params p = s.actuator[a].params;
    pneu_laws laws = s.actuator[a].laws;
    const double force = (double)p.dry_friction / (double)p.area;
    const double low = (double)p.spring_rate * ((double)p.spring_preload + 0.05 * (double)p.stroke) / (double)p.area;
    const double high = (double)p.spring_rate * ((double)p.spring_preload + 0.95 * (double)p.stroke) / (double)p.area;
    const double top = (double)p.supply_pressure;
    const double rise = (top - low - force) / (top - high - force), fall = (high - force) / (low - force);
    lab_asymmetry r;
    check_note("%s", s.actuator[a].name);
    hypothesis_without(H6_AIR_PROCESS, &p, &laws);
    succeed(stroke_measure(&p, &p, &laws, &r, &error));
    assert_close(r.asymmetry_signed, exponential_area(rise) - exponential_area(fall), 1e-3, 0);
  }
}

/* ---- Why: PAPER.md 3.5 ---- */

/* Chamber pressure [Pa] gauge that balances a rising stem at a share of the travel. */
static double rising_pressure(const pneu_params *p, double share)
{
  return ((double)p->spring_rate * ((double)p->spring_preload + share * (double)p->stroke) + (double)p->dry_friction) /
         (double)p->area;
}

/* Linear symmetric air: both strokes slow down alike, as the distance to the supply shrinks. */
static void check_symmetric_air(const lab_rig *rig)
{
  pneu_params p = rig->params;
  pneu_laws laws = rig->laws;
  speed_pair pair;
  double slowing;
  hypothesis_without(H6_AIR_PROCESS, &p, &laws);
  hypothesis_without(H4_BENCH_OFFSET, &p, &laws);
  succeed(speeds_measure(&p, &laws, &pair, &error));
  slowing = ((double)p.supply_pressure - rising_pressure(&p, speed_position(0))) /
            ((double)p.supply_pressure - rising_pressure(&p, speed_position(SPEED_POINTS - 1)));
  assert_true(slowing > 2);
  assert_close(speed_max(&pair.up) / speed_min(&pair.up), slowing, 0, 1e-2);
  assert_close(speed_max(&pair.down) / speed_min(&pair.down), slowing, 0, 1e-2);
}

/* A constant load: both strokes are nearly straight, though they take different times. */
static void check_constant_load(const lab_rig *rig)
{
  pneu_params p = rig->params;
  pneu_laws laws = rig->laws;
  speed_pair pair;
  hypothesis_without(H1_RATE, &p, &laws);
  succeed(speeds_measure(&p, &laws, &pair, &error));
  assert_close(speed_max(&pair.up) / speed_min(&pair.up), 1, 0.03, 0);
  assert_close(speed_max(&pair.down) / speed_min(&pair.down), 1, 0.03, 0);
  assert_true(fabs(pair.shape.duration_ratio - 1) > 0.1);
}

TEST(test_hypotheses__spring_or_air__each_stroke_as_the_closed_form_has_it)
{
  static study s;
  int a;
  read_study(&s);
  for (a = 0; a < s.n_actuators; a++) {
    check_note("%s", s.actuator[a].name);
    check_symmetric_air(&s.actuator[a]);
    check_constant_load(&s.actuator[a]);
  }
}

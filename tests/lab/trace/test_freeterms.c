/* What a free term is called, where it acts and how it is put in words. */
#include "../../fixture.h"

#include "../../../apps/lab/trace/freeterms.h"

enum { KNOTS = 11, AT_X = PNEU_TERM_OVER_POSITION, AT_V = PNEU_TERM_OVER_VELOCITY, AT_P = PNEU_TERM_OVER_PRESSURE };

/* Eleven knots of one level, the ends included; what departs from it is put in by the test. */
static pneu_term flat(int equation, int argument, double from, double to, double level)
{
  pneu_term t;
  int i;
  memset(&t, 0, sizeof t);
  t.equation = equation;
  t.argument = argument;
  t.n = KNOTS;
  t.from = (pneu_real)from;
  t.to = (pneu_real)to;
  for (i = 0; i < KNOTS; i++)
    t.value[i] = (pneu_real)level;
  return t;
}

static void put(pneu_term *t, int first, int n, const double *value)
{
  int i;
  for (i = 0; i < n; i++)
    t->value[first + i] = (pneu_real)value[i];
}

/* ---- Equation ---- */

TEST(test_lab_free_term_equation__every_one__is_that_of_the_report)
{
  static const struct {
    int equation;
    const char *name, *what;
  } cases[] = {{PNEU_TERM_SUPPLY, "mass", "a change of the supply pressure"},
               {PNEU_TERM_FORCE, "force", "a force on the stem"},
               {PNEU_TERM_FRICTION, "force", "dry friction"},
               {PNEU_TERM_FLOW, "mass", "a flow into or out of the chamber"},
               {PNEU_TERM_HEAT, "energy", "heat into the gas"},
               {PNEU_TERM_SHOWN_PRESSURE, "sensor", "an error of the pressure sensor"},
               {PNEU_TERM_SHOWN_POSITION, "sensor", "an error of the position sensor"}};
  int i;
  assert_int_equal(COUNT(cases), PNEU_TERM_EQUATION_COUNT);
  for (i = 0; i < COUNT(cases); i++) {
    const pneu_term t = flat(cases[i].equation, AT_X, 0, 1, 0);
    assert_string_equal(lab_free_term_equation(&t), cases[i].name);
    assert_string_equal(lab_free_term_what(&t), cases[i].what);
  }
}

/* ---- Stretch ---- */

typedef struct stretch {
  double from, to, level, peak;
  int is_short;
} stretch;

static stretch stretch_of(const pneu_term *t)
{
  stretch s;
  s.is_short = lab_free_term_stretch(t, &s.from, &s.to, &s.level, &s.peak);
  return s;
}

static void assert_stretch(const pneu_term *t, stretch want)
{
  const stretch got = stretch_of(t);
  assert_close(got.from, want.from, 1e-12, 1e-12);
  assert_close(got.to, want.to, 1e-12, 1e-12);
  assert_close(got.level, want.level, 1e-12, 0);
  assert_close(got.peak, want.peak, 1e-12, 0);
  assert_int_equal(got.is_short, want.is_short);
}

TEST(test_lab_free_term_stretch__bump__is_where_it_is)
{
  static const double bump[] = {20, 60, 20}, dent[] = {-20, -60, -20};
  pneu_term t = flat(PNEU_TERM_FRICTION, AT_X, 0, 20e-3, 0);
  const stretch up = {8e-3, 12e-3, 0, 60, 1}, down = {8e-3, 12e-3, 0, -60, 1};
  put(&t, 4, 3, bump);
  assert_stretch(&t, up);
  put(&t, 4, 3, dent);
  assert_stretch(&t, down);
}

/* Feet below 15 % of the peak are not where it acts; above it, they are. */
TEST(test_lab_free_term_stretch__feet_of_a_bump__count_from_a_share_of_its_peak_on)
{
  static const double low[] = {14, 100, -14}, high[] = {16, 100, -16};
  pneu_term t = flat(PNEU_TERM_FORCE, AT_X, -1, 9, 0);
  const stretch narrow = {3.5, 4.5, 0, 100, 1}, wide = {3, 5, 0, 100, 1};
  put(&t, 4, 3, low);
  assert_stretch(&t, narrow);
  put(&t, 4, 3, high);
  assert_stretch(&t, wide);
}

TEST(test_lab_free_term_stretch__one_knot_at_an_end__reaches_half_of_the_way_to_the_next)
{
  static const double high = 100;
  pneu_term t = flat(PNEU_TERM_FLOW, AT_X, 0, 20e-3, 0);
  const double knot = 20e-3 / (t.n - 1);
  const stretch first = {0, knot / 2, 0, 100, 1}, last = {20e-3 - knot / 2, 20e-3, 0, 100, 1};
  put(&t, 0, 1, &high);
  assert_stretch(&t, first);
  t = flat(PNEU_TERM_FLOW, AT_X, 0, 20e-3, 0);
  put(&t, t.n - 1, 1, &high);
  assert_stretch(&t, last);
}

TEST(test_lab_free_term_stretch__bump_on_a_level__departs_from_the_level)
{
  static const double bump[] = {130, 190, 130}, dent[] = {70, 10, 70};
  pneu_term t = flat(PNEU_TERM_FRICTION, AT_X, 0, 10, 100);
  const stretch up = {2, 4, 100, 90, 1}, down = {2, 4, 100, -90, 1};
  put(&t, 2, 3, bump);
  assert_stretch(&t, up);
  put(&t, 2, 3, dent);
  assert_stretch(&t, down);
}

/* Ends of 0 are held there: the level is 0 even where most knots are not. */
TEST(test_lab_free_term_stretch__ends_at_zero__have_the_level_zero)
{
  pneu_term t = flat(PNEU_TERM_FLOW, AT_P, 1e5, 2e5, 3e-6);
  const stretch all = {1.1e5, 1.9e5, 0, 3e-6, 0};
  t.value[0] = t.value[KNOTS - 1] = 0;
  assert_stretch(&t, all);
}

/* From the median knot, a straight line departs to both sides alike. */
TEST(test_lab_free_term_stretch__straight_line__is_everywhere)
{
  pneu_term t = flat(PNEU_TERM_FORCE, AT_X, 0, 10, 0);
  stretch got;
  int i;
  for (i = 0; i < KNOTS; i++)
    t.value[i] = (pneu_real)(7 + 3 * i);
  got = stretch_of(&t);
  assert_close(got.from, 0, 0, 0);
  assert_close(got.to, 10, 1e-12, 0);
  assert_close(got.level, 22, 1e-12, 0);
  assert_close(fabs(got.peak), 15, 1e-12, 0);
  assert_int_equal(got.is_short, 0);
}

/* Half of the knots is where a stretch stops to be short. */
TEST(test_lab_free_term_stretch__half_of_the_knots__is_no_longer_short)
{
  static const double five[] = {8, 8, 8, 8, 8}, six[] = {8, 8, 8, 8, 8, 8};
  pneu_term t = flat(PNEU_TERM_FORCE, AT_X, 0, 10, 0);
  const stretch lesser = {3, 7, 0, 8, 1}, larger = {3, 8, 0, 8, 0};
  put(&t, 3, 5, five);
  assert_stretch(&t, lesser);
  put(&t, 3, 6, six);
  assert_stretch(&t, larger);
}

TEST(test_lab_free_term_stretch__nothing__has_no_peak)
{
  const pneu_term t = flat(PNEU_TERM_FORCE, AT_X, 2, 12, 0), level = flat(PNEU_TERM_FORCE, AT_X, 2, 12, -5);
  assert_close(stretch_of(&t).peak, 0, 0, 0);
  assert_close(stretch_of(&level).level, -5, 0, 0);
  assert_close(stretch_of(&level).peak, 0, 0, 0);
}

/* A log that has been from 0 to 12 of 20, or from 8 on, and found 100 nearly all along: what it has not reached is no
 * departure from that. */
TEST(test_lab_free_term_stretch__knots_that_no_log_has_reached__do_not_count)
{
  static const double found[] = {101, 99, 100, 130, 100, 98, 102}, line[] = {10, 30, 50, 70, 90, 110, 140};
  pneu_term low = flat(PNEU_TERM_FRICTION, AT_X, 0, 20, 0), high = low, rising = low;
  const stretch bump = {5, 7, 100, 30, 1}, late_bump = {13, 15, 100, 30, 1}, everywhere = {0, 12, 70, 70, 0};
  put(&low, 0, 7, found);
  put(&high, KNOTS - 7, 7, found);
  put(&rising, 0, 7, line);
  assert_stretch(&low, bump);
  assert_stretch(&high, late_bump);
  assert_stretch(&rising, everywhere);
}

/* Zeros on more than half of the stretch are the level from which the others depart. */
TEST(test_lab_free_term_stretch__mostly_zero__has_the_level_zero)
{
  static const double end[] = {60, 50, 40, 30, 20};
  pneu_term t = flat(PNEU_TERM_FRICTION, AT_X, 0, 20, 0);
  const stretch want = {0, 8, 0, 60, 1};
  put(&t, 0, 5, end);
  assert_stretch(&t, want);
}

/* Amplitudes are no knots: where one is larger than the other is no place. */
TEST(test_lab_free_term_stretch__cycle__is_all_of_it)
{
  static const double amplitudes[] = {50, -120, 3, 4};
  pneu_term t = flat(PNEU_TERM_FORCE, PNEU_TERM_OVER_CYCLE, 0, 1.87, 0);
  const stretch want = {0, 1.87, 0, 130, 0};
  put(&t, 0, 4, amplitudes);
  t.n = 4;
  assert_stretch(&t, want);
  t.n = 2;
  assert_stretch(&t, want);
}

/* ---- Where ---- */

static void assert_where(const pneu_term *t, const char *want)
{
  char text[LAB_WHERE_TEXT];
  assert_string_equal(lab_free_term_where(t, text), want);
}

/* A bump of the given peak at knots 3 to 5 of eleven from 0. */
static pneu_term local(int equation, int argument, double to, double peak)
{
  const double bump[] = {peak / 2, peak, peak / 2};
  pneu_term t = flat(equation, argument, 0, to, 0);
  put(&t, 3, 3, bump);
  return t;
}

TEST(test_lab_free_term_where__short_stretch__is_named_with_its_units)
{
  static const struct {
    int equation, argument;
    double to, peak;
    const char *want;
  } cases[] = {
      {PNEU_TERM_FORCE, AT_X, 20e-3, -62, "x = 6.00 .. 10.0 mm; largest value -62.0 N"},
      {PNEU_TERM_FRICTION, AT_X, 40e-3, 1234, "x = 12.0 .. 20.0 mm, both directions; largest value 1230 N"},
      {PNEU_TERM_FRICTION, AT_V, 0.1, 33.3, "v = 30.0 .. 50.0 mm/s, both directions; largest value 33.3 N"},
      {PNEU_TERM_SUPPLY, AT_P, 4e5, -2460, "p = 120 .. 200 kPa; largest value -2.46 kPa"},
      {PNEU_TERM_FLOW, PNEU_TERM_OVER_OPENING, 1, 1e-3, "u = 0.300 .. 0.500; largest value 0.00100 kg/s"},
      {PNEU_TERM_FLOW, AT_P, 4e5, -2.46e-6, "p = 120 .. 200 kPa; largest value -2.46e-6 kg/s"},
      {PNEU_TERM_HEAT, AT_P, 1e3, 7.5, "p = 0.300 .. 0.500 kPa; largest value 7.50 W"},
      {PNEU_TERM_SHOWN_PRESSURE, AT_P, 1e6, 5591, "p = 300 .. 500 kPa; largest value 5.59 kPa"},
      {PNEU_TERM_SHOWN_POSITION, AT_X, 1e-3, 4.2e-5, "x = 0.300 .. 0.500 mm; largest value 0.0420 mm"},
  };
  int i;
  for (i = 0; i < COUNT(cases); i++) {
    const pneu_term t = local(cases[i].equation, cases[i].argument, cases[i].to, cases[i].peak);
    assert_where(&t, cases[i].want);
  }
}

TEST(test_lab_free_term_where__long_stretch__is_nearly_everywhere)
{
  static const double all[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 14};
  pneu_term t = flat(PNEU_TERM_FRICTION, AT_X, 0, 20e-3, 0);
  put(&t, 0, KNOTS, all);
  assert_where(&t, "nearly everywhere, x = 0 .. 20.0 mm, both directions; largest value 8.00 N");
  t.equation = PNEU_TERM_FORCE;
  assert_where(&t, "nearly everywhere, x = 0 .. 20.0 mm; largest value 8.00 N");
}

TEST(test_lab_free_term_where__long_stretch_with_ends_at_zero__is_a_stretch)
{
  pneu_term t = flat(PNEU_TERM_SHOWN_PRESSURE, AT_P, 0, 5e5, 2e3);
  t.value[0] = t.value[KNOTS - 1] = 0;
  assert_where(&t, "p = 50.0 .. 450 kPa; largest value 2.00 kPa");
  t.value[0] = t.value[1] = 0;
  assert_where(&t, "p = 100 .. 450 kPa; largest value 2.00 kPa");
}

TEST(test_lab_free_term_where__long_numbers__fit)
{
  pneu_term t = flat(PNEU_TERM_FRICTION, AT_V, -1.23e252, 4.56e252, 0);
  char text[LAB_WHERE_TEXT];
  int i;
  for (i = 0; i < KNOTS; i++)
    t.value[i] = (pneu_real)(-1.58e-98 * (i + 1));
  t.value[KNOTS - 1] = (pneu_real)-1.9e-97;
  assert_string_equal(lab_free_term_where(&t, text), "nearly everywhere, v = -1.23e255 .. 4.56e255 mm/s, both "
                                                     "directions; largest value -9.52e-98 N");
}

/* Every 1.87 s, by its largest amplitude: hypot(147, 198.5) = 247, and hypot(30, 40) of the half period. */
TEST(test_lab_free_term_where__cycle__is_told_by_period_frequency_and_amplitude)
{
  static const struct {
    int equation;
    double from, to;
    const char *want;
  } cases[] = {
      {PNEU_TERM_FORCE, 0, 1.87, "periodically, every 1.87 s (0.535 Hz); amplitude 247 N"},
      {PNEU_TERM_FORCE, -1, 0.87, "periodically, every 1.87 s (0.535 Hz); amplitude 247 N"},
      {PNEU_TERM_SUPPLY, 0, 0.02, "periodically, every 0.0200 s (50.0 Hz); amplitude 0.247 kPa"},
      {PNEU_TERM_SUPPLY, 0, 90, "periodically, every 90.0 s (0.0111 Hz); amplitude 0.247 kPa"},
  };
  static const double first[] = {147, -198.5, 30, 40}, second[] = {30, 40, 147, -198.5};
  int i;
  for (i = 0; i < COUNT(cases); i++) {
    pneu_term t = flat(cases[i].equation, PNEU_TERM_OVER_CYCLE, cases[i].from, cases[i].to, 0);
    t.n = 4;
    put(&t, 0, 4, first);
    assert_where(&t, cases[i].want);
    put(&t, 0, 4, second);
    assert_where(&t, cases[i].want);
  }
}

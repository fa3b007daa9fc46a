/* apps/lab/metrics/asymmetry: how strokes differ */
#include "../../words.h"

#include "../../../apps/lab/metrics/asymmetry.h"

enum { SAMPLES = 4001 };

/* A stroke of unit time: share(s) from 0 to 1, rising or falling. */
typedef struct drawn {
  double t[SAMPLES], x[SAMPLES];
} drawn;

static double straight(double s)
{
  return s;
}

/* Reaches its end but for 1 %. */
static double lagging(double s)
{
  return 1 - exp(-s * log(100));
}

/* Above the straight line first, then below: as much. */
static double wavy(double s)
{
  return s + 0.05 * sin(2 * acos(-1) * (s - 0.05) / 0.9) * (s > 0.05 && s < 0.95);
}

static lab_edge draw(drawn *d, double (*share)(double), int falling)
{
  const lab_edge edge = {SAMPLES, d->t, d->x};
  int i;
  for (i = 0; i < SAMPLES; i++) {
    const double s = (double)i / (SAMPLES - 1), y = share(s) / share(1);
    d->t[i] = s;
    d->x[i] = falling ? 1 - y : y;
  }
  return edge;
}

static lab_asymmetry compare(double (*rise)(double), double (*fall)(double))
{
  static drawn up, down;
  const lab_edge a = draw(&up, rise, 0), b = draw(&down, fall, 1);
  lab_asymmetry r;
  succeed(lab_asymmetry_measure(&a, &b, &r, &error));
  return r;
}

/* Between 5 and 95 % a lag runs from 0 to 1 as (1 - q^s)/(1 - q) where q = 0.05.../0.95... is what is left to go. */
TEST(test_asymmetry_signed__lag_against_line__closed_form)
{
  const double end = 1 / 0.99, q = (end - 0.95) / (end - 0.05);
  const double area = (1 + (1 - q) / log(q)) / (1 - q) - 0.5;
  lab_asymmetry r = compare(lagging, straight);
  assert_true(area > 0.1);
  assert_close(r.asymmetry_signed, area, 1e-4, 0);
  assert_close(r.asymmetry, area, 1e-4, 0);
  r = compare(straight, lagging);
  assert_close(r.asymmetry_signed, -area, 1e-4, 0);
  assert_close(r.asymmetry, area, 1e-4, 0);
}

TEST(test_asymmetry_signed__strokes_that_cross__areas_cancel)
{
  const lab_asymmetry r = compare(wavy, straight);
  assert_close(r.asymmetry, 0.05 * 2 / acos(-1) / 0.9, 1e-3, 0);
  assert_close(r.asymmetry_signed, 0, 1e-4, 0);
}

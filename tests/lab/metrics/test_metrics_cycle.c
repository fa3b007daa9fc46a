/* Air and energy of a cycle, against the paper's formulae; reasons where there is none. */
#include "../../record.h"

static double record_flow[RECORD_ROWS];                     /* [kg/s] from the supply */
static const double F = 480, A = 0.04, k = 4e5, x_0 = 0.01; /* R1-400 [B, Table A1] */

/* Pressure over time that balances spring and friction in a full stroke up and down, 10 s each way; at the upper
 * stop it goes on to the supply and comes back. Flow from the supply as long as the pressure rises.
 * In:      preload  [m], of the spring */
static void record_cycle(double supply, double preload, double friction)
{
  int i;
  record_new(LAB_COMMAND_OPENING);
  record.supply = supply;
  for (i = 0; i <= 4000; i++) {
    const double t = 0.01 * i;
    const double x = t < 10 ? 0.002 * t : t < 30 ? record_stroke : 0.002 * (40 - t);
    const double sign = t < 20 ? 1 : -1, force = k * (preload + x) + sign * friction;
    const double top = k * (preload + record_stroke);
    const double p =
        t < 10 || t > 30
            ? force / A
            : ((t < 20 ? t - 10 : 30 - t) / 10 * (record.supply * A - top - sign * friction) + top + sign * friction) /
                  A;
    record_add(t, t < 20 ? 1 : -1, p, x);
    record_flow[i] = t < 20 ? 1e-4 * t : 0;
  }
  record.mass_in = record_flow;
}

TEST(test_metrics__cycle__the_paper_s_energies)
{
  const double in = A * 4e5 * record_stroke;                           /* [B, Eq. 42] */
  const double spring = k * record_stroke * (x_0 + record_stroke / 2); /* [J] */
  const double out = spring - F * record_stroke, lost = 2 * F * record_stroke;
  record_cycle(4e5, x_0, F);
  record_measure();
  assert_metric(LAB_METRIC_ENERGY_IN, in, 0, 1e-9);
  assert_metric(LAB_METRIC_ENERGY_OUT, out, 0, 1e-6);
  assert_metric(LAB_METRIC_ENERGY_LOST, lost, 0, 1e-6);
  assert_metric(LAB_METRIC_ENERGY_EFFICIENCY, 100 * (1 - out / in - lost / in), 0, 1e-6);
  assert_contains(metric_of(LAB_METRIC_ENERGY_EFFICIENCY)->text, "below the limit of 50 %");
}

/* [B, Eqs. 41 to 43]: a spring without preload that the supply just compresses gives back half of what came in. */
TEST(test_metrics__spring_that_fills_the_supply__half)
{
  record_cycle(k * record_stroke / A, 0, 0);
  record_measure();
  assert_close(metric_of(LAB_METRIC_ENERGY_OUT)->value, metrics.metric[LAB_METRIC_ENERGY_IN].value / 2, 0, 1e-6);
  assert_metric(LAB_METRIC_ENERGY_EFFICIENCY, 50, 1e-4, 0);
}

/* A bench set low in the supply range leaves more than the paper's limit. */
TEST(test_metrics__low_bench_set__above_the_limit_and_said)
{
  record_cycle(2.4e5, 0, 100);
  record_measure();
  assert_metric(LAB_METRIC_ENERGY_EFFICIENCY, 100 * (1 - (80 + 2) / 192.0), 1e-3, 0);
  assert_contains(metric_of(LAB_METRIC_ENERGY_EFFICIENCY)->text, "above the limit of 50 %");
}

TEST(test_metrics__noisy_cycle__within_what_is_said)
{
  const double spring = k * record_stroke * (x_0 + record_stroke / 2);
  record_cycle(4e5, x_0, F);
  record_noise(500, 2e-5);
  record_p[600] = record_x[3300] = (double)NAN;
  record_measure();
  assert_covers(LAB_METRIC_ENERGY_OUT, spring - F * record_stroke, 3);
  assert_covers(LAB_METRIC_ENERGY_LOST, 2 * F * record_stroke, 3);
}

TEST(test_metrics__air__integral_of_the_flow)
{
  const double mass = 1e-4 * 20 * 20 / 2;
  record_cycle(4e5, x_0, F);
  record_measure();
  assert_metric(LAB_METRIC_AIR_MASS, mass, 0, 1e-3);
  assert_metric(LAB_METRIC_AIR_VOLUME, 1e3 * mass * 287 * 273.15 / 101325, 0, 1e-3);
  record.mass_in = NULL;
  record_measure();
  assert_denied(LAB_METRIC_AIR_MASS, "no mass flow");
  assert_denied(LAB_METRIC_AIR_VOLUME, "no mass flow");
}

TEST(test_metrics__no_cycle__says_what_is_missing)
{
  record_cycle(4e5, x_0, F);
  record.supply = 0;
  record_measure();
  assert_denied(LAB_METRIC_ENERGY_IN, "supply pressure is not known");
  record.supply = 4e5;
  record.p = NULL;
  record_measure();
  assert_denied(LAB_METRIC_ENERGY_LOST, "no chamber pressure");
  assert_denied(LAB_METRIC_AIR_MASS, "no cycle");
  record.p = record_p;
  record_first[1] = record.n = 2500; /* the way up only */
  record_measure();
  assert_denied(LAB_METRIC_ENERGY_EFFICIENCY, "no full stroke up that a full stroke down follows");
  assert_denied(LAB_METRIC_AIR_VOLUME, "no cycle");
  record.command = LAB_COMMAND_PRESSURE;
  record_measure();
  assert_denied(LAB_METRIC_AIR_MASS, "chamber pressure is the input");
}

/* Up in one run and down in the next is no cycle. */
TEST(test_metrics__two_runs__are_kept_apart)
{
  record_cycle(4e5, x_0, F);
  record_first[2] = record.n;
  record_first[1] = 2000;
  record.n_runs = 2;
  record_measure();
  assert_int_equal(metrics.n_steps, 0);
  assert_denied(LAB_METRIC_ENERGY_IN, "no cycle");
}

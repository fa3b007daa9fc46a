/* Air and energy of a cycle, a full stroke up and then down: [B, section 5]. */
#include <math.h>

#include "metrics_private.h"

static const double normal_pressure = 101325, normal_temperature = 273.15; /* DIN 1343 */
static const double limit = 50;                                            /* [%] [B, Eq. 49] */

typedef struct cycle {
  const lab_leg *up, *down;
} cycle;

static int find_cycle(const lab_metrics_work *m, cycle *c)
{
  const lab_path *rows = &m->rows;
  const double least = LAB_FULL_STROKE * m->record->stroke;
  size_t k;
  for (k = 1; k < rows->n_legs; k++) {
    c->up = &rows->leg[k - 1];
    c->down = &rows->leg[k];
    if (c->up->up && !c->down->up && rows->point[c->up->begin].run == rows->point[c->down->begin].run &&
        lab_leg_travel(rows, c->up) >= least && lab_leg_travel(rows, c->down) >= least)
      return 1;
  }
  return 0;
}

/* Integral of A p dx over a leg by the trapezoidal rule on every `stride`-th point, the last one included. */
static double work(const lab_metrics_work *m, const lab_leg *leg, size_t stride)
{
  const lab_point *at = m->rows.point;
  double sum = 0;
  size_t i = leg->begin, next;
  while (i + 1 < leg->end) {
    next = i + stride < leg->end ? i + stride : leg->end - 1;
    sum += (at[i].s + at[next].s) / 2 * (at[next].x - at[i].x);
    i = next;
  }
  return m->record->area * sum;
}

/* How well an integral is known: noise of the pressure over the stroke and of the ends of the stroke, and the step. */
static double work_error(const lab_metrics_work *m, const lab_leg *leg)
{
  const double noise =
      m->record->area * m->noise_p * lab_leg_travel(&m->rows, leg) / sqrt((double)(leg->end - leg->begin));
  const double ends = m->record->area * m->record->supply * m->noise_x;
  return 2 * noise + ends + fabs(work(m, leg, 1) - work(m, leg, 2));
}

static void report_efficiency(lab_metrics_work *m, double in, double out, double lost, double error)
{
  const double share = 100 * (1 - out / in - lost / in);
  lab_metric_set(m, LAB_METRIC_ENERGY_EFFICIENCY, share, 100 * error / in,
                 share < limit ? "below the limit of 50 %% of Eq. 49; E_o/E_i = %.3g"
                               : "above the limit of 50 %% of Eq. 49, which takes E_o/E_i as 0.5; here it is %.3g",
                 out / in);
}

static void report_energy(lab_metrics_work *m, const cycle *c)
{
  const lab_record *r = m->record;
  const double rise = work(m, c->up, 1), out = -work(m, c->down, 1);
  const double error = work_error(m, c->up) + work_error(m, c->down);
  const double stroke = lab_leg_travel(&m->rows, c->up), in = r->area * r->supply * stroke;
  lab_metric_set(m, LAB_METRIC_ENERGY_IN, in, r->area * r->supply * 2 * m->noise_x,
                 "supply of %.4g kPa, travel of %.4g mm", r->supply / 1e3, 1e3 * stroke);
  lab_metric_set(m, LAB_METRIC_ENERGY_OUT, out, error, "falling stroke of the same cycle");
  lab_metric_set(m, LAB_METRIC_ENERGY_LOST, rise - out, error,
                 "the same cycle; all of it is friction if nothing loads the stem");
  report_efficiency(m, in, out, rise - out, error);
}

/* Integral of the flow from the supply between two times of a run. */
static double inflow(const lab_record *r, int run, double from, double to, size_t stride)
{
  double sum = 0;
  size_t i = r->first[run], next;
  for (; i + 1 < r->first[run + 1] && r->t[i] < to; i = next) {
    next = i + stride < r->first[run + 1] ? i + stride : r->first[run + 1] - 1;
    if (r->t[i] >= from)
      sum += (r->mass_in[i] + r->mass_in[next]) / 2 * (r->t[next] - r->t[i]);
  }
  return sum;
}

static void report_air(lab_metrics_work *m, const cycle *c)
{
  const lab_record *r = m->record;
  const lab_point *begin = &m->rows.point[c->up->begin], *end = &m->rows.point[c->down->end - 1];
  const double mass = inflow(r, begin->run, begin->t, end->t, 1);
  const double error = fabs(mass - inflow(r, begin->run, begin->t, end->t, 2));
  const double litres = 1e3 * r->gas_constant * normal_temperature / normal_pressure;
  lab_metric_set(m, LAB_METRIC_AIR_MASS, mass, error, "first full stroke up and down");
  lab_metric_set(m, LAB_METRIC_AIR_VOLUME, litres * mass, litres * error, "first full stroke up and down");
}

void lab_energy_measure(lab_metrics_work *m)
{
  enum { FIRST = LAB_METRIC_ENERGY_IN, LAST = LAB_METRIC_ENERGY_EFFICIENCY };
  static const char no_cycle[] = "no cycle: no full stroke up that a full stroke down follows";
  const lab_record *r = m->record;
  cycle c;
  const int found = r->p && find_cycle(m, &c);
  if (!r->p)
    lab_metrics_absent(m, FIRST, LAST, "the record has no chamber pressure");
  else if (!found)
    lab_metrics_absent(m, FIRST, LAST, no_cycle);
  else if (!(r->supply > 0))
    lab_metrics_absent(m, FIRST, LAST, "the supply pressure is not known");
  else
    report_energy(m, &c);
  if (r->command == LAB_COMMAND_PRESSURE)
    lab_metrics_absent(m, LAB_METRIC_AIR_MASS, LAB_METRIC_AIR_VOLUME,
                       "chamber pressure is the input: nothing is known of the flow that makes it");
  else if (!r->mass_in)
    lab_metrics_absent(m, LAB_METRIC_AIR_MASS, LAB_METRIC_AIR_VOLUME,
                       "the record has no mass flow; a simulation of it has");
  else if (!found)
    lab_metrics_absent(m, LAB_METRIC_AIR_MASS, LAB_METRIC_AIR_VOLUME, no_cycle);
  else
    report_air(m, &c);
}

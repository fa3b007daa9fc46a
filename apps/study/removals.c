#include "removals.h"

#include <math.h>

#include "stroke.h"

/* H1: the spring pushes with the force it has at mid-travel, whatever the position. A hundredth of the rate is
 * left, so that a bench set exists. */
static void without_spring(pneu_params *p, pneu_laws *laws)
{
  const double middle = p->spring_rate * (p->spring_preload + p->stroke / 2);
  (void)laws;
  p->spring_rate /= 100;
  p->spring_preload = fmin(middle / p->spring_rate - p->stroke / 2, 1.0);
  p->external_force = middle - p->spring_rate * (p->spring_preload + p->stroke / 2);
}

/* H2: no more force at rest than brings the stem home against friction. */
static void without_preload(pneu_params *p, pneu_laws *laws)
{
  (void)laws;
  p->spring_preload = 1.25 * p->dry_friction / p->spring_rate;
}

/* H3: no upper limiter: supply and spring end the travel. */
static void without_limiter(pneu_params *p, pneu_laws *laws)
{
  (void)laws;
  p->stroke = 2 * p->supply_pressure * p->area / p->spring_rate;
}

/* H4: the bench set in the middle of the supply range, where neither stroke is favoured. */
static void without_bench_offset(pneu_params *p, pneu_laws *laws)
{
  (void)laws;
  p->spring_preload = p->supply_pressure / 2 * p->area / p->spring_rate - p->stroke / 2;
}

/* H5: the vent is sized so that both strokes take the same time. */
static void without_unequal_times(pneu_params *p, pneu_laws *laws)
{
  lab_asymmetry r;
  lab_error ignored;
  int i;
  for (i = 0; i < 20; i++) {
    if (stroke_measure(p, laws, &r, &ignored) != LAB_OK)
      return;
    p->vent_area *= r.duration_ratio;
    if (fabs(r.duration_ratio - 1) < 1e-9)
      return;
  }
}

/* H6: filling and venting are made the same process: flow in proportion to the pressure difference whatever the
 * density, the volume of mid-travel throughout, no change of temperature, the bench set in the middle. */
static void without_air_process(pneu_params *p, pneu_laws *laws)
{
  p->dead_volume += p->area * p->stroke / 2;
  p->swept_ratio = 0;
  laws->gas = PNEU_GAS_ISOTHERMAL;
  laws->flow = PNEU_FLOW_LINEAR;
  without_bench_offset(p, laws);
}

const removal removals[REMOVALS] = {[REMOVE_SPRING] = {"H1", without_spring},
                                    [REMOVE_PRELOAD] = {"H2", without_preload},
                                    [REMOVE_LIMITER] = {"H3", without_limiter},
                                    [REMOVE_BENCH_OFFSET] = {"H4", without_bench_offset},
                                    [REMOVE_UNEQUAL_TIMES] = {"H5", without_unequal_times},
                                    [REMOVE_AIR_PROCESS] = {"H6", without_air_process}};

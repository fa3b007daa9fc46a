/* Stops that yield: contact force s/c + d v on a stem that is s beyond a stop, never pulling. The stem then has no
 * rigid stop in its travel: it slides on and sticks by friction beyond 0 and `travel` as between them, so that the
 * modes of the stops do not occur. Rigid stops stay far out: above, twice the stroke; below, where a tenth of the dead
 * volume is left, for the gas must keep a volume.
 * Size: 1e6 to 1e8 N/m; c counts as 1e-11 m/N at least. */
#include "../internal.h"

#define LEAST PNEU_C(1e-11) /* [m/N] stiffer than a solid block */

enum { COMPLIANCE, DAMPING };

static const pneu_param_info params[] = {
    {"stop_compliance", "m/N", 0, PNEU_C(1e-4), PNEU_C(1e-8), 0, 0, "1/stiffness of both stops"},
    {"stop_damping", "N.s/m", 0, PNEU_C(1e7), PNEU_C(1e4), PNEU_C(1e4), 1, "damping of the contact"}};

static int acts(const pneu_model *model, const pneu_real *param)
{
  return model->p.stroke > 0 && param[COMPLIANCE] > 0;
}

static void prepare(pneu_model *model, const pneu_real *param)
{
  const pneu_params *p = &model->p;
  const pneu_real swept = p->area * p->swept_ratio * p->stroke, room = PNEU_C(0.9) * p->dead_volume;
  model->stop_compliance = PNEU_M(fmax)(param[COMPLIANCE], LEAST);
  model->upper_stop = 2 * p->stroke;
  model->lower_stop = room < swept ? -p->stroke * room / swept : -p->stroke;
}

/* Force of a stop on a stem that has gone `beyond` it at a given speed. */
static pneu_real contact(const pneu_model *model, pneu_real damping, pneu_real beyond, pneu_real speed)
{
  const pneu_real force = beyond > 0 ? beyond / model->stop_compliance + damping * speed : 0;
  return force > 0 ? force : 0;
}

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  (void)state, (void)rate;
  t->force += contact(t->model, param[DAMPING], -t->x, -t->v);
  t->force -= contact(t->model, param[DAMPING], t->x - t->model->travel, t->v);
}

const pneu_effect pneu_effect_record_stop_compliance = {
    "stop_compliance",
    "The stops yield like springs and the stem may bounce.",
    "Kelvin-Voigt contact; its limits: Hunt and Crossley 1975, ASME J. Appl. Mech. 42:440",
    "force",
    "position moves on slightly at the stops as pressure changes, and rings after impact",
    PNEU_STAGE_FORCE,
    params,
    .add = add,
    .acts = acts,
    .prepare = prepare};

const char pneu_effect_sentence_stop_compliance[] = "The stops yield: {size}.";

/* Rubber, cloth and plastic give way slowly: beside the spring a second one of stiffness k, in series with a dashpot,
 * so that the force is k (x - y) with y' = (x - y)/tau. The state is y over the stroke; at rest y = x. In less than
 * 0.2 s it is damping.
 * Size: of soft bellows 0.13 times the spring's rate over 4 s, of a soft arm 1.4 times over 0.6 s
 * (results/measured). */
#include "../internal.h"

enum { STIFFNESS, TIME };

static const pneu_param_info params[] = {
    {"creep_stiffness", "N/m", 0, PNEU_C(1e9), PNEU_C(1e4), 0, 0, "by which quick strokes are stiffer than slow ones"},
    {"creep_time", "s", PNEU_C(0.2), PNEU_C(1e5), PNEU_C(10.0), PNEU_C(10.0), 1,
     "time constant with which that dies out"}};

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  const pneu_real ahead = t->x / t->model->scale[2] - state[0];
  rate[0] = ahead / param[TIME];
  t->force -= param[STIFFNESS] * t->model->scale[2] * ahead;
}

static void start(const pneu_real *param, const pneu_terms *t, pneu_real *state)
{
  (void)param;
  state[0] = t->x / t->model->scale[2];
}

const pneu_effect pneu_effect_record_spring_creep = {
    "spring_creep",
    "Spring, diaphragm or bellows give way slowly: the stem goes on under a constant force.",
    "standard linear solid: Zener 1948, Elasticity and Anelasticity of Metals",
    "force",
    "after each stroke the position moves on in the same sense and settles; quick strokes seem to have a stiffer "
    "spring",
    PNEU_STAGE_FORCE,
    params,
    .add = add,
    .start = start};

const char pneu_effect_sentence_spring_creep[] =
    "Spring, diaphragm or bellows give way slowly: to quick strokes they are {size} stiffer, {of_rate} of the spring.";

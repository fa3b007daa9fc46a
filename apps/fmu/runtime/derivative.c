/* Directional derivatives: one central difference along the seed, whatever the variables are. */
#include <math.h>

#include "private.h"

/* Of full scale: the cube root of rounding, where rounding and curvature take the same share. */
#define DISTANCE 6e-6

enum { KNOWN_MAX = FMU_INPUT_COUNT + FMU_START_COUNT + PNEU_STATE_MAX + PNEU_PARAM_COUNT };

/* A variable on which others depend: where it lies, NULL where nothing follows it at present; its full scale, and the
 * range in which it acts. */
typedef struct known {
  double *at;
  double scale, lower, upper;
} known;

static known known_input(fmu_instance *i, int which)
{
  const double p = i->model.scale[0], x = i->model.scale[2], v = i->model.scale[3];
  const double stroke = i->m.params.stroke, force = p * i->m.params.area;
  const int kind = fmu_command_kind(&i->m.params);
  const double u_end = kind == FMU_COMMAND_OPENING ? 1 : HUGE_VAL;
  const known inputs[FMU_INPUT_COUNT] = {
      {NULL, kind == FMU_COMMAND_PRESSURE ? p : 1, -u_end, u_end},
      {NULL, p, -HUGE_VAL, HUGE_VAL},
      {NULL, force, -HUGE_VAL, HUGE_VAL},
      {NULL, p, -HUGE_VAL, HUGE_VAL},
      {NULL, p, -HUGE_VAL, HUGE_VAL},
      {NULL, x, 0, stroke},
      {NULL, v, -HUGE_VAL, HUGE_VAL},
  };
  known k = inputs[which];
  k.at = &i->m.input[which];
  return k;
}

static known known_start(fmu_instance *i, int which)
{
  const known starts[FMU_START_COUNT] = {{NULL, i->model.scale[0], -HUGE_VAL, HUGE_VAL},
                                         {NULL, i->model.scale[1], 0, HUGE_VAL},
                                         {NULL, i->model.scale[2], 0, i->m.params.stroke}};
  known k = starts[which];
  k.at = &i->m.start[which];
  return k;
}

static known known_parameter(fmu_instance *i, int which)
{
  double *at = pneu_param_at(&i->m.params, which);
  pneu_param_info info;
  known k;
  pneu_param_describe(which, &info);
  k.at = at;
  k.scale = fmax(fabs(*at), fabs(info.value));
  k.scale = k.scale > 0 ? k.scale : 1e-3 * info.upper;
  k.lower = info.lower;
  k.upper = info.upper;
  return k;
}

static known known_state(fmu_instance *i, int kind)
{
  const int acts = fmu_packed_at(&i->model, i->m.state.mode, kind) >= 0;
  known k = {NULL, 1, -HUGE_VAL, HUGE_VAL};
  k.at = acts ? fmu_state_at(&i->model, &i->m.state, kind) : NULL;
  k.scale = kind < FMU_STATE_EFFECT ? i->model.scale[kind] : 1;
  return k;
}

/* Before initialisation ends states follow from start values and parameters; then these are fixed. */
static int find(fmu_instance *i, unsigned r, known *k)
{
  const int before = (i->m.phase & (FMU_INSTANTIATED | FMU_INITIALIZING)) != 0;
  int s;
  if (!fmu_has_variable(&fmu_model_data.law, r))
    return FMU_ERROR;
  for (s = 0; s < i->shape.n && !before; s++)
    if (fmu_state_reference(i->shape.kind[s]) == r) {
      *k = known_state(i, i->shape.kind[s]);
      return FMU_OK;
    }
  if (r >= FMU_REF_INPUT && r < FMU_REF_INPUT + FMU_INPUT_COUNT)
    *k = known_input(i, (int)(r - FMU_REF_INPUT));
  else if (before && r >= FMU_REF_START && r < FMU_REF_START + FMU_START_COUNT)
    *k = known_start(i, (int)(r - FMU_REF_START));
  else if (before && r >= FMU_REF_PARAMETER && fmu_has_parameter(&fmu_model_data, (int)(r - FMU_REF_PARAMETER)))
    *k = known_parameter(i, (int)(r - FMU_REF_PARAMETER));
  else
    return FMU_ERROR;
  return FMU_OK;
}

/* Go from the present point along the seed; at the end of a range the present point is one inside, lest half of the
 * difference lie where nothing acts. */
static void go(fmu_instance *i, const known *k, size_t n, const double *seed, double distance)
{
  size_t j;
  for (j = 0; j < n; j++) {
    const double by = distance * seed[j], most = fabs(by);
    if (!k[j].at)
      continue;
    if (*k[j].at >= k[j].lower && *k[j].at <= k[j].upper)
      *k[j].at = fmin(fmax(*k[j].at, k[j].lower + most), k[j].upper - most);
    *k[j].at += by;
  }
  if (i->m.phase & (FMU_INSTANTIATED | FMU_INITIALIZING))
    i->m.stale = 1;
  else
    fmu_impose(i);
}

static int look(fmu_instance *i, const unsigned *unknown, size_t n, double *value)
{
  size_t j;
  int status = fmu_refresh(i);
  for (j = 0; j < n && status == FMU_OK; j++)
    status = fmu_value(i, unknown[j], &value[j]);
  return status;
}

int fmu_derivative(fmu_instance *i, const unsigned *unknown, size_t n_unknown, const unsigned *reference,
                   size_t n_known, const double *seed, double *sensitivity)
{
  known k[KNOWN_MAX];
  fmu_memory keep;
  double size = 0, distance, value;
  size_t j;
  int status;
  if (fmu_may(i, FMU_CALL_DIFFERENTIATE) || fmu_refresh(i))
    return FMU_ERROR;
  for (j = 0; j < n_known; j++) {
    if (n_known > KNOWN_MAX || find(i, reference[j], &k[j]) || !(seed[j] * 0 == 0))
      return fmu_say(i, FMU_ERROR, "no derivative by reference %u now, or a seed is no number", reference[j]);
    size = fmax(size, fabs(seed[j]) / k[j].scale);
  }
  keep = i->m;
  distance = size > 0 ? DISTANCE / size : 1;
  go(i, k, n_known, seed, distance);
  status = look(i, unknown, n_unknown, sensitivity);
  i->m = keep;
  go(i, k, n_known, seed, -distance);
  for (j = 0; j < n_unknown && status == FMU_OK; j++) {
    status = look(i, &unknown[j], 1, &value);
    sensitivity[j] = (sensitivity[j] - value) / (2 * distance);
  }
  i->m = keep;
  i->m.stale |= (i->m.phase & (FMU_INSTANTIATED | FMU_INITIALIZING)) != 0;
  return status;
}

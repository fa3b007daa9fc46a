#include "servomotor.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "measured.h"

const servo_law servo_laws[] = {
    {"coulomb", 0, {0}},
    {"friction-position", 1, {SERVO_FRICTION_POSITION}},
    {"friction-pressure", 1, {SERVO_FRICTION_PRESSURE}},
    {"hardening", 1, {SERVO_SPRING_HARDENING}},
    {"area", 1, {SERVO_AREA_VARIATION}},
    {"friction-position+hardening", 2, {SERVO_FRICTION_POSITION, SERVO_SPRING_HARDENING}},
    {"friction-pressure+hardening", 2, {SERVO_FRICTION_PRESSURE, SERVO_SPRING_HARDENING}},
    {"friction-position+area", 2, {SERVO_FRICTION_POSITION, SERVO_AREA_VARIATION}},
    {"friction-position+hardening+area", 3, {SERVO_FRICTION_POSITION, SERVO_SPRING_HARDENING, SERVO_AREA_VARIATION}},
};
const int servo_law_count = (int)(sizeof servo_laws / sizeof servo_laws[0]);

/* ---- Parameters ---- */

typedef struct term_info {
  const char *key, *unit;
  double scale, start, lower, upper; /* of reports; theta = value / scale */
} term_info;

static const term_info base[SERVO_BASE_COUNT] = {
    {"bench_low", "kPa", 1e-3, 20, -50, 200}, {"span", "kPa", 1e-3, 80, 1, 500}, {"friction", "kPa", 1e-3, 4, 0, 50}};

static const term_info terms[SERVO_TERM_COUNT] = {
#define X(name, key, unit, scale, start, lower, upper, what) {key, unit, scale, start, lower, upper},
    SERVO_TERM_LIST(X)
#undef X
};

static const term_info *info_of(const servo_law *law, int j)
{
  return j < SERVO_BASE_COUNT ? &base[j] : &terms[law->term[j - SERVO_BASE_COUNT]];
}

const char *servo_key(const servo_law *law, int j)
{
  return info_of(law, j)->key;
}

const char *servo_unit(const servo_law *law, int j)
{
  return info_of(law, j)->unit;
}

double servo_scale(const servo_law *law, int j)
{
  return info_of(law, j)->scale;
}

static void describe(const servo_law *law, lab_fit_param *param)
{
  int j;
  for (j = 0; j < SERVO_BASE_COUNT + law->n; j++) {
    const term_info *i = info_of(law, j);
    const lab_fit_param made = {i->key, "SI", i->start / i->scale, i->lower / i->scale, i->upper / i->scale, 0, 0};
    param[j] = made;
  }
}

/* ---- Loop ---- */

/* What the drawing resolves [m]: 0.14 % of 38.1 mm. */
static const double resolution = 0.0014 * 38.1e-3;

static int add_point(void *context, const char *text, lab_error *error)
{
  servomotor *s = context;
  char branch[16];
  double p_kPa, x_percent;
  const size_t i = s->n;
  if (sscanf(text, "%15[^,],%lf,%lf", branch, &p_kPa, &x_percent) != 3 ||
      (strcmp(branch, "lower") != 0 && strcmp(branch, "upper") != 0))
    return lab_fail(error, LAB_DATA, "expected lower or upper, pressure, position; found \"%s\"", text);
  if (i == SERVO_POINTS)
    return lab_fail(error, LAB_DATA, "more than %d points", SERVO_POINTS);
  s->direction[i] = strcmp(branch, "lower") ? -1 : 1;
  s->p[i] = 1e3 * p_kPa;
  s->x[i] = 0.01 * x_percent * s->nominal;
  s->sliding[i] = s->x[i] > 2 * resolution && s->x[i] < (double)s->rig.params.stroke - 2 * resolution;
  s->n++;
  return LAB_OK;
}

int servo_read(const char *rig_path, const char *loop_path, servomotor *s, lab_error *error)
{
  memset(s, 0, sizeof *s);
  s->nominal = 38.1e-3; /* the data's unit of travel, from their source */
  if (lab_rig_read(rig_path, &s->rig, error) || measured_lines(loop_path, add_point, s, error))
    return error->status;
  return LAB_OK;
}

/* ---- Balance of forces ---- */

/* The library's model under a law, and the terms that it does not have. */
typedef struct balance {
  pneu_model model;
  const servomotor *s;
  const servo_law *law;
  const double *theta;
} balance;

static int balance_open(balance *b, const servomotor *s, const servo_law *law, const double *theta, lab_error *error)
{
  pneu_params p = s->rig.params;
  pneu_laws laws = s->rig.laws;
  int status;
  p.spring_rate = (pneu_real)(theta[SERVO_SPAN] * p.area / s->nominal);
  p.spring_preload = (pneu_real)(theta[SERVO_BENCH_LOW] / theta[SERVO_SPAN] * s->nominal);
  p.dry_friction = (pneu_real)(theta[SERVO_FRICTION] * p.area);
  laws.pressure_input = 1;
  b->s = s;
  b->law = law;
  b->theta = theta;
  status = pneu_model_init(&b->model, &p, &laws, NULL);
  return status == PNEU_OK ? LAB_OK : lab_fail(error, LAB_NUMERIC, "%s: %s", law->name, pneu_status_text(status));
}

/* A term as a pressure on the diaphragm against the air [Pa]. */
static double term_pressure(int term, double c, double xi, double p, int direction)
{
  switch (term) {
  case SERVO_FRICTION_POSITION:
    return direction * c * xi;
  case SERVO_FRICTION_PRESSURE:
    return direction * c * p;
  case SERVO_SPRING_HARDENING:
    return c * xi * xi * xi;
  default: /* SERVO_AREA_VARIATION */
    return -c * xi * p;
  }
}

/* Force of all terms, as pneu_input has it. */
static pneu_real added_force(const balance *b, double p, double x, int direction)
{
  double sum = 0;
  int j;
  for (j = 0; j < b->law->n; j++)
    sum += term_pressure(b->law->term[j], b->theta[SERVO_BASE_COUNT + j], x / b->s->nominal, p, direction);
  return (pneu_real)sum * b->model.p.area;
}

/* Acceleration of a stem that creeps through x. */
static double acceleration(const balance *b, double p, double x, int direction)
{
  pneu_real y[PNEU_STATE_MAX], rate[PNEU_STATE_MAX];
  pneu_state state;
  pneu_input input;
  int n;
  memset(&state, 0, sizeof state);
  state.p = (pneu_real)p;
  state.T = b->model.p.ambient_temperature;
  state.x = (pneu_real)x;
  state.mode = direction > 0 ? PNEU_MODE_UP : PNEU_MODE_DOWN;
  pneu_input_default(&b->model, &input);
  input.force = added_force(b, p, x, direction);
  n = pneu_pack(&b->model, &state, y);
  return pneu_rhs(&b->model, &state, &input, y, rate) == PNEU_OK ? (double)rate[n - 1] : (double)NAN;
}

/* Pressure without acceleration: every term is linear in pressure, so that one secant is exact. */
static double balancing_pressure(const balance *b, double x, int direction)
{
  const double high = 1e5, at_zero = acceleration(b, 0, x, direction), at_high = acceleration(b, high, x, direction);
  return high * at_zero / (at_zero - at_high);
}

int servo_pressure(const servomotor *s, const servo_law *law, const double *theta, double x, int direction, double *p,
                   lab_error *error)
{
  balance b;
  if (balance_open(&b, s, law, theta, error))
    return error->status;
  *p = balancing_pressure(&b, x, direction);
  return LAB_OK;
}

/* ---- Fit ---- */

typedef struct job {
  const servomotor *s;
  const servo_law *law;
  const unsigned char *use;
} job;

static int counts(const job *j, size_t i)
{
  return j->s->sliding[i] && (!j->use || j->use[i]);
}

static int residuals(void *context, const double *theta, double *r, lab_error *error)
{
  const job *j = context;
  balance b;
  size_t i, k = 0;
  if (balance_open(&b, j->s, j->law, theta, error))
    return error->status;
  for (i = 0; i < j->s->n; i++)
    if (counts(j, i))
      r[k++] = balancing_pressure(&b, j->s->x[i], j->s->direction[i]) - j->s->p[i];
  return LAB_OK;
}

int servo_fit(const servomotor *s, const servo_law *law, const unsigned char *use, lab_fit_result *fit,
              lab_error *error)
{
  lab_fit_param param[SERVO_FIT_MAX];
  job j = {s, law, use};
  lab_fit_problem problem = {SERVO_BASE_COUNT + law->n, param, 0, residuals, NULL, &j, NULL, 0};
  size_t i;
  describe(law, param);
  for (i = 0; i < s->n; i++)
    problem.m += (size_t)counts(&j, i);
  return lab_fit_run(&problem, NULL, fit, error);
}

/* ---- Ramp ---- */

static const double ramp_rate = 1e3; /* [Pa/s]: viscous friction then is below 10 Pa */

/* From one pressure to the next, in the direction of `direction`. */
static int ramp_step(const balance *b, pneu_state *state, double to, int direction, pneu_workspace *work,
                     lab_error *error)
{
  const double duration = fabs(to - (double)state->p) / ramp_rate;
  pneu_options options;
  pneu_input input;
  int status;
  pneu_options_default(&options);
  pneu_input_default(&b->model, &input);
  input.pressure_rate = (pneu_real)(direction * ramp_rate);
  input.force = added_force(b, (double)state->p, (double)state->x, direction);
  pneu_settle(&b->model, &input, state);
  status = pneu_run(&b->model, state, &input, (pneu_real)duration, &options, NULL, work);
  if (status == PNEU_OK)
    return LAB_OK;
  return lab_fail(error, LAB_NUMERIC, "ramp of pressure at p = %.6g Pa, x = %.6g m: %s", (double)state->p,
                  (double)state->x, pneu_status_text(status));
}

int servo_ramp(const servomotor *s, const servo_law *law, const double *theta, double top, size_t n, double *p,
               double *x, lab_error *error)
{
  pneu_workspace work;
  pneu_input input;
  pneu_state state;
  balance b;
  size_t i;
  if (balance_open(&b, s, law, theta, error))
    return error->status;
  memset(&work, 0, sizeof work);
  pneu_input_default(&b.model, &input);
  if (pneu_state_rest(&b.model, 0, b.model.p.ambient_temperature, 0, &input, &state) != PNEU_OK)
    return lab_fail(error, LAB_NUMERIC, "the stem cannot rest on its lower stop");
  for (i = 0; i < 2 * n; i++) {
    const int direction = i < n ? 1 : -1;
    const double to = top * (double)(i < n ? i : 2 * n - 1 - i) / (double)(n - 1);
    if (ramp_step(&b, &state, to, direction, &work, error))
      return error->status;
    p[i] = (double)state.p;
    x[i] = (double)state.x;
  }
  return LAB_OK;
}

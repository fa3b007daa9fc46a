#include "vessel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../lab/run/response.h"
#include "measured.h"

static const double tolerance = 1e-9; /* of full scale; pressures are then good to 1 Pa and better */

/* Weights where both channels are fitted: about the scatter that the energy balance leaves in each alone. Equal
 * weights within a channel do not matter to a fit of that channel. */
static const double sigma_p = 2e3, sigma_T = 2; /* [Pa], [K] */

#define CHOKED PNEU_FLOW_CHOKED
const vessel_law vessel_laws[] = {
    {"paper",
     "isothermal; flow that never chokes [B, Eqs. 7-8]",
     PNEU_GAS_ISOTHERMAL,
     PNEU_FLOW_PAPER,
     0,
     1,
     {VESSEL_ORIFICE}},
    {"isothermal", "isothermal; nozzle", PNEU_GAS_ISOTHERMAL, CHOKED, 0, 1, {VESSEL_ORIFICE}},
    {"adiabatic", "n = 1.4; nozzle", PNEU_GAS_POLYTROPIC, CHOKED, 0, 1, {VESSEL_ORIFICE}},
    {"polytropic", "n fitted; nozzle", PNEU_GAS_POLYTROPIC, CHOKED, 0, 2, {VESSEL_ORIFICE, VESSEL_INDEX}},
    {"film",
     "energy balance with a constant film; nozzle",
     PNEU_GAS_ENERGY,
     CHOKED,
     0,
     2,
     {VESSEL_ORIFICE, VESSEL_FILM}},
    {"convection",
     "energy balance with natural convection; nozzle",
     PNEU_GAS_ENERGY,
     CHOKED,
     0,
     2,
     {VESSEL_ORIFICE, VESSEL_CONVECTION}},
    {"convection-paper",
     "energy balance with natural convection; flow that never chokes",
     PNEU_GAS_ENERGY,
     PNEU_FLOW_PAPER,
     0,
     2,
     {VESSEL_ORIFICE, VESSEL_CONVECTION}},
    {"convection-ends",
     "as convection; start and outside pressure fitted too",
     PNEU_GAS_ENERGY,
     CHOKED,
     0,
     4,
     {VESSEL_ORIFICE, VESSEL_CONVECTION, VESSEL_START, VESSEL_OUTSIDE}},
    {"film-both",
     "as film; fitted to pressure and temperature",
     PNEU_GAS_ENERGY,
     CHOKED,
     1,
     2,
     {VESSEL_ORIFICE, VESSEL_FILM}},
    {"convection-both",
     "as convection; fitted to pressure and temperature",
     PNEU_GAS_ENERGY,
     CHOKED,
     1,
     2,
     {VESSEL_ORIFICE, VESSEL_CONVECTION}},
};
const int vessel_law_count = (int)(sizeof vessel_laws / sizeof vessel_laws[0]);

/* ---- Items ---- */

typedef struct item_info {
  const char *key, *unit;
  double scale;
  int log_scaled;
  double start, lower, upper;
} item_info;

static const item_info items[VESSEL_ITEM_COUNT] = {
#define X(name, key, unit, scale, log, start, lower, upper) {key, unit, scale, log, start, lower, upper},
    VESSEL_ITEM_LIST(X)
#undef X
};

const char *vessel_item_key(int item)
{
  return items[item].key;
}

const char *vessel_item_unit(int item)
{
  return items[item].unit;
}

double vessel_item_scale(int item)
{
  return items[item].scale;
}

static void describe(const vessel_law *law, lab_fit_param *param)
{
  int j;
  for (j = 0; j < law->n; j++) {
    const item_info *i = &items[law->item[j]];
    const lab_fit_param made = {i->key,        "SI", i->start / i->scale, i->lower / i->scale, i->upper / i->scale,
                                i->log_scaled, 0};
    param[j] = made;
  }
}

/* ---- Record ---- */

int vessel_open(const char *rig_path, const char *log_path, vessel *v, lab_error *error)
{
  memset(v, 0, sizeof *v);
  if (lab_rig_read(rig_path, &v->rig, error))
    return error->status;
  if (lab_log_read(log_path, &v->rig.log, (double)v->rig.params.ambient_pressure, &v->log, error))
    return error->status;
  if (v->log.value[LAB_CHANNEL_P] && v->log.value[LAB_CHANNEL_T] && v->log.n_runs == 1)
    return LAB_OK;
  vessel_close(v);
  return lab_fail(error, LAB_DATA, "%s: expected one run with pressure and temperature", log_path);
}

void vessel_close(vessel *v)
{
  lab_log_free(&v->log);
}

/* ---- Model ---- */

static void put_effect(pneu_params *p, const char *name, double value)
{
  pneu_real *place = pneu_param_at(p, measured_effect_param("heat_transfer", name));
  if (place)
    *place = (pneu_real)value;
}

/* Parameters under a law. The vessel is charged to the supply pressure: that is where it starts. */
static pneu_params parameters(const vessel *v, const vessel_law *law, const double *theta)
{
  pneu_params p = v->rig.params;
  const pneu_real start_abs = p.supply_pressure + p.ambient_pressure;
  double value[VESSEL_ITEM_COUNT];
  int j;
  for (j = 0; j < VESSEL_ITEM_COUNT; j++)
    value[j] = (double)NAN;
  for (j = 0; j < law->n; j++)
    value[law->item[j]] = theta[j];
  p.fill_area = p.vent_area = (pneu_real)value[VESSEL_ORIFICE];
  put_effect(&p, "film_conductance", isnan(value[VESSEL_FILM]) ? 0 : value[VESSEL_FILM]);
  put_effect(&p, "free_convection", isnan(value[VESSEL_CONVECTION]) ? 0 : value[VESSEL_CONVECTION]);
  if (!isnan(value[VESSEL_INDEX]))
    p.polytropic_index = (pneu_real)value[VESSEL_INDEX];
  if (!isnan(value[VESSEL_OUTSIDE]))
    p.ambient_pressure = (pneu_real)value[VESSEL_OUTSIDE];
  p.supply_pressure = (isnan(value[VESSEL_START]) ? start_abs : (pneu_real)value[VESSEL_START]) - p.ambient_pressure;
  return p;
}

double vessel_exponent(const vessel *v, const vessel_law *law, const double *theta)
{
  if (law->gas == PNEU_GAS_ISOTHERMAL)
    return 1;
  return law->gas == PNEU_GAS_POLYTROPIC ? (double)parameters(v, law, theta).polytropic_index : (double)NAN;
}

static int respond(const pneu_model *model, const double *t, size_t n, lab_trace *trace, lab_error *error)
{
  const lab_response_options options = {LAB_STEPPER, tolerance, t[n - 1], 0, 0, 0};
  const double from = 0;
  pneu_input input;
  const lab_schedule schedule = {1, &from, &input};
  pneu_state state;
  int status;
  pneu_input_default(model, &input);
  input.u = -1;
  status = pneu_state_rest(model, model->p.supply_pressure, model->p.supply_temperature, 0, &input, &state);
  if (status != PNEU_OK)
    return lab_fail(error, LAB_NUMERIC, "start of the vessel: %s", pneu_status_text(status));
  return lab_respond(model, &state, &schedule, t, n, &options, trace, NULL, error);
}

int vessel_predict(const vessel *v, const vessel_law *law, const double *theta, const double *t, size_t n, double *p,
                   double *T, lab_error *error)
{
  const pneu_params params = parameters(v, law, theta);
  const double shift = (double)(params.ambient_pressure - v->rig.params.ambient_pressure);
  pneu_laws laws = v->rig.laws;
  pneu_model model;
  lab_trace trace;
  size_t i;
  int bad, status;
  laws.gas = law->gas;
  laws.flow = law->flow;
  if ((status = pneu_model_init(&model, &params, &laws, &bad)) != PNEU_OK)
    return lab_fail(error, LAB_NUMERIC, "%s: %s", law->name, pneu_status_text(status));
  if (respond(&model, t, n, &trace, error))
    return error->status;
  for (i = 0; i < n; i++) {
    p[i] = trace.p[i] + shift; /* gauge to the ambient of the rig file, as the log is */
    T[i] = trace.T[i];
  }
  lab_trace_free(&trace);
  return LAB_OK;
}

/* ---- Fit ---- */

/* A fit in progress: model and rows. */
typedef struct job {
  const vessel *v;
  const vessel_law *law;
  const unsigned char *use;
  double *p, *T; /* at the rows of the log */
} job;

static int counts(const job *j, size_t row, int wanted)
{
  return !j->use || !!j->use[row] == wanted;
}

/* Whether a value of a row is fitted. */
static int fitted(const job *j, int channel, size_t row)
{
  return !isnan(j->v->log.value[channel][row]) && counts(j, row, 1) && (channel == LAB_CHANNEL_P || j->law->with_T);
}

static int residuals(void *context, const double *theta, double *r, lab_error *error)
{
  job *j = context;
  const lab_log *log = &j->v->log;
  size_t i, k = 0;
  if (vessel_predict(j->v, j->law, theta, log->value[LAB_CHANNEL_TIME], log->n, j->p, j->T, error))
    return error->status;
  for (i = 0; i < log->n; i++) {
    if (fitted(j, LAB_CHANNEL_P, i))
      r[k++] = (j->p[i] - log->value[LAB_CHANNEL_P][i]) / sigma_p;
    if (fitted(j, LAB_CHANNEL_T, i))
      r[k++] = (j->T[i] - log->value[LAB_CHANNEL_T][i]) / sigma_T;
  }
  return LAB_OK;
}

static int job_open(job *j, const vessel *v, const vessel_law *law, const unsigned char *use, lab_error *error)
{
  j->v = v;
  j->law = law;
  j->use = use;
  j->p = calloc(2 * v->log.n, sizeof *j->p);
  if (!j->p)
    return lab_fail_memory(error, "a vessel");
  j->T = j->p + v->log.n;
  return LAB_OK;
}

int vessel_fit(const vessel *v, const vessel_law *law, const unsigned char *use, lab_fit_result *fit, lab_error *error)
{
  lab_fit_param param[VESSEL_FIT_MAX];
  lab_fit_problem problem = {law->n, param, 0, residuals, NULL, NULL, NULL, 0};
  job j;
  size_t i;
  int status;
  if (job_open(&j, v, law, use, error))
    return error->status;
  describe(law, param);
  problem.context = &j;
  for (i = 0; i < v->log.n; i++)
    problem.m += (size_t)fitted(&j, LAB_CHANNEL_P, i) + (size_t)fitted(&j, LAB_CHANNEL_T, i);
  status = lab_fit_run(&problem, NULL, fit, error);
  free(j.p);
  return status;
}

/* ---- Errors ---- */

/* Sums over a stretch of errors. */
static void sum_errors(const double *e, size_t n, vessel_error *out)
{
  double squares = 0, products = 0;
  size_t i;
  memset(out, 0, sizeof *out);
  out->n = n;
  for (i = 0; i < n; i++) {
    squares += e[i] * e[i];
    products += i ? e[i] * e[i - 1] : 0;
    out->largest = fmax(out->largest, fabs(e[i]));
  }
  out->rmse = sqrt(squares / (double)n);
  out->lag1 = products / squares;
}

int vessel_errors(const vessel *v, const vessel_law *law, const double *theta, int channel, const unsigned char *use,
                  int wanted, vessel_error *out, lab_error *error)
{
  const double *data = v->log.value[channel];
  const double *model;
  size_t i, n = 0;
  job j;
  int status;
  if (job_open(&j, v, law, use, error))
    return error->status;
  model = channel == LAB_CHANNEL_P ? j.p : j.T;
  status = vessel_predict(v, law, theta, v->log.value[LAB_CHANNEL_TIME], v->log.n, j.p, j.T, error);
  for (i = 0; status == LAB_OK && i < v->log.n; i++)
    if (!isnan(data[i]) && counts(&j, i, wanted))
      j.p[n++] = model[i] - data[i]; /* n <= i: what is still to be read stays */
  if (status == LAB_OK)
    sum_errors(j.p, n, out);
  free(j.p);
  return status;
}

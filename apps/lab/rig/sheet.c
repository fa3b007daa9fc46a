#include "sheet.h"

#include <math.h>
#include <string.h>

#include "../base/config.h"
#include "../base/names.h"

static const double pi = 3.14159265358979324;
static const double bar = 1e5, atmosphere = 101325, hour = 3600; /* [Pa], [Pa], [s] */
static const double room = 293.15;                               /* [K] of the air that a sheet speaks of */
static const double air = 287.05;                                /* [J/kg/K] dry */
static const double usual_xT = 0.72;

int lab_sheet_has(const char *group, const char *key)
{
  static const struct {
    const char *key, *group;
  } words[] = {{"bench_set", "actuator"},
               {"diameter", "actuator"},
               {"fail", "actuator"},
               {"fill", "transducer"},
               {"vent", "transducer"}};
  const int i = lab_name_index(key, words, sizeof words / sizeof words[0], sizeof words[0]);
  return i >= 0 && strcmp(words[i].group, group) == 0;
}

/* Set a parameter, within its bounds; `other` is the key that says the same and must not be there. */
static int put(const config_setting_t *from, int param, double value, const config_setting_t *other, lab_rig *rig,
               lab_error *error)
{
  const pneu_param_info info = lab_param_info(param);
  if (other)
    return lab_config_fail(from, error, "%s is there too: give one of them", config_setting_name(other));
  if (!(value >= (double)info.lower && value <= (double)info.upper))
    return lab_config_fail(from, error, "gives a %s of %g %s; expected %g to %g", info.name, value, info.unit,
                           (double)info.lower, (double)info.upper);
  *pneu_param_at(&rig->params, param) = (pneu_real)(value + 0.0); /* a zero without sign, as it is written */
  rig->assumed[param] = 0;
  return LAB_OK;
}

/* ---- Diaphragm, spring, side ---- */

static int read_diameter(const config_setting_t *actuator, lab_rig *rig, lab_error *error)
{
  const config_setting_t *diameter = lab_config_member(actuator, "diameter");
  double d;
  if (!diameter)
    return LAB_OK;
  if (lab_config_quantity(diameter, "m", 1e-3, 10, &d, error))
    return error->status;
  return put(diameter, PNEU_PARAM_area, pi / 4 * d * d, lab_config_member(actuator, "area"), rig, error);
}

/* Air that closes a valve: how far it is open falls as the stem follows the air. */
static int read_fail(const config_setting_t *actuator, lab_rig *rig, lab_error *error)
{
  static const char *const words[] = {"close", "open"};
  const config_setting_t *fail = lab_config_member(actuator, "fail");
  const double stroke = (double)rig->params.stroke;
  int word;
  if (!fail)
    return LAB_OK;
  if (lab_config_choice(fail, words, 2, sizeof words[0], &word, error))
    return error->status;
  if (!word)
    return LAB_OK;
  if (!(stroke > 0))
    return lab_config_fail(fail, error, "needs actuator.stroke above 0");
  lab_log_format_turn(&rig->log, LAB_CHANNEL_X, stroke);
  lab_log_format_turn(&rig->log, LAB_CHANNEL_SP, 1);
  return LAB_OK;
}

static int read_bench_set(const config_setting_t *actuator, lab_rig *rig, lab_error *error)
{
  const config_setting_t *set = lab_config_member(actuator, "bench_set");
  const double area = (double)rig->params.area, stroke = (double)rig->params.stroke;
  double low, high, rate;
  if (!set)
    return LAB_OK;
  if (lab_config_list(set, 2, 2, error) ||
      lab_config_quantity(config_setting_get_elem(set, 0), "Pa", -bar, INFINITY, &low, error) ||
      lab_config_quantity(config_setting_get_elem(set, 1), "Pa", 1e3, INFINITY, &high, error))
    return error->status;
  if (!(low < high))
    return lab_config_fail(set, error, "expected the lower pressure first, found %g Pa and %g Pa", low, high);
  if (!(stroke > 0))
    return lab_config_fail(set, error, "needs actuator.stroke above 0");
  rate = area * (high - low) / stroke;
  if (put(set, PNEU_PARAM_spring_rate, rate, lab_config_member(actuator, "spring_rate"), rig, error))
    return error->status;
  return put(set, PNEU_PARAM_spring_preload, area * low / rate, lab_config_member(actuator, "spring_preload"), rig,
             error);
}

/* ---- Orifices ---- */

/* Air at 293.15 K that flows from p_up to p_down. */
typedef struct passed {
  double p_up, p_down; /* [Pa] abs */
  double q;            /* [kg/s] */
} passed;

/* From 6 bar to 5 bar where the law does not choke, else choked. */
static passed reference(const lab_rig *rig)
{
  const passed p = {atmosphere + 6 * bar, rig->laws.flow == PNEU_FLOW_PAPER ? atmosphere + 5 * bar : 0, 0};
  return p;
}

/* IEC 60534-2-1.  In: kv [m3/h] */
static passed flow_of_kv(const lab_rig *rig, double kv, double xT)
{
  passed p = reference(rig);
  const double x = fmin(1 - p.p_down / p.p_up, xT), rho = p.p_up / (air * room);
  p.q = 31.6 * kv * (1 - x / (3 * xT)) * sqrt(x * p.p_up / bar * rho) / hour;
  return p;
}

/* ISO 6358-1.  In: c [m3/(s Pa)] */
static passed flow_of_c(const lab_rig *rig, double c, double b)
{
  passed p = reference(rig);
  const double z = fmax((p.p_down / p.p_up - b) / (1 - b), 0);
  p.q = c * p.p_up * bar / (air * room) * sqrt(1 - z * z);
  return p;
}

/* What a sheet says of an orifice. Qn and C end beyond the largest boosters, with a Kv of 40, and p1 at 10 mbar, so
 * that a number meant in litres or bar is refused. */
enum { KV, CV, C, B, QN, XT, P1, P2, WORDS };
static const struct {
  const char *key, *unit;
  double lower, upper;
} words[WORDS] = {{"Kv", "m3/h", 0, 1e6}, {"Cv", "1", 0, 1e6}, {"C", "m3/(s.Pa)", 0, 1e-5}, {"b", "1", 0, 0.99},
                  {"Qn", "m3/s", 0, 1},   {"xT", "1", 0, 1},   {"p1", "Pa", 1e3, 1e9},      {"p2", "Pa", 0, 1e9}};

/* Read those that are there over w. */
static int read_words(const config_setting_t *group, double w[WORDS], lab_error *error)
{
  int i;
  if (lab_config_known(group, words, WORDS, sizeof words[0], error))
    return error->status;
  for (i = 0; i < WORDS; i++) {
    const config_setting_t *setting = lab_config_member(group, words[i].key);
    if (!setting)
      continue;
    if (lab_config_quantity(setting, words[i].unit, words[i].lower, words[i].upper, &w[i], error))
      return error->status;
    if (i < P1 && !(w[i] > 0))
      return lab_config_expected(setting, "more than 0", error);
  }
  if ((w[KV] > 0) + (w[CV] > 0) + (w[C] > 0) + (w[QN] > 0) != 1)
    return lab_config_fail(group, error, "expected one of Kv, Cv, C and Qn");
  if (!(w[P2] < w[P1]))
    return lab_config_fail(group, error, "expected p1 above p2, found %g Pa and %g Pa", w[P1], w[P2]);
  return LAB_OK;
}

static passed flow_of(const lab_rig *rig, const double w[WORDS])
{
  const passed nominal = {atmosphere + w[P1], atmosphere + w[P2], 1.293 * w[QN]};
  if (w[QN] > 0)
    return nominal;
  return w[C] > 0 ? flow_of_c(rig, w[C], w[B]) : flow_of_kv(rig, w[KV] > 0 ? w[KV] : 0.865 * w[CV], w[XT]);
}

/* The area [m2] through which the declared law passes as much air. */
static int area_of(const lab_rig *rig, const passed *p, double *area, lab_error *error)
{
  pneu_params params;
  pneu_model model;
  pneu_flow flow;
  pneu_params_default(&params);
  params.gas_constant = (pneu_real)air;
  params.critical_ratio = rig->params.critical_ratio;
  params.subsonic_index = rig->params.subsonic_index;
  if (pneu_model_init(&model, &params, &rig->laws, NULL) != PNEU_OK)
    return lab_fail(error, LAB_DATA, "%s: the transducer's flow law cannot be used", rig->file);
  pneu_orifice(&model, rig->laws.flow, 1, (pneu_real)p->p_up, (pneu_real)room, (pneu_real)p->p_down, &flow);
  *area = p->q / (double)flow.q;
  return LAB_OK;
}

/* b is one for both orifices, and known before either is converted. */
static int read_b(const config_setting_t *transducer, lab_rig *rig, lab_error *error)
{
  static const char *const orifices[] = {"fill", "vent"};
  const config_setting_t *before = lab_config_member(transducer, "critical_ratio");
  int i;
  for (i = 0; i < 2; i++) {
    const config_setting_t *orifice = lab_config_member(transducer, orifices[i]);
    const config_setting_t *setting = lab_config_member(orifice, "b");
    double b;
    if (!setting)
      continue;
    if (lab_config_quantity(setting, "1", 0, 0.99, &b, error))
      return error->status;
    if (before && b != (double)rig->params.critical_ratio)
      return lab_config_fail(setting, error, "expected %g, as the model has one critical ratio",
                             (double)rig->params.critical_ratio);
    if (put(setting, PNEU_PARAM_critical_ratio, b, NULL, rig, error))
      return error->status;
    before = setting;
  }
  return LAB_OK;
}

static int read_orifice(const config_setting_t *transducer, const char *key, const char *same, int param, lab_rig *rig,
                        lab_error *error)
{
  const config_setting_t *group = lab_config_member(transducer, key);
  double w[WORDS] = {[B] = (double)rig->params.critical_ratio, [XT] = usual_xT, [P1] = 6 * bar, [P2] = 5 * bar};
  double area;
  passed p;
  if (!group)
    return LAB_OK;
  if (read_words(group, w, error))
    return error->status;
  p = flow_of(rig, w);
  if (area_of(rig, &p, &area, error))
    return error->status;
  return put(group, param, area, lab_config_member(transducer, same), rig, error);
}

/* ---- Tube ---- */

/* Pressure drop over mass flow [Pa s/kg] at a mass flow q [kg/s] of air. */
static double tube_resistance(double length, double bore, double q, double rho)
{
  const double mu = 1.82e-5; /* [Pa s] of air at 293 K (VDI Heat Atlas, D2.2) */
  const double re = 4 * q / (pi * bore * mu), v = 4 * q / (pi * rho * bore * bore);
  if (re < 2300)
    return 128 * mu * length / (pi * rho * pow(bore, 4));
  return 0.3164 * pow(re, -0.25) * length / bore * rho * v * v / 2 / q;
}

/* What the fill orifice passes from the supply to ambient. */
static double full_flow(const lab_rig *rig, const pneu_model *model)
{
  const pneu_params *p = &rig->params;
  pneu_flow flow;
  pneu_orifice(model, rig->laws.flow, p->fill_area, p->supply_pressure + p->ambient_pressure, p->supply_temperature,
               p->ambient_pressure, &flow);
  return (double)flow.q;
}

static int read_tube(const config_setting_t *root, lab_rig *rig, lab_error *error)
{
  static const char *const keys[] = {"length", "bore"};
  const config_setting_t *tube = lab_config_member(root, "tube"),
                         *other = lab_config_member(lab_config_member(root, "effects"), "connecting_tube");
  const config_setting_t *size[2];
  const int resistance = pneu_param_find("connecting_tube.tube_resistance");
  const int volume = pneu_param_find("connecting_tube.tube_volume");
  double length = 0, bore = 0, p_mean, rho;
  pneu_model model;
  if (!tube)
    return LAB_OK;
  if (resistance < 0 || volume < 0)
    return lab_config_fail(tube, error, "this build of the library has no connecting_tube");
  if (lab_config_members(tube, keys, 2, 0, size, error))
    return error->status;
  if (!size[0] || !size[1])
    return lab_config_fail(tube, error, "expected length and bore");
  if (lab_config_quantity(size[0], "m", 1e-3, 1e3, &length, error) ||
      lab_config_quantity(size[1], "m", 1e-4, 1, &bore, error) || lab_rig_model(rig, &model, error))
    return error->status;
  p_mean = (double)rig->params.ambient_pressure + (double)rig->params.supply_pressure / 2;
  rho = p_mean / (air * (double)rig->params.ambient_temperature);
  if (put(tube, volume, pi / 4 * bore * bore * length, other, rig, error))
    return error->status;
  return put(tube, resistance, tube_resistance(length, bore, full_flow(rig, &model), rho), other, rig, error);
}

int lab_sheet_read(const config_setting_t *root, lab_rig *rig, lab_error *error)
{
  const config_setting_t *transducer = lab_config_member(root, "transducer");
  const config_setting_t *actuator = lab_config_member(root, "actuator");
  if (read_diameter(actuator, rig, error) || read_bench_set(actuator, rig, error) || read_fail(actuator, rig, error) ||
      read_b(transducer, rig, error) ||
      read_orifice(transducer, "fill", "fill_area", PNEU_PARAM_fill_area, rig, error) ||
      read_orifice(transducer, "vent", "vent_area", PNEU_PARAM_vent_area, rig, error))
    return error->status;
  return read_tube(root, rig, error);
}

#include "tolerance.h"

#include <math.h>
#include <string.h>

#include "../base/config.h"
#include "../base/names.h"
#include "../base/number.h"

/* What a share is one of. */
enum span { OF_VALUE, OF_SUPPLY, OF_STROKE, OF_VENT };

/* Defaults: a share, or a quantity where that is not 0. */
static const struct kind {
  const char *name, *effect;
  int param; /* of the model, or of the effect */
  enum span span;
  double share, quantity;
} kinds[] = {
#define BASE(name, share, quantity)                                                                                    \
  {                                                                                                                    \
#name, NULL, PNEU_PARAM_##name, OF_VALUE, share, quantity                                                          \
  }
    BASE(area, 0.02, 0),
    BASE(dead_volume, 0.3, 0),
    BASE(stroke, 0, 0),
    BASE(spring_rate, 0.1, 0),
    BASE(spring_preload, 0.1, 0),
    BASE(moving_mass, 0.2, 0),
    BASE(dry_friction, 0.5, 0),
    BASE(viscous_friction, 0.5, 0),
    BASE(damping, 0.5, 0),
    BASE(external_force, 0, 0),
    BASE(fill_area, 0.2, 0),
    BASE(vent_area, 0.2, 0),
    BASE(critical_ratio, 0, 0.1),
    BASE(supply_pressure, 0.02, 0),
    BASE(supply_temperature, 0, 0),
    BASE(ambient_pressure, 0, 2000),
    BASE(ambient_temperature, 0, 0),
#undef BASE
    {"orifice_area", NULL, LAB_PARAM_ORIFICE_AREA, OF_VALUE, 0.2, 0},
    {"vent_restriction", "vent_restriction", 0, OF_VENT, 0, 0},
    {"pressure_bias", "pressure_bias", 0, OF_SUPPLY, 0.0025, 0},
    {"pressure_gain", "pressure_gain", 0, OF_VALUE, 0, 0.0025},
    {"pressure_lag", "pressure_lag", 0, OF_VALUE, 0, 5e-3},
    {"position_bias", "position_bias", 0, OF_STROKE, 0.0025, 0},
    {"position_gain", "position_gain", 0, OF_VALUE, 0, 0.0025},
    {"position_lag", "position_lag", 0, OF_VALUE, 0, 5e-3},
    {"clock", "channel_skew", 0, OF_VALUE, 0, 5e-3},
    {"start_temperature", "start_temperature", 0, OF_VALUE, 0, 0},
    {"positioner.gain", "positioner", 0, OF_VALUE, 0.2, 0},
    {"positioner.integral_time", "positioner", 1, OF_VALUE, 0, 0},
    {"positioner.derivative_time", "positioner", 2, OF_VALUE, 0, 0},
    {"positioner.dead_band", "positioner", 3, OF_VALUE, 0, 0},
    {"positioner.integral_start", "positioner", 6, OF_VALUE, 0, 0},
    {"pressure_drift", NULL, LAB_PRESSURE_DRIFT, OF_SUPPLY, 0.0025, 0},
    {"position_drift", NULL, LAB_POSITION_DRIFT, OF_STROKE, 0.0025, 0},
    {"pressure_resolution", NULL, LAB_PRESSURE_RESOLUTION, OF_SUPPLY, 0, 0},
    {"position_resolution", NULL, LAB_POSITION_RESOLUTION, OF_STROKE, 0, 0},
};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

/* The parameter of a kind; -1 where this build of the library does not have its effect. */
static int param_of(const struct kind *k)
{
  const int effect = k->effect ? pneu_effect_find(k->effect) : 0;
  if (!k->effect)
    return k->param;
  return effect < 0 ? -1 : pneu_effect_params(effect, NULL) + k->param;
}

/* How well the ratio of both areas is known where one factor of them is fitted, a share; else 0, for each is then known
 * by itself.  Orifices of one make differ less from each other than from their sheet. */
static double ratio_known(const lab_rig *rig)
{
  static const double of_one_make = 0.25; /* of the vent area's own tolerance: chosen by judgement, not calibrated */
  return lab_rig_fits(rig, LAB_PARAM_ORIFICE_AREA) && rig->params.vent_area > 0
             ? of_one_make * lab_tolerance(rig, PNEU_PARAM_vent_area) / (double)rig->params.vent_area
             : 0;
}

/* What a share of a kind's tolerance is a share of. */
static double whole_of(const struct kind *k, const lab_rig *rig)
{
  if (k->span == OF_SUPPLY)
    return fabs((double)rig->params.supply_pressure);
  if (k->span == OF_STROKE)
    return (double)rig->params.stroke;
  if (k->quantity > 0 || param_of(k) == LAB_PARAM_ORIFICE_AREA)
    return 1;
  return fabs(lab_param_value(rig, param_of(k)));
}

/* The unit of a kind's tolerance, SI. */
static const char *unit_of(const struct kind *k)
{
  if (k->span == OF_SUPPLY)
    return "Pa";
  if (k->span == OF_STROKE)
    return "m";
  return lab_param_info(param_of(k)).unit;
}

static double usual(const struct kind *k, const lab_rig *rig)
{
  return k->span == OF_VENT ? ratio_known(rig) : k->quantity > 0 ? k->quantity : k->share * whole_of(k, rig);
}

const char *lab_tolerance_name(int param)
{
  int i;
  for (i = 0; i < KINDS; i++)
    if (param_of(&kinds[i]) == param)
      return kinds[i].name;
  return NULL;
}

/* The name of a kind in the group, which has no points: "positioner_gain". */
static const char *key_of(const struct kind *k, char key[LAB_PARAM_NAME_TEXT])
{
  char *at;
  snprintf(key, LAB_PARAM_NAME_TEXT, "%s", k->name);
  while ((at = strchr(key, '.')))
    *at = '_';
  return key;
}

/* A text such as "5 %" of something that is not a share itself, or is usually known to a share. */
static int is_share(const config_setting_t *setting, const struct kind *k)
{
  const char *text = config_setting_get_string(setting);
  return text && strchr(text, '%') && (k->share > 0 || strcmp(unit_of(k), "1") != 0);
}

static int read_one(const config_setting_t *setting, const struct kind *k, lab_rig *rig, lab_error *error)
{
  const int param = param_of(k);
  double whole = 1, value;
  if (param < 0)
    return LAB_OK;
  if (is_share(setting, k))
    whole = whole_of(k, rig);
  if (!(whole > 0))
    return lab_config_expected(setting, "a quantity, because a share of 0 is 0", error);
  if (lab_config_difference(setting, is_share(setting, k) ? "1" : unit_of(k), &value, error))
    return error->status;
  if (!(value >= 0))
    return lab_config_expected(setting, "a standard deviation, 0 or more", error);
  rig->tolerance[param] = value * whole;
  return LAB_OK;
}

int lab_tolerance_read(const config_setting_t *group, lab_rig *rig, lab_error *error)
{
  const char *names[KINDS + 1] = {"others"};
  char keys[KINDS][LAB_PARAM_NAME_TEXT];
  int i, which, status;
  for (i = 0; i < KINDS; i++)
    names[i + 1] = key_of(&kinds[i], keys[i]);
  status = lab_config_known(group, names, KINDS + 1, sizeof names[0], error);
  for (i = 0; status == LAB_OK && i < config_setting_length(group); i++) {
    const config_setting_t *setting = config_setting_get_elem(group, (unsigned)i);
    double value;
    which = lab_name_index(config_setting_name(setting), names, KINDS + 1, sizeof names[0]);
    if (which > 0)
      status = read_one(setting, &kinds[which - 1], rig, error);
    else if ((status = lab_config_quantity(setting, "1", 0, 0, &value, error)) == LAB_OK)
      rig->others_are_exact = 1;
  }
  return status;
}

int lab_param_is_vents_share(int param)
{
  return param >= 0 && param == pneu_param_find("vent_restriction");
}

double lab_tolerance(const lab_rig *rig, int param)
{
  int i;
  if (!isnan(rig->tolerance[param]))
    return rig->tolerance[param];
  for (i = 0; i < KINDS && !rig->others_are_exact; i++)
    if (param_of(&kinds[i]) == param)
      return usual(&kinds[i], rig);
  return 0;
}

void lab_tolerance_write(FILE *file, const lab_rig *rig)
{
  char number[LAB_NUMBER_TEXT], key[LAB_PARAM_NAME_TEXT];
  int i, any = rig->others_are_exact;
  if (any)
    fputs("tolerance = {\n  others = 0;\n", file);
  for (i = 0; i < KINDS; i++) {
    const int param = param_of(&kinds[i]);
    if (param < 0 || isnan(rig->tolerance[param]))
      continue;
    fprintf(file, "%s  %s = \"%s %s\";\n", any++ ? "" : "tolerance = {\n", key_of(&kinds[i], key),
            lab_number_write(rig->tolerance[param], number), unit_of(&kinds[i]));
  }
  if (any)
    fputs("};\n", file);
}

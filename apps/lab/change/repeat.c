#include "repeat.h"

#include <math.h>
#include <string.h>

/* Chosen by judgement; not calibrated: regulators and weather, zeros and gains of ordinary transmitters, and what
 * friction does from day to day. Who knows better gives the measured supply as a channel. */
const lab_repeat lab_repeats[] = {
    {"supply_pressure", 0.02, NULL, 0, 1},
    {"ambient_pressure", 0, NULL, 1500, 0},
    {"ambient_temperature", 0, NULL, 5, 0},
    {"supply_temperature", 0, NULL, 5, 0},
    {"pressure_bias.pressure_bias", 0.0025, "supply_pressure", 0, 1},
    {"position_bias.position_bias", 0.0025, "stroke", 0, 1},
    {"pressure_gain.pressure_gain", 0, NULL, 0.002, 1},
    {"position_gain.position_gain", 0, NULL, 0.002, 1},
    {"channel_skew.channel_skew", 0.3, "row", 0, 1},
    {"orifice_area", 0.01, NULL, 0, 1},
    {"fill_area", 0, NULL, 0, 1},
    {"vent_area", 0, NULL, 0, 1},
    {"dead_volume", 0.05, NULL, 0, 1},
    {"dry_friction", 0.05, NULL, 0, 1},
    {"viscous_friction", 0.1, NULL, 0, 1},
    {"spring_rate", 0.005, NULL, 0, 1},
    {"spring_preload", 0.005, NULL, 0, 1},
    {"positioner.gain", 0, NULL, 0, 1},
    {"positioner.dead_band", 0, NULL, 0, 1},
};
const int lab_repeat_count = sizeof lab_repeats / sizeof *lab_repeats;

const lab_repeat *lab_repeat_find(int param)
{
  int i;
  for (i = 0; i < lab_repeat_count; i++)
    if (lab_param_index(lab_repeats[i].name) == param)
      return &lab_repeats[i];
  return NULL;
}

double lab_repeat_spread(const lab_repeat *repeat, const lab_rig *rig, double row)
{
  int of;
  if (repeat->of && strcmp(repeat->of, "row") == 0)
    return repeat->share * row;
  of = lab_param_index(repeat->of ? repeat->of : repeat->name);
  return repeat->share > 0 && of >= 0 ? repeat->share * fabs(lab_param_value(rig, of)) : repeat->spread;
}

#include "rigkeys.h"

#define PARAM(group, key, name)                                                                                        \
  {                                                                                                                    \
    key, group, LAB_KEY_PARAM, PNEU_PARAM_##name                                                                       \
  }

const lab_key lab_keys[] = {
    {"name", "actuator", LAB_KEY_NAME, 0},
    {"action", "actuator", LAB_KEY_ACTION, 0},
    PARAM("actuator", "area", area),
    PARAM("actuator", "dead_volume", dead_volume),
    PARAM("actuator", "swept_ratio", swept_ratio),
    PARAM("actuator", "stroke", stroke),
    PARAM("actuator", "spring_rate", spring_rate),
    PARAM("actuator", "spring_preload", spring_preload),
    PARAM("actuator", "moving_mass", moving_mass),
    PARAM("actuator", "dry_friction", dry_friction),
    PARAM("actuator", "viscous_friction", viscous_friction),
    PARAM("actuator", "damping", damping),
    PARAM("actuator", "external_force", external_force),
    PARAM("transducer", "fill_area", fill_area),
    PARAM("transducer", "vent_area", vent_area),
    PARAM("transducer", "critical_ratio", critical_ratio),
    PARAM("transducer", "subsonic_index", subsonic_index),
    PARAM("transducer", "proportional_band", proportional_band),
    PARAM("supply", "pressure", supply_pressure),
    PARAM("supply", "temperature", supply_temperature),
    PARAM("ambient", "pressure", ambient_pressure),
    PARAM("ambient", "temperature", ambient_temperature),
    PARAM("gas", "gas_constant", gas_constant),
    PARAM("gas", "heat_ratio", heat_ratio),
    PARAM("gas", "polytropic_index", polytropic_index),
    {"gas", "laws", LAB_KEY_GAS, 0},
    {"flow", "laws", LAB_KEY_FLOW, 0},
    {"friction", "laws", LAB_KEY_FRICTION, 0},
};
const int lab_key_count = sizeof lab_keys / sizeof lab_keys[0];

const lab_word lab_action_words[2] = {{"normal", NULL}, {"reverse", NULL}};
const lab_word lab_friction_words[LAB_FRICTION_COUNT] = {
    {"coulomb", NULL}, {"stribeck", "stribeck_friction"}, {"lugre", "presliding"}};

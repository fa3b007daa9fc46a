#include "rigkeys.h"

#include <stddef.h>

static const char *const actions[] = {"normal", "reverse"};
static const char *const gases[] = {
#define X(name, key, text) key,
    PNEU_GAS_LIST(X)
#undef X
};
static const char *const flows[] = {
#define X(name, key, text) key,
    PNEU_FLOW_LIST(X)
#undef X
};
static const char *const frictions[LAB_FRICTION_COUNT] = {"coulomb", "stribeck", "lugre"};
const char *const lab_friction_effects[LAB_FRICTION_COUNT] = {NULL, "stribeck_friction", "presliding"};

#define PARAM(group, key, name)                                                                                        \
  {                                                                                                                    \
    key, group, LAB_KEY_PARAM, PNEU_PARAM_##name, NULL, 0, 0                                                           \
  }
#define WORD(group, key, words, member)                                                                                \
  {                                                                                                                    \
    key, group, LAB_KEY_WORD, 0, words, sizeof words / sizeof *words, offsetof(lab_rig, member)                        \
  }

const lab_key lab_keys[] = {
    {"name", "actuator", LAB_KEY_NAME, 0, NULL, 0, 0},
    WORD("actuator", "action", actions, action),
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
    WORD("laws", "gas", gases, laws.gas),
    WORD("laws", "flow", flows, laws.flow),
    WORD("laws", "friction", frictions, friction),
};
const int lab_key_count = sizeof lab_keys / sizeof lab_keys[0];

/* The channels of a log.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_CHANNEL_H
#define LAB_CHANNEL_H

/*    name     key      unit  quantity       meaning */
#define LAB_CHANNEL_LIST(X)                                                                                            \
  X(TIME, "t", "s", "time", "time")                                                                                    \
  X(U, "u", "1", "command", "command: 1 supply orifice fully open, -1 vent fully open, 0 both shut")                   \
  X(SP, "sp", "1", "set_point", "set position of a positioner, share of the stroke")                                   \
  X(P, "p", "Pa", "pressure", "chamber pressure, gauge")                                                               \
  X(X, "x", "m", "position", "stem position")                                                                          \
  X(PS, "ps", "Pa", "supply", "supply pressure, gauge")                                                                \
  X(T, "T", "K", "temperature", "gas temperature in the chamber")                                                      \
  X(FORCE, "force", "N", "force", "force on the stem, positive against the air")                                       \
  X(P2, "p2", "Pa", "far_pressure", "pressure at the far end of a line, gauge")

enum lab_channel {
#define X(name, key, unit, quantity, meaning) LAB_CHANNEL_##name,
  LAB_CHANNEL_LIST(X)
#undef X
      LAB_CHANNEL_COUNT
};

typedef struct lab_channel_info {
  const char *key;      /* in the header of a log; first member, for lab_name_index */
  const char *unit;     /* SI */
  const char *quantity; /* in reports and in the noise group */
  const char *meaning;
} lab_channel_info;

/* Indexed by enum lab_channel. */
extern const lab_channel_info lab_channels[LAB_CHANNEL_COUNT];

/* SI unit of a channel; a command may be a set pressure. */
const char *lab_channel_unit(int channel, int command_is_pressure);

#endif

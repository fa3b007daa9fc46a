#include "channel.h"

const lab_channel_info lab_channels[LAB_CHANNEL_COUNT] = {
#define X(name, key, unit, quantity, meaning) {key, unit, quantity, meaning},
    LAB_CHANNEL_LIST(X)
#undef X
};

const char *lab_channel_unit(int channel, int command_is_pressure)
{
  return lab_channels[channel == LAB_CHANNEL_U && command_is_pressure ? LAB_CHANNEL_P : channel].unit;
}

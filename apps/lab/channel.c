#include "channel.h"

const lab_channel_info lab_channels[LAB_CHANNEL_COUNT] = {
#define X(name, key, unit, quantity, meaning) {key, unit, quantity, meaning},
    LAB_CHANNEL_LIST(X)
#undef X
};

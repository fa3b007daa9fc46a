#include "format_channel.h"

#include <stdio.h>

#include "../log/channel.h"

static const struct reading {
  int channel;
  double factor;
  const char *unit;
} readings[] = {{LAB_CHANNEL_P, 1e-3, "kPa"},
                {LAB_CHANNEL_PS, 1e-3, "kPa"},
                {LAB_CHANNEL_P2, 1e-3, "kPa"},
                {LAB_CHANNEL_X, 1e3, "mm"}};

const char *lab_format_channel(int channel, double value, char text[LAB_FORMAT_CHANNEL_TEXT])
{
  struct reading how = {channel, 1, lab_channels[channel].unit};
  unsigned i;
  for (i = 0; i < sizeof readings / sizeof readings[0]; i++)
    if (readings[i].channel == channel)
      how = readings[i];
  snprintf(text, LAB_FORMAT_CHANNEL_TEXT, "%.4g %s", how.factor * value, how.unit);
  return text;
}

#include "show.h"

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

const char *lab_show(int channel, double value, char text[LAB_SHOW_TEXT])
{
  struct reading how = {channel, 1, lab_channels[channel].unit};
  unsigned i;
  for (i = 0; i < sizeof readings / sizeof readings[0]; i++)
    if (readings[i].channel == channel)
      how = readings[i];
  snprintf(text, LAB_SHOW_TEXT, "%.4g %s", how.factor * value, how.unit);
  return text;
}

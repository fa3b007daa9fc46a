/* Values of channels in messages: in units that engineers read.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_FORMAT_CHANNEL_H
#define LAB_FORMAT_CHANNEL_H

enum { LAB_FORMAT_CHANNEL_TEXT = 48 };

/* "398.2 kPa", "19.98 mm", "298.1 K", "12.5 N".
 * In:      channel  enum lab_channel; value in SI
 * Returns: text */
const char *lab_format_channel(int channel, double value, char text[LAB_FORMAT_CHANNEL_TEXT]);

#endif

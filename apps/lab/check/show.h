/* Values of channels in messages: in units that engineers read.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SHOW_H
#define LAB_SHOW_H

enum { LAB_SHOW_TEXT = 48 };

/* "398.2 kPa", "19.98 mm", "298.1 K", "12.5 N".
 * In:      channel  enum lab_channel; value in SI
 * Returns: text */
const char *lab_show(int channel, double value, char text[LAB_SHOW_TEXT]);

#endif

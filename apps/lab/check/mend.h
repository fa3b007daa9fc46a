/* What is done to a log before it is checked, and to what drives the model after that, in this order; a limitation says
 * so.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_MEND_H
#define LAB_MEND_H

#include "../base/limitations.h"
#include "../log/log.h"
#include "../rig/rig.h"

/* Take lines off the spectrum of p, x, T and force that stand on a log from its first row to its last, whatever the
 * stem and the chamber do: the hum of the mains, 50 or 60 Hz and two harmonics, within 0.3 %, or what sampling makes of
 * it. Only what is fast counts, of at most 16 rows a period; rows at uneven distances, or fewer than 20 a second, have
 * no spectrum. A motion that swings is not always there; a cycle that drives the rig is slower, or does
 * not show while the orifices are shut.
 * In/out:  log  its values; hum has what was taken off
 * Returns: LAB_OK, LAB_WORLD. */
int lab_log_remove_hum(lab_log *log, lab_limitations *limitations, lab_error *error);

/* The same where a model leaves it, which shows slower lines, of at most 50 rows a period, and in fewer rows, 8 a
 * second.
 * In:      left   [SI] what a model leaves of n rows from `first` on, 0 at a gap
 * In/out:  log    those rows of the channel
 * Out:     lines  how many were taken off
 * Returns: LAB_OK, LAB_WORLD */
int lab_log_remove_hum_left(lab_log *log, size_t first, size_t n, int channel, const double *left, int *lines,
                            lab_limitations *limitations, lab_error *error);

/* Whether a line is where sampling puts a hum of the mains, which lab_log_remove_hum leaves where it is slow: within
 * 0.3 % of 50 or 60 Hz. Where that is at 0, all slow lines would be, and none counts.
 * In:      f     [Hz] of the line
 *          rate  [1/s] of rows */
int lab_may_be_hum(double f, double rate);

/* Rows of a log that a fit uses. Its time grows with the rows (about 10 s for 100,000 without an effect, several times
 * that with one), and what can be told from a stroke does not: 20,000 rows show one of 10 s every half a millisecond.
 */
enum { LAB_THIN_ROWS = 20000 };

/* Keep every k-th row of a log of more than `most` rows, with the first and the last row of each run, and the row of
 * each change of command with the one before it, which bracket the instant. Where the command changes in more than a
 * quarter of `most` rows, it becomes its mean over the rows that each kept one stands for. */
void lab_log_thin(lab_log *log, size_t most, lab_limitations *limitations);

/* Make gaps of what is no measurement, run by run.
 * Saturation. A value at the end of a converter's range shows by the noise that is missing: the largest (or smallest)
 * value comes back exactly, again and again, where the rest of the channel is noisy. A pressure without visible noise
 * that stops from one row to the next, under an open orifice, is taken as saturated too: a chamber settles slowly.
 * Spikes. A value far from its neighbours, two on either side, which agree. A peak of break-away has slopes.
 * In:      rig  its inputs: a channel that drives the model cannot have such gaps
 * Returns: LAB_OK; LAB_DATA if an input is saturated or hardly anything is left; LAB_WORLD. */
int lab_log_clean(const lab_rig *rig, lab_log *log, lab_limitations *limitations, lab_error *error);

/* Take the noise off p and x where they drive the model: it would drive a stem through its friction, to the end of what
 * it reaches. Each value becomes that of a straight line through its neighbours, about half as many as agree within the
 * noise that is declared, or less where the log shows less; without a declared one only a pressure is smoothed that
 * drives a stem. Where such lines meet between two rows is a bend; no line goes on beyond.
 * In/out:  log  its values; smoothed, bend
 * Returns: LAB_OK, LAB_WORLD. */
int lab_log_smooth_inputs(const lab_rig *rig, lab_log *log, lab_limitations *limitations, lab_error *error);

#endif

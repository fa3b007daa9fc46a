/* Step responses and static characteristics: figures 4, 11, 13, 14 and the standard experiment.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_RESPONSES_H
#define STUDY_RESPONSES_H

#include "study.h"

/* results/step_<actuator>_<gas>_<flow>.csv: the standard experiment of every actuator in every law. */
int responses_standard(const study *s, lab_error *error);

/* results/fig04.csv: the large step of the subject; results/fig13.csv, fig14.csv: the steps of both actuators in
 * every law, the second without its upper limiter. */
int responses_steps(const study *s, lab_error *error);

/* results/fig11.csv: travel over pressure, up and down, slow against every time constant. */
int responses_static(const study *s, lab_error *error);

#endif

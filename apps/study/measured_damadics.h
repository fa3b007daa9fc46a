/* The force balance and the asymmetry against a measured diaphragm servomotor (DAMADICS benchmark).
 *
 * Data, read off vector figures of the benchmark's specification (study/measured/fetch.sh says what can be had):
 * a static loop of pressure and position, and the positions after a step of pressure up and one down. The loop tests
 * the force balance alone, as pressure is an input. The steps come without pressure, supply or orifice, so that they
 * are measured like the paper's strokes but not simulated.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_MEASURED_DAMADICS_H
#define STUDY_MEASURED_DAMADICS_H

#include "../lab/base/message.h"

/* Write to results_dir: measured_damadics_static.csv (a row a law of the force balance), measured_damadics_loop.csv
 * (points, models, residuals), measured_damadics_catalogue.csv (hysteresis, linearity, bench set),
 * measured_damadics_steps.csv (asymmetry and time constants of the two steps, beside the 37-13 of the paper) and
 * measured_damadics_edges.csv (the steps and the two shapes fitted to each).
 * In:      study_dir  folder of the study, with its rig files
 *          data_dir   folder of the public data sets (see measured.h)
 * Returns: LAB_OK; MEASURED_ABSENT, announced on stderr, without the data; LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int measured_damadics(const char *study_dir, const char *data_dir, const char *results_dir, lab_error *error);

/* The steps' share of it; made by measured_damadics. */
int measured_damadics_steps(const char *study_dir, const char *data_dir, const char *results_dir, lab_error *error);

#endif

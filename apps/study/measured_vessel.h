/* The air processes against a measured vessel: which law explains pressure and gas temperature of an air discharge.
 *
 * Data: Air_790kPa_21mm of HydDown's validation set (study/measured/fetch.sh): 15 pressures and 14 temperatures,
 * read off published figures. The orifice area, and the heat transfer where the law has one, are fitted to the
 * pressures; the temperatures are predicted, but under the laws whose names end in "-both".
 *
 * Start and outside pressure stay at what the source declares (7.90 bar, 1.0 bar) in all laws but one, so that a law
 * cannot hide its error in them: the last points, at 1.006 bar, are 0.6 kPa above the outside pressure for which the
 * source gives one digit, and the first, at 0.226 s, is 6 kPa below what 7.90 bar allows. "convection-ends" fits both
 * and shows what that is worth.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_MEASURED_VESSEL_H
#define STUDY_MEASURED_VESSEL_H

#include "../lab/message.h"

/* Fit every law and write to results_dir: measured_vessel.csv (a row a law), measured_vessel_parameters.csv (a row a
 * fitted parameter) and measured_vessel_curves.csv (data, models, residuals over time).
 * In:      data_dir  folder of the public data sets (see measured.h)
 * Returns: LAB_OK; MEASURED_ABSENT, announced on stderr, without the data; LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int measured_vessel(const char *data_dir, const char *results_dir, lab_error *error);

#endif

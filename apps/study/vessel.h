/* A measured vessel that empties through an orifice, under one law or another: its model and its fit.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_VESSEL_H
#define STUDY_VESSEL_H

#include <stddef.h>

#include "../../lib/pneu.h"
#include "../lab/fit/fit.h"
#include "../lab/log/log.h"
#include "../lab/base/message.h"
#include "../lab/rig/rig.h"

/* What can be fitted.
 *    name        key                  unit           scale  log  start   lower  upper   (in the unit)
 * The unit is that of reports: SI is value / scale. */
#define VESSEL_ITEM_LIST(X)                                                                                            \
  X(ORIFICE, "orifice_area", "mm2", 1e6, 1, 4.845, 0.5, 50)                                                            \
  X(FILM, "film_conductance", "W/K", 1, 0, 2, 0, 50)                                                                   \
  X(CONVECTION, "free_convection", "W/K^(4/3)", 1, 0, 1.5, 0, 50)                                                      \
  X(INDEX, "polytropic_index", "1", 1, 0, 1.2, 1, 1.4)                                                                 \
  X(START, "start_pressure", "kPa", 1e-3, 0, 790, 700, 850)                                                            \
  X(OUTSIDE, "outside_pressure", "kPa", 1e-3, 0, 100, 95, 105)

enum vessel_item {
#define X(name, key, unit, scale, log, start, lower, upper) VESSEL_##name,
  VESSEL_ITEM_LIST(X)
#undef X
      VESSEL_ITEM_COUNT
};

enum { VESSEL_FIT_MAX = 4 };

/* A law to be tried. */
typedef struct vessel_law {
  const char *name, *what;
  int gas, flow; /* enum pneu_gas, enum pneu_flow_law */
  int with_T;    /* not 0: fitted to pressure and temperature; else to pressure alone */
  int n;
  int item[VESSEL_FIT_MAX]; /* enum vessel_item */
} vessel_law;

extern const vessel_law vessel_laws[];
extern const int vessel_law_count;

/* The rig and its record. */
typedef struct vessel {
  lab_rig rig;
  lab_log log; /* one run; rows in time order, with p or T or both */
} vessel;

/* Errors of a prediction against some of the rows. */
typedef struct vessel_error {
  double rmse, largest; /* Pa or K; largest is the greatest magnitude */
  double lag1;          /* correlation of each error with the one before it */
  size_t n;
} vessel_error;

/* Read rig and record.
 * Out:     v  to be freed with vessel_close
 * Returns: LAB_OK, LAB_DATA, LAB_WORLD. */
int vessel_open(const char *rig_path, const char *log_path, vessel *v, lab_error *error);
void vessel_close(vessel *v);

/* Value, unit and scale of an item for reports. */
const char *vessel_item_key(int item);
const char *vessel_item_unit(int item);
double vessel_item_scale(int item);

/* Exponent of a law's gas [1]: 1 if isothermal, n if polytropic; NaN for an energy balance.  In: theta  as below */
double vessel_exponent(const vessel *v, const vessel_law *law, const double *theta);

/* Pressure and temperature under a law.
 * In:      theta  law->n values, SI;  t  n times [s], increasing from 0
 * Out:     p [Pa] gauge, T [K]
 * Returns: LAB_OK, LAB_NUMERIC, LAB_WORLD. */
int vessel_predict(const vessel *v, const vessel_law *law, const double *theta, const double *t, size_t n, double *p,
                   double *T, lab_error *error);

/* Fit a law to the pressures, and the temperatures where the law says so, of the rows that are in use.
 * In:      use  not 0 for each row of the log that counts; NULL: all
 * Returns: LAB_OK, LAB_NUMERIC, LAB_WORLD. */
int vessel_fit(const vessel *v, const vessel_law *law, const unsigned char *use, lab_fit_result *fit, lab_error *error);

/* Errors, model minus data, of a channel (LAB_CHANNEL_P or LAB_CHANNEL_T) over the rows whose `use` is `wanted`. */
int vessel_errors(const vessel *v, const vessel_law *law, const double *theta, int channel, const unsigned char *use,
                  int wanted, vessel_error *out, lab_error *error);

#endif

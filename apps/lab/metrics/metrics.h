/* Figures of merit of an actuator from a record of it, measured or simulated: how fast, how fine, how straight, how
 * thrifty.
 *
 * Definitions follow ANSI/ISA-75.25.01 (steps; IEC 60534-9 is its sister, ISA-TR75.25.02 its companion), IEC 60534-4
 * (stroking time, dead band of a valve), IEC 61298-2 (dead band, hysteresis, linearity) and M. Bartys, "Dynamics of
 * single-action pneumatic actuators" [B], section 5 (energy).
 *
 * Two signals are told apart. A step is a step of what is commanded: the opening of the transducer, a set pressure, a
 * set position, or the chamber pressure itself where it is the model's input. The static figures (dead band,
 * resolution, hysteresis, linearity) set position against a set pressure where there is a transducer that regulates,
 * against the set position where a positioner is in the loop, else against chamber pressure: an opening commands how
 * fast the chamber fills, not where the stem is to go.
 *
 * A figure that a record cannot give is NaN, with the reason in words.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_METRICS_H
#define LAB_METRICS_H

#include <stddef.h>
#include <stdio.h>

#include <cjson/cJSON.h>

#include "../base/message.h"

/* What is commanded. */
enum lab_command {
  LAB_COMMAND_OPENING,      /* of the transducer, -1..1 */
  LAB_COMMAND_SET_PRESSURE, /* [Pa], to a transducer that regulates */
  LAB_COMMAND_PRESSURE,     /* chamber pressure [Pa] is the input */
  LAB_COMMAND_SET_POSITION  /* [1] share of the stroke, to a positioner */
};

/* Channels over time, in SI; NaN is a gap. A channel that is not recorded is NULL. */
typedef struct lab_record {
  size_t n;
  int n_runs;
  const size_t *first;   /* row with which each run begins, then n: n_runs + 1 entries */
  const double *t;       /* [s], growing within a run */
  const double *u;       /* command; holds until the next row; NULL where chamber pressure is the input */
  const double *p;       /* [Pa] gauge */
  const double *x;       /* [m] */
  const double *mass_in; /* [kg/s] from the supply */
  const char *unfit;     /* NULL, or why such a record gives nothing */
  int command;           /* enum lab_command */
  int bracketed;         /* not 0: a command changed at some time since the row before the one that shows it */
  double noise_p;        /* standard deviations; NaN: estimate them from the record */
  double noise_x;
  double stroke;                  /* [m] rated travel */
  double signal_low, signal_high; /* [Pa] pressures that balance the spring at both ends: the bench set; of a set
                                     position 0 and 1 */
  double area;                    /* [m2] of the diaphragm */
  double supply;                  /* [Pa] gauge */
  double gas_constant;            /* [J/kg/K] */
} lab_record;

/* clang-format off */

/*    name                    key                      unit  standard                       meaning */
#define LAB_METRIC_LIST(X) \
  X(DEAD_TIME_UP,          "dead_time_up",          "s",  "ISA-75.25.01, IEC 60534-9",   "dead time Td, rising: from the step to the first movement that can be seen") \
  X(DEAD_TIME_DOWN,        "dead_time_down",        "s",  "ISA-75.25.01, IEC 60534-9",   "dead time Td, falling") \
  X(T63_UP,                "t63_up",                "s",  "ISA-75.25.01, IEC 60534-9",   "T63, rising: from the step to 63.2 % of the change, dead time included") \
  X(T63_DOWN,              "t63_down",              "s",  "ISA-75.25.01, IEC 60534-9",   "T63, falling") \
  X(T86_UP,                "t86_up",                "s",  "ISA-75.25.01, IEC 60534-9",   "step response time T86, rising: from the step to 86.5 % of the change") \
  X(T86_DOWN,              "t86_down",              "s",  "ISA-75.25.01, IEC 60534-9",   "step response time T86, falling") \
  X(SETTLING_TIME_UP,      "settling_time_up",      "s",  "IEC 60050-351",               "settling time, rising: from the step until within 2 % of the change for good") \
  X(SETTLING_TIME_DOWN,    "settling_time_down",    "s",  "IEC 60050-351",               "settling time, falling") \
  X(OVERSHOOT_UP,          "overshoot_up",          "%",  "ISA-75.25.01, IEC 60534-9",   "overshoot, rising: beyond the final position, over the change") \
  X(OVERSHOOT_DOWN,        "overshoot_down",        "%",  "ISA-75.25.01, IEC 60534-9",   "overshoot, falling") \
  X(DEAD_BAND,             "dead_band",             "%",  "IEC 61298-2, IEC 60534-4, ISA-75.25.01", "dead band: change of signal after a reversal that moves nothing, over the span of the signal") \
  X(RESOLUTION,            "resolution",            "%",  "ISA-75.25.01, ISA-TR75.25.02", "resolution: smallest change of signal that moves the stem on in the same direction, over the span") \
  X(HYSTERESIS_DEAD_BAND,  "hysteresis_dead_band",  "%",  "IEC 61298-2",                 "hysteresis and dead band: largest distance of the two branches of a slow loop, over the travel") \
  X(HYSTERESIS,            "hysteresis",            "%",  "IEC 61298-2",                 "hysteresis alone: the above less the dead band") \
  X(LINEARITY,             "linearity",             "%",  "IEC 61298-2",                 "independent linearity: largest distance of the mean branch from the straight line that suits it best, over the travel") \
  X(STROKE_TIME_UP,        "stroke_time_up",        "s",  "IEC 60534-4",                 "stroke time, rising: from the command to 99 % of a full stroke") \
  X(STROKE_TIME_DOWN,      "stroke_time_down",      "s",  "IEC 60534-4",                 "stroke time, falling") \
  X(DURATION_RATIO,        "duration_ratio",        "1",  "this project",                "time of the falling over that of the rising stroke, from 5 % to 95 % of travel") \
  X(ASYMMETRY,             "asymmetry",             "1",  "this project",                "difference in shape of the two strokes; 0 is none, 0.2 a straight line against a first-order lag") \
  X(AIR_MASS,              "air_mass",              "kg", "this project",                "air taken from the supply in a cycle: a full stroke up and down") \
  X(AIR_VOLUME,            "air_normal_litres",     "l",  "DIN 1343",                    "the same in normal litres: at 0 degC and 101.325 kPa") \
  X(ENERGY_IN,             "energy_in",             "J",  "[B, Eqs. 39, 42]",            "energy of the air delivered in a cycle, E_i = A p_s x_n") \
  X(ENERGY_OUT,            "energy_out",            "J",  "[B, Eqs. 39 to 41]",          "energy of the air that leaves, E_o: integral of A p dx over the falling stroke") \
  X(ENERGY_LOST,           "energy_lost",           "J",  "[B, Eqs. 46, 47]",            "energy lost to friction in a cycle without load, E_F: area of the loop of A p over x") \
  X(ENERGY_EFFICIENCY,     "energy_efficiency",     "%",  "[B, Eqs. 47 to 49]",          "what is left for a load, 1 - E_o/E_i - E_F/E_i; the paper's limit is 50 %")

/* clang-format on */

enum lab_metric_index {
#define X(name, key, unit, standard, meaning) LAB_METRIC_##name,
  LAB_METRIC_LIST(X)
#undef X
      LAB_METRIC_COUNT
};

typedef struct lab_metric_info {
  const char *key, *unit, *standard, *meaning;
} lab_metric_info;

/* Indexed by enum lab_metric_index. */
extern const lab_metric_info lab_metric_infos[LAB_METRIC_COUNT];

enum { LAB_METRIC_TEXT = 200, LAB_METRIC_STEPS = 128 };

typedef struct lab_metric {
  double value;               /* in its unit; NaN: the record cannot give it */
  double uncertainty;         /* what sampling, noise and threshold leave open, either way */
  int at_most;                /* not 0: the value is an upper bound */
  char text[LAB_METRIC_TEXT]; /* what it was taken from; for NaN, the reason */
} lab_metric;

/* What became of a step. */
enum lab_step_fate {
  LAB_STEP_GOOD,
  LAB_STEP_NO_SIGNAL,   /* the signal takes too long to be a step */
  LAB_STEP_GAP,         /* too few values before or after it */
  LAB_STEP_NOT_AT_REST, /* still moving when it came */
  LAB_STEP_NOT_SETTLED, /* still moving when the next one came */
  LAB_STEP_TOO_SMALL    /* the response is small against the noise, or there is none */
};

typedef struct lab_step_response {
  double t;                                  /* [s] of the step */
  double from, to;                           /* command */
  double x_from, x_to;                       /* [m] at rest before and after */
  int fate;                                  /* enum lab_step_fate; the rest is NaN unless good */
  double dead_time, t63, t86, settling_time; /* [s] from the step */
  double overshoot;                          /* [%] of the change */
  double stroke_time;                        /* [s] to 99 % of the change */
  double dead_time_error, t63_error, t86_error, settling_error, overshoot_error, stroke_error;
} lab_step_response;

typedef struct lab_metrics {
  int command; /* enum lab_command */
  lab_metric metric[LAB_METRIC_COUNT];
  int n_steps; /* all of them; the first LAB_METRIC_STEPS are kept */
  lab_step_response step[LAB_METRIC_STEPS];
} lab_metrics;

/* Measure a record.
 * Returns: LAB_OK, whatever the record can or cannot give; LAB_WORLD without memory. */
int lab_metrics_measure(const lab_record *record, lab_metrics *metrics, lab_error *error);

/* What steps and static figures refer to, in words. */
const char *lab_metrics_step_signal(int command);
const char *lab_metrics_static_signal(int command);

enum { LAB_METRIC_SHOWN = 64 };

/* "0.842", "<= 0.21", "-"
 * Returns: text */
const char *lab_metric_value(const lab_metric *metric, char text[LAB_METRIC_SHOWN]);

/* Write a table of all figures, and of the steps. */
void lab_metrics_print(FILE *file, const lab_metrics *metrics);

/* { "<key>": { "value":, "unit":, "uncertainty":, "at_most":, "standard":, "basis": }, ... }, or
 * { "<key>": { "value": null, "unit":, "reason": } } */
cJSON *lab_metrics_object(const lab_metrics *metrics);

/* Write an object with the signals, the figures and the steps.  Returns: LAB_OK, LAB_WORLD. */
int lab_metrics_json(FILE *file, const lab_metrics *metrics, lab_error *error);

#endif

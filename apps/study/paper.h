/* Closed forms of the paper [B] and what follows from its equations where it printed something else.
 *
 * Derivations are in study/PAPER.md, whose section numbers the comments and the notes of the rows give.
 * Velocities are in units of paper_speed_scale, the factor C a/A sqrt(2 R T/delta) of [B, Eq. 12].
 * Pressures named p are gauge, those named P absolute [Pa].
 *
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_PAPER_H
#define STUDY_PAPER_H

#include <stddef.h>

#include "table.h"

/* clang-format off */
/* Numbers that the paper prints and that the formulae start from, in SI.
 *    name              value        unit         where */
#define PAPER_CONSTANT_LIST(X) \
  X(GAS_CONSTANT,       8.31446,     "J/(K mol)", "Table A1, 1") \
  X(MOLAR_MASS,         0.02896,     "kg/mol",    "Table A1, 2") \
  X(AMBIENT,            101325.0,    "Pa",        "Table A1, 3") \
  X(HEAT_RATIO,         1.4,         "1",         "Table A1, 4") \
  X(TEMPERATURE,        298.15,      "K",         "Table A1, 5") \
  X(R1_VOLUME,          0.8e-3,      "m3",        "Table A1, 6") \
  X(R1_DEAD_VOLUME,     2e-6,        "m3",        "Table A1, 7") \
  X(R1_AREA,            0.04,        "m2",        "Table A1, 8") \
  X(R1_PRELOAD,         0.01,        "m",         "Table A1, 9") \
  X(R1_TRAVEL,          0.02,        "m",         "Table A1, 10") \
  X(R1_SUPPLY,          400e3,       "Pa",        "Table A1, 11") \
  X(R1_BENCH_HIGH,      240e3,       "Pa",        "Table A1, 12") \
  X(R1_RATE,            400e3,       "N/m",       "Table A1, 13") \
  X(M37_VOLUME,         2.581e-3,    "m3",        "Table A1, 14") \
  X(M37_DEAD_VOLUME,    4e-6,        "m3",        "Table A1, 15") \
  X(M37_AREA,           0.0677,      "m2",        "Table A1, 16") \
  X(M37_PRELOAD,        7.62e-3,     "m",         "Table A1, 17") \
  X(M37_TRAVEL,         38.1e-3,     "m",         "Table A1, 18") \
  X(M37_SUPPLY,         140e3,       "Pa",        "Table A1, 19") \
  X(M37_BENCH_LOW,      20e3,        "Pa",        "Table A1, 20") \
  X(M37_BENCH_HIGH,     100e3,       "Pa",        "Table A1, 20") \
  X(M37_RATE,           120e3,       "N/m",       "Table A1, 21") \
  X(MASS,               2.0,         "kg",        "Table A1, 22") \
  X(FRICTION,           480.0,       "N",         "Table A1, 23") \
  X(VISCOUS,            500.0,       "N s/m",     "Table A1, 24") \
  X(R1_ORIFICE,         0.893e-6,    "m2",        "Table A1, 25") \
  X(M37_ORIFICE,        2.177e-6,    "m2",        "Table A1, 26") \
  X(DAMPING,            1000.0,      "N s/m",     "Table A1, 27") \
  X(SPRINGS_3_LOW,      20e3,        "Pa",        "Table 1") \
  X(SPRINGS_3_HIGH,     100e3,       "Pa",        "Table 1") \
  X(SPRINGS_6_LOW,      80e3,        "Pa",        "Table 1") \
  X(SPRINGS_6_HIGH,     240e3,       "Pa",        "Table 1") \
  X(SPRINGS_12_LOW,     180e3,       "Pa",        "Table 1") \
  X(SPRINGS_12_HIGH,    380e3,       "Pa",        "Table 1") \
  X(CHANGE_3,           0.290,       "1",         "Table 1, without its sign") \
  X(CHANGE_6,           0.200,       "1",         "Table 1, without its sign") \
  X(CHANGE_12,          0.175,       "1",         "Table 1, without its sign") \
  X(EXAMPLE_AMBIENT,    100e3,       "Pa",        "Example 1") \
  X(EXAMPLE_SUPPLY,     400e3,       "Pa",        "Example 2") \
  X(TYPICAL_LOW,        140e3,       "Pa",        "text before Fig. 8") \
  X(TYPICAL_HIGH,       800e3,       "Pa",        "text before Fig. 8") \
  X(FLAT_FROM,          5.0,         "1",         "text before Fig. 6") \
  X(PRELOAD_FORCE,      4000.0,      "N",         "hypothesis 2") \
  X(CLASS_1_LOW,        80e3,        "Pa",        "Fig. 18") \
  X(CLASS_1_HIGH,       240e3,       "Pa",        "Fig. 18") \
  X(CLASS_2_LOW,        120e3,       "Pa",        "Fig. 18") \
  X(CLASS_2_HIGH,       280e3,       "Pa",        "Fig. 18") \
  X(CLASS_3_LOW,        160e3,       "Pa",        "Fig. 18") \
  X(CLASS_3_HIGH,       320e3,       "Pa",        "Fig. 18") \
  X(CLASS_4_LOW,        200e3,       "Pa",        "Fig. 18") \
  X(CLASS_4_HIGH,       360e3,       "Pa",        "Fig. 18")

/* clang-format on */

enum paper_constant_id {
#define X(name, value, unit, where) PAPER_##name,
  PAPER_CONSTANT_LIST(X)
#undef X
      PAPER_CONSTANT_COUNT
};

typedef struct paper_constant {
  const char *name;
  double value; /* SI */
  const char *unit, *where;
} paper_constant;

extern const paper_constant paper_constants[PAPER_CONSTANT_COUNT];

/* ---- Flow laws ---- */

/* Mass flow over C a sqrt(2 delta/(R T)), a pressure [Pa], for 0 <= P_dn <= P_up. */
typedef double (*paper_flow)(double P_up, double P_dn);

/* [B, Eq. 9]: sqrt(P_up (P_up - P_dn)). */
double paper_flow_unchoked(double P_up, double P_dn);

/* Isentropic nozzle with the gamma of Table A1, choked below P_dn/P_up = 0.528; for a small drop in
 * pressure it is the law above (PAPER.md 3.4). */
double paper_flow_choked(double P_up, double P_dn);

/* Ratio of pressures below which the nozzle chokes. */
double paper_choking_ratio(void);

typedef struct paper_law {
  const char *key; /* as in results/: "paper", "choked" */
  paper_flow flow;
} paper_law;

enum { PAPER_LAW_UNCHOKED, PAPER_LAW_CHOKED, PAPER_LAW_COUNT };
extern const paper_law paper_laws[PAPER_LAW_COUNT];

/* ---- The paper's velocities: pressure taken as constant while the stem moves ---- */

/* [B, Eqs. 12, 14] with any flow law: flow(P_s, P)/P. */
double paper_fill_speed(paper_flow flow, double P_s, double P);

/* [B, Eqs. 19, 25] with any flow law: flow(P, P_a)/P. */
double paper_vent_speed(paper_flow flow, double P, double P_a);

/* [B, Eq. 23] with any flow law: 1 - v(p_bl)/v(p_bh) while venting to P_a. */
double paper_speed_change(paper_flow flow, double p_bl, double p_bh, double P_a);

/* Right end of [B, Eq. 35]: p/p_s at which both edges are equally fast.  In: pa_over_ps, any real number */
double paper_critical_pressure(double pa_over_ps);

/* The same for any flow law, by bisection of flow(P_s, P) = flow(P, P_a).  In: pa_over_ps >= 0 */
double paper_crossing(paper_flow flow, double pa_over_ps);

/* Positive root of s (s + 1) = c, the form of [B, Eq. 30]; c >= 0. */
double paper_supply_threshold(double c);

/* C a/A sqrt(2 R T/delta) [m/s] of [B, Eq. 12].  In: orifice C a [m2], area A [m2], temperature [K] */
double paper_speed_scale(double orifice, double area, double temperature);

/* ---- Energy (PAPER.md 7) ---- */

/* Energy of the leaving over that of the entering air, E_o/E_i of [B, Eqs. 41-43], for a stem that
 * travels between the bench pressures: (p_bl + p_bh)/(2 p_s). */
double paper_returned_share(double p_bl, double p_bh, double p_s);

/* Largest work that a loaded stem can do in a cycle over the isothermal exergy of the air that fills
 * the swept volume to p_s: p_s/(P_s ln(P_s/P_a)). */
double paper_exergy_efficiency(double p_s, double P_a);

/* ---- A spring-loaded stem in quasi-equilibrium (PAPER.md 3.2) ---- */

typedef struct paper_actuator {
  const char *key;    /* as in results/: "r1-400", "37-13" */
  double area;        /* [m2] */
  double dead_volume; /* [m3] */
  double travel;      /* [m] */
  double rate;        /* [N/m] of the spring */
  double preload;     /* [m] compression at x = 0 */
  double supply;      /* [Pa] gauge */
  double bench_low;   /* [Pa] gauge, at x = 0 without friction */
  double bench_high;  /* [Pa] gauge, at x = travel without friction */
  double orifice;     /* C a [m2], fill and vent */
  double friction;    /* [N] Coulomb */
} paper_actuator;

enum { PAPER_R1_400, PAPER_37_13, PAPER_ACTUATOR_COUNT };

/* Actuator of Table A1 with its spring as printed; the bench set of the R1-400 is the 80..240 kPa
 * of Table 1, as Table A1 misprints it. */
paper_actuator paper_actuator_printed(int which);

/* The same actuator with the spring rate and preload that a bench set implies (PAPER.md 8.1):
 * k = A (p_bh - p_bl)/x_n, x_0 = p_bl A/k.  In: base; p_bl < p_bh [Pa] */
paper_actuator paper_actuator_with_bench(const paper_actuator *base, double p_bl, double p_bh);

/* One way of computing a stroke. */
typedef struct paper_case {
  paper_actuator actuator;
  paper_flow flow;
  double P_a;
  double storage; /* 1: V dp/dt stays in the mass balance [B, Eq. 7]; 0: dropped, [B, Eqs. 10, 18] */
} paper_case;

enum { PAPER_DOWN = -1, PAPER_UP = 1 };

/* Chamber pressure, gauge, of a stem that slides slowly: (k (x + x_0) + direction F)/A. */
double paper_pressure(const paper_case *c, int direction, double x);

/* Velocity of the sliding stem, positive both ways: flow/(P + storage k V(x)/A^2).
 * Omits: inertia, viscous friction (0.4 kPa in Table A1), heat.
 * Source: isothermal mass balance [B, Eq. 7] with dp = k/A dx. */
double paper_speed(const paper_case *c, int direction, double x);

/* Time [s] from 5 % to 95 % of the stroke, at the temperature of Table A1, by Simpson's rule. Infinite or NaN
 * where the stem cannot get through. */
double paper_stroke_time(const paper_case *c, int direction);

/* Area between the two strokes from 5 % to 95 % of travel, each over its own duration, the falling one
 * mirrored: 0 for equal shapes. The area is taken along the travel, which gives the same number. */
double paper_asymmetry(const paper_case *c);

/* Bench set of the width of c's whose two strokes take equal time: its lower end [Pa], by bisection
 * between 0 and the highest that the supply can move; NaN if there is none. */
double paper_symmetric_bench(const paper_case *c);

/* ---- Rows of results/paper_numbers.csv ---- */

/* One number or claim of the paper beside ours. */
typedef struct paper_row {
  const char *item, *quantity, *unit;
  double printed;     /* NaN: a claim without a number */
  double computed;    /* NaN: a matter of form, without a number */
  const char *agrees; /* "yes", "no", "rounding" */
  const char *note;
  const char *kind, *cause; /* of a "no": "arithmetic", "derivation", "data" or "modelling", and what it comes from;
                               several rows may share a cause. "" of the others */
} paper_row;

/* Fill at most `room` rows.  Returns: how many there are in all; rows may be NULL if room is 0. */
size_t paper_numbers(paper_row *rows, size_t room);

/* Append one row, ours or that of a simulation, to a table opened with PAPER_ROW_HEADER. */
#define PAPER_ROW_HEADER "item,quantity,unit,printed,computed,agrees,note,kind,cause"
void paper_row_add(table *t, const paper_row *row);

/* Verdict on a printed number.
 * In:      digit  unit of its last digit
 *          slack  how far rounded or cut intermediate numbers can carry it
 * Returns: "yes" within half a digit, "rounding" within slack beyond that, else "no" (also for NaN). */
const char *paper_agreement(double printed, double computed, double digit, double slack);

/* ---- Tables of figures 5 to 8; each opens t, the caller closes it ---- */

void paper_numbers_table(table *t); /* every row of paper_numbers */
void paper_fig05(table *t);         /* velocity of the leading edge over P_1/P_2, R1-400 */
void paper_fig06(table *t);         /* velocity of the falling edge over p/p_a, and that of the spring-loaded stem */
void paper_fig07(table *t);         /* p/p_s where both edges are equally fast, over p_a/p_s */
void paper_fig08(table *t);         /* the same over p_s/p_a, with the asymptote */

#endif

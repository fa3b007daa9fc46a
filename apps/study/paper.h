/* Closed forms of the paper [B] and what follows from its equations where it printed something else.
 *
 * Derivations are in study/PAPER.md, whose section numbers the comments and the notes of the rows give.
 * Velocities are in units of paper_speed_scale, the factor C a/A sqrt(2 R T/delta) of [B, Eq. 12].
 * Pressures named p are gauge, those named P absolute [Pa].
 *
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_PAPER_H
#define STUDY_PAPER_H

#include "table.h"

/* Numbers that the paper prints and that the formulae start from, SI. */
typedef struct paper_constants {
  double gas_constant, molar_mass, ambient, heat_ratio, temperature; /* Table A1, 1 to 5 */
  double mass, viscous, damping;                                     /* Table A1, 22, 24, 27 */
  double example_ambient, example_supply;                            /* Examples 1 and 2 */
  double typical_low, typical_high;                                  /* supplies, text before Fig. 8 */
} paper_constants;

extern const paper_constants paper;

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

/* Table A1 with springs as printed; the bench set of the R1-400 is the 80..240 kPa of Table 1, as Table A1 misprints
 * it. */
extern const paper_actuator paper_actuators[PAPER_ACTUATOR_COUNT];

/* An actuator with the spring rate and preload that a bench set implies (PAPER.md 8.1):
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

/* ---- Tables; each is opened here, the caller closes it ---- */

/* Verdict on a printed number.
 * In:      digit  unit of its last digit
 *          slack  how far rounded or cut intermediate numbers can carry it
 * Returns: "yes" within half a digit, "rounding" within slack beyond that, else "no" (also for NaN). */
const char *paper_agreement(double printed, double computed, double digit, double slack);

/* Every number or claim of the paper beside ours. A row that tests no statement of the paper is an aside and not
 * counted; one that disagrees has a kind ("arithmetic", "derivation", "data", "modelling"), a cause, which several rows
 * may share, and a severity: what it changes, "conclusion", "number" or "form". */
void paper_numbers_table(table *t);

enum { PAPER_FIG05, PAPER_FIG06, PAPER_FIG07, PAPER_FIG08, PAPER_FIGURES };

/* The curves of figures 5 to 8: velocity of the leading edge over P_1/P_2; of the falling one over p/p_a, and that of
 * the spring-loaded stem; p/p_s where both edges are equally fast, over p_a/p_s, and over p_s/p_a with the asymptote.
 */
void paper_figure(int which, table *t);

#endif

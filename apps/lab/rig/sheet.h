/* The words of a data sheet in a rig file, and what becomes of them:
 *
 *   actuator   = { bench_set = ["0.2 bar", "1.0 bar"];     // in place of spring_rate and spring_preload
 *                  diameter = "226 mm";                   // in place of area
 *                  fail = "open"; };                      // or "close"
 *   transducer = { fill = { Kv = 0.1; };                   // or { Cv = 0.12; }, { C = "0.4 dm3/(s.bar)"; b = 0.3; },
 *                  vent = { Qn = "110 l/min"; }; };        // { Qn = ; }, in place of fill_area and vent_area
 *   tube       = { length = "2 m"; bore = "4 mm"; };       // in place of the effect connecting_tube
 *
 * - bench_set: gauge pressures at which the stem leaves its lower stop and reaches the upper one, without friction and
 *   process forces: p A = k (x + x_0), so that k = A (p_high - p_low)/stroke and x_0 = A p_low/k. Source: the force
 *   balance of [B, Eq. 1]; the term is that of ANSI/ISA-75.05.01.
 * - diameter: the effective one, pi d^2/4 = area; plates print it beside or in place of the area.
 * - fail: where the spring takes the valve when the air fails. A log's travel and set position say how far it is open.
 *   With "close" the air opens it and they are those of the model, whose stem follows the air; with "open" the air
 *   closes it, and they are read as what is left to the stroke.
 * - Kv: [m3/h] of water at 1 bar (IEC 60534-1), number or text. Air by IEC 60534-2-1:2011, with Fp = 1:
 *   W = 31.6 Kv Y sqrt(x p_1 rho_1) in kg/h, bar, kg/m3; Y = 1 - x/(3 xT); choked from x = xT on, Y = 2/3. xT, where it
 *   is not given, is 0.72 (a globe valve, its Table D.2): a spool or a nozzle chokes earlier, and a wrong xT costs up
 *   to a sixth of the choked flow.
 * - Cv: [gal/min of water at 1 psi]: Kv = 0.865 Cv (IEC 60534-1).
 * - C, b: sonic conductance [m3/(s Pa), ANR 293.15 K, 100 kPa] and critical pressure ratio (ISO 6358-1:2013). b becomes
 *   transducer.critical_ratio, which is one for both orifices; without it that stands.
 * - Qn: standard nominal flow [m3/s] from p1 to p2, gauge, by default 6 bar to 5 bar (VDI 3290), of air at 0 degC and
 *   101325 Pa (DIN 1343: 1.293 kg/m3).
 * - tube: tube_volume = pi d^2 L/4, and tube_resistance = pressure drop over mass flow, both of the flow that the fill
 *   orifice passes from the supply to ambient, at the mean of the two pressures: 128 mu L/(pi rho d^4) (Hagen and
 *   Poiseuille) below Re = 2300, else f L rho v^2/(2 d) over it with f = 0.3164 Re^-0.25 (Blasius 1913). Bends and
 *   fittings are not in it; at smaller flow the resistance is smaller.
 *
 * An orifice becomes the area through which the declared flow law passes the same air at 293.15 K: choked for Kv, Cv
 * and C, from 6 bar to 5 bar with the law "paper", which does not choke; from p1 to p2 for Qn.
 *
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SHEET_H
#define LAB_SHEET_H

#include <libconfig.h>

#include "rig.h"

/* Convert the words of a rig file into parameters, after everything else of it was read.
 * In/out:  rig
 * Returns: LAB_OK; LAB_DATA with the place, also where a value is there in both ways. */
int lab_sheet_read(const config_setting_t *root, lab_rig *rig, lab_error *error);

/* Whether a key is one of these words, such as "bench_set". */
int lab_sheet_has(const char *group, const char *key);

#endif

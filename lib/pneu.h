/* libpneu: a spring-and-diaphragm pneumatic actuator, for firmware and for the bench.
 *
 * Rules that hold throughout:
 *   Units      SI. Pressures in parameters and inputs are gauge unless the name says abs;
 *              pressures in flow functions are absolute. Temperatures are absolute [K].
 *   Sign       x grows in the direction in which the air drives the stem, from 0 at the lower
 *              stop (spring side) to `stroke`; mass flow is positive into the chamber.
 *   Arguments  model first, then state, then inputs, outputs last.
 *   Memory     the caller owns everything; nothing is allocated, and no function but pneu_model_terms
 *              keeps a pointer. No pointer may be NULL unless its comment says so.
 *   Results    functions that can fail return PNEU_OK (0), a value > 0 to ask for a smaller step, or
 *              a value < 0 to stop; pneu_status_text() has the words.
 *   Precision  pneu_real is double, or float where everything is compiled with PNEU_SINGLE.
 *   Effects    the catalogue is effects.def, or the file that PNEU_EFFECTS_FILE names: a copy with fewer lines makes a
 *              smaller library. Compile the library and its user with the same one: it sets array sizes.
 *   Free terms the same holds for PNEU_TERM_KNOTS, room for the knots of a free term. 0 leaves free
 *              terms out of the code.
 *   Compiler   lib/ refuses -ffast-math and -ffinite-math-only, which would take its checks for NaN away. What uses it
 *              may have them.
 *   Method     PNEU_ORDER 5 (in double) is Rodas5P, exact to many digits; 4 (in single) is ROS4: less than half the
 * work, a fifth less workspace for the base model, and more exact in single precision up to steps of 2 ms. The same
 * holds for it.
 *
 * The equations are derived in DESIGN.md; [B] stands for M. Bartys, "Dynamics of single-action
 * pneumatic actuators", whose model this library extends.
 *
 * SPDX-License-Identifier: MIT */
#ifndef PNEU_H
#define PNEU_H

/* Version of header and library. What uses another MAJOR.MINOR is compiled again: structs may have grown. */
#define PNEU_VERSION_MAJOR 0
#define PNEU_VERSION_MINOR 1
#define PNEU_VERSION_PATCH 0

#define PNEU_VERSION_WORDS(a, b, c) #a "." #b "." #c
#define PNEU_VERSION_TEXT(a, b, c)  PNEU_VERSION_WORDS(a, b, c)
#define PNEU_VERSION                PNEU_VERSION_TEXT(PNEU_VERSION_MAJOR, PNEU_VERSION_MINOR, PNEU_VERSION_PATCH)

#ifdef PNEU_SINGLE
typedef float pneu_real;
#define pneu_model_init pneu_model_init_single /* a mixed build fails at link time */
#else
typedef double pneu_real;
#endif

#ifndef PNEU_TERM_KNOTS
#define PNEU_TERM_KNOTS 33
#endif

#ifndef PNEU_EFFECTS_FILE
#define PNEU_EFFECTS_FILE "effects.def"
#endif

#ifndef PNEU_ORDER
#ifdef PNEU_SINGLE
#define PNEU_ORDER 4
#else
#define PNEU_ORDER 5
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off */

/* ---- Lists: each expands into an enum, a table of words, a struct, wherever it is needed ---- */

/*    name                   code  text */
#define PNEU_STATUS_LIST(X) \
  X(PNEU_OK,                    0, "success") \
  X(PNEU_RETRY_STATE,           1, "trial state outside the model's domain") \
  X(PNEU_HELD,                  2, "stem held, for want of parts of the step") \
  X(PNEU_E_PARAM,              -1, "parameter outside its bounds or not finite") \
  X(PNEU_E_LAW,                -2, "unknown law or role") \
  X(PNEU_E_NONFINITE,          -3, "non-finite or unphysical input, state, step or tolerance") \
  X(PNEU_E_STEP_SIZE,          -4, "step size fell below its limit") \
  X(PNEU_E_STEP_COUNT,         -5, "more steps than allowed") \
  X(PNEU_E_EVENTS,             -6, "more events than allowed in one step") \
  X(PNEU_E_SINGULAR,           -7, "iteration matrix is singular") \
  X(PNEU_E_STOPPED,            -8, "stopped by the observer") \
  X(PNEU_E_DELAY,              -9, "no room for a command that acts late: see pneu_input.delay")

/*    name         key in files   chamber law */
#define PNEU_GAS_LIST(X) \
  X(ISOTHERMAL, "isothermal", "p V = m R T at ambient temperature [B, Eq. 6]") \
  X(POLYTROPIC, "polytropic", "energy balance with n for gamma, no wall; n = 1.4 is adiabatic; beside a film, ENERGY") \
  X(ENERGY,     "energy",     "energy balance of an ideal gas with constant heat capacities and heat from the wall")

#define PNEU_FLOW_LIST(X) \
  X(PAPER,      "paper",      "a sqrt(2 rho_up (p_up - p_dn)), never chokes [B, Eq. 8]") \
  X(CHOKED,     "choked",     "isentropic nozzle, choked below (2/(g+1))^(g/(g-1))") \
  X(ISO6358,    "iso6358",    "ISO 6358-1:2013 (C, b, m), choked below b")

#define PNEU_MODE_LIST(X) \
  X(LOWER,      "lower stop",   "at rest on the lower stop") \
  X(STUCK,      "stuck",        "at rest between the stops, held by friction") \
  X(UP,         "sliding up",   "v > 0; on bristles, which never stick, at rest too") \
  X(DOWN,       "sliding down", "v < 0; on bristles at rest too") \
  X(UPPER,      "upper stop",   "at rest on the upper stop") \
  X(DRIVEN,     "driven",       "position is an input") \
  X(FIXED,      "fixed",        "no stem: a vessel")

/* Parameters of the base model. Bounds are those of physics and of sane data, not of the law.
 *    name                  unit        lower   upper   default    meaning */
#define PNEU_PARAM_LIST(X) \
  X(area,                "m2",       1e-6,   10.0,   0.04,      "effective area of the diaphragm") \
  X(dead_volume,         "m3",       1e-9,   10.0,   2e-6,      "chamber volume at x = 0, with the line") \
  X(swept_ratio,         "1",        0.0,    2.0,    1.0,       "volume swept per travel over effective area") \
  X(stroke,              "m",        0.0,    10.0,   0.02,      "travel between the stops; 0 makes a vessel") \
  X(spring_rate,         "N/m",      0.0,    1e9,    4e5,       "spring rate") \
  X(spring_preload,      "m",       -1.0,    1.0,    0.01,      "compression of the spring at x = 0") \
  X(moving_mass,         "kg",       1e-4,   1e4,    2.0,       "lumped moving mass") \
  X(dry_friction,        "N",        0.0,    1e6,    480.0,     "Coulomb friction") \
  X(viscous_friction,    "N.s/m",    0.0,    1e7,    500.0,     "viscous friction of packing and guide") \
  X(damping,             "N.s/m",    0.0,    1e7,    1000.0,    "damping of the stem") \
  X(external_force,      "N",       -1e7,    1e7,    0.0,       "constant force on the stem, positive against the air") \
  X(fill_area,           "m2",       0.0,    1.0,    0.893e-6,  "effective area C*a of the fill orifice, fully open") \
  X(vent_area,           "m2",       0.0,    1.0,    0.893e-6,  "effective area C*a of the vent orifice, fully open") \
  X(critical_ratio,      "1",        0.0,    0.9,    0.3,       "b of ISO 6358") \
  X(subsonic_index,      "1",        0.2,    1.0,    0.5,       "m of ISO 6358") \
  X(proportional_band,   "Pa",       0.0,    1e7,    0.0,       "0: u is the opening; else u is a set pressure [Pa] and this opens the transducer fully") \
  X(supply_pressure,     "Pa",       0.0,    1e8,    4e5,       "supply, gauge") \
  X(supply_temperature,  "K",        100.0,  1500.0, 298.15,    "supply air") \
  X(ambient_pressure,    "Pa",       1e2,    1e7,    101325.0,  "ambient, absolute") \
  X(ambient_temperature, "K",        100.0,  1500.0, 298.15,    "ambient air and chamber wall") \
  X(gas_constant,        "J/kg/K",   10.0,   1e4,    287.1015193370166, "8.31446/0.02896 [B, Table A1]") \
  X(heat_ratio,          "1",        1.01,   1.67,   1.4,       "gamma of the gas") \
  X(polytropic_index,    "1",        1.0,    1.67,   1.4,       "n of the polytropic law")

/* What a free term is added to. Friction is added to the level that the effects have made, in both directions and at
 * break-away, and is not below 0 with it; LuGre friction, whose force is a share of dry_friction, needs that above 0.
 * Flow comes in at ambient temperature and leaves at that of the gas. Heat counts where the chamber law is an energy
 * balance; supply, flow and heat, where pressure is no input; sensors show the term as it is, behind their lags and gains.
 *    name            key in files      unit */
#define PNEU_TERM_EQUATION_LIST(X) \
  X(SUPPLY,         "supply",         "Pa",   "supply pressure at the transducer") \
  X(FORCE,          "force",          "N",    "force on the stem, positive against the air") \
  X(FRICTION,       "friction",       "N",    "level of dry friction") \
  X(FLOW,           "flow",           "kg/s", "mass flow into the chamber") \
  X(HEAT,           "heat",           "W",    "heat into the gas") \
  X(SHOWN_PRESSURE, "shown_pressure", "Pa",   "what the pressure sensor shows too much") \
  X(SHOWN_POSITION, "shown_position", "m",    "what the position sensor shows too much")

/* What a free term depends on: always the true value, never a sensor's. Over a cycle its values are no knots but the
 * amplitudes of cosine and sine of the period to - from, of its half, its third ..., by the model's clock; `to` and
 * `from` mean no more than that, and the clock is a state of the model: see pneu_model.clock.
 *    name      key   unit */
#define PNEU_TERM_ARGUMENT_LIST(X) \
  X(POSITION, "x", "m",   "position of the stem") \
  X(VELOCITY, "v", "m/s", "velocity of the stem, signed") \
  X(PRESSURE, "p", "Pa",  "gauge pressure in the chamber") \
  X(OPENING,  "u", "1",   "opening of the transducer after its own dynamics; 0 where pressure is an input") \
  X(CYCLE,    "t", "s",   "time, in cycles that repeat")

enum pneu_status {
#define X(name, code, text) name = code,
  PNEU_STATUS_LIST(X)
#undef X
  PNEU_STATUS_END = 99
};

enum pneu_gas {
#define X(name, key, text) PNEU_GAS_##name,
  PNEU_GAS_LIST(X)
#undef X
  PNEU_GAS_COUNT
};

enum pneu_flow_law {
#define X(name, key, text) PNEU_FLOW_##name,
  PNEU_FLOW_LIST(X)
#undef X
  PNEU_FLOW_COUNT
};

enum pneu_mode {
#define X(name, key, text) PNEU_MODE_##name,
  PNEU_MODE_LIST(X)
#undef X
  PNEU_MODE_COUNT
};

/* Where a stem is about the positions at which its positioner shuts both orifices, its dead band: the opening jumps at
 * either edge. Along a ramp of the set position it does not, and no side is told. */
enum pneu_side { PNEU_SIDE_UNTOLD, PNEU_SIDE_BELOW, PNEU_SIDE_WITHIN, PNEU_SIDE_ABOVE };

enum pneu_param {
#define X(name, unit, lo, hi, dflt, text) PNEU_PARAM_##name,
  PNEU_PARAM_LIST(X)
#undef X
  PNEU_PARAM_BASE_COUNT
};

enum pneu_term_equation {
#define X(name, key, unit, text) PNEU_TERM_##name,
  PNEU_TERM_EQUATION_LIST(X)
#undef X
  PNEU_TERM_EQUATION_COUNT
};

enum pneu_term_argument {
#define X(name, key, unit, text) PNEU_TERM_OVER_##name,
  PNEU_TERM_ARGUMENT_LIST(X)
#undef X
  PNEU_TERM_ARGUMENT_COUNT
};

/* Effects, the place of the first parameter of each in pneu_params.effect (PNEU_AT_chamber_leak), and their number of
 * states. */
enum pneu_effect_id {
#define PNEU_EFFECT(name, n_param, n_state) PNEU_EFFECT_##name,
#include PNEU_EFFECTS_FILE
#undef PNEU_EFFECT
  PNEU_EFFECT_COUNT
};

enum pneu_effect_place {
#define PNEU_EFFECT(name, n_param, n_state) PNEU_AT_##name, PNEU_LAST_##name = PNEU_AT_##name + n_param - 1,
#include PNEU_EFFECTS_FILE
#undef PNEU_EFFECT
  PNEU_EFFECT_PARAM_COUNT
};

enum pneu_effect_sizes {
  PNEU_EFFECT_STATE_COUNT = 0
#define PNEU_EFFECT(name, n_param, n_state) + n_state
#include PNEU_EFFECTS_FILE
#undef PNEU_EFFECT
  ,
  PNEU_PARAM_COUNT = PNEU_PARAM_BASE_COUNT + PNEU_EFFECT_PARAM_COUNT,
  PNEU_EXTRA_MAX = PNEU_EFFECT_STATE_COUNT + 1, /* effects, clock; never 0: C has no empty array */
  PNEU_STATE_MAX = 4 + PNEU_EFFECT_STATE_COUNT + (PNEU_TERM_KNOTS > 0), /* and p, T, clock, x, v */
  PNEU_STAGE_COUNT = PNEU_ORDER == 5 ? 8 : 4,   /* of the Rosenbrock method */
  PNEU_DENSE_COUNT = PNEU_ORDER == 5 ? 3 : 2,   /* powers of its dense output */
  PNEU_NOZZLE_TERMS = sizeof(pneu_real) == sizeof(double) ? 16 : 8, /* of a polynomial; a multiple of 4 */
  PNEU_TERM_ROOM = PNEU_TERM_KNOTS > 0 ? PNEU_TERM_KNOTS : 1
};

/* clang-format on */

/* ---- Types; all open, so that they can be placed statically ---- */

typedef struct pneu_params {
#define X(name, unit, lo, hi, dflt, text) pneu_real name;
  PNEU_PARAM_LIST(X)
#undef X
  pneu_real effect[PNEU_EFFECT_PARAM_COUNT + 1]; /* in the order of effects.def; one spare */
} pneu_params;

typedef struct pneu_laws {
  int gas;            /* enum pneu_gas */
  int flow;           /* enum pneu_flow_law */
  int pressure_input; /* not 0: chamber pressure is an input, the mass balance is off */
  int position_input; /* not 0: stem position is an input, the force balance is off */
} pneu_laws;

/* A value on its way. */
typedef struct pneu_late {
  pneu_real gap; /* [s] from the value before it */
  pneu_real value;
  int runs; /* not 0: the signal runs here on a straight line from the value before; 0: it jumps */
} pneu_late;

/* A signal that acts some time after it is given, and what is on its way, in the caller's memory. */
typedef struct pneu_delay {
  pneu_late *slot; /* the caller's, a ring of `room` */
  int room, first, n;
  pneu_real acting; /* the value reached last */
  pneu_real given;  /* the newest */
  pneu_real since;  /* [s] since `acting` was reached; 0 where nothing is on its way */
} pneu_delay;

/* What drives the model over one stretch of time. The command holds or runs along a straight line, and so do pressure
 * and position where they are inputs; the rest holds. */
typedef struct pneu_input {
  pneu_real u;               /* -1..1 opening: 1 fill fully open, -1 vent fully open, 0 shut; or set pressure [Pa]; or
                                set position of a positioner, in shares of the stroke */
  pneu_real u_rate;          /* [unit of u over s] slope of the command that acts; 0: it holds */
  pneu_real elapsed;         /* [s] since it was u: what acts is u + u_rate elapsed. A run goes on from here */
  pneu_real supply_pressure; /* [Pa] gauge */
  pneu_real force;           /* [N] on the stem, positive against the air, added to external_force */
  pneu_real pressure_rate;   /* [Pa/s] slope of the chamber pressure, where it is an input */
  pneu_real position_rate;   /* [m/s] slope of the position, where it is an input */
  pneu_delay *delay;         /* commands on their way, for a model with command_delay; else NULL will do */
  int set_position;          /* not 0: u is a set position, for a model with a positioner (effect positioner); 0: its
                                positioner does nothing */
} pneu_input;

typedef struct pneu_state {
  pneu_real p;                     /* [Pa] gauge, gas in the chamber */
  pneu_real T;                     /* [K] gas temperature */
  pneu_real x;                     /* [m] stem position, 0..stroke */
  pneu_real v;                     /* [m/s] stem velocity */
  pneu_real extra[PNEU_EXTRA_MAX]; /* states of the active effects, see pneu_model.state_of; the clock */
  int mode;                        /* enum pneu_mode */
  int side;                        /* enum pneu_side, by pneu_settle and pneu_switch; constant within a step */
} pneu_state;

/* Forms of an effect: one that it always has, and one that it may do without. */
enum pneu_form { PNEU_FORM_OWN = 1, PNEU_FORM_OPTION = 2 };

/* A parameter, as files, fits, reports and --help want it. */
typedef struct pneu_param_info {
  const char *name, *unit;
  pneu_real lower, upper;
  pneu_real value;   /* base model: default. Effect: the size it starts from when switched on */
  pneu_real neutral; /* effect: value at which the model is the base model, or the effect without this form; else as
                        `value` */
  int shape;         /* effect: not 0 if it only gives form to what another parameter switches on (enum pneu_form) */
  const char *meaning;
} pneu_param_info;

/* A free term: something that acts, measured but not named. Its value lies on straight lines between knots at equal
 * distances, the first at `from` and the last at `to`, and is constant beyond them; over a cycle it is a Fourier
 * series. */
typedef struct pneu_term {
  int equation;                    /* enum pneu_term_equation */
  int argument;                    /* enum pneu_term_argument */
  int n;                           /* knots, 2..PNEU_TERM_KNOTS */
  pneu_real from, to;              /* argument at the first and at the last knot, from < to */
  pneu_real value[PNEU_TERM_ROOM]; /* at the knots, in the unit of the equation; over a cycle cos, sin, cos, sin ... */
} pneu_term;

/* How an effect is at work: not at all; with its states; by the model's constants alone, without states. */
enum pneu_action { PNEU_RESTS, PNEU_ACTS, PNEU_ACTS_BY_CONSTANTS };

typedef struct pneu_model pneu_model;
struct pneu_terms; /* the running sums of one evaluation; private to lib/ */

/* An effect: what it is, and the function that adds its terms (NULL where `prepare` does all). One per file in
 * lib/effects/. */
typedef struct pneu_effect {
  const char *name;             /* as in reports and files */
  const char *what;             /* one sentence */
  const char *source;           /* author, year, equation */
  const char *equation;         /* mass, energy, force, command or sensor */
  const char *footprint;        /* where its absence shows in a residual */
  int stage;                    /* enum pneu_stage: when in an evaluation it adds its terms */
  const pneu_param_info *param; /* as many as effects.def says */
  void (*add)(const pneu_real *param, const pneu_real *state, struct pneu_terms *terms, pneu_real *rate);
  void (*start)(const pneu_real *param, const struct pneu_terms *terms, pneu_real *state); /* at rest; NULL: 0 */
  int (*acts)(const struct pneu_model *model, const pneu_real *param); /* enum pneu_action; NULL: with its states where
                                                                           any parameter is not neutral */
  void (*prepare)(struct pneu_model *model, const pneu_real *param);   /* change the model's constants; may be NULL */
} pneu_effect;

/* A flow law of the caller's: as pneu_orifice, always with the slopes. */
struct pneu_flow;
typedef void pneu_own_flow(const pneu_model *model, pneu_real area, pneu_real p_up, pneu_real T_up, pneu_real p_down,
                           struct pneu_flow *flow);

/* A line that takes pressure from what flows through it. */
typedef struct pneu_line {
  pneu_real resistance; /* [Pa s/kg] at the full flow of the fill orifice; 0: none */
  pneu_real turbulence; /* [1] share of that which grows with the flow */
  pneu_real area;       /* [m2] of the orifice that resists as that share does; 0: none */
  pneu_real lost;       /* [Pa] towards the chamber, where it is in series with an orifice */
} pneu_line;

/* Constant after pneu_model_init and pneu_model_terms; may lie in read-only memory.
 *
 * Time that the state does not hold: commands on their way to a model with command_delay (effect dead_time), set
 * positions apart, are in pneu_input.delay; without one pneu_run and pneu_step refuse such a model. position_skew
 * (effect channel_skew) is the recorder's: pneu_show and pneu_observe say what the sensor has at time t, and the
 * recorder shows it at t + position_skew. The programs do so; firmware that compares positions puts them through a
 * pneu_delay of its own. */
struct pneu_model {
  pneu_params p;
  pneu_laws law;
  pneu_own_flow *own_flow;  /* set by the caller after pneu_model_init: in the place of law.flow; else NULL */
  pneu_real g;              /* exponent of the energy balance: n or gamma */
  pneu_real critical_ratio; /* of the isentropic nozzle */
  pneu_real nozzle[PNEU_NOZZLE_TERMS]; /* of its flow function, see lib/flow.c */
  pneu_real choked_gain;               /* choked flow is area p_up choked_gain / sqrt(T_up) [sqrt(kg K/J)] */
  pneu_real nozzle_gain;               /* sqrt(2 gamma/((gamma-1) R)) [sqrt(kg K/J)] */
  pneu_real paper_gain;                /* sqrt(2/R) [sqrt(kg K/J)] */
  pneu_real viscous;                   /* viscous_friction + damping [N.s/m] */
  pneu_real lower_stop, upper_stop;    /* [m] where the stem is stopped: 0 and travel, unless an effect moves them */
  pneu_real travel;                    /* [m] between touching both stops: stroke, less what an effect takes away */
  pneu_real stop_compliance;           /* [m/N] of either stop; 0: rigid */
  pneu_real exponent_rise;             /* [1] n - 1 of an isothermal chamber that is not quite one; 0: isothermal */
  pneu_real rate_exponent_rise;        /* [1] the same of the rate of pressure, while the temperature stays */
  pneu_real start_excess;              /* [K] by which gas is warmer than told where a state of rest begins */
  pneu_real band_edge;                 /* [1] of the stroke, over which a positioner's dead band opens while its set
                                          position runs; may be changed after pneu_model_init to another above
                                          0, see effects/positioner.c */
  pneu_real dead_band;                 /* [1] of the stroke, of a positioner, either way; 0: none */
  pneu_real feedback_zero, feedback_span; /* [m], [1]: it sees x (1 + span) + zero */
  pneu_line supply_loss;               /* on the way from the supply, without a volume */
  pneu_real area_slope;                /* [1/m] share of the effective area lost per travel */
  pneu_real command_delay;             /* [s] from a command to its action, see pneu_input.delay; a set position acts
                                          at once, with the dead time in its loop */
  pneu_real position_skew;             /* [s] from a position to its record; below 0 it is the rest that comes late */
  pneu_real force_noise;               /* [N] rounding of the balance of forces; break-away asks for more */
  pneu_real force_resolved;            /* [N] by which a stem that has just stopped must be pushed to go on */
  pneu_real velocity_resolved;         /* [m/s] against its mode at which a stem on bristles turns round; 0: it sticks */
  pneu_real scale[4];                  /* full scale of pressure [Pa], T [K], x [m], v [m/s], for error control */
  int thermal;                         /* gas temperature is a state */
  int bristle;                         /* friction has its own state: the stem turns round and never sticks */
  int n_extra;                         /* states of active effects, and the clock */
  int n_gas;                           /* states before x in the packed vector: p, [T], effects */
  int n_active;
  unsigned char active[PNEU_EFFECT_COUNT + 1];    /* effects not at their neutral value, by stage */
  unsigned char param_of[PNEU_EFFECT_COUNT + 1];  /* first parameter in p.effect */
  unsigned char state_of[PNEU_EFFECT_COUNT + 1];  /* first state in pneu_state.extra */
  unsigned char states_of[PNEU_EFFECT_COUNT + 1]; /* how many an active effect has */
  int supply_line;       /* place in pneu_state.extra of the pressure in the supply's line; -1: it has no volume */
  int n_terms;
  const pneu_term *term; /* free terms, the caller's */
  int clock;             /* place in pneu_state.extra of the time [s], 0 after pneu_state_rest; -1: there is none */
  pneu_real term_step;   /* [s] longest step of pneu_run that does not miss a cycle of a free term; 0: any */
};

/* What can be read off a state, by pneu_observe. */
typedef struct pneu_output {
  pneu_real pressure;          /* [Pa] gauge, in the chamber */
  pneu_real temperature;       /* [K] of the gas */
  pneu_real mass;              /* [kg] of gas in the chamber [B, Eq. 6] */
  pneu_real position;          /* [m] */
  pneu_real velocity;          /* [m/s] */
  pneu_real opening;           /* [1] of the transducer, after its own dynamics */
  pneu_real mass_in;           /* [kg/s] into the chamber */
  pneu_real mass_out;          /* [kg/s] out of it, leaks included */
  pneu_real heat;              /* [W] from the wall into the gas */
  pneu_real supply;            /* [Pa] gauge, at the transducer */
  pneu_real friction;          /* [N] level of dry friction while sliding */
  pneu_real holding_force;     /* [N] that keeps the stem at its velocity, positive against the air */
  int choked;                  /* 1: flow through the transducer is choked; 0: it is not, or the transducer is shut */
  pneu_real shown_pressure;    /* [Pa] gauge, by its sensor */
  pneu_real shown_temperature; /* [K] by its sensor */
  pneu_real shown_position;    /* [m] by its sensor */
} pneu_output;

/* What the sensors show, by pneu_show. */
typedef struct pneu_shown {
  pneu_real pressure;    /* [Pa] gauge */
  pneu_real temperature; /* [K] */
  pneu_real position;    /* [m] */
  pneu_real force;       /* [N] where position is an input: pneu_output.holding_force; else 0 */
} pneu_shown;

typedef struct pneu_options {
  pneu_real tol;   /* local error in units of stroke, full pressure and so on (pneu_scales); 1e-10..1e-2 */
  pneu_real h_max; /* [s] longest step; 0 or less: none */
  int max_steps;   /* per run, > 0 */
} pneu_options;

typedef struct pneu_stats {
  long steps, rejected, events, rhs, jacobians;
} pneu_stats;

/* Scratch of the stepper. Its content need not be set and means nothing between calls, but for h, the step to try
 * first (0 lets the stepper choose), and stats, which are added up: set both to 0 once. */
typedef struct pneu_workspace {
  pneu_real h;
  pneu_real y0[PNEU_STATE_MAX], y1[PNEU_STATE_MAX], f0[PNEU_STATE_MAX];
  pneu_real ft[PNEU_STATE_MAX]; /* slope of f0 in time, where the command runs */
  pneu_real k[PNEU_STATE_MAX][PNEU_STAGE_COUNT];
  pneu_real jac[PNEU_STATE_MAX][PNEU_STATE_MAX];
  pneu_real inverse[PNEU_STATE_MAX][PNEU_STATE_MAX]; /* of I/(h gamma) - J */
  pneu_real dense[PNEU_DENSE_COUNT][PNEU_STATE_MAX]; /* coefficients of the dense output */
  pneu_stats stats;
} pneu_workspace;

/* One accepted step, for dense output: valid only inside the observer's call. */
typedef struct pneu_step_view {
  const pneu_model *model;
  const pneu_input *input; /* at t */
  const pneu_workspace *work;
  const pneu_state *start; /* state at t */
  pneu_real t, h;          /* [s] from the start of the run */
} pneu_step_view;

/* Called after each accepted step and each event; any pointer may be NULL. A result other than 0 stops the run with
 * PNEU_E_STOPPED: the state is then that at the start of the step shown, or that after the event; an edge of a dead band
 * leaves the mode as it was. */
typedef struct pneu_observer {
  int (*step)(void *context, const pneu_step_view *view);
  int (*event)(void *context, pneu_real t, const pneu_state *state, int mode_before);
  void *context;
} pneu_observer;

/* ---- Model ---- */

/* Default parameters: actuator R1-400 of [B, Table A1], every effect neutral.
 * Out: p */
void pneu_params_default(pneu_params *p);

/* Describe parameter i, 0 <= i < PNEU_PARAM_COUNT: the base list, then the effects in order.
 * Out: info, whose strings are constant.  Returns: PNEU_OK, or PNEU_E_PARAM out of range. */
int pneu_param_describe(int i, pneu_param_info *info);

/* Find a parameter by its name, or by that of its effect before it: "area", "leak_area", "chamber_leak.leak_area".
 * Returns: its index, or -1 if there is none. */
int pneu_param_find(const char *name);

/* Where parameter i lies in `p`; the order is that of pneu_param_describe.
 * Returns: a pointer into p, or NULL out of range. */
pneu_real *pneu_param_at(pneu_params *p, int i);

/* The record of effect i, 0 <= i < PNEU_EFFECT_COUNT.  Returns: the record, or NULL out of range. */
const pneu_effect *pneu_effect_at(int i);

/* Find an effect by its name.  Returns: its index, or -1 if there is none. */
int pneu_effect_find(const char *name);

/* The effect that parameter i belongs to.  Returns: its index, or -1 for the base list and out of range. */
int pneu_effect_of(int i);

/* What effect i does to an actuator, with places for its size: "The chamber leaks: {size}, ...". What stands in braces is
 * the user's to fill in; {+more|less} is the first word of a positive size and the second of a negative one.
 * Returns: a constant sentence, or NULL out of range. */
const char *pneu_effect_sentence(int i);

/* Index (as in pneu_param_describe) of the first parameter of effect i, and their number.
 * Returns: the index, or -1 out of range. Out: count (may be NULL) */
int pneu_effect_params(int i, int *count);

/* Check parameters and laws once and precompute what follows from them.
 * In:      p    every value within the bounds of pneu_param_describe; what gives form to an effect that is neutral may
 *               also be 0, so that an initialiser need not name it
 *          law  laws and roles
 * Out:     model
 *          bad  index of the parameter at fault, or -1 (may be NULL)
 * Returns: PNEU_OK; PNEU_E_PARAM for a parameter outside its bounds or not finite; PNEU_E_LAW for an unknown law of gas
 *          or flow. On error `model` must not be used. */
int pneu_model_init(pneu_model *model, const pneu_params *p, const pneu_laws *law, int *bad);

/* Add free terms to an initialised model, in place of those that it has; it has none after pneu_model_init.
 * In:      term  n terms, checked and then used where they lie: they must outlive the model unchanged, and may be in
 *                read-only memory. NULL with n = 0
 *          n     >= 0
 * Out:     model
 * Returns: PNEU_OK; PNEU_E_LAW for an unknown equation or argument; PNEU_E_PARAM for n < 0, for a number that is not
 *          finite, for from >= to, for knots fewer than 2 or more than PNEU_TERM_KNOTS, over a cycle an odd number of
 *          values. On error the model keeps what it has. */
int pneu_model_terms(pneu_model *model, const pneu_term *term, int n);

/* Words for a status and a mode, keys of a gas law and a flow law.
 * Returns: a constant string, "unknown" out of range. */
const char *pneu_status_text(int status);
const char *pneu_mode_text(int mode);
const char *pneu_gas_key(int law);
const char *pneu_flow_key(int law);

/* ---- State and right-hand side ---- */

/* Shut transducer, supply at its nominal pressure, no extra force.  Out: input */
void pneu_input_default(const pneu_model *model, pneu_input *input);

/* A state at rest.
 * In:      pressure     chamber pressure [Pa] gauge, > -ambient_pressure
 *          temperature  of the gas [K], > 0; where it is no state (isothermal law, pressure an input) ambient is taken
 *                       instead; start_temperature adds its excess. Absolute pressure times temperature at most
 *                       1e30 Pa K
 *          position     [m], 0..stroke; a stem beyond a stop that an effect has moved is put onto it, and one
 *                       pressed onto a stop that yields sinks in until it is carried
 * Out:     state        mode chosen from the balance of forces
 * Returns: PNEU_OK, or PNEU_E_NONFINITE outside these ranges: `state` then is as it was. */
int pneu_state_rest(const pneu_model *model, pneu_real pressure, pneu_real temperature, pneu_real position,
                    const pneu_input *input, pneu_state *state);

/* Everything that can be read off a state.
 * Returns: PNEU_OK, or PNEU_RETRY_STATE if the state is not physical: absolute pressure or temperature <= 0, or volume,
 *          unless pressure is an input. `out` is set only with PNEU_OK. */
int pneu_observe(const pneu_model *model, const pneu_state *state, const pneu_input *input, pneu_output *out);

/* What the sensors show of a state: the same as the last three of pneu_observe, and the force on a driven stem; without
 * an evaluation where there is neither an effect of a sensor nor a free term nor a driven stem.  Returns: as
 * pneu_observe; `shown` is set only with PNEU_OK. */
int pneu_show(const pneu_model *model, const pneu_state *state, const pneu_input *input, pneu_shown *shown);

/* Packed vector for an external integrator: p, [T], states of effects, [clock], x, v, in their units of pneu_state. At
 * rest x and v are frozen and left out, so is v of a driven stem.
 * Returns: the number of entries in the state's mode. Out: y, PNEU_STATE_MAX entries at most */
int pneu_pack(const pneu_model *model, const pneu_state *state, pneu_real *y);
void pneu_unpack(const pneu_model *model, const pneu_real *y, pneu_state *state);

/* Number of packed entries in a mode.  In: mode  enum pneu_mode. */
int pneu_dimension(const pneu_model *model, int mode);

/* Full scale of each packed entry of a moving stem, the unit of pneu_options.tol: absolute supply pressure, ambient
 * temperature, 1 for states of effects and the clock, stroke (1 m for a vessel), and the stroke in 10 ms for velocity,
 * whatever the stem.  Out: scale, PNEU_STATE_MAX entries at most */
void pneu_scales(const pneu_model *model, pneu_real *scale);

/* Time derivative of the packed vector in the state's mode: [B, Eqs. 2, 7, 8] and what was added.
 * In:      state  its mode, and x, v where they are frozen
 *          y      packed vector
 * Out:     dydt   as many entries, per second
 * Returns: PNEU_OK, or PNEU_RETRY_STATE where pneu_observe has it: `dydt` then means nothing. */
int pneu_rhs(const pneu_model *model, const pneu_state *state, const pneu_input *input, const pneu_real *y,
             pneu_real *dydt);

/* d(dydt)/dy, row by row; analytic, exact to rounding, where no effect and no free term is active, pressure is no input
 * and proportional_band is 0; else by one-sided differences, exact to about the square root of the machine's accuracy
 * but at kinks.
 * In:      f0   dydt at y
 * Out:     jac  jac[i][j] = d f_i / d y_j, as many rows and columns as pneu_dimension says
 * Returns: PNEU_OK, or PNEU_RETRY_STATE where pneu_rhs has it, at y or at a difference from it. */
int pneu_jacobian(const pneu_model *model, const pneu_state *state, const pneu_input *input, const pneu_real *y,
                  const pneu_real *f0, pneu_real jac[PNEU_STATE_MAX][PNEU_STATE_MAX]);

/* ---- Modes and events: one set for every integrator ---- */

/* Events at once, and the one that is the edge of a positioner's dead band; parts of a pneu_step, those near the end
 * that are coarse, and the last, in which the stem is held; repeats by which the end of one is located; evaluations of
 * the right-hand side in a pneu_step, the Jacobian's differences and looks for events apart. */
enum {
  PNEU_EVENT_MAX = 3,
  PNEU_EVENT_EDGE = PNEU_EVENT_MAX - 1,
  PNEU_PARTS_MAX = 64,
  PNEU_PARTS_COARSE = 28,
  PNEU_PARTS_HELD = 12,
  PNEU_LOCATE_MAX = 8,
  PNEU_STEP_RHS_MAX = PNEU_PARTS_MAX * (2 + (PNEU_STAGE_COUNT - 1) * (1 + PNEU_LOCATE_MAX))
};

/* Event functions of the state's mode: an event happens where g rises through 0.
 * Out:     g  as many as returned, at most PNEU_EVENT_MAX: force above break-away [N] at rest,
 *             velocity [m/s] against the mode's, with bristles beyond what is resolved, and distance beyond the stop
 *             [m] while sliding; PNEU_EVENT_EDGE, where the state has a side, distance beyond the edge of the dead band
 *             [m], and -1 in the place of those before it that the mode has not
 * Returns: their number; without a side 0 driven, for a vessel, and at rest where the state is not physical. */
int pneu_events(const pneu_model *model, const pneu_state *state, const pneu_input *input, const pneu_real *y,
                pneu_real *g);

/* Mode and side after event `which` of pneu_events fired, 0 <= which < its result; sets x and v exactly (v = 0 on a
 * stop: the impact is taken as inelastic).  In/out: state */
void pneu_switch(const pneu_model *model, const pneu_input *input, int which, pneu_state *state);

/* Side of the dead band, and mode that the balance of forces asks for, at the present instant, after an input has
 * jumped. A stem that moves goes on, or, if into a stop that it has reached, is at rest there; a driven one takes the
 * input's rate as v.
 * At rest a state that is not physical (absolute pressure, temperature or volume <= 0) counts as stuck.
 * In/out: state, side, mode and v */
void pneu_settle(const pneu_model *model, const pneu_input *input, pneu_state *state);

/* ---- What comes late ---- */

/* A line for commands on their way to a model with a dead time:
 *
 *   static pneu_late slot[32];
 *   pneu_delay line[1];
 *   pneu_delay_begin(line, slot, 32, 0);
 *   input.delay = line;
 *
 * From then on set input.u as ever: pneu_run and pneu_step put it into the line and let act what is due, to the
 * instant, also within a step; the other functions see the command that acts. A slot is taken by each change of the
 * command until it acts: room for the dead time over the shortest time between changes, and one, is enough; with less,
 * PNEU_E_DELAY. State, line and slots together are a checkpoint. One line belongs to one state; where the model has no
 * dead time it changes nothing.
 * In:      slot   `room` of them, not used by others as long as the line is; NULL with room 0
 *          value  [1] that has been acting
 * Out:     delay */
void pneu_delay_begin(pneu_delay *delay, pneu_late *slot, int room, pneu_real value);

/* The rest is for who integrates himself, or delays another signal.
 *
 * A value is given: from now on (give), where the signal jumps; or it has run there during the last dt on a straight
 * line from the one before (follow, which lets dt pass as well).
 * In:      length  [s] of the delay, >= 0; one that is shorter than the last does not change the order
 *          dt      [s] > 0
 * Returns: PNEU_OK, or PNEU_E_DELAY without room: the value is then not in the line */
int pneu_delay_give(pneu_delay *delay, pneu_real length, pneu_real value);
int pneu_delay_follow(pneu_delay *delay, pneu_real length, pneu_real dt, pneu_real value);

/* Time passes. Jumps wait for their release: those that are due act, with the exactness of an event.  In: dt [s] >= 0
 */
void pneu_delay_pass(pneu_delay *delay, pneu_real dt);
void pneu_delay_release(pneu_delay *delay);

/* Returns: time until the next jump is due [s], at most `left` */
pneu_real pneu_delay_until(const pneu_delay *delay, pneu_real left);

/* Returns: the value that acts `ahead` [s] >= 0 from now, up to the next jump */
pneu_real pneu_delay_value(const pneu_delay *delay, pneu_real ahead);

/* ---- Stepping ---- */

/* Default options: tol 1e-6 (single: 1e-4), no longest step, 100000 steps.  Out: options */
void pneu_options_default(pneu_options *options);

/* Run with constant input and adaptive steps to the end of a stretch of time.
 * Method:  Rodas5P (Steinebach 2023, BIT 63:27): Rosenbrock-Wanner, order 5(4), L-stable, stiffly
 *          accurate; PNEU_ORDER 4: ROS4 (Hairer and Wanner 1996, IV.7), order 4(3), L-stable. Events are located to
 *          1e-9 s (single: 1e-6 s) by repeating the step.
 * In:      input     throughout; where the command jumps or its slope changes, a new run begins
 *          duration  [s] >= 0, finite
 *          options   see pneu_options
 *          observer  may be NULL
 * In/out:  state     at the start, then at the end
 *          work      scratch; statistics are added to work->stats
 * Error:   largest over a fill-and-vent of both actuators of the study in four laws, in double, against CVODE: position
 *          2e-6 of stroke at tol 1e-6, 3e-8 at 1e-8; pressure 2e-4 and 5e-6 of the supply's, in the milliseconds after
 *          the stem has landed, when a dead volume of 2 or 4 cm3 empties and an error of time becomes one of pressure
 *          (tests/lab/run/test_standard.c; measured at 1e-8 in results/agreement.csv: 1.8e-8 and 3.1e-6). Mass and
 *          energy are kept to 6e-8 of what has passed at 1e-8 (results/agreement.csv)
 * Omits:   waves in the line, inertia of the gas
 * Returns: PNEU_OK, or the reason for stopping; `state` is then the last accepted one. PNEU_E_NONFINITE also for a
 *          state or input outside the range that pneu_step documents, a duration or a tolerance outside its own, and
 *          PNEU_E_DELAY for a command that acts late without room in input->delay: nothing is done then. */
int pneu_run(const pneu_model *model, pneu_state *state, const pneu_input *input, pneu_real duration,
             const pneu_options *options, const pneu_observer *observer, pneu_workspace *work);

/* One step of fixed length, for a firmware loop. The work is bounded: one Rosenbrock step as a rule, at
 * most PNEU_PARTS_MAX where modes switch within it, its error is large, or a trial point leaves the chamber without
 * volume, each end on an event located in at most PNEU_LOCATE_MAX repeats: PNEU_STEP_RHS_MAX evaluations in all. A part
 * keeps a local error of 1e-4 of full scale; when they run short, PNEU_PARTS_COARSE of them keep 1e-3, so that a stem
 * that rings is damped. A stem that has used these up too, by bouncing between its stops or on its bristles, is held
 * where it is for what is left of the step; in the last PNEU_PARTS_HELD the gas goes on as in a vessel, to 1e-2.
 * In:      state  made of numbers; p > -ambient_pressure; T > 0 where it is a state; x on or between the stops, to a
 *                 thousandth of the stroke, or, driven, anywhere; volume > 0 unless pressure is an input; a mode of
 *                 enum pneu_mode
 *          input  made of numbers; u in -1..1 unless proportional_band is set, and at the end of dt too where it runs;
 *                 supply_pressure > -ambient_pressure
 *          dt  [s] > 0. How far the parts reach is a matter of how stiff gas, V_0/(A stroke), and bristles are
 * Error:   R1-400 with its 2 cm3 of dead volume, filled and vented from end to end, in four laws, in double: at most
 *          4e-6 of stroke up to 2 ms, 4e-5 up to 50 ms. In single (order 4): 7e-5 up to 1 ms, most of it rounding, 9e-5
 *          up to 50 ms.
 *          Anywhere: random actuators, states and inputs, all laws, up to three effects, steps of 0.1 to 5 ms, each
 *          against 64 small ones (make step-search). Of 5.0 million in double and as many in single 47 and 145 that
 *          said PNEU_OK were off by more than 1e-2 of full scale (pneu_scales), 1 and 26 by more than 1e-1, the worst
 *          by 0.23 and 0.46; without stop_compliance, whose stop a stem may leave late, 36 and 23, the worst by 0.23
 *          and 0.16. One in 920 and one in 260 was PNEU_HELD, 9 and 18 were PNEU_E_STEP_COUNT. In none, held or not,
 *          had more gas passed than the orifices let, or was its pressure beyond what supply, ambient and compression
 *          allow
 * In/out:  state, work
 * Returns: PNEU_OK, and `state` is again in the ranges above, v = 0 on a stop. PNEU_HELD, and it is so too, but the
 *          stem was held and is late: a controller goes on, and does not judge by this step; shorter ones from a copy
 *          of the start follow the stem. PNEU_E_NONFINITE where state, input or dt is outside the ranges, PNEU_E_DELAY as
 *          pneu_run, PNEU_E_SINGULAR, or PNEU_E_STEP_COUNT where the gas alone uses up its parts: `state` and
 *          input->delay then are unchanged, bit for bit. Each command that comes out of its delay within dt makes two
 *          steps of one. */
int pneu_step(const pneu_model *model, pneu_state *state, const pneu_input *input, pneu_real dt, pneu_workspace *work);

/* State inside an accepted step. Order 4: its error falls with the fifth power of the step's length; PNEU_ORDER 4:
 * order 2, with the third power. At the ends it is the step itself.
 * In:      theta  0..1: start to end of the step
 * Out:     state, in the mode of the step */
void pneu_dense(const pneu_step_view *view, pneu_real theta, pneu_state *state);

/* ---- Parts that are useful alone ---- */

/* A mass flow and its slopes. */
typedef struct pneu_flow {
  pneu_real q;        /* [kg/s] from up to down, >= 0 */
  pneu_real dq_dup;   /* [kg/s/Pa] */
  pneu_real dq_ddown; /* [kg/s/Pa] */
  pneu_real dq_dT;    /* [kg/s/K] by upstream temperature */
  int choked;
} pneu_flow;

/* Mass flow through an orifice, in the direction up to down; swap the arguments for the other.
 * In:      law     enum pneu_flow_law
 *          area    effective area C*a [m2], >= 0
 *          p_up    [Pa] abs, > 0;  T_up [K], > 0;  p_down [Pa] abs, 0..p_up
 * Out:     flow
 * Domain:  ideal gas; steady. Within PNEU_BLEND (5e-4) of equal pressures the root is replaced
 *          by an odd polynomial that is linear at zero, with value, slope and curvature
 *          continuous at the edge.
 * Error:   exact to 1e-12 of itself outside the blend (tests; in double); inside it at most 18 % of the flow
 *          at its edge lies between polynomial and root, with subsonic_index 0.2 at most 47 %. Slopes: to
 *          1e-6 of difference quotients.
 * Omits:   vena contracta shift with ratio, upstream kinetic energy, heat, inertia of the gas.
 * Source:  paper: [B, Eq. 8]; choked: Saint-Venant and Wantzel 1839, as in ISO 6358-1 Annex;
 *          iso6358: ISO 6358-1:2013, with C = area * pneu_sonic_conductance(model, 1). */
void pneu_orifice(const pneu_model *model, int law, pneu_real area, pneu_real p_up, pneu_real T_up, pneu_real p_down,
                  pneu_flow *flow);

/* Sonic conductance C [m3/(s Pa), ANR 293.15 K, 100 kPa] of an effective area [m2]: the choked
 * flow of both is the same. */
pneu_real pneu_sonic_conductance(const pneu_model *model, pneu_real area);

/* Chamber volume [m3] at position x [m], 0..stroke, and mass of gas [kg] of a state; [B, Eq. 6]. Exact to rounding. Left
 * out is what effects add: the volume of a connecting_tube, and that by which a wall gives way (chamber_creep). */
pneu_real pneu_volume(const pneu_model *model, pneu_real x);
pneu_real pneu_mass(const pneu_model *model, const pneu_state *state);

/* Chamber pressure at which the forces on a stem at rest balance: those of air, spring and load, and what effects and
 * free terms add to them. Effects with a state have that of pneu_state_rest.
 * In:      x          position [m], 0..stroke
 *          input      supply_pressure and force, as they drive the model
 *          direction  1: dry friction holds the stem as it does before break-away upward; -1: downward; 0: friction is
 *                     left out
 * Returns: [Pa] gauge; below vacuum where no pressure in the chamber does it. NaN where none was found: friction that
 *          grows with pressure by as much as the force of the air.
 * Error:   the rounding of the largest force over the area. */
pneu_real pneu_balance_pressure(const pneu_model *model, pneu_real x, const pneu_input *input, int direction);

/* How far the stem is out of the actuator. Air extends the stem of a normal-acting actuator and retracts that of a
 * reverse-acting one; the model's x follows the air in both.
 * In:      x        position [m], 0..stroke
 *          reverse  not 0 for a reverse-acting actuator
 * Returns: [m], 0..stroke; exact to rounding. */
pneu_real pneu_stem_extension(const pneu_model *model, pneu_real x, int reverse);

/* Opening of an electro-pneumatic transducer that regulates pressure in proportion.
 * In:      set, p  set point and chamber pressure [Pa], same reference
 *          band    [Pa] > 0: error that opens it fully
 * Returns: opening -1..1. */
pneu_real pneu_regulator_opening(pneu_real set, pneu_real p, pneu_real band);

#ifdef __cplusplus
}
#endif

#endif

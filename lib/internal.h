/* What the files of lib/ share and users do not see.
 * SPDX-License-Identifier: MIT */
#ifndef PNEU_INTERNAL_H
#define PNEU_INTERNAL_H

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "pneu.h"

/* What is no number is told by comparisons and by 0 * x, which these options let a compiler leave out. */
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || defined(_M_FP_FAST)
#error "libpneu refuses input that is not finite: compile lib/ without -ffast-math and -ffinite-math-only"
#endif

#ifdef PNEU_SINGLE
#define PNEU_C(literal)        literal##f
#define PNEU_M(function)       function##f
#define PNEU_EPS               PNEU_C(1.1920929e-7)
#define PNEU_EVENT_TIME        PNEU_C(1e-6)
#define PNEU_FORCE_NOISE       PNEU_C(7.6e-6)
#define PNEU_FORCE_RESOLVED    PNEU_C(1e-4)
#define PNEU_VELOCITY_RESOLVED PNEU_C(1e-6)
#define PNEU_ON_STOP           PNEU_C(0.02)
#define PNEU_ON_EDGE           PNEU_C(1e-5)
#else
#define PNEU_C(literal)        literal
#define PNEU_M(function)       function
#define PNEU_EPS               2.220446049250313e-16
#define PNEU_EVENT_TIME        1e-9
#define PNEU_FORCE_NOISE       1.5e-14
#define PNEU_FORCE_RESOLVED    1e-7
#define PNEU_VELOCITY_RESOLVED 1e-10
#define PNEU_ON_STOP           1
#define PNEU_ON_EDGE           1e-6
#endif

/* PNEU_EVENT_TIME [s]: exactness of an event. Shares of the largest force: PNEU_FORCE_NOISE, rounding, which break-away
 * asks for beyond friction; PNEU_FORCE_RESOLVED, below which a stem that has just come to rest stays there, lest it
 * chatter where it stops in equilibrium. PNEU_VELOCITY_RESOLVED, share of full scale at which a stem on bristles turns
 * round: without it, it would do so for ever where it comes to rest. PNEU_ON_STOP, share of stroke over the compliance
 * of a stop that yields which counts as such a force: enough for the rounding of the position; all of it would, in
 * single, hold a stem by 2 kN. PNEU_ON_EDGE, share of stroke by which a stem may be beyond the edge of a dead band that
 * it has met and keep its side. */

/* The record of each effect of the catalogue, in lib/effects/, and its sentence, a symbol of its own that a linker
 * leaves out where nothing asks for it (-fdata-sections and --gc-sections, or -flto). */
#define PNEU_EFFECT(name, n_param, n_state)                                                                            \
  extern const pneu_effect pneu_effect_record_##name;                                                                  \
  extern const char pneu_effect_sentence_##name[];
#include PNEU_EFFECTS_FILE
#undef PNEU_EFFECT

/* Relative distance from equal pressures below which flow is nearly linear in the difference. */
#define PNEU_BLEND PNEU_C(5e-4)

/* Order in which an evaluation adds its terms. */
enum pneu_stage {
  PNEU_STAGE_GEOMETRY,   /* area, volume */
  PNEU_STAGE_POSITIONER, /* opening asked for, from a set position */
  PNEU_STAGE_COMMAND,    /* opening */
  PNEU_STAGE_SPOOL,      /* opening: from the spool to its ports */
  PNEU_STAGE_BOUNDARY,   /* what the orifices see */
  PNEU_STAGE_LINE,       /* between transducer and chamber: takes the transducer's flow, gives the chamber's */
  PNEU_STAGE_FEED,       /* what is drawn from the supply's line */
  PNEU_STAGE_LEAK,       /* flows beside the transducer */
  PNEU_STAGE_HEAT,       /* heat into the gas */
  PNEU_STAGE_WALL,       /* what the heat does to the wall */
  PNEU_STAGE_FORCE,      /* forces and friction level */
  PNEU_STAGE_BRISTLE,    /* friction with a state of its own, from the level */
  PNEU_STAGE_LAG,        /* sensors: what they follow */
  PNEU_STAGE_GAIN,       /* sensors: in what proportion they show it */
  PNEU_STAGE_SENSOR      /* sensors: what they add to it */
};

/* The running sums of one evaluation: first what begins as the base model says, then what begins at 0. */
struct pneu_terms {
  const pneu_model *model;
  const pneu_input *input;
  pneu_real p, T, x, v;                /* p [Pa] abs */
  pneu_real sense;                     /* [1] of motion: 1 up, -1 down, 0 neither */
  pneu_real time;                      /* [s] by the model's clock, 0 without one */
  pneu_real volume, area, swept_area;  /* [m3], [m2] that pressure acts on, [m2] dV/dx */
  pneu_real asked, opening;            /* [1] by the command, before any dynamics of the transducer; [1] */
  pneu_real supply, exhaust;           /* [Pa] abs, behind the orifices */
  pneu_real fill_area, vent_area;      /* [m2] */
  pneu_real force;                     /* [N] sum without friction and viscous terms */
  pneu_real friction;                  /* [N] level of dry friction at the present velocity */
  pneu_real p_shown, T_shown, x_shown; /* [Pa] gauge, [K], [m] by the sensors */

  pneu_real crossing;                 /* [1] opening of the other port of an underlapped spool, signed as `opening` */
  pneu_line supply_line;              /* on the way from the supply, without a volume */
  pneu_line exhaust_line;             /* on the way out */
  pneu_real choked_share;             /* [1] of the flow that follows the nozzle law */
  pneu_real growth;                   /* [m3/s] of the volume, beside what the stem sweeps */
  pneu_real mass_in, mass_out;        /* [kg/s] of the chamber */
  pneu_real drawn;                    /* [kg/s] from the supply */
  pneu_real mass_in_T;                /* [kg K/s] inflow times its temperature */
  pneu_real heat;                     /* [W] from the wall into the gas */
  pneu_real film;                     /* [W/K] its conductance */
  pneu_real bristle_force;            /* [N] */
  pneu_real din_dp, dout_dp, dout_dT; /* slopes of the flows, base model only */
  int side;                           /* enum pneu_side */
  int choked;                         /* flow through the transducer */
  int extent;                         /* enum pneu_extent */
};
typedef struct pneu_terms pneu_terms;

/* How far an evaluation goes; what is left out stays 0. */
enum pneu_extent {
  PNEU_EXTENT_FORCES, /* without flow through the transducer */
  PNEU_EXTENT_FLOWS,
  PNEU_EXTENT_SLOPES /* with the slopes of the flows, for the Jacobian */
};

/* Evaluate the terms at a packed vector.  Out: terms; rate: of the effects' states; NULL: not asked for, and the terms
 * have what the sensors show.
 * Returns: PNEU_OK or PNEU_RETRY_STATE. */
int pneu_evaluate(const pneu_model *model, const pneu_state *state, const pneu_input *input, const pneu_real *y,
                  int extent, pneu_terms *terms, pneu_real *rate);

/* The same of what the sensors show alone, at a state that is physical, where no free term stands before it. */
void pneu_evaluate_sensors(const pneu_model *model, const pneu_state *state, const pneu_input *input,
                           const pneu_real *y, pneu_terms *terms);

/* Rates of the packed vector but for the effects' states, from the sums. */
void pneu_rates(const pneu_terms *terms, int mode, pneu_real *dydt);

/* Whether these effects are compiled in: constants to a compiler that optimises, which leaves out what is for them. */
static inline int pneu_has_dead_time(void)
{
  return 0
#define PNEU_EFFECT(name, n_param, n_state) || strcmp(#name, "dead_time") == 0
#include PNEU_EFFECTS_FILE
#undef PNEU_EFFECT
      ;
}

static inline int pneu_has_positioner(void)
{
  return 0
#define PNEU_EFFECT(name, n_param, n_state) || strcmp(#name, "positioner") == 0
#include PNEU_EFFECTS_FILE
#undef PNEU_EFFECT
      ;
}

/* Commands on their way; NULL if there are none. */
static inline pneu_delay *pneu_commands(const pneu_input *input)
{
  return pneu_has_dead_time() ? input->delay : NULL;
}

/* Error of a positioner's loop [1] of the stroke, with the stem at x [m]. */
static inline pneu_real pneu_loop_error(const pneu_model *model, pneu_real set, pneu_real x)
{
  return set - (x * (1 + model->feedback_span) + model->feedback_zero) / model->p.stroke;
}

/* Whether the command is the set position of a positioner, which has prepared its dead band: a dead time then lies in
 * its loop, and not before the model. */
static inline int pneu_is_in_loop(const pneu_model *model, const pneu_input *input)
{
  return pneu_has_positioner() && model->band_edge > 0 && input->set_position;
}

/* Whether pressure, temperature and volume of a state are above zero. */
int pneu_is_physical(const pneu_model *model, const pneu_state *state);

/* Flow through the open orifice of the transducer into or out of pressure t->p, added to the sums. */
void pneu_transducer_flow(pneu_terms *terms);

/* The same where it faces pressure p [Pa] abs and air at temperature T [K] in place of the chamber's: the sums, and
 * nothing else, are its own. */
void pneu_transducer_at(pneu_terms *terms, pneu_real p, pneu_real T);

/* Ambient air that comes into the chamber [kg/s]; below 0 it leaves it. None where pressure is an input. */
void pneu_let_in(pneu_terms *terms, pneu_real q);

/* Flow between the chamber and a reservoir, either way, added to the sums.
 * In/out:  line  between orifice and reservoir; NULL: none
 * Returns: whether it is choked. */
int pneu_exchange(pneu_terms *terms, pneu_real area, pneu_real p_other, pneu_real T_other, pneu_line *line);

/* Flow [kg/s] from one volume to another through a line, either way (flow.c).
 * In:      resistance  [Pa s/kg] at the full flow of the fill orifice; counts as 1e4 at least: with less both pressures
 *                      are one to rounding, and the equations stiff for nothing
 *          turbulence  [1] share of it that grows with the flow
 *          p, T        [Pa] abs, [K] of either volume
 * Out:     slope       in the pressure upstream [kg/(s Pa)]
 * Returns: above 0 from `from` to `to` */
pneu_real pneu_line_pass(const pneu_terms *terms, pneu_real resistance, pneu_real turbulence, pneu_real p_from,
                         pneu_real T_from, pneu_real p_to, pneu_real T_to, pneu_real *slope);

/* States of the active effects at rest.  In/out: state */
void pneu_start_effects(const pneu_model *model, const pneu_input *input, pneu_state *state);

/* Whether a lag is long enough to be one, a nanosecond: over a shorter one, the rounding of what it follows is a rate
 * that no step holds.  In: param  [s] its time constant */
int pneu_lag_acts(const pneu_model *model, const pneu_real *param);

/* Let the active effects of all stages up to `stage` add their terms, from *next on; those without terms have changed
 * the model's constants by `prepare`.  Out: rate, of their states (may be NULL) */
void pneu_add_effects(pneu_terms *terms, const pneu_real *y, int stage, int *next, pneu_real *rate);

/* Terms of the nozzle's flow function, for its heat and critical ratio.  In/out: model */
void pneu_nozzle_prepare(pneu_model *model);

/* Add the free terms on the equations first..last (enum pneu_term_equation) to the sums. */
void pneu_add_terms(pneu_terms *terms, int first, int last);

/* Inverse of the leading n x n block of a, in place.  Returns: PNEU_OK or PNEU_E_SINGULAR. */
int pneu_invert(int n, pneu_real a[PNEU_STATE_MAX][PNEU_STATE_MAX]);

/* Right-hand side and Jacobian at work->y0, for all tries from there. */
int pneu_step_prepare(const pneu_model *model, const pneu_state *state, const pneu_input *input, pneu_workspace *work);

/* One Rosenbrock step from work->y0 to work->y1.  Out: error, in units of full scale.
 * Returns: PNEU_OK, PNEU_RETRY_STATE, PNEU_E_SINGULAR. */
int pneu_step_try(const pneu_model *model, const pneu_state *state, const pneu_input *input, pneu_real h,
                  pneu_workspace *work, pneu_real *error);

/* Coefficients of the dense output of the last step, for pneu_dense_packed. */
void pneu_dense_prepare(int n, pneu_workspace *work);

/* The same for a step of length h in a mode of the stem. */
void pneu_dense_step(const pneu_model *model, int mode, pneu_real h, pneu_workspace *work);

/* Packed vector inside the last step. */
void pneu_dense_packed(const pneu_workspace *work, int n, pneu_real theta, pneu_real *y);

/* If an event lies inside the step just tried (length h), shorten the step so that it ends there.
 * In/out: h
 * Out:     which  -1 if none
 *          error  of the repeated step, 1e30 where there is no event after all; as it was without an event
 * Returns: PNEU_OK or the status of a repeated step. */
int pneu_locate(const pneu_model *model, const pneu_state *state, const pneu_input *input, pneu_workspace *work,
                pneu_real *h, int *which, pneu_real *error);

#endif

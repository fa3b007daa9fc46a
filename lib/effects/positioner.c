/* A positioner in the loop: the command is a set position, and the opening follows from how far the stem is off it.
 *
 *   e = s - (x (1 + span) + zero)/stroke,   u = clip(gain (e + I + T_d e'), -1, 1),   I' = e/T_i,
 *
 * s the set position in shares of the stroke, which is pneu_input.u; span, zero and a wider dead band are effects of
 * their own. u is 0 while |e| is within the dead band, -1 below cutoff_low and 1 above cutoff_high. What is 0 is not
 * there. e' has the slope of a set position that ramps; one that jumps gives it no kick.
 * The state is I. It begins at integral_start, for a loop has worked before its record, and stands still within the
 * dead band, beyond the cut-offs and while u is clipped, lest it wind up. Without pneu_input.set_position the command
 * is u itself, and I stands still. The rate of I where u is clipped follows a straight line over CLIPPED of the
 * opening. u jumps at the edge of the dead band, an event that ends a step (pneu_state.side): a stem that a leak pushes
 * out of the band stops by its friction where it is, and air is let in until p has risen by the friction band, 2 F/A;
 * then the cycle begins again. An opening that rises over 0.01 % of the stroke would hold the stem there, and p would
 * be off by up to that. Along a ramp of the set position u does rise, over usual_edge of the stroke: the stem would go
 * in and out of the band ninety times a second, which takes 15 times the steps for at most 1 um of 38 mm of travel.
 * Without friction it does so everywhere. A short stroke goes in and out all the same: 10 mm at 0.3 mm/s sixty times a
 * second by 4 um, up to an edge of 3e-4 of it (pneu_model.band_edge, then about the band's own), with which the stem is
 * where it is in the mean to 0.01 um.
 *
 * Size: gain 10 to 50, dead band 0.1 to 1 %, cut-offs 0.5 and 99 to 99.5 %. */
#include "../internal.h"

#define CLIPPED  PNEU_C(1e-3)
#define ROUNDING PNEU_C(1e-6) /* of the stroke: by so much a set position that has come along a ramp may be off */

enum { GAIN, INTEGRAL_TIME, DERIVATIVE_TIME, DEAD_BAND, CUTOFF_LOW, CUTOFF_HIGH, INTEGRAL_START };

static const pneu_param_info params[] = {
    {"gain", "1", 0, PNEU_C(1e4), 20, 0, 0, "opening over error in shares of the stroke; 0: there is no positioner"},
    {"integral_time", "s", 0, PNEU_C(1e6), 0, 0, 1, "time in which the integral of an error adds as much; 0: none"},
    {"derivative_time", "s", 0, PNEU_C(100.0), 0, 0, 1, "time by which the error is foreseen"},
    {"dead_band", "1", 0, PNEU_C(0.5), 0, 0, 1,
     "error, in shares of the stroke, either way, up to which both orifices are shut"},
    {"cutoff_low", "1", 0, 1, 0, 0, 1, "set position, share of the stroke, below which it vents fully; 0: none"},
    {"cutoff_high", "1", 0, PNEU_C(2.0), 0, 0, 1,
     "set position, share of the stroke, above which it fills fully; 0: none"},
    {"integral_start", "1", -1, 1, 0, 0, 1,
     "integral of the error, in shares of the stroke, where a state of rest begins"}};

/* Of the stroke: a constant in memory, for x87 compares a literal to more digits than a model holds. */
static const pneu_real usual_edge = PNEU_C(3e-5);

static pneu_real clip(pneu_real value, pneu_real low, pneu_real high)
{
  return value < low ? low : value > high ? high : value;
}

/* Share of the opening that the dead band lets through. */
static pneu_real outside(const pneu_terms *t, pneu_real error)
{
  const pneu_real beyond = PNEU_M(fabs)(error) - t->model->dead_band, edge = t->model->band_edge;
  if (!(t->model->dead_band > 0))
    return 1;
  if (t->side != PNEU_SIDE_UNTOLD)
    return t->side != PNEU_SIDE_WITHIN;
  return t->input->u_rate != 0 ? clip((edge > usual_edge ? PNEU_C(0.5) : 0) + beyond / edge, 0, 1) : beyond > 0;
}

static void add(const pneu_real *param, const pneu_real *state, pneu_terms *t, pneu_real *rate)
{
  const pneu_real set = t->asked, error = pneu_loop_error(t->model, set, t->x);
  const pneu_real error_rate = t->input->u_rate - t->v * (1 + t->model->feedback_span) / t->model->p.stroke;
  const pneu_real u = param[GAIN] * (error + state[0] + param[DERIVATIVE_TIME] * error_rate);
  const pneu_real passes = outside(t, error);
  rate[0] = 0;
  if (!t->input->set_position || t->model->law.pressure_input)
    return;
  if (param[CUTOFF_LOW] > 0 && set < param[CUTOFF_LOW] - ROUNDING)
    t->asked = -1;
  else if (param[CUTOFF_HIGH] > 0 && set > param[CUTOFF_HIGH] + ROUNDING)
    t->asked = 1;
  else {
    t->asked = clip(u, -1, 1) * passes;
    if (param[INTEGRAL_TIME] > 0)
      rate[0] = error / param[INTEGRAL_TIME] * passes * clip((1 - PNEU_M(fabs)(u)) / CLIPPED, 0, 1);
  }
  t->opening = t->asked;
}

/* Without an integral there is none at the start. */
static void start(const pneu_real *param, const pneu_terms *t, pneu_real *state)
{
  (void)t;
  state[0] = param[INTEGRAL_TIME] > 0 ? param[INTEGRAL_START] : 0;
}

static void prepare(pneu_model *model, const pneu_real *param)
{
  model->band_edge = usual_edge;
  model->dead_band += param[DEAD_BAND];
}

/* A vessel has no position; a set pressure is no set position. */
static int acts(const pneu_model *model, const pneu_real *param)
{
  return param[GAIN] > 0 && model->p.stroke > 0 && !(model->p.proportional_band > 0);
}

const pneu_effect pneu_effect_record_positioner = {
    "positioner",
    "A positioner opens the transducer by how far the stem is off its set position.",
    "PID action as in IEC 60050-351; dead band and tight shut-off as in IEC 61514",
    "command",
    "declared, never looked for: without it a set position says nothing",
    PNEU_STAGE_POSITIONER,
    params,
    .add = add,
    .start = start,
    .acts = acts,
    .prepare = prepare};

const char pneu_effect_sentence_positioner[] =
    "A positioner opens the transducer by {size} of itself for each share of the stroke that the stem is off.";

/* A positioner that watches its actuator. At 1 kHz it steps the model of the healthy actuator with the command that it
 * gives; wherever a measurement is stored, it compares, and raises the alarm when pressure stays below what the model
 * says. The commands and measurements are those of two rigs, one of which leaks. */
#include "board.h"
#include "pneu.h"
#include "rig_logs.h"

/* Cumulative sum (Page 1954) of the shortfall of pressure in units of the sensor's noise. */
#define NOISE     ((pneu_real)320.0) /* [Pa] */
#define ALLOWANCE ((pneu_real)3.0)   /* shortfall that is still healthy: the model is not the actuator */
#define THRESHOLD ((pneu_real)60.0)

enum { PRINT_EVERY = 8 };

static pneu_model model;
static pneu_workspace work;

static int prepare(const rig_log *log)
{
  pneu_params p;
  pneu_laws law = {PNEU_GAS_ISOTHERMAL, 0, 0, 0};
  law.flow = log->flow;
  pneu_params_default(&p);
  p.dead_volume = (pneu_real)40e-6;
  p.spring_rate = log->spring_rate;
  p.spring_preload = log->spring_preload;
  p.dry_friction = log->dry_friction;
  p.damping = log->viscous - p.viscous_friction;
  p.fill_area = p.vent_area = log->orifice;
  return pneu_model_init(&model, &p, &law, 0);
}

static void show(const rig_log *log, const rig_row *row, const pneu_state *state, pneu_real score)
{
  board_text(log->name);
  board_text(" ");
  board_number(row->t);
  board_text(" ");
  board_number((long)state->p);
  board_text(" ");
  board_number((long)(state->x * 1000000));
  board_text(" ");
  board_number((long)score);
  board_text("\n");
}

/* Follow one log.  Out: alarm  time [ms], -1 if none.  Returns: status */
static int watch(const rig_log *log, long *alarm)
{
  pneu_input input;
  pneu_state state;
  pneu_real score = 0;
  long t;
  int i, status = prepare(log);
  *alarm = -1;
  if (status != PNEU_OK)
    return status;
  pneu_input_default(&model, &input);
  status = pneu_state_rest(&model, 0, (pneu_real)298.15, 0, &input, &state);
  for (i = 0; i + 1 < log->n && status == PNEU_OK; i++) {
    const rig_row *row = &log->row[i];
    const pneu_real measured = (pneu_real)row->p * 20;
    score += (state.p - measured) / NOISE - ALLOWANCE;
    if (score < 0)
      score = 0;
    if (score > THRESHOLD && *alarm < 0)
      *alarm = row->t;
    if (i % PRINT_EVERY == 0)
      show(log, row, &state, score);
    input.u = row->u;
    for (t = row->t; t < row[1].t && status == PNEU_OK; t++)
      status = pneu_step(&model, &state, &input, (pneu_real)1e-3, &work);
  }
  return status;
}

static int tell(const rig_log *log, int want_alarm)
{
  long alarm;
  const int status = watch(log, &alarm);
  board_text(log->name);
  if (status != PNEU_OK) {
    board_text(": ");
    board_text(pneu_status_text(status));
  } else if (alarm < 0)
    board_text(": no alarm");
  else {
    board_text(": leak alarm ");
    board_number(alarm);
  }
  board_text("\n");
  return status != PNEU_OK || (alarm >= 0) != want_alarm;
}

int main(void)
{
  const int wrong = tell(&rig_log_healthy, 0) + tell(&rig_log_leak, 1);
  return wrong != 0;
}

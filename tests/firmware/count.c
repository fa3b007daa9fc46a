/* What a step costs: bytes of the types, and instructions and stack of pneu_step over a fill and a vent of the R1-400
 * with 40 cm3 of dead volume, at 1 kHz. */
#include "board.h"
#include "pneu.h"

enum { FILL = 1500, VENT = 1500 }; /* [ms] */

typedef struct variant {
  const char *name;
  pneu_laws law;
  int effects; /* so many effects of the catalogue are active, from the first */
} variant;

static const variant variants[] = {
    {"isothermal/paper", {PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 0, 0}, 0},
    {"isothermal/iso6358", {PNEU_GAS_ISOTHERMAL, PNEU_FLOW_ISO6358, 0, 0}, 0},
    {"isothermal/choked", {PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED, 0, 0}, 0},
    {"energy/choked", {PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED, 0, 0}, 0},
    {"isothermal/iso6358 and two effects", {PNEU_GAS_ISOTHERMAL, PNEU_FLOW_ISO6358, 0, 0}, 2},
};

static pneu_model model;
static pneu_workspace work;

static void say(const char *name, long value)
{
  board_text(" ");
  board_text(name);
  board_text(" ");
  board_number(value);
}

/* Switch on the first effects, at the size that they start from. */
static void add_effects(pneu_params *p, int n)
{
  int e, i, first, count;
  for (e = 0; e < n; e++) {
    first = pneu_effect_params(e, &count);
    for (i = first; i < first + count; i++) {
      pneu_param_info info;
      pneu_param_describe(i, &info);
      *pneu_param_at(p, i) = info.value;
    }
  }
}

static int run(const variant *v)
{
  pneu_params p;
  pneu_input input;
  pneu_state state;
  long sum = 0, worst = 0;
  int i, status;
  pneu_params_default(&p);
  p.dead_volume = (pneu_real)40e-6;
  add_effects(&p, v->effects);
  status = pneu_model_init(&model, &p, &v->law, 0);
  if (status != PNEU_OK)
    return status;
  pneu_input_default(&model, &input);
  status = pneu_state_rest(&model, 0, (pneu_real)298.15, 0, &input, &state);
  board_paint_stack();
  for (i = 0; i < FILL + VENT && status == PNEU_OK; i++) {
    unsigned long from, to;
    long n;
    input.u = i < FILL ? 1 : -1;
    from = board_ticks();
    status = pneu_step(&model, &state, &input, (pneu_real)1e-3, &work);
    to = board_ticks();
    n = board_instructions(from, to);
    sum += n;
    if (n > worst)
      worst = n;
  }
  board_text(v->name);
  board_text(",");
  board_number(sum / (FILL + VENT));
  board_text(",");
  board_number(worst);
  board_text(",");
  board_number(board_stack_used());
  board_text("\n");
  return status;
}

int main(void)
{
  int i, wrong = 0;
  board_text("bytes");
  say("model", (long)sizeof model);
  say("state", (long)sizeof(pneu_state));
  say("workspace", (long)sizeof work);
  board_text("\n");
  for (i = 0; i < (int)(sizeof variants / sizeof *variants); i++)
    if (variants[i].effects <= PNEU_EFFECT_COUNT)
      wrong |= run(&variants[i]);
  return wrong;
}

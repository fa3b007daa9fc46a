#include "linearflow.h"

#include <math.h>

static void held_below(const pneu_model *model, double critical, double area, double p_up, double p_down,
                       pneu_flow *flow)
{
  const double k = area * model->paper_gain / sqrt(model->p.ambient_temperature), r = p_down / p_up;
  flow->choked = r <= critical;
  flow->q = k * p_up * (1 - (flow->choked ? critical : r));
  flow->dq_dup = flow->choked ? k * (1 - critical) : k;
  flow->dq_ddown = flow->choked ? 0 : -k;
  flow->dq_dT = 0;
}

static void linear(const pneu_model *model, double area, double p_up, double T_up, double p_down, pneu_flow *flow)
{
  (void)T_up;
  held_below(model, -1, area, p_up, p_down, flow);
}

static void linear_choked(const pneu_model *model, double area, double p_up, double T_up, double p_down,
                          pneu_flow *flow)
{
  (void)T_up;
  held_below(model, model->critical_ratio, area, p_up, p_down, flow);
}

int linear_model_init(pneu_model *model, const pneu_params *p, const pneu_laws *laws, int *bad)
{
  const int is_linear = laws->flow == LINEAR_FLOW || laws->flow == LINEAR_CHOKED_FLOW;
  pneu_laws known = *laws;
  int status;
  if (is_linear)
    known.flow = PNEU_FLOW_PAPER;
  status = pneu_model_init(model, p, &known, bad);
  if (is_linear)
    model->own_flow = laws->flow == LINEAR_FLOW ? linear : linear_choked;
  return status;
}

/* Free terms: check them, and add them to the sums of an evaluation. */
#include "internal.h"

static int bad_numbers(const pneu_term *term)
{
  pneu_real zero = 0 * (term->to - term->from);
  int i;
  for (i = 1; i < term->n; i++)
    zero += 0 * (term->value[i] - term->value[i - 1]);
  return !(zero == 0 && term->from < term->to);
}

static int check(const pneu_term *term)
{
  if (term->equation < 0 || term->equation >= PNEU_TERM_EQUATION_COUNT || term->argument < 0 ||
      term->argument >= PNEU_TERM_ARGUMENT_COUNT)
    return PNEU_E_LAW;
  if (term->n < 2 || term->n > PNEU_TERM_KNOTS || bad_numbers(term))
    return PNEU_E_PARAM;
  return PNEU_OK;
}

int pneu_model_terms(pneu_model *model, const pneu_term *term, int n)
{
  int i;
  if (n < 0)
    return PNEU_E_PARAM;
  for (i = 0; i < n; i++) {
    const int status = check(&term[i]);
    if (status != PNEU_OK)
      return status;
  }
  model->term = term;
  model->n_terms = n;
  return PNEU_OK;
}

static pneu_real value_at(const pneu_term *term, pneu_real argument)
{
  const int last = term->n - 1;
  const pneu_real place = (argument - term->from) / (term->to - term->from) * (pneu_real)last;
  const pneu_real *value = term->value;
  int i;
  if (!(place > 0))
    return value[0];
  if (place >= (pneu_real)last)
    return value[last];
  i = (int)place;
  return value[i] + (place - (pneu_real)i) * (value[i + 1] - value[i]);
}

static void add_flow(pneu_terms *t, pneu_real q)
{
  if (t->model->law.pressure_input)
    return;
  if (q > 0) {
    t->mass_in += q;
    t->mass_in_T += q * t->model->p.ambient_temperature;
  } else
    t->mass_out -= q;
}

void pneu_add_terms(pneu_terms *t, int first, int last)
{
  const pneu_model *model = t->model;
  const pneu_real argument[PNEU_TERM_ARGUMENT_COUNT] = {t->x, t->v, t->p - model->p.ambient_pressure, t->opening};
  pneu_real sum[PNEU_TERM_EQUATION_COUNT] = {0};
  int i;
  for (i = 0; i < model->n_terms; i++) {
    const pneu_term *term = &model->term[i];
    if (term->equation >= first && term->equation <= last)
      sum[term->equation] += value_at(term, argument[term->argument]);
  }
  t->force -= sum[PNEU_TERM_FORCE];
  t->friction = PNEU_M(fmax)(t->friction + sum[PNEU_TERM_FRICTION], 0);
  add_flow(t, sum[PNEU_TERM_FLOW]);
  if (model->thermal && model->law.gas != PNEU_GAS_POLYTROPIC)
    t->heat += sum[PNEU_TERM_HEAT];
  t->p_shown += sum[PNEU_TERM_SHOWN_PRESSURE];
  t->x_shown += sum[PNEU_TERM_SHOWN_POSITION];
}

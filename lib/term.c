/* Free terms: check them, and add them to the sums of an evaluation. */
#include "internal.h"

enum { STEPS_PER_CYCLE = 8 };

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
  return term->argument == PNEU_TERM_OVER_CYCLE && term->n % 2 ? PNEU_E_PARAM : PNEU_OK;
}

/* Give the model a clock if a term runs over cycles, and take it away if none does. */
static void set_clock(pneu_model *model)
{
  const int had = model->clock >= 0, states = model->n_extra - had;
  pneu_real step = 0;
  int i;
  for (i = 0; i < model->n_terms; i++) {
    const pneu_term *term = &model->term[i];
    const pneu_real shortest = 2 * (term->to - term->from) / (pneu_real)term->n;
    if (term->argument == PNEU_TERM_OVER_CYCLE)
      step = step > 0 ? PNEU_M(fmin)(step, shortest / STEPS_PER_CYCLE) : shortest / STEPS_PER_CYCLE;
  }
  model->term_step = step;
  model->clock = step > 0 ? states : -1;
  model->n_extra = states + (step > 0);
  model->n_gas += (step > 0) - had;
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
  set_clock(model);
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

/* Fourier series; each angle from the one before by the sum formulae. */
static pneu_real series_at(const pneu_term *term, pneu_real time)
{
  const pneu_real angle = PNEU_C(6.283185307179586) * time / (term->to - term->from);
  const pneu_real c1 = PNEU_M(cos)(angle), s1 = PNEU_M(sin)(angle);
  pneu_real c = c1, s = s1, sum = 0;
  int i;
  for (i = 0; i + 1 < term->n; i += 2) {
    const pneu_real c_next = c * c1 - s * s1;
    sum += term->value[i] * c + term->value[i + 1] * s;
    s = s * c1 + c * s1;
    c = c_next;
  }
  return sum;
}

static void add_supply(pneu_terms *t, pneu_real difference)
{
  const pneu_real least = PNEU_C(1e-3) * t->model->p.ambient_pressure;
  if (difference != 0)
    t->supply = PNEU_M(fmax)(t->supply + difference, least);
}

/* Add to its equation what the terms on it come to. */
static void add_sum(pneu_terms *t, int equation, pneu_real sum)
{
  switch (equation) {
  case PNEU_TERM_SUPPLY:
    add_supply(t, sum);
    break;
  case PNEU_TERM_FORCE:
    t->force -= sum;
    break;
  case PNEU_TERM_FRICTION:
    t->friction = PNEU_M(fmax)(t->friction + sum, 0);
    break;
  case PNEU_TERM_FLOW:
    pneu_let_in(t, sum);
    break;
  case PNEU_TERM_HEAT:
    if (t->model->thermal && t->model->law.gas != PNEU_GAS_POLYTROPIC)
      t->heat += sum;
    break;
  case PNEU_TERM_SHOWN_PRESSURE:
    t->p_shown += sum;
    break;
  default:
    t->x_shown += sum;
  }
}

void pneu_add_terms(pneu_terms *t, int first, int last)
{
  const pneu_model *model = t->model;
  const pneu_real argument[PNEU_TERM_ARGUMENT_COUNT] = {t->x, t->v, t->p - model->p.ambient_pressure, t->opening,
                                                        t->time};
  pneu_real sum[PNEU_TERM_EQUATION_COUNT] = {0};
  int i;
  for (i = 0; i < model->n_terms; i++) {
    const pneu_term *term = &model->term[i];
    if (term->equation >= first && term->equation <= last)
      sum[term->equation] +=
          term->argument == PNEU_TERM_OVER_CYCLE ? series_at(term, t->time) : value_at(term, argument[term->argument]);
  }
  for (i = first; i <= last; i++)
    add_sum(t, i, sum[i]);
}

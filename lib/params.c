/* The parameter list: description, access, defaults. */
#include <string.h>

#include "internal.h"

static const pneu_effect *const records[PNEU_EFFECT_COUNT + 1] = {
#define PNEU_EFFECT(name, n_param, n_state) &pneu_effect_record_##name,
#include PNEU_EFFECTS_FILE
#undef PNEU_EFFECT
    NULL};

static const unsigned char param_counts[PNEU_EFFECT_COUNT + 1] = {
#define PNEU_EFFECT(name, n_param, n_state) n_param,
#include PNEU_EFFECTS_FILE
#undef PNEU_EFFECT
    0};

static const pneu_param_info base[PNEU_PARAM_BASE_COUNT] = {
#define X(name, unit, lo, hi, dflt, text)                                                                              \
  {#name, unit, (pneu_real)(lo), (pneu_real)(hi), (pneu_real)(dflt), (pneu_real)(dflt), 0, text},
    PNEU_PARAM_LIST(X)
#undef X
};

static const unsigned short base_offset[PNEU_PARAM_BASE_COUNT] = {
#define X(name, unit, lo, hi, dflt, text) (unsigned short)offsetof(pneu_params, name),
    PNEU_PARAM_LIST(X)
#undef X
};

const pneu_effect *pneu_effect_at(int i)
{
  return i >= 0 && i < PNEU_EFFECT_COUNT ? records[i] : NULL;
}

int pneu_effect_params(int i, int *count)
{
  int e, first = PNEU_PARAM_BASE_COUNT;
  if (i < 0 || i >= PNEU_EFFECT_COUNT)
    return -1;
  if (count)
    *count = param_counts[i];
  for (e = 0; e < i; e++)
    first += param_counts[e];
  return first;
}

int pneu_effect_of(int i)
{
  int e, k = i - PNEU_PARAM_BASE_COUNT;
  if (k < 0 || i >= PNEU_PARAM_COUNT)
    return -1;
  for (e = 0; k >= param_counts[e]; e++)
    k -= param_counts[e];
  return e;
}

int pneu_param_describe(int i, pneu_param_info *info)
{
  const int e = pneu_effect_of(i);
  if (i < 0 || i >= PNEU_PARAM_COUNT)
    return PNEU_E_PARAM;
  *info = e < 0 ? base[i] : records[e]->param[i - pneu_effect_params(e, NULL)];
  return PNEU_OK;
}

pneu_real *pneu_param_at(pneu_params *p, int i)
{
  if (i < 0 || i >= PNEU_PARAM_COUNT)
    return NULL;
  if (i >= PNEU_PARAM_BASE_COUNT)
    return &p->effect[i - PNEU_PARAM_BASE_COUNT];
  return (pneu_real *)(void *)((char *)p + base_offset[i]);
}

void pneu_params_default(pneu_params *p)
{
  int i;
  memset(p, 0, sizeof *p);
  for (i = 0; i < PNEU_PARAM_COUNT; i++) {
    pneu_param_info info;
    pneu_param_describe(i, &info);
    *pneu_param_at(p, i) = info.neutral;
  }
}

/* Parameters and effects by their names. */
#include "internal.h"

int pneu_effect_find(const char *name)
{
  int e;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++)
    if (strcmp(pneu_effect_at(e)->name, name) == 0)
      return e;
  return -1;
}

int pneu_param_find(const char *name)
{
  const char *dot = strchr(name, '.'), *own = dot ? dot + 1 : name;
  pneu_param_info info;
  int i;
  for (i = 0; i < PNEU_PARAM_COUNT; i++) {
    const pneu_effect *effect = pneu_effect_at(pneu_effect_of(i));
    pneu_param_describe(i, &info);
    if (strcmp(info.name, own) == 0 && (!dot || (effect && strlen(effect->name) == (size_t)(dot - name) &&
                                                 strncmp(effect->name, name, (size_t)(dot - name)) == 0)))
      return i;
  }
  return -1;
}

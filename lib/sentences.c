/* The sentences of the catalogue, apart from its records: firmware does without them. */
#include "internal.h"

const char *pneu_effect_sentence(int i)
{
  static const char *const sentences[PNEU_EFFECT_COUNT + 1] = {
#define PNEU_EFFECT(name, n_param, n_state) pneu_effect_sentence_##name,
#include PNEU_EFFECTS_FILE
#undef PNEU_EFFECT
      NULL};
  return i >= 0 && i < PNEU_EFFECT_COUNT ? sentences[i] : NULL;
}

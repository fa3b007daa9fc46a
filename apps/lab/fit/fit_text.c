/* A fit in words. */
#include "fit.h"

const char *lab_fit_state_text(int state)
{
  static const char *const text[] = {"free", "at its lower bound", "at its upper bound", "undetermined"};
  return state >= 0 && state < 4 ? text[state] : "unknown";
}

/* Words for codes, expanded from the lists in pneu.h. */
#include "internal.h"

#define COUNT(table) ((int)(sizeof(table) / sizeof *(table)))

const char *pneu_status_text(int status)
{
  switch (status) {
#define X(name, code, text)                                                                                            \
  case name:                                                                                                           \
    return text;
    PNEU_STATUS_LIST(X)
#undef X
  default:
    return "unknown";
  }
}

static const char *pick(const char *const *table, int count, int i)
{
  return i >= 0 && i < count ? table[i] : "unknown";
}

#define X(name, key, text) key,
const char *pneu_mode_text(int mode)
{
  static const char *const table[] = {PNEU_MODE_LIST(X)};
  return pick(table, COUNT(table), mode);
}

const char *pneu_gas_key(int law)
{
  static const char *const table[] = {PNEU_GAS_LIST(X)};
  return pick(table, COUNT(table), law);
}

const char *pneu_flow_key(int law)
{
  static const char *const table[] = {PNEU_FLOW_LIST(X)};
  return pick(table, COUNT(table), law);
}
#undef X

#include <string.h>

#include "stats.h"
#include "summary.h"

static int is(const char *text, const char *word)
{
  return strcmp(text, word) == 0;
}

static int pressure_and_position(const blind_record *r)
{
  return strncmp(r->channels, "px", 2) == 0;
}

static int above_twice(const blind_record *r)
{
  return r->ratio >= 2;
}

/* ---- Which trials count ---- */

static int single(const blind_record *r)
{
  return is(r->kind, "single") && pressure_and_position(r) && above_twice(r);
}

static int single_any_size(const blind_record *r)
{
  return is(r->kind, "single") && pressure_and_position(r);
}

static int pair(const blind_record *r)
{
  return is(r->kind, "pair") && pressure_and_position(r) && above_twice(r);
}

static int one_or_two(const blind_record *r)
{
  return single(r) || pair(r);
}

static int nothing(const blind_record *r)
{
  return is(r->kind, "nothing");
}

static int unlisted(const blind_record *r)
{
  return is(r->kind, "unlisted") && pressure_and_position(r) && above_twice(r);
}

static int position_only(const blind_record *r)
{
  return is(r->channels, "x") && !nothing(r) && above_twice(r);
}

static int pressure_only(const blind_record *r)
{
  return is(r->channels, "p") && !nothing(r) && above_twice(r);
}

/* ---- What is a hit ---- */

static int detected(const blind_record *r)
{
  return r->detected;
}

static int name(const blind_record *r)
{
  return r->name;
}

static int stated(const blind_record *r)
{
  return r->stated;
}

static int family(const blind_record *r)
{
  return r->family;
}

static int undecided(const blind_record *r)
{
  return is(r->verdict, "undecided");
}

static int no_answer(const blind_record *r)
{
  return is(r->verdict, "timeout") || is(r->verdict, "failed");
}

static int all(const blind_record *r)
{
  (void)r;
  return 1;
}

/* "Above" is: of a size of at least twice the information limit. */
const blind_bar blind_bars[] = {
    {"p and x, one or two missing, above: added under the right names", one_or_two, name, -1, 0},
    {"p and x, one or two missing, above: right names, stated class, or listed below --min-gain", one_or_two, stated, 1,
     0.95},
    {"nothing missing: something named (false alarm)", nothing, detected, 0, 0.01},
    {"unlisted, above: called unlisted, in the right equation", unlisted, name, 1, 0.90},
    {"unlisted, above: so called, or listed so below --min-gain", unlisted, stated, -1, 0},
    {"p and x, one missing, above: detected", single, detected, -1, 0},
    {"p and x, one missing, above: right name", single, name, -1, 0},
    {"p and x, one missing, above: right name, stated or listed", single, stated, -1, 0},
    {"p and x, one missing, above: right name or family", single, family, -1, 0},
    {"p and x, one missing, above: undecided", single, undecided, -1, 0},
    {"p and x, one missing, any size: detected", single_any_size, detected, -1, 0},
    {"p and x, one missing, any size: right name, stated or listed", single_any_size, stated, -1, 0},
    {"p and x, two missing, above: right names, stated or listed", pair, stated, -1, 0},
    {"x only, something missing, above: right answer or stated class", position_only, stated, -1, 0},
    {"p only, something missing, above: right answer or stated class", pressure_only, stated, -1, 0},
    {"no answer in the time allowed, or an error", all, no_answer, -1, 0},
};
const int blind_bar_count = sizeof blind_bars / sizeof blind_bars[0];

blind_count blind_bar_counts(const blind_bar *bar, const blind_record *record, int n)
{
  blind_count count = {0, 0};
  int i;
  for (i = 0; i < n; i++)
    if (bar->counts(&record[i])) {
      count.n++;
      count.k += bar->hit(&record[i]) != 0;
    }
  return count;
}

int blind_bar_word(const blind_bar *bar, blind_count count)
{
  const double share = count.n ? (double)count.k / count.n : bar->share;
  double low, high;
  blind_wilson(count, &low, &high);
  if (bar->at_least ? high < bar->share : low > bar->share)
    return BLIND_BAR_REFUTED;
  if (bar->at_least ? share < bar->share : share > bar->share)
    return BLIND_BAR_MISSED;
  return (bar->at_least ? low >= bar->share : high <= bar->share) ? BLIND_BAR_SHOWN : BLIND_BAR_REACHED;
}

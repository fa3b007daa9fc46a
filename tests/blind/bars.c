#include <string.h>

#include "stats.h"
#include "summary.h"

unsigned blind_mark(int has, unsigned trait)
{
  return has ? trait : 0;
}

/* Traits of a trial; "above" is: of a size of at least twice the information limit. */
enum {
  ANY = 1 << 0,
  NOTHING = 1 << 1,
  SINGLE = 1 << 2, /* these with pressure and position */
  SINGLE_ABOVE = 1 << 3,
  PAIR_ABOVE = 1 << 4,
  UNLISTED_ABOVE = 1 << 5,
  X_ABOVE = 1 << 6, /* position alone, something missing */
  P_ABOVE = 1 << 7,
  DETECTED = 1 << 8,
  NAME = 1 << 9,
  STATED = 1 << 10,
  FAMILY = 1 << 11,
  UNDECIDED = 1 << 12,
  NO_ANSWER = 1 << 13
};

static unsigned traits_of(const blind_record *r)
{
  const int nothing = blind_is(r->kind, "nothing"), px = strncmp(r->channels, "px", 2) == 0, above = r->ratio >= 2;
  return ANY | blind_mark(nothing, NOTHING) | blind_mark(px && blind_is(r->kind, "single"), SINGLE) |
         blind_mark(px && above && blind_is(r->kind, "single"), SINGLE_ABOVE) |
         blind_mark(px && above && blind_is(r->kind, "pair"), PAIR_ABOVE) |
         blind_mark(px && above && blind_is(r->kind, "unlisted"), UNLISTED_ABOVE) |
         blind_mark(blind_is(r->channels, "x") && !nothing && above, X_ABOVE) |
         blind_mark(blind_is(r->channels, "p") && !nothing && above, P_ABOVE) | blind_mark(r->detected, DETECTED) |
         blind_mark(r->name, NAME) | blind_mark(r->stated, STATED) | blind_mark(r->family, FAMILY) |
         blind_mark(blind_is(r->verdict, "undecided"), UNDECIDED) |
         blind_mark(blind_is(r->verdict, "timeout") || blind_is(r->verdict, "failed"), NO_ANSWER);
}

static const blind_bar bars[] = {
    {"p and x, one or two missing, above: added under the right names", SINGLE_ABOVE | PAIR_ABOVE, NAME, -1, 0},
    {"p and x, one or two missing, above: right names, stated class, or listed below --min-gain",
     SINGLE_ABOVE | PAIR_ABOVE, STATED, 1, 0.95},
    {"nothing missing: something named (false alarm)", NOTHING, DETECTED, 0, 0.01},
    {"unlisted, above: called unlisted, in the right equation", UNLISTED_ABOVE, NAME, 1, 0.90},
    {"unlisted, above: so called, or listed so below --min-gain", UNLISTED_ABOVE, STATED, -1, 0},
    {"p and x, one missing, above: detected", SINGLE_ABOVE, DETECTED, -1, 0},
    {"p and x, one missing, above: right name", SINGLE_ABOVE, NAME, -1, 0},
    {"p and x, one missing, above: right name, stated or listed", SINGLE_ABOVE, STATED, -1, 0},
    {"p and x, one missing, above: right name or family", SINGLE_ABOVE, FAMILY, -1, 0},
    {"p and x, one missing, above: undecided", SINGLE_ABOVE, UNDECIDED, -1, 0},
    {"p and x, one missing, any size: detected", SINGLE, DETECTED, -1, 0},
    {"p and x, one missing, any size: right name, stated or listed", SINGLE, STATED, -1, 0},
    {"p and x, two missing, above: right names, stated or listed", PAIR_ABOVE, STATED, -1, 0},
    {"x only, something missing, above: right answer or stated class", X_ABOVE, STATED, -1, 0},
    {"p only, something missing, above: right answer or stated class", P_ABOVE, STATED, -1, 0},
    {"no answer in the time allowed, or an error", ANY, NO_ANSWER, -1, 0},
};
const blind_bar_list blind_bars = {bars, sizeof bars / sizeof *bars, traits_of};

blind_count blind_bar_counts(const blind_bar_list *list, int bar, const blind_record *record, int n)
{
  const blind_bar *b = &list->bar[bar];
  blind_count count = {0, 0};
  int i;
  for (i = 0; i < n; i++) {
    const unsigned traits = list->traits_of(&record[i]);
    if (traits & b->counts) {
      count.n++;
      count.k += (traits & b->hits) != 0;
    }
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

#include "trends.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double chance = 0.05; /* of an interval that leaves out the truth */

/* Days until the line is further from the declared value than the tolerance. */
static void find_days(lab_trend *t)
{
  const lab_sample *last = t->last;
  const double tolerance = last->declared != 0 ? last->tolerance * fabs(last->declared) : last->tolerance;
  int i;
  for (i = 0; i < 3; i++)
    t->days[i] = t->drifts && tolerance > 0 ? 0 : (double)NAN;
  if (t->days[0] == 0 && fabs(lab_line_value(&t->line, last->at) - last->declared) < tolerance &&
      lab_line_reaches(&t->line, last->declared + copysign(tolerance, t->slope), chance, t->days))
    for (i = 0; i < 3; i++)
      t->days[i] = fmax(t->days[i] - last->at, 0);
}

/* In:  n  trends of one rig */
static void judge(lab_trend *trend, int n)
{
  int i;
  trend->n_of_rig = n;
  for (i = 0; i < n; i++) {
    lab_trend *t = &trend[i];
    t->slope = lab_line_slope(&t->line);
    t->half = lab_line_half(&t->line, chance);
    t->drifts = fabs(t->slope) > lab_line_half(&t->line, chance / n);
    find_days(t);
  }
}

static int is_same(const lab_sample *a, const lab_sample *b)
{
  return !strcmp(a->rig, b->rig) && !strcmp(a->parameter, b->parameter);
}

/* One trend from the samples of a parameter.  Returns: the sample after them */
static const lab_sample *gather(const lab_sample *first, const lab_sample *end, lab_trend *t)
{
  const lab_sample *s;
  *t = (lab_trend){.first = first};
  for (s = first; s < end && is_same(first, s); s++)
    lab_line_add(&t->line, s->at, s->value, s->deviation);
  t->last = s - 1;
  return s;
}

int lab_trends_find(const lab_history *history, lab_trends *trends, lab_error *error)
{
  const lab_sample *s = history->of, *end = s + history->n;
  int from, i;
  trends->of = malloc(((size_t)history->n + 1) * sizeof *trends->of);
  if (!trends->of)
    return lab_fail_memory(error, "trends");
  while (s < end) {
    s = gather(s, end, &trends->of[trends->n]);
    trends->n += lab_line_is_there(&trends->of[trends->n].line);
  }
  for (from = 0, i = 1; i <= trends->n; i++)
    if (i == trends->n || strcmp(trends->of[from].first->rig, trends->of[i].first->rig) != 0) {
      judge(&trends->of[from], i - from);
      from = i;
    }
  return LAB_OK;
}

void lab_trends_free(lab_trends *trends)
{
  free(trends->of);
  *trends = (lab_trends){0};
}

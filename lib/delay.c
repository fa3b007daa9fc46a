/* A signal that comes late: a queue of what was given, each value with its distance in time from the one before.
 * Nothing in it is a time of day, so that single precision is as good on the tenth day as on the first. */
#include "internal.h"

void pneu_delay_begin(pneu_delay *d, pneu_late *slot, int room, pneu_real value)
{
  d->slot = slot;
  d->room = room;
  d->first = d->n = 0;
  d->acting = d->given = value;
  d->since = 0;
}

static pneu_late *late_at(const pneu_delay *d, int i)
{
  return &d->slot[(d->first + i) % d->room];
}

/* Time until the newest value acts, 0 where nothing is on its way; less if it should have acted. */
static pneu_real newest_acts_in(const pneu_delay *d)
{
  pneu_real wait = -d->since;
  int i;
  for (i = 0; i < d->n; i++)
    wait += late_at(d, i)->gap;
  return wait;
}

/* A value that acts `wait` from now, and not before the one given before it. */
static int append(pneu_delay *d, pneu_real wait, pneu_real value, int runs)
{
  pneu_late *late;
  const pneu_real gap = wait - newest_acts_in(d);
  if (d->n == d->room)
    return PNEU_E_DELAY;
  late = late_at(d, d->n++);
  late->gap = gap > 0 ? gap : 0;
  late->value = d->given = value;
  late->runs = runs;
  return PNEU_OK;
}

int pneu_delay_give(pneu_delay *d, pneu_real length, pneu_real value)
{
  if (value == d->given)
    return PNEU_OK;
  if (length > PNEU_EVENT_TIME || d->n > 0)
    return append(d, length, value, 0);
  d->acting = d->given = value;
  return PNEU_OK;
}

/* The oldest value on its way acts. */
static void reach(pneu_delay *d)
{
  const pneu_late *late = late_at(d, 0);
  d->since = d->n > 1 && d->since > late->gap ? d->since - late->gap : 0;
  d->acting = late->value;
  d->first = (d->first + 1) % d->room;
  d->n--;
}

void pneu_delay_pass(pneu_delay *d, pneu_real dt)
{
  if (d->n > 0)
    d->since += dt;
  while (d->n > 0 && late_at(d, 0)->runs && late_at(d, 0)->gap <= d->since)
    reach(d);
}

void pneu_delay_release(pneu_delay *d)
{
  while (d->n > 0 && late_at(d, 0)->gap <= d->since + PNEU_EVENT_TIME)
    reach(d);
}

int pneu_delay_follow(pneu_delay *d, pneu_real length, pneu_real dt, pneu_real value)
{
  pneu_real held;
  int status = PNEU_OK;
  pneu_delay_pass(d, dt);
  if (value == d->given)
    return PNEU_OK;
  held = length - dt - newest_acts_in(d); /* before it began to run */
  if (held > 0)
    status = append(d, length - dt, d->given, 1);
  else if (d->n == 0)
    d->since = -held;
  return status == PNEU_OK ? append(d, length, value, 1) : status;
}

pneu_real pneu_delay_until(const pneu_delay *d, pneu_real left)
{
  pneu_real wait = -d->since;
  int i;
  for (i = 0; i < d->n; i++) {
    wait += late_at(d, i)->gap;
    if (!late_at(d, i)->runs)
      return wait < left - PNEU_EVENT_TIME ? (wait > 0 ? wait : 0) : left;
  }
  return left;
}

pneu_real pneu_delay_value(const pneu_delay *d, pneu_real ahead)
{
  pneu_real from = d->acting, t = d->since + ahead;
  int i;
  for (i = 0; i < d->n && late_at(d, i)->runs; i++) {
    const pneu_late *late = late_at(d, i);
    if (t < late->gap)
      return from + t / late->gap * (late->value - from);
    t -= late->gap;
    from = late->value;
  }
  return from;
}

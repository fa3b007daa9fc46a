#include "delay.h"

#include <math.h>

void fmu_delay_begin(fmu_delay *d, double length, double time, double u)
{
  d->length = length;
  d->now = time;
  d->wake = time;
  d->runs = 0;
  pneu_delay_begin(&d->line, d->slot, FMU_DELAY_ROOM, u);
}

int fmu_delay_follow(fmu_delay *d, double time, double u)
{
  const double dt = time - d->now;
  if (!(dt > 0))
    return PNEU_OK;
  d->runs = u != d->line.given;
  d->now = time;
  return pneu_delay_follow(&d->line, d->length, dt, u);
}

int fmu_delay_jump(fmu_delay *d, double time, double u)
{
  int status;
  pneu_delay_pass(&d->line, fmax(time - d->now, 0));
  d->now = time;
  status = pneu_delay_give(&d->line, d->length, u);
  pneu_delay_release(&d->line);
  return status;
}

int fmu_delay_asks(const fmu_delay *d, double time)
{
  return d->runs && d->wake <= time;
}

double fmu_delay_stop(fmu_delay *d, double time)
{
  const double next = time + pneu_delay_until(&d->line, HUGE_VAL);
  if (!d->runs)
    return next;
  d->wake = time + d->length / 2;
  return fmin(d->wake, next);
}

double fmu_delay_value(const fmu_delay *d, double time)
{
  return pneu_delay_value(&d->line, time - d->now);
}

int fmu_delay_is_sound(const fmu_delay *d)
{
  const pneu_delay *line = &d->line;
  int i;
  for (i = 0; i < FMU_DELAY_ROOM; i++)
    if (!(d->slot[i].gap >= 0))
      return 0;
  return d->length >= 0 && line->room == FMU_DELAY_ROOM && line->n >= 0 && line->n <= line->room && line->first >= 0 &&
         line->first < line->room;
}

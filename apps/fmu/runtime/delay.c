#include "delay.h"

#include <math.h>
#include <string.h>

void fmu_delay_begin(fmu_delay *d, double length, double time, double u)
{
  d->length = length;
  d->last_time = time;
  d->wake = time;
  d->runs = 0;
  d->head = 0;
  d->n = 1;
  d->t[0] = time;
  d->u[0] = u;
}

/* Last entry of the line on which entry `head` lies: a jump follows it, or nothing. */
static int line_end(const fmu_delay *d)
{
  int i = d->head;
  while (i + 1 < d->n && d->t[i + 1] > d->t[i])
    i++;
  return i;
}

/* Entries before the head are past; on a line all but the last that the command has reached are. */
static void make_room(fmu_delay *d)
{
  const size_t left = (size_t)(d->n - d->head);
  memmove(d->t, d->t + d->head, left * sizeof d->t[0]);
  memmove(d->u, d->u + d->head, left * sizeof d->u[0]);
  d->n = (int)left;
  d->head = 0;
}

static void append(fmu_delay *d, double time, double u)
{
  if (d->n == FMU_DELAY_ROOM)
    make_room(d);
  if (d->n == FMU_DELAY_ROOM)
    d->n--;
  d->t[d->n] = time;
  d->u[d->n++] = u;
}

/* The last command has held until `time`. */
static void hold_until(fmu_delay *d, double time)
{
  if (time > d->t[d->n - 1])
    append(d, time, d->u[d->n - 1]);
}

void fmu_delay_follow(fmu_delay *d, double time, double u)
{
  if (!(time > d->last_time))
    return;
  d->runs = u != d->u[d->n - 1];
  if (d->runs) {
    hold_until(d, d->last_time);
    append(d, time, u);
  }
  d->last_time = time;
}

void fmu_delay_jump(fmu_delay *d, double time, double u)
{
  const int last = d->n - 1;
  if (u != d->u[last]) {
    hold_until(d, time);
    if (last > d->head && d->t[last - 1] == time)
      d->u[last] = u; /* one jump after the other at the same time */
    else
      append(d, time, u);
  }
  d->last_time = time;
}

double fmu_delay_next(const fmu_delay *d)
{
  const int end = line_end(d);
  return end + 1 < d->n ? d->t[end] + d->length : HUGE_VAL;
}

int fmu_delay_asks(const fmu_delay *d, double time)
{
  return d->runs && d->wake <= time;
}

double fmu_delay_stop(fmu_delay *d, double time)
{
  if (!d->runs)
    return fmu_delay_next(d);
  d->wake = time + d->length / 2;
  return fmin(d->wake, fmu_delay_next(d));
}

void fmu_delay_release(fmu_delay *d, double time)
{
  const double rounding = 1e-12 * (1 + fabs(time));
  while (fmu_delay_next(d) <= time + rounding)
    d->head = line_end(d) + 1;
  while (d->head < line_end(d) && d->t[d->head + 1] <= time - d->length)
    d->head++;
}

double fmu_delay_value(const fmu_delay *d, double time)
{
  const double at = time - d->length;
  const int end = line_end(d);
  int i = d->head;
  while (i < end && d->t[i + 1] <= at)
    i++;
  if (i == end || at <= d->t[i])
    return d->u[i];
  return d->u[i] + (at - d->t[i]) / (d->t[i + 1] - d->t[i]) * (d->u[i + 1] - d->u[i]);
}

int fmu_delay_is_sound(const fmu_delay *d)
{
  return d->length >= 0 && d->n >= 1 && d->n <= FMU_DELAY_ROOM && d->head >= 0 && d->head < d->n;
}

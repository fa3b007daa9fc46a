#include "pace.h"

#include <stdlib.h>
#include <string.h>

/* Room for one more of `n`.  Returns: the memory, NULL: there is none. */
static void *room_for(void *memory, size_t n, size_t size, size_t *room)
{
  if (n < *room)
    return memory;
  *room = 2 * *room + 64;
  return realloc(memory, *room * size);
}

static void *keep(lab_pace *pace, void *old, void *grown)
{
  pace->lacks_memory |= !grown;
  return grown ? grown : old;
}

void lab_pace_row(lab_pace *pace)
{
  if (!pace->lacks_memory)
    pace->first = keep(pace, pace->first, room_for(pace->first, pace->rows, sizeof *pace->first, &pace->row_room));
  if (!pace->lacks_memory)
    pace->first[pace->rows++] = pace->n;
}

void lab_pace_step(lab_pace *pace, double h)
{
  if (!pace->lacks_memory)
    pace->step = keep(pace, pace->step, room_for(pace->step, pace->n, sizeof *pace->step, &pace->step_room));
  if (!pace->lacks_memory)
    pace->step[pace->n++] = (pneu_paced_step){(pneu_real)h, 0};
}

void lab_pace_event(lab_pace *pace)
{
  if (pace->n > 0)
    pace->step[pace->n - 1].event = 1;
}

int lab_pace_end(lab_pace *pace, lab_error *error)
{
  lab_pace_row(pace);
  if (pace->lacks_memory)
    return lab_fail_memory(error, "the steps of a run");
  pace->rows--;
  pace->is_set = 1;
  return LAB_OK;
}

void lab_pace_follow(const lab_pace *pace, size_t i, pneu_options *options)
{
  options->pace = pace->step + pace->first[i];
  options->n_pace = (int)(pace->first[i + 1] - pace->first[i]);
}

void lab_pace_close(lab_pace *pace)
{
  free(pace->step);
  free(pace->first);
  memset(pace, 0, sizeof *pace);
}

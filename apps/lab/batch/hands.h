/* Jobs in processes of their own: whatever happens to one, it ends alone, and its memory is gone with it.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_HANDS_H
#define LAB_HANDS_H

#include <sys/types.h>

#include "crew.h"

typedef struct lab_hand {
  pid_t pid; /* 0: idle */
  int pipe;  /* its result comes here */
  size_t got;
  void *job, *result;
} lab_hand;

typedef struct lab_hands {
  const lab_crew *crew;
  int n;
  lab_hand *hand;
} lab_hands;

/* Out: hands  to be closed, also after an error.  Returns: LAB_OK, LAB_WORLD. */
int lab_hands_open(lab_hands *hands, const lab_crew *crew, lab_error *error);

/* A hand that is idle; put its job in hand->job and start it.  Returns: NULL if there is none */
lab_hand *lab_hands_idle(lab_hands *hands);
int lab_hands_start(lab_hands *hands, lab_hand *hand, lab_error *error);

/* Wait at most `ms` milliseconds (-1: for ever) for one to finish; its result is whole then, and it is idle.
 * Returns: NULL if none has, or if a signal came */
lab_hand *lab_hands_wait(lab_hands *hands, int ms);

/* How many are at work. */
int lab_hands_busy(const lab_hands *hands);

/* End those at work. */
void lab_hands_close(lab_hands *hands);

#endif

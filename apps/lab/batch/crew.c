/* A crew on this machine. */
#include "crew.h"

#ifdef _OPENMP
#include <omp.h>
#endif

#include "hands.h"
#include "../base/interrupt.h"

static const int breath = 200; /* [ms] between two looks for signals */

int lab_crew_usual(void)
{
#ifdef _OPENMP
  return omp_get_num_procs();
#else
  return 1;
#endif
}

int lab_crew_join(void)
{
  return 1;
}

void lab_crew_serve(const lab_crew *crew)
{
  (void)crew;
}

void lab_crew_leave(const lab_crew *crew)
{
  (void)crew;
}

/* Give every idle hand a job.  In/out: more  0: none is left */
static int hand_out(lab_hands *hands, int *more, lab_error *error)
{
  const lab_crew *crew = hands->crew;
  lab_hand *hand;
  while (*more && (hand = lab_hands_idle(hands))) {
    *more = crew->next(crew->context, hand->job);
    if (*more && lab_hands_start(hands, hand, error))
      return error->status;
  }
  return LAB_OK;
}

int lab_crew_run(const lab_crew *crew, lab_error *error)
{
  lab_hands hands;
  int more = 1, status = lab_hands_open(&hands, crew, error);
  while (status == LAB_OK && (more || lab_hands_busy(&hands))) {
    const lab_hand *finished;
    if (lab_interrupt_pending()) {
      status = lab_fail(error, LAB_WORLD, "interrupted");
      break;
    }
    status = hand_out(&hands, &more, error);
    finished = status == LAB_OK && lab_hands_busy(&hands) ? lab_hands_wait(&hands, breath) : NULL;
    if (finished)
      status = crew->done(crew->context, finished->job, finished->result, error);
  }
  lab_hands_close(&hands);
  return status;
}

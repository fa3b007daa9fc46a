#ifndef PNEU_TRANSDUCER_H
#define PNEU_TRANSDUCER_H

#include "internal.h"

/* Opening that the command asks for, before any dynamics of the transducer. */
pneu_real pneu_command_opening(const pneu_terms *t);

#endif

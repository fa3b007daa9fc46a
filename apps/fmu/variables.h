/* The variables of an FMU, as its description wants them; one list for both versions of FMI. References are those of
 * runtime/shape.h, parameters those of pneu_param_describe.
 * SPDX-License-Identifier: MIT */
#ifndef FMU_VARIABLES_H
#define FMU_VARIABLES_H

#include "runtime/shape.h"

enum fmu_causality { FMU_INDEPENDENT, FMU_PARAMETER, FMU_INPUT, FMU_OUTPUT, FMU_LOCAL };

enum {
  FMU_NAME_TEXT = 64,
  FMU_VARIABLE_MAX = 3 + FMU_INPUT_COUNT + FMU_START_COUNT + FMU_OUTPUT_COUNT + 2 * PNEU_STATE_MAX +
                     FMU_INDICATOR_COUNT + PNEU_PARAM_COUNT
};

typedef struct fmu_variable {
  unsigned reference;
  int causality;            /* enum fmu_causality */
  int integer;              /* not 0: a whole number, which changes at events alone */
  char name[FMU_NAME_TEXT]; /* structured: "chamber_leak.leak_area", "der(pressure)" */
  const char *unit;         /* NULL: none */
  const char *meaning;
  double lower, upper, start; /* NaN: none */
  double nominal;             /* of a state; else NaN */
  int jumps;                  /* a state that events set anew */
  unsigned rate_of;           /* reference of the state or input whose rate it is; 0: it is none */
} fmu_variable;

typedef struct fmu_list {
  int n;
  fmu_variable variable[FMU_VARIABLE_MAX];
  fmu_shape shape;
  char modes[256]; /* numbers and words */
} fmu_list;

/* In: data, of which fmu_model makes `model`.  Out: list, to stay where it is: its texts point into it. */
void fmu_list_of(const fmu_data *data, const pneu_model *model, fmu_list *list);

/* Place of a reference in the list. */
int fmu_list_find(const fmu_list *list, unsigned reference);

/* What an output depends on, as places in the list: an importer that knows closes loops without iterating.
 * Returns: their number, or -1 where it may be everything. Out: place, at most PNEU_STATE_MAX */
int fmu_dependencies(const fmu_data *data, const fmu_list *list, int output, int *place);

#endif

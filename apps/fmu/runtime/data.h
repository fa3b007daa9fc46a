/* The model inside the FMU: what export-fmu writes, once into the binary and once into model_data.h for those who
 * compile the sources. Numbers only, no pointers: the binary is compiled once, and for each model the exporter puts
 * these bytes in the place that begins with the mark.
 * SPDX-License-Identifier: MIT */
#ifndef FMU_DATA_H
#define FMU_DATA_H

#include "../../../lib/pneu.h"

#define FMU_MARK "model of libpneu" /* found once in the binary */

enum { FMU_MARK_TEXT = 20, FMU_TOKEN_TEXT = 44, FMU_TERM_MAX = 4 };

typedef struct fmu_data {
  char mark[FMU_MARK_TEXT];
  char token[FMU_TOKEN_TEXT]; /* guid of FMI 2, instantiationToken of FMI 3 */
  pneu_params params;
  pneu_laws law;
  int n_terms;
  pneu_term term[FMU_TERM_MAX];
} fmu_data;

extern const fmu_data fmu_model_data;

#endif

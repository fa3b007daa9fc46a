#include "modeldata.h"

#include <inttypes.h>
#include <string.h>

#include "../lab/base/checksum.h"
#include "../lab/rig/rigterm.h"
#include "carried.h"

typedef char fmu_room_for_terms[(int)FMU_TERM_MAX >= (int)LAB_TERM_MAX ? 1 : -1];

static uint64_t add_numbers(uint64_t sum, const fmu_data *data)
{
  pneu_params params = data->params;
  const int laws[] = {data->law.gas, data->law.flow, data->law.pressure_input, data->law.position_input, data->n_terms};
  int i, k;
  for (i = 0; i < PNEU_PARAM_COUNT; i++)
    sum = lab_checksum(sum, pneu_param_at(&params, i), sizeof(pneu_real));
  sum = lab_checksum(sum, laws, sizeof laws);
  for (i = 0; i < data->n_terms; i++) {
    const pneu_term *term = &data->term[i];
    const int whole[] = {term->equation, term->argument, term->n};
    sum = lab_checksum(sum, whole, sizeof whole);
    sum = lab_checksum(sum, &term->from, sizeof term->from);
    sum = lab_checksum(sum, &term->to, sizeof term->to);
    for (k = 0; k < term->n; k++)
      sum = lab_checksum(sum, &term->value[k], sizeof term->value[k]);
  }
  return sum;
}

static void make_token(fmu_data *data, int fmi)
{
  uint64_t sum[2] = {LAB_CHECKSUM_SEED, ~LAB_CHECKSUM_SEED};
  int i, k;
  for (k = 0; k < 2; k++) {
    sum[k] = lab_checksum(sum[k], &fmi, sizeof fmi);
    for (i = 0; fmu_files[i].name; i++)
      sum[k] = lab_checksum(sum[k], fmu_files[i].bytes, fmu_files[i].size);
    sum[k] = add_numbers(sum[k], data);
  }
  snprintf(data->token, sizeof data->token, "{%08" PRIx32 "-%04x-%04x-%04x-%012" PRIx64 "}", (uint32_t)(sum[0] >> 32),
           (unsigned)(sum[0] >> 16 & 0xffff), (unsigned)(sum[0] & 0xffff), (unsigned)(sum[1] >> 48),
           sum[1] & UINT64_C(0xffffffffffff));
}

void fmu_data_of(const lab_rig *rig, int fmi, fmu_data *data)
{
  memset(data, 0, sizeof *data);
  strcpy(data->mark, FMU_MARK);
  data->params = rig->params;
  data->law = rig->laws;
  data->n_terms = rig->n_terms;
  memcpy(data->term, rig->term, (size_t)rig->n_terms * sizeof rig->term[0]);
  make_token(data, fmi);
}

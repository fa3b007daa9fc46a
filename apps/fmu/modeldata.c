#include "modeldata.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "../lab/base/checksum.h"
#include "../lab/rig/rigterm.h"
#include "carried.h"

typedef char fmu_room_for_terms[(int)FMU_TERM_MAX >= (int)LAB_TERM_MAX ? 1 : -1];

/* ---- Data ---- */

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
    for (i = 0; fmu_carried(i); i++)
      sum[k] = lab_checksum(sum[k], fmu_carried(i)->bytes, fmu_carried(i)->size);
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

/* ---- Header ---- */

int fmu_data_header(const lab_rig *rig, const fmu_data *data, char **text, size_t *size, lab_error *error)
{
  FILE *file;
  *text = NULL;
  if (!(file = open_memstream(text, size)))
    return lab_fail_memory(error, "model_data.h");
  fprintf(file, "/* The model, by export-fmu; for libpneu " PNEU_VERSION " with its whole catalogue. */\n");
  fprintf(file, "#define MODEL_TOKEN \"%s\"\n", data->token);
  lab_rig_write_c(file, rig, 1);
  if (rig->n_terms == 0)
    fputs("#define MODEL_TERMS {{0, 0, 0, 0, 0, {0}}}\n", file);
  if (fclose(file) == 0)
    return LAB_OK;
  free(*text);
  *text = NULL;
  return lab_fail_memory(error, "model_data.h");
}

/* ---- Binary ---- */

/* Where the data begin. */
static unsigned char *place_of(unsigned char *bytes, size_t size)
{
  size_t i;
  for (i = 0; i + sizeof(fmu_data) <= size; i++)
    if (memcmp(bytes + i, FMU_MARK, sizeof FMU_MARK) == 0)
      return bytes + i;
  return NULL;
}

int fmu_data_binary(const fmu_data *data, int fmi, unsigned char **bytes, size_t *size, lab_error *error)
{
  const fmu_file *file = fmu_carried_find(fmi == 2 ? "fmu2.so" : "fmu3.so");
  unsigned char *place;
  *size = file->size;
  *bytes = malloc(file->size);
  if (!*bytes)
    return lab_fail_memory(error, "the shared library");
  memcpy(*bytes, file->bytes, file->size);
  place = place_of(*bytes, *size);
  if (!place) {
    free(*bytes);
    *bytes = NULL;
    return lab_fail(error, LAB_WORLD, "%s as built has no place for a model: build export-fmu again without -flto",
                    file->name);
  }
  memcpy(place, data, sizeof *data);
  return LAB_OK;
}

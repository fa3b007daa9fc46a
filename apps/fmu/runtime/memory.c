/* FMU state: a copy of all that an instance remembers. */
#include <stdlib.h>
#include <string.h>

#include "private.h"

int fmu_get_memory(fmu_instance *instance, void **memory)
{
  if (fmu_may(instance, FMU_CALL_ANY))
    return FMU_ERROR;
  if (!memory)
    return fmu_say(instance, FMU_ERROR, "no place for the FMU state");
  if (!*memory)
    *memory = malloc(sizeof instance->m);
  if (!*memory)
    return fmu_say(instance, FMU_ERROR, "out of memory");
  memcpy(*memory, &instance->m, sizeof instance->m);
  ((fmu_memory *)*memory)->delay.line.slot = NULL;
  return FMU_OK;
}

/* Whether bytes are a state of this FMU: it may have been written by another one, or cut short. */
static int is_sound(const fmu_instance *i, const fmu_memory *m)
{
  return memcmp(m->token, i->m.token, sizeof m->token) == 0 && m->kind == i->m.kind && m->phase > 0 &&
         m->phase <= FMU_TERMINATED && (m->phase & (m->phase - 1)) == 0 && m->state.mode >= 0 &&
         m->state.mode < PNEU_MODE_COUNT &&
         (fmu_delay_is_sound(&m->delay) || (m->stale && m->phase & (FMU_INSTANTIATED | FMU_INITIALIZING)));
}

int fmu_set_memory(fmu_instance *instance, const void *memory)
{
  const fmu_memory *m = memory;
  pneu_model model;
  int was_made;
  if (fmu_may(instance, FMU_CALL_ANY))
    return FMU_ERROR;
  if (!m || !is_sound(instance, m))
    return fmu_say(instance, FMU_ERROR, "no state of this FMU, or of the other kind of instance");
  was_made = fmu_model(&fmu_model_data, &m->params, &model, NULL) == PNEU_OK && fmu_fits(&instance->shape, &model);
  if (!was_made && !(m->phase & (FMU_INSTANTIATED | FMU_INITIALIZING)))
    return fmu_say(instance, FMU_ERROR, "no state of this FMU");
  if (was_made)
    instance->model = model;
  instance->m = *m;
  instance->m.delay.line.slot = instance->m.delay.slot;
  return FMU_OK;
}

int fmu_free_memory(fmu_instance *instance, void **memory)
{
  if (!instance)
    return FMU_ERROR;
  if (memory) {
    free(*memory);
    *memory = NULL;
  }
  return FMU_OK;
}

int fmu_memory_size(fmu_instance *instance, const void *memory, size_t *size)
{
  if (!instance || !memory)
    return FMU_ERROR;
  *size = sizeof(fmu_memory);
  return FMU_OK;
}

int fmu_write_memory(fmu_instance *instance, const void *memory, void *bytes, size_t size)
{
  if (!instance || !memory || size < sizeof(fmu_memory))
    return instance ? fmu_say(instance, FMU_ERROR, "too little room for the FMU state") : FMU_ERROR;
  memcpy(bytes, memory, sizeof(fmu_memory));
  return FMU_OK;
}

int fmu_read_memory(fmu_instance *instance, const void *bytes, size_t size, void **memory)
{
  void *copy;
  if (!instance || size != sizeof(fmu_memory))
    return instance ? fmu_say(instance, FMU_ERROR, "this is not an FMU state") : FMU_ERROR;
  copy = malloc(size);
  if (!copy)
    return fmu_say(instance, FMU_ERROR, "out of memory");
  memcpy(copy, bytes, size);
  if (!is_sound(instance, copy)) {
    free(copy);
    return fmu_say(instance, FMU_ERROR, "this is not an FMU state of this FMU");
  }
  *memory = copy;
  return FMU_OK;
}

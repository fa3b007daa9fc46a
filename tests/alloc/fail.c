/* Memory that runs out. What is linked with --wrap for malloc, calloc and realloc gets no memory at the call FAIL_AT,
 * counted from 1, of the environment, and if FAIL_ON is set at no later call either. At the end the number of calls
 * goes into the file FAIL_COUNT. Libraries that are linked dynamically have memory all the time. */
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

void *__real_malloc(size_t size);
void *__real_calloc(size_t n, size_t size);
void *__real_realloc(void *old, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t n, size_t size);
void *__wrap_realloc(void *old, size_t size);

static unsigned long calls;

static void write_count(void)
{
  FILE *file = fopen(getenv("FAIL_COUNT"), "w");
  if (!file)
    return;
  fprintf(file, "%lu\n", calls);
  fclose(file);
}

static int fails(void)
{
  static unsigned long at;
  static int on;
  if (calls++ == 0) {
    const char *text = getenv("FAIL_AT");
    at = text ? strtoul(text, NULL, 10) : 0;
    on = getenv("FAIL_ON") != NULL;
    if (getenv("FAIL_COUNT"))
      atexit(write_count);
  }
  return at > 0 && (calls == at || (on && calls > at));
}

void *__wrap_malloc(size_t size)
{
  return fails() ? NULL : __real_malloc(size);
}

void *__wrap_calloc(size_t n, size_t size)
{
  return fails() ? NULL : __real_calloc(n, size);
}

void *__wrap_realloc(void *old, size_t size)
{
  return fails() ? NULL : __real_realloc(old, size);
}

/* Rig files of a test: read, refused, written and read again.
 * SPDX-License-Identifier: MIT */
#ifndef TESTS_RIGFILE_H
#define TESTS_RIGFILE_H

#include <stddef.h>

#include "scratch.h"

#include "../apps/lab/rig/rig.h"

/* A rig file that must be good. */
static inline lab_rig read_rig(const char *text)
{
  lab_rig rig;
  succeed(lab_rig_read(scratch_text("rig.cfg", text), &rig, &error));
  return rig;
}

/* A rig file that must be refused, with LAB_DATA, its place and some words. */
static inline void assert_rig_refused(const char *text, const char *place, const char *words)
{
  lab_rig rig;
  assert_fails(lab_rig_read(scratch_text("rig.cfg", text), &rig, &error), LAB_DATA, words);
  assert_contains(error.text, place);
}

/* What a written rig is when it is read again.  In: remark  above it; NULL: none */
static inline lab_rig write_and_read(const lab_rig *rig, const char *remark)
{
  const char *path = scratch_path("again.cfg");
  FILE *file = fopen(path, "w");
  lab_rig again;
  assert_non_null(file);
  lab_rig_write(file, rig, remark);
  assert_int_equal(fclose(file), 0);
  succeed(lab_rig_read(path, &again, &error));
  return again;
}

/* The first of the listed parts in which two rigs differ; NULL: none. */
static inline const char *rig_difference(const lab_rig *a, const lab_rig *b)
{
#define PART(field)                                                                                                    \
  {                                                                                                                    \
#field, offsetof(lab_rig, field), sizeof a->field                                                                  \
  }
  static const struct part {
    const char *name;
    size_t at, size;
  } parts[] = {PART(params), PART(laws), PART(action),      PART(friction), PART(n_terms), PART(term),
               PART(n_fit),  PART(fit),  PART(fit_per_log), PART(noise),    PART(input),   PART(log)};
#undef PART
  size_t i;
  for (i = 0; i < sizeof parts / sizeof *parts; i++)
    if (memcmp((const char *)a + parts[i].at, (const char *)b + parts[i].at, parts[i].size) != 0)
      return parts[i].name;
  return strcmp(a->name, b->name) ? "name" : NULL;
}

#endif

/* Answers in short and records in words, for the tests of scores.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_ANSWERS_H
#define BLIND_ANSWERS_H

#include "score.h"

static blind_answer answer;

/* An answer in short: found effects with "+" between them, each with what it states as alike after ":". */
static inline void set_answer(const char *verdict, const char *found, const char *unlisted)
{
  char names[200], *name;
  memset(&answer, 0, sizeof answer);
  strcpy(answer.verdict, verdict);
  snprintf(names, sizeof names, "%s", found);
  for (name = strtok(names, "+"); name; name = strtok(NULL, "+")) {
    blind_found *f = &answer.found[answer.n_found++];
    char *alike = strchr(name, ':');
    if (alike) {
      *alike++ = '\0';
      strcpy(f->alike[f->n_alike++], alike);
    }
    strcpy(f->effect, name);
    f->since.t = f->since.low = f->since.high = NAN;
  }
  if (*unlisted)
    strcpy(answer.unlisted[answer.n_unlisted++], unlisted);
}

/* A record as its line, to be freed. */
static inline char *line_of(const blind_record *r, int recorded)
{
  char *line = NULL;
  size_t size;
  FILE *memory = open_memstream(&line, &size);
  blind_record_write(memory, r, recorded);
  fclose(memory);
  return line;
}

#endif

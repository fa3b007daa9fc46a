/* Errors of the programs: a code that is the exit status, and one sentence that says what to do.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_MESSAGE_H
#define LAB_MESSAGE_H

#if defined(__GNUC__)
#define LAB_PRINTF(fmt, args) __attribute__((format(printf, fmt, args)))
#else
#define LAB_PRINTF(fmt, args)
#endif

/* Exit status of every program. */
enum lab_status {
  LAB_OK = 0,
  LAB_DATA = 1,    /* the data or the configuration is at fault */
  LAB_USAGE = 2,   /* the command line is */
  LAB_NUMERIC = 3, /* a numerical failure, named, with time and state */
  LAB_WORLD = 4    /* the outside world: no disk, no permission, no memory */
};

typedef struct lab_error {
  int status;
  char text[1024];
} lab_error;

/* Record an error, replacing an older one.  In: status; format and arguments, no newline at the end.
 * Returns: status, so that a caller can write `return lab_fail(...)`. */
int lab_fail(lab_error *error, int status, const char *format, ...) LAB_PRINTF(3, 4);

/* Put "prefix: " in front of the recorded text, as a caller that knows more does.  Returns: its status. */
int lab_fail_in(lab_error *error, const char *format, ...) LAB_PRINTF(2, 3);

/* Attempts of which any may fail for a reason of its own fail together where it is the outside world's: take that from
 * one of them. From any thread.  In/out: all  with status LAB_OK before the first */
void lab_fail_together(lab_error *all, const lab_error *one);

/* Out of memory, while making `what`.  Returns: LAB_WORLD; here, so that a static analysis knows. */
static inline int lab_fail_memory(lab_error *error, const char *what)
{
  lab_fail(error, LAB_WORLD, "out of memory for %s", what);
  return LAB_WORLD;
}

/* For the static analysis, which does not look into message.c: the status that is given comes back. */
#ifdef __clang_analyzer__
#define lab_fail(error, status, ...) ((void)(lab_fail)(error, status, __VA_ARGS__), (status))
#endif

#endif

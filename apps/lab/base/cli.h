/* The command line that all programs share: long options from a table, usage text from the same table; -o is --out.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_CLI_H
#define LAB_CLI_H

#include "message.h"

enum lab_option_kind {
  LAB_OPTION_FLAG,  /* value: int *, set to 1 */
  LAB_OPTION_TEXT,  /* value: const char **, points into argv */
  LAB_OPTION_COUNT, /* value: int *, a whole number in lower..upper */
  LAB_OPTION_REAL,  /* value: double *, a number in lower..upper */
  LAB_OPTION_TEXTS  /* value: lab_texts *; may be given many times */
};

enum { LAB_TEXTS_MAX = 64 };

typedef struct lab_texts {
  int n;
  const char *text[LAB_TEXTS_MAX]; /* point into argv */
} lab_texts;

/* A row of a program's own table; the last row has name NULL. */
typedef struct lab_option {
  const char *name;     /* without the dashes */
  int kind;             /* enum lab_option_kind */
  void *value;          /* where it goes; keeps what is there if the option is not given */
  const char *argument; /* word for the argument in the usage text; NULL for a flag */
  const char *help;     /* a line, or several */
  double lower, upper;  /* bounds of a number */
} lab_option;

typedef struct lab_program {
  const char *name;
  const char *operands;     /* "MODEL.cfg LOG.csv", for the usage text */
  const char *what;         /* what the program does, a sentence or more */
  const lab_option *option; /* its own table */
  int min_operands, max_operands;
} lab_program;

typedef struct lab_cli {
  int quiet;
  int threads; /* 0: as many as the machine has */
  int done;    /* not 0: --help or --version has been answered, nothing is left to do */
  int n_operands;
  char **operand; /* points into argv */
} lab_cli;

/* Read a command line; sets the number of OpenMP threads. Options may stand before, between and after operands.
 * Out:     cli, and the values of program->option
 * Returns: LAB_OK; LAB_USAGE naming the option at fault and the nearest known one. */
int lab_cli_read(const lab_program *program, int argc, char **argv, lab_cli *cli, lab_error *error);

/* The whole of a program: signals end it with no file half-written, its command line is read, `run` does the work.
 * Returns: its exit status, with the error told on stderr. */
int lab_cli_main(const lab_program *program, int argc, char **argv, int (*run)(const lab_cli *cli, lab_error *error));

/* Write an error to stderr as "program: text".  Returns: its status, the exit status of the program. */
int lab_cli_report(const lab_program *program, const lab_error *error);

#endif

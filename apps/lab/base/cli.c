#include "cli.h"

#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "../../../lib/pneu.h"
#include "interrupt.h"
#include "names.h"

enum { OPTION_MAX = 32, THREADS_MAX = 1024 };

/* What every program takes, and then its own. */
struct table {
  int help, version;
  int n;
  lab_option row[OPTION_MAX];
};

static void fill(struct table *table, const lab_program *program, lab_cli *cli)
{
  const lab_option shared[] = {
      {"threads", LAB_OPTION_COUNT, &cli->threads, "N", "threads to use; default: all of the machine", 1, THREADS_MAX},
      {"quiet", LAB_OPTION_FLAG, &cli->quiet, NULL, "no progress on stderr", 0, 0},
      {"help", LAB_OPTION_FLAG, &table->help, NULL, "show this text", 0, 0},
      {"version", LAB_OPTION_FLAG, &table->version, NULL, "show the version", 0, 0},
  };
  const lab_option *own = program->option;
  size_t i;
  table->help = table->version = table->n = 0;
  while (own && own->name && table->n < OPTION_MAX - 4)
    table->row[table->n++] = *own++;
  for (i = 0; i < sizeof shared / sizeof shared[0]; i++)
    table->row[table->n++] = shared[i];
}

/* Row of the option --out, which -o stands for in every program that has it; -1: there is none. */
static int row_of_out(const struct table *table)
{
  return lab_name_index("out", table->row, (size_t)table->n, sizeof table->row[0]);
}

/* Every line of a text in its column. */
static void print_help(const char *head, const char *text)
{
  for (; text; head = "") {
    const char *end = strchr(text, '\n');
    printf("  %-20s %.*s\n", head, end ? (int)(end - text) : (int)strlen(text), text);
    text = end ? end + 1 : NULL;
  }
}

static void print_usage(const lab_program *program, const struct table *table)
{
  int i;
  printf("Usage: %s %s [OPTION ...]\n%s\n\n", program->name, program->operands, program->what);
  for (i = 0; i < table->n; i++) {
    const lab_option *row = &table->row[i];
    char head[64];
    snprintf(head, sizeof head, "--%s%s%s", row->name, row->argument ? " " : "", row->argument ? row->argument : "");
    print_help(head, row->help);
  }
  if (row_of_out(table) >= 0)
    puts("\n-o is short for --out.");
  printf("\nExit status: 0 done, 1 data or configuration at fault, 2 usage, 3 numerical failure, 4 no disk, permission "
         "or memory.\nCtrl-C ends it by the signal, 130 in a shell, with every file whole or absent.\n");
}

static int set_number(const lab_option *row, const char *text, lab_error *error)
{
  const int is_whole = row->kind == LAB_OPTION_COUNT;
  char *end;
  const double value = strtod(text, &end);
  if (end == text || *end || !(value >= row->lower && value <= row->upper) || (is_whole && value != floor(value)))
    return lab_fail(error, LAB_USAGE, "--%s: expected a %snumber, %g to %g, found \"%s\"", row->name,
                    is_whole ? "whole " : "", row->lower, row->upper, text);
  if (is_whole)
    *(int *)row->value = (int)value;
  else
    *(double *)row->value = value;
  return LAB_OK;
}

static int add_text(const lab_option *row, const char *argument, lab_error *error)
{
  lab_texts *texts = row->value;
  if (texts->n == LAB_TEXTS_MAX)
    return lab_fail(error, LAB_USAGE, "--%s: given more than %d times", row->name, (int)LAB_TEXTS_MAX);
  texts->text[texts->n++] = argument;
  return LAB_OK;
}

static int set_option(const lab_option *row, const char *argument, lab_error *error)
{
  switch (row->kind) {
  case LAB_OPTION_FLAG:
    *(int *)row->value = 1;
    return LAB_OK;
  case LAB_OPTION_TEXT:
    *(const char **)row->value = argument;
    return LAB_OK;
  case LAB_OPTION_TEXTS:
    return add_text(row, argument, error);
  default:
    return set_number(row, argument, error);
  }
}

/* getopt_long's '?' and ':' in words. */
static int bad_option(const struct table *table, int code, const char *text, lab_error *error)
{
  if (code == ':')
    return lab_fail(error, LAB_USAGE, "%s: expected an argument after it", text);
  if (optopt > 0)
    return lab_fail(error, LAB_USAGE, "%s: takes no argument, or is not known; see --help", text);
  return lab_fail(error, LAB_USAGE, "%s: unknown or ambiguous option; the nearest known one is --%s", text,
                  lab_name_nearest(text + strspn(text, "-"), table->row, (size_t)table->n, sizeof table->row[0]));
}

static int read_options(struct table *table, int argc, char **argv, lab_error *error)
{
  struct option longs[OPTION_MAX + 1];
  const int out = row_of_out(table);
  int i, code, row;
  memset(longs, 0, sizeof longs);
  for (i = 0; i < table->n; i++) {
    longs[i].name = table->row[i].name;
    longs[i].has_arg = table->row[i].kind == LAB_OPTION_FLAG ? no_argument : required_argument;
  }
  optind = 0; /* start afresh */
  opterr = 0;
  while ((code = getopt_long(argc, argv, out >= 0 ? ":o:" : ":", longs, &row)) != -1) {
    if (code == 'o')
      row = out;
    else if (code != 0)
      return bad_option(table, code, argv[optind - 1], error);
    if (set_option(&table->row[row], optarg, error))
      return error->status;
  }
  return LAB_OK;
}

/* --help and --version; results go to stdout. */
static int answer(const lab_program *program, const struct table *table)
{
  if (table->help)
    print_usage(program, table);
  else if (table->version)
    printf("%s (libpneu) %s\n", program->name, PNEU_VERSION);
  return table->help || table->version;
}

int lab_cli_read(const lab_program *program, int argc, char **argv, lab_cli *cli, lab_error *error)
{
  struct table table;
  memset(cli, 0, sizeof *cli);
  fill(&table, program, cli);
  if (read_options(&table, argc, argv, error))
    return error->status;
  cli->done = answer(program, &table);
  cli->n_operands = argc - optind;
  cli->operand = argv + optind;
  if (!cli->done && (cli->n_operands < program->min_operands || cli->n_operands > program->max_operands))
    return lab_fail(error, LAB_USAGE, "expected %s, found %d operands; see --help", program->operands, cli->n_operands);
#ifdef _OPENMP
  if (cli->threads > 0)
    omp_set_num_threads(cli->threads);
#endif
  return LAB_OK;
}

int lab_cli_report(const lab_program *program, const lab_error *error)
{
  fprintf(stderr, "%s: %s\n", program->name, error->text);
  return error->status;
}

int lab_cli_main(const lab_program *program, int argc, char **argv, int (*run)(const lab_cli *cli, lab_error *error))
{
  lab_error error;
  lab_cli cli;
  int status;
  lab_interrupt_catch();
  status = lab_cli_read(program, argc, argv, &cli, &error);
  if (status == LAB_OK && !cli.done)
    status = run(&cli, &error);
  return status == LAB_OK ? LAB_OK : lab_cli_report(program, &error);
}

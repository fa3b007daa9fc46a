#include "report_paper.h"

#include <string.h>

#include "reporttext.h"
#include "tableread.h"

/* Kinds of disagreement, as paper_causes.def has them. */
static const struct {
  const char *kind, *words;
} kinds[] = {{"arithmetic", "a number, sign or symbol that what it is taken from does not give"},
             {"derivation", "a step or a limit that does not follow, or is used where it does not hold"},
             {"data", "given numbers that contradict each other or the actuator, most of them in Table A1"},
             {"modelling", "what the model itself leaves out or takes for something else"}};

enum { KINDS = sizeof kinds / sizeof *kinds };

static int disagrees(const table *t, size_t row)
{
  return !strcmp(table_text(t, row, "agrees"), "no");
}

static int is_printed(const table *t, size_t row)
{
  return *table_text(t, row, "printed") != 0;
}

/* Whether no row above has the same cause. */
static int is_first_of_cause(const table *t, size_t row)
{
  const char *cause = table_text(t, row, "cause");
  size_t i;
  for (i = 0; i < row; i++)
    if (disagrees(t, i) && !strcmp(table_text(t, i, "cause"), cause))
      return 0;
  return 1;
}

/* Statements that disagree, those of them with a number in print, and their distinct causes. */
typedef struct tally {
  unsigned long rows, printed, causes;
} tally;

/* Over the rows whose `column` reads `text`; every row if column is NULL. */
static tally count(const table *t, const char *column, const char *text)
{
  tally n = {0, 0, 0};
  size_t row;
  for (row = 0; row < table_rows(t); row++)
    if (disagrees(t, row) && (!column || !strcmp(table_text(t, row, column), text))) {
      n.rows++;
      n.printed += (unsigned long)is_printed(t, row);
      n.causes += (unsigned long)is_first_of_cause(t, row);
    }
  return n;
}

static void write_kinds(FILE *file, const table *t)
{
  const tally all = count(t, NULL, NULL);
  int k;
  fprintf(file,
          "## Where the paper and its equations disagree\n\nOf %lu statements that can be recomputed %lu do not agree "
          "([paper_numbers.csv](paper_numbers.csv)): %lu with a number in print, %lu\nclaims in words or matters of "
          "form. They are of four kinds and come from %lu causes; one cause may show in many statements.\n\n"
          "| kind | what it is | causes | statements | with a number in print |\n|---|---|---|---|---|\n",
          (unsigned long)table_rows(t), all.rows, all.printed, all.rows - all.printed, all.causes);
  for (k = 0; k < KINDS; k++) {
    const tally n = count(t, "kind", kinds[k].kind);
    fprintf(file, "| %s | %s | %lu | %lu | %lu |\n", kinds[k].kind, kinds[k].words, n.causes, n.rows, n.printed);
  }
}

static void write_causes(FILE *file, const table *t)
{
  size_t row;
  int k;
  fputs("\n| cause | kind | statements |\n|---|---|---|\n", file);
  for (k = 0; k < KINDS; k++)
    for (row = 0; row < table_rows(t); row++)
      if (disagrees(t, row) && is_first_of_cause(t, row) && !strcmp(table_text(t, row, "kind"), kinds[k].kind)) {
        const char *cause = table_text(t, row, "cause");
        fprintf(file, "| %s | %s | %lu |\n", cause, kinds[k].kind, count(t, "cause", cause).rows);
      }
}

static void write_printed(FILE *file, const table *t)
{
  size_t row;
  fputs("\nThose with a number in print:\n\n| item | kind | printed | computed | why |\n|---|---|---|---|---|\n", file);
  for (row = 0; row < table_rows(t); row++)
    if (disagrees(t, row) && is_printed(t, row)) {
      const char *unit = table_text(t, row, "unit");
      if (!strcmp(unit, "1"))
        unit = "";
      fprintf(file, "| %s | %s | %.4g %s | %.4g %s | %s |\n", table_text(t, row, "item"), table_text(t, row, "kind"),
              table_number(t, row, "printed"), unit, table_number(t, row, "computed"), unit,
              table_text(t, row, "note"));
    }
  fputc('\n', file);
}

int report_paper(const study *s, FILE *file, lab_error *error)
{
  table t;
  if (table_load(s, "paper_numbers.csv", &t, error) == LAB_OK) {
    write_kinds(file, &t);
    write_causes(file, &t);
    write_printed(file, &t);
  }
  table_close(&t);
  return error->status;
}

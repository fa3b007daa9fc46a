#include "rigterm.h"

#include <math.h>
#include <string.h>

#include "../base/config.h"
#include "../base/number.h"
#include "../base/units.h"

#define X(name, key, unit, text) {key, unit, "PNEU_TERM_" #name},
const lab_term_word lab_term_equations[PNEU_TERM_EQUATION_COUNT] = {PNEU_TERM_EQUATION_LIST(X)};
#undef X
#define X(name, key, unit, text) {key, unit, "PNEU_TERM_OVER_" #name},
const lab_term_word lab_term_arguments[PNEU_TERM_ARGUMENT_COUNT] = {PNEU_TERM_ARGUMENT_LIST(X)};
#undef X

/* ---- Reading ---- */

enum { EQUATION, ARGUMENT, FROM, TO, VALUES, UNIT, KEYS };
static const char *const keys[KEYS] = {"equation", "argument", "from", "to", "values", "unit"};

static int read_ends(const config_setting_t *const member[KEYS], pneu_term *term, lab_error *error)
{
  const char *unit = lab_term_arguments[term->argument].unit;
  double from, to;
  if (lab_config_quantity(member[FROM], unit, -INFINITY, INFINITY, &from, error) ||
      lab_config_quantity(member[TO], unit, -INFINITY, INFINITY, &to, error))
    return error->status;
  if (!(from < to))
    return lab_config_fail(member[TO], error, "expected more than from, which is %g %s, found %g %s", from, unit, to,
                           unit);
  term->from = (pneu_real)from;
  term->to = (pneu_real)to;
  return LAB_OK;
}

/* Numbers in the unit given beside them, by default in SI; or texts with units of their own. */
static int read_values(const config_setting_t *const member[KEYS], pneu_term *term, lab_error *error)
{
  const char *si = lab_term_equations[term->equation].unit, *unit = si;
  double scale, offset;
  int i;
  if (PNEU_TERM_KNOTS < 2)
    return lab_config_fail(member[VALUES], error, "this build of the library has no free terms");
  if (lab_config_list(member[VALUES], 2, PNEU_TERM_KNOTS, error))
    return error->status;
  if (member[UNIT] && !(unit = config_setting_get_string(member[UNIT])))
    return lab_config_expected(member[UNIT], "a unit in quotes", error);
  if (lab_unit_factor(unit, si, &scale, &offset, error))
    return lab_config_fail_in(member[UNIT], error);
  term->n = config_setting_length(member[VALUES]);
  if (term->argument == PNEU_TERM_OVER_CYCLE && term->n % 2)
    return lab_config_expected(
        member[VALUES], "an even number of values, cosine and sine of the period, of its half and so on,", error);
  for (i = 0; i < term->n; i++) {
    double value;
    if (lab_config_difference(config_setting_get_elem(member[VALUES], (unsigned)i), unit, &value, error))
      return error->status;
    term->value[i] = (pneu_real)(value * scale);
  }
  return LAB_OK;
}

static int read_term(const config_setting_t *group, pneu_term *term, lab_error *error)
{
  const config_setting_t *member[KEYS];
  memset(term, 0, sizeof *term);
  if (lab_config_members(group, keys, KEYS, UNIT, member, error) ||
      lab_config_choice(member[EQUATION], lab_term_equations, PNEU_TERM_EQUATION_COUNT, sizeof lab_term_equations[0],
                        &term->equation, error) ||
      lab_config_choice(member[ARGUMENT], lab_term_arguments, PNEU_TERM_ARGUMENT_COUNT, sizeof lab_term_arguments[0],
                        &term->argument, error) ||
      read_ends(member, term, error))
    return error->status;
  return read_values(member, term, error);
}

int lab_terms_read(const config_setting_t *list, int max, pneu_term *term, int *n, lab_error *error)
{
  int status = lab_config_list(list, 0, max, error);
  for (*n = 0; status == LAB_OK && *n < config_setting_length(list); ++*n)
    status = read_term(config_setting_get_elem(list, (unsigned)*n), &term[*n], error);
  return status;
}

/* ---- Writing ---- */

/* Values with a comma between them, `width` to a line. An exponent keeps libconfig from taking a number for an int. */
static void write_values(FILE *file, const pneu_term *term, const char *before, int width, const char *line_end)
{
  int i;
  for (i = 0; i < term->n; i++)
    fprintf(file, "%s%s%.16e", i == 0 ? "" : i % width ? ", " : line_end, before, (double)term->value[i]);
}

void lab_terms_write(FILE *file, const pneu_term *term, int n)
{
  int i;
  for (i = 0; i < n; i++) {
    const lab_term_word *equation = &lab_term_equations[term[i].equation];
    const lab_term_word *argument = &lab_term_arguments[term[i].argument];
    char from[LAB_NUMBER_TEXT], to[LAB_NUMBER_TEXT];
    fprintf(file, "%s  { equation = \"%s\"; argument = \"%s\"; from = \"%s %s\"; to = \"%s %s\";\n    values = [ ",
            i ? ",\n" : "unlisted = (\n", equation->key, argument->key, lab_number_write((double)term[i].from, from),
            argument->unit, lab_number_write((double)term[i].to, to), argument->unit);
    write_values(file, &term[i], "", 4, ",\n               ");
    fputs(" ]; }", file);
  }
  if (n)
    fputs("\n);\n", file);
}

void lab_terms_print_c(FILE *file, const pneu_term *term, int n)
{
  int i;
  fprintf(file, "#define MODEL_N_TERMS %d\n", n);
  if (n)
    fputs("/* static const pneu_term term[] = MODEL_TERMS; pneu_model_terms(&model, term, MODEL_N_TERMS); */\n"
          "#define MODEL_TERMS \\\n  { \\\n",
          file);
  for (i = 0; i < n; i++) {
    char from[LAB_NUMBER_TEXT], to[LAB_NUMBER_TEXT];
    fprintf(file, "    { %s, %s, %d, (pneu_real)%s, (pneu_real)%s, /* %s over %s [%s] */ \\\n      { ",
            lab_term_equations[term[i].equation].constant, lab_term_arguments[term[i].argument].constant, term[i].n,
            lab_number_write((double)term[i].from, from), lab_number_write((double)term[i].to, to),
            lab_term_equations[term[i].equation].unit, lab_term_arguments[term[i].argument].key,
            lab_term_arguments[term[i].argument].unit);
    write_values(file, &term[i], "(pneu_real)", 3, ", \\\n        ");
    fprintf(file, " } }%s \\\n", i + 1 < n ? "," : "");
  }
  if (n)
    fputs("  }\n", file);
}

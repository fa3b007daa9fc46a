#include "report_hypotheses.h"

#include <math.h>
#include <string.h>

#include "reporttext.h"
#include "tableread.h"

/* The paper's own verdicts, section 7. */
static const struct {
  const char *name, *words, *paper;
} hypotheses[] = {{"H1", "directional action of the spring", "not confirmed"},
                  {"H2", "preload of the spring", "not confirmed"},
                  {"H3", "travel limiters", "not confirmed"},
                  {"H4", "place of the bench set", "not confirmed"},
                  {"H5", "unequal fill and vent", "not confirmed"},
                  {"H6", "different air processes when filling and venting", "confirmed"}};

enum { HYPOTHESES = sizeof hypotheses / sizeof *hypotheses };

/* ---- Verdicts ---- */

/* One cell: asymmetry with and without the cause.  Returns: whether the verdict is the paper's */
static int verdict_cell(FILE *file, const table *t, int h, const char *gas, const char *flow)
{
  int agrees = 0;
  size_t row;
  for (row = 0; row < table_rows(t); row++) {
    const char *verdict = table_text(t, row, "verdict");
    if (!report_is_law(t, row, gas, flow) || strcmp(table_text(t, row, "hypothesis"), hypotheses[h].name) != 0)
      continue;
    agrees = !strncmp(verdict, hypotheses[h].paper, strlen(hypotheses[h].paper));
    fprintf(file, " %.3f to %.3f: %s |", table_number(t, row, "asymmetry_base"),
            fabs(table_number(t, row, "asymmetry_without_cause")), verdict);
  }
  return agrees;
}

/* One line of the table.  Returns: in how many laws the verdict is the paper's */
static int verdict_line(const study *s, FILE *file, const table *t, int h)
{
  int g, f, agree = 0;
  fprintf(file, "| %s %s | %s |", hypotheses[h].name, hypotheses[h].words, hypotheses[h].paper);
  for (g = 0; g < s->n_gas; g++)
    for (f = 0; f < s->n_flow; f++)
      agree += verdict_cell(file, t, h, pneu_gas_key(s->gas[g]), pneu_flow_key(s->flow[f]));
  fputc('\n', file);
  return agree;
}

/* "words: H1 H2." of the hypotheses that agree in `least` to `most` laws; nothing where there is none. */
static void list_agreeing(FILE *file, const char *words, const int *agree, int least, int most)
{
  int h, any = 0;
  for (h = 0; h < HYPOTHESES; h++)
    if (agree[h] >= least && agree[h] <= most)
      fprintf(file, "%s %s", any++ ? "" : words, hypotheses[h].name);
  if (any)
    fputs(".\n", file);
}

static int verdicts(const study *s, FILE *file, lab_error *error)
{
  const int laws = s->n_gas * s->n_flow;
  int h, agree[HYPOTHESES];
  table t;
  if (table_load(s, "hypotheses.csv", &t, error) == LAB_OK) {
    fprintf(
        file,
        "## Six hypotheses in %d laws\n\nAsymmetry with the cause, and without it; confirmed where it falls below "
        "%.0f %% of its value. Asymmetry is the area\nbetween the two strokes, each scaled to unit time and travel, "
        "the falling one mirrored; 0 is the same shape.\nWhere several causes are confirmed each is tried alone "
        "too, with the others taken away.\n\n"
        "![Asymmetry with and without each cause](hypotheses.svg)\n\n| hypothesis | paper |",
        laws, 100 * s->confirmed_below);
    report_law_heads(s, file);
    report_rule(file, 2 + laws);
    for (h = 0; h < HYPOTHESES; h++)
      agree[h] = verdict_line(s, file, &t, h);
    fputc('\n', file);
    list_agreeing(file, "Verdicts that agree with the paper in every law:", agree, laws, laws);
    list_agreeing(file, "In some laws only:", agree, 1, laws - 1);
    list_agreeing(file, "In no law, the paper's own included:", agree, 0, 0);
    fputs("H4 takes nothing away where the bench set already lies in the middle of the supply range; the other "
          "actuators have tables\nof their own.\n\n",
          file);
  }
  table_close(&t);
  return error->status;
}

/* ---- Spring and air ---- */

/* " 0.125; 4.27 / 1.17 |" */
static void speed_cell(FILE *file, const table *t, size_t row)
{
  fprintf(file, " %.3f; %.2f / %.2f |", table_number(t, row, "asymmetry"), table_number(t, row, "rise_speed_ratio"),
          table_number(t, row, "fall_speed_ratio"));
}

/* Rows of an actuator in a law follow one another: both, without the spring, without the air process. */
static int spring_and_air(const study *s, FILE *file, lab_error *error)
{
  table t;
  size_t row;
  if (table_load(s, "spring_and_air.csv", &t, error) == LAB_OK) {
    fputs("### It takes both, the spring and the air\n\n"
          "The spring makes the pressure change along the travel; the air makes flow and volume depend on pressure and "
          "travel.\nNeither is enough. Under a constant load the pressure does not change during a stroke, and both "
          "strokes run at nearly\nconstant speed: two straight lines, whatever time each takes. With a linear "
          "symmetric air process the strokes of the spring\nbend, but mirror each other. In each cell: asymmetry; "
          "fastest over slowest velocity of the rise / of the fall, from 5 % to\n95 % of travel "
          "([spring_and_air.csv](spring_and_air.csv)).\n\n"
          "| actuator | law | spring and air | constant load, air | spring, linear symmetric air |\n"
          "|---|---|---|---|---|\n",
          file);
    for (row = 0; row + 2 < table_rows(&t); row += 3) {
      fprintf(file, "| %s | %s, %s |", table_text(&t, row, "actuator"), table_text(&t, row, "gas"),
              table_text(&t, row, "flow"));
      speed_cell(file, &t, row);
      speed_cell(file, &t, row + 1);
      speed_cell(file, &t, row + 2);
      fputc('\n', file);
    }
    fputc('\n', file);
  }
  table_close(&t);
  return error->status;
}

/* ---- H5 ---- */

/* Smallest and largest value met. */
typedef struct span {
  double low, high;
} span;

static const span no_span = {HUGE_VAL, -HUGE_VAL};

static void widen(span *of, double value)
{
  of->low = fmin(of->low, value);
  of->high = fmax(of->high, value);
}

/* Over the rows of H5 in the table of one actuator. */
static int durations_of(const study *s, int actuator, span *ratio, span *change, lab_error *error)
{
  char name[REPORT_NAME_TEXT];
  table t;
  size_t row;
  report_table_name(s, actuator, "hypotheses", name);
  if (table_load(s, name, &t, error) == LAB_OK)
    for (row = 0; row < table_rows(&t); row++)
      if (!strcmp(table_text(&t, row, "hypothesis"), "H5")) {
        widen(ratio, table_number(&t, row, "duration_ratio_base"));
        widen(change,
              fabs(table_number(&t, row, "asymmetry_without_cause") / table_number(&t, row, "asymmetry_base") - 1));
      }
  table_close(&t);
  return error->status;
}

static int durations(const study *s, FILE *file, lab_error *error)
{
  span change = no_span;
  int a;
  fputs("### H5: orifices set durations, not shapes\n\n"
        "Forces are as good as in balance throughout a stroke, so that another orifice makes it faster or slower and "
        "leaves its\nshape in unit time as it is. Asymmetry could not have confirmed H5, whatever the cause; that it "
        "stays is no finding. What\norifices set is durations. Table A1 has one orifice for both directions, and "
        "still fall over rise is",
        file);
  for (a = 0; a < s->n_actuators; a++) {
    span ratio = no_span;
    if (durations_of(s, a, &ratio, &change, error))
      return error->status;
    fprintf(file, "%s %.2f to %.2f (%s)", a ? "," : "", ratio.low, ratio.high, s->actuator[a].name);
  }
  fprintf(
      file,
      ";\nwith the vent sized for it it is 1, and asymmetry has moved by %.2g %% at most. Equal orifices do not make "
      "equal times,\nand equal times do not make equal shapes.\n\n",
      100 * change.high);
  return LAB_OK;
}

/* ---- H6 ---- */

/* Columns of attribution_cells.csv, as bits of a set. */
static const struct {
  const char *column, *words;
} parts[] = {{"density", "flow by upstream density"},
             {"volume", "volume that grows"},
             {"choking", "choking"},
             {"temperature", "temperature"},
             {"place", "place of the bench set"}};

enum { PARTS = sizeof parts / sizeof *parts, CELLS = 1 << PARTS };

static int set_of(const table *t, size_t row)
{
  int i, set = 0;
  for (i = 0; i < PARTS; i++)
    set |= (table_number(t, row, parts[i].column) > 0) << i;
  return set;
}

/* Asymmetry of every set of parts present, under one chamber law. */
static void read_cells(const table *t, const char *gas, double cell[CELLS])
{
  size_t row;
  int set;
  for (set = 0; set < CELLS; set++)
    cell[set] = (double)NAN;
  for (row = 0; row < table_rows(t); row++)
    if (!strcmp(table_text(t, row, "gas"), gas))
      cell[set_of(t, row)] = table_number(t, row, "asymmetry");
}

static int members(int set)
{
  int n = 0;
  for (; set; set &= set - 1)
    n++;
  return n;
}

/* The fewest parts that must go together before less than `below` of the asymmetry is left, as a set. */
static int fewest(const double cell[CELLS], double below)
{
  int gone, best = CELLS - 1;
  for (gone = 0; gone < CELLS; gone++)
    if (cell[(CELLS - 1) & ~gone] < below * cell[CELLS - 1] && members(gone) < members(best))
      best = gone;
  return best;
}

static void part_cells(FILE *file, const double cell[CELLS], double below)
{
  const double whole = cell[CELLS - 1];
  const int gone = fewest(cell, below);
  int i, any = 0;
  fprintf(file, " %.4f |", whole);
  for (i = 0; i < PARTS; i++)
    fprintf(file, " %.0f %% |", 100 * cell[(CELLS - 1) & ~(1 << i)] / whole);
  for (i = 0; i < PARTS; i++)
    if (gone >> i & 1)
      fprintf(file, "%s%s", any++ ? ", " : " ", parts[i].words);
  fputs(" |\n", file);
}

static int part_rows(const study *s, FILE *file, int actuator, double *check, lab_error *error)
{
  char name[REPORT_NAME_TEXT];
  double cell[CELLS];
  table t;
  int g;
  report_table_name(s, actuator, "attribution_cells", name);
  if (table_load(s, name, &t, error) == LAB_OK)
    for (g = 0; g < s->n_gas; g++) {
      read_cells(&t, pneu_gas_key(s->gas[g]), cell);
      fprintf(file, "| %s | %s |", s->actuator[actuator].name, pneu_gas_key(s->gas[g]));
      part_cells(file, cell, s->confirmed_below);
      *check = fmax(*check, cell[0]);
    }
  table_close(&t);
  return error->status;
}

static int air_parts(const study *s, FILE *file, lab_error *error)
{
  double check = 0;
  int a, i;
  fprintf(file,
          "### H6: one part of the air process at a time\n\nHow much of the asymmetry is left when one part is taken "
          "away and the others stay, and the fewest parts that must go\ntogether before less than %.0f %% is left "
          "([attribution_cells.csv](attribution_cells.csv), choked flow with everything present).\n\n"
          "| actuator | chamber law | asymmetry |",
          100 * s->confirmed_below);
  for (i = 0; i < PARTS; i++)
    fprintf(file, " without %s |", parts[i].words);
  fputs(" fewest that must go together |\n", file);
  report_rule(file, 4 + PARTS);
  for (a = 0; a < s->n_actuators; a++)
    if (part_rows(s, file, a, &check, error))
      return error->status;
  fprintf(file,
          "\nWith all of them taken away, as in the row H6 above, rise and fall obey the same linear equation, and two "
          "strokes alike\nare what it must give, under every law, for the laws are what has been taken away. The %.0e "
          "that is left at most says\nthat the measure is sound; it says nothing on the actuator.\n\n",
          check);
  return LAB_OK;
}

int report_hypotheses(const study *s, FILE *file, lab_error *error)
{
  if (verdicts(s, file, error) || spring_and_air(s, file, error) || durations(s, file, error))
    return error->status;
  return air_parts(s, file, error);
}

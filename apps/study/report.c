#include "report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../lab/base/outfile.h"
#include "report_hypotheses.h"
#include "report_paper.h"
#include "reporttext.h"
#include "tableread.h"

static void introduction(const study *s, FILE *file)
{
  const lab_rig *rig = &s->actuator[s->subject];
  fprintf(file,
          "# The asymmetry of a single-acting actuator, re-examined\n\n"
          "Made by `make study`; every number comes from a table in this folder. The paper is M. Bartys, \"Dynamics of "
          "single-action\npneumatic actuators\"; what its equations imply where it prints something else is derived in "
          "[PAPER.md](../study/PAPER.md).\nThe subject is the %s with the parameters of Table A1 as printed.\n\n"
          "![Large step up and down](fig13.svg)\n\n",
          rig->name);
}

static int attribution_rows(const study *s, FILE *file, int actuator, lab_error *error)
{
  const char *name = s->actuator[actuator].name;
  char path[REPORT_NAME_TEXT];
  table t;
  size_t row;
  report_table_name(s, actuator, "attribution", path);
  if (table_load(s, path, &t, error) == LAB_OK)
    for (row = 0; row < table_rows(&t); row++)
      if (strcmp(table_text(&t, row, "cause"), "remainder") != 0) /* a check of the measure, told before */
        fprintf(file, "| %s | %s | %s | %.1f %% | %.4f | %.4f | %.4f |\n", name, table_text(&t, row, "gas"),
                table_text(&t, row, "cause"), 100 * table_number(&t, row, "share"), table_number(&t, row, "shapley"),
                table_number(&t, row, "asymmetry_alone"), table_number(&t, row, "asymmetry_without"));
  table_close(&t);
  return error->status;
}

static int attribution(const study *s, FILE *file, lab_error *error)
{
  int a;
  fputs(
      "## Which part of the air process\n\nShapley shares of the asymmetry over all combinations of the causes, from "
      "the nozzle flow with everything present\nto a linear symmetric conductance into a constant isothermal volume. "
      "A negative share makes the strokes more alike.\nCauses that bend the strokes in opposite ways hide each other: "
      "\"alone\" has the cause as the only one present, \"without\" as the only one removed.\n\n"
      "![Shares of the causes](attribution.svg)\n\n| actuator | chamber law | cause | share | Shapley value | alone | "
      "without |\n|---|---|---|---|---|---|---|\n",
      file);
  for (a = 0; a < s->n_actuators; a++)
    if (attribution_rows(s, file, a, error))
      return error->status;
  fputc('\n', file);
  return LAB_OK;
}

/* "holds when ..." is too long for a column; the condition is in the table. */
static const char *short_verdict(const char *verdict)
{
  return !strncmp(verdict, "holds when", 10) ? "holds when ..." : verdict;
}

static int conclusions(const study *s, FILE *file, lab_error *error)
{
  int i, g, f;
  size_t row;
  table t;
  if (table_load(s, "conclusions.csv", &t, error) == LAB_OK) {
    fputs("## Eighteen conclusions\n\nThe conditions of \"holds when\" and the evidence for each are in "
          "[conclusions.csv](conclusions.csv).\n\n| conclusion |",
          file);
    report_law_heads(s, file);
    report_rule(file, 1 + s->n_gas * s->n_flow);
    for (i = 1; i <= 18; i++) {
      fprintf(file, "| %d |", i);
      for (g = 0; g < s->n_gas; g++)
        for (f = 0; f < s->n_flow; f++)
          for (row = 0; row < table_rows(&t); row++)
            if (atoi(table_text(&t, row, "conclusion")) == i &&
                report_is_law(&t, row, pneu_gas_key(s->gas[g]), pneu_flow_key(s->flow[f])))
              fprintf(file, " %s |", short_verdict(table_text(&t, row, "verdict")));
      fputc('\n', file);
    }
    fputc('\n', file);
  }
  table_close(&t);
  return error->status;
}

/* One cell: four digits where it is a number. */
static void cell(FILE *file, const char *text)
{
  char *end;
  const double value = strtod(text, &end);
  if (end != text && !*end)
    fprintf(file, " %.4g |", value);
  else
    fprintf(file, " %s |", text);
}

enum { COLUMNS = 11 };

/* A table to show, where it exists: its columns by name, and words around it. */
typedef struct shown {
  const char *file, *before;
  const char *column[COLUMNS];               /* names in the file; NULL ends */
  void (*after)(const table *t, FILE *file); /* may be NULL */
} shown;

/* Smallest and largest value of a column over the rows whose source is, or is not, the one named. */
static void column_span(const table *t, const char *column, const char *source, int same, double *low, double *high)
{
  size_t row;
  *low = HUGE_VAL;
  *high = -HUGE_VAL;
  for (row = 0; row < table_rows(t); row++)
    if ((strcmp(table_text(t, row, "source"), source) == 0) == same) {
      *low = fmin(*low, table_number(t, row, column));
      *high = fmax(*high, table_number(t, row, column));
    }
}

/* What the two pairs of steps have in common, and what not. */
static void compare_steps(const table *t, FILE *file)
{
  static const struct {
    const char *column, *words;
  } compared[] = {{"asymmetry", "Asymmetry, by the measure used above"}, {"duration_ratio", "Fall over rise"}};
  size_t i;
  for (i = 0; i < sizeof compared / sizeof *compared; i++) {
    double low, high, model_low, model_high;
    column_span(t, compared[i].column, "measured", 1, &low, &high);
    column_span(t, compared[i].column, "measured", 0, &model_low, &model_high);
    fprintf(file, "- %s: measured %.3f to %.3f, models %.3f to %.3f.\n", compared[i].words, low, high, model_low,
            model_high);
  }
  fputs(
      "\nThe measured pair is asymmetric in shape as much as the models are; but its fall is the faster stroke, where "
      "theirs is the slower\none, and both of its strokes are nearer a first-order lag than an integrator "
      "([edges](measured_damadics_edges.csv)).\n\n",
      file);
}

static void show(const study *s, FILE *file, const shown *what)
{
  lab_error ignored;
  table t;
  size_t row;
  int i;
  if (table_load(s, what->file, &t, &ignored) == LAB_OK) {
    fprintf(file, "%s\n\n|", what->before);
    for (i = 0; i < COLUMNS && what->column[i]; i++)
      fprintf(file, " %s |", what->column[i]);
    fputc('\n', file);
    report_rule(file, i);
    for (row = 0; row < table_rows(&t); row++) {
      fputc('|', file);
      for (i = 0; i < COLUMNS && what->column[i]; i++)
        cell(file, table_text(&t, row, what->column[i]));
      fputc('\n', file);
    }
    fputc('\n', file);
    if (what->after)
      what->after(&t, file);
  }
  table_close(&t);
}

static const shown tables[] = {
    {"measured_vessel.csv",
     "## Measured: a vessel blows down through an orifice\n\n![Vessel](measured_vessel.svg)\n\nEffective area Ca in "
     "mm2 "
     "and discharge coefficient Cd of a 2.71 mm hole (the file that comes with the data says 0.84), rms of pressure in "
     "kPa\n(as fitted; each point left out in turn), rms of the gas temperature in K, which is predicted except where "
     "`fitted_to` says so;\nn is the exponent of the gas, empty for an energy balance. A fitted n at its bound is no "
     "finding of its own: the row repeats that of the bound.\nWhat remains is described in "
     "`apps/study/measured_vessel.h`: thermometer lag or mixing, "
     "and "
     "an orifice whose coefficient falls with pressure.",
     {"law", "what", "fitted_to", "Ca", "Cd_of_2.71_mm", "rmse_p", "rmse_p_left_out", "rmse_T", "n", "remark"},
     NULL},
    {"measured_damadics_static.csv",
     "## Measured: a spring-and-diaphragm servomotor\n\n![Servomotor](measured_damadics.svg)\n\nStatic loop by the "
     "balance of forces alone; rms in kPa, as fitted and on alternate points held out. Kept: friction that grows with\n"
     "position and a hardening spring. All three terms fit better with an area that would have to grow by a quarter, "
     "which is not believed.",
     {"law", "parameters", "added_terms", "rmse", "rmse_held_out"},
     NULL},
    {"measured_damadics_steps.csv",
     "Its two step responses beside the 37-13 of the paper, which is another actuator of type 37.",
     {"source", "gas", "flow", "rise_time", "fall_time", "duration_ratio", "asymmetry", "rise_lag_T", "fall_ramp_T",
      "note"},
     compare_steps},
    {"agreement.csv",
     "## Can these numbers be trusted\n\nThe library's stepper at 1e-8 against CVODE at 1e-12 on the standard "
     "experiment, and the balances of mass and energy.",
     {"actuator", "gas", "flow", "position_gap_over_stroke", "pressure_gap_over_supply", "mass_gap", "energy_gap"},
     NULL}};

static int write_report(const study *s, FILE *file, lab_error *error)
{
  size_t i;
  error->status = LAB_OK;
  introduction(s, file);
  if (report_hypotheses(s, file, error) || attribution(s, file, error) || conclusions(s, file, error) ||
      report_paper(s, file, error))
    return error->status;
  for (i = 0; i < sizeof tables / sizeof *tables; i++)
    show(s, file, &tables[i]);
  return LAB_OK;
}

int report_make(const study *s, lab_error *error)
{
  char path[STUDY_PATH_TEXT + 16];
  lab_outfile out;
  snprintf(path, sizeof path, "%s/REPORT.md", s->results);
  if (lab_out_open(&out, path, error))
    return error->status;
  if (write_report(s, out.file, error)) {
    lab_out_abandon(&out);
    return error->status;
  }
  if (lab_out_close(&out, error))
    return error->status;
  study_note_saved(s, "REPORT.md");
  return LAB_OK;
}

/* sweep: the study of a study file: tables, figures, report.
 * SPDX-License-Identifier: MIT */
#include <stdio.h>
#include <string.h>

#include <unistd.h>

#include "lab/base/cli.h"
#include "study/products.h"

/* Where make install puts the study. */
#ifndef SWEEP_INSTALLED
#define SWEEP_INSTALLED "/usr/local/share/pneu/study"
#endif

static int force, no_figures;
static const char *results;

static const lab_option options[] = {
    {"force", LAB_OPTION_FLAG, &force, NULL, "make everything again, not only what is missing or outdated", 0, 0},
    {"no-figures", LAB_OPTION_FLAG, &no_figures, NULL, "tables and report only, without gnuplot", 0, 0},
    {"results", LAB_OPTION_TEXT, &results, "DIR", "write there instead of the folder that the study file names", 0, 0},
    {NULL, 0, NULL, NULL, NULL, 0, 0}};

static const lab_program program = {
    "sweep",
    "STUDY.cfg",
    "Run a study: the hypotheses on the asymmetry of a single-acting actuator, in every chamber and flow law, with "
    "tables (CSV), figures (SVG) and a report. A bare name that is not a file is looked up in study/, and then in the "
    "installed study.",
    options,
    1,
    1};

/* A bare name that is not a file is looked up in study/, in the working directory and where it is installed. */
static const char *find_study(const char *name, char *path, size_t size)
{
  static const char *const folders[] = {"study", SWEEP_INSTALLED};
  size_t i;
  if (access(name, F_OK) == 0 || strchr(name, '/'))
    return name;
  for (i = 0; i < sizeof folders / sizeof *folders; i++) {
    snprintf(path, size, "%s/%s", folders[i], name);
    if (access(path, F_OK) == 0)
      return path;
  }
  return name;
}

static int sweep(const lab_cli *cli, lab_error *error)
{
  static study s;
  char path[STUDY_PATH_TEXT];
  const study_run run = {force, cli->quiet, !no_figures};
  if (study_read(find_study(cli->operand[0], path, sizeof path), &s, error))
    return error->status;
  if (results && snprintf(s.results, sizeof s.results, "%s", results) >= (int)sizeof s.results)
    return lab_fail(error, LAB_USAGE, "--results: path is too long");
  return products_make(&s, &run, error);
}

int main(int argc, char **argv)
{
  return lab_cli_main(&program, argc, argv, sweep);
}

/* export-fmu: a model file as an FMU, for Simulink, Dymola, FMPy and others.
 *
 * The FMU's shared library is compiled when export-fmu is, once for each version of FMI, and carried inside together
 * with its sources. An export puts the model's numbers into the place that the library keeps for them, and the same
 * numbers into a header among the sources, for importers that compile on another platform. So it needs neither a
 * compiler nor any file but the model's, and the same model gives the same bytes. SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdio.h>

#include "fmu/export.h"
#include "lab/base/cli.h"

static const char *out_path;
static int fmi = 3;

static const lab_option options[] = {
    {"out", LAB_OPTION_TEXT, &out_path, "FILE", "write there instead of to <name of the actuator>.fmu", 0, 0},
    {"fmi", LAB_OPTION_COUNT, &fmi, "N", "version of FMI: 2 or 3; default: 3", 2, 3},
    {NULL, 0, NULL, NULL, NULL, 0, 0}};

static const lab_program program = {
    "export-fmu", "MODEL.cfg", "Write the model in MODEL.cfg as an FMU for model exchange and co-simulation.",
    options,      1,           1};

static int run(const lab_cli *cli, lab_error *error)
{
  lab_rig file, rig;
  pneu_model model;
  if (lab_rig_read(cli->operand[0], &file, error))
    return error->status;
  lab_rig_at(&file, INFINITY, &rig);
  if (lab_rig_model(&rig, &model, error))
    return error->status;
  if (model.position_skew != 0)
    fprintf(stderr, "%s: note: %s: channel_skew is the recorder's; the FMU shows the position as it is\n", program.name,
            cli->operand[0]);
  return fmu_export(&rig, fmi, out_path, error);
}

int main(int argc, char **argv)
{
  return lab_cli_main(&program, argc, argv, run);
}

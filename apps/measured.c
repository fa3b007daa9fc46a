/* measured: closeloop on every measured set, and one report over all.
 * SPDX-License-Identifier: MIT */
#include <stdio.h>

#include "lab/base/cli.h"
#include "lab/base/config.h"
#include "study/sets.h"

static const lab_option options[] = {{NULL, 0, NULL, NULL, NULL, 0, 0}};

static const lab_program program = {
    "measured", "SETS.cfg", "Run closeloop on measured sets and write results/measured/REPORT.md.", options, 1, 1};

static int run(const lab_cli *cli, lab_error *error)
{
  static sets_result result[SETS_MAX];
  config_t config;
  const char *path = cli->operand[0];
  int i, n = 0, there = 0, status = lab_config_read(&config, path, error);
  if (status == LAB_OK) {
    const config_setting_t *list = config_lookup(&config, "sets");
    status = list ? sets_run(list, sets_data_folder(), "results/measured", result, &n, error)
                  : lab_fail(error, LAB_DATA, "%s: expected the list sets", path);
  }
  for (i = 0; i < n; i++)
    there += result[i].state != SETS_ABSENT;
  if (status == LAB_OK && there > 0)
    status = sets_report(result, n, "results/measured", error);
  config_destroy(&config);
  return status;
}

int main(int argc, char **argv)
{
  return lab_cli_main(&program, argc, argv, run);
}

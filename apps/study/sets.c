#include "sets.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../lab/base/config.h"
#include "../lab/base/text.h"
#include "replicates.h"

enum { PATH_BYTES = 1024, LOGS_MAX = SETS_LOGS_MAX };

static int check_set(const config_setting_t *set, lab_error *error)
{
  static const char *const needed[] = {"name", "rig",      "title",       "folder", "judged",
                                       "unit", "declared", "independent", "remains"};
  size_t i;
  for (i = 0; i < sizeof needed / sizeof *needed; i++)
    if (!*sets_text(set, needed[i]))
      return lab_config_fail(set, error, "expected the text %s", needed[i]);
  if (!lab_config_member(set, "fit") || !lab_config_member(set, "holdout"))
    return lab_config_fail(set, error, "expected the lists fit and holdout");
  if (sets_channel(sets_text(set, "judged")) < 0)
    return lab_config_fail(set, error, "judged: %s is no channel", sets_text(set, "judged"));
  if (*sets_text(set, "sensor") && sets_channel(sets_text(set, "check")) < 0)
    return lab_config_fail(set, error, "sensor needs a channel as check, found \"%s\"", sets_text(set, "check"));
  return LAB_OK;
}

static void name_log(const config_setting_t *set, const char *data_dir, const char *log, char path[PATH_BYTES])
{
  snprintf(path, PATH_BYTES, "%s/%s/%s", data_dir, sets_text(set, "folder"), log);
}

/* Paths of a list of logs, one behind the other, `mark` in between.  Returns: 0 if one is not there. */
static int list_logs(const config_setting_t *set, const char *list, const char *data_dir, char mark, char *text)
{
  const config_setting_t *logs = lab_config_member(set, list);
  int i, there = 1;
  for (i = 0; i < config_setting_length(logs) && i < LOGS_MAX; i++) {
    char *path = text + strlen(text);
    name_log(set, data_dir, config_setting_get_string_elem(logs, i), path);
    there &= access(path, R_OK) == 0;
    path += strlen(path);
    path[0] = mark;
    path[1] = '\0';
  }
  return there;
}

/* Run a program and wait for its end.  Returns: whether it did what it should. */
static int run(const char *const *words)
{
  int how = 1;
  const pid_t child = fork();
  if (child == 0) {
    execv(words[0], (char *const *)words);
    _exit(127);
  }
  return child > 0 && waitpid(child, &how, 0) == child && how == 0;
}

/* closeloop --figures --budget SECONDS --out DIR --holdout A,B RIG LOGS; so long that no answer depends on the machine
 */
static int run_set(const config_setting_t *set, const char *data_dir, const char *out_dir)
{
  static char fit[LOGS_MAX * (PATH_BYTES + 1)], held[LOGS_MAX * (PATH_BYTES + 1)];
  char rig[PATH_BYTES], out[PATH_BYTES];
  const char *words[11 + LOGS_MAX] = {"./closeloop", "--quiet", "--figures", "--budget", "3600",
                                      "--out",       out,       "--holdout", held,       rig};
  fit[0] = held[0] = '\0';
  if (!list_logs(set, "fit", data_dir, '\n', fit) || !list_logs(set, "holdout", data_dir, ',', held)) {
    fprintf(stderr, "%s: data absent below %s; study/measured/fetch.sh loads what can be had\n", sets_text(set, "name"),
            data_dir);
    return SETS_ABSENT;
  }
  snprintf(rig, sizeof rig, "study/measured/%s", sets_text(set, "rig"));
  snprintf(out, sizeof out, "%s/%s", out_dir, sets_text(set, "name"));
  lab_split(fit, '\n', words + 10, LOGS_MAX);
  printf("%s: ", sets_text(set, "name"));
  fflush(stdout);
  return run(words) ? SETS_DONE : SETS_FAILED;
}

static int measure_repeat(sets_result *result, const char *data_dir, lab_error *error)
{
  char rig[PATH_BYTES];
  result->repeat = (double)NAN;
  if (result->state == SETS_ABSENT)
    return LAB_OK;
  snprintf(rig, sizeof rig, "study/measured/%s", sets_text(result->set, "rig"));
  return replicates_repeat(result->set, rig, data_dir, &result->repeat, error);
}

/* Whether rows of a log are held out, and not logs. */
static int holds_out_rows(const config_setting_t *set)
{
  int i, any = 0;
  for (i = config_setting_length(lab_config_member(set, "fit")); sets_log(set, i); i++)
    any |= sets_is_fitted(set, sets_log(set, i));
  return any;
}

/* Fit the completed model to each log by itself, and to the channel that was not fitted through its sensor. A log that
 * cannot be read or followed so is one without a number. */
static int fit_alone(sets_result *result, const char *data_dir, const char *out_dir, lab_error *error)
{
  static lab_rig model;
  const config_setting_t *set = result->set;
  const char *sensor = sets_text(set, "sensor");
  const int judged = sets_channel(sets_text(set, "judged")), check = sets_channel(sets_text(set, "check"));
  char path[PATH_BYTES];
  int status = LAB_OK;
  result->n_alone = 0;
  result->sensor.left = 0;
  if (result->state != SETS_DONE || holds_out_rows(set))
    return LAB_OK;
  snprintf(path, sizeof path, "%s/%s/model.cfg", out_dir, sets_text(set, "name"));
  if (lab_rig_read(path, &model, error))
    return error->status;
  name_log(set, data_dir, sets_log(set, 0), path);
  if (*sensor && alone_fit_sensor(&model, path, sensor, check, &result->sensor, error))
    return error->status;
  for (; status != LAB_WORLD && sets_log(set, 1) && sets_log(set, result->n_alone) && result->n_alone < LOGS_MAX;
       result->n_alone++) {
    name_log(set, data_dir, sets_log(set, result->n_alone), path);
    status = alone_fit_log(&model, path, judged, &result->alone[result->n_alone], error);
  }
  return status == LAB_WORLD ? status : LAB_OK;
}

const char *sets_data_folder(void)
{
  const char *named = getenv("MEASURED");
  return named && *named ? named : "../shared/data";
}

int sets_run(const config_setting_t *list, const char *data_dir, const char *out_dir, sets_result *result, int *n,
             lab_error *error)
{
  int i;
  *n = config_setting_length(list);
  if (*n > SETS_MAX)
    return lab_config_fail(list, error, "expected at most %d sets", SETS_MAX);
  for (i = 0; i < *n; i++)
    if (check_set(config_setting_get_elem(list, (unsigned)i), error))
      return error->status;
  for (i = 0; i < *n; i++) {
    result[i].set = config_setting_get_elem(list, (unsigned)i);
    result[i].state = run_set(result[i].set, data_dir, out_dir);
    if (measure_repeat(&result[i], data_dir, error) || fit_alone(&result[i], data_dir, out_dir, error))
      return error->status;
  }
  return LAB_OK;
}

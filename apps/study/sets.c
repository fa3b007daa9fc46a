#include "sets.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../lab/base/config.h"

enum { COMMAND_BYTES = 16384, PATH_BYTES = 1024 };

/* A command line under construction. */
typedef struct command {
  char text[COMMAND_BYTES];
  size_t n;
} command;

static void add_text(command *c, const char *text)
{
  for (; *text && c->n + 1 < sizeof c->text; text++)
    c->text[c->n++] = *text;
  c->text[c->n] = '\0';
}

/* Text that the shell takes as it is: in single quotes, those in it apart. */
static void add_quoted(command *c, const char *text)
{
  add_text(c, "'");
  for (; *text; text++) {
    const char one[2] = {*text, '\0'};
    add_text(c, *text == '\'' ? "'\\''" : one);
  }
  add_text(c, "'");
}

static const char *text_of(const config_setting_t *set, const char *key)
{
  const char *text = NULL;
  config_setting_lookup_string(set, key, &text);
  return text;
}

static int check_set(const config_setting_t *set, lab_error *error)
{
  static const char *const needed[] = {"name", "rig",      "title",       "folder", "judged",
                                       "unit", "declared", "independent", "remains"};
  size_t i;
  for (i = 0; i < sizeof needed / sizeof *needed; i++)
    if (!text_of(set, needed[i]))
      return lab_config_fail(set, error, "expected the text %s", needed[i]);
  if (!config_setting_get_member((config_setting_t *)set, "fit") ||
      !config_setting_get_member((config_setting_t *)set, "holdout"))
    return lab_config_fail(set, error, "expected the lists fit and holdout");
  return LAB_OK;
}

/* Paths of a list of logs, each quoted and after `before`.  Returns: 0 if one is not there. */
static int add_logs(command *c, const config_setting_t *set, const char *list, const char *data_dir, const char *before,
                    const char *between)
{
  const config_setting_t *logs = config_setting_get_member((config_setting_t *)set, list);
  int i, there = 1;
  for (i = 0; i < config_setting_length(logs); i++) {
    char path[PATH_BYTES];
    snprintf(path, sizeof path, "%s/%s/%s", data_dir, text_of(set, "folder"), config_setting_get_string_elem(logs, i));
    there &= access(path, R_OK) == 0;
    add_text(c, i == 0 ? before : between);
    add_quoted(c, path);
  }
  return there;
}

/* closeloop RIG LOGS --holdout A,B --out DIR */
static int run_set(const config_setting_t *set, const char *data_dir, const char *out_dir)
{
  static command c;
  char path[PATH_BYTES];
  c.n = 0;
  snprintf(path, sizeof path, "study/measured/%s", text_of(set, "rig"));
  add_text(&c, "./closeloop --quiet ");
  add_quoted(&c, path);
  if (!add_logs(&c, set, "fit", data_dir, " ", " ") || !add_logs(&c, set, "holdout", data_dir, " --holdout ", ",")) {
    fprintf(stderr, "%s: data absent below %s; study/measured/fetch.sh loads what can be had\n", text_of(set, "name"),
            data_dir);
    return SETS_ABSENT;
  }
  snprintf(path, sizeof path, "%s/%s", out_dir, text_of(set, "name"));
  add_text(&c, " --out ");
  add_quoted(&c, path);
  printf("%s: ", text_of(set, "name"));
  fflush(stdout);
  return system(c.text) == 0 ? SETS_DONE : SETS_FAILED;
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
  }
  return LAB_OK;
}

#include "ask.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cjson/cJSON.h>

#include "../../apps/lab/base/text.h"

extern char **environ;

/* ---- The report ---- */

static void copy_word(const cJSON *from, blind_word to)
{
  const char *text = cJSON_GetStringValue(from);
  snprintf(to, sizeof(blind_word), "%s", text ? text : "");
}

/* Words of a list, or of one member of the objects in it.  Returns: how many */
static int copy_words(const cJSON *list, const char *member, blind_word *to, int room)
{
  const cJSON *item;
  int n = 0;
  cJSON_ArrayForEach(item, list)
  {
    if (n < room)
      copy_word(member ? cJSON_GetObjectItem(item, member) : item, to[n++]);
  }
  return n;
}

static double number(const cJSON *object, const char *member)
{
  const cJSON *item = cJSON_GetObjectItem(object, member);
  return cJSON_IsNumber(item) ? item->valuedouble : (double)NAN;
}

static double in_noise(const cJSON *errors)
{
  const cJSON *channel;
  double sum = 0;
  int n = 0;
  cJSON_ArrayForEach(channel, errors)
  {
    const double r = number(channel, "in_noise");
    sum += r * r;
    n++;
  }
  return n ? sqrt(sum / n) : (double)NAN;
}

static void read_found(const cJSON *list, blind_answer *a)
{
  const cJSON *item;
  cJSON_ArrayForEach(item, list)
  {
    blind_found *f = &a->found[a->n_found];
    if (a->n_found == BLIND_FINDS)
      return;
    copy_word(cJSON_GetObjectItem(item, "effect"), f->effect);
    copy_word(cJSON_GetObjectItem(item, "equation"), f->equation);
    f->n_alike = copy_words(cJSON_GetObjectItem(item, "indistinguishable_from"), NULL, f->alike, BLIND_CANDIDATES);
    a->n_found++;
  }
}

static void read_candidates(const cJSON *list, blind_answer *a)
{
  const cJSON *item;
  int n = 0;
  a->n_candidates = copy_words(list, "effect", a->candidate, BLIND_CANDIDATES);
  cJSON_ArrayForEach(item, list)
  {
    if (n < a->n_candidates)
      a->statistic[n++] = number(item, "statistic");
  }
}

static void read_report(const cJSON *root, blind_answer *a)
{
  const cJSON *error = cJSON_GetObjectItem(root, "error"), *holdout = cJSON_GetObjectItem(error, "holdout");
  memset(a, 0, sizeof *a);
  copy_word(cJSON_GetObjectItem(root, "verdict"), a->verdict);
  read_found(cJSON_GetObjectItem(root, "found"), a);
  read_candidates(cJSON_GetObjectItem(root, "candidates"), a);
  a->n_unlisted = copy_words(cJSON_GetObjectItem(root, "unlisted"), "equation", a->unlisted, BLIND_FINDS);
  a->n_small = copy_words(cJSON_GetObjectItem(root, "significant_but_small"), NULL, a->small, BLIND_CANDIDATES);
  a->before = in_noise(cJSON_GetObjectItem(error, "before"));
  a->after = in_noise(cJSON_GetObjectItem(error, "after"));
  a->holdout_before = in_noise(cJSON_GetObjectItem(holdout, "before"));
  a->holdout_after = in_noise(cJSON_GetObjectItem(holdout, "after"));
}

int blind_answer_read(const char *path, blind_answer *answer, lab_error *error)
{
  lab_text text;
  cJSON *root;
  if (lab_text_read(path, &text, error))
    return error->status;
  root = cJSON_Parse(text.data);
  lab_text_free(&text);
  if (!cJSON_GetStringValue(cJSON_GetObjectItem(root, "verdict"))) {
    cJSON_Delete(root);
    return lab_fail(error, LAB_DATA, "%s: not a report of closeloop: there is no verdict in it", path);
  }
  read_report(root, answer);
  cJSON_Delete(root);
  return LAB_OK;
}

/* ---- The program ---- */

enum { PATHS = 1024 };

static int start(const char *program, const char *folder, pid_t *pid, lab_error *error)
{
  static char quiet[] = "--quiet", threads[] = "--threads", one[] = "1", held[] = "--holdout", out[] = "--out";
  char rig[PATHS], fit[PATHS], holdout[PATHS], said[PATHS];
  char *const argv[] = {(char *)program, rig, fit, held, holdout, out, (char *)folder, quiet, threads, one, NULL};
  posix_spawn_file_actions_t files;
  int failed;
  snprintf(rig, sizeof rig, "%s/rig.cfg", folder);
  snprintf(fit, sizeof fit, "%s/fit.csv", folder);
  snprintf(holdout, sizeof holdout, "%s/holdout.csv", folder);
  snprintf(said, sizeof said, "%s/said.txt", folder);
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, said, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  failed = posix_spawn(pid, program, &files, NULL, argv, environ);
  posix_spawn_file_actions_destroy(&files);
  if (failed)
    return lab_fail(error, LAB_WORLD, "%s: cannot be started: %s", program, strerror(failed));
  return LAB_OK;
}

static double seconds(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Exit status of a child, as from wait; -1 if it had to be stopped. */
static int wait_for(pid_t pid, double timeout)
{
  const struct timespec nap = {0, 10000000};
  const double end = seconds() + timeout;
  int status, late = 0;
  for (;;) {
    const pid_t got = waitpid(pid, &status, late ? 0 : WNOHANG);
    if (got == pid)
      return late ? -1 : status;
    if (got < 0 && errno != EINTR)
      return -1;
    if (seconds() > end) {
      late = 1;
      kill(pid, SIGKILL);
    } else {
      nanosleep(&nap, NULL);
    }
  }
}

/* What a failed run said, on one line without commas. */
static void failed(const char *folder, int status, blind_answer *a)
{
  char path[PATHS];
  lab_text text;
  lab_error ignored;
  char *c;
  memset(a, 0, sizeof *a);
  a->before = a->after = a->holdout_before = a->holdout_after = NAN;
  strcpy(a->verdict, status == -1 ? "timeout" : "failed");
  snprintf(path, sizeof path, "%s/said.txt", folder);
  if (lab_text_read(path, &text, &ignored) == LAB_OK) {
    snprintf(a->words, sizeof a->words, "%s", text.data);
    lab_text_free(&text);
  }
  for (c = a->words; *c; c++)
    *c = *c == ',' || *c == '\n' ? ';' : *c;
}

int blind_ask(const char *program, const char *folder, double timeout, blind_answer *answer, lab_error *error)
{
  char path[PATHS];
  pid_t pid;
  int status;
  if (start(program, folder, &pid, error))
    return error->status;
  status = wait_for(pid, timeout);
  snprintf(path, sizeof path, "%s/report.json", folder);
  if (status == 0)
    return blind_answer_read(path, answer, error);
  failed(folder, status, answer);
  return LAB_OK;
}

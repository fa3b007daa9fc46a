#define _DEFAULT_SOURCE /* for wait4, which tells of one child alone what it took */
#include "ask.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cjson/cJSON.h>

#include "../../apps/lab/base/text.h"

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

static void read_interval(const cJSON *object, double over, double *low, double *high)
{
  const cJSON *ci = cJSON_GetObjectItem(object, "ci95");
  const cJSON *a = cJSON_GetArrayItem(ci, 0), *b = cJSON_GetArrayItem(ci, 1);
  *low = cJSON_IsNumber(a) ? a->valuedouble / over : (double)NAN;
  *high = cJSON_IsNumber(b) ? b->valuedouble / over : (double)NAN;
}

static blind_since read_since(const cJSON *object)
{
  const cJSON *onset = cJSON_GetObjectItem(object, "onset");
  blind_since since = {number(onset, "t"), NAN, NAN};
  read_interval(onset, 1, &since.low, &since.high);
  return since;
}

static void read_deviations(const cJSON *list, blind_answer *a)
{
  const cJSON *item;
  cJSON_ArrayForEach(item, list)
  {
    blind_deviation *d = &a->deviation[a->n_deviations];
    const double declared = number(item, "declared"), over = declared != 0 ? declared : 1;
    if (a->n_deviations == BLIND_CANDIDATES)
      return;
    copy_word(cJSON_GetObjectItem(item, "parameter"), d->parameter);
    d->absolute = declared == 0;
    d->ratio = number(item, "found") / over;
    read_interval(item, over, &d->low, &d->high);
    d->beyond = cJSON_IsTrue(cJSON_GetObjectItem(item, "beyond"));
    d->since = read_since(item);
    a->n_deviations++;
  }
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
    f->since = read_since(item);
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
  copy_word(cJSON_GetObjectItem(root, "condition"), a->condition);
  read_deviations(cJSON_GetObjectItem(root, "deviations"), a);
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
static const int not_started = 127; /* exit status */

/* In the child: its own seconds of CPU, its words into a file. */
static void become(const char *program, char *const *argv, const char *said, int seconds)
{
  const struct rlimit limit = {(rlim_t)seconds, (rlim_t)seconds + 1};
  const int file = open(said, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file >= 0 && dup2(file, STDOUT_FILENO) >= 0 && dup2(file, STDERR_FILENO) >= 0 &&
      setrlimit(RLIMIT_CPU, &limit) == 0)
    execv(program, argv);
  _exit(not_started);
}

/* Run on the logs in a folder; the program is told of nine tenths of its seconds.  Out: status, as from wait; cpu [s]
 */
static int run(const char *program, const char *folder, int seconds, int *status, double *cpu, lab_error *error)
{
  static char quiet[] = "--quiet", threads[] = "--threads", one[] = "1", held[] = "--holdout", out[] = "--out",
              budget[] = "--budget";
  char rig[PATHS], fit[PATHS], holdout[PATHS], said[PATHS], most[24];
  char *argv[] = {(char *)program, rig, fit, out, (char *)folder, quiet, threads, one, budget, most, held,
                  holdout,         NULL};
  struct rusage used = {0};
  pid_t pid;
  snprintf(most, sizeof most, "%g", 0.9 * seconds);
  snprintf(rig, sizeof rig, "%s/rig.cfg", folder);
  snprintf(fit, sizeof fit, "%s/fit.csv", folder);
  snprintf(holdout, sizeof holdout, "%s/holdout.csv", folder);
  snprintf(said, sizeof said, "%s/said.txt", folder);
  if (access(holdout, R_OK))
    argv[10] = NULL;
  pid = fork();
  if (pid == 0)
    become(program, argv, said, seconds);
  while (pid > 0 && wait4(pid, status, 0, &used) < 0 && errno == EINTR)
    ;
  if (pid < 0 || (WIFEXITED(*status) && WEXITSTATUS(*status) == not_started))
    return lab_fail(error, LAB_WORLD, "%s: cannot be started", program);
  *cpu = (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
  return LAB_OK;
}

/* What a failed run said, on one line without commas. */
static void failed(const char *folder, int in_time, blind_answer *a)
{
  char path[PATHS];
  lab_text text;
  lab_error ignored;
  char *c;
  memset(a, 0, sizeof *a);
  a->before = a->after = a->holdout_before = a->holdout_after = NAN;
  strcpy(a->verdict, in_time ? "failed" : "timeout");
  snprintf(path, sizeof path, "%s/said.txt", folder);
  if (lab_text_read(path, &text, &ignored) == LAB_OK) {
    snprintf(a->words, sizeof a->words, "%s", text.data);
    lab_text_free(&text);
  }
  for (c = a->words; *c; c++)
    *c = *c == ',' || *c == '\n' ? ';' : *c;
}

int blind_ask(const char *program, const char *folder, int seconds, blind_answer *answer, lab_error *error)
{
  char path[PATHS];
  const double ticks =
      0.5; /* [s] by which times of a process may be short of what its limit counts, on a busy machine */
  double cpu = 0;
  int status;
  if (run(program, folder, seconds, &status, &cpu, error))
    return error->status;
  snprintf(path, sizeof path, "%s/report.json", folder);
  if (status != 0)
    failed(folder, !(WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) && cpu < seconds - ticks, answer);
  else if (blind_answer_read(path, answer, error))
    return error->status;
  answer->cpu = cpu;
  return LAB_OK;
}

#include "batch.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "batchindex.h"
#include "batchlist.h"
#include "../base/checksum.h"
#include "../base/escape.h"
#include "jobs.h"
#include "../base/interrupt.h"
#include "../base/outfile.h"
#include "../base/progress.h"
#include "../base/text.h"
#include "../base/units.h"
#include "../base/clock.h"

/* What is handed out. */
typedef struct job {
  uint64_t key;
  lab_fleet_entry entry;
} job;

typedef struct batch {
  const lab_batch_options *how;
  char shown[LAB_PATH_TEXT];                      /* folder of the results, as it was given */
  char out[LAB_PATH_TEXT - LAB_FLEET_ENTRY_NAME]; /* the same, absolute */
  pid_t leader;                                   /* of this rank */
  lab_fleet_list list;
  lab_progress progress;
  int n, done, before; /* lines; done; of these, by an earlier run */
  lab_history history; /* of its rigs, once it is done */
} batch;

/* What this process took since a time on the clock. */
static lab_cost cost_since(double start)
{
  lab_cost cost;
  struct rusage use;
  getrusage(RUSAGE_SELF, &use);
  cost.seconds = lab_clock() - start;
  cost.cpu = lab_cpu_time();
  cost.memory = (double)use.ru_maxrss / 1024; /* in kB on Linux */
  return cost;
}

/* The path of something in the folder of the results. */
#define IN_FOLDER(b, name) LAB_IN_FOLDER((b)->out, name)

static void limit(int what, rlim_t most)
{
  struct rlimit now;
  if (getrlimit(what, &now) || now.rlim_cur <= most)
    return;
  now.rlim_cur = most;
  setrlimit(what, &now);
}

/* What the process at work on one line may take: CPU time, room on the disk for a file, and memory. */
static void bound(const batch *b)
{
  signal(SIGXCPU, SIG_DFL); /* the parent says it, in the line's row */
  signal(SIGXFSZ, SIG_IGN); /* who writes says it */
  limit(RLIMIT_CPU, (rlim_t)b->how->budget);
  limit(RLIMIT_FSIZE, (rlim_t)b->how->room);
#ifndef LAB_SANITIZED /* a sanitizer reserves more than there is */
  limit(RLIMIT_DATA, (rlim_t)b->how->memory << 20);
#endif
}

/* ---- Whether a line is done ---- */

/* Cut the logs of a cell.  Out: text, path, which points into it  Returns: how many; -1 if there are too many */
static int split(const char *cell, char text[LAB_FLEET_ENTRY_TEXT], const char *path[LAB_LOGS_MAX])
{
  return lab_split(strcpy(text, cell), ';', path, LAB_LOGS_MAX);
}

static uint64_t add_files(uint64_t key, const char *list)
{
  char text[LAB_FLEET_ENTRY_TEXT];
  const char *path[LAB_LOGS_MAX];
  const int n = split(list, text, path);
  int i;
  key = lab_checksum_text(key, list);
  for (i = 0; i < n; i++)
    key = lab_checksum_file(key, path[i]);
  return key;
}

/* Whether a rig file may take in others: the words alone are enough. */
static int has_include(const char *rig)
{
  lab_error ignored;
  lab_text text;
  int any;
  if (lab_text_read(rig, &text, &ignored))
    return 0;
  any = strstr(text.data, "@include") != NULL;
  lab_text_free(&text);
  return any;
}

/* Checksum of all that decides about a line's row and report; 0 where that cannot be told. A date that can be read is
 * no part of it, because trends are made anew at the end of every run. */
static uint64_t key_of(const batch *b, const lab_fleet_entry *e)
{
  char numbers[80];
  uint64_t key = lab_checksum_text(LAB_CHECKSUM_SEED, lab_build());
  snprintf(numbers, sizeof numbers, "%.17g %.17g", b->how->alpha, b->how->min_gain);
  key = lab_checksum_text(key, numbers);
  key = lab_checksum_text(lab_checksum_text(key, e->name), e->wrong);
  key = lab_checksum_file(lab_checksum_text(key, e->rig), e->rig);
  key = add_files(add_files(key, e->log), e->holdout);
  return has_include(e->rig) ? 0 : key;
}

static int is_done(const batch *b, const lab_fleet_entry *e, uint64_t key)
{
  const char *folder = IN_FOLDER(b, e->name);
  lab_done done;
  return lab_done_read(folder, &done) && key && done.key == key &&
         (done.outcome.status != LAB_OK ||
          (done.extent >= b->how->extent && lab_answer_is_there(folder, b->how->extent)));
}

/* ---- Jobs ---- */

/* The next line that is not done yet. */
static int next(void *context, void *to)
{
  batch *b = context;
  job *j = to;
  lab_error never; /* the list has been checked */
  int more;
  while (lab_fleet_list_next(&b->list, &j->entry, &more, &never) == LAB_OK && more) {
    const char *folder = IN_FOLDER(b, j->entry.name);
    j->key = key_of(b, &j->entry);
    if (!is_done(b, &j->entry, j->key)) {
      lab_done_remove(folder);
      lab_answer_remove(folder);
      return 1;
    }
    b->before++;
    lab_progress_count(&b->progress, ++b->done, b->n, b->before);
    if (lab_interrupt_pending())
      return 0;
  }
  return 0;
}

static int done(void *context, const void *what, const void *result, lab_error *error)
{
  batch *b = context;
  const job *j = what;
  lab_done d = {.outcome = *(const lab_outcome *)result, .extent = b->how->extent};
  d.key = d.outcome.status == LAB_WORLD ? 0 : j->key; /* the world may be better next time */
  if (lab_done_write(IN_FOLDER(b, j->entry.name), &d, error))
    return error->status;
  lab_progress_count(&b->progress, ++b->done, b->n, b->before);
  return LAB_OK;
}

/* A job whose leader has gone ends at its next stage. */
static void look_for_leader(void *context, const char *what)
{
  const batch *b = context;
  (void)what;
  if (getppid() != b->leader)
    _exit(LAB_WORLD);
}

static int ask(batch *b, const lab_fleet_entry *e, lab_answer **answer, lab_error *error)
{
  char log_text[LAB_FLEET_ENTRY_TEXT], held_text[LAB_FLEET_ENTRY_TEXT];
  const char *log[LAB_LOGS_MAX], *held[LAB_LOGS_MAX];
  lab_request q = {.rig = e->rig, .log = log, .holdout = held, .alpha = b->how->alpha, .min_gain = b->how->min_gain};
  q.n_logs = split(e->log, log_text, log);
  q.n_holdout = split(e->holdout, held_text, held);
  q.on_progress = look_for_leader;
  q.context = b;
  if (*e->wrong)
    return lab_fail(error, LAB_DATA, "%s", e->wrong);
  if (q.n_logs < 0 || q.n_holdout < 0)
    return lab_fail(error, LAB_DATA, "more than %d logs on one line of the list", (int)LAB_LOGS_MAX);
  if (!b->how->allow_include && has_include(e->rig))
    return lab_fail(error, LAB_DATA,
                    "%s: @include would read any file that you may read; if you trust the rig files of this list, give "
                    "--allow-include",
                    e->rig);
  return lab_answer_find(&q, answer, error);
}

static void work(void *context, const void *what, void *result)
{
  const double start = lab_clock();
  batch *b = context;
  const job *j = what;
  lab_outcome *outcome = result;
  lab_answer *answer = NULL;
  lab_error error;
  bound(b);
  if (ask(b, &j->entry, &answer, &error)) {
    lab_row_error(&error, outcome);
  } else {
    look_for_leader(b, "writing");
    if (lab_answer_write(answer, IN_FOLDER(b, j->entry.name), b->how->extent, &error))
      lab_row_error(&error, outcome);
    else
      lab_row_answer(answer, outcome);
    lab_answer_free(answer);
  }
  outcome->cost = cost_since(start);
}

static void lost(void *context, const void *what, int wait, void *result)
{
  const batch *b = context;
  lab_error error;
  (void)what;
  if (WIFSIGNALED(wait) && WTERMSIG(wait) == SIGXCPU)
    lab_fail(&error, LAB_WORLD, "not done within %d s of CPU; give --budget more, or keep fewer rows (log.every)",
             b->how->budget);
  else
    lab_fail(&error, LAB_WORLD,
             "the process that worked on this line was ended by %s %d; if this happens again, please report it",
             WIFSIGNALED(wait) ? "signal" : "status", WIFSIGNALED(wait) ? WTERMSIG(wait) : WEXITSTATUS(wait));
  lab_row_error(&error, result);
}

/* ---- batch.csv ---- */

enum { KINDS = 5 };
static const char *const kinds[KINDS] = {"effect", "none", "unlisted", "undecided", "error"};

typedef struct totals {
  int n[KINDS];
  int worst; /* status */
} totals;

static void count(totals *t, const lab_outcome *outcome)
{
  int k;
  for (k = 0; k < KINDS; k++)
    t->n[k] += strncmp(outcome->row, kinds[k], strcspn(outcome->row, ",")) == 0;
  if (outcome->status > t->worst)
    t->worst = outcome->status;
}

static int copy_rows(batch *b, FILE *rows, FILE *costs, lab_index *index, totals *t, lab_error *error)
{
  lab_fleet_entry e;
  int more, status;
  while ((status = lab_fleet_list_next(&b->list, &e, &more, error)) == LAB_OK && more) {
    const char *folder = IN_FOLDER(b, e.name);
    lab_done d;
    if (!lab_done_read(folder, &d))
      return lab_fail(error, LAB_DATA, "%s: the record of what was done has gone during the run; run it again", folder);
    lab_put_users_cell(rows, e.name);
    fprintf(rows, ",%s\n", d.outcome.row);
    lab_put_users_cell(costs, e.name);
    fprintf(costs, ",%.3f,%.3f,%.1f\n", d.outcome.cost.seconds, d.outcome.cost.cpu, d.outcome.cost.memory);
    count(t, &d.outcome);
    if (lab_index_add(index, e.name, &d, error) ||
        (d.outcome.status == LAB_OK && lab_history_add(&b->history, &e, folder, error)))
      return error->status;
  }
  return status;
}

static int write_tables(batch *b, lab_index *index, totals *t, lab_error *error)
{
  lab_outfile rows, costs;
  int status;
  lab_fleet_list_restart(&b->list);
  if (lab_out_open(&rows, IN_FOLDER(b, "batch.csv"), error))
    return error->status;
  if (lab_out_open(&costs, IN_FOLDER(b, "batch.cost.csv"), error)) {
    lab_out_abandon(&rows);
    return error->status;
  }
  lab_row_header(rows.file);
  fputs("name,seconds,cpu_seconds,memory_MB\n", costs.file);
  status = lab_out_end(&costs, copy_rows(b, rows.file, costs.file, index, t, error), error);
  return lab_out_end(&rows, status, error);
}

/* batch.csv and what goes with it: trends.csv, and the page that shows these too. */
static int write_all(batch *b, totals *t, lab_error *error)
{
  lab_index index = {0};
  lab_trends trends = {0};
  int status = write_tables(b, &index, t, error);
  if (status == LAB_OK) {
    lab_history_sort(&b->history);
    status = lab_trends_find(&b->history, &trends, error) ||
                     lab_trends_write(&trends, IN_FOLDER(b, "trends.csv"), error) ||
                     lab_index_write(&index, b->how->list, &trends, b->out, error)
                 ? error->status
                 : LAB_OK;
  }
  lab_trends_free(&trends);
  lab_history_free(&b->history);
  lab_index_free(&index);
  return status;
}

/* "100 logs: 61 effect, 29 none, 10 error. results/fleet/batch.csv" */
static int sum_up(const batch *b, const totals *t, lab_error *error)
{
  int k, said = 0;
  lab_outfile out;
  if (lab_out_open(&out, NULL, error))
    return error->status;
  fprintf(out.file, "%d line%s:", b->n, b->n == 1 ? "" : "s");
  for (k = 0; k < KINDS; k++)
    if (t->n[k])
      fprintf(out.file, "%s %d %s", said++ ? "," : "", t->n[k], kinds[k]);
  fprintf(out.file, ". %s/batch.csv\n", b->shown);
  if (lab_out_close(&out, error))
    return error->status;
  if (t->worst == LAB_OK)
    return LAB_OK;
  return lab_fail(error, t->worst, "%d of %d lines have the verdict error; the column message of batch.csv says why",
                  t->n[KINDS - 1], b->n);
}

/* ---- The run ---- */

/* The folder of the results, absolute. */
static int place_out(batch *b, lab_error *error)
{
  const lab_batch_options *how = b->how;
  const char *base = lab_file_name(how->list), *dot = strrchr(base, '.');
  char cwd[LAB_PATH_TEXT];
  int length;
  snprintf(b->shown, sizeof b->shown, "results/%.*s", dot && dot > base ? (int)(dot - base) : (int)strlen(base), base);
  if (how->out)
    snprintf(b->shown, sizeof b->shown, "%s", how->out);
  if (!getcwd(cwd, sizeof cwd))
    return lab_fail(error, LAB_WORLD, "the present folder has no name: %s", strerror(errno));
  length =
      snprintf(b->out, sizeof b->out, "%s%s%s", *b->shown == '/' ? "" : cwd, *b->shown == '/' ? "" : "/", b->shown);
  return length < (int)sizeof b->out ? LAB_OK : lab_fail(error, LAB_USAGE, "--out: the path is too long");
}

/* Paths in the list are taken from its folder. */
static int move_to_list(void *context, lab_error *error)
{
  const batch *b = context;
  const char *list = b->how->list, *slash = strrchr(list, '/');
  char folder[LAB_PATH_TEXT];
  snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - list) + 1 : 1, slash ? list : ".");
  if (chdir(folder))
    return lab_fail(error, LAB_WORLD, "%s: cannot go there: %s", folder, strerror(errno));
  return LAB_OK;
}

/* Two runs in one folder would be in each other's way. The lock goes with the process, however it ends. */
static int lock(const batch *b, lab_error *error)
{
  const char *path = IN_FOLDER(b, ".lock");
  struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
  int file;
  if (lab_make_folder(b->out, error))
    return error->status;
  file = open(path, O_RDWR | O_CREAT, 0666);
  if (file < 0)
    return lab_fail(error, LAB_WORLD, "%s: cannot be written: %s", path, strerror(errno));
  if (fcntl(file, F_SETLK, &whole) && (errno == EACCES || errno == EAGAIN))
    return lab_fail(error, LAB_WORLD, "%s: another run of closeloop --batch is at work there; wait, or give --out",
                    b->shown);
  return LAB_OK;
}

static int lead(batch *b, const lab_jobs *jobs, lab_error *error)
{
  totals t = {{0}, LAB_OK};
  int status;
  if (lab_fleet_list_check(&b->list, &b->n, error) || lock(b, error) || move_to_list(b, error))
    return error->status;
  lab_progress_begin(&b->progress, "closeloop", b->how->quiet);
  status = lab_jobs_run(jobs, error);
  lab_progress_end(&b->progress);
  if (lab_interrupt_pending() && !b->how->quiet)
    fprintf(stderr, "closeloop: stopped with %d of %d lines done; the same command goes on\n", b->done, b->n);
  if (status == LAB_OK && !lab_interrupt_pending())
    status = write_all(b, &t, error);
  return status == LAB_OK && !lab_interrupt_pending() ? sum_up(b, &t, error) : status;
}

int lab_batch_run(const lab_batch_options *options, lab_error *error)
{
  static batch b;
  lab_jobs jobs = {0, sizeof(job), sizeof(lab_outcome), move_to_list, next, work, lost, done, &b};
  double scale, offset;
  int status = LAB_OK;
  b.how = options;
  b.leader = getpid();
  jobs.at_once = options->at_once ? options->at_once : lab_jobs_usual();
  if (place_out(&b, error) || lab_unit_factor("kPa", "Pa", &scale, &offset, error)) /* loads the units once for all */
    return error->status;
  lab_interrupt_hold();
  if (lab_jobs_join())
    status = lab_fleet_list_open(&b.list, options->list, error) ? error->status : lead(&b, &jobs, error);
  else
    lab_jobs_serve(&jobs);
  lab_jobs_leave(&jobs);
  lab_fleet_list_close(&b.list);
  lab_interrupt_release();
  return status;
}

#include "targets.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../../apps/lab/base/escape.h"
#include "../../apps/lab/log/log.h"
#include "../../apps/lab/rig/rig.h"
#include "../../apps/study/study.h"
#include "../../apps/study/table.h"

/* ---- Files ---- */

static const double ambient = 101325; /* [Pa] */

static char folder[64];

/* A file of the folder, kept open so that a run costs one write. */
typedef struct slot {
  const char *name;
  char path[96];
  FILE *file;
} slot;

static slot slots[] = {{.name = "in_l0.25.csv"}, {.name = "rig.cfg"}, {.name = "actuator.cfg"}, {.name = "again.cfg"}};
enum { IN, RIG, ACTUATOR, AGAIN, SLOTS };

static void promise(int kept, const char *what, const char *text)
{
  if (kept)
    return;
  fprintf(stderr, "broken promise: %s: %s\n", what, text);
  abort();
}

static void remove_files(void)
{
  int i;
  for (i = 0; i < SLOTS; i++) {
    fclose(slots[i].file);
    remove(slots[i].path);
  }
  rmdir(folder);
}

/* Give a file other bytes.  Returns: its path */
static const char *put(int which, const void *data, size_t size)
{
  FILE *file = slots[which].file;
  rewind(file);
  promise((size == 0 || fwrite(data, 1, size, file) == size) && fflush(file) == 0 &&
              ftruncate(fileno(file), (off_t)size) == 0,
          "scratch file written", slots[which].path);
  return slots[which].path;
}

static void open_files(void)
{
  static const char actuator[] = "actuator = { name = \"r1-400\"; };\n";
  int i;
  if (*folder)
    return;
  strcpy(folder, "/tmp/libpneu-fuzz-XXXXXX");
  promise(mkdtemp(folder) != NULL, "scratch folder made", folder);
  for (i = 0; i < SLOTS; i++) {
    snprintf(slots[i].path, sizeof slots[i].path, "%s/%s", folder, slots[i].name);
    slots[i].file = fopen(slots[i].path, "wb");
    promise(slots[i].file != NULL, "scratch file opened", slots[i].path);
  }
  put(ACTUATOR, actuator, sizeof actuator - 1);
  atexit(remove_files);
}

/* ---- What every reader promises ---- */

/* Bad bytes are the file's fault, and the message is one line that ends. */
static void check_error(int status, const lab_error *error)
{
  promise(status == LAB_DATA && error->status == LAB_DATA, "status of a bad file", error->text);
  promise(*error->text && memchr(error->text, 0, sizeof error->text), "message", "none");
  promise(lab_is_plain(error->text), "no control characters in a message", error->text);
}

/* ---- Logs ---- */

static void check_channel(const lab_log *log, int c)
{
  const int whole = c == LAB_CHANNEL_TIME || c == LAB_CHANNEL_U;
  size_t i;
  for (i = 0; i < log->n; i++) {
    promise(!isinf(log->value[c][i]), "finite or a gap", lab_channels[c].key);
    promise(!whole || !isnan(log->value[c][i]), "never a gap", lab_channels[c].key);
  }
}

static void check_run(const lab_log *log, size_t run)
{
  const double *t = log->value[LAB_CHANNEL_TIME];
  size_t i;
  promise(log->run[run] < log->run[run + 1], "runs have rows", log->path);
  for (i = log->run[run] + 1; i < log->run[run + 1]; i++)
    promise(t[i] > t[i - 1], "time grows within a run", log->path);
}

static void check_log(const lab_log *log)
{
  size_t run;
  int c;
  promise(log->n > 0 && log->n_runs > 0 && log->value[LAB_CHANNEL_TIME], "a log has rows", log->path);
  promise(log->run[0] == 0 && log->run[log->n_runs] == log->n, "runs cover the log", log->path);
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    if (log->value[c])
      check_channel(log, c);
  for (run = 0; run < log->n_runs; run++)
    check_run(log, run);
}

/* Where "\n%%\n" is. */
static const uint8_t *find_break(const uint8_t *data, size_t size)
{
  size_t i;
  for (i = 0; i + 4 <= size; i++)
    if (memcmp(data + i, "\n%%\n", 4) == 0)
      return data + i;
  return NULL;
}

/* The format that a rig's text asks for. A fuzzer changes the log more often than the rig before it: the last rig is
 * kept.  Returns: 0 if the text is no rig's */
static int format_of(const uint8_t *text, size_t size, lab_log_format *format)
{
  static uint8_t known[4096];
  static size_t known_size;
  static lab_rig rig;
  static int good;
  lab_error error;
  if (size > sizeof known)
    return 0;
  if (!known_size || known_size != size || memcmp(known, text, size) != 0) {
    memcpy(known, text, size);
    known_size = size;
    good = lab_rig_read(put(RIG, text, size), &rig, &error) == LAB_OK;
  }
  *format = rig.log;
  return good;
}

static void read_log(const uint8_t *data, size_t size)
{
  const uint8_t *middle = find_break(data, size);
  const size_t head = middle ? (size_t)(middle - data) : 0;
  lab_log_format format;
  lab_error error;
  lab_log log;
  int status;
  lab_log_format_default(&format);
  if (middle && !format_of(data, head, &format))
    return;
  if (middle) {
    data += head + 4;
    size -= head + 4;
  }
  status = lab_log_read(put(IN, data, size), &format, ambient, &log, &error);
  if (status == LAB_OK)
    check_log(&log);
  else
    check_error(status, &error);
  lab_log_free(&log);
}

/* ---- Rig files ---- */

/* What was read can be written, and is read as the same again. */
static void check_rig(const lab_rig *rig)
{
  static lab_rig again;
  lab_error error = {0, ""};
  FILE *file = slots[AGAIN].file;
  pneu_model model;
  promise(lab_rig_model(rig, &model, &error) == LAB_OK, "a rig makes a model", error.text);
  rewind(file);
  lab_rig_write(file, rig, NULL);
  promise(fflush(file) == 0 && ftruncate(fileno(file), (off_t)ftell(file)) == 0, "rig written", rig->name);
  promise(lab_rig_read(slots[AGAIN].path, &again, &error) == LAB_OK, "a written rig is read", error.text);
  promise(memcmp(&again.params, &rig->params, sizeof again.params) == 0, "same parameters", rig->name);
  promise(again.n_terms == rig->n_terms && memcmp(again.term, rig->term, sizeof again.term) == 0, "same terms",
          rig->name);
  promise(again.n_fit == rig->n_fit && memcmp(again.fit, rig->fit, sizeof again.fit) == 0, "same fit", rig->name);
  promise(memcmp(again.noise, rig->noise, sizeof again.noise) == 0, "same noise", rig->name);
  promise(memcmp(again.input, rig->input, sizeof again.input) == 0, "same inputs", rig->name);
  promise(memcmp(&again.log, &rig->log, sizeof again.log) == 0, "same form of logs", rig->name);
}

static void read_rig(const uint8_t *data, size_t size)
{
  static lab_rig rig;
  lab_error error;
  const int status = lab_rig_read(put(RIG, data, size), &rig, &error);
  if (status == LAB_OK)
    check_rig(&rig);
  else
    check_error(status, &error);
}

/* ---- The study's configuration ---- */

static void check_study(const study *s)
{
  promise(s->n_actuators > 0 && s->subject >= 0 && s->subject < s->n_actuators, "a subject", s->file);
  promise(s->n_gas > 0 && s->n_flow > 0 && s->n_benches > 0, "laws and bench sets", s->file);
}

static void read_study(const uint8_t *data, size_t size)
{
  static study s;
  lab_error error;
  const int status = study_read(put(IN, data, size), &s, &error);
  if (status == LAB_OK)
    check_study(&s);
  else
    check_error(status, &error);
}

/* ---- Tables of results ---- */

static void read_table(const uint8_t *data, size_t size)
{
  lab_error error;
  size_t row;
  table t;
  const int status = table_load_file(put(IN, data, size), &t, &error);
  if (status != LAB_OK)
    check_error(status, &error);
  for (row = 0; status == LAB_OK && row < table_rows(&t); row++) {
    promise(table_text(&t, row, "name") != NULL, "text of a cell", "none");
    table_number(&t, row, "value");
  }
  table_close(&t);
}

/* ---- All ---- */

const fuzz_target fuzz_targets[FUZZ_TARGETS] = {
    {"log", read_log}, {"rig", read_rig}, {"study", read_study}, {"table", read_table}};

const fuzz_target *fuzz_target_named(const char *name, size_t length)
{
  int i;
  open_files();
  for (i = 0; i < FUZZ_TARGETS; i++)
    if (strlen(fuzz_targets[i].name) == length && strncmp(fuzz_targets[i].name, name, length) == 0)
      return &fuzz_targets[i];
  return NULL;
}

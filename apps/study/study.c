#include "study.h"

#include <ctype.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "../lab/base/config.h"
#include "../lab/base/outfile.h"
#include "../lab/base/text.h"

/* A row of the table of keys; the name comes first, as lab_config_known wants it. */
typedef struct key {
  const char *name;
  int (*read)(const struct key *key, const config_setting_t *setting, study *s, lab_error *error);
  size_t at;        /* of its field */
  const char *unit; /* of a range */
  int optional;
} key;

/* The field of a key. */
static void *field(const key *k, study *s)
{
  return (char *)s + k->at;
}

/* Path beside the study file. */
static int beside(const study *s, const char *name, char *path, lab_error *error)
{
  const char *slash = strrchr(s->file, '/');
  const int folder = name[0] == '/' || !slash ? 0 : (int)(slash - s->file) + 1;
  if (snprintf(path, STUDY_PATH_TEXT, "%.*s%s", folder, s->file, name) < STUDY_PATH_TEXT)
    return LAB_OK;
  return lab_fail(error, LAB_DATA, "path is too long: %s", name);
}

/* The name of an actuator goes into names of files and the first cells of tables. */
static int check_name(const config_setting_t *item, const char *name, lab_error *error)
{
  if (!ispunct((unsigned char)*name) && !strpbrk(name, "/\\"))
    return LAB_OK;
  return lab_config_fail(item, error,
                         "expected an actuator whose name begins with a letter or digit and has no / or \\, "
                         "found \"%s\"",
                         name);
}

/* Rig files, added to the actuators; those of the first list are printed. */
static int read_actuators(const key *k, const config_setting_t *list, study *s, lab_error *error)
{
  int i;
  (void)k;
  if (lab_config_list(list, 1, STUDY_ACTUATOR_MAX - s->n_actuators, error))
    return error->status;
  for (i = 0; i < config_setting_length(list); i++) {
    const config_setting_t *item = config_setting_get_elem(list, (unsigned)i);
    char name[STUDY_PATH_TEXT], path[STUDY_PATH_TEXT];
    if (lab_config_text(item, name, sizeof name, error) || beside(s, name, path, error) ||
        lab_rig_read(path, &s->actuator[s->n_actuators], error) ||
        check_name(item, s->actuator[s->n_actuators].name, error))
      return error->status;
    s->n_actuators++;
  }
  if (s->n_printed == 0)
    s->n_printed = s->n_actuators;
  return LAB_OK;
}

static int read_subject(const key *k, const config_setting_t *setting, study *s, lab_error *error)
{
  char name[LAB_NAME_TEXT];
  (void)k;
  if (lab_config_text(setting, name, sizeof name, error))
    return error->status;
  for (s->subject = 0; s->subject < s->n_actuators; s->subject++)
    if (!strcmp(s->actuator[s->subject].name, name))
      return LAB_OK;
  return lab_config_fail(setting, error, "no actuator of the list is named \"%s\"", name);
}

static int read_laws(const key *k, const config_setting_t *list, study *s, lab_error *error)
{
  const int is_gas = k->at == offsetof(study, gas), count = is_gas ? PNEU_GAS_COUNT : PNEU_FLOW_COUNT;
  const char *names[PNEU_GAS_COUNT + PNEU_FLOW_COUNT];
  int i, *law = field(k, s);
  for (i = 0; i < count; i++)
    names[i] = is_gas ? pneu_gas_key(i) : pneu_flow_key(i);
  if (lab_config_list(list, 1, STUDY_LAW_MAX, error))
    return error->status;
  for (i = 0; i < config_setting_length(list); i++)
    if (lab_config_choice(config_setting_get_elem(list, (unsigned)i), names, (size_t)count, sizeof *names, &law[i],
                          error))
      return error->status;
  *(is_gas ? &s->n_gas : &s->n_flow) = i;
  return LAB_OK;
}

static int read_folder(const key *k, const config_setting_t *setting, study *s, lab_error *error)
{
  return lab_config_text(setting, field(k, s), STUDY_PATH_TEXT, error);
}

static int read_share(const key *k, const config_setting_t *setting, study *s, lab_error *error)
{
  return lab_config_quantity(setting, "1", 0, 1, field(k, s), error);
}

/* The group of a hypothesis: figure is for the reader, the range is for the program. */
static int read_range(const key *k, const config_setting_t *group, study *s, lab_error *error)
{
  static const char *const keys[] = {"figure", "from", "to", "points"};
  const config_setting_t *member[4];
  study_range *range = field(k, s);
  if (lab_config_members(group, keys, 4, 0, member, error))
    return error->status;
  if (!member[1] || !member[2] || !member[3])
    return lab_config_fail(group, error, "expected the keys from, to and points");
  if (lab_config_quantity(member[1], k->unit, 0, HUGE_VAL, &range->from, error) ||
      lab_config_quantity(member[2], k->unit, range->from, HUGE_VAL, &range->to, error))
    return error->status;
  return lab_config_count(member[3], 2, 10000, &range->points, error);
}

static int read_bench(const config_setting_t *pair, study_bench *bench, lab_error *error)
{
  if (lab_config_list(pair, 2, 2, error))
    return error->status;
  if (lab_config_quantity(config_setting_get_elem(pair, 0), "Pa", 0, HUGE_VAL, &bench->low, error))
    return error->status;
  return lab_config_quantity(config_setting_get_elem(pair, 1), "Pa", bench->low + 1, HUGE_VAL, &bench->high, error);
}

static int read_benches(const key *k, const config_setting_t *group, study *s, lab_error *error)
{
  static const char *const keys[] = {"figure", "bench_sets"};
  const config_setting_t *list = config_setting_get_member(group, "bench_sets");
  (void)k;
  if (lab_config_known(group, keys, 2, sizeof *keys, error))
    return error->status;
  if (!list)
    return lab_config_fail(group, error, "expected the key bench_sets");
  if (lab_config_list(list, 1, STUDY_BENCH_MAX, error))
    return error->status;
  for (s->n_benches = 0; s->n_benches < config_setting_length(list); s->n_benches++)
    if (read_bench(config_setting_get_elem(list, (unsigned)s->n_benches), &s->bench[s->n_benches], error))
      return error->status;
  return LAB_OK;
}

static const key keys[] = {{"actuators", read_actuators, 0, NULL, 0},
                           {"consistent", read_actuators, 0, NULL, 1},
                           {"subject", read_subject, 0, NULL, 0},
                           {"gas", read_laws, offsetof(study, gas), NULL, 0},
                           {"flow", read_laws, offsetof(study, flow), NULL, 0},
                           {"results", read_folder, offsetof(study, results), NULL, 0},
                           {"confirmed_below", read_share, offsetof(study, confirmed_below), NULL, 0},
                           {"H1", read_range, offsetof(study, range[0]), "N/m", 0},
                           {"H2", read_range, offsetof(study, range[1]), "N", 0},
                           {"H3", read_range, offsetof(study, range[2]), "1", 0},
                           {"H4", read_benches, 0, NULL, 0},
                           {"H5", read_range, offsetof(study, range[4]), "1", 0}};
enum { KEYS = sizeof keys / sizeof *keys };

static int read_all(config_t *config, study *s, lab_error *error)
{
  const config_setting_t *root = config_root_setting(config);
  int i;
  if (lab_config_known(root, keys, KEYS, sizeof *keys, error))
    return error->status;
  for (i = 0; i < KEYS; i++) {
    const config_setting_t *setting = config_setting_get_member(root, keys[i].name);
    if (!setting && keys[i].optional)
      continue;
    if (!setting)
      return lab_fail(error, LAB_DATA, "%s: key %s is missing", s->file, keys[i].name);
    if (keys[i].read(&keys[i], setting, s, error))
      return error->status;
  }
  return LAB_OK;
}

int study_read(const char *path, study *s, lab_error *error)
{
  config_t config;
  int status;
  memset(s, 0, sizeof *s);
  if (snprintf(s->file, sizeof s->file, "%s", path) >= (int)sizeof s->file)
    return lab_fail(error, LAB_DATA, "path is too long: %s", path);
  status = lab_config_read(&config, s->file, error);
  if (status == LAB_OK)
    status = read_all(&config, s, error);
  config_destroy(&config);
  return status;
}

void study_folder(const study *s, char folder[STUDY_PATH_TEXT])
{
  const char *slash = strrchr(s->file, '/');
  if (slash)
    snprintf(folder, STUDY_PATH_TEXT, "%.*s", (int)(slash - s->file), s->file);
  else
    strcpy(folder, ".");
}

int study_save(const study *s, const char *name, const table *t, lab_error *error)
{
  char path[STUDY_PATH_TEXT + 64];
  lab_outfile out;
  snprintf(path, sizeof path, "%s/%s", s->results, name);
  if (lab_out_open(&out, path, error))
    return error->status;
  if (lab_out_end(&out, table_write(t, out.file, error), error))
    return error->status;
  study_note_saved(s, name);
  return LAB_OK;
}

int table_load(const study *s, const char *name, table *t, lab_error *error)
{
  char path[STUDY_PATH_TEXT + 64];
  snprintf(path, sizeof path, "%s/%s", s->results, name);
  return table_load_file(path, t, error);
}

void study_note_saved(const study *s, const char *name)
{
  if (s->saved)
    lab_append(s->saved->names, sizeof s->saved->names, "%s%s", *s->saved->names ? " " : "", name);
}

pneu_laws study_laws(const lab_rig *rig, int gas, int flow)
{
  pneu_laws laws = rig->laws;
  laws.gas = gas;
  laws.flow = flow;
  return laws;
}

#include "study.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../lab/base/config.h"
#include "../lab/base/outfile.h"

/* A row of the table of keys; the name comes first, as lab_config_known wants it. */
typedef struct key {
  const char *name;
  int (*read)(const config_setting_t *setting, study *s, lab_error *error);
} key;

/* Path beside the study file. */
static int beside(const study *s, const char *name, char *path, lab_error *error)
{
  const char *slash = strrchr(s->file, '/');
  const int folder = name[0] == '/' || !slash ? 0 : (int)(slash - s->file) + 1;
  if (snprintf(path, STUDY_PATH_TEXT, "%.*s%s", folder, s->file, name) < STUDY_PATH_TEXT)
    return LAB_OK;
  return lab_fail(error, LAB_DATA, "path is too long: %s", name);
}

static int read_actuators(const config_setting_t *list, study *s, lab_error *error)
{
  int i;
  if (lab_config_list(list, 1, STUDY_ACTUATOR_MAX, error))
    return error->status;
  for (i = 0; i < config_setting_length(list); i++) {
    const config_setting_t *item = config_setting_get_elem(list, (unsigned)i);
    char name[STUDY_PATH_TEXT], path[STUDY_PATH_TEXT];
    if (lab_config_text(item, name, sizeof name, error) || beside(s, name, path, error) ||
        lab_rig_read(path, &s->actuator[i], error))
      return error->status;
  }
  s->n_actuators = i;
  return LAB_OK;
}

static int read_subject(const config_setting_t *setting, study *s, lab_error *error)
{
  char name[LAB_NAME_TEXT];
  if (lab_config_text(setting, name, sizeof name, error))
    return error->status;
  for (s->subject = 0; s->subject < s->n_actuators; s->subject++)
    if (!strcmp(s->actuator[s->subject].name, name))
      return LAB_OK;
  return lab_config_fail(setting, error, "no actuator of the list is named \"%s\"", name);
}

static int read_laws(const config_setting_t *list, const char *(*name_of)(int), int count, int *law, int *n,
                     lab_error *error)
{
  const char *names[STUDY_LAW_MAX];
  int i;
  for (i = 0; i < count && i < STUDY_LAW_MAX; i++)
    names[i] = name_of(i);
  if (lab_config_list(list, 1, STUDY_LAW_MAX, error))
    return error->status;
  for (*n = 0; *n < config_setting_length(list); ++*n)
    if (lab_config_choice(config_setting_get_elem(list, (unsigned)*n), names, (size_t)i, sizeof *names, &law[*n],
                          error))
      return error->status;
  return LAB_OK;
}

static int read_gas(const config_setting_t *list, study *s, lab_error *error)
{
  return read_laws(list, pneu_gas_key, PNEU_GAS_COUNT, s->gas, &s->n_gas, error);
}

static int read_flow(const config_setting_t *list, study *s, lab_error *error)
{
  return read_laws(list, pneu_flow_key, PNEU_FLOW_COUNT, s->flow, &s->n_flow, error);
}

static int read_results(const config_setting_t *setting, study *s, lab_error *error)
{
  return lab_config_text(setting, s->results, sizeof s->results, error);
}

static int read_measured(const config_setting_t *setting, study *s, lab_error *error)
{
  return lab_config_text(setting, s->measured, sizeof s->measured, error);
}

static int read_confirmed(const config_setting_t *setting, study *s, lab_error *error)
{
  return lab_config_quantity(setting, "1", 0, 1, &s->confirmed_below, error);
}

/* The group of a hypothesis: figure is for the reader, the range is for the program. */
static int read_range(const config_setting_t *group, const char *unit, study_range *range, lab_error *error)
{
  static const char *const keys[] = {"figure", "from", "to", "points"};
  const config_setting_t *from = config_setting_get_member(group, "from");
  const config_setting_t *to = config_setting_get_member(group, "to");
  const config_setting_t *points = config_setting_get_member(group, "points");
  if (lab_config_is_group(group, error) || lab_config_known(group, keys, 4, sizeof *keys, error))
    return error->status;
  if (!from || !to || !points)
    return lab_config_fail(group, error, "expected the keys from, to and points");
  if (lab_config_quantity(from, unit, 0, HUGE_VAL, &range->from, error) ||
      lab_config_quantity(to, unit, range->from, HUGE_VAL, &range->to, error))
    return error->status;
  return lab_config_count(points, 2, 10000, &range->points, error);
}

static int read_h1(const config_setting_t *group, study *s, lab_error *error)
{
  return read_range(group, "N/m", &s->range[0], error);
}

static int read_h2(const config_setting_t *group, study *s, lab_error *error)
{
  return read_range(group, "N", &s->range[1], error);
}

static int read_h3(const config_setting_t *group, study *s, lab_error *error)
{
  return read_range(group, "1", &s->range[2], error);
}

static int read_h5(const config_setting_t *group, study *s, lab_error *error)
{
  return read_range(group, "1", &s->range[4], error);
}

static int read_bench(const config_setting_t *pair, study_bench *bench, lab_error *error)
{
  if (lab_config_list(pair, 2, 2, error))
    return error->status;
  if (lab_config_quantity(config_setting_get_elem(pair, 0), "Pa", 0, HUGE_VAL, &bench->low, error))
    return error->status;
  return lab_config_quantity(config_setting_get_elem(pair, 1), "Pa", bench->low + 1, HUGE_VAL, &bench->high, error);
}

static int read_h4(const config_setting_t *group, study *s, lab_error *error)
{
  static const char *const keys[] = {"figure", "bench_sets"};
  const config_setting_t *list = config_setting_get_member(group, "bench_sets");
  if (lab_config_is_group(group, error) || lab_config_known(group, keys, 2, sizeof *keys, error))
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

static const key keys[] = {{"actuators", read_actuators},
                           {"subject", read_subject},
                           {"gas", read_gas},
                           {"flow", read_flow},
                           {"results", read_results},
                           {"measured", read_measured},
                           {"confirmed_below", read_confirmed},
                           {"H1", read_h1},
                           {"H2", read_h2},
                           {"H3", read_h3},
                           {"H4", read_h4},
                           {"H5", read_h5}};
enum { KEYS = sizeof keys / sizeof *keys };

static int read_all(config_t *config, study *s, lab_error *error)
{
  const config_setting_t *root = config_root_setting(config);
  int i;
  if (lab_config_known(root, keys, KEYS, sizeof *keys, error))
    return error->status;
  for (i = 0; i < KEYS; i++) {
    const config_setting_t *setting = config_setting_get_member(root, keys[i].name);
    if (!setting)
      return lab_fail(error, LAB_DATA, "%s: key %s is missing", s->file, keys[i].name);
    if (keys[i].read(setting, s, error))
      return error->status;
  }
  return LAB_OK;
}

int study_read(const char *path, study *s, lab_error *error)
{
  const char *measured = getenv("MEASURED");
  config_t config;
  int status;
  memset(s, 0, sizeof *s);
  if (snprintf(s->file, sizeof s->file, "%s", path) >= (int)sizeof s->file)
    return lab_fail(error, LAB_DATA, "path is too long: %s", path);
  status = lab_config_read(&config, s->file, error);
  if (status == LAB_OK)
    status = read_all(&config, s, error);
  config_destroy(&config);
  if (status == LAB_OK && measured && *measured)
    snprintf(s->measured, sizeof s->measured, "%s", measured);
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
  if (table_write(t, out.file, error)) {
    lab_out_abandon(&out);
    return error->status;
  }
  if (lab_out_close(&out, error))
    return error->status;
  study_note_saved(s, name);
  return LAB_OK;
}

void study_note_saved(const study *s, const char *name)
{
  size_t used;
  if (!s->saved)
    return;
  used = strlen(s->saved->names);
  snprintf(s->saved->names + used, sizeof s->saved->names - used, "%s%s", used ? " " : "", name);
}

pneu_laws study_laws(const lab_rig *rig, int gas, int flow)
{
  pneu_laws laws = rig->laws;
  laws.gas = gas;
  laws.flow = flow;
  return laws;
}

#include "rigonset.h"

#include <math.h>

#include "../base/config.h"
#include "../base/number.h"

enum { PARAMETER, FROM, VALUE, KEYS };
static const char *const keys[KEYS] = {"parameter", "from", "value"};

static const double narrowest = 1e-3, widest = 1e3; /* factor on the area of an orifice */

/* Members of one onset, in the order of `keys`; all must be there. */
static int find_members(const config_setting_t *group, config_setting_t *member[KEYS], lab_error *error)
{
  int k, status = lab_config_is_group(group, error);
  if (status == LAB_OK)
    status = lab_config_known(group, keys, KEYS, sizeof keys[0], error);
  for (k = 0; status == LAB_OK && k < KEYS; k++) {
    member[k] = config_setting_get_member((config_setting_t *)group, keys[k]);
    if (!member[k])
      status = lab_config_fail(group, error, "expected the keys parameter, from and value; %s is missing", keys[k]);
  }
  return status;
}

static int read_parameter(const config_setting_t *setting, int *param, lab_error *error)
{
  char text[LAB_PARAM_COUNT][LAB_PARAM_NAME_TEXT];
  const char *names[LAB_PARAM_COUNT];
  int i;
  for (i = 0; i < LAB_PARAM_COUNT; i++)
    names[i] = lab_fit_name(i, text[i]);
  return lab_config_choice(setting, names, LAB_PARAM_COUNT, sizeof names[0], param, error);
}

static int read_value(const config_setting_t *setting, lab_rig_onset *onset, lab_error *error)
{
  pneu_param_info info;
  if (onset->param == LAB_PARAM_ORIFICE_AREA)
    return lab_config_quantity(setting, "1", narrowest, widest, &onset->value, error);
  pneu_param_describe(onset->param, &info);
  return lab_config_quantity(setting, info.unit, (double)info.lower, (double)info.upper, &onset->value, error);
}

static int read_onset(const config_setting_t *group, lab_rig *rig, lab_error *error)
{
  lab_rig_onset *onset = &rig->onset[rig->n_onsets];
  config_setting_t *member[KEYS];
  if (find_members(group, member, error) || read_parameter(member[PARAMETER], &onset->param, error) ||
      lab_config_quantity(member[FROM], "s", -INFINITY, INFINITY, &onset->from, error) ||
      read_value(member[VALUE], onset, error))
    return error->status;
  if (rig->n_onsets > 0 && onset->from < onset[-1].from)
    return lab_config_fail(member[FROM], error,
                           "expected no earlier time than that of the entry before, %g s, found %g s", onset[-1].from,
                           onset->from);
  rig->n_onsets++;
  return LAB_OK;
}

int lab_onsets_read(const config_setting_t *list, lab_rig *rig, lab_error *error)
{
  int i, status = lab_config_list(list, 0, LAB_ONSETS_MAX, error);
  for (i = 0; status == LAB_OK && i < config_setting_length(list); i++)
    status = read_onset(config_setting_get_elem(list, (unsigned)i), rig, error);
  return status;
}

void lab_onsets_write(FILE *file, const lab_rig *rig)
{
  char name[LAB_PARAM_NAME_TEXT], from[LAB_NUMBER_TEXT], value[LAB_NUMBER_TEXT];
  int i;
  for (i = 0; i < rig->n_onsets; i++) {
    const lab_rig_onset *onset = &rig->onset[i];
    pneu_param_info info = {.unit = "1"};
    if (onset->param != LAB_PARAM_ORIFICE_AREA)
      pneu_param_describe(onset->param, &info);
    fprintf(file, "%s  { parameter = \"%s\"; from = \"%s s\"; value = \"%s %s\"; }", i ? ",\n" : "onset = (\n",
            lab_fit_name(onset->param, name), lab_number_write(onset->from, from),
            lab_number_write(onset->value, value), info.unit);
  }
  if (rig->n_onsets)
    fputs("\n);\n", file);
}

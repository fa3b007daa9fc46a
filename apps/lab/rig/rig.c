#include "rig.h"

#include <math.h>
#include <string.h>

#include "../base/config.h"
#include "../base/escape.h"
#include "../base/names.h"
#include "rigkeys.h"
#include "rigterm.h"
#include "sheet.h"
#include "tolerance.h"
#include "../base/text.h"

/* ---- What can be fitted ---- */

pneu_param_info lab_param_info(int param)
{
  pneu_param_info info = {.name = "orifice_area", .unit = "1", .lower = (pneu_real)1e-3, .upper = (pneu_real)1e3};
  if (param != LAB_PARAM_ORIFICE_AREA)
    pneu_param_describe(param, &info);
  return info;
}

double lab_param_value(const lab_rig *rig, int param)
{
  return param == LAB_PARAM_ORIFICE_AREA ? 1 : (double)*pneu_param_at((pneu_params *)&rig->params, param);
}

const char *lab_fit_name(int index, char name[LAB_PARAM_NAME_TEXT])
{
  const int is_effects = index >= PNEU_PARAM_BASE_COUNT && index != LAB_PARAM_ORIFICE_AREA;
  snprintf(name, LAB_PARAM_NAME_TEXT, "%s%s%s", is_effects ? pneu_effect_at(pneu_effect_of(index))->name : "",
           is_effects ? "." : "", lab_param_info(index).name);
  return name;
}

int lab_param_index(const char *name)
{
  char text[LAB_PARAM_NAME_TEXT];
  int i;
  for (i = 0; i < LAB_PARAM_COUNT; i++)
    if (!strcmp(lab_fit_name(i, text), name))
      return i;
  return -1;
}

/* ---- Keys ---- */

/* A parameter, within its bounds. */
static int read_param(const config_setting_t *setting, int param, lab_rig *rig, lab_error *error)
{
  const pneu_param_info info = lab_param_info(param);
  double value;
  if (lab_config_quantity(setting, info.unit, (double)info.lower, (double)info.upper, &value, error))
    return error->status;
  *pneu_param_at(&rig->params, param) = (pneu_real)value;
  rig->assumed[param] = 0;
  return LAB_OK;
}

static int read_name(const config_setting_t *setting, lab_rig *rig, lab_error *error)
{
  if (lab_config_text(setting, rig->name, sizeof rig->name, error))
    return error->status;
  if (*rig->name && lab_is_plain(rig->name))
    return LAB_OK;
  return lab_config_expected(setting, "a name in UTF-8, without control characters or marks that turn the writing",
                             error);
}

static int read_key(const config_setting_t *setting, const lab_key *key, lab_rig *rig, lab_error *error)
{
  if (key->kind == LAB_KEY_PARAM)
    return read_param(setting, key->param, rig, error);
  if (key->kind == LAB_KEY_NAME)
    return read_name(setting, rig, error);
  return lab_config_choice(setting, key->words, (size_t)key->n, sizeof *key->words, (int *)((char *)rig + key->member),
                           error);
}

/* ---- Groups ---- */

/* The row of a key, -1 where its group has none of that name. */
static int key_row(const char *group, const char *key)
{
  int i;
  for (i = 0; i < lab_key_count; i++)
    if (strcmp(lab_keys[i].group, group) == 0 && strcmp(lab_keys[i].key, key) == 0)
      return i;
  return -1;
}

/* The nearest key of the same group, or the group where the key is at home. */
static int unknown_key(const config_setting_t *setting, const char *group, lab_error *error)
{
  const char *key = config_setting_name(setting), *names[64];
  int i, n = 0, elsewhere = lab_name_index(key, lab_keys, (size_t)lab_key_count, sizeof lab_keys[0]);
  if (elsewhere >= 0)
    return lab_config_fail(setting, error, "unknown key; %s belongs to the group %s", key, lab_keys[elsewhere].group);
  for (i = 0; i < lab_key_count; i++)
    if (strcmp(lab_keys[i].group, group) == 0)
      names[n++] = lab_keys[i].key;
  return lab_config_unknown(setting, names, (size_t)n, sizeof names[0], error);
}

/* A group of the key table. */
static int read_keys(const config_setting_t *group, lab_rig *rig, lab_error *error)
{
  int i, row, status = lab_config_is_group(group, error);
  for (i = 0; status == LAB_OK && i < config_setting_length(group); i++) {
    const config_setting_t *setting = config_setting_get_elem(group, (unsigned)i);
    if (lab_sheet_has(config_setting_name(group), config_setting_name(setting)))
      continue;
    row = key_row(config_setting_name(group), config_setting_name(setting));
    if (row < 0)
      return unknown_key(setting, config_setting_name(group), error);
    status = read_key(setting, &lab_keys[row], rig, error);
  }
  return status;
}

/* A friction law is an effect at its usual size. */
static int read_laws(const config_setting_t *group, lab_rig *rig, lab_error *error)
{
  const char *effect;
  int i, first, count;
  if (read_keys(group, rig, error))
    return error->status;
  effect = lab_friction_effects[rig->friction];
  if (!effect)
    return LAB_OK;
  if (pneu_effect_find(effect) < 0)
    return lab_config_fail(lab_config_member(group, "friction"), error, "this build of the library has no effect %s",
                           effect);
  first = pneu_effect_params(pneu_effect_find(effect), &count);
  for (i = first; i < first + count; i++)
    *pneu_param_at(&rig->params, i) = lab_param_info(i).value;
  return LAB_OK;
}

static int read_effect(const config_setting_t *group, int effect, lab_rig *rig, lab_error *error)
{
  const char *names[PNEU_PARAM_COUNT];
  int i, k, count, first = pneu_effect_params(effect, &count), status;
  for (k = 0; k < count; k++)
    names[k] = lab_param_info(first + k).name;
  status = lab_config_known(group, names, (size_t)count, sizeof names[0], error);
  for (i = 0; status == LAB_OK && i < config_setting_length(group); i++) {
    const config_setting_t *setting = config_setting_get_elem(group, (unsigned)i);
    status = read_param(setting, pneu_param_find(config_setting_name(setting)), rig, error);
  }
  return status;
}

static int check_cutoffs(const config_setting_t *group, const lab_rig *rig, lab_error *error)
{
  const double low = lab_param_value(rig, pneu_param_find("positioner.cutoff_low")),
               high = lab_param_value(rig, pneu_param_find("positioner.cutoff_high"));
  if (!(high > 0) || low < high)
    return LAB_OK;
  return lab_config_fail(
      group, error,
      "cutoff_low, %g %%, is not below cutoff_high, %g %%: nothing would be positioned between them; 0 is none",
      100 * low, 100 * high);
}

/* A positioner has its usual gain unless the group says otherwise. */
static int read_positioner(const config_setting_t *group, lab_rig *rig, lab_error *error)
{
  const int gain = pneu_param_find("positioner.gain");
  if (gain < 0)
    return lab_config_fail(group, error, "this build of the library has no positioner");
  *pneu_param_at(&rig->params, gain) = lab_param_info(gain).value;
  return read_effect(group, pneu_effect_of(gain), rig, error) ? error->status : check_cutoffs(group, rig, error);
}

static int read_effects(const config_setting_t *group, lab_rig *rig, lab_error *error)
{
  const char *names[PNEU_EFFECT_COUNT + 1];
  const int positioner = pneu_effect_find("positioner"); /* has a group of its own */
  int i, n = 0, status;
  for (i = 0; i < PNEU_EFFECT_COUNT; i++)
    if (i != positioner)
      names[n++] = pneu_effect_at(i)->name;
  status = lab_config_known(group, names, (size_t)n, sizeof names[0], error);
  for (i = 0; status == LAB_OK && i < config_setting_length(group); i++) {
    const config_setting_t *member = config_setting_get_elem(group, (unsigned)i);
    status = read_effect(member, pneu_effect_find(config_setting_name(member)), rig, error);
  }
  return status;
}

/* ---- Lists ---- */

/* One more name to fit; each once, and orifice_area not beside what it scales. */
static int add_fit(const config_setting_t *setting, int index, lab_rig *rig, lab_error *error)
{
  const int area[2] = {PNEU_PARAM_fill_area, PNEU_PARAM_vent_area};
  char name[LAB_PARAM_NAME_TEXT];
  int i;
  for (i = 0; i < rig->n_fit; i++) {
    int other = rig->fit[i];
    if (other == index)
      return lab_config_fail(setting, error, "%s is there twice", lab_fit_name(index, name));
    if ((index == LAB_PARAM_ORIFICE_AREA && (other == area[0] || other == area[1])) ||
        (other == LAB_PARAM_ORIFICE_AREA && (index == area[0] || index == area[1])))
      return lab_config_fail(setting, error, "orifice_area scales fill_area and vent_area: give it alone, or these");
  }
  rig->fit[rig->n_fit++] = index;
  return LAB_OK;
}

/* The name of something that can be fitted. */
static int read_fit_name(const config_setting_t *setting, int *index, lab_error *error)
{
  char text[LAB_PARAM_COUNT][LAB_PARAM_NAME_TEXT];
  const char *names[LAB_PARAM_COUNT];
  int i;
  for (i = 0; i < LAB_PARAM_COUNT; i++)
    names[i] = lab_fit_name(i, text[i]);
  return lab_config_choice(setting, names, LAB_PARAM_COUNT, sizeof names[0], index, error);
}

/* The lists fit and fit_per_log. */
static int read_fit(const config_setting_t *list, lab_rig *rig, lab_error *error)
{
  const int per_log = strcmp(config_setting_name(list), "fit_per_log") == 0;
  int i, index, status = lab_config_list(list, 0, LAB_PARAM_COUNT, error);
  for (i = 0; status == LAB_OK && i < config_setting_length(list); i++) {
    const config_setting_t *setting = config_setting_get_elem(list, (unsigned)i);
    status = read_fit_name(setting, &index, error);
    if (status == LAB_OK)
      status = add_fit(setting, index, rig, error);
    if (status == LAB_OK)
      rig->fit_per_log[rig->n_fit - 1] = (unsigned char)per_log;
  }
  return status;
}

/* Commands have no noise. */
static int has_noise(int channel)
{
  return channel != LAB_CHANNEL_U && channel != LAB_CHANNEL_SP;
}

/* Channel of a key in the noise group, "pressure" or "p"; -1: none */
static int noise_channel(const char *key)
{
  int i;
  for (i = 0; i < LAB_CHANNEL_COUNT; i++)
    if (has_noise(i) && (strcmp(lab_channels[i].quantity, key) == 0 || strcmp(lab_channels[i].key, key) == 0))
      return i;
  return -1;
}

static int unknown_noise(const config_setting_t *setting, lab_error *error)
{
  const char *known[LAB_CHANNEL_COUNT];
  size_t n = 0;
  int i;
  for (i = 0; i < LAB_CHANNEL_COUNT; i++)
    if (has_noise(i))
      known[n++] = lab_channels[i].quantity;
  return lab_config_unknown(setting, known, n, sizeof *known, error);
}

static int read_noise(const config_setting_t *group, lab_rig *rig, lab_error *error)
{
  int i, status = lab_config_is_group(group, error);
  for (i = 0; status == LAB_OK && i < config_setting_length(group); i++) {
    const config_setting_t *setting = config_setting_get_elem(group, (unsigned)i);
    const int channel = noise_channel(config_setting_name(setting));
    if (channel < 0)
      return unknown_noise(setting, error);
    status = lab_config_difference(setting, lab_channels[channel].unit, &rig->noise[channel], error);
    if (status == LAB_OK && !(rig->noise[channel] > 0))
      status = lab_config_expected(setting, "a standard deviation above 0", error);
  }
  return status;
}

static int read_inputs(const config_setting_t *list, lab_rig *rig, lab_error *error)
{
  static const struct input_word {
    const char *name;
    int channel;
  } words[] = {{"u", LAB_CHANNEL_U},
               {"p", LAB_CHANNEL_P},
               {"x", LAB_CHANNEL_X},
               {"ps", LAB_CHANNEL_PS},
               {"force", LAB_CHANNEL_FORCE}};
  enum { WORDS = sizeof words / sizeof words[0] };
  int i, word, status = lab_config_list(list, 1, WORDS, error);
  for (i = 0; status == LAB_OK && i < config_setting_length(list); i++) {
    status = lab_config_choice(config_setting_get_elem(list, (unsigned)i), words, WORDS, sizeof words[0], &word, error);
    if (status == LAB_OK)
      rig->input[words[word].channel] = 1;
  }
  rig->laws.pressure_input = rig->input[LAB_CHANNEL_P];
  rig->laws.position_input = rig->input[LAB_CHANNEL_X];
  return status;
}

/* What units in a log may refer to. */
static void tell_log(lab_rig *rig)
{
  rig->log.command_is_pressure = rig->params.proportional_band > 0;
  rig->log.stroke = (double)rig->params.stroke;
}

static int read_log(const config_setting_t *group, lab_rig *rig, lab_error *error)
{
  tell_log(rig);
  return lab_log_format_read(group, &rig->log, error);
}

static int read_unlisted(const config_setting_t *list, lab_rig *rig, lab_error *error)
{
  return lab_terms_read(list, LAB_TERM_MAX, rig->term, &rig->n_terms, error);
}

/* ---- What begins within a log ---- */

enum { PARAMETER, FROM, VALUE, KEYS };
static const char *const keys[KEYS] = {"parameter", "from", "value"};

static int read_onset(const config_setting_t *group, lab_rig *rig, lab_error *error)
{
  lab_rig_onset *onset = &rig->onset[rig->n_onsets];
  pneu_param_info info;
  const config_setting_t *member[KEYS];
  if (lab_config_members(group, keys, KEYS, KEYS, member, error) ||
      read_fit_name(member[PARAMETER], &onset->param, error) ||
      lab_config_quantity(member[FROM], "s", -INFINITY, INFINITY, &onset->from, error))
    return error->status;
  info = lab_param_info(onset->param);
  if (lab_config_quantity(member[VALUE], info.unit, (double)info.lower, (double)info.upper, &onset->value, error))
    return error->status;
  if (rig->n_onsets > 0 && onset->from < onset[-1].from)
    return lab_config_fail(member[FROM], error,
                           "expected no earlier time than that of the entry before, %g s, found %g s", onset[-1].from,
                           onset->from);
  rig->n_onsets++;
  return LAB_OK;
}

static int read_onsets(const config_setting_t *list, lab_rig *rig, lab_error *error)
{
  int i, status = lab_config_list(list, 0, LAB_ONSETS_MAX, error);
  for (i = 0; status == LAB_OK && i < config_setting_length(list); i++)
    status = read_onset(config_setting_get_elem(list, (unsigned)i), rig, error);
  return status;
}

/* ---- All sections ---- */

/* By lab_sheet_read, when all else is known. */
static int read_later(const config_setting_t *group, lab_rig *rig, lab_error *error)
{
  (void)rig;
  return lab_config_is_group(group, error);
}

/* In the order of reading: effects after the friction law, log after the transducer. */
static const struct section {
  const char *name;
  int (*read)(const config_setting_t *, lab_rig *, lab_error *);
} sections[] = {
    {"actuator", read_keys},
    {"transducer", read_keys},
    {"supply", read_keys},
    {"ambient", read_keys},
    {"gas", read_keys},
    {"laws", read_laws},
    {"fit", read_fit},
    {"fit_per_log", read_fit},
    {"noise", read_noise},
    {"inputs", read_inputs},
    {"positioner", read_positioner},
    {"effects", read_effects},
    {"unlisted", read_unlisted},
    {"onset", read_onsets},
    {"tolerance", lab_tolerance_read},
    {"tube", read_later},
    {"log", read_log},
};
enum { SECTIONS = sizeof sections / sizeof sections[0] };

/* ---- The whole file ---- */

void lab_rig_default(lab_rig *rig)
{
  int i;
  memset(rig, 0, sizeof *rig);
  strcpy(rig->name, "rig");
  pneu_params_default(&rig->params);
  rig->input[LAB_CHANNEL_U] = 1;
  for (i = 0; i < LAB_CHANNEL_COUNT; i++)
    rig->noise[i] = NAN;
  for (i = 0; i < LAB_TOLERANCE_COUNT; i++)
    rig->tolerance[i] = NAN;
  lab_log_format_default(&rig->log);
  tell_log(rig);
}

/* "study/actuators/r1-400.cfg" -> "r1-400" */
static void name_from_path(const char *path, char name[LAB_NAME_TEXT])
{
  char *dot;
  snprintf(name, LAB_NAME_TEXT, "%s", lab_file_name(path));
  dot = strrchr(name, '.');
  if (dot && dot > name)
    *dot = '\0';
  lab_make_plain(name);
}

/* A rig that can fill must have something to fill from. */
static int check_supply(const config_t *config, const lab_rig *rig, lab_error *error)
{
  const config_setting_t *setting = config_lookup(config, "supply.pressure");
  if (rig->params.supply_pressure > 0 || rig->params.fill_area == 0 || rig->laws.pressure_input || !setting)
    return LAB_OK;
  return lab_config_fail(setting, error,
                         "expected more than 0 Pa gauge (supply above ambient), found %g Pa; a rig "
                         "that only vents has transducer.fill_area = 0",
                         (double)rig->params.supply_pressure);
}

static int is_active(const pneu_model *model, int effect)
{
  int i;
  for (i = 0; i < model->n_active; i++)
    if (model->active[i] == effect)
      return 1;
  return 0;
}

static int check_effects_act(const lab_rig *rig, const pneu_model *model, lab_error *error)
{
  int e, i, count;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    const int first = pneu_effect_params(e, &count);
    for (i = 0; i < count && !is_active(model, e); i++) {
      const pneu_param_info info = lab_param_info(first + i);
      if (!info.shape && lab_param_value(rig, first + i) != (double)info.neutral)
        return lab_fail(error, LAB_DATA,
                        "%s: %s%s.%s does nothing with the other laws and effects declared (gas law \"%s\"): %s",
                        rig->file, e == pneu_effect_find("positioner") ? "" : "effects.", pneu_effect_at(e)->name,
                        info.name, pneu_gas_key(rig->laws.gas), info.meaning);
    }
  }
  return LAB_OK;
}

void lab_rig_drop_idle(lab_rig *rig)
{
  pneu_model model;
  lab_error ignored;
  int e, i, n;
  if (lab_rig_model(rig, &model, &ignored))
    return;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++)
    for (i = pneu_effect_params(e, &n); n > 0 && !is_active(&model, e); i++, n--)
      if (!lab_param_info(i).shape)
        *pneu_param_at(&rig->params, i) = lab_param_info(i).neutral;
}

static int check_terms_act(const lab_rig *rig, const pneu_model *model, lab_error *error)
{
  const int heats = model->thermal && rig->laws.gas != PNEU_GAS_POLYTROPIC;
  int i;
  for (i = 0; i < rig->n_terms; i++)
    if (rig->term[i].equation == PNEU_TERM_HEAT && !heats)
      return lab_fail(error, LAB_DATA,
                      "%s: unlisted[%d]: heat does nothing with the other laws declared (gas law \"%s\"); it needs "
                      "the gas law \"energy\"",
                      rig->file, i, pneu_gas_key(rig->laws.gas));
  return LAB_OK;
}

static int check_fit_acts(const lab_rig *rig, lab_error *error)
{
  const int positioner = pneu_effect_find("positioner");
  char name[LAB_PARAM_NAME_TEXT];
  int i;
  for (i = 0; i < rig->n_fit; i++)
    if (positioner >= 0 && pneu_effect_of(rig->fit[i]) == positioner && !lab_rig_has_positioner(rig))
      return lab_fail(error, LAB_DATA,
                      "%s: %s is to be fitted, but no positioner is declared: positioner = { }; has the usual gain",
                      rig->file, lab_fit_name(rig->fit[i], name));
  return LAB_OK;
}

/* What is set but cannot act under the declared laws is a mistake, not a remark. */
static int check_all_acts(const lab_rig *rig, lab_error *error)
{
  lab_rig last;
  pneu_model model;
  if (lab_rig_model(rig, &model, error) || check_effects_act(rig, &model, error) ||
      check_terms_act(rig, &model, error) || check_fit_acts(rig, error))
    return error->status;
  lab_rig_at(rig, INFINITY, &last);
  return lab_rig_model(&last, &model, error) ? error->status : check_effects_act(&last, &model, error);
}

static int read_sections(const config_t *config, lab_rig *rig, lab_error *error)
{
  const config_setting_t *root = config_root_setting(config);
  int i, status = lab_config_known(root, sections, SECTIONS, sizeof sections[0], error);
  for (i = 0; status == LAB_OK && i < SECTIONS; i++) {
    const config_setting_t *member = lab_config_member(root, sections[i].name);
    if (member)
      status = sections[i].read(member, rig, error);
  }
  if (status == LAB_OK)
    status = lab_sheet_read(root, rig, error);
  tell_log(rig);
  return status == LAB_OK ? check_supply(config, rig, error) : status;
}

/* What a file or a text declares, and the end of it. */
static int take_config(config_t *config, int status, lab_rig *rig, lab_error *error)
{
  if (status == LAB_OK)
    status = read_sections(config, rig, error);
  config_destroy(config);
  return status == LAB_OK ? check_all_acts(rig, error) : status;
}

static void begin(const char *path, lab_rig *rig)
{
  lab_rig_default(rig);
  memset(rig->assumed, 1, sizeof rig->assumed);
  rig->assumed[LAB_PARAM_ORIFICE_AREA] = 0;
  snprintf(rig->file, sizeof rig->file, "%s", path);
  name_from_path(path, rig->name);
}

int lab_rig_read(const char *path, lab_rig *rig, lab_error *error)
{
  config_t config;
  begin(path, rig);
  return take_config(&config, lab_config_read(&config, path, error), rig, error);
}

int lab_rig_parse(const char *text, const char *path, lab_rig *rig, lab_error *error)
{
  config_t config;
  begin(path, rig);
  return take_config(&config, lab_config_parse(&config, text, path, error), rig, error);
}

static void begin_onset(const lab_rig_onset *onset, pneu_params *params)
{
  if (onset->param != LAB_PARAM_ORIFICE_AREA) {
    *pneu_param_at(params, onset->param) = (pneu_real)onset->value;
    return;
  }
  params->fill_area *= (pneu_real)onset->value;
  params->vent_area *= (pneu_real)onset->value;
}

double lab_rig_outflow(const lab_rig *rig, double p, double x)
{
  const pneu_input input = {.supply_pressure = rig->params.supply_pressure};
  const pneu_state state = {
      .p = (pneu_real)p, .T = rig->params.ambient_temperature, .x = (pneu_real)x, .mode = PNEU_MODE_STUCK};
  pneu_model model;
  pneu_output out;
  lab_error error;
  if (lab_rig_model(rig, &model, &error) || pneu_observe(&model, &state, &input, &out) != PNEU_OK)
    return (double)NAN;
  return (double)out.mass_out;
}

double lab_rig_leak(const lab_rig *rig, int param)
{
  const double supply = (double)rig->params.supply_pressure, stroke = (double)rig->params.stroke;
  lab_rig without = *rig;
  *pneu_param_at(&without.params, param) = 0;
  return lab_rig_outflow(rig, supply, stroke) - lab_rig_outflow(&without, supply, stroke);
}

void lab_rig_at(const lab_rig *rig, double t, lab_rig *now)
{
  int i;
  *now = *rig;
  now->n_onsets = 0;
  for (i = 0; i < rig->n_onsets && rig->onset[i].from <= t; i++)
    begin_onset(&rig->onset[i], &now->params);
}

int lab_rig_has_positioner(const lab_rig *rig)
{
  const int gain = pneu_param_find("positioner.gain");
  return gain >= 0 && lab_param_value(rig, gain) > 0;
}

void lab_rig_free_integral(lab_rig *rig)
{
  static const double usual = 0.02; /* of the stroke: opens by 0.4 at the usual gain; by judgement */
  const int time = pneu_param_find("positioner.integral_time"), start = pneu_param_find("positioner.integral_start");
  if (start < 0 || !lab_rig_has_positioner(rig) || !(lab_param_value(rig, time) > 0) || lab_rig_fits(rig, start) ||
      !rig->assumed[start] || !isnan(rig->tolerance[start]) || rig->others_are_exact)
    return;
  rig->fit[rig->n_fit] = start;
  rig->fit_per_log[rig->n_fit++] = 1;
  rig->tolerance[start] = usual;
}

int lab_rig_fits(const lab_rig *rig, int param)
{
  int i, any = 0;
  for (i = 0; i < rig->n_fit; i++)
    any |= rig->fit[i] == param;
  return any;
}

int lab_rig_model(const lab_rig *rig, pneu_model *model, lab_error *error)
{
  char name[LAB_PARAM_NAME_TEXT];
  int bad, status = pneu_model_init(model, &rig->params, &rig->laws, &bad);
  if (status != PNEU_OK)
    return lab_fail(error, LAB_DATA, "%s: %s%s%s", rig->file, bad >= 0 ? lab_fit_name(bad, name) : "",
                    bad >= 0 ? ": " : "", pneu_status_text(status));
  if (model->band_edge > 0)
    model->band_edge = (pneu_real)fmax((double)model->band_edge, rig->band_edge);
  status = pneu_model_terms(model, rig->term, rig->n_terms);
  if (status != PNEU_OK)
    return lab_fail(error, LAB_DATA, "%s: unlisted: %s", rig->file, pneu_status_text(status));
  return LAB_OK;
}

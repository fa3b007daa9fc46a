#include "rig.h"

#include <math.h>
#include <string.h>

#include "../base/escape.h"
#include "../base/number.h"
#include "rigkeys.h"
#include "rigterm.h"
#include "tolerance.h"

static void write_param(FILE *file, const lab_rig *rig, const char *key, int param, int indent)
{
  const pneu_param_info info = lab_param_info(param);
  char number[LAB_NUMBER_TEXT];
  lab_number_write(lab_param_value(rig, param), number);
  if (strcmp(info.unit, "1") == 0)
    fprintf(file, "%*s%s = %s;\n", indent, "", key, number);
  else
    fprintf(file, "%*s%s = \"%s %s\";\n", indent, "", key, number, info.unit);
}

static void write_key(FILE *file, const lab_rig *rig, const lab_key *key)
{
  if (key->kind == LAB_KEY_PARAM) {
    write_param(file, rig, key->key, key->param, 2);
  } else if (key->kind == LAB_KEY_NAME) {
    fprintf(file, "  %s = ", key->key);
    lab_put_config(file, rig->name);
    fputs(";\n", file);
  } else {
    fprintf(file, "  %s = \"%s\";\n", key->key, key->words[*(const int *)((const char *)rig + key->member)]);
  }
}

/* The groups of the key table. */
static void write_keys(FILE *file, const lab_rig *rig)
{
  const char *group = "";
  int i;
  for (i = 0; i < lab_key_count; i++) {
    if (strcmp(lab_keys[i].group, group) != 0)
      fprintf(file, "%s%s = {\n", *group ? "};\n" : "", lab_keys[i].group);
    group = lab_keys[i].group;
    write_key(file, rig, &lab_keys[i]);
  }
  fputs("};\n", file);
}

static void write_fit(FILE *file, const lab_rig *rig, const char *key, int per_log)
{
  char name[LAB_PARAM_NAME_TEXT];
  int i, any = 0;
  for (i = 0; i < rig->n_fit; i++)
    if (rig->fit_per_log[i] == per_log)
      fprintf(file, "%s%s\"%s\"", any ? ", " : key, any ? "" : " = ( ", lab_fit_name(rig->fit[i], name)), any = 1;
  if (any)
    fputs(" );\n", file);
}

static void write_noise(FILE *file, const lab_rig *rig)
{
  char number[LAB_NUMBER_TEXT];
  int i, any = 0;
  for (i = 0; i < LAB_CHANNEL_COUNT; i++)
    if (!isnan(rig->noise[i]))
      fprintf(file, "%s  %s = \"%s %s\";\n", any++ ? "" : "noise = {\n", lab_channels[i].quantity,
              lab_number_write(rig->noise[i], number), lab_channels[i].unit);
  if (any)
    fputs("};\n", file);
}

static void write_inputs(FILE *file, const lab_rig *rig)
{
  int i, any = 0;
  fputs("inputs = [ ", file);
  for (i = 0; i < LAB_CHANNEL_COUNT; i++)
    if (rig->input[i])
      fprintf(file, "%s\"%s\"", any++ ? ", " : "", lab_channels[i].key);
  fputs(" ];\n", file);
}

/* An effect is written if it acts, or if the friction law would switch it on. */
static int is_written(const lab_rig *rig, int effect)
{
  const char *law = lab_friction_effects[rig->friction];
  int i, count, first = pneu_effect_params(effect, &count);
  for (i = first; i < first + count; i++)
    if (lab_param_value(rig, i) != (double)lab_param_info(i).neutral)
      return 1;
  return law && strcmp(law, pneu_effect_at(effect)->name) == 0;
}

static void write_effect(FILE *file, const lab_rig *rig, int effect, int indent)
{
  int i, count, first = pneu_effect_params(effect, &count);
  fprintf(file, "%*s%s = {\n", indent, "", pneu_effect_at(effect)->name);
  for (i = first; i < first + count; i++)
    write_param(file, rig, lab_param_info(i).name, i, indent + 2);
  fprintf(file, "%*s};\n", indent, "");
}

static void write_positioner(FILE *file, const lab_rig *rig)
{
  const int positioner = pneu_effect_find("positioner");
  if (positioner >= 0 && is_written(rig, positioner))
    write_effect(file, rig, positioner, 0);
}

static void write_effects(FILE *file, const lab_rig *rig)
{
  int i, any = 0;
  for (i = 0; i < PNEU_EFFECT_COUNT; i++)
    if (is_written(rig, i) && i != pneu_effect_find("positioner")) {
      fputs(any++ ? "" : "effects = {\n", file);
      write_effect(file, rig, i, 2);
    }
  if (any)
    fputs("};\n", file);
}

static void write_onsets(FILE *file, const lab_rig *rig)
{
  char name[LAB_PARAM_NAME_TEXT], from[LAB_NUMBER_TEXT], value[LAB_NUMBER_TEXT];
  int i;
  for (i = 0; i < rig->n_onsets; i++) {
    const lab_rig_onset *onset = &rig->onset[i];
    fprintf(file, "%s  { parameter = \"%s\"; from = \"%s s\"; value = \"%s %s\"; }", i ? ",\n" : "onset = (\n",
            lab_fit_name(onset->param, name), lab_number_write(onset->from, from),
            lab_number_write(onset->value, value), lab_param_info(onset->param).unit);
  }
  if (rig->n_onsets)
    fputs("\n);\n", file);
}

static void write_remark(FILE *file, const char *remark)
{
  while (remark && *remark) {
    int length = (int)strcspn(remark, "\n");
    fprintf(file, "// %.*s\n", length, remark);
    remark += length + (remark[length] == '\n');
  }
}

void lab_rig_write(FILE *file, const lab_rig *rig, const char *remark)
{
  write_remark(file, remark);
  write_keys(file, rig);
  write_fit(file, rig, "fit", 0);
  write_fit(file, rig, "fit_per_log", 1);
  lab_tolerance_write(file, rig);
  write_noise(file, rig);
  write_inputs(file, rig);
  write_positioner(file, rig);
  write_effects(file, rig);
  lab_terms_write(file, rig->term, rig->n_terms);
  write_onsets(file, rig);
  lab_log_format_write(file, &rig->log);
}

/* A parameter in C, with what comes before and after it. */
static void write_c(FILE *file, const lab_rig *rig, int param, const char *before)
{
  const pneu_param_info info = lab_param_info(param);
  char number[LAB_NUMBER_TEXT];
  fprintf(file, "%s(pneu_real)%s, /* %s [%s] */ \\\n", before, lab_number_write(lab_param_value(rig, param), number),
          info.name, info.unit);
}

/* Parameters of the effects that are not neutral, or of all, each by its name. */
static void write_c_by_name(FILE *file, const lab_rig *rig, int whole)
{
  char place[128];
  int e, i, count;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++)
    for (i = pneu_effect_params(e, &count); count > 0 && (whole || is_written(rig, e)); i++, count--) {
      snprintf(place, sizeof place, "    [PNEU_AT_%s + %d] = ", pneu_effect_at(e)->name,
               i - pneu_effect_params(e, NULL));
      write_c(file, rig, i, place);
    }
}

/* Parameters of all effects by their places, and what these places are. */
static void write_c_by_place(FILE *file, const lab_rig *rig)
{
  int e, i;
  for (i = PNEU_PARAM_BASE_COUNT; i < PNEU_PARAM_COUNT; i++)
    write_c(file, rig, i, "    ");
  fputs("    (pneu_real)0\ntypedef char model_needs_the_whole_catalogue[ \\\n", file);
  for (e = 0; e < PNEU_EFFECT_COUNT; e++)
    fprintf(file, "    PNEU_AT_%s == %d && \\\n", pneu_effect_at(e)->name,
            pneu_effect_params(e, NULL) - PNEU_PARAM_BASE_COUNT);
  fprintf(file, "    PNEU_EFFECT_PARAM_COUNT == %d ? 1 : -1];\n", PNEU_EFFECT_PARAM_COUNT);
}

void lab_rig_write_c(FILE *file, const lab_rig *rig, int whole)
{
  int i;
  fputs("#if defined(__STDC_VERSION__) && __STDC_VERSION__ >= 199901L && !defined(__cplusplus)\n"
        "#define MODEL_EFFECTS \\\n",
        file);
  write_c_by_name(file, rig, whole);
  fputs("    [PNEU_EFFECT_PARAM_COUNT] = (pneu_real)0\n#else\n#define MODEL_EFFECTS \\\n", file);
  write_c_by_place(file, rig);
  fputs("#endif\n#define MODEL_PARAMS \\\n  { \\\n", file);
  for (i = 0; i < PNEU_PARAM_BASE_COUNT; i++)
    write_c(file, rig, i, "    ");
  fprintf(file, "    { MODEL_EFFECTS } \\\n  }\n#define MODEL_LAWS {%d, %d, %d, %d} /* %s, %s */\n", rig->laws.gas,
          rig->laws.flow, rig->laws.pressure_input, rig->laws.position_input, pneu_gas_key(rig->laws.gas),
          pneu_flow_key(rig->laws.flow));
  lab_terms_print_c(file, rig->term, rig->n_terms);
}

void lab_rig_write_catalogue(FILE *file, const lab_rig *rig)
{
  static const char *const lines[] = {
#define PNEU_EFFECT(name, n_param, n_state) "PNEU_EFFECT(" #name ", " #n_param ", " #n_state ")",
#include "../../../lib/effects.def"
#undef PNEU_EFFECT
      NULL};
  int e;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++)
    if (is_written(rig, e))
      fprintf(file, "%s\n", lines[e]);
}

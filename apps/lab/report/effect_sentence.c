#include "report.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../base/format.h"
#include "../base/text.h"

/* ---- Sizes: each from a rig and the parameter of an effect, of which the amount counts ---- */

enum { NONE = -1 };

typedef struct about {
  lab_rig rig;
  int param;
  double value; /* of it, without its sign */
} about;

static double of_itself(const about *a)
{
  return a->value;
}

static double reciprocal(const about *a)
{
  return 1 / a->value;
}

static double friction_rise(const about *a)
{
  return a->value * (double)a->rig.params.supply_pressure;
}

/* Of the straight spring's force at full stroke. */
static double of_spring(const about *a)
{
  const pneu_params *p = &a->rig.params;
  const double stroke = (double)p->stroke;
  return 100 * a->value * pow(stroke, 3) / ((double)p->spring_rate * (stroke + (double)p->spring_preload));
}

/* Flow of an orifice between supply and ambient pressure [kg/s]. */
static double full_flow(const about *a, double area)
{
  const pneu_params *p = &a->rig.params;
  pneu_model model;
  pneu_flow flow;
  lab_error error;
  if (lab_rig_model(&a->rig, &model, &error))
    return (double)NAN;
  pneu_orifice(&model, a->rig.laws.flow, (pneu_real)area, p->supply_pressure + p->ambient_pressure,
               p->supply_temperature, p->ambient_pressure, &flow);
  return (double)flow.q;
}

static double fill_drop(const about *a)
{
  return a->value * full_flow(a, (double)a->rig.params.fill_area);
}

static double vent_drop(const about *a)
{
  return a->value * full_flow(a, (double)a->rig.params.vent_area);
}

/* What leaves a chamber at supply pressure while both orifices are shut [kg/s]. */
static double outflow(const lab_rig *rig)
{
  const pneu_params *p = &rig->params;
  const pneu_input input = {.supply_pressure = p->supply_pressure};
  const pneu_state state = {
      .p = p->supply_pressure, .T = p->ambient_temperature, .x = p->stroke, .mode = PNEU_MODE_STUCK};
  pneu_model model;
  pneu_output out;
  lab_error error;
  if (lab_rig_model(rig, &model, &error) || pneu_observe(&model, &state, &input, &out) != PNEU_OK)
    return (double)NAN;
  return (double)out.mass_out;
}

/* How much more that is with the effect than without [kg/s]. */
static double leak(const about *a)
{
  lab_rig without = a->rig;
  *pneu_param_at(&without.params, a->param) = 0;
  return outflow(&a->rig) - outflow(&without);
}

/* In litres at 0 degC and 101325 Pa (DIN 1343) an hour. */
static double leak_normal(const about *a)
{
  const double density = 101325 / ((double)a->rig.params.gas_constant * 273.15);
  return leak(a) / density * 1e3 * 3600;
}

static double leak_share(const about *a)
{
  return 100 * leak(a) / full_flow(a, (double)a->rig.params.fill_area);
}

/* ---- Words ---- */

/* Each amount, in a unit or as a share of a parameter. */
static const struct {
  const char *name, *unit; /* unit: as in lab_format_as; "": that of the parameter */
  double (*amount)(const about *a);
  double times;
  int of;      /* the parameter that it is a share of; NONE: it is no share of one */
  double most; /* beyond, it is left out, for what it is a share of is nearly nothing; 0: it always tells */
} sizes[] = {
    {"size", "", of_itself, 1, NONE, 0},
    {"percent", "%", of_itself, 100, NONE, 0},
    {"reciprocal", "J/K", reciprocal, 1, NONE, 0},
    {"of_fill", "%", of_itself, 100, PNEU_PARAM_fill_area, 1000},
    {"of_stroke", "%", of_itself, 100, PNEU_PARAM_stroke, 1000},
    {"of_supply", "%", of_itself, 100, PNEU_PARAM_supply_pressure, 1000},
    {"of_friction", "%", of_itself, 100, PNEU_PARAM_dry_friction, 1000},
    {"of_friction_rise", "%", friction_rise, 100, PNEU_PARAM_dry_friction, 1000},
    {"friction_rise", "N", friction_rise, 1, NONE, 0},
    {"of_spring", "%", of_spring, 1, NONE, 0},
    {"fill_drop", "Pa", fill_drop, 1, NONE, 0},
    {"vent_drop", "Pa", vent_drop, 1, NONE, 0},
    {"leak", "Nl/h", leak_normal, 1, NONE, 0},
    {"leak_share", "%", leak_share, 1, NONE, 1000},
};

/* A size with its unit; "" for one that is not finite or beyond what tells, and the name itself where it is none. */
static void write_size(const about *a, const char *name, size_t length, char text[2 * LAB_FORMAT_TEXT])
{
  enum { SIZES = sizeof sizes / sizeof *sizes };
  char number[LAB_FORMAT_TEXT];
  pneu_params params = a->rig.params;
  pneu_param_info info;
  double size;
  int i = 0;
  while (i < SIZES && (strlen(sizes[i].name) != length || strncmp(sizes[i].name, name, length) != 0))
    i++;
  snprintf(text, 2 * LAB_FORMAT_TEXT, "{%.*s}", (int)length, name);
  if (i == SIZES)
    return;
  size = sizes[i].times * sizes[i].amount(a);
  if (sizes[i].of != NONE)
    size /= (double)*pneu_param_at(&params, sizes[i].of);
  pneu_param_describe(a->param, &info);
  snprintf(text, 2 * LAB_FORMAT_TEXT, "%s",
           lab_format_quantity(size, *sizes[i].unit ? sizes[i].unit : info.unit, *sizes[i].unit ? 2 : 3, number));
  if (sizes[i].amount == leak_normal)
    lab_append(text, 2 * LAB_FORMAT_TEXT, " at %.3g bar supply", 1e-5 * (double)a->rig.params.supply_pressure);
  if (!isfinite(size) || (sizes[i].most > 0 && size > sizes[i].most))
    *text = '\0';
}

/* One of the two words of {+more|less}. */
static void write_word(const char *at, int negative, char text[2 * LAB_FORMAT_TEXT])
{
  const char *second = at + strcspn(at, "|") + 1;
  if (negative)
    snprintf(text, 2 * LAB_FORMAT_TEXT, "%.*s", (int)strcspn(second, "}"), second);
  else
    snprintf(text, 2 * LAB_FORMAT_TEXT, "%.*s", (int)(second - at) - 1, at);
}

const char *lab_effect_sentence(const lab_rig *rig, int effect, int param, char text[LAB_EFFECT_SENTENCE])
{
  about a = {*rig, param, 0};
  const double value = (double)*pneu_param_at(&a.rig.params, param);
  const char *at = pneu_effect_sentence(effect);
  char part[2 * LAB_FORMAT_TEXT];
  size_t used = 0, comma = 0;
  a.value = fabs(value);
  for (*text = '\0'; *at; used = strlen(text)) {
    const char *close = strchr(at, '}');
    if (*at == ',')
      comma = used;
    if (*at != '{') {
      lab_append(text, LAB_EFFECT_SENTENCE, "%c", *at++);
      continue;
    }
    if (at[1] == '+')
      write_word(at + 2, value < 0, part);
    else
      write_size(&a, at + 1, (size_t)(close - at) - 1, part);
    at = close + 1;
    lab_append(text, LAB_EFFECT_SENTENCE, "%s", part);
    if (!*part && comma) { /* drop what hangs on it */
      text[comma] = '\0';
      at += strcspn(at, ",.");
    }
  }
  return text;
}

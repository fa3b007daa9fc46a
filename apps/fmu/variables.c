#include "variables.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../lab/base/text.h"
#include "../lab/rig/rig.h"

#define NONE ((double)NAN)

typedef struct words {
  const char *name, *unit, *meaning;
} words;

static const words input_words[FMU_INPUT_COUNT] = {
    {"u", "1", "opening: 1 fill fully open, -1 vent fully open, 0 shut; beyond counts as the nearest"},
    {"supply", "Pa", "supply pressure, gauge"},
    {"force", "N", "force on the stem, positive against the air, added to external_force"},
    {"pressure", "Pa", "pressure in the chamber, gauge: it drives the model"},
    {"pressure_rate", "Pa/s", "slope of pressure from the time at which it was set; 0: it holds"},
    {"position", "m", "position of the stem: it drives the model; beyond 0..stroke counts as on the stop"},
    {"velocity", "m/s", "slope of position: it pumps the gas, and friction has its sign"}};
/* What else the command can be, by enum fmu_command_kind. */
static const words command_words[] = {{NULL, NULL, NULL},
                                      {"u", "Pa", "set pressure, gauge"},
                                      {"u", "1", "set position of the positioner, share of the stroke"}};

static const words start_words[FMU_START_COUNT] = {
    {"start_pressure", "Pa", "pressure in the chamber at the start, gauge"},
    {"start_temperature", "K", "temperature of the gas at the start; isothermal law: ambient is taken instead"},
    {"start_position", "m", "position at the start, 0..stroke; the stem is at rest"}};

static const words output_words[FMU_OUTPUT_COUNT] = {
    {"pressure", "Pa", "pressure in the chamber, gauge"},
    {"temperature", "K", "temperature of the gas"},
    {"position", "m", "position of the stem in the direction in which air drives it, 0..stroke"},
    {"velocity", "m/s", "velocity of the stem"},
    {"mass_flow", "kg/s", "mass flow into the chamber"},
    {"shown_pressure", "Pa", "pressure as its sensor shows it, gauge"},
    {"shown_temperature", "K", "temperature as its sensor shows it"},
    {"shown_position", "m", "position as its sensor shows it"},
    {"holding_force", "N", "force that holds the stem at its velocity, positive against the air"}};

static const words event_words[FMU_INDICATOR_COUNT] = {
    {"event[1]", NULL, "first event function of the stem's mode: break-away upwards, reversal, upper stop"},
    {"event[2]", NULL, "second event function of the stem's mode: break-away downwards, a stop"},
    {"event[3]", NULL, "above 0 where flow has begun or ceased to choke"},
    {"event[4]", NULL, "the edge of a positioner's dead band"}};

static const char *const rate_units[FMU_STATE_EFFECT] = {"Pa/s", "K/s", "m/s", "m/s2"};

static fmu_variable *add(fmu_list *list, unsigned reference, int causality, const words *w)
{
  fmu_variable *v = &list->variable[list->n++];
  memset(v, 0, sizeof *v);
  v->reference = reference;
  v->causality = causality;
  snprintf(v->name, sizeof v->name, "%s", w->name);
  v->unit = w->unit;
  v->meaning = w->meaning;
  v->lower = v->upper = v->start = v->nominal = NONE;
  return v;
}

static void add_inputs(fmu_list *list, const fmu_data *data)
{
  const int kind = fmu_command_kind(&data->params);
  int i;
  for (i = 0; i < FMU_INPUT_COUNT; i++) {
    fmu_variable *v;
    if (!fmu_has_variable(&data->law, FMU_REF_INPUT + (unsigned)i))
      continue;
    v = add(list, FMU_REF_INPUT + (unsigned)i, FMU_INPUT,
            i == FMU_INPUT_U && kind != FMU_COMMAND_OPENING ? &command_words[kind] : &input_words[i]);
    if (i == FMU_INPUT_PRESSURE_RATE || i == FMU_INPUT_VELOCITY)
      v->rate_of = FMU_REF_INPUT + (unsigned)i - 1;
    v->start = i == FMU_INPUT_SUPPLY ? (double)data->params.supply_pressure : 0;
    if (i == FMU_INPUT_U && kind == FMU_COMMAND_OPENING) {
      v->lower = -1;
      v->upper = 1;
    }
  }
}

static void add_starts(fmu_list *list, const fmu_data *data)
{
  int i;
  for (i = 0; i < FMU_START_COUNT; i++) {
    fmu_variable *v;
    if (!fmu_has_variable(&data->law, FMU_REF_START + (unsigned)i))
      continue;
    v = add(list, FMU_REF_START + (unsigned)i, FMU_PARAMETER, &start_words[i]);
    v->start = i == FMU_START_TEMPERATURE ? (double)data->params.ambient_temperature : 0;
    v->lower = i == FMU_START_PRESSURE ? NONE : 0;
  }
}

static void add_outputs(fmu_list *list, const fmu_data *data)
{
  static const words mode = {"mode", NULL, NULL},
                     choked = {"choked", NULL, "1: flow through the transducer is choked; 0: it is not, or shut"};
  int i;
  for (i = 0; i < FMU_OUTPUT_COUNT; i++)
    if (fmu_has_variable(&data->law, FMU_REF_OUTPUT + (unsigned)i))
      add(list, FMU_REF_OUTPUT + (unsigned)i, FMU_OUTPUT, &output_words[i]);
  for (i = 0; i < PNEU_MODE_COUNT; i++)
    lab_append(list->modes, sizeof list->modes, "%s%d %s", i ? ", " : "", i, pneu_mode_text(i));
  add(list, FMU_REF_MODE, FMU_OUTPUT, &mode)->integer = 1;
  list->variable[list->n - 1].meaning = list->modes;
  if (fmu_has_variable(&data->law, FMU_REF_CHOKED))
    add(list, FMU_REF_CHOKED, FMU_OUTPUT, &choked)->integer = 1;
}

/* A state of an effect is named after it, the others are outputs; then their rates. */
static void add_states(fmu_list *list, const pneu_model *model)
{
  int i;
  for (i = 0; i < list->shape.n; i++) {
    const int kind = list->shape.kind[i];
    fmu_variable *v;
    if (kind >= FMU_STATE_EFFECT) {
      const pneu_effect *effect = pneu_effect_at(fmu_state_effect(kind));
      const words w = {"", "1", effect->what};
      const int number = fmu_state_number(kind);
      v = add(list, fmu_state_reference(kind), FMU_LOCAL, &w);
      snprintf(v->name, sizeof v->name, number ? "%s.state[%d]" : "%s.state", effect->name, number);
      v->nominal = 1;
    } else {
      v = &list->variable[fmu_list_find(list, fmu_state_reference(kind))];
      v->nominal = (double)model->scale[kind];
      v->jumps = kind == FMU_STATE_X || kind == FMU_STATE_V;
    }
  }
  for (i = 0; i < list->shape.n; i++) {
    const int kind = list->shape.kind[i];
    const fmu_variable *state = &list->variable[fmu_list_find(list, fmu_state_reference(kind))];
    const words w = {"", kind < FMU_STATE_EFFECT ? rate_units[kind] : "1/s", "its rate"};
    fmu_variable *v = add(list, FMU_REF_RATE + (unsigned)kind, FMU_LOCAL, &w);
    snprintf(v->name, sizeof v->name, "der(%.*s)", FMU_NAME_TEXT - 6, state->name);
    v->rate_of = state->reference;
  }
}

static void add_parameters(fmu_list *list, const fmu_data *data)
{
  pneu_params params = data->params;
  int i;
  for (i = 0; i < PNEU_PARAM_COUNT; i++) {
    const pneu_effect *effect = pneu_effect_at(pneu_effect_of(i));
    const pneu_param_info info = lab_param_info(i);
    const words w = {info.name, info.unit, info.meaning};
    fmu_variable *v;
    if (!fmu_has_parameter(data, i))
      continue;
    v = add(list, FMU_REF_PARAMETER + (unsigned)i, FMU_PARAMETER, &w);
    if (effect)
      snprintf(v->name, sizeof v->name, "%s.%s", effect->name, info.name);
    v->lower = (double)info.lower;
    v->upper = (double)info.upper;
    v->start = (double)*pneu_param_at(&params, i);
  }
}

void fmu_list_of(const fmu_data *data, const pneu_model *model, fmu_list *list)
{
  static const words the_time = {"time", "s", NULL};
  int i;
  memset(list, 0, sizeof *list);
  fmu_shape_of(model, &list->shape);
  add(list, FMU_REF_TIME, FMU_INDEPENDENT, &the_time);
  add_inputs(list, data);
  add_outputs(list, data);
  add_starts(list, data);
  add_parameters(list, data);
  add_states(list, model);
  for (i = 0; i < FMU_INDICATOR_COUNT; i++)
    add(list, FMU_REF_INDICATOR + (unsigned)i, FMU_LOCAL, &event_words[i]);
}

int fmu_list_find(const fmu_list *list, unsigned reference)
{
  int i = 0;
  while (list->variable[i].reference != reference)
    i++;
  return i;
}

int fmu_dependencies(const fmu_data *data, const fmu_list *list, int output, int *place)
{
  const unsigned reference = list->variable[output].reference;
  int i, n = 0;
  if (reference == FMU_REF_OUTPUT + FMU_OUTPUT_MASS_FLOW || list->variable[output].integer)
    return -1;
  if (reference >= FMU_REF_OUTPUT + FMU_OUTPUT_SHOWN_PRESSURE &&
      (data->n_terms > 0 || data->law.pressure_input || data->law.position_input))
    return -1; /* a free term over the opening may be added to what is shown, or it shows an input */
  for (i = 0; i < list->shape.n; i++) {
    const unsigned state = fmu_state_reference(list->shape.kind[i]);
    if (reference == state || reference >= FMU_REF_OUTPUT + FMU_OUTPUT_SHOWN_PRESSURE)
      place[n++] = fmu_list_find(list, state);
  }
  return n;
}

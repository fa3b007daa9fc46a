/* The answer in words: what an effect does, what has changed, deviates or is missing, and what limits the answer. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../base/format.h"
#include "../base/json.h"
#include "../base/names.h"
#include "../base/text.h"
#include "../rig/tolerance.h"
#include "../trace/freeterms.h"
#include "report.h"

enum { DEVIATIONS_TOLD = 3 };
static const double wider = 1.1; /* times, from which on a wide interval is worth a word */

/* Append to the text of an answer. */
#define ADD(text, ...) lab_append(text, LAB_SENTENCE_TEXT, __VA_ARGS__)

/* ---- An effect: its sizes, each from a rig and its parameter, of which the amount counts ---- */

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

static double exponent(const about *a)
{
  return 1 + a->value;
}

static double reciprocal(const about *a)
{
  return 1 / a->value;
}

/* What grows with pressure, at the supply pressure. */
static double at_supply(const about *a)
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

/* What a line takes that stands before the fill orifice, while that is wide open into an empty chamber [Pa]. */
static double fill_drop(const about *a)
{
  const int is_tube = a->param == pneu_param_find("tube_resistance");
  const int turbulence = pneu_param_find(is_tube ? "tube_turbulence" : "supply_turbulence");
  pneu_params was = a->rig.params;
  pneu_input input = {.u = 1, .supply_pressure = was.supply_pressure};
  const pneu_state state = {.T = was.ambient_temperature, .mode = PNEU_MODE_STUCK};
  lab_rig rig = a->rig;
  pneu_model model;
  pneu_output out;
  lab_error error;
  int i;
  for (i = PNEU_PARAM_BASE_COUNT; i < PNEU_PARAM_COUNT; i++)
    *pneu_param_at(&rig.params, i) = lab_param_info(i).neutral;
  rig.params.proportional_band = 0;
  if (lab_rig_model(&rig, &model, &error))
    return (double)NAN;
  model.supply_loss = (pneu_line){(pneu_real)a->value, *pneu_param_at(&was, turbulence), 0, 0};
  if (pneu_observe(&model, &state, &input, &out) != PNEU_OK)
    return (double)NAN;
  return (double)(input.supply_pressure - out.supply);
}

static double vent_drop(const about *a)
{
  return a->value * full_flow(a, (double)a->rig.params.vent_area);
}

static double growth_at_supply(const about *a)
{
  return at_supply(a) * (double)a->rig.params.dead_volume;
}

static double leak(const about *a)
{
  return lab_rig_leak(&a->rig, a->param);
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
    {"exponent", "", exponent, 1, NONE, 0},
    {"reciprocal", "J/K", reciprocal, 1, NONE, 0},
    {"of_fill", "%", of_itself, 100, PNEU_PARAM_fill_area, 1000},
    {"of_stroke", "%", of_itself, 100, PNEU_PARAM_stroke, 1000},
    {"of_supply", "%", of_itself, 100, PNEU_PARAM_supply_pressure, 1000},
    {"of_friction", "%", of_itself, 100, PNEU_PARAM_dry_friction, 1000},
    {"of_friction_rise", "%", at_supply, 100, PNEU_PARAM_dry_friction, 1000},
    {"friction_rise", "N", at_supply, 1, NONE, 0},
    {"of_spring", "%", of_spring, 1, NONE, 0},
    {"volume_growth", "m3", growth_at_supply, 1, NONE, 0},
    {"of_volume", "%", at_supply, 100, NONE, 0},
    {"of_rate", "%", of_itself, 100, PNEU_PARAM_spring_rate, 1000},
    {"fill_drop", "Pa", fill_drop, 1, NONE, 0},
    {"vent_drop", "Pa", vent_drop, 1, NONE, 0},
    {"leak", "Nl/h", leak_normal, 1, NONE, 0},
    {"leak_share", "%", leak_share, 1, NONE, 1000},
};

/* A size with its unit; "" for one that is not finite or beyond what tells, and the name itself where it is none. */
static void write_size(const about *a, const char *name, size_t length, char text[2 * LAB_FORMAT_TEXT])
{
  enum { SIZES = sizeof sizes / sizeof *sizes };
  pneu_params params = a->rig.params;
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
  if (*sizes[i].unit)
    lab_format_quantity(size, sizes[i].unit, 2, text);
  else
    lab_format_quantity(size, lab_param_info(a->param).unit, 3, text);
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

/* ---- What deviates ---- */

/* What a person calls a parameter, and by how much less or more of it there is; others are "the" and their name. */
static const struct {
  const char *name, *called, *less, *more;
} plain[] = {{"dry_friction", "friction", NULL, NULL},
             {"spring_rate", "the spring", "soft", "stiff"},
             {"orifice_area", "the area of both orifices", NULL, NULL},
             {"vent_restriction", "the vent", NULL, NULL},
             {"pressure_lag", "the lag of the pressure sensor", NULL, NULL},
             {"position_lag", "the lag of the position sensor", NULL, NULL},
             {"pressure_bias", "the zero of the pressure sensor", NULL, NULL},
             {"position_bias", "the zero of the position sensor", NULL, NULL},
             {"pressure_gain", "the gain error of the pressure sensor", NULL, NULL},
             {"position_gain", "the gain error of the position sensor", NULL, NULL},
             {"clock", "the offset between the clocks of the channels", NULL, NULL}};

/* What a value is off from: what the rig file does not say, or is known to no better than its own size, stands on no
 * sheet, nor does the weather. */
static const char *sheet_of(const lab_rig *rig, const lab_deviation *d)
{
  return rig->assumed[d->param] || !(d->tolerance < 1) ? "what was assumed"
         : strcmp(d->name, "ambient_pressure") == 0    ? "what was declared"
                                                       : "its sheet";
}

/* "3.7 times its sheet", "25 % soft", "12 % above its sheet", "6 % narrower", "0.5 kPa in place of 0 kPa". */
static void add_ratio(char *text, const lab_rig *rig, const lab_deviation *d, const char *less, const char *more)
{
  const double percent = 100 * (d->ratio - 1), opened = 100 * ((1 - d->found) / (1 - d->declared) - 1);
  const char *sheet = sheet_of(rig, d);
  if (strcmp(d->name, "vent_restriction") == 0)
    ADD(text, "%.2g %% %s", fabs(opened), opened < 0 ? "narrower" : "wider");
  else if (!isfinite(d->ratio) && strcmp(d->unit, "1") == 0)
    ADD(text, "%.2g %% in place of %.2g %%", 100 * d->found, 100 * d->declared);
  else if (!isfinite(d->ratio))
    ADD(text, "%s in place of %s", LAB_QUANTITY(d->found, d->unit, 3), LAB_QUANTITY(d->declared, d->unit, 3));
  else if (d->ratio >= 1.995 || d->ratio < 0.5)
    ADD(text, d->ratio < 99.5 ? "%.2g times %s" : "%.0f times %s", d->ratio, sheet);
  else if (less)
    ADD(text, "%.2g %% %s", fabs(percent), percent < 0 ? less : more);
  else
    ADD(text, "%.2g %% %s %s", fabs(percent), percent < 0 ? "below" : "above", sheet);
}

/* Whether a factor on both orifices is one on the fill orifice, for the vent has another that is told by itself. */
static int is_of_fill(const lab_report *report, const lab_deviation *d)
{
  int i, vent = 0;
  for (i = 0; i < report->result->n_found; i++)
    vent |= lab_param_is_vents_share(report->result->found[i].param);
  return vent && d->param == LAB_PARAM_ORIFICE_AREA;
}

enum { CALLED_TEXT = LAB_PARAM_NAME_TEXT + 4 };

static int in_plain(const char *name)
{
  return lab_name_index(name, plain, sizeof plain / sizeof *plain, sizeof *plain);
}

/* "friction", "the dead volume". */
static const char *called(const char *name, char text[CALLED_TEXT])
{
  const int i = in_plain(name);
  char *at;
  snprintf(text, CALLED_TEXT, i < 0 ? "the %s" : "%s", i < 0 ? name : plain[i].called);
  while ((at = strpbrk(text, "_.")))
    *at = ' ';
  return text;
}

static void add_deviation(char *text, const lab_report *report, const lab_deviation *d, int first)
{
  const int i = in_plain(d->name);
  char name[CALLED_TEXT], since[LAB_SINCE_TEXT];
  ADD(text, "%s %s", is_of_fill(report, d) ? "the fill orifice" : called(d->name, name), first ? "is " : "");
  add_ratio(text, report->rig, d, i < 0 ? NULL : plain[i].less, i < 0 ? NULL : plain[i].more);
  ADD(text, "%s", lab_report_since(lab_report_onset(report, d->param), since));
}

int lab_report_is_told(const lab_report *report, const lab_deviation *d)
{
  return d->beyond || lab_report_onset(report, d->param);
}

int lab_report_count_told(const lab_report *report)
{
  const lab_deviations *all = &report->deviations;
  int i, n = 0;
  for (i = 0; i < all->n; i++)
    n += lab_report_is_told(report, &all->of[i]);
  return n;
}

void lab_report_deviation(const lab_report *report, const lab_deviation *d, char text[LAB_SENTENCE_TEXT])
{
  *text = '\0';
  add_deviation(text, report, d, 1);
}

/* Whether it is an error of a sensor that is declared to have none: the sentence of its effect tells that. */
static int is_of_sensor(const lab_deviation *d)
{
  return lab_param_is_of_sensor(d->param) && d->declared == 0;
}

/* Values beyond their tolerance, and those that begin.  Returns: their number */
static int add_deviations(char *text, const lab_report *report, int is_hedged)
{
  const lab_deviations *all = &report->deviations;
  char *begin;
  int i, n = 0, told = 0;
  for (i = 0; i < all->n; i++)
    n += lab_report_is_told(report, &all->of[i]) && !is_of_sensor(&all->of[i]);
  ADD(text, "%s", is_hedged && n > 0 ? " As far as the log tells, " : "");
  begin = text + strlen(text);
  for (i = 0; i < all->n && told < DEVIATIONS_TOLD; i++)
    if (lab_report_is_told(report, &all->of[i]) && !is_of_sensor(&all->of[i])) {
      ADD(text, "%s", told ? ", " : "");
      add_deviation(text, report, &all->of[i], told++ == 0);
    }
  if (n > told)
    ADD(text, ", and %d more", n - told);
  if (!is_hedged)
    *begin = (char)toupper((unsigned char)*begin);
  return n;
}

/* ---- What has changed since the baseline ---- */

/* "friction from 480 N to 724 N (1.51 times)" */
static void say_value(const lab_change *change, char text[LAB_SENTENCE_TEXT])
{
  const char *unit = lab_change_unit(change), *now = LAB_QUANTITY(change->now, unit, 3);
  char name[LAB_PARAM_NAME_TEXT], is_called[CALLED_TEXT];
  if (change->param == PNEU_PARAM_spring_rate)
    ADD(text, "the rate of the spring ");
  else
    ADD(text, "%s ", called(lab_fit_name(change->param, name), is_called));
  if (change->then == 0)
    ADD(text, "of %s", now);
  else
    ADD(text, "from %s to %s (%s times)", LAB_QUANTITY(change->then, unit, 3), now,
        LAB_NUMBER(change->now / change->then, 3));
}

/* What the vent passes less than declared, if that is the parameter: what it does beside the fill orifice, and both. */
static void compare_vent(const lab_report *report, lab_rig *rig, int param)
{
  const pneu_params *now = &rig->params, *declared = &report->rig->params;
  const double passes = 1 - lab_param_value(rig, param);
  if (lab_param_is_vents_share(param) && declared->vent_area > 0)
    *pneu_param_at(&rig->params, param) = (pneu_real)(1 - passes * (double)(now->vent_area / declared->vent_area));
}

/* What an effect was before: of what may have either sign, such as a zero, its size; else the ratio. */
static void say_before(const lab_change *change, double ratio, char text[LAB_SENTENCE_TEXT])
{
  const char *unit = lab_change_unit(change);
  if (!(lab_param_info(change->param).lower < 0))
    ADD(text, ", %s times what it was", LAB_NUMBER(ratio, 3));
  else if (strcmp(unit, "1") == 0)
    ADD(text, ", %s %% before", LAB_NUMBER(100 * change->then, 2));
  else
    ADD(text, ", %s before", LAB_QUANTITY(change->then, unit, 3));
}

/* "the chamber leaks: 0.0602 mm2, ... (chamber_leak, 3 times what it was)", "no longer: the chamber leaks: ..."; of
 * what may have either sign, "(position_bias, 0.136 mm before)" */
static void say_effect(const lab_report *report, const lab_change *change, char text[LAB_SENTENCE_TEXT])
{
  static const double comparable = 20; /* times: beyond, it was hardly there, by judgement */
  const double ratio = change->then != 0 ? change->now / change->then : 0;
  const int is_gone = change->now == (double)lab_param_info(change->param).neutral;
  char sentence[LAB_EFFECT_SENTENCE], name[LAB_PARAM_NAME_TEXT];
  lab_rig rig;
  lab_rig_at(&report->completed->rig, INFINITY, &rig);
  *pneu_param_at(&rig.params, change->param) = (pneu_real)(is_gone ? change->then : change->now);
  compare_vent(report, &rig, change->param);
  lab_effect_sentence(&rig, pneu_effect_of(change->param), change->param, sentence);
  *sentence = (char)tolower((unsigned char)*sentence);
  ADD(text, "%s%.*s (%s", is_gone ? "no longer: " : "", (int)strlen(sentence) - 1, sentence,
      lab_change_name(change->param, name));
  if (fabs(ratio) > 1 / comparable && fabs(ratio) < comparable)
    say_before(change, ratio, text);
  ADD(text, ")");
}

/* Whether the sentence of an effect tells of a parameter: its size, and not the positioner, which is declared. */
static int has_sentence(int param)
{
  const int effect = param < LAB_PARAM_ORIFICE_AREA ? pneu_effect_of(param) : -1;
  return effect >= 0 && !lab_param_info(param).shape && effect != pneu_effect_find("positioner");
}

static void say_change(const lab_report *report, const lab_change *change, char text[LAB_SENTENCE_TEXT])
{
  char name[LAB_PARAM_NAME_TEXT], since[LAB_SINCE_TEXT];
  int i;
  if (has_sentence(change->param))
    say_effect(report, change, text);
  else
    say_value(change, text);
  ADD(text, "%s", lab_report_since(change->begin.known ? &change->begin : NULL, since));
  if (change->end.known)
    ADD(text, " until %s s", LAB_NUMBER(change->end.t, 4));
  for (i = 0; i < change->n_alike; i++)
    ADD(text, "%s %s", i ? "," : " (or", lab_change_name(change->alike[i], name));
  if (change->n_alike)
    ADD(text, ": the logs cannot tell)");
}

static void add_changes(const lab_report *report, char text[LAB_SENTENCE_TEXT])
{
  const lab_changes *changes = report->changes;
  int i;
  if (changes->condition == LAB_SINCE_UNCHANGED)
    ADD(text, "As it was: nothing has changed since the baseline. ");
  if (changes->condition == LAB_SINCE_CANNOT_TELL)
    ADD(text, "Whether anything has changed since the baseline cannot be told: %s. ", changes->why);
  if (changes->condition != LAB_SINCE_CHANGED)
    return;
  ADD(text, "Changed since the baseline: ");
  for (i = 0; i < changes->n; i++) {
    ADD(text, "%s", i ? "; " : "");
    say_change(report, &changes->change[i], text);
  }
  ADD(text, ". ");
}

/* ---- What is missing ---- */

/* The sentence of an effect, at a rig's values, with when it begins. */
static void tell_effect(const lab_report *report, const lab_rig *rig, int param, char text[LAB_FOUND_SENTENCE])
{
  char sentence[LAB_EFFECT_SENTENCE], since[LAB_SINCE_TEXT];
  lab_effect_sentence(rig, pneu_effect_of(param), param, sentence);
  lab_report_since(lab_report_onset(report, param), since);
  snprintf(text, LAB_FOUND_SENTENCE, "%.*s%s%s.", (int)strlen(sentence) - 1, sentence, *since ? "," : "", since);
}

const char *lab_report_found_sentence(const lab_report *report, const lab_found *found, char text[LAB_FOUND_SENTENCE])
{
  char where[LAB_WHERE_TEXT];
  lab_rig last;
  if (found->effect >= 0) {
    lab_rig_at(&report->completed->rig, INFINITY, &last);
    compare_vent(report, &last, found->param);
    tell_effect(report, &last, found->param, text);
  } else
    snprintf(text, LAB_FOUND_SENTENCE, "Something that is not in the catalogue acts like %s: %s.",
             lab_free_term_what(lab_report_term(report, found)),
             lab_free_term_where(lab_report_term(report, found), where));
  return text;
}

/* Whether it is told as what has changed, or as what the logs cannot tell from that. */
static int has_changed(const lab_report *report, int param)
{
  int i, k, any = 0;
  for (i = 0; report->changes && i < report->changes->n; i++) {
    const lab_change *change = &report->changes->change[i];
    any |= change->param == param;
    for (k = 0; k < change->n_alike; k++)
      any |= pneu_effect_of(change->alike[k]) >= 0 && pneu_effect_of(change->alike[k]) == pneu_effect_of(param);
  }
  return any;
}

/* What parts a sentence from what stands before it. */
static const char *gap(const char *text)
{
  const size_t n = strlen(text);
  return n == 0 || text[n - 1] == ' ' ? "" : " ";
}

/* The sentence of each that is not told yet, with its name before the full stop. */
static void add_found(char *text, const lab_report *report)
{
  const lab_search_result *r = report->result;
  int i;
  for (i = 0; i < r->n_found; i++) {
    char sentence[LAB_FOUND_SENTENCE];
    if (r->found[i].effect >= 0 && has_changed(report, r->found[i].param))
      continue;
    lab_report_found_sentence(report, &r->found[i], sentence);
    ADD(text, "%s%.*s", gap(text), (int)strlen(sentence) - 1, sentence);
    if (r->found[i].effect >= 0)
      ADD(text, " (%s)", pneu_effect_at(r->found[i].effect)->name);
    ADD(text, ".");
  }
}

static int is_found(const lab_search_result *r, int param)
{
  int i, any = 0;
  for (i = 0; i < r->n_found; i++)
    any |= r->found[i].param == param;
  return any;
}

/* Sensors that are off come last: what the valve does is asked first. */
static void add_sensors(char *text, const lab_report *report)
{
  const lab_deviations *all = &report->deviations;
  int i;
  for (i = 0; i < all->n; i++) {
    const lab_deviation *d = &all->of[i];
    char sentence[LAB_FOUND_SENTENCE];
    lab_rig last;
    if (!lab_report_is_told(report, d) || !is_of_sensor(d) || is_found(report->result, d->param) ||
        has_changed(report, d->param))
      continue;
    lab_rig_at(&report->completed->rig, INFINITY, &last);
    *pneu_param_at(&last.params, d->param) = (pneu_real)d->found;
    tell_effect(report, &last, d->param, sentence);
    ADD(text, "%s%s", gap(text), sentence);
  }
}

static int is_small(const lab_search_result *r)
{
  return r->n_listed > 0 || r->has_small;
}

/* In the words that follow deviations, or in those that stand alone. */
static const char *nothing(const lab_report *report, int deviates)
{
  if (is_small(report->result))
    return deviates ? "; nothing else is missing that is worth adding." : "Nothing is missing that is worth adding.";
  if (deviates)
    return "; nothing else is missing.";
  return report->deviations.condition == LAB_CONDITION_AS_DECLARED
             ? "Nothing is missing, and every declared value is within its tolerance."
             : "Nothing is missing.";
}

/* Whether a verdict is undecided where what is left may be noise. */
static int may_leave_noise(const lab_search_result *r)
{
  const double in_noise = lab_report_in_noise(&r->after);
  return r->verdict == LAB_VERDICT_UNDECIDED && in_noise * in_noise < lab_constant(LAB_NOISE_DOUBTFUL);
}

int lab_report_is_unfinished(const lab_search_result *r)
{
  return r->cut_short && may_leave_noise(r);
}

int lab_report_is_ambiguous(const lab_search_result *r)
{
  return !r->cut_short && !r->is_far && r->n_found > 0 && may_leave_noise(r);
}

int lab_report_wanders(const lab_search_result *r)
{
  const double left = lab_report_in_noise(&r->after);
  return (r->verdict == LAB_VERDICT_NONE || r->verdict == LAB_VERDICT_EFFECT) && r->window == 0 &&
         left * left > lab_constant(LAB_NOISE_SLIP) && !lab_residual_stats_noise(r->left[LAB_STAGE_AFTER]) &&
         lab_residual_stats_of_sensors(r->left[LAB_STAGE_AFTER]);
}

/* As much as is known of what is missing, where no name is. */
static void add_undecided_cause(char *text, const lab_search_result *r)
{
  const char *why = r->cut_short ? "and there was no time to find what" : "but the log does not say what";
  if (lab_report_is_unfinished(r))
    ADD(text, "The search was ended by --budget before it was finished: what it has found so far may be wrong.");
  else if (r->sound_until > 0)
    ADD(text, "Until %s s nothing is missing; then something is, %s.",
        LAB_NUMBER(r->sound_until, (int)fmax(4, 2 + floor(log10(r->sound_until)))), why);
  else if (r->jerks)
    ADD(text,
        "The stem moves by jerks and the model's does not: something is missing, perhaps friction that sticks or a "
        "force that shakes it.");
  else if (r->is_far)
    ADD(text,
        "It takes values far off their sheet to explain the log: the sheet is of another rig, or something else is "
        "missing.");
  else
    ADD(text, "Something is missing, %s.", why);
}

void lab_report_headline(const lab_report *report, char text[LAB_SENTENCE_TEXT])
{
  const lab_search_result *r = report->result;
  int deviates;
  *text = '\0';
  if (report->changes)
    add_changes(report, text);
  if (lab_report_doubt(report)) {
    ADD(text, "Undecided: %s", lab_report_doubt(report));
    return;
  }
  if (r->verdict == LAB_VERDICT_UNDECIDED) {
    add_undecided_cause(text, r);
    if (add_deviations(text, report, 1))
      ADD(text, ".");
    add_sensors(text, report);
    return;
  }
  deviates = add_deviations(text, report, 0) > 0;
  ADD(text, deviates && r->verdict != LAB_VERDICT_NONE ? "." : "");
  if (r->verdict == LAB_VERDICT_NONE)
    ADD(text, "%s", nothing(report, deviates));
  else
    add_found(text, report);
  add_sensors(text, report);
}

/* ---- What that does to the error ---- */

/* "With the best candidates, laminar_leak, heat_transfer and a free term, the error falls ..." */
static void add_undecided(char *text, const lab_search_result *r)
{
  static const double hardly = 0.95; /* times as much: what takes off less is no candidate, by judgement */
  const double before = lab_report_in_noise(&r->before), after = lab_report_in_noise(&r->after);
  const int n = after < hardly * before ? r->n_found : 0;
  int i;
  if (n == 0) {
    ADD(text, "The residual is %.2f times the noise%s.", after,
        lab_report_is_unfinished(r) || r->is_far ? "" : ", and nothing that was tried explains it");
    return;
  }
  ADD(text, "With the best candidate%s, ", n > 1 ? "s" : "");
  for (i = 0; i < n; i++)
    ADD(text, "%s%s",
        i == 0      ? ""
        : i + 1 < n ? ", "
                    : " and ",
        r->found[i].effect >= 0 ? pneu_effect_at(r->found[i].effect)->name : "a free term");
  ADD(text, ", the error falls from %.2f to %.2f times the noise%s.", before, after,
      lab_report_is_unfinished(r) || r->is_far ? ""
      : lab_report_is_ambiguous(r)             ? ", as it may with others"
                                               : ", but what is left is not noise");
}

static void add_small(char *text, const lab_search_result *r)
{
  const int more = r->n_listed + r->has_small - 1;
  ADD(text, " Too small to be worth adding: %s", r->n_listed ? pneu_effect_at(r->listed[0])->name : "a free term");
  ADD(text, more > 0 ? " and %d more." : ".", more);
}

/* What declared values that are off leave, and how much that is less than with those of the rig file. */
static void add_corrected(char *text, const lab_search_result *r)
{
  static const double less = 1.05;
  const double before = lab_report_in_noise(&r->before), after = lab_report_in_noise(&r->after);
  if (before > less * after)
    ADD(text, "With these values the error falls from %.2f to %.2f times the noise.", before, after);
  else
    ADD(text, "With these values the model leaves %.2f times the noise.", after);
}

/* "The logs do not show chamber_leak.leak_area, which is declared." */
static void add_absent(char *text, const lab_unknowns *u)
{
  int j;
  for (j = 0; j < u->n; j++)
    if (lab_unknown_is_absent(&u->unknown[j]))
      ADD(text, " The logs do not show %s, which is declared: it is 0.", u->unknown[j].name);
}

void lab_report_evidence(const lab_report *report, char text[LAB_SENTENCE_TEXT])
{
  const lab_search_result *r = report->result;
  const char *with = lab_report_count_told(report) > 0 ? "With all of this" : r->n_found > 1 ? "With them" : "With it";
  *text = '\0';
  if (lab_report_doubt(report))
    return;
  if (r->verdict == LAB_VERDICT_UNDECIDED)
    add_undecided(text, r);
  else if (r->window > 0 && r->n_found > 0)
    ADD(text, "%s the stem sticks and slips as it does in the log; the instants of single slips cannot be predicted.",
        with);
  else if (r->n_found > 0)
    ADD(text, "%s the error falls from %.2f to %.2f times the noise.", with, lab_report_in_noise(&r->before),
        lab_report_in_noise(&r->after));
  else if (lab_report_count_told(report) > 0)
    add_corrected(text, r);
  else
    ADD(text, "The declared model leaves %.2f times the noise%s.", lab_report_in_noise(&r->after),
        lab_report_is_completed(report) ? ", with values within their tolerances" : "");
  if (r->verdict == LAB_VERDICT_NONE && is_small(r))
    add_small(text, r);
  add_absent(text, report->completed);
  if (r->cut_short && !lab_report_is_unfinished(r))
    ADD(text, " The search was ended by --budget: this is the best answer so far.");
}

void lab_report_sentence(const lab_report *report, char text[LAB_SENTENCE_TEXT])
{
  char evidence[LAB_SENTENCE_TEXT];
  lab_report_headline(report, text);
  lab_report_evidence(report, evidence);
  ADD(text, "%s%s", *evidence ? gap(text) : "", evidence);
}

/* ---- What it has to be read with: remarks on the logs, and what the fit could not determine ---- */

/* The next clause of the remark of a fit that is of use to a reader: not one on instants of the command, which have no
 * name.
 * In/out:  limitation  moves on
 * Out:     clause      where it begins
 * Returns: its length, 0 at the end */
static int next_clause(const char **limitation, const char **clause)
{
  while (**limitation) {
    const char *end = strstr(*limitation, "; "), *name = strstr(*limitation, "switch_");
    const int length = (int)(end ? end - *limitation : (long)strlen(*limitation));
    *clause = *limitation;
    *limitation += length + (end ? 2 : 0);
    if (!name || name >= *clause + length)
      return length;
  }
  return 0;
}

void lab_report_undetermined(const lab_report *report, char text[LAB_FIT_UNDETERMINED_TEXT])
{
  const char *limitation = report->result->fit.undetermined, *clause;
  const char *const full = limitation + LAB_FIT_UNDETERMINED_TEXT - 1; /* what ends here was cut */
  int length;
  char *to = text;
  for (*to = '\0'; (length = next_clause(&limitation, &clause)) > 0 && clause + length < full;)
    to += sprintf(to, "%s%.*s", to > text ? "; " : "", length, clause);
}

static void add_clauses(const lab_report *report, cJSON *list)
{
  char text[LAB_FIT_UNDETERMINED_TEXT];
  const char *limitation = text, *clause;
  int length;
  lab_report_undetermined(report, text);
  while ((length = next_clause(&limitation, &clause)) > 0)
    lab_json_say(list, "Among the fitted values, %.*s.", length, clause);
}

/* Intervals that are wide because there is more noise than declared, or because the model is not the whole truth. */
static void add_widening(const lab_search_result *r, cJSON *list)
{
  const double times = sqrt(r->fit.reduced_chi2);
  if (!(times > wider) || r->window > 0)
    return;
  lab_json_say(
      list,
      r->verdict == LAB_VERDICT_UNDECIDED || r->verdict == LAB_VERDICT_UNLISTED
          ? "More than noise is left, so intervals are at least %.2g times as wide as noise alone would make them."
      : lab_residual_stats_white(r->left[LAB_STAGE_AFTER])
          ? "The residual is white, so the sensors seem to be %.2g times as noisy as the rig file says. The intervals "
            "allow for that."
          : "The sensors seem to be %.2g times as noisy as the rig file says. The intervals allow for that.",
      times);
}

void lab_report_limits(const lab_report *report, cJSON *list)
{
  int i;
  for (i = 0; report->limitations && i < report->limitations->n; i++)
    lab_json_say(list, "%s", report->limitations->text[i]);
  if (report->result->preview > 0)
    lab_json_say(list,
                 "Effects were scored by the first %.3g s; what was found there was then fitted to the whole log.",
                 report->result->preview);
  if (report->result->cut_short)
    lab_json_say(list, "The search was ended by --budget: with more time it may find something else.");
  add_widening(report->result, list);
  add_clauses(report, list);
}

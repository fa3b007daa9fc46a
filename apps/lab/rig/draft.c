#include "draft.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "../base/escape.h"
#include "../base/line.h"
#include "../base/noise.h"
#include "../base/text.h"
#include "../log/log.h"
#include "rig.h"
#include "rigkeys.h"
#include "sheetwords.h"

enum { SHEET_TEXT = LAB_SHEET_WORDS * (LAB_SHEET_VALUE + 64), LEAST_ROWS = 20, WINDOWS = 200 };

typedef struct draft {
  lab_sheet_word word[LAB_SHEET_WORDS];
  int n, n_said;                                 /* of words; those behind the said ones are of what was named */
  const lab_product *product[LAB_PRODUCT_KINDS]; /* NULL: none was named */
  lab_rig rig; /* of the sheet alone, defaults elsewhere, and then with what was derived */
  lab_log log;
  int x_is_share;                             /* x is a share of the stroke: its range does not tell the stroke */
  const char *derived[PNEU_PARAM_BASE_COUNT]; /* from what of the log; NULL: it says nothing of the parameter */
  lab_error *error;
} draft;

static int has(const draft *d, int channel)
{
  return d->log.value[channel] != NULL;
}

/* ---- The sheet ---- */

static const lab_sheet_word *find_word(const draft *d, const char *group, const char *key)
{
  int i;
  for (i = 0; i < d->n; i++)
    if (strcmp(d->word[i].group, group) == 0 && (!key || strcmp(d->word[i].key, key) == 0))
      return &d->word[i];
  return NULL;
}

static int add_word(draft *d, const lab_sheet_word *word)
{
  if (d->n == LAB_SHEET_WORDS || find_word(d, word->group, word->key))
    return lab_fail(d->error, LAB_USAGE, "--sheet: %s is there twice", word->key);
  d->word[d->n++] = *word;
  return LAB_OK;
}

/* Whether the sheet says in other words what a word of the catalogue would: the spring, or what an orifice passes. */
static int is_said_otherwise(const draft *d, const lab_sheet_word *word)
{
  static const struct {
    const char *group, *key, *other_group, *other;
  } words[] = {
      {"actuator", "bench_set", "actuator", "spring_rate"}, {"actuator", "bench_set", "actuator", "spring_preload"},
      {"actuator", "area", "actuator", "diameter"},         {"transducer.fill", NULL, "transducer", "fill_area"},
      {"transducer.fill", NULL, "transducer.fill", NULL},   {"transducer.vent", NULL, "transducer", "vent_area"},
      {"transducer.vent", NULL, "transducer.vent", NULL}};
  size_t i;
  for (i = 0; i < sizeof words / sizeof words[0]; i++) {
    const lab_sheet_word *other = find_word(d, words[i].other_group, words[i].other);
    if (strcmp(word->group, words[i].group) == 0 && (!words[i].key || strcmp(word->key, words[i].key) == 0) && other &&
        other - d->word < d->n_said)
      return 1;
  }
  return 0;
}

/* A word of the catalogue, where the sheet does not say it. */
static int add_known(draft *d, const char *text)
{
  lab_sheet_word word[2];
  int k, found;
  if (lab_sheet_word_read(text, word, &found, d->error))
    return d->error->status;
  for (k = 0; k < found; k++)
    if (!find_word(d, word[k].group, word[k].key) && !is_said_otherwise(d, &word[k]) && add_word(d, &word[k]))
      return d->error->status;
  return LAB_OK;
}

/* What products of such names have; a rig is called by its actuator. */
static int add_products(draft *d)
{
  char name[LAB_SHEET_VALUE];
  int kind, i;
  for (kind = 0; kind < LAB_PRODUCT_KINDS; kind++) {
    const lab_product *product = d->product[kind];
    if (product && kind == LAB_ACTUATOR) {
      snprintf(name, sizeof name, "name=%s", product->name);
      if (add_known(d, name))
        return d->error->status;
    }
    for (i = 0; product && i < LAB_PRODUCT_WORDS && product->word[i]; i++)
      if (add_known(d, product->word[i]))
        return d->error->status;
  }
  return LAB_OK;
}

static int read_words(draft *d, const char *const *sheet, int n)
{
  int i, k, found, kind;
  for (i = 0; i < n; i++) {
    const lab_product *product;
    lab_sheet_word word[2];
    if (lab_product_read(sheet[i], &kind, &product, d->error))
      return d->error->status;
    if (kind < LAB_PRODUCT_KINDS) {
      d->product[kind] = product;
      continue;
    }
    if (lab_sheet_word_read(sheet[i], word, &found, d->error))
      return d->error->status;
    for (k = 0; k < found; k++)
      if (add_word(d, &word[k]))
        return d->error->status;
  }
  d->n_said = d->n;
  return add_products(d);
}

/* Where a word comes from. */
static const char *source_of(const draft *d, const lab_sheet_word *word)
{
  return word - d->word < d->n_said ? "sheet" : "catalogue";
}

/* "{ Kv = "0.1"; }", the members of an inner group; nothing where the sheet has none. */
static void put_members(const draft *d, const char *group, char *text, size_t room)
{
  int i;
  for (i = 0; i < d->n; i++)
    if (strcmp(d->word[i].group, group) == 0)
      lab_append(text, room, "%s = %s; ", d->word[i].key, d->word[i].value);
}

/* The rig that the sheet alone declares. */
static int read_sheet(draft *d)
{
  static const char *const groups[] = {"actuator", "transducer", "supply", "ambient", "gas", "laws", "tube"};
  static const char *const inner[] = {"fill", "vent"};
  char text[SHEET_TEXT] = "", name[32];
  size_t i, k;
  for (i = 0; i < sizeof groups / sizeof groups[0]; i++) {
    if (!find_word(d, groups[i], NULL) && strcmp(groups[i], "transducer") != 0)
      continue;
    lab_append(text, sizeof text, "%s = { ", groups[i]);
    put_members(d, groups[i], text, sizeof text);
    for (k = 0; k < 2 && strcmp(groups[i], "transducer") == 0; k++) {
      snprintf(name, sizeof name, "transducer.%s", inner[k]);
      if (!find_word(d, name, NULL))
        continue;
      lab_append(text, sizeof text, "%s = { ", inner[k]);
      put_members(d, name, text, sizeof text);
      lab_append(text, sizeof text, "}; ");
    }
    lab_append(text, sizeof text, "};\n");
  }
  return lab_rig_parse(text, "--sheet", &d->rig, d->error);
}

/* Whether the sheet says a parameter, by its key or by a word for it. */
static int is_said(const draft *d, const lab_key *key)
{
  const int spring = key->param == PNEU_PARAM_spring_rate || key->param == PNEU_PARAM_spring_preload;
  return find_word(d, key->group, key->key) || (spring && find_word(d, "actuator", "bench_set")) ||
         (key->param == PNEU_PARAM_area && find_word(d, "actuator", "diameter")) ||
         (key->param == PNEU_PARAM_fill_area && find_word(d, "transducer.fill", NULL)) ||
         (key->param == PNEU_PARAM_vent_area && find_word(d, "transducer.vent", NULL));
}

static int is_param_said(const draft *d, int param)
{
  int i;
  for (i = 0; i < lab_key_count; i++)
    if (lab_keys[i].kind == LAB_KEY_PARAM && lab_keys[i].param == param)
      return is_said(d, &lab_keys[i]);
  return 0;
}

/* ---- What the log says ---- */

typedef struct range {
  double low, high;
} range;

static range range_of(const draft *d, int channel)
{
  range r;
  lab_range(d->log.value[channel], has(d, channel) ? d->log.n : 0, &r.low, &r.high);
  return r;
}

/* A parameter that the sheet does not say, within its bounds. */
static void derive(draft *d, int param, double value, const char *from)
{
  const pneu_param_info info = lab_param_info(param);
  if (is_param_said(d, param) || !isfinite(value))
    return;
  value = fmin(fmax(value, (double)info.lower), (double)info.upper);
  d->derived[param] = from;
  *pneu_param_at(&d->rig.params, param) = (pneu_real)value;
}

/* Where the stops are: means of what lies within a hundredth of the range of its ends. */
static range stops_of(const draft *d)
{
  const double *x = d->log.value[LAB_CHANNEL_X];
  const range r = range_of(d, LAB_CHANNEL_X);
  const double margin = 0.01 * (r.high - r.low);
  double low = 0, high = 0, n_low = 0, n_high = 0;
  size_t i;
  for (i = 0; x && i < d->log.n; i++)
    if (x[i] <= r.low + margin) {
      low += x[i];
      n_low++;
    } else if (x[i] >= r.high - margin) {
      high += x[i];
      n_high++;
    }
  return (range){low / n_low, high / n_high};
}

static void derive_travel(draft *d)
{
  const range x = stops_of(d), p = range_of(d, LAB_CHANNEL_P), ps = range_of(d, LAB_CHANNEL_PS);
  const pneu_params *q = &d->rig.params;
  if (x.high > x.low && !d->x_is_share)
    derive(d, PNEU_PARAM_stroke, x.high - x.low, "the range of x; give that of the sheet");
  if (has(d, LAB_CHANNEL_PS))
    derive(d, PNEU_PARAM_supply_pressure, ps.high, "the highest ps");
  else if (has(d, LAB_CHANNEL_P) && p.high > 0)
    derive(d, PNEU_PARAM_supply_pressure, 1.05 * p.high, "5 % above the highest p; give that of the regulator");
  derive(d, PNEU_PARAM_dead_volume, 0.1 * (double)(q->area * q->stroke),
         "a tenth of the swept volume; with tubes, of which nothing is known");
}

/* Which way the stem moves in row i: 1, -1, or 0 where it hardly does, or is next to a stop. */
static int way_of(const draft *d, const range *r, size_t i, size_t w)
{
  const double *x = d->log.value[LAB_CHANNEL_X], span = r->high - r->low, dx = x[i + w] - x[i - w];
  if (!(x[i] > r->low + 0.1 * span && x[i] < r->high - 0.1 * span) || !(fabs(dx) > 0.01 * span))
    return 0;
  return dx > 0 ? 1 : -1;
}

/* The straight lines of p over x up and down, of one slope. */
typedef struct lines {
  double slope; /* [Pa/m]; NaN, as the others, where the log does not tell */
  double at_0;  /* [Pa] of their middle */
  double apart; /* [Pa] half their distance */
} lines;

static lines fit_lines(const draft *d)
{
  const double *p = d->log.value[LAB_CHANNEL_P], *x = d->log.value[LAB_CHANNEL_X];
  const range r = range_of(d, LAB_CHANNEL_X);
  const size_t w = d->log.n / (5 * WINDOWS) + 1;
  lab_line up = {0}, down = {0};
  lines l;
  size_t i;
  for (i = w; i + w < d->log.n; i++) {
    const int way = way_of(d, &r, i, w);
    if (way && isfinite(p[i]))
      lab_line_add(way > 0 ? &up : &down, x[i], p[i], 1);
  }
  if (up.n < LEAST_ROWS || down.n < LEAST_ROWS)
    return (lines){NAN, NAN, NAN};
  l.slope = (up.xy + down.xy) / (up.xx + down.xx);
  l.at_0 = (up.level - l.slope * up.middle + down.level - l.slope * down.middle) / 2;
  l.apart = (up.level - l.slope * up.middle - down.level + l.slope * down.middle) / 2;
  return l;
}

static void derive_spring(draft *d)
{
  const double area = (double)d->rig.params.area;
  lines l;
  if (!has(d, LAB_CHANNEL_P) || !has(d, LAB_CHANNEL_X))
    return;
  l = fit_lines(d);
  if (!(l.slope > 0))
    return;
  derive(d, PNEU_PARAM_spring_rate, area * l.slope, "area times the slope of p over x");
  derive(d, PNEU_PARAM_spring_preload, l.at_0 / l.slope, "where the line of p over x would be at 0");
  derive(d, PNEU_PARAM_dry_friction, fmax(area * l.apart, 0), "half the width of the loop of p over x, times area");
}

/* Friction that no log shows grows with the actuator: a start, by judgement, as a share of what the spring gains over
 * the stroke. */
static void guess_friction(draft *d)
{
  static const double share = 0.03;
  const pneu_params *p = &d->rig.params;
  if (!d->derived[PNEU_PARAM_dry_friction])
    derive(d, PNEU_PARAM_dry_friction, share * (double)(p->spring_rate * p->stroke),
           "a guess, 3 % of what the spring gains over the stroke; of the packing nothing is known");
}

/* The largest flow into the chamber (sign 1) or out of it (-1) [kg/s]. */
static double largest_flow(const draft *d, double sign)
{
  const double *t = d->log.value[LAB_CHANNEL_TIME], *p = d->log.value[LAB_CHANNEL_P], *x = d->log.value[LAB_CHANNEL_X];
  const pneu_params *q = &d->rig.params;
  const size_t w = d->log.n / WINDOWS > 4 ? d->log.n / WINDOWS : 4;
  double most = 0;
  size_t i;
  for (i = 0; i + w < d->log.n; i++) {
    const double dt = t[i + w] - t[i], at = x && isfinite(x[i]) ? x[i] : 0;
    const double dx = x && isfinite(x[i + w] - x[i]) ? x[i + w] - x[i] : 0;
    const double volume = (double)q->dead_volume + (double)q->area * fmax(at, 0);
    const double rate = (volume * (p[i + w] - p[i]) + (p[i] + (double)q->ambient_pressure) * (double)q->area * dx) / dt;
    if (dt > 0 && sign * rate > most)
      most = sign * rate;
  }
  return most / (double)(q->gas_constant * q->ambient_temperature);
}

static void derive_orifices(draft *d)
{
  const pneu_params *q = &d->rig.params;
  const double p_high = range_of(d, LAB_CHANNEL_P).high;
  pneu_model model;
  pneu_flow full;
  if (!has(d, LAB_CHANNEL_P) || lab_log_command(&d->log) < 0 || lab_rig_model(&d->rig, &model, d->error))
    return;
  pneu_orifice(&model, PNEU_FLOW_CHOKED, 1, q->supply_pressure + q->ambient_pressure, q->supply_temperature, 0, &full);
  derive(d, PNEU_PARAM_fill_area, largest_flow(d, 1) / (double)full.q, "the fastest filling, were it choked");
  pneu_orifice(&model, PNEU_FLOW_CHOKED, 1, (pneu_real)fmax(p_high, 1) + q->ambient_pressure, q->ambient_temperature, 0,
               &full);
  derive(d, PNEU_PARAM_vent_area, largest_flow(d, -1) / (double)full.q, "the fastest venting, were it choked");
}

/* ---- Writing ---- */

static void put_value(FILE *file, const draft *d, int param)
{
  fprintf(file, "\"%.4g %s\"", lab_param_value(&d->rig, param), lab_param_info(param).unit);
}

/* What every draft has. */
static const int needed[] = {PNEU_PARAM_area,           PNEU_PARAM_dead_volume,    PNEU_PARAM_stroke,
                             PNEU_PARAM_spring_rate,    PNEU_PARAM_spring_preload, PNEU_PARAM_moving_mass,
                             PNEU_PARAM_dry_friction,   PNEU_PARAM_fill_area,      PNEU_PARAM_vent_area,
                             PNEU_PARAM_supply_pressure};
enum { NEEDED = sizeof needed / sizeof needed[0] };

/* A line for a parameter that the sheet, the log or nobody knows; those that hardly matter only where they are known.
 */
static void put_key(FILE *file, const draft *d, const lab_key *key)
{
  const lab_sheet_word *word = find_word(d, key->group, key->key);
  const char *from = key->kind == LAB_KEY_PARAM ? d->derived[key->param] : NULL;
  size_t i;
  if (word) {
    fprintf(file, "  %s = %s; // %s\n", key->key, word->value, source_of(d, word));
    return;
  }
  if (key->kind == LAB_KEY_NAME)
    fprintf(file, "  // %s = \"...\"; // by default that of this file\n", key->key);
  if (key->kind != LAB_KEY_PARAM || is_said(d, key))
    return;
  for (i = 0; i < NEEDED; i++)
    if (needed[i] == key->param) {
      fprintf(file, "  %s = ", key->key);
      put_value(file, d, key->param);
      fprintf(file, from ? "; // derived: %s\n" : "; // NOT KNOWN, a default: %s\n",
              from ? from : lab_param_info(key->param).meaning);
    }
}

/* Members that stand in a group of their own. */
static void put_inner(FILE *file, const draft *d, const char *key, const char *group)
{
  char members[SHEET_TEXT] = "";
  put_members(d, group, members, sizeof members);
  if (*members)
    fprintf(file, "%s = { %s}; // %s\n", key, members, source_of(d, find_word(d, group, NULL)));
}

/* What a sheet says of an actuator in other words than keys. */
static void put_words(FILE *file, const draft *d)
{
  static const struct {
    const char *key, *what;
  } words[] = {{"bench_set", ", in place of spring_rate and spring_preload"},
               {"diameter", ", in place of area"},
               {"fail", ": travel in a log is how far the valve is open, in results how far air has driven the stem"}};
  size_t i;
  for (i = 0; i < sizeof words / sizeof words[0]; i++) {
    const lab_sheet_word *word = find_word(d, "actuator", words[i].key);
    if (word)
      fprintf(file, "  %s = %s; // %s%s\n", word->key, word->value, source_of(d, word), words[i].what);
  }
}

static void put_group(FILE *file, const draft *d, const char *group)
{
  int i;
  fprintf(file, "%s = {\n", group);
  for (i = 0; i < lab_key_count; i++)
    if (strcmp(lab_keys[i].group, group) == 0)
      put_key(file, d, &lab_keys[i]);
  if (strcmp(group, "actuator") == 0)
    put_words(file, d);
  if (strcmp(group, "transducer") == 0) {
    put_inner(file, d, "  fill", "transducer.fill");
    put_inner(file, d, "  vent", "transducer.vent");
  }
  fputs("};\n", file);
}

/* Whether the flow law is the draft's: that of ISO 6358, whose b of 0.3 is within 4.2 % of IEC 60534-2-1. A nozzle
 * passes up to 17 % more where pressures are near, which a log tells as another b; what the law of a nozzle lacks it
 * does not. */
static int drafts_flow(const draft *d)
{
  return !find_word(d, "laws", "flow");
}

static void put_laws(FILE *file, const draft *d)
{
  char members[SHEET_TEXT] = "";
  put_members(d, "laws", members, sizeof members);
  fprintf(file, "laws = { %s%s};\n", drafts_flow(d) ? "flow = \"iso6358\"; " : "", members);
}

/* To be away from a start of the fit, up to ten times, or from a default that nobody knows, is no deviation. Only what
 * is derived and not fitted, as a stroke, is as good as declared.
 * In:      fitted  whether each of `needed` is */
static void put_tolerances(FILE *file, const draft *d, const int fitted[NEEDED])
{
  int i, any = 0;
  for (i = 0; i < NEEDED; i++) {
    if (is_param_said(d, needed[i]) || (d->derived[needed[i]] && !fitted[i]))
      continue;
    fprintf(file, "%s %s = \"%s %%\";", any++ ? "" : "tolerance = {", lab_param_info(needed[i]).name,
            fitted[i] ? "1000" : "100");
  }
  if (drafts_flow(d) && !is_param_said(d, PNEU_PARAM_critical_ratio))
    fprintf(file, "%s critical_ratio = \"100 %%\";", any++ ? "" : "tolerance = {");
  if (any)
    fputs(" }; // starts and defaults: to be away from them is no deviation\n", file);
}

/* A log with sp and no u has a positioner, the gain of which it can determine if the sheet does not say it. */
static int fits_gain(const draft *d)
{
  return lab_log_command(&d->log) == LAB_CHANNEL_SP && !find_word(d, "positioner", "gain");
}

/* What the log can determine: orifices by p or x, supply and dead volume by p, spring and friction by both p and x. */
static void put_fit(FILE *file, const draft *d)
{
  const int p = has(d, LAB_CHANNEL_P), x = has(d, LAB_CHANNEL_X), u = lab_log_command(&d->log) >= 0;
  const int spring = d->derived[PNEU_PARAM_spring_rate] != NULL;
  const struct {
    int param, can;
  } fit[] = {{PNEU_PARAM_fill_area, u && (p || x)},
             {PNEU_PARAM_vent_area, u && (p || x)},
             {PNEU_PARAM_supply_pressure, u && p && !has(d, LAB_CHANNEL_PS)},
             {PNEU_PARAM_dead_volume, u && p && x},
             {PNEU_PARAM_spring_rate, spring},
             {PNEU_PARAM_spring_preload, spring},
             {PNEU_PARAM_dry_friction, x}};
  const char *between = "";
  int fitted[NEEDED] = {0};
  size_t i, k;
  fputs(
      "// What the log can determine, and the sheet does not say; the rest is known to its usual tolerance.\nfit = ( ",
      file);
  for (i = 0; i < sizeof fit / sizeof fit[0]; i++) {
    if (!fit[i].can || is_param_said(d, fit[i].param))
      continue;
    fprintf(file, "%s\"%s\"", between, lab_param_info(fit[i].param).name);
    between = ", ";
    for (k = 0; k < NEEDED; k++)
      fitted[k] |= needed[k] == fit[i].param;
  }
  if (fits_gain(d))
    fprintf(file, "%s\"positioner.gain\"", between);
  fputs(" );\n", file);
  put_tolerances(file, d, fitted);
}

/* What the sheet says of the positioner, and a start of its gain for the fit. */
static void put_positioner(FILE *file, const draft *d)
{
  char members[SHEET_TEXT] = "";
  if (!fits_gain(d)) {
    put_inner(file, d, "positioner", "positioner");
    return;
  }
  put_members(d, "positioner", members, sizeof members);
  fprintf(file,
          "positioner = { gain = 20; %s}; // the log has a set position and no command; the gain is a start for the "
          "fit\n",
          members);
}

/* A log with neither u nor sp is the balance of forces alone, driven by p. */
static void put_drive(FILE *file, const draft *d)
{
  const int command = lab_log_command(&d->log);
  put_positioner(file, d);
  if (command < 0 && has(d, LAB_CHANNEL_P) && has(d, LAB_CHANNEL_X))
    fputs("inputs = [\"p\"]; // the log has no command: p drives the stem, and the balance of mass is off\n", file);
}

/* A channel whose value does not change tells no noise. */
static void put_noise(FILE *file, const draft *d)
{
  int c, any = 0;
  for (c = LAB_CHANNEL_P; c < LAB_CHANNEL_COUNT; c++) {
    const range r = range_of(d, c);
    if (!has(d, c) || r.high > r.low)
      continue;
    fprintf(file, "%s %s = \"%.3g %s\";", any++ ? "" : "noise = {", lab_channels[c].quantity,
            fmax(1e-3 * fabs(r.high), 1e-6), lab_channels[c].unit);
  }
  if (any)
    fputs(" }; // a channel that does not change: a thousandth of it\n", file);
}

static void put_channel(FILE *file, const draft *d, int c)
{
  const char *unit = strcmp(lab_channels[c].unit, "1") ? lab_channels[c].unit : "";
  const range r = range_of(d, c);
  const double q = lab_resolution(d->log.value[c], d->log.n);
  lab_error ignored;
  double noise;
  fprintf(file, "//   %-5s %s: %.4g .. %.4g%s%s", lab_channels[c].key, lab_channels[c].meaning, r.low, r.high,
          *unit ? " " : "", unit);
  if (q > 0)
    fprintf(file, ", in steps of %.3g", q);
  if (c >= LAB_CHANNEL_P && lab_noise_estimate(d->log.value[c], d->log.n, &noise, &ignored) == LAB_OK && noise > 0)
    fprintf(file, ", noise about %.3g", noise);
  fputc('\n', file);
}

/* Of which log, and what it has. */
static void put_log(FILE *file, const draft *d)
{
  const double *t = d->log.value[LAB_CHANNEL_TIME];
  const double length = t[d->log.n - 1] - t[0], step = d->log.n > 1 ? length / (double)(d->log.n - 1) : 0;
  char name[256];
  int c;
  snprintf(name, sizeof name, "%s", lab_file_name(d->log.path));
  lab_make_plain(name);
  fprintf(file, "// Drafted by closeloop --init from %s: %zu rows", name, d->log.n);
  if (d->log.n_runs == 1 && length > 0)
    fprintf(file, " in %.4g s, one each %.4g s (%.4g Hz)", length, step, 1 / step);
  fputs(".\n", file);
  if (*d->log.read_as)
    fprintf(file, "// Read as: %s.\n", d->log.read_as);
  fputs("// Channels, in SI:\n", file);
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    if (has(d, c))
      put_channel(file, d, c);
}

static void put_head(FILE *file, const draft *d)
{
  int c;
  if (d->log.n)
    put_log(file, d);
  else
    fputs("// Drafted by closeloop --sheet, without a log.\n", file);
  for (c = 0; c < LAB_PRODUCT_KINDS; c++)
    if (d->product[c])
      fprintf(file, "// Catalogue: %s. %s\n", d->product[c]->source,
              c == LAB_ACTUATOR ? "Its plate may say another range or travel." : "Tubes and fittings pass less.");
  fputs("// Behind each value stands where it comes from. Replace what is NOT KNOWN by what the data sheet says.\n",
        file);
}

static void put_all(FILE *file, const draft *d)
{
  put_head(file, d);
  put_group(file, d, "actuator");
  put_group(file, d, "transducer");
  put_group(file, d, "supply");
  if (find_word(d, "ambient", NULL))
    put_group(file, d, "ambient");
  if (find_word(d, "gas", NULL))
    put_group(file, d, "gas");
  put_inner(file, d, "tube", "tube");
  put_laws(file, d);
  put_drive(file, d);
  if (d->log.n)
    put_fit(file, d);
  put_noise(file, d);
}

/* ---- All ---- */

/* Read the log, and once more with another stroke: a position that follows is a share of it. */
static int read_log(draft *d, const char *path)
{
  const double ambient = (double)d->rig.params.ambient_pressure;
  lab_log_format other = d->rig.log;
  lab_log again;
  if (lab_log_read(path, &d->rig.log, ambient, &d->log, d->error))
    return d->error->status;
  if (!has(d, LAB_CHANNEL_X))
    return LAB_OK;
  other.stroke *= 2;
  if (lab_log_read(path, &other, ambient, &again, d->error))
    return d->error->status;
  d->x_is_share = memcmp(again.value[LAB_CHANNEL_X], d->log.value[LAB_CHANNEL_X], d->log.n * sizeof(double)) != 0;
  lab_log_free(&again);
  return LAB_OK;
}

static int write_draft(draft *d, FILE *file, const char *log, const char *const *sheet, int n)
{
  if (read_words(d, sheet, n) || read_sheet(d) || (log && read_log(d, log)))
    return d->error->status;
  derive_travel(d);
  derive_spring(d);
  guess_friction(d);
  derive_orifices(d);
  put_all(file, d);
  return LAB_OK;
}

int lab_draft_write(FILE *file, const char *log, const char *const *sheet, int n, lab_error *error)
{
  draft *d = calloc(1, sizeof *d);
  int status;
  if (!d)
    return lab_fail_memory(error, "a draft");
  d->error = error;
  status = write_draft(d, file, log, sheet, n);
  lab_log_free(&d->log);
  free(d);
  return status;
}

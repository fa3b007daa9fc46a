#include "metrics.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/format.h"
#include "../base/json.h"
#include "metrics_private.h"
#include "../base/noise.h"

static const double normal_pressure = 101325, normal_temperature = 273.15; /* DIN 1343 */
static const double limit = 50;                                            /* [%] [B, Eq. 49] */
static const char *const fates[] = {"",
                                    "the signal takes its time",
                                    "gap",
                                    "the stem was not at rest before it",
                                    "not settled before the next step or the end (hold longer)",
                                    "too small a movement"};

static const double seen_share = 0.0005; /* a movement is seen from this share of the stroke on, and above noise */

/* ---- Setting a figure ---- */

const lab_metric_info lab_metric_infos[LAB_METRIC_COUNT] = {
#define X(name, key, unit, standard, meaning) {key, unit, standard, meaning},
    LAB_METRIC_LIST(X)
#undef X
};

int lab_command_is_set(int command)
{
  return command == LAB_COMMAND_SET_PRESSURE || command == LAB_COMMAND_SET_POSITION;
}

const char *lab_metrics_step_signal(int command)
{
  static const char *const text[] = {"opening of the transducer", "set pressure", "chamber pressure", "set position"};
  return text[command];
}

const char *lab_metrics_static_signal(int command)
{
  return lab_command_is_set(command) ? lab_metrics_step_signal(command) : "chamber pressure";
}

double lab_span(const lab_record *r)
{
  return r->signal_high - r->signal_low;
}

void lab_metric_set(lab_metrics_work *m, int metric, double value, double uncertainty, const char *format, ...)
{
  lab_metric *it = &m->metrics->metric[metric];
  va_list list;
  it->value = value;
  it->uncertainty = uncertainty;
  va_start(list, format);
  vsnprintf(it->text, sizeof it->text, format, list);
  va_end(list);
}

void lab_metrics_deny(lab_metrics_work *m, int first, int last, const char *reason)
{
  for (; first <= last; first++)
    lab_metric_absent(m, first, "%s", reason);
}

/* ---- Air and energy of a cycle, a full stroke up and then down: [B, section 5] ---- */

typedef struct cycle {
  const lab_leg *up, *down;
} cycle;

static int find_cycle(const lab_metrics_work *m, cycle *c)
{
  const lab_path *rows = &m->rows;
  const double least = LAB_FULL_STROKE * m->record->stroke;
  size_t k;
  for (k = 1; k < rows->n_legs; k++) {
    c->up = &rows->leg[k - 1];
    c->down = &rows->leg[k];
    if (c->up->up && !c->down->up && rows->point[c->up->begin].run == rows->point[c->down->begin].run &&
        lab_leg_travel(rows, c->up) >= least && lab_leg_travel(rows, c->down) >= least)
      return 1;
  }
  return 0;
}

/* Integral of A p dx over a leg by the trapezoidal rule on every `stride`-th point, the last one included. */
static double work(const lab_metrics_work *m, const lab_leg *leg, size_t stride)
{
  const lab_point *at = m->rows.point;
  double sum = 0;
  size_t i = leg->begin, next;
  while (i + 1 < leg->end) {
    next = i + stride < leg->end ? i + stride : leg->end - 1;
    sum += (at[i].s + at[next].s) / 2 * (at[next].x - at[i].x);
    i = next;
  }
  return m->record->area * sum;
}

/* How well an integral is known: noise of the pressure over the stroke and of the ends of the stroke, and the step. */
static double work_error(const lab_metrics_work *m, const lab_leg *leg)
{
  const double noise =
      m->record->area * m->noise_p * lab_leg_travel(&m->rows, leg) / sqrt((double)(leg->end - leg->begin));
  const double ends = m->record->area * m->record->supply * m->noise_x;
  return 2 * noise + ends + fabs(work(m, leg, 1) - work(m, leg, 2));
}

static void report_efficiency(lab_metrics_work *m, double in, double out, double lost, double error)
{
  const double share = 100 * (1 - out / in - lost / in);
  lab_metric_set(m, LAB_METRIC_ENERGY_EFFICIENCY, share, 100 * error / in,
                 share < limit ? "below the limit of 50 %% of Eq. 49; E_o/E_i = %.3g"
                               : "above the limit of 50 %% of Eq. 49, which takes E_o/E_i as 0.5; here it is %.3g",
                 out / in);
}

static void report_energy(lab_metrics_work *m, const cycle *c)
{
  const lab_record *r = m->record;
  const double rise = work(m, c->up, 1), out = -work(m, c->down, 1);
  const double error = work_error(m, c->up) + work_error(m, c->down);
  const double stroke = lab_leg_travel(&m->rows, c->up), in = r->area * r->supply * stroke;
  lab_metric_set(m, LAB_METRIC_ENERGY_IN, in, r->area * r->supply * 2 * m->noise_x,
                 "supply of %.4g kPa, travel of %.4g mm", r->supply / 1e3, 1e3 * stroke);
  lab_metric_set(m, LAB_METRIC_ENERGY_OUT, out, error, "falling stroke of the same cycle");
  lab_metric_set(m, LAB_METRIC_ENERGY_LOST, rise - out, error,
                 "the same cycle; all of it is friction if nothing loads the stem");
  report_efficiency(m, in, out, rise - out, error);
}

/* Integral of the flow from the supply between two times of a run. */
static double inflow(const lab_record *r, int run, double from, double to, size_t stride)
{
  double sum = 0;
  size_t i = r->first[run], next;
  for (; i + 1 < r->first[run + 1] && r->t[i] < to; i = next) {
    next = i + stride < r->first[run + 1] ? i + stride : r->first[run + 1] - 1;
    if (r->t[i] >= from)
      sum += (r->mass_in[i] + r->mass_in[next]) / 2 * (r->t[next] - r->t[i]);
  }
  return sum;
}

static void report_air(lab_metrics_work *m, const cycle *c)
{
  const lab_record *r = m->record;
  const lab_point *begin = &m->rows.point[c->up->begin], *end = &m->rows.point[c->down->end - 1];
  const double mass = inflow(r, begin->run, begin->t, end->t, 1);
  const double error = fabs(mass - inflow(r, begin->run, begin->t, end->t, 2));
  const double litres = 1e3 * r->gas_constant * normal_temperature / normal_pressure;
  lab_metric_set(m, LAB_METRIC_AIR_MASS, mass, error, "first full stroke up and down");
  lab_metric_set(m, LAB_METRIC_AIR_VOLUME, litres * mass, litres * error, "first full stroke up and down");
}

static void measure_cycle(lab_metrics_work *m)
{
  const lab_record *r = m->record;
  cycle c = {NULL, NULL};
  const char *no_cycle =
      r->p && find_cycle(m, &c) ? NULL : "no cycle: no full stroke up that a full stroke down follows";
  const char *no_energy = !r->p              ? "the record has no chamber pressure"
                          : no_cycle         ? no_cycle
                          : !(r->supply > 0) ? "the supply pressure is not known"
                                             : NULL;
  const char *no_air = r->command == LAB_COMMAND_PRESSURE
                           ? "chamber pressure is the input: nothing is known of the flow that makes it"
                       : !r->mass_in ? "the record has no mass flow; a simulation of it has"
                                     : no_cycle;
  if (no_energy)
    lab_metrics_deny(m, LAB_METRIC_ENERGY_IN, LAB_METRIC_ENERGY_EFFICIENCY, no_energy);
  else
    report_energy(m, &c);
  if (no_air)
    lab_metrics_deny(m, LAB_METRIC_AIR_MASS, LAB_METRIC_AIR_VOLUME, no_air);
  else
    report_air(m, &c);
}

/* ---- Measuring all ---- */

/* Noise of a channel: declared, or estimated; 0 where there is too little to tell. */
static int noise_of(const double *value, size_t n, double declared, double *noise, lab_error *error)
{
  *noise = declared;
  if (isnan(declared) && value && lab_noise_estimate(value, n, noise, error))
    return error->status;
  if (!(*noise >= 0))
    *noise = 0;
  return LAB_OK;
}

static int measure(lab_metrics_work *m, lab_error *error)
{
  const lab_record *r = m->record;
  if (noise_of(r->p, r->n, r->noise_p, &m->noise_p, error) || noise_of(r->x, r->n, r->noise_x, &m->noise_x, error))
    return error->status;
  m->least = fmax(LAB_SEEN * m->noise_x, seen_share * r->stroke);
  if (lab_holds_find(m, error) || lab_steps_measure(m, error) || lab_path_find(m, error))
    return error->status;
  lab_static_measure(m);
  measure_cycle(m);
  return LAB_OK;
}

/* Why a record gives nothing; NULL: it may give something. */
static const char *unfit(const lab_record *r)
{
  return r->unfit           ? r->unfit
         : !(r->stroke > 0) ? "there is no stem: the stroke is 0"
         : !r->x            ? "the record has no position"
         : r->n == 0        ? "the record has no rows"
                            : NULL;
}

int lab_metrics_measure(const lab_record *record, lab_metrics *metrics, lab_error *error)
{
  const char *reason = unfit(record);
  lab_metrics_work m = {.record = record, .metrics = metrics};
  int status = LAB_OK;
  memset(metrics, 0, sizeof *metrics);
  metrics->command = record->command;
  if (reason)
    lab_metrics_deny(&m, 0, LAB_METRIC_COUNT - 1, reason);
  else
    status = measure(&m, error);
  free(m.hold);
  free(m.step);
  lab_path_free(&m.path);
  lab_path_free(&m.rows);
  return status;
}

/* ---- For people ---- */

const char *lab_metric_value(const lab_metric *metric, char text[LAB_METRIC_SHOWN])
{
  char number[LAB_FORMAT_TEXT];
  snprintf(text, LAB_METRIC_SHOWN, "%s%s", metric->at_most && isfinite(metric->value) ? "<= " : "",
           lab_format_number(metric->value, 4, number));
  return text;
}

static void print_figures(FILE *file, const lab_metrics *metrics)
{
  int i;
  fprintf(file, "%-21s %10s %9s %-4s %-39s %s\n", "figure", "value", "+/-", "unit", "standard", "from, or why not");
  for (i = 0; i < LAB_METRIC_COUNT; i++) {
    const lab_metric *metric = &metrics->metric[i];
    const lab_metric_info *info = &lab_metric_infos[i];
    char value[LAB_METRIC_SHOWN], error[LAB_FORMAT_TEXT];
    fprintf(file, "%-21s %10s %9s %-4s %-39s %s\n", info->key, lab_metric_value(metric, value),
            lab_format_number(metric->at_most ? (double)NAN : metric->uncertainty, 2, error), info->unit,
            info->standard, metric->text);
  }
}

static int kept(const lab_metrics *metrics)
{
  return metrics->n_steps < LAB_METRIC_STEPS ? metrics->n_steps : LAB_METRIC_STEPS;
}

static void print_step(FILE *file, const lab_metrics *metrics, const lab_step_response *step)
{
  const double scale =
      metrics->command == LAB_COMMAND_OPENING || metrics->command == LAB_COMMAND_SET_POSITION ? 1 : 1e-3;
  fprintf(file, "%9.6g %9.6g %9.6g %9.5g %9.5g ", step->t, scale * step->from, scale * step->to, 1e3 * step->x_from,
          1e3 * step->x_to);
  if (step->fate == LAB_STEP_GOOD)
    fprintf(file, "%9.4g %9.4g %9.4g %9.4g %9.3g\n", step->dead_time, step->t63, step->t86, step->settling_time,
            step->overshoot);
  else
    fprintf(file, "  %s\n", fates[step->fate]);
}

void lab_metrics_print(FILE *file, const lab_metrics *metrics)
{
  int i;
  fprintf(file, "Steps are of the %s; static figures set position against %s.\n\n",
          lab_metrics_step_signal(metrics->command), lab_metrics_static_signal(metrics->command));
  print_figures(file, metrics);
  if (metrics->n_steps == 0)
    return;
  fprintf(file, "\n%9s %9s %9s %9s %9s %9s %9s %9s %9s %9s\n", "step [s]", "from", "to", "x [mm]", "to [mm]", "Td [s]",
          "T63 [s]", "T86 [s]", "2 % [s]", "over [%]");
  for (i = 0; i < kept(metrics); i++)
    print_step(file, metrics, &metrics->step[i]);
  if (kept(metrics) < metrics->n_steps)
    fprintf(file, "and %d steps more\n", metrics->n_steps - kept(metrics));
}

/* ---- For programs ---- */

cJSON *lab_metrics_object(const lab_metrics *metrics)
{
  cJSON *all = cJSON_CreateObject();
  int i;
  for (i = 0; i < LAB_METRIC_COUNT; i++) {
    const lab_metric *metric = &metrics->metric[i];
    const lab_metric_info *info = &lab_metric_infos[i];
    cJSON *o = cJSON_AddObjectToObject(all, info->key);
    cJSON_AddNumberToObject(o, "value", metric->value);
    cJSON_AddStringToObject(o, "unit", info->unit);
    if (isnan(metric->value)) {
      cJSON_AddStringToObject(o, "reason", metric->text);
      continue;
    }
    cJSON_AddNumberToObject(o, "uncertainty", metric->uncertainty);
    cJSON_AddBoolToObject(o, "at_most", metric->at_most);
    cJSON_AddStringToObject(o, "standard", info->standard);
    cJSON_AddStringToObject(o, "basis", metric->text);
  }
  return all;
}

static void add_step(cJSON *list, const lab_step_response *step)
{
  cJSON *o = lab_json_append(list);
  LAB_JSON_NUMBERS(o, {"t", step->t}, {"from", step->from}, {"to", step->to}, {"x_from", step->x_from},
                   {"x_to", step->x_to}, {"dead_time", step->dead_time}, {"t63", step->t63}, {"t86", step->t86},
                   {"settling_time", step->settling_time}, {"overshoot", step->overshoot});
  if (step->fate != LAB_STEP_GOOD)
    cJSON_AddStringToObject(o, "reason", fates[step->fate]);
}

int lab_metrics_json(FILE *file, const lab_metrics *metrics, lab_error *error)
{
  cJSON *root = cJSON_CreateObject(), *list;
  int i;
  cJSON_AddStringToObject(root, "step_signal", lab_metrics_step_signal(metrics->command));
  cJSON_AddStringToObject(root, "static_signal", lab_metrics_static_signal(metrics->command));
  cJSON_AddItemToObject(root, "metrics", lab_metrics_object(metrics));
  list = cJSON_AddArrayToObject(root, "steps");
  for (i = 0; i < kept(metrics); i++)
    add_step(list, &metrics->step[i]);
  return lab_json_write(file, root, "figures of merit", error);
}

#include "report.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../base/escape.h"
#include "../base/format.h"
#include "../trace/freeterms.h"

const char *lab_in_folder(const char *folder, const char *name, char path[LAB_FILE_TEXT])
{
  snprintf(path, LAB_FILE_TEXT, "%s/%s", folder, name);
  return path;
}

int lab_report_file(const char *folder, const char *name, lab_report_writer *write, const lab_sources *from,
                    lab_error *error)
{
  char path[LAB_PATH_TEXT + 32];
  lab_outfile out;
  if (snprintf(path, sizeof path, "%s/%s", folder, name) >= (int)sizeof path)
    return lab_fail(error, LAB_DATA, "%.80s...: the path is too long", folder);
  if (lab_out_open(&out, path, error))
    return error->status;
  return lab_out_end(&out, write(out.file, from, error), error);
}

/* What was added stands in `fit` beside what was fitted, so that another log is asked for its size. */
static void fit_what_was_added(const lab_unknowns *u, lab_rig *rig)
{
  int j;
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].kind == LAB_UNKNOWN_PARAM && !lab_rig_fits(rig, u->unknown[j].index))
      rig->fit[rig->n_fit++] = u->unknown[j].index;
}

int lab_report_model(FILE *file, const lab_sources *from, lab_error *error)
{
  lab_rig rig = from->report->completed->rig;
  (void)error;
  fit_what_was_added(from->report->completed, &rig);
  rig.friction = LAB_FRICTION_COULOMB; /* its effects are written with their sizes */
  lab_rig_write(file, &rig, "The completed model, by closeloop.");
  return LAB_OK;
}

int lab_report_header(FILE *file, const lab_sources *from, lab_error *error)
{
  lab_rig last;
  (void)error;
  lab_rig_at(&from->report->completed->rig, INFINITY, &last);
  fputs("/* The completed model of ", file);
  lab_put_comment(file, from->report->rig->name);
  fputs(
      ", by closeloop; for libpneu " PNEU_VERSION ".\n"
      " * const pneu_params p = MODEL_PARAMS; const pneu_laws law = MODEL_LAWS;\n"
      " * The catalogue may be the whole one, or in C99 any that has the effects of effects.def beside this file:\n"
      " * -DPNEU_EFFECTS_FILE='\"FOLDER/effects.def\"', FOLDER as seen from a folder given with -I, and the same for\n"
      " * the library. With any other it does not compile. */\n"
      "#include \"pneu.h\"\n",
      file);
  lab_rig_write_c(file, &last, 0);
  return LAB_OK;
}

int lab_report_catalogue(FILE *file, const lab_sources *from, lab_error *error)
{
  lab_rig last;
  (void)error;
  lab_rig_at(&from->report->completed->rig, INFINITY, &last);
  fputs("/* The effects that model.h beside this file needs, by closeloop: see there. */\n", file);
  lab_rig_write_catalogue(file, &last);
  return LAB_OK;
}

const pneu_term *lab_report_term(const lab_report *report, const lab_found *found)
{
  return &report->completed->rig.term[found->term];
}

int lab_report_size(const lab_report *report, int param)
{
  const int j = lab_unknowns_find_onset(report->completed, param);
  return j >= 0 ? j : lab_unknowns_find(report->completed, param);
}

/* When the logs begin [s]. */
static double start_of(const lab_unknowns *u)
{
  return u->n_runs > 0 ? u->run[0].log->value[LAB_CHANNEL_TIME][u->run[0].first] : -HUGE_VAL;
}

const lab_onset *lab_report_onset(const lab_report *report, int param)
{
  const int j = lab_unknowns_find_onset(report->completed, param);
  const lab_onset *begin = j < 0 ? NULL : &report->result->begin[report->completed->unknown[j].index];
  return begin && begin->known && begin->low > start_of(report->completed) ? begin : NULL;
}

const char *lab_report_since(const lab_onset *onset, char text[LAB_SINCE_TEXT])
{
  const double width = onset ? fmax(onset->high - onset->low, 1e-9) : 1, size = onset ? fabs(onset->high) : 1;
  const int digits = (int)fmin(fmax(3, 1 + ceil(log10(fmax(size / width, 1)))), 9);
  char at[LAB_FORMAT_TEXT], low[LAB_FORMAT_TEXT], high[LAB_FORMAT_TEXT];
  *text = '\0';
  if (onset)
    snprintf(text, LAB_SINCE_TEXT, " since %s s (%s to %s s)", lab_format_number(onset->t, digits, at),
             lab_format_number(onset->low, digits, low), lab_format_number(onset->high, digits, high));
  return text;
}

double lab_report_refit_explains(const lab_search_result *r, const lab_score *score)
{
  int i;
  for (i = 1; r->window == 0 && i < r->n_steps; i++)
    if (!strcmp(r->step[i].name, pneu_effect_at(score->effect)->name))
      return fmin(fmax((r->step[0].chi2 - r->step[i].chi2) / fmax(r->step[0].chi2 - (double)r->before.n, 1), 0), 1);
  return (double)NAN;
}

const char *lab_report_doubt(const lab_report *report)
{
  const lab_limitations *l = report->limitations;
  return l && l->doubt ? l->text[l->doubt - 1] : NULL;
}

double lab_report_in_noise(const lab_errors *errors)
{
  return sqrt(errors->chi2 / (double)errors->n);
}

int lab_report_is_completed(const lab_report *report)
{
  static const double alike = 0.01; /* errors below the noise count as the noise */
  const lab_search_result *r = report->result;
  const double before = lab_report_in_noise(&r->before), after = lab_report_in_noise(&r->after);
  return r->n_found > 0 || report->completed->rig.n_onsets > 0 || fabs(after - before) > alike * fmax(before, 1);
}

double lab_report_chance(const lab_report *report, const lab_found *found)
{
  return found->effect >= 0 ? found->p_value
                            : lab_free_term_p_value(lab_report_term(report, found), found->statistic, found->degrees);
}

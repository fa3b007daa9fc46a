#include "report.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../base/escape.h"
#include "../trace/freeterms.h"

int lab_report_file_open(const char *folder, const char *name, lab_outfile *out, lab_error *error)
{
  char path[LAB_PATH_TEXT + 32];
  if (snprintf(path, sizeof path, "%s/%s", folder, name) >= (int)sizeof path)
    return lab_fail(error, LAB_DATA, "%.80s...: the path is too long", folder);
  return lab_out_open(out, path, error);
}

int lab_report_model(const lab_report *report, const char *folder, lab_error *error)
{
  lab_rig rig = *report->rig;
  lab_outfile out;
  if (lab_report_file_open(folder, "model.cfg", &out, error))
    return error->status;
  rig = report->completed->rig;
  rig.friction = LAB_FRICTION_COULOMB; /* its effects are written with their sizes */
  lab_rig_write(out.file, &rig, "The completed model, by closeloop.");
  return lab_out_close(&out, error);
}

int lab_report_header(const lab_report *report, const char *folder, lab_error *error)
{
  lab_outfile out;
  if (lab_report_file_open(folder, "model.h", &out, error))
    return error->status;
  fputs("/* The completed model of ", out.file);
  lab_put_comment(out.file, report->rig->name);
  fputs(
      ", by closeloop; for libpneu " PNEU_VERSION ".\n"
      " * const pneu_params p = MODEL_PARAMS; const pneu_laws law = MODEL_LAWS;\n"
      " * The catalogue may be the whole one, or in C99 any that has the effects of effects.def beside this file:\n"
      " * -DPNEU_EFFECTS_FILE='\"FOLDER/effects.def\"', FOLDER as seen from a folder given with -I, and the same for\n"
      " * the library. With any other it does not compile. */\n"
      "#include \"pneu.h\"\n",
      out.file);
  lab_rig_write_c(out.file, &report->completed->rig, 0);
  return lab_out_close(&out, error);
}

int lab_report_catalogue(const lab_report *report, const char *folder, lab_error *error)
{
  lab_outfile out;
  if (lab_report_file_open(folder, "effects.def", &out, error))
    return error->status;
  fputs("/* The effects that model.h beside this file needs, by closeloop: see there. */\n", out.file);
  lab_rig_write_catalogue(out.file, &report->completed->rig);
  return lab_out_close(&out, error);
}

double lab_report_refit_explains(const lab_search_result *r, const lab_score *score)
{
  int i;
  for (i = 1; r->window == 0 && i < r->n_steps; i++)
    if (!strcmp(r->step[i].name, pneu_effect_at(score->effect)->name))
      return (r->step[0].chi2 - r->step[i].chi2) / fmax(r->step[0].chi2 - (double)r->before.n, 1);
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

double lab_report_chance(const lab_report *report, const lab_found *found)
{
  return found->effect >= 0
             ? found->p_value
             : lab_free_term_p_value(&report->completed->rig.term[found->term], found->statistic, found->degrees);
}

#include "report.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../base/escape.h"
#include "../trace/freeterms.h"

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

int lab_report_model(FILE *file, const lab_sources *from, lab_error *error)
{
  lab_rig rig = from->report->completed->rig;
  (void)error;
  rig.friction = LAB_FRICTION_COULOMB; /* its effects are written with their sizes */
  lab_rig_write(file, &rig, "The completed model, by closeloop.");
  return LAB_OK;
}

int lab_report_header(FILE *file, const lab_sources *from, lab_error *error)
{
  (void)error;
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
  lab_rig_write_c(file, &from->report->completed->rig, 0);
  return LAB_OK;
}

int lab_report_catalogue(FILE *file, const lab_sources *from, lab_error *error)
{
  (void)error;
  fputs("/* The effects that model.h beside this file needs, by closeloop: see there. */\n", file);
  lab_rig_write_catalogue(file, &from->report->completed->rig);
  return LAB_OK;
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

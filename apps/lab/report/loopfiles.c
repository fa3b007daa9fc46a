#include "loopfiles.h"

#include <stdio.h>

int lab_report_open(const char *folder, const char *name, lab_outfile *out, lab_error *error)
{
  char path[LAB_PATH_TEXT + 32];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  return lab_out_open(out, path, error);
}

int lab_story_model(const lab_story *story, const char *folder, lab_error *error)
{
  lab_rig rig = *story->rig;
  lab_outfile out;
  if (lab_report_open(folder, "model.cfg", &out, error))
    return error->status;
  rig = story->completed->rig;
  rig.friction = LAB_FRICTION_COULOMB; /* its effects are written with their sizes */
  lab_rig_write(out.file, &rig, "The completed model, by closeloop.");
  return lab_out_close(&out, error);
}

int lab_story_header(const lab_story *story, const char *folder, lab_error *error)
{
  lab_outfile out;
  if (lab_report_open(folder, "model.h", &out, error))
    return error->status;
  fprintf(out.file,
          "/* The completed model of %s, by closeloop; for libpneu " PNEU_VERSION " with its whole catalogue.\n"
          " * const pneu_params p = MODEL_PARAMS; const pneu_laws law = MODEL_LAWS; */\n",
          story->rig->name);
  lab_rig_write_c(out.file, &story->completed->rig);
  return lab_out_close(&out, error);
}

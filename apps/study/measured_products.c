#include "measured_products.h"

#include "measured.h"
#include "measured_damadics.h"
#include "measured_vessel.h"

/* Note the files of a comparison that has been made; absent data has been announced and leaves nothing to note. */
static int note(const study *s, int status, const char *const *file, int n)
{
  int i;
  if (status == MEASURED_ABSENT)
    return LAB_OK;
  for (i = 0; status == LAB_OK && i < n; i++)
    study_note_saved(s, file[i]);
  return status;
}

int measured_vessel_product(const study *s, lab_error *error)
{
  char folder[STUDY_PATH_TEXT];
  static const char *const files[] = {"measured_vessel.csv", "measured_vessel_parameters.csv",
                                      "measured_vessel_curves.csv"};
  study_folder(s, folder);
  return note(s, measured_vessel(folder, s->measured, s->results, error), files, 3);
}

int measured_damadics_product(const study *s, lab_error *error)
{
  char folder[STUDY_PATH_TEXT];
  static const char *const files[] = {"measured_damadics_static.csv", "measured_damadics_loop.csv",
                                      "measured_damadics_catalogue.csv", "measured_damadics_steps.csv",
                                      "measured_damadics_edges.csv"};
  study_folder(s, folder);
  return note(s, measured_damadics(folder, s->measured, s->results, error), files, 5);
}

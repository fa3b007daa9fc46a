/* An answer as files in a folder. */
#include <stdio.h>
#include <unistd.h>

#include "answer.h"
#include "figures.h"
#include "../base/interrupt.h"
#include "../base/outfile.h"

/* Files of an answer, the extent from which on each is always there, and what writes it; figures are drawn by
 * lab_figures_draw. */
static const struct {
  const char *name;
  int extent;
  int rows; /* 1: it needs rows and figures; these come last */
  lab_report_writer *write;
} files[] = {{"model.cfg", LAB_WRITE_PLAIN, 0, lab_report_model},
             {"model.h", LAB_WRITE_PLAIN, 0, lab_report_header},
             {"effects.def", LAB_WRITE_PLAIN, 0, lab_report_catalogue},
             {"report.json", LAB_WRITE_JSON, 0, lab_report_json},
             {"residual.csv", LAB_WRITE_PLAIN, 1, lab_report_residual},
             {"report.html", LAB_WRITE_PLAIN, 1, lab_report_html},
             {"response.svg", LAB_WRITE_FIGURES, 1, NULL},
             {"residual.svg", LAB_WRITE_FIGURES, 1, NULL}};

static int write_files(const lab_report *report, const char *folder, int extent, lab_error *error)
{
  lab_figures *figures = NULL;
  int status = lab_make_folder(folder, error);
  size_t i;
  for (i = 0; i < sizeof files / sizeof *files; i++) {
    if (!files[i].write || files[i].extent > extent)
      continue;
    if (status == LAB_OK && files[i].rows && !figures)
      status = lab_figures_make(report, &figures, error);
    if (status == LAB_OK)
      status = lab_report_file(folder, files[i].name, files[i].write, &(lab_sources){report, figures}, error);
  }
  if (status == LAB_OK && extent >= LAB_WRITE_PLAIN)
    status = lab_figures_draw(extent >= LAB_WRITE_DRAWN ? figures : NULL, folder, extent == LAB_WRITE_FIGURES, error);
  lab_figures_free(figures);
  return status;
}

int lab_answer_write(const lab_answer *answer, const char *folder, int extent, lab_error *error)
{
  int status;
  lab_interrupt_hold();
  status = write_files(&answer->report, folder, extent, error);
  lab_interrupt_release();
  return status;
}

static void path_in(const char *folder, const char *name, char path[LAB_PATH_TEXT + 32])
{
  snprintf(path, LAB_PATH_TEXT + 32, "%s/%s", folder, name);
}

void lab_answer_remove(const char *folder)
{
  char path[LAB_PATH_TEXT + 32];
  lab_error error;
  size_t i;
  for (i = 0; i < sizeof files / sizeof *files; i++) {
    path_in(folder, files[i].name, path);
    remove(path);
  }
  lab_figures_draw(NULL, folder, 0, &error);
}

int lab_answer_is_there(const char *folder, int extent)
{
  char path[LAB_PATH_TEXT + 32];
  size_t i;
  for (i = 0; i < sizeof files / sizeof *files; i++) {
    path_in(folder, files[i].name, path);
    if (files[i].extent <= extent && access(path, R_OK))
      return 0;
  }
  return 1;
}

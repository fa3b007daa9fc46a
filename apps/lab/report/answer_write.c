/* An answer as files in a folder. */
#include <stdio.h>
#include <unistd.h>

#include "answer.h"
#include "report_html.h"
#include "../base/interrupt.h"
#include "../base/outfile.h"

/* The page and the drawings of the same figures, and the rows behind them. */
static int write_rows(const lab_report *report, const char *folder, int extent, lab_error *error)
{
  lab_residual_table table;
  lab_figures *figures = NULL;
  int status = lab_residual_table_collect(report, &table, error);
  if (status == LAB_OK)
    status = lab_report_residual(report, &table, folder, error);
  if (status == LAB_OK)
    status = lab_figures_make(report, &table, &figures, error);
  if (status == LAB_OK)
    status = lab_report_html(report, &table, figures, folder, error);
  if (status == LAB_OK)
    status = lab_figures_draw(extent >= LAB_WRITE_DRAWN ? figures : NULL, folder, extent == LAB_WRITE_FIGURES, error);
  lab_figures_free(figures);
  lab_residual_table_free(&table);
  return status;
}

static int write_files(const lab_report *report, const char *folder, int extent, lab_error *error)
{
  if (lab_make_folder(folder, error))
    return error->status;
  if (extent >= LAB_WRITE_PLAIN &&
      (lab_report_model(report, folder, error) || lab_report_header(report, folder, error) ||
       lab_report_catalogue(report, folder, error)))
    return error->status;
  if (lab_report_json(report, folder, error))
    return error->status;
  return extent >= LAB_WRITE_PLAIN ? write_rows(report, folder, extent, error) : LAB_OK;
}

int lab_answer_write(const lab_answer *answer, const char *folder, int extent, lab_error *error)
{
  int status;
  lab_interrupt_hold();
  status = write_files(&answer->report, folder, extent, error);
  lab_interrupt_release();
  return status;
}

/* Files of an answer, and the extent from which on each is always there. */
static const struct {
  const char *name;
  int extent;
} files[] = {{"report.json", LAB_WRITE_JSON},     {"report.html", LAB_WRITE_PLAIN},   {"model.cfg", LAB_WRITE_PLAIN},
             {"model.h", LAB_WRITE_PLAIN},        {"effects.def", LAB_WRITE_PLAIN},   {"residual.csv", LAB_WRITE_PLAIN},
             {"response.svg", LAB_WRITE_FIGURES}, {"residual.svg", LAB_WRITE_FIGURES}};

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

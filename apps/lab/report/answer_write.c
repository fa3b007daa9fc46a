/* An answer as files in a folder. */
#include <stdio.h>
#include <unistd.h>

#include "answer.h"
#include "report_html.h"
#include "../base/interrupt.h"
#include "../base/outfile.h"

/* Figures, if wanted, and the page around them. */
static int write_page(const lab_story *story, const char *folder, int with_figures, lab_error *error)
{
  lab_evidence evidence;
  lab_figures figures = {0};
  int status = lab_evidence_collect(story, &evidence, error);
  if (status == LAB_OK && with_figures)
    status = lab_figures_draw(story, &evidence, &figures, error);
  if (status == LAB_OK)
    status = lab_figures_write(&figures, folder, error);
  if (status == LAB_OK)
    status = lab_report_html(story, &evidence, &figures, folder, error);
  lab_figures_free(&figures);
  lab_evidence_free(&evidence);
  return status;
}

static int write_files(const lab_story *story, const char *folder, int extent, lab_error *error)
{
  if (lab_make_folder(folder, error))
    return error->status;
  if (extent >= LAB_WRITE_PLAIN && (lab_story_residual(story, folder, error) || lab_story_model(story, folder, error) ||
                                    lab_story_header(story, folder, error)))
    return error->status;
  if (lab_story_json(story, folder, error))
    return error->status;
  return extent >= LAB_WRITE_PLAIN ? write_page(story, folder, extent == LAB_WRITE_FIGURES, error) : LAB_OK;
}

int lab_answer_write(const lab_answer *answer, const char *folder, int extent, lab_error *error)
{
  int status;
  lab_interrupt_hold();
  status = write_files(&answer->story, folder, extent, error);
  lab_interrupt_release();
  return status;
}

/* Files of an answer, and the extent from which on each is always there. */
static const struct {
  const char *name;
  int extent;
} files[] = {{"report.json", LAB_WRITE_JSON},    {"report.html", LAB_WRITE_PLAIN},  {"model.cfg", LAB_WRITE_PLAIN},
             {"model.h", LAB_WRITE_PLAIN},       {"residual.csv", LAB_WRITE_PLAIN}, {"response.svg", LAB_WRITE_FIGURES},
             {"residual.svg", LAB_WRITE_FIGURES}};
static const char *const sometimes[] = {"arguments.svg", "autocorrelation.svg", "candidates.svg", "parameters.svg",
                                        "unlisted.svg"};

static void path_in(const char *folder, const char *name, char path[LAB_PATH_TEXT + 32])
{
  snprintf(path, LAB_PATH_TEXT + 32, "%s/%s", folder, name);
}

void lab_answer_remove(const char *folder)
{
  char path[LAB_PATH_TEXT + 32];
  size_t i;
  for (i = 0; i < sizeof files / sizeof *files; i++) {
    path_in(folder, files[i].name, path);
    remove(path);
  }
  for (i = 0; i < sizeof sometimes / sizeof *sometimes; i++) {
    path_in(folder, sometimes[i], path);
    remove(path);
  }
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

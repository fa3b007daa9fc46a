#include "api.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/clock.h"
#include "../check/mend.h"
#include "../report/answer.h"
#include "../report/figures.h"
#include "../rig/draft.h"
#include "../run/simulation.h"
#include "../trace/decide.h"

enum { GIVEN = 1 + 3 * LAB_LOGS_MAX };

/* In: status  of whoever wrote  Out: text; NULL after an error  Returns: status, LAB_WORLD */
static int end(lab_writing *w, int status, char **text, lab_error *error)
{
  *text = lab_writing_end(w);
  if (status == LAB_OK)
    return *text ? LAB_OK : lab_fail_memory(error, "a text");
  free(*text);
  *text = NULL;
  return status;
}

static int begin(lab_writing *w, lab_error *error)
{
  return lab_writing_begin(w) ? LAB_OK : lab_fail_memory(error, "a text");
}

void lab_api_free(char *text)
{
  free(text);
}

const char *lab_api_version(void)
{
  return PNEU_VERSION;
}

/* ---- closeloop ---- */

/* The texts of one call. */
typedef struct texts {
  lab_text_given of[GIVEN];
  int n;
} texts;

/* Add texts, and their names to a list.  Returns: LAB_OK, LAB_USAGE for two of one name */
static int give(texts *all, const lab_text_given *text, int n, const char **name, lab_error *error)
{
  int i, k;
  for (i = 0; i < n; i++) {
    for (k = 0; k < all->n; k++)
      if (strcmp(all->of[k].name, text[i].name) == 0 && all->of[k].data != text[i].data)
        return lab_fail(error, LAB_USAGE, "two texts have the name \"%s\"", text[i].name);
    all->of[all->n++] = text[i];
    name[i] = text[i].name;
  }
  return LAB_OK;
}

/* A rig file may take in others, which lie on a disk. */
static int check_rig(const lab_text_given *rig, lab_error *error)
{
  static const char word[] = "@include";
  const char *at = rig->data;
  size_t i;
  for (i = 0; i + sizeof word <= rig->size + 1; i++)
    if (memcmp(at + i, word, sizeof word - 1) == 0)
      return lab_fail(error, LAB_DATA, "%s: @include reads a file; put the text of that file in its place", rig->name);
  return LAB_OK;
}

static int check_request(const lab_api_request *r, lab_error *error)
{
  const int n[] = {r->n_logs, r->n_holdout, r->n_baseline};
  size_t i;
  for (i = 0; i < sizeof n / sizeof n[0]; i++)
    if (n[i] < (i == 0) || n[i] > LAB_LOGS_MAX)
      return lab_fail(error, LAB_USAGE, "expected %d to %d %s, found %d", i == 0, (int)LAB_LOGS_MAX,
                      (const char *const[]){"logs", "held-out logs", "logs of the baseline"}[i], n[i]);
  if (!(r->alpha >= 0 && r->alpha <= 0.5))
    return lab_fail(error, LAB_USAGE, "alpha: expected 0 to 0.5, found %g", r->alpha);
  if (!(r->min_gain >= 0 && r->min_gain < 1))
    return lab_fail(error, LAB_USAGE, "min_gain: expected 0 to 1, found %g", r->min_gain);
  return r->budget >= 0 ? LAB_OK : lab_fail(error, LAB_USAGE, "budget: expected seconds, found %g", r->budget);
}

static int write_answer(const lab_report *report, lab_api_answer *answer, lab_error *error)
{
  const struct {
    lab_report_writer *write;
    char **text;
  } all[] = {{lab_report_json, &answer->json},
             {lab_report_html, &answer->html},
             {lab_report_model, &answer->model},
             {lab_report_residual, &answer->residual}};
  lab_figures *figures;
  lab_writing w;
  size_t i;
  int status = lab_figures_make(report, &figures, error);
  for (i = 0; i < sizeof all / sizeof all[0] && status == LAB_OK; i++)
    if ((status = begin(&w, error)) == LAB_OK)
      status = end(&w, all[i].write(w.file, &(lab_sources){report, figures}, error), all[i].text, error);
  if (status == LAB_OK && !(answer->sentence = malloc(LAB_SENTENCE_TEXT)))
    status = lab_fail_memory(error, "a text");
  if (status == LAB_OK)
    lab_report_sentence(report, answer->sentence);
  lab_figures_free(figures);
  return status;
}

static int find_answer(const lab_request *q, lab_api_answer *answer, lab_error *error)
{
  lab_answer *found;
  int status = lab_answer_find(q, &found, error);
  if (lab_cpu_is_stopped())
    status = lab_fail(error, LAB_WORLD, "stopped, as was asked for");
  else if (status == LAB_OK)
    status = write_answer(&found->report, answer, error);
  if (found)
    lab_answer_free(found);
  return status;
}

int lab_api_closeloop(const lab_api_request *request, lab_api_answer *answer, lab_error *error)
{
  const char *log[LAB_LOGS_MAX], *holdout[LAB_LOGS_MAX], *baseline[LAB_LOGS_MAX], *rig[1];
  const lab_api_request *r = request;
  texts given = {.n = 0};
  lab_request q;
  int status;
  memset(answer, 0, sizeof *answer);
  if (check_request(r, error) || check_rig(&r->rig, error) || give(&given, &r->rig, 1, rig, error) ||
      give(&given, r->log, r->n_logs, log, error) || give(&given, r->holdout, r->n_holdout, holdout, error) ||
      give(&given, r->baseline, r->n_baseline, baseline, error))
    return error->status;
  q = (lab_request){.rig = rig[0],
                    .log = log,
                    .n_logs = r->n_logs,
                    .holdout = holdout,
                    .n_holdout = r->n_holdout,
                    .baseline = baseline,
                    .n_baseline = r->n_baseline,
                    .alpha = r->alpha > 0 ? r->alpha : lab_constant(LAB_ALPHA),
                    .min_gain = r->min_gain > 0 ? r->min_gain : lab_constant(LAB_MIN_GAIN),
                    .budget = r->budget > 0 ? r->budget : LAB_USUAL_BUDGET,
                    .on_progress = r->on_progress,
                    .context = r->context};
  lab_cpu_stop(0);
  lab_text_give(given.of, given.n);
  status = find_answer(&q, answer, error);
  lab_text_give(NULL, 0);
  if (status != LAB_OK)
    lab_api_free_answer(answer);
  return status;
}

void lab_api_free_answer(lab_api_answer *answer)
{
  free(answer->sentence);
  free(answer->json);
  free(answer->html);
  free(answer->model);
  free(answer->residual);
  memset(answer, 0, sizeof *answer);
}

void lab_api_stop(void)
{
  lab_cpu_stop(1);
}

/* ---- simulate ---- */

static int simulate(const char *rig_name, const char *log_name, FILE *file, lab_error *error)
{
  lab_limitations unsaid = {0};
  lab_rig rig;
  lab_log log;
  pneu_model model;
  int status;
  if (lab_rig_read(rig_name, &rig, error) || lab_rig_model(&rig, &model, error))
    return error->status;
  if (!log_name)
    return lab_simulation_write_standard(&model, file, error);
  if (lab_log_read(log_name, &rig.log, (double)rig.params.ambient_pressure, &log, error))
    return error->status;
  status = lab_log_smooth_inputs(&rig, &log, &unsaid, error);
  if (status == LAB_OK)
    status = lab_simulation_write(&model, &rig, &log, file, error);
  lab_log_free(&log);
  return status;
}

int lab_api_simulate(const lab_text_given *rig, const lab_text_given *log, char **csv, lab_error *error)
{
  const lab_text_given given[] = {*rig, log ? *log : *rig};
  lab_writing w;
  int status;
  *csv = NULL;
  if (check_rig(rig, error) || begin(&w, error))
    return error->status;
  lab_text_give(given, 2);
  status = simulate(rig->name, log ? log->name : NULL, w.file, error);
  lab_text_give(NULL, 0);
  return end(&w, status, csv, error);
}

/* ---- The draft ---- */

int lab_api_draft(const lab_text_given *log, const char *const *sheet, int n, char **rig, lab_error *error)
{
  lab_writing w;
  int status;
  *rig = NULL;
  if (begin(&w, error))
    return error->status;
  lab_text_give(log, 1);
  status = lab_draft_write(w.file, log->name, sheet, n, error);
  lab_text_give(NULL, 0);
  return end(&w, status, rig, error);
}

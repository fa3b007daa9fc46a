#include "plausible.h"

#include <stdio.h>

#include "logscene.h"
#include "../base/text.h"

enum severity { WRONG, LIMIT, DOUBT };
enum { VALUES_EACH = 7 }; /* measured values for each unknown, below which nothing is named */

/* In this order: the first that is WRONG ends it, and a slip of units should be called one. */
static const struct check {
  const char *name;
  int (*find)(const lab_scene *, lab_finding *);
  int severity;
} checks[] = {
    {"pressure range", lab_check_pressure_range, WRONG},
    {"vacuum", lab_check_vacuum, WRONG},
    {"position range", lab_check_position_range, WRONG},
    {"temperature", lab_check_temperature, WRONG},
    {"dead channel", lab_check_dead, WRONG},
    {"opposite position", lab_check_opposite, WRONG},
    {"balance of forces", lab_check_balance, WRONG},
    {"reach", lab_check_reach, WRONG},
    {"settled level", lab_check_settled, WRONG},
    {"early", lab_check_early, WRONG},
    {"command", lab_check_command, WRONG},
    {"pace", lab_check_pace, WRONG},
    {"early starts", lab_check_starts, WRONG},
    {"alike", lab_check_alike, WRONG},
    {"late", lab_check_late, DOUBT},
    {"one-sided command", lab_check_one_sided, DOUBT},
    {"absolute pressure", lab_check_absolute, DOUBT},
    {"steps", lab_check_steps, LIMIT},
    {"noise", lab_check_noise, LIMIT},
    {"jump in time", lab_check_jump, LIMIT},
    {"part of the stroke", lab_check_part, LIMIT},
    {"measured and not used", lab_check_unused, LIMIT},
};

/* "log.csv:12", "log.csv", or "log.csv, run 3" */
static void place(const lab_scene *s, const lab_finding *f, const char *file, char *text, size_t size)
{
  int used = snprintf(text, size, "%s", file);
  if (f->has_row && used > 0 && (size_t)used < size)
    snprintf(text + used, size - (size_t)used, ":%d", s->log->line[s->first + f->row]);
  else if (s->log->n_runs > 1 && used > 0 && (size_t)used < size)
    snprintf(text + used, size - (size_t)used, ", run %zu", s->run + 1);
}

static int check_run(const lab_scene *s, lab_remarks *remarks, lab_error *error)
{
  size_t i;
  for (i = 0; i < sizeof checks / sizeof checks[0]; i++) {
    lab_finding f;
    char where[LAB_PATH_TEXT];
    if (!checks[i].find(s, &f))
      continue;
    place(s, &f, checks[i].severity == WRONG ? s->log->path : lab_file_name(s->log->path), where, sizeof where);
    if (checks[i].severity == WRONG)
      return lab_fail(error, LAB_DATA, "%s: %s", where, f.text);
    if (checks[i].severity == DOUBT)
      lab_remark_doubt(remarks, "%s: %s.", where, f.text);
    else
      lab_remark(remarks, "%s: %s.", where, f.text);
  }
  return LAB_OK;
}

/* Whether a fit has something to compare with a channel; a force only where it holds a driven stem. */
static int is_compared(const lab_scene *s, int channel)
{
  return lab_scene_predicts(s, channel) ||
         (channel == LAB_CHANNEL_FORCE && s->y[channel] && !s->rig->input[channel] && s->rig->laws.position_input);
}

static size_t count_values(const lab_scene *s)
{
  size_t i, n = 0;
  int c;
  for (c = LAB_CHANNEL_P; c < LAB_CHANNEL_COUNT; c++)
    for (i = 0; is_compared(s, c) && i < s->n; i++)
      n += s->y[c][i] == s->y[c][i];
  return n;
}

int lab_plausible(const lab_rig *rig, const lab_log *log, lab_remarks *remarks, lab_content *content, lab_error *error)
{
  size_t run;
  for (run = 0; run < log->n_runs; run++) {
    lab_scene scene;
    int status = lab_scene_open(rig, log, run, &scene, error);
    if (status == LAB_OK) {
      content->runs++;
      content->still += lab_scene_is_still(&scene);
      content->values += count_values(&scene);
      if (scene.n >= LAB_SCENE_FEWEST)
        status = check_run(&scene, remarks, error);
    }
    lab_scene_close(&scene);
    if (status != LAB_OK)
      return status;
  }
  return LAB_OK;
}

int lab_plausible_content(const lab_rig *rig, const lab_content *content, lab_remarks *remarks, lab_error *error)
{
  const size_t unknowns = rig->n_fit > 0 ? (size_t)rig->n_fit : 1;
  if (content->values <= unknowns)
    return lab_fail(error, LAB_DATA, "the log is too short: %zu measured values for %zu unknowns determine nothing",
                    content->values, unknowns);
  if (content->runs > 0 && content->still == content->runs)
    return lab_fail(
        error, LAB_DATA,
        "nothing moves by more than the noise in any log: they determine nothing; record at least a fill and "
        "a vent");
  if (content->values < VALUES_EACH * unknowns)
    lab_remark_doubt(remarks, "the log is short: %zu measured values for %zu unknowns are too few to name an effect.",
                     content->values, unknowns);
  return LAB_OK;
}

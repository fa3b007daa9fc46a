/* What the page's worker calls: texts are given one by one, then closeloop or the draft is asked for, then its answers
 * are read. A worker does one thing and ends, so that nothing is freed here. SPDX-License-Identifier: MIT */
#include <emscripten.h>
#include <stddef.h>

#include "../lab/api/api.h"
#include "../lab/check/logs.h"

/* What a text is for. */
enum { RIG, LOG, HOLDOUT, BASELINE, ROLES };
enum { SHEET_MAX = 64 };

/* A browser has no clock of CPU time: this is time on the clock, and three times what closeloop has. */
static const double budget = 180; /* [s] */

/* Texts by role, and the answers: sentence, report.json, report.html, model.cfg, residual.csv; a draft; a prediction.
 */
static lab_text_given given[ROLES][LAB_LOGS_MAX];
static int n_given[ROLES];
static const char *sheet[SHEET_MAX];
static int n_sheet;
static lab_api_answer answer;
static char *draft, *prediction;
static lab_error error;

/* Tell the page what is being done. */
EM_JS(void, web_progress, (const char *what), { self.postMessage({kind : "progress", text : UTF8ToString(what)}); })

static void progress(void *context, const char *what)
{
  (void)context;
  web_progress(what);
}

/* Take a text, name and data, which stay where they are.
 * In:      role  RIG to BASELINE; size  of the data [byte]
 * Returns: LAB_OK, LAB_USAGE for too many */
EMSCRIPTEN_KEEPALIVE int web_give(int role, const char *name, const char *data, int size)
{
  if (n_given[role] == LAB_LOGS_MAX)
    return lab_fail(&error, LAB_USAGE, "expected at most %d files of one kind", (int)LAB_LOGS_MAX);
  given[role][n_given[role]++] = (lab_text_given){name, data, (size_t)size};
  return LAB_OK;
}

/* Take "key=value" of a data sheet, which stays where it is.  Returns: LAB_OK, LAB_USAGE for too many */
EMSCRIPTEN_KEEPALIVE int web_say(const char *word)
{
  if (n_sheet == SHEET_MAX)
    return lab_fail(&error, LAB_USAGE, "expected at most %d words of a data sheet", (int)SHEET_MAX);
  sheet[n_sheet++] = word;
  return LAB_OK;
}

/* Each returns as its function of lab_api does; web_error has the sentence. */
EMSCRIPTEN_KEEPALIVE int web_closeloop(void)
{
  const lab_api_request request = {.rig = given[RIG][0],
                                   .log = given[LOG],
                                   .holdout = given[HOLDOUT],
                                   .baseline = given[BASELINE],
                                   .n_logs = n_given[LOG],
                                   .n_holdout = n_given[HOLDOUT],
                                   .n_baseline = n_given[BASELINE],
                                   .budget = budget,
                                   .on_progress = progress};
  return lab_api_closeloop(&request, &answer, &error);
}

EMSCRIPTEN_KEEPALIVE int web_draft(void)
{
  return lab_api_draft(&given[LOG][0], sheet, n_sheet, &draft, &error);
}

/* What the rig file predicts at the rows of the first log. */
EMSCRIPTEN_KEEPALIVE int web_simulate(void)
{
  return lab_api_simulate(&given[RIG][0], &given[LOG][0], &prediction, &error);
}

/* In: which  0..6 in the order above  Returns: NULL where there is none */
EMSCRIPTEN_KEEPALIVE const char *web_answer(int which)
{
  const char *const all[] = {answer.sentence, answer.json, answer.html, answer.model,
                             answer.residual, draft,       prediction};
  return which >= 0 && which < (int)(sizeof all / sizeof all[0]) ? all[which] : NULL;
}

EMSCRIPTEN_KEEPALIVE const char *web_error(void)
{
  return error.text;
}

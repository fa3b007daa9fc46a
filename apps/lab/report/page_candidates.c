/* Whether what is left is white, and which effects the residual of the declared model asks for. */
#include <math.h>

#include "../base/quantile.h"
#include "../base/shown.h"
#include "page_private.h"

void page_whiteness(const telling *t, cJSON *page)
{
  cJSON *list = cJSON_AddArrayToObject(page, "whiteness");
  int c;
  for (c = 0; c < t->evidence->n_channels; c++) {
    const lab_evidence_channel *mine = &t->evidence->channel[c];
    const lab_whiteness *after = &mine->whiteness[LAB_STAGE_AFTER];
    const int white = after->p_value >= page_white_level;
    cJSON *item = page_append(list);
    page_put(item, "channel", "%s %s", lab_channels[mine->channel].quantity, lab_channels[mine->channel].key);
    page_put(item, "before", "%.3f", mine->whiteness[LAB_STAGE_BEFORE].correlation[1]);
    if (page_has_completed(t))
      page_put(item, "after", "%.3f", after->correlation[1]);
    page_put_number(item, "q", after->statistic, 3);
    page_put(item, "lags", "%d", after->degrees);
    page_put_p(item, "p_value", after->p_value);
    page_put(item, "mood", "%s", white ? "good" : "bad");
    page_put(item, "words", "%s", isnan(after->p_value) ? "too few values" : white ? "white" : "not white");
  }
}

void page_candidates(const telling *t, cJSON *page)
{
  const lab_trace_result *trace = &t->story->result->trace;
  cJSON *list = cJSON_AddArrayToObject(page, "candidates");
  char threshold[LAB_SHOWN_TEXT];
  int i;
  for (i = 0; i < trace->n; i++) {
    const lab_candidate *c = &trace->candidate[i];
    pneu_param_info info;
    cJSON *item = page_append(list);
    pneu_param_describe(c->param, &info);
    page_put(item, "effect", "%s", page_effect_name(c->effect));
    page_put(item, "parameter", "%s", info.name);
    page_put_number(item, "statistic", c->statistic, 3);
    page_put_p(item, "p_value", c->p_value);
    page_put_share(item, "explained", c->explained);
    page_put_number(item, "visible", c->visible, 2);
  }
  page_put(page, "tried", "%d effects and parameters, %d slopes in all; the threshold is %s", trace->n, trace->tests,
           t->story->result->level > 0 ? lab_shown_number(lab_chi2_threshold(t->story->result->level), 3, threshold)
                                       : "-");
}

/* Whether what is left is white, and which effects the residual of the declared model asks for. */
#include <math.h>

#include "../base/quantile.h"
#include "../base/format.h"
#include "page_private.h"

void lab_page_whiteness(const lab_sources *t, cJSON *page)
{
  cJSON *list = cJSON_AddArrayToObject(page, "whiteness");
  const lab_search_result *r = t->report->result;
  int c;
  for (c = 0; c < t->table->n_channels; c++) {
    const lab_residual_channel *mine = &t->table->channel[c];
    const lab_whiteness *before = &r->left[LAB_STAGE_BEFORE][mine->channel].whiteness;
    const lab_whiteness *after = &r->left[LAB_STAGE_AFTER][mine->channel].whiteness;
    const int white = lab_is_white(after);
    cJSON *item = lab_json_append(list);
    lab_json_put(item, "channel", "%s %s", lab_channels[mine->channel].quantity, lab_channels[mine->channel].key);
    lab_json_put(item, "before", "%.3f", before->correlation[1]);
    if (lab_page_has_completed(t))
      lab_json_put(item, "after", "%.3f", after->correlation[1]);
    lab_page_put_number(item, "q", after->statistic, 3);
    lab_json_put(item, "lags", "%d", after->degrees);
    lab_page_put_p(item, "p_value", after->p_value);
    lab_json_put(item, "mood", "%s", white ? "good" : "bad");
    lab_json_put(item, "words", "%s", isnan(after->p_value) ? "too few values" : white ? "white" : "not white");
  }
}

/* The bar of a statistic: how long, in per cent on a scale of logarithms, and what became of its effect. */
static void put_bar(const lab_sources *t, const lab_score *c, double threshold, cJSON *item)
{
  const lab_search_result *result = t->report->result;
  const double least = 0.5, most = fmax(threshold, result->scores.of[0].statistic);
  int i, found = 0;
  for (i = 0; i < result->n_found; i++)
    found |= result->found[i].effect == c->effect;
  lab_json_put(item, "mood", "%s", found ? "after" : c->statistic > threshold ? "passes" : "fails");
  lab_json_put(item, "share", "%.0f", c->statistic > least ? 100 * log(c->statistic / least) / log(most / least) : 0);
}

static void put_refit(double explained, cJSON *item)
{
  if (isnan(explained))
    lab_json_put(item, "explained", "-");
  else
    lab_page_put_share(item, "explained", explained);
}

void lab_page_candidates(const lab_sources *t, cJSON *page)
{
  const lab_scores *scores = &t->report->result->scores;
  cJSON *list = cJSON_AddArrayToObject(page, "candidates");
  const double threshold = t->report->result->level > 0 ? lab_chi2_threshold(t->report->result->level) : (double)NAN;
  char text[LAB_FORMAT_TEXT];
  int i;
  for (i = 0; i < scores->n; i++) {
    const lab_score *c = &scores->of[i];
    pneu_param_info info;
    cJSON *item = lab_json_append(list);
    pneu_param_describe(c->param, &info);
    lab_json_put(item, "effect", "%s", lab_page_effect_name(c->effect));
    lab_json_put(item, "parameter", "%s", info.name);
    lab_page_put_number(item, "statistic", c->statistic, 3);
    lab_page_put_p(item, "p_value", c->p_value);
    put_refit(lab_report_refit_explains(t->report->result, c), item);
    lab_page_put_share(item, "by_slope", c->explained);
    lab_page_put_number(item, "visible", c->visible, 2);
    put_bar(t, c, threshold, item);
  }
  lab_json_put(page, "tried", "%d effects and parameters, %d slopes in all; the threshold is %s", scores->n,
               scores->tests, lab_format_number(threshold, 3, text));
}

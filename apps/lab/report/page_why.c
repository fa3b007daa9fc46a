/* Why: what was found and how sure it is; or why nothing was added, or nothing more. */
#include <string.h>

#include "../base/quantile.h"
#include "../base/format.h"
#include "../trace/freeterms.h"
#include "page_private.h"

/* All parameters of an effect that were fitted. */
static void put_sizes(const lab_sources *t, int effect, cJSON *list)
{
  int i, count, first = pneu_effect_params(effect, &count);
  for (i = first; i < first + count; i++)
    lab_page_put_size(t, i, list);
}

static void put_sentence(const lab_sources *t, const lab_found *found, cJSON *item)
{
  char sentence[LAB_FOUND_SENTENCE];
  lab_report_found_sentence(t->report, found, sentence);
  lab_json_put(item, "sentence", "%s", sentence);
}

/* How much it explains, and how far that is from chance. */
static void put_strength(const lab_sources *t, const lab_found *found, cJSON *item)
{
  lab_page_put_share(item, "explained", found->explained);
  lab_page_put_number(item, "statistic", found->statistic, 3);
  if (found->effect >= 0) /* that of a free term depends on its values */
    lab_page_put_number(item, "threshold", lab_chi2_threshold(t->report->result->level), 3);
  lab_page_put_p(item, "p_value", lab_report_chance(t->report, found));
}

/* What was found and has no name. */
static void put_unlisted(const lab_sources *t, const lab_found *found, cJSON *list)
{
  const pneu_term *term = &t->report->completed->rig.term[found->term];
  char where[LAB_WHERE_TEXT];
  cJSON *item = lab_json_append(list);
  lab_json_put(item, "name", "Not in the catalogue");
  put_sentence(t, found, item);
  lab_json_put(item, "footprint", "%s", lab_free_term_where(term, where));
  lab_json_put(item, "source", "A free term was added; its values are in model.cfg.");
  lab_json_put(item, "equation", "%s", lab_free_term_equation(term));
  cJSON_AddArrayToObject(item, "sizes");
  put_strength(t, found, item);
}

static void put_found(const lab_sources *t, const lab_found *found, cJSON *list)
{
  static const struct {
    const char *key, *words;
  } equations[] = {{"mass", "balance of mass in the chamber"},
                   {"energy", "balance of energy in the chamber"},
                   {"force", "balance of forces on the stem"},
                   {"command", "from the command to the opening"},
                   {"sensor", "reading of a sensor"}};
  const pneu_effect *effect = pneu_effect_at(found->effect);
  cJSON *item = lab_json_append(list);
  size_t i;
  lab_json_put(item, "code", "%s", effect->name);
  put_sentence(t, found, item);
  lab_json_put(item, "footprint", "%s", effect->footprint);
  lab_json_put(item, "source", "%s", effect->source);
  for (i = 0; i < sizeof equations / sizeof *equations; i++)
    if (!strcmp(equations[i].key, effect->equation))
      lab_json_put(item, "equation", "%s: %s", effect->equation, equations[i].words);
  put_sizes(t, found->effect, cJSON_AddArrayToObject(item, "sizes"));
  put_strength(t, found, item);
}

/* Why nothing was added, or nothing more. */
static void put_reasons(const lab_sources *t, cJSON *list)
{
  const lab_search_result *r = t->report->result;
  char statistic[LAB_FORMAT_TEXT], threshold[LAB_FORMAT_TEXT], where[LAB_WHERE_TEXT];
  int i;
  if (r->n_found == 0 && r->n_listed == 0 && r->scores.n > 0 && r->level > 0)
    lab_json_say(list, "The effect with the highest score is %s: %s. Above %s it would be significant.",
                 lab_page_effect_name(r->scores.of[0].effect),
                 lab_format_number(r->scores.of[0].statistic, 3, statistic),
                 lab_format_number(lab_chi2_threshold(r->level), 3, threshold));
  for (i = 0; i < r->n_listed; i++)
    lab_json_say(list,
                 "The effect %s is significant, but would lower the error by less than --min-gain. It was not added.",
                 lab_page_effect_name(r->listed[i]));
  if (r->has_small)
    lab_json_say(
        list,
        "A free term that acts like %s (%s) is significant, but would lower the error by less than --min-gain. "
        "It was not added.",
        lab_free_term_what(&r->small), lab_free_term_where(&r->small, where));
  if (r->verdict == LAB_VERDICT_UNDECIDED)
    lab_json_say(
        list, "The residual is not noise, and no effect of the catalogue explains it. The figures below show when and "
              "where it arises.");
}

void lab_page_why(const lab_sources *t, cJSON *page)
{
  const lab_search_result *r = t->report->result;
  cJSON *list = cJSON_AddArrayToObject(page, "found");
  int i;
  for (i = 0; i < r->n_found; i++)
    (r->found[i].effect < 0 ? put_unlisted : put_found)(t, &r->found[i], list);
  put_reasons(t, cJSON_AddArrayToObject(page, "reasons"));
}

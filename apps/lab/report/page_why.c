/* Why: what was found and how sure it is; or why nothing was added, or nothing more. */
#include <string.h>

#include "../base/quantile.h"
#include "../base/shown.h"
#include "../trace/unlisted.h"
#include "page_private.h"

/* All parameters of an effect that were fitted. */
static void put_sizes(const telling *t, int effect, cJSON *list)
{
  const lab_unknowns *u = t->story->completed;
  int i, count, first = pneu_effect_params(effect, &count);
  for (i = first; i < first + count; i++) {
    const int j = lab_unknowns_find(u, i);
    pneu_param_info info;
    cJSON *item;
    if (j < 0)
      continue;
    pneu_param_describe(i, &info);
    item = page_append(list);
    page_put(item, "meaning", "%s", info.meaning);
    page_put_quantity(item, "value", u->unknown[j].value, page_unit(&u->unknown[j]), page_digits(t, j));
    page_put_interval(t, j, item);
  }
}

/* What was found and has no name. */
static void put_unlisted(const telling *t, const lab_found *found, cJSON *list)
{
  const pneu_term *term = &t->story->completed->rig.term[found->term];
  char where[LAB_WHERE_TEXT];
  cJSON *item = page_append(list);
  page_put(item, "name", "Not in the catalogue");
  page_put(item, "what", "Something acts like %s: %s.", lab_unlisted_what(term), lab_unlisted_where(term, where));
  page_put(item, "footprint", "%s", lab_unlisted_where(term, where));
  page_put(item, "source", "a free term; its values are in model.cfg");
  page_put(item, "equation", "%s", lab_unlisted_equation(term));
  cJSON_AddArrayToObject(item, "sizes");
  page_put_share(item, "explained", found->explained);
  page_put_number(item, "statistic", found->statistic, 3);
  page_put_number(item, "threshold", lab_chi2_threshold(t->story->result->level), 3);
  page_put_p(item, "p_value", lab_chi2_tail(found->statistic, found->degrees));
}

static void put_found(const telling *t, const lab_found *found, cJSON *list)
{
  static const struct {
    const char *key, *words;
  } equations[] = {{"mass", "balance of mass in the chamber"},
                   {"energy", "balance of energy in the chamber"},
                   {"force", "balance of forces on the stem"},
                   {"command", "from the command to the opening"},
                   {"sensor", "what a sensor shows"}};
  const pneu_effect *effect = pneu_effect_at(found->effect);
  cJSON *item = page_append(list);
  size_t i;
  page_put(item, "name", "%s", effect->name);
  page_put(item, "what", "%s", effect->what);
  page_put(item, "footprint", "%s", effect->footprint);
  page_put(item, "source", "%s", effect->source);
  for (i = 0; i < sizeof equations / sizeof *equations; i++)
    if (!strcmp(equations[i].key, effect->equation))
      page_put(item, "equation", "%s: %s", effect->equation, equations[i].words);
  put_sizes(t, found->effect, cJSON_AddArrayToObject(item, "sizes"));
  page_put_share(item, "explained", found->explained);
  page_put_number(item, "statistic", found->statistic, 3);
  page_put_number(item, "threshold", lab_chi2_threshold(t->story->result->level), 3);
  page_put_p(item, "p_value", found->p_value);
}

/* Why nothing was added, or nothing more. */
static void put_reasons(const telling *t, cJSON *list)
{
  const lab_loop_result *r = t->story->result;
  char statistic[LAB_SHOWN_TEXT], threshold[LAB_SHOWN_TEXT], where[LAB_WHERE_TEXT];
  int i;
  if (r->n_found == 0 && r->n_listed == 0 && r->trace.n > 0 && r->level > 0)
    page_say(list, "Of all effects %s comes nearest, with a statistic of %s; it would take %s to be more than chance.",
             page_effect_name(r->trace.candidate[0].effect),
             lab_shown_number(r->trace.candidate[0].statistic, 3, statistic),
             lab_shown_number(lab_chi2_threshold(r->level), 3, threshold));
  for (i = 0; i < r->n_listed; i++)
    page_say(list,
             "%s is more than chance, but would lower the error by less than --min-gain asks for, and was not added.",
             page_effect_name(r->listed[i]));
  if (r->has_small)
    page_say(list,
             "Something without a name, like %s (%s), is more than chance, but would lower the error by less than "
             "--min-gain asks for, and was not added.",
             lab_unlisted_what(&r->small), lab_unlisted_where(&r->small, where));
  if (r->verdict == LAB_VERDICT_UNDECIDED)
    page_say(list,
             "What is left is not noise, and no effect of the catalogue explains it. The figures below show when and "
             "where it arises.");
}

void page_why(const telling *t, cJSON *page)
{
  const lab_loop_result *r = t->story->result;
  cJSON *list = cJSON_AddArrayToObject(page, "found");
  int i;
  for (i = 0; i < r->n_found; i++)
    (r->found[i].effect < 0 ? put_unlisted : put_found)(t, &r->found[i], list);
  put_reasons(t, cJSON_AddArrayToObject(page, "reasons"));
}

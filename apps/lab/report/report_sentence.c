/* The answer in one sentence. */
#include <math.h>
#include <stdio.h>

#include "../trace/unlisted.h"
#include "loopfiles.h"

/* "chamber_leak", "dry friction at x = 11 .. 13 mm, both directions" */
static void name_found(const lab_story *story, const lab_found *found, char *text, size_t size)
{
  char where[LAB_WHERE_TEXT];
  const pneu_term *term;
  if (found->effect >= 0) {
    snprintf(text, size, "%s", pneu_effect_at(found->effect)->name);
    return;
  }
  term = &story->completed->rig.term[found->term];
  snprintf(text, size, "something that has no name here (%s, %s)", lab_unlisted_what(term),
           lab_unlisted_where(term, where));
}

static const char *found_names(const lab_story *story, char *text, size_t size)
{
  const lab_loop_result *r = story->result;
  size_t used = 0;
  int i;
  for (i = 0; i < r->n_found && used < size; i++) {
    char name[LAB_WHERE_TEXT + 128];
    name_found(story, &r->found[i], name, sizeof name);
    used += (size_t)snprintf(text + used, size - used, "%s%s", i ? " and " : "", name);
  }
  return text;
}

/* "wall_temperature and 2 more are" */
static const char *listed_names(const lab_loop_result *r, char *text, size_t size)
{
  const char *first = r->n_listed ? pneu_effect_at(r->listed[0])->name : "something without a name";
  const int more = r->n_listed + r->has_small - 1;
  if (more > 0)
    snprintf(text, size, "%s and %d more are", first, more);
  else
    snprintf(text, size, "%s is", first);
  return text;
}

void lab_story_sentence(const lab_story *story, char *text, size_t size)
{
  const lab_loop_result *r = story->result;
  const double before = sqrt(r->before.chi2 / (double)r->before.n), after = sqrt(r->after.chi2 / (double)r->after.n);
  char names[512];
  if (story->remarks && story->remarks->doubt)
    snprintf(text, size, "Undecided: %s", story->remarks->text[story->remarks->doubt - 1]);
  else if (r->verdict == LAB_VERDICT_UNDECIDED && r->n_found)
    snprintf(text, size,
             "Undecided: %s comes nearest and lowers the error from %.2f to %.2f times the noise, but what is left is "
             "not noise.",
             found_names(story, names, sizeof names), before, after);
  else if (r->verdict == LAB_VERDICT_UNDECIDED)
    snprintf(text, size,
             "Undecided: what is left, %.2f times the noise, is not noise, and the catalogue does not explain it.",
             after);
  else if (r->window > 0)
    snprintf(text, size,
             "The model lacks %s: the stem sticks and slips, and with it the model does so as much as the log, though "
             "no model keeps in step with every slip.",
             found_names(story, names, sizeof names));
  else if (r->n_found > 0)
    snprintf(text, size, "The model lacks %s: with it the error falls from %.2f to %.2f times the noise.",
             found_names(story, names, sizeof names), before, after);
  else if (r->n_listed || r->has_small)
    snprintf(text, size,
             "Nothing worth adding: the declared model leaves %.2f times the noise; %s significant, but would lower "
             "that by less than --min-gain asks for.",
             before, listed_names(r, names, sizeof names));
  else
    snprintf(text, size, "Nothing is missing: the declared model leaves %.2f times the noise.", before);
}

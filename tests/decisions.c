/* The tables that the search decides by, in Markdown, from apps/lab/trace/decide.h.
 *   decisions rules|constants
 * SPDX-License-Identifier: MIT */
#include <stdio.h>
#include <string.h>

#include "../apps/lab/trace/decide.h"

static int rules(void)
{
  static const char *const phase[] = {
      [LAB_PHASE_SCORED] = "effects are scored",  [LAB_PHASE_LED] = "the leaders are refitted",
      [LAB_PHASE_REFITTED] = "they are refitted", [LAB_PHASE_ROUND] = "the round is over",
      [LAB_PHASE_END] = "all rounds are over",    [LAB_PHASE_VERDICT] = "verdict"};
  int i;
  puts("| asked when | if | then |\n|---|---|---|");
  for (i = 0; i < lab_rule_count; i++)
    printf("| %s | %s | %s |\n", phase[lab_rules[i].phase], lab_rules[i].when, lab_rules[i].then);
  return 0;
}

static int constants(void)
{
  int i;
  puts("| constant | value | what it is | how it was calibrated |\n|---|---|---|---|");
  for (i = 0; i < LAB_CONSTANT_COUNT; i++)
    printf("| %s | %g | %s | %s |\n", lab_constants[i].name, lab_constants[i].value, lab_constants[i].meaning,
           lab_constants[i].source);
  return 0;
}

int main(int argc, char **argv)
{
  if (argc == 2 && !strcmp(argv[1], "rules"))
    return rules();
  if (argc == 2 && !strcmp(argv[1], "constants"))
    return constants();
  return 2;
}

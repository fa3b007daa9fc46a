#include "reporttext.h"

#include <string.h>

#include "tableread.h"

int report_is_law(const table *t, size_t row, const char *gas, const char *flow)
{
  return !strcmp(table_text(t, row, "gas"), gas) && !strcmp(table_text(t, row, "flow"), flow);
}

void report_law_heads(const study *s, FILE *file)
{
  int g, f;
  for (g = 0; g < s->n_gas; g++)
    for (f = 0; f < s->n_flow; f++)
      fprintf(file, " %s, %s |", pneu_gas_key(s->gas[g]), pneu_flow_key(s->flow[f]));
  fputc('\n', file);
}

void report_rule(FILE *file, int columns)
{
  int i;
  fputc('|', file);
  for (i = 0; i < columns; i++)
    fputs("---|", file);
  fputc('\n', file);
}

void report_table_name(const study *s, int actuator, const char *stem, char *name)
{
  if (actuator == s->subject)
    snprintf(name, REPORT_NAME_TEXT, "%s.csv", stem);
  else
    snprintf(name, REPORT_NAME_TEXT, "%s_%s.csv", stem, s->actuator[actuator].name);
}

/* For each line "FROM<tab>TO" on stdin: how a value in the unit FROM becomes one in TO, as "scale offset", or "no".
 * Built twice, with UDUNITS-2 and with packaging/cross/units/. */
#include <stdio.h>
#include <string.h>

#include "../../apps/lab/base/units.h"

int main(void)
{
  char line[512];
  while (fgets(line, sizeof line, stdin)) {
    char *to = strchr(line, '\t');
    double scale, offset;
    lab_error error;
    if (!to)
      return 1;
    *to++ = '\0';
    to[strcspn(to, "\n")] = '\0';
    if (lab_unit_factor(line, to, &scale, &offset, &error) == LAB_OK)
      printf("%s\t%s\t%.17g %.17g\n", line, to, scale, offset);
    else
      printf("%s\t%s\tno\n", line, to);
  }
  return 0;
}

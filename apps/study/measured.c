#include "measured.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../lab/base/outfile.h"
#include "../lab/rig/rigkeys.h"
#include "../lab/base/text.h"

enum { PATH_BYTES = 1024 };

const char *measured_folder(void)
{
  const char *named = getenv("MEASURED");
  return named && *named ? named : "../shared/data";
}

int measured_join(const char *folder, const char *name, char *path, size_t size, lab_error *error)
{
  if ((size_t)snprintf(path, size, "%s/%s", folder, name) < size)
    return LAB_OK;
  return lab_fail(error, LAB_DATA, "path is too long: %s/%s", folder, name);
}

int measured_path(const char *folder, const char *name, char *path, size_t size, lab_error *error)
{
  if (measured_join(folder, name, path, size, error))
    return error->status;
  if (access(path, R_OK) == 0)
    return LAB_OK;
  fprintf(stderr, "absent: %s; study/measured/fetch.sh loads what can be had, MEASURED names its folder\n", path);
  return MEASURED_ABSENT;
}

int measured_effect_param(const char *effect, const char *param)
{
  const int e = lab_effect_index(effect);
  int i, count = 0, first = pneu_effect_params(e, &count);
  for (i = 0; e >= 0 && i < count; i++)
    if (!strcmp(pneu_effect_at(e)->param[i].name, param))
      return first + i;
  return -1;
}

int measured_save(const char *results_dir, const char *name, const table *t, lab_error *error)
{
  char path[PATH_BYTES];
  lab_outfile out;
  if (measured_join(results_dir, name, path, sizeof path, error) || lab_out_open(&out, path, error))
    return error->status;
  if (table_write(t, out.file, error)) {
    lab_out_abandon(&out);
    return error->status;
  }
  return lab_out_close(&out, error);
}

int measured_lines(const char *path, int (*take)(void *context, const char *text, lab_error *error), void *context,
                   lab_error *error)
{
  const char *begin, *end;
  lab_lines lines;
  lab_text text;
  int status = lab_text_read(path, &text, error);
  if (status != LAB_OK)
    return status;
  lab_lines_start(&lines, &text);
  lab_lines_next(&lines, &begin, &end); /* the header */
  while (status == LAB_OK && lab_lines_next(&lines, &begin, &end)) {
    char line[80];
    snprintf(line, sizeof line, "%.*s", (int)(end - begin), begin);
    status = take(context, line, error);
    if (status != LAB_OK)
      lab_fail_in(error, "%s:%d", path, lines.number);
  }
  lab_text_free(&text);
  return status;
}

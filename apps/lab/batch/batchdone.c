#include "batchdone.h"

#include <inttypes.h>
#include <string.h>

#include "../base/outfile.h"

static void path_in(const char *folder, char path[LAB_PATH_TEXT + 32])
{
  snprintf(path, LAB_PATH_TEXT + 32, "%s/.done", folder);
}

/* Two lines: numbers, and the row. The end of the second tells that it is whole. */
static int read_lines(FILE *file, lab_done *done)
{
  lab_cost *cost = &done->outcome.cost;
  char line[160];
  size_t length;
  if (!fgets(line, sizeof line, file) || sscanf(line, "%" SCNx64 " %d %d %lf %lf %lf", &done->key, &done->extent,
                                                &done->outcome.status, &cost->seconds, &cost->cpu, &cost->memory) != 6)
    return 0;
  if (!fgets(done->outcome.row, sizeof done->outcome.row, file))
    return 0;
  length = strlen(done->outcome.row);
  if (length == 0 || done->outcome.row[length - 1] != '\n')
    return 0;
  done->outcome.row[length - 1] = '\0';
  return 1;
}

int lab_done_read(const char *folder, lab_done *done)
{
  char path[LAB_PATH_TEXT + 32];
  FILE *file;
  int whole;
  path_in(folder, path);
  memset(done, 0, sizeof *done);
  file = fopen(path, "r");
  whole = file && read_lines(file, done);
  if (file)
    fclose(file);
  return whole;
}

int lab_done_write(const char *folder, const lab_done *done, lab_error *error)
{
  const lab_cost *cost = &done->outcome.cost;
  char path[LAB_PATH_TEXT + 32];
  lab_outfile out;
  path_in(folder, path);
  if (lab_out_open(&out, path, error))
    return error->status;
  fprintf(out.file, "%016" PRIx64 " %d %d %.3f %.3f %.1f\n%s\n", done->key, done->extent, done->outcome.status,
          cost->seconds, cost->cpu, cost->memory, done->outcome.row);
  return lab_out_close(&out, error);
}

void lab_done_remove(const char *folder)
{
  char path[LAB_PATH_TEXT + 32];
  path_in(folder, path);
  remove(path);
}

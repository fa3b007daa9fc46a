#include "prepare.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../apps/lab/base/outfile.h"

enum { PATHS = 1024 };

/* Numbers of a trial whose files are kept, under the line of its truth, by which a changed one is known. */
enum { NUMBERS = 1 + sizeof(blind_visible) / sizeof(double) };

static void numbers_path(const char *folder, char path[PATHS])
{
  snprintf(path, PATHS, "%s/visible.txt", folder);
}

static char *truth_line(const blind_recorded *r)
{
  char *line = NULL;
  size_t size;
  FILE *memory = open_memstream(&line, &size);
  if (memory) {
    blind_truth_write(memory, r, 0);
    fclose(memory);
  }
  return line;
}

/* Returns: 0 if they are not there, or of another trial. */
static int take_numbers(const char *folder, const char *truth, double number[NUMBERS])
{
  char path[PATHS], *line = NULL;
  size_t room = 0;
  FILE *file;
  int i, n = 0;
  numbers_path(folder, path);
  file = fopen(path, "r");
  if (file && getline(&line, &room, file) > 0 && strcmp(line, truth) == 0)
    for (i = 0; i < NUMBERS; i++)
      n += fscanf(file, "%lf", &number[i]) == 1;
  free(line);
  if (file)
    fclose(file);
  return n == NUMBERS;
}

static int put_numbers(const char *folder, const char *truth, const double number[NUMBERS], lab_error *error)
{
  char path[PATHS];
  lab_outfile file;
  int i;
  numbers_path(folder, path);
  if (lab_out_open(&file, path, error))
    return error->status;
  fputs(truth, file.file);
  for (i = 0; i < NUMBERS; i++)
    fprintf(file.file, "%.9g\n", number[i]);
  return lab_out_close(&file, error);
}

int blind_prepare(const blind_recorded *r, const char *folder, size_t *rows, blind_visible *visible, lab_error *error)
{
  char *truth = truth_line(r);
  double number[NUMBERS] = {0};
  int status = truth ? LAB_OK : lab_fail_memory(error, "a trial");
  if (status == LAB_OK && !take_numbers(folder, truth, number)) {
    status = blind_write_recorded(r, folder, rows, error);
    if (status == LAB_OK)
      status = blind_recorded_visible(r, visible, error);
    number[0] = (double)*rows;
    memcpy(number + 1, visible, sizeof *visible);
    if (status == LAB_OK)
      status = put_numbers(folder, truth, number, error);
  }
  *rows = (size_t)number[0];
  memcpy(visible, number + 1, sizeof *visible);
  free(truth);
  return status;
}

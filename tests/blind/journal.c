#include "journal.h"

#include <stdlib.h>
#include <string.h>

#include "../../apps/lab/base/outfile.h"
#include "../../apps/lab/base/text.h"

/* Read the records of a file that begins with the right key. Nothing to read is no error. */
static void take_up(blind_journal *j, const char *path, const char *key)
{
  lab_text text;
  lab_error ignored;
  const size_t length = strlen(key);
  char *line;
  if (lab_text_read(path, &text, &ignored))
    return;
  line = text.data;
  if (strncmp(line, key, length) == 0 && line[length] == '\n')
    for (line += length + 1; *line && j->n < j->room; line += strcspn(line, "\n") + 1) {
      j->n += blind_record_read(line, j->recorded, &j->record[j->n]) && j->record[j->n].trial < j->room;
      if (!strchr(line, '\n'))
        break;
    }
  lab_text_free(&text);
}

static int rewrite(const blind_journal *j, const char *path, const char *key, lab_error *error)
{
  lab_outfile out;
  int i;
  if (lab_out_open(&out, path, error))
    return error->status;
  fprintf(out.file, "%s\n", key);
  for (i = 0; i < j->n; i++)
    blind_record_write(out.file, &j->record[i], j->recorded);
  return lab_out_close(&out, error);
}

int blind_journal_open(blind_journal *j, const char *path, const char *key, int room, int recorded, lab_error *error)
{
  memset(j, 0, sizeof *j);
  j->room = room;
  j->recorded = recorded;
  j->record = malloc((size_t)room * sizeof *j->record);
  if (!j->record)
    return lab_fail_memory(error, "the journal");
  take_up(j, path, key);
  if (rewrite(j, path, key, error))
    return error->status;
  j->file = fopen(path, "a");
  return j->file ? LAB_OK : lab_fail(error, LAB_WORLD, "%s: cannot be written", path);
}

int blind_journal_has(const blind_journal *j, int trial)
{
  int i;
  for (i = 0; i < j->n; i++)
    if (j->record[i].trial == trial)
      return 1;
  return 0;
}

int blind_journal_add(blind_journal *j, const blind_record *record, lab_error *error)
{
  char *line = NULL;
  size_t size;
  FILE *memory = open_memstream(&line, &size);
  int whole = 0;
  if (!memory)
    return lab_fail_memory(error, "a line of the journal");
  blind_record_write(memory, record, j->recorded);
  fclose(memory);
  if (j->n < j->room && blind_record_read(line, j->recorded, &j->record[j->n]))
    whole = fputs(line, j->file) != EOF && fflush(j->file) == 0;
  j->n += whole;
  free(line);
  return whole ? LAB_OK : lab_fail(error, LAB_WORLD, "the journal cannot be written: is the disk full?");
}

static int by_trial(const void *a, const void *b)
{
  return ((const blind_record *)a)->trial - ((const blind_record *)b)->trial;
}

void blind_journal_sort(blind_journal *j)
{
  qsort(j->record, (size_t)j->n, sizeof *j->record, by_trial);
}

void blind_journal_close(blind_journal *j)
{
  if (j->file)
    fclose(j->file);
  free(j->record);
  memset(j, 0, sizeof *j);
}

#include "done.h"

#include <stdio.h>
#include <string.h>

#include <unistd.h>

#include "../lab/base/outfile.h"

void done_read(done *d, const char *folder)
{
  char text[DONE_TEXT + 128];
  FILE *file;
  memset(d, 0, sizeof *d);
  snprintf(d->folder, sizeof d->folder, "%s", folder);
  snprintf(d->path, sizeof d->path, "%s/.done", folder);
  snprintf(text, sizeof text, "%s.part", d->path);
  remove(text); /* of a run that was killed while it wrote the record */
  file = fopen(d->path, "r");
  while (file && d->n < DONE_MAX && fgets(text, sizeof text, file)) {
    done_line *line = &d->line[d->n];
    if (sscanf(text, "%63s %llx %2047[^\n]", line->product, &line->key, line->files) == 3)
      d->n++;
  }
  if (file)
    fclose(file);
}

static done_line *find(const done *d, const char *product)
{
  int i;
  for (i = 0; i < d->n; i++)
    if (!strcmp(d->line[i].product, product))
      return (done_line *)&d->line[i];
  return NULL;
}

static int all_there(const done *d, const char *files)
{
  char names[DONE_TEXT], path[DONE_TEXT + 1200], *name;
  snprintf(names, sizeof names, "%s", files);
  for (name = strtok(names, " "); name; name = strtok(NULL, " ")) {
    snprintf(path, sizeof path, "%s/%s", d->folder, name);
    if (access(path, R_OK))
      return 0;
  }
  return 1;
}

int done_is_fresh(const done *d, const char *product, unsigned long long key)
{
  const done_line *line = find(d, product);
  return line && line->key == key && all_there(d, line->files);
}

static int write_record(const done *d, lab_error *error)
{
  lab_outfile out;
  int i;
  if (lab_out_open(&out, d->path, error))
    return error->status;
  for (i = 0; i < d->n; i++)
    fprintf(out.file, "%s %llx %s\n", d->line[i].product, d->line[i].key, d->line[i].files);
  return lab_out_close(&out, error);
}

int done_forget(done *d, const char *product, lab_error *error)
{
  done_line *line = find(d, product);
  if (!line)
    return LAB_OK;
  *line = d->line[--d->n];
  return write_record(d, error);
}

int done_note(done *d, const char *product, unsigned long long key, const char *files, lab_error *error)
{
  done_line *line = find(d, product);
  if (!line && d->n == DONE_MAX)
    return LAB_OK; /* not noted: made again next time */
  if (!line)
    line = &d->line[d->n++];
  snprintf(line->product, sizeof line->product, "%s", product);
  snprintf(line->files, sizeof line->files, "%s", files);
  line->key = key;
  return write_record(d, error);
}

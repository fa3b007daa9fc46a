#include "outfile.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "interrupt.h"

static const char part_suffix[] = ".part";

static int cannot(const char *what, const char *path, lab_error *error)
{
  return lab_fail(error, LAB_WORLD, "%s: cannot be %s: %s", path, what, strerror(errno));
}

static char *join(const char *a, const char *b)
{
  char *text = malloc(strlen(a) + strlen(b) + 1);
  return text ? strcat(strcpy(text, a), b) : NULL;
}

/* ---- Folders ---- */

/* Make one folder.  Returns: 0 with errno set if there is none afterwards. */
static int make_one(const char *path)
{
  struct stat info;
  int reason;
  if (mkdir(path, 0777) == 0)
    return 1;
  reason = errno;
  if (stat(path, &info) == 0 && S_ISDIR(info.st_mode))
    return 1;
  errno = reason == EEXIST ? ENOTDIR : reason;
  return 0;
}

/* Make the folders named by path[0..length); path is restored. */
static int make_folders(char *path, size_t length, lab_error *error)
{
  size_t i;
  for (i = 1; i <= length; i++) {
    char kept = path[i];
    int failed;
    if (i < length && kept != '/')
      continue;
    path[i] = '\0';
    failed = !make_one(path);
    if (failed)
      cannot("made", path, error);
    path[i] = kept;
    if (failed)
      return error->status;
  }
  return LAB_OK;
}

int lab_make_folder(const char *path, lab_error *error)
{
  char *copy = join(path, "");
  int status = copy ? make_folders(copy, strlen(copy), error) : lab_fail_memory(error, path);
  free(copy);
  return status;
}

static int make_parent(char *path, lab_error *error)
{
  const char *slash = strrchr(path, '/');
  return slash && slash > path ? make_folders(path, (size_t)(slash - path), error) : LAB_OK;
}

/* ---- Files ---- */

/* Something that is there and that a rename would replace by a plain file. */
static int is_special(const char *path)
{
  struct stat info;
  return stat(path, &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
}

/* While there is a part, a signal waits (interrupt.h). */
static void forget(lab_outfile *out)
{
  if (out->part)
    lab_interrupt_release();
  free(out->path);
  free(out->part);
  memset(out, 0, sizeof *out);
}

static int open_file(lab_outfile *out, lab_error *error)
{
  const char *target = out->part ? out->part : out->path;
  int status = make_parent(out->path, error);
  if (status != LAB_OK)
    return status;
  out->file = fopen(target, "w");
  return out->file ? LAB_OK : cannot("written", target, error);
}

int lab_out_open(lab_outfile *out, const char *path, lab_error *error)
{
  int special = path && is_special(path), status;
  memset(out, 0, sizeof *out);
  out->path = join(path ? path : "standard output", "");
  if (path && !special && (out->part = join(path, part_suffix)))
    lab_interrupt_hold();
  out->file = path ? NULL : stdout;
  if (!out->path || (path && !special && !out->part))
    status = lab_fail_memory(error, "a file name");
  else
    status = path ? open_file(out, error) : LAB_OK;
  if (status != LAB_OK)
    forget(out);
  return status;
}

/* Why an earlier write has failed, which nobody has noted: the system says it again to whoever asks again. */
static void ask_again(FILE *file)
{
  clearerr(file);
  fputc('\n', file);
  fflush(file);
}

/* Returns: 0 if all that was written has arrived, else -1 with errno. */
static int finish_stream(FILE *file)
{
  int failed, reason;
  errno = 0;
  failed = fflush(file) != 0 || ferror(file);
  if (failed && !errno && file != stdout)
    ask_again(file);
  reason = errno ? errno : EIO;
  if (file != stdout && fclose(file) != 0 && !failed) {
    failed = 1;
    reason = errno;
  }
  errno = reason;
  return failed ? -1 : 0;
}

int lab_out_close(lab_outfile *out, lab_error *error)
{
  int status = LAB_OK;
  if (finish_stream(out->file) != 0)
    status = cannot("written", out->path, error);
  else if (out->part && rename(out->part, out->path) != 0)
    status = cannot("put in place", out->path, error);
  if (status != LAB_OK && out->part)
    remove(out->part);
  forget(out);
  return status;
}

int lab_out_say(const char *line, lab_error *error)
{
  lab_outfile out;
  if (lab_out_open(&out, NULL, error))
    return error->status;
  fprintf(out.file, "%s\n", line);
  return lab_out_close(&out, error);
}

void lab_out_abandon(lab_outfile *out)
{
  if (out->file && out->file != stdout)
    fclose(out->file);
  if (out->part)
    remove(out->part);
  forget(out);
}

int lab_out_end(lab_outfile *out, int status, lab_error *error)
{
  if (status == LAB_OK)
    return lab_out_close(out, error);
  lab_out_abandon(out);
  return status;
}

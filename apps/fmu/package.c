#include "package.h"

#include "../lab/base/outfile.h"

enum { NO_TIME = 0, NO_DATE = 1 << 5 | 1 }; /* 1980-01-01, the earliest that a zip archive knows */
#define PLAIN_FILE ((zip_uint32_t)0100644 << 16)

int fmu_package_begin(fmu_package *package, lab_error *error)
{
  package->zip = NULL;
  package->source = zip_source_buffer_create(NULL, 0, 0, NULL);
  if (package->source)
    package->zip = zip_open_from_source(package->source, ZIP_TRUNCATE, NULL);
  if (package->zip) {
    zip_source_keep(package->source);
    return LAB_OK;
  }
  if (package->source)
    zip_source_free(package->source);
  package->source = NULL;
  return lab_fail_memory(error, "the archive");
}

/* A source that owns a copy of the bytes; NULL without memory. */
static zip_source_t *copy_in(const void *bytes, size_t size)
{
  zip_source_t *source = zip_source_buffer_create(NULL, 0, 0, NULL);
  if (source && (zip_source_begin_write(source) || zip_source_write(source, bytes, size) != (zip_int64_t)size ||
                 zip_source_commit_write(source))) {
    zip_source_free(source);
    return NULL;
  }
  return source;
}

int fmu_package_add(fmu_package *package, const char *name, const void *bytes, size_t size, lab_error *error)
{
  zip_source_t *source = copy_in(bytes, size);
  zip_int64_t at;
  if (!source)
    return lab_fail_memory(error, name);
  at = zip_file_add(package->zip, name, source, 0);
  if (at < 0) {
    zip_source_free(source);
    return lab_fail(error, LAB_WORLD, "%s: cannot go into the archive: %s", name, zip_strerror(package->zip));
  }
  if (zip_file_set_dostime(package->zip, (zip_uint64_t)at, NO_TIME, NO_DATE, 0) ||
      zip_file_set_external_attributes(package->zip, (zip_uint64_t)at, 0, ZIP_OPSYS_UNIX, PLAIN_FILE))
    return lab_fail(error, LAB_WORLD, "%s: cannot go into the archive: %s", name, zip_strerror(package->zip));
  return LAB_OK;
}

static int copy_out(zip_source_t *source, FILE *file)
{
  char part[16384];
  zip_int64_t n;
  if (zip_source_open(source))
    return -1;
  while ((n = zip_source_read(source, part, sizeof part)) > 0)
    fwrite(part, 1, (size_t)n, file);
  zip_source_close(source);
  return n < 0 ? -1 : 0;
}

int fmu_package_write(fmu_package *package, const char *path, lab_error *error)
{
  lab_outfile out;
  if (zip_close(package->zip)) {
    lab_fail(error, LAB_WORLD, "the archive cannot be made: %s", zip_strerror(package->zip));
    fmu_package_drop(package);
    return error->status;
  }
  package->zip = NULL;
  if (lab_out_open(&out, path, error) == LAB_OK) {
    if (copy_out(package->source, out.file) == 0)
      lab_out_close(&out, error);
    else {
      lab_out_abandon(&out);
      lab_fail_memory(error, "the archive");
    }
  }
  fmu_package_drop(package);
  return error->status;
}

void fmu_package_drop(fmu_package *package)
{
  if (package->zip)
    zip_discard(package->zip);
  if (package->source)
    zip_source_free(package->source);
  package->zip = NULL;
  package->source = NULL;
}

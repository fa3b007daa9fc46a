#include "export.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include <zip.h>

#include "carried.h"
#include "description.h"
#include "modeldata.h"
#include "../lab/base/outfile.h"

enum { PATH_TEXT = 256 };

/* Folders for binaries in FMI 2 and FMI 3, where this compiler's machine has one. */
#if defined __x86_64__ && defined __linux__
static const char *const platforms[] = {"linux64", "x86_64-linux"};
#elif defined __aarch64__ && defined __linux__
static const char *const platforms[] = {NULL, "aarch64-linux"};
#else
static const char *const platforms[] = {NULL, NULL}; /* sources only */
#endif

/* ---- A zip archive in memory, by libzip; the same files give the same bytes, because none has a date ---- */

typedef struct package {
  zip_source_t *source; /* the archive */
  zip_t *zip;
} package;

enum { NO_TIME = 0, NO_DATE = 1 << 5 | 1 }; /* 1980-01-01, the earliest that a zip archive knows */
#define PLAIN_FILE ((zip_uint32_t)0100644 << 16)

/* Begin; to be ended by write_package, or drop_package after an error.  Returns: LAB_OK, LAB_WORLD. */
static int begin_package(package *p, lab_error *error)
{
  p->zip = NULL;
  p->source = zip_source_buffer_create(NULL, 0, 0, NULL);
  if (p->source)
    p->zip = zip_open_from_source(p->source, ZIP_TRUNCATE, NULL);
  if (p->zip) {
    zip_source_keep(p->source);
    return LAB_OK;
  }
  if (p->source)
    zip_source_free(p->source);
  p->source = NULL;
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

/* Add a file.  In: bytes  copied.  Returns: LAB_OK, LAB_WORLD. */
static int add_file(package *p, const char *name, const void *bytes, size_t size, lab_error *error)
{
  zip_source_t *source = copy_in(bytes, size);
  zip_int64_t at;
  if (!source)
    return lab_fail_memory(error, name);
  at = zip_file_add(p->zip, name, source, 0);
  if (at < 0) {
    zip_source_free(source);
    return lab_fail(error, LAB_WORLD, "%s: cannot go into the archive: %s", name, zip_strerror(p->zip));
  }
  if (zip_file_set_dostime(p->zip, (zip_uint64_t)at, NO_TIME, NO_DATE, 0) ||
      zip_file_set_external_attributes(p->zip, (zip_uint64_t)at, 0, ZIP_OPSYS_UNIX, PLAIN_FILE))
    return lab_fail(error, LAB_WORLD, "%s: cannot go into the archive: %s", name, zip_strerror(p->zip));
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

static void drop_package(package *p)
{
  if (p->zip)
    zip_discard(p->zip);
  if (p->source)
    zip_source_free(p->source);
  p->zip = NULL;
  p->source = NULL;
}

/* Put the archive into a file, whole or not at all.  Returns: LAB_OK, LAB_WORLD. */
static int write_package(package *p, const char *path, lab_error *error)
{
  lab_outfile out;
  if (zip_close(p->zip)) {
    lab_fail(error, LAB_WORLD, "the archive cannot be made: %s", zip_strerror(p->zip));
    drop_package(p);
    return error->status;
  }
  p->zip = NULL;
  if (lab_out_open(&out, path, error) == LAB_OK) {
    if (copy_out(p->source, out.file) == 0)
      lab_out_close(&out, error);
    else {
      lab_out_abandon(&out);
      lab_fail_memory(error, "the archive");
    }
  }
  drop_package(p);
  return error->status;
}

/* ---- What goes into it ---- */

/* What is at hand while an FMU is made. */
typedef struct maker {
  const lab_rig *rig;
  fmu_data data;
  fmu_list list;
  char identifier[LAB_NAME_TEXT + 1];
  fmu_description description;
  package package;
} maker;

/* "37-13" is no name in C: "_37_13" is. */
static void identify(const char *name, char *identifier)
{
  if (!isalpha((unsigned char)*name))
    *identifier++ = '_';
  for (; *name; name++)
    *identifier++ = (char)(isalnum((unsigned char)*name) ? *name : '_');
  *identifier = '\0';
}

static int add_xml(maker *m, const char *name, void (*describe)(fmu_xml *, const fmu_description *), lab_error *error)
{
  fmu_xml xml;
  char *text;
  size_t size;
  fmu_xml_begin(&xml);
  describe(&xml, &m->description);
  if (fmu_xml_end(&xml, &text, &size, error) == LAB_OK)
    add_file(&m->package, name, text, size, error);
  free(text);
  return error->status;
}

static int add_carried(maker *m, const char *name, const char *carried, lab_error *error)
{
  const fmu_file *file = fmu_carried_find(carried);
  return add_file(&m->package, name, file->bytes, file->size, error);
}

static int add_binary(maker *m, lab_error *error)
{
  const int fmi = m->description.fmi;
  const char *platform = platforms[fmi - 2];
  char name[PATH_TEXT];
  unsigned char *bytes;
  size_t size;
  if (!platform)
    return LAB_OK;
  snprintf(name, sizeof name, "binaries/%s/%s.so", platform, m->identifier);
  if (fmu_data_binary(&m->data, fmi, &bytes, &size, error) == LAB_OK)
    add_file(&m->package, name, bytes, size, error);
  free(bytes);
  return error->status;
}

static int add_header(maker *m, const char *name, lab_error *error)
{
  char *text;
  size_t size;
  if (fmu_data_header(m->rig, &m->data, &text, &size, error) == LAB_OK)
    add_file(&m->package, name, text, size, error);
  free(text);
  return error->status;
}

/* The sources, in the folders of the repository, and the model's header in the place of the empty one. */
static int add_sources(maker *m, lab_error *error)
{
  const fmu_file *file;
  int i;
  for (i = 0; (file = fmu_carried(i)); i++) {
    char name[PATH_TEXT];
    if (!fmu_is_source(file, m->description.fmi))
      continue;
    snprintf(name, sizeof name, "sources/%s", file->name);
    if (strstr(name, "/model_data.h") ? add_header(m, name, error)
                                      : add_file(&m->package, name, file->bytes, file->size, error))
      return error->status;
  }
  return LAB_OK;
}

/* The model file, for the other programs. */
static int add_model(maker *m, lab_error *error)
{
  char *text = NULL;
  size_t size;
  FILE *file = open_memstream(&text, &size);
  if (!file)
    return lab_fail_memory(error, "the model");
  lab_rig_write(file, m->rig, "The model of this FMU, for libpneu's programs.");
  if (fclose(file) == 0)
    add_file(&m->package, "resources/model.cfg", text, size, error);
  else
    lab_fail_memory(error, "the model");
  free(text);
  return error->status;
}

/* What only one version has. */
static int add_own(maker *m, lab_error *error)
{
  if (m->description.fmi == 2)
    return add_carried(m, "model.png", "icon.png", error);
  if (add_xml(m, "sources/buildDescription.xml", fmu_describe_build, error) ||
      add_xml(m, "terminalsAndIcons/terminalsAndIcons.xml", fmu_describe_icon, error) ||
      add_carried(m, "terminalsAndIcons/icon.png", "icon.png", error))
    return error->status;
  return add_carried(m, "terminalsAndIcons/icon.svg", "icon.svg", error);
}

static int add_all(maker *m, lab_error *error)
{
  if (add_xml(m, "modelDescription.xml", fmu_describe, error) || add_binary(m, error) || add_sources(m, error) ||
      add_model(m, error) || add_carried(m, "documentation/index.html", "index.html", error) ||
      add_carried(m, "documentation/licenses/license.txt", "license.txt", error))
    return error->status;
  return add_own(m, error);
}

static int prepare(maker *m, int fmi, lab_error *error)
{
  pneu_model model;
  if (lab_rig_model(m->rig, &model, error))
    return error->status;
  fmu_data_of(m->rig, fmi, &m->data);
  fmu_list_of(&m->data, &model, &m->list);
  identify(m->rig->name, m->identifier);
  m->description.fmi = fmi;
  m->description.name = m->rig->name;
  m->description.identifier = m->identifier;
  m->description.data = &m->data;
  m->description.list = &m->list;
  return LAB_OK;
}

int fmu_export(const lab_rig *rig, int fmi, const char *path, lab_error *error)
{
  char own_path[LAB_NAME_TEXT + 8];
  maker m;
  memset(&m, 0, sizeof m);
  m.rig = rig;
  error->status = LAB_OK;
  if (prepare(&m, fmi, error) || begin_package(&m.package, error))
    return error->status;
  if (add_all(&m, error)) {
    drop_package(&m.package);
    return error->status;
  }
  snprintf(own_path, sizeof own_path, "%s.fmu", m.identifier);
  return write_package(&m.package, path ? path : own_path, error);
}

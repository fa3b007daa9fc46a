#include "export.h"

#include <ctype.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include <zip.h>

#include "carried.h"
#include "description.h"
#include "../lab/base/checksum.h"
#include "../lab/base/outfile.h"

enum { PATH_TEXT = 256 };

/* Folders for binaries in FMI 2 and FMI 3: of the machine that builds export-fmu, if it has one (FMU_LINUX64 tells that
 * to another machine's compiler), and of Windows. */
static const struct {
  const char *folder[2], *ending;
} platforms[] = {
#if (defined __x86_64__ && defined __linux__) || defined FMU_LINUX64
    {{"linux64", "x86_64-linux"}, "so"},
#elif defined __aarch64__ && defined __linux__
    {{NULL, "aarch64-linux"}, "so"},
#endif
    {{"win64", "x86_64-windows"}, "dll"}};

/* ---- The model as the FMU has it ---- */

typedef char fmu_room_for_terms[(int)FMU_TERM_MAX >= (int)LAB_TERM_MAX ? 1 : -1];

static uint64_t add_numbers(uint64_t sum, const fmu_data *data)
{
  pneu_params params = data->params;
  const int laws[] = {data->law.gas, data->law.flow, data->law.pressure_input, data->law.position_input, data->n_terms};
  int i, k;
  for (i = 0; i < PNEU_PARAM_COUNT; i++)
    sum = lab_checksum(sum, pneu_param_at(&params, i), sizeof(pneu_real));
  sum = lab_checksum(sum, laws, sizeof laws);
  for (i = 0; i < data->n_terms; i++) {
    const pneu_term *term = &data->term[i];
    const int whole[] = {term->equation, term->argument, term->n};
    sum = lab_checksum(sum, whole, sizeof whole);
    sum = lab_checksum(sum, &term->from, sizeof term->from);
    sum = lab_checksum(sum, &term->to, sizeof term->to);
    for (k = 0; k < term->n; k++)
      sum = lab_checksum(sum, &term->value[k], sizeof term->value[k]);
  }
  return sum;
}

static void make_token(fmu_data *data, int fmi)
{
  uint64_t sum[2] = {LAB_CHECKSUM_SEED, ~LAB_CHECKSUM_SEED};
  int i, k;
  for (k = 0; k < 2; k++) {
    sum[k] = lab_checksum(sum[k], &fmi, sizeof fmi);
    for (i = 0; fmu_files[i].name; i++)
      sum[k] = lab_checksum(sum[k], fmu_files[i].bytes, fmu_files[i].size);
    sum[k] = add_numbers(sum[k], data);
  }
  snprintf(data->token, sizeof data->token, "{%08" PRIx32 "-%04x-%04x-%04x-%012" PRIx64 "}", (uint32_t)(sum[0] >> 32),
           (unsigned)(sum[0] >> 16 & 0xffff), (unsigned)(sum[0] & 0xffff), (unsigned)(sum[1] >> 48),
           sum[1] & UINT64_C(0xffffffffffff));
}

/* The data of a rig; their token is made from the model, from the version of FMI and from what export-fmu carries: the
 * same model gives the same token. */
static void data_of(const lab_rig *rig, int fmi, fmu_data *data)
{
  memset(data, 0, sizeof *data);
  strcpy(data->mark, FMU_MARK);
  data->params = rig->params;
  data->law = rig->laws;
  data->n_terms = rig->n_terms;
  memcpy(data->term, rig->term, (size_t)rig->n_terms * sizeof rig->term[0]);
  make_token(data, fmi);
}

/* What is at hand while an FMU is made. */
typedef struct maker {
  fmu_description d;
  zip_source_t *archive; /* in memory */
  zip_t *zip;
} maker;

/* ---- A zip archive, by libzip; the same files give the same bytes, because none has a date ---- */

enum { NO_TIME = 0, NO_DATE = 1 << 5 | 1 }; /* 1980-01-01, the earliest that a zip archive knows */
#define PLAIN_FILE ((zip_uint32_t)0100644 << 16)

static int begin_archive(maker *m, lab_error *error)
{
  m->archive = zip_source_buffer_create(NULL, 0, 0, NULL);
  m->zip = m->archive ? zip_open_from_source(m->archive, ZIP_TRUNCATE, NULL) : NULL;
  if (!m->zip)
    return lab_fail_memory(error, "the archive");
  zip_source_keep(m->archive);
  return LAB_OK;
}

/* In: owned  not 0: the archive frees the bytes, also after an error */
static int add_file(maker *m, const char *name, const void *bytes, size_t size, int owned, lab_error *error)
{
  zip_source_t *source = zip_source_buffer(m->zip, bytes, size, owned);
  zip_int64_t at;
  if (!source) {
    free(owned ? (void *)bytes : NULL);
    return lab_fail_memory(error, name);
  }
  at = zip_file_add(m->zip, name, source, 0);
  if (at < 0)
    zip_source_free(source);
  if (at < 0 || zip_file_set_dostime(m->zip, (zip_uint64_t)at, NO_TIME, NO_DATE, 0) ||
      zip_file_set_external_attributes(m->zip, (zip_uint64_t)at, 0, ZIP_OPSYS_UNIX, PLAIN_FILE))
    return lab_fail(error, LAB_WORLD, "%s: cannot go into the archive: %s", name, zip_strerror(m->zip));
  return LAB_OK;
}

static int copy_out(zip_source_t *source, FILE *file, lab_error *error)
{
  char part[16384];
  zip_int64_t n = -1;
  if (zip_source_open(source) == 0) {
    while ((n = zip_source_read(source, part, sizeof part)) > 0)
      fwrite(part, 1, (size_t)n, file);
    zip_source_close(source);
  }
  return n < 0 ? lab_fail_memory(error, "the archive") : LAB_OK;
}

/* Put the archive into a file, whole or not at all. */
static int write_archive(maker *m, const char *path, lab_error *error)
{
  lab_outfile out;
  if (zip_close(m->zip))
    return lab_fail(error, LAB_WORLD, "the archive cannot be made: %s", zip_strerror(m->zip));
  m->zip = NULL;
  if (lab_out_open(&out, path, error))
    return error->status;
  return lab_out_end(&out, copy_out(m->archive, out.file, error), error);
}

static void end_archive(maker *m)
{
  if (m->zip)
    zip_discard(m->zip);
  zip_source_free(m->archive);
}

/* ---- What goes into it ---- */

/* "37-13" is no name in C: "_37_13" is. */
static void identify(const char *name, char *identifier)
{
  if (!isalpha((unsigned char)*name))
    *identifier++ = '_';
  for (; *name; name++)
    *identifier++ = (char)(isalnum((unsigned char)*name) ? *name : '_');
  *identifier = '\0';
}

static int add_carried(maker *m, const char *name, const char *carried, lab_error *error)
{
  const fmu_file *file = fmu_carried(carried);
  return add_file(m, name, file->bytes, file->size, 0, error);
}

/* Writes a file of the FMU.  Returns: LAB_OK, LAB_WORLD. */
typedef int writer(FILE *file, const fmu_description *d, lab_error *error);

/* Add what depends on the model. */
static int add_written(maker *m, const char *name, writer *write, lab_error *error)
{
  char *text = NULL;
  size_t size;
  FILE *file = open_memstream(&text, &size);
  int status = file ? write(file, &m->d, error) : lab_fail_memory(error, name);
  if (file && fclose(file) != 0 && status == LAB_OK)
    status = lab_fail_memory(error, name);
  if (status == LAB_OK)
    return add_file(m, name, text, size, 1, error);
  free(text);
  return status;
}

/* model_data.h, for who compiles the sources. */
static int write_header(FILE *file, const fmu_description *d, lab_error *error)
{
  (void)error;
  fprintf(file, "/* The model, by export-fmu; for libpneu " PNEU_VERSION " with its whole catalogue. */\n");
  fprintf(file, "#define MODEL_TOKEN \"%s\"\n", d->data.token);
  lab_rig_write_c(file, d->rig, 1);
  if (d->rig->n_terms == 0)
    fputs("#define MODEL_TERMS {{0, 0, 0, 0, 0, {0}}}\n", file);
  return LAB_OK;
}

/* The model file, for the other programs. */
static int write_model(FILE *file, const fmu_description *d, lab_error *error)
{
  (void)error;
  lab_rig_write(file, d->rig, "The model of this FMU, for libpneu's programs.");
  return LAB_OK;
}

/* A shared library, with the data in their place. */
static int add_binary(maker *m, const char *name, const fmu_file *library, lab_error *error)
{
  const fmu_data *data = &m->d.data;
  unsigned char *bytes;
  size_t at = 0; /* where the data begin */
  while (at + sizeof *data <= library->size && memcmp(library->bytes + at, FMU_MARK, sizeof FMU_MARK) != 0)
    at++;
  if (at + sizeof *data > library->size)
    return lab_fail(error, LAB_WORLD, "%s as built has no place for a model: build export-fmu again without -flto",
                    library->name);
  bytes = malloc(library->size);
  if (!bytes)
    return lab_fail_memory(error, name);
  memcpy(bytes, library->bytes, library->size);
  memcpy(bytes + at, data, sizeof *data);
  return add_file(m, name, bytes, library->size, 1, error);
}

static int add_binaries(maker *m, lab_error *error)
{
  char library[16], name[PATH_TEXT];
  size_t i;
  int status = LAB_OK;
  for (i = 0; i < sizeof platforms / sizeof platforms[0] && status == LAB_OK; i++) {
    const char *folder = platforms[i].folder[m->d.fmi - 2], *ending = platforms[i].ending;
    const fmu_file *carried;
    snprintf(library, sizeof library, "fmu%d.%s", m->d.fmi, ending);
    snprintf(name, sizeof name, "binaries/%s/%s.%s", folder ? folder : "", m->d.identifier, ending);
    carried = fmu_carried(library);
    if (folder && carried)
      status = add_binary(m, name, carried, error);
  }
  return status;
}

/* The sources, in the folders of the repository, and the model's header in the place of the empty one. */
static int add_sources(maker *m, lab_error *error)
{
  const fmu_file *file;
  for (file = fmu_files; file->name; file++) {
    char name[PATH_TEXT];
    if (!fmu_is_source(file, m->d.fmi))
      continue;
    snprintf(name, sizeof name, "sources/%s", file->name);
    if (strstr(name, "/model_data.h") ? add_written(m, name, write_header, error)
                                      : add_carried(m, name, file->name, error))
      return error->status;
  }
  return LAB_OK;
}

/* What only one version has. */
static int add_own(maker *m, lab_error *error)
{
  if (m->d.fmi == 2)
    return add_carried(m, "model.png", "icon.png", error);
  if (add_written(m, "sources/buildDescription.xml", fmu_describe_build, error) ||
      add_carried(m, "terminalsAndIcons/terminalsAndIcons.xml", "terminalsAndIcons.xml", error) ||
      add_carried(m, "terminalsAndIcons/icon.png", "icon.png", error))
    return error->status;
  return add_carried(m, "terminalsAndIcons/icon.svg", "icon.svg", error);
}

static int add_all(maker *m, lab_error *error)
{
  if (add_written(m, "modelDescription.xml", fmu_describe, error) || add_binaries(m, error) || add_sources(m, error) ||
      add_written(m, "resources/model.cfg", write_model, error) ||
      add_carried(m, "documentation/index.html", "index.html", error) ||
      add_carried(m, "documentation/licenses/license.txt", "license.txt", error))
    return error->status;
  return add_own(m, error);
}

int fmu_export(const lab_rig *rig, int fmi, const char *path, lab_error *error)
{
  char own_path[LAB_NAME_TEXT + 8];
  pneu_model model;
  maker m;
  int status;
  memset(&m, 0, sizeof m);
  if (lab_rig_model(rig, &model, error))
    return error->status;
  m.d.fmi = fmi;
  m.d.rig = rig;
  identify(rig->name, m.d.identifier);
  data_of(rig, fmi, &m.d.data);
  fmu_list_of(&m.d.data, &model, &m.d.list);
  snprintf(own_path, sizeof own_path, "%s.fmu", m.d.identifier);
  status = begin_archive(&m, error);
  if (status == LAB_OK)
    status = add_all(&m, error);
  if (status == LAB_OK)
    status = write_archive(&m, path ? path : own_path, error);
  end_archive(&m);
  return status;
}
